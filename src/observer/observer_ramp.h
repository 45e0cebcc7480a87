/* src/observer/observer_ramp.h -- The error of the first impulses of a damper after a start with a velocity. [H 13]
 *
 * Internal to the room. At first an elongation is z = t zdot. The steps of order 2 sum the force of this line with an
 * error that no shorter step makes smaller in the first rows: for a dashpot the first impulse is 3/4 of rho h zdot.
 * Both impulses of the line are known, the one that the steps give and the exact one. So the observer adds their
 * difference, the lead, to the impulses. x and p keep the error. */
#ifndef FVI_OBSERVER_RAMP_H
#define FVI_OBSERVER_RAMP_H

#include <fvi/trajectory.h>

typedef struct fvi_ramp fvi_ramp;

/* fvi_ramp_method -- the method of order 2 by convolution quadrature, without a mechanism, that sums the dampers in the
 * same way as the run of s; NULL for other methods. */
const fvi_method *fvi_ramp_method(const fvi_stepper *s);

/* fvi_ramp_step_prescribed -- take a step of bodies whose motion is prescribed, because their mass is so large that no
 * damper slows them down; by a method of fvi_ramp_method. Adds the impulse of the damping to J, a number for each body:
 * the part of D_k at the beginning of the step, and the part of D_{k+1} at its end (13.10). Returns what the step
 * returns. */
int fvi_ramp_step_prescribed(fvi_stepper *bodies, double *J);

/* fvi_ramp_start -- start the line of damper j of the run of s, for a method of order 2 by convolution quadrature.
 *
 *   ramp  output; NULL if there is nothing to add: for other methods, and for orders above 1, because their history
 *         subtracts the line exactly (19.3)
 *
 * Returns FVI_SUCCESS, FVI_ENOMEM, or what the start of the steps along the line returned. */
int fvi_ramp_start(const fvi_stepper *s, size_t j, fvi_ramp **ramp);

/* fvi_ramp_step -- go on to the next node.
 *
 *   lead  in and out: the exact impulse of the line with zdot = 1 up to this node, minus the impulse of the steps. For
 *         a damper of an alpha this is with rho = 1
 *
 * Once a step adds less than 1e-10 of the exact impulse, lead no longer changes. Cost: a step of one body; for a law
 * 150 products of complex numbers in addition. Returns what the step returns. */
int fvi_ramp_step(fvi_ramp *ramp, double *lead);

/* fvi_ramp_leads -- write the leads of damper j in rows 1 to `rows`; lead[0] is that of row 1.
 *
 *   is_whole  nonzero: the lead changes in all rows, however little */
int fvi_ramp_leads(const fvi_stepper *s, size_t j, size_t rows, int is_whole, double *lead);

/* fvi_ramp_copy -- make a copy.
 * fvi_ramp_archive -- serialise what its steps change, as fvi_stepper_archive.
 * fvi_ramp_free -- free everything. NULL is allowed. */
int fvi_ramp_copy(const fvi_ramp *from, fvi_ramp **to);
int fvi_ramp_archive(fvi_ramp *ramp, fvi_archive *archive);
void fvi_ramp_free(fvi_ramp *ramp);

#endif
