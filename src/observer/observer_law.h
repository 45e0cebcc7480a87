/* src/observer/observer_law.h -- The force of a law in the first rows, from its impulses. [H 13, 26]
 *
 * Internal to the room. Differences of impulses give a smooth force. In the first rows the force of a law is not
 * smooth: it answers to a start with a velocity within its relaxation time, which may be shorter than a step. But its
 * answers G_1 to G_4 to a jump, a line and a parabola are known (26.21). The steps sum the impulses S_1, S_2 and S_3 of
 * these three motions, and S_i differs from G_{i+1} in the first rows. A damper with z = z_0 + v_0 t + ... gets the
 * impulse
 *
 *     J = z_0 S_1 + v_0 S_2 + g S_3,     so its force is z_0 G_1 + v_0 G_2 + g G_3 + g' G_4,          (13.20)
 *
 * and only g, which is smooth, is differentiated. */
#ifndef FVI_OBSERVER_LAW_H
#define FVI_OBSERVER_LAW_H

#include <fvi/trajectory.h>

/* The motions, as indices of their numbers. */
enum { FVI_JUMP, FVI_LINE, FVI_PARABOLA, FVI_STARTS };

/* One row of a law: G_1 to G_4, and S_1 to S_3. Motion i has the force exact[i], the exact impulse exact[i + 1], and
 * the impulse summed[i] of the steps. */
typedef struct {
    double exact[FVI_STARTS + 1], summed[FVI_STARTS];
    double uncorrected_line; /* S_2 of convolution quadrature without the correction (13.18) */
} fvi_law_row;

/* How the steps of a run sum a damper: by the weights of a law, or, if law is NULL, by the weights of one power. A law
 * may be one power, too: its weights are other ones. */
typedef struct {
    const fvi_kernel *law;
    fvi_kernel_term power;
} fvi_summed_damper;

/* fvi_summed_damper_of -- damper j of the run of s. */
fvi_summed_damper fvi_summed_damper_of(const fvi_stepper *s, size_t j);

/* The rows 1 to `rows` of all different laws of a run. */
typedef struct {
    size_t rows, laws, dampers;
    size_t *law_of;     /* the index of the law of each damper */
    fvi_law_row *first; /* the rows of law i begin at [i * rows] */
} fvi_law_rows;

/* fvi_law_rows_start -- compute the rows of the laws of a run at its start. *o is zeroed before the call.
 *
 *   dampers  how many the run has
 *
 * Cost: for each different law one start of a run and `rows` steps of two bodies, 0.2 ms to 4 ms (seen). Returns
 * FVI_SUCCESS, FVI_ENOMEM or what the steps returned.
 * fvi_law_rows_copy -- make a copy. Returns FVI_SUCCESS or FVI_ENOMEM.
 * fvi_law_rows_free -- free the memory. */
int fvi_law_rows_start(fvi_law_rows *o, const fvi_stepper *s, size_t dampers, size_t rows);
int fvi_law_rows_copy(const fvi_law_rows *from, fvi_law_rows *to);
void fvi_law_rows_free(fvi_law_rows *o);

/* fvi_law_rows_of -- the rows of damper j, row 1 first; NULL if there are none, or if its law has no force. */
const fvi_law_row *fvi_law_rows_of(const fvi_law_rows *o, size_t j);

/* fvi_law_sums -- compute S_1 to S_3 of rows 1 to `rows`. Two bodies of huge mass move along t and t^2/2 by the method
 * of s, and the impulses of their dampers are read. S_1 is 0 except for `fvi`, the only method that accepts a jump with
 * a law. Returns what the steps return. */
int fvi_law_sums(const fvi_stepper *s, const fvi_summed_damper *of, size_t rows, fvi_law_row *first);

#endif
