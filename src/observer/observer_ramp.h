/* src/observer/observer_ramp.h -- What a start with a velocity leaves in the impulses of a damper. [H 13]
 *
 * Internal to the room. At first an elongation is z = t zdot. The steps of order 2 sum the force of this line with an
 * error that no shorter step makes smaller in the first rows: for a dashpot the first impulse is 3/4 of rho h zdot.
 * Both impulses of the line are known, that of the steps and the exact one, so the difference can be added to what
 * the steps give. x and p keep it. */
#ifndef FVI_OBSERVER_RAMP_H
#define FVI_OBSERVER_RAMP_H

#include <fvi/trajectory.h>

typedef struct fvi_ramp fvi_ramp;

/* fvi_ramp_method -- the steps of order 2 by convolution quadrature that sum the dampers of s, without a mechanism;
 * NULL of other steps. */
const fvi_method *fvi_ramp_method(const fvi_stepper *s);

/* fvi_ramp_step_prescribed -- a step of bodies whose motion is prescribed, because their mass is so large that no damper
 * slows them down; by a method of fvi_ramp_method. J, a number for each body, grows by the impulse of the damping: the
 * part of D_k at the begin of the step, and the part of D_{k+1} at its end (13.10). Returns what the step returns. */
int fvi_ramp_step_prescribed(fvi_stepper *bodies, double *J);

/* fvi_ramp_start -- of damper j of the run of s, for a method of order 2 (a scheme by convolution quadrature).
 *
 *   ramp  output; NULL if there is nothing to add: other methods, and orders above 1, whose line is taken out of the
 *         history exactly (19.3)
 *
 * Returns FVI_SUCCESS, FVI_ENOMEM, or what the start of the steps along the line returned. */
int fvi_ramp_start(const fvi_stepper *s, size_t j, fvi_ramp **ramp);

/* fvi_ramp_step -- go on to the next node.
 *
 *   lead  in and out: the exact impulse of the line with zdot = 1 up to this node, less that of the steps. A damper
 *         of an alpha has rho = 1 here
 *
 * Once a step adds less than 1e-10 of the exact impulse, lead stays. Cost: a step of one body; of a law 150 products
 * of complex numbers, too. */
int fvi_ramp_step(fvi_ramp *ramp, double *lead);

/* fvi_ramp_leads -- the lead of damper j in rows 1 to `rows`, lead[0] that of row 1.
 *
 *   is_whole  nonzero: it grows in all rows, however little */
int fvi_ramp_leads(const fvi_stepper *s, size_t j, size_t rows, int is_whole, double *lead);

/* fvi_ramp_copy -- the same again, by its steps from the start on: as long as they add something, a copy takes as long
 * as a run of one body up to this node.
 * fvi_ramp_archive -- what its steps change, as fvi_stepper_archive.
 * fvi_ramp_free -- give everything back. NULL is allowed. */
int fvi_ramp_copy(const fvi_ramp *from, fvi_ramp **to);
int fvi_ramp_archive(fvi_ramp *ramp, fvi_archive *archive);
void fvi_ramp_free(fvi_ramp *ramp);

#endif
