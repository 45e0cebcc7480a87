/* tests/bench/peers/product_weights.h -- Weights of fractional integrals. [H 18] */
#ifndef PRODUCT_WEIGHTS_H
#define PRODUCT_WEIGHTS_H

#include <stddef.h>

typedef enum { PRODUCT, TRAPEZOIDAL, NEWTON_GREGORY, BDF2 } rule;

/* product_weights -- J^gamma u(n h) = h^gamma (start0_n u_0 + start1_n u_1
 *                                             + sum_{j=1}^{n} w_{n-j} u_j).
 *
 *   which   product trapezoid, or the fractional linear multistep method of this rule
 *   gamma   0 < gamma <= 2
 *   w, start0, start1  outputs, N + 1 numbers each; PRODUCT does not write start1 */
void product_weights(rule which, double gamma, size_t N, double *w, double *start0,
                     double *start1);

#endif
