/* src/stages/variable_loops.h -- The two loops over the modes of variable steps; s is 6 or 8.    [H 22] */
#ifndef FVI_VARIABLE_LOOPS_H
#define FVI_VARIABLE_LOOPS_H

#include "variable_table.h"

/* The input of the modes from one step: u and ds of (22.6) and (22.7), and the velocity before the step, for modes that
 * are inactive. */
typedef struct {
    double u[FVI_LANES], ds, before;
} fvi_last_step;

/* fvi_loop_gather -- Compute H_i = sum_q weight_q a_i(mu_q) y_q for i < s, and H_i = 0 for s <= i < FVI_LANES. Q is a
 * multiple of 4. [(22.10)] */
void fvi_loop_gather(size_t s, size_t Q, const double *weight, const double *y,
                     const fvi_mode_row *row, double *H);

/* fvi_loop_advance -- Compute y_q += mu_q a(mu_q).u + ds - p_q y_q for n modes, a multiple of 4. */
void fvi_loop_advance(size_t s, size_t n, const fvi_mode_row *row,
                      const fvi_last_step *last, double *y);

#endif
