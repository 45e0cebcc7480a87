/* src/stages/variable_loops.h -- The two loops over the modes of variable steps; s is 6 or 8.
 *                                                                     [H 22] */
#ifndef FVI_VARIABLE_LOOPS_H
#define FVI_VARIABLE_LOOPS_H

#include "variable_table.h"

/* What a step tells the modes: u and ds of (22.6), (22.7); and, for modes that sleep, the
 * velocity before it. */
typedef struct {
    double u[FVI_LANES], ds, before;
} fvi_last_step;

/* fvi_loop_gather -- H_i = sum_q weight_q a_i(mu_q) y_q, and 0 for i >= s.     [(22.10)]
 * Q is a multiple of 4; H has FVI_LANES numbers. */
void fvi_loop_gather(size_t s, size_t Q, const double *weight, const double *y,
                     const fvi_mode_row *row, double *H);

/* fvi_loop_advance -- y_q += mu_q a(mu_q).u + ds - p_q y_q, n of them, a multiple of 4. */
void fvi_loop_advance(size_t s, size_t n, const fvi_mode_row *row,
                      const fvi_last_step *last, double *y);

#endif
