/* tests/bench/peers/flmm_modes.h -- The trapezoidal FLMM by exponentials. [H 18] */
#ifndef FLMM_MODES_H
#define FLMM_MODES_H

#include <stddef.h>

/* flmm_modes -- sum_{j=1}^{n-1} w_{n-j} u_j for n = 1, 2, ..., N, the weights those of
 * ((1 + z) / (2 (1 - z)))^gamma, 0 < gamma < 2, by sums of powers r^n.
 *
 *   tolerance  about what is left out of a weight, against w_0
 *
 * flmm_modes_alloc returns NULL if there is no memory. */
typedef struct flmm_modes flmm_modes;
flmm_modes *flmm_modes_alloc(double gamma, size_t N, double tolerance);
void flmm_modes_free(flmm_modes *o);

/* flmm_modes_sum -- the sum for the next n. flmm_modes_push gives u_n afterwards. */
double flmm_modes_sum(const flmm_modes *o);
void flmm_modes_push(flmm_modes *o, double u);

#endif
