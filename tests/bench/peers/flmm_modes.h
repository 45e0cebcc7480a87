/* tests/bench/peers/flmm_modes.h -- The trapezoidal FLMM by exponentials. [H 18] */
#ifndef FLMM_MODES_H
#define FLMM_MODES_H

#include <stddef.h>

/* flmm_modes -- sum_{j=1}^{n-1} w_{n-j} u_j for n = 1, 2, ..., N by sums of powers r^n, where w_n are the
 * weights of ((1 + z) / (2 (1 - z)))^gamma, 0 < gamma < 2.
 *
 *   tolerance  about the error of a weight, divided by w_0
 *
 * flmm_modes_alloc returns NULL if there is no memory. */
typedef struct flmm_modes flmm_modes;
flmm_modes *flmm_modes_alloc(double gamma, size_t N, double tolerance);
void flmm_modes_free(flmm_modes *o);

/* flmm_modes_sum -- return the sum for the next n. flmm_modes_push hands over u_n afterwards. */
double flmm_modes_sum(const flmm_modes *o);
void flmm_modes_push(flmm_modes *o, double u);

#endif
