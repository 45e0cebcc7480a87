/* src/observer/observer_short_steps.h -- First rows that need steps shorter than those of the run. [H 13, 22]
 *
 * Internal to the room. A run with steps of one length tells forces by its impulses. In three cases it errs in its first
 * rows, however the impulses are compared:
 *
 *   - a damper has an order above 1: with a start velocity its force falls from infinity within a few steps
 *   - the past rl jumps: the force of every damper that it stretches falls from infinity
 *   - a coordinate has no inertia: it jumps, or starts with a velocity that is not known
 *
 * fvi_variable_step begins with steps as short as such a start asks for. So it takes the same run up to the last of these
 * rows, and its numbers are told: the forces, accelerations and multipliers, and the velocities if a coordinate has no
 * inertia. x and p stay those of the run. */
#ifndef FVI_OBSERVER_SHORT_STEPS_H
#define FVI_OBSERVER_SHORT_STEPS_H

#include <fvi/observer.h>

#include <stddef.h>

typedef struct {
    size_t rows;     /* 1 to `rows` are known; 0: none */
    size_t width;    /* of a row: the forces, d velocities, d accelerations, the multipliers, d places */
    double *numbers; /* owned; NULL if there are none */
} fvi_short_rows;

/* fvi_short_rows_start -- the rows of an observer whose forces have begun.
 *
 * None are made if none are needed, or if fvi_variable_step refuses the run. Three kinds of runs have none either: those
 * by lda and Euler's methods, more than 200 unknowns of matrices, and more than 12 coordinates whose potential has no narrow
 * band. If a callback fails, or if more than 1000 steps were needed, the rows end there. Accuracy: what x may be
 * off by in each step is 1e-10 of what x does in the first step of the run, or up to 1e-6 of it where an order is near 2;
 * seen 1e-7 of the forces. Cost: mostly 20 to 100 steps; 0.1 ms to 0.4 ms for one mass and one damper, 0.2 s for 100
 * unknowns of matrices (seen). Returns
 * FVI_SUCCESS or FVI_ENOMEM.
 * fvi_short_rows_copy -- the same again. Returns the same.
 * fvi_short_rows_free -- give the memory back. */
int fvi_short_rows_start(fvi_observer *o, const fvi_stepper *s);
int fvi_short_rows_copy(const fvi_short_rows *from, fvi_short_rows *to);
void fvi_short_rows_free(fvi_short_rows *o);

/* fvi_short_row -- row k, from 1; NULL if it is not known. */
static inline const double *fvi_short_row(const fvi_short_rows *o, size_t k)
{
    return k >= 1 && k <= o->rows ? o->numbers + (k - 1) * o->width : NULL;
}

#endif
