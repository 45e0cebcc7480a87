/* src/observer/observer_short_steps.h -- First rows that need steps shorter than the steps of the run. [H 13, 22]
 *
 * Internal to the room. A run with steps of one length gives forces by its impulses. In three cases they are wrong in
 * the first rows, with whatever the impulses are compared:
 *
 *   - a damper has an order above 1: with a start velocity its force falls from infinity within a few steps
 *   - the past rl jumps: the force of every damper that it stretches falls from infinity
 *   - a coordinate has no inertia: it jumps, or starts with a velocity that is not known
 *
 * fvi_variable_step begins with steps as short as such a start needs. So it makes the same run up to the last of these
 * rows. The observer gives its forces, accelerations and multipliers, and its velocities if a coordinate has no
 * inertia. x and p stay those of the run. */
#ifndef FVI_OBSERVER_SHORT_STEPS_H
#define FVI_OBSERVER_SHORT_STEPS_H

#include <fvi/observer.h>

#include <stddef.h>

typedef struct {
    size_t rows;     /* rows 1 to `rows` are known; 0: none */
    size_t width;    /* how many numbers a row has: the forces, d velocities, d accelerations, the multipliers, d
                        positions */
    double *numbers; /* owned; NULL if there are none */
} fvi_short_rows;

/* fvi_short_rows_start -- compute the rows for an observer whose forces have begun.
 *
 * No rows are computed if none are needed, or if fvi_variable_step refuses the run. Three kinds of runs have none
 * either: runs by lda and Euler's methods, runs of more than 200 unknowns of matrices, and runs of more than 12
 * coordinates whose potential has no narrow band. If a callback fails, or if more than 1000 steps are needed, the rows
 * end there.
 *
 * Accuracy: the error of x allowed in each step is 1e-10 of the distance that x moves in the first step of the run, or
 * up to 1e-6 of it if an order is near 2; seen 1e-7 of the forces. Cost: mostly 20 to 100 steps; 0.1 ms to 0.4 ms for
 * one mass and one damper, 0.2 s for 100 unknowns of matrices (seen). Returns FVI_SUCCESS or FVI_ENOMEM.
 * fvi_short_rows_copy -- make a copy. Returns FVI_SUCCESS or FVI_ENOMEM.
 * fvi_short_rows_free -- free the memory. */
int fvi_short_rows_start(fvi_observer *o, const fvi_stepper *s);
int fvi_short_rows_copy(const fvi_short_rows *from, fvi_short_rows *to);
void fvi_short_rows_free(fvi_short_rows *o);

/* fvi_short_row -- row k, from 1; NULL if it is not known. */
static inline const double *fvi_short_row(const fvi_short_rows *o, size_t k)
{
    return k >= 1 && k <= o->rows ? o->numbers + (k - 1) * o->width : NULL;
}

#endif
