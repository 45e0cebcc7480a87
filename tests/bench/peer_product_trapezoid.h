/* tests/bench/peer_product_trapezoid.h -- The method that ours are measured against.
 *                                                               [Chapter 18] */
#ifndef PEER_PRODUCT_TRAPEZOID_H
#define PEER_PRODUCT_TRAPEZOID_H

#include <fvi/trajectory.h>

/* peer_product_trapezoid -- the implicit product-integration rule of order 2, with
 * blocked FFT convolutions.                                           [(18.4)]
 *
 * The equation of motion, Caputo, beta = 2 alpha, is integrated twice,
 *
 *     m (x - x0 - t v0) = J^2 (F - grad U(x)) - rho J^{2-beta} (x - s),
 *
 * s = x0, and x0 + t v0 if beta > 1, and both integrals are those of the piecewise
 * linear functions through the nodes: m and rho h^gamma/Gamma(gamma+2) times
 *
 *     c_n g_0 + sum_{j=1}^{n} a_{n-j} g_j,     gamma = 2 and 2 - beta,
 *     a_0 = 1,   a_k = (k+1)^(gamma+1) - 2 k^(gamma+1) + (k-1)^(gamma+1),
 *     c_n = (n-1)^(gamma+1) - n^gamma (n - gamma - 1).
 *
 * Each step is solved by Newton's method. Where F jumps it is the mean of both
 * limits, which keeps the order.
 *
 *   run  as for fvi_start, 0 < alpha < 1; the past is Caputo's whatever run->past
 *        says; kappa, memory, tolerance are not read
 *   x    output, (steps + 1) d positions
 *
 * Cost O(N log^2 N), memory O(N d).
 * Returns FVI_SUCCESS, FVI_ENOMEM, what the solver (newton.h) or a callback returned.
 * On error x is of no use. */
int peer_product_trapezoid(const fvi_run *run, double *x);

#endif
