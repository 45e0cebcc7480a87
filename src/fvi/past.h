/* src/fvi/past.h -- What the body did before t = 0.                  [H 19]
 *
 * A damping with memory has to know the past. All of them are Caputo's damping
 * and a pull that fades, known beforehand:
 *
 *     rho D^{2 alpha} x = rho D_C^{2 alpha} x + rho A t^e / Gamma(1 + e),   (19.3)
 *     e = -2 alpha if 2 alpha < 1,   1 - 2 alpha if 2 alpha > 1. */
#ifndef FVI_PAST_H
#define FVI_PAST_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_initial_history -- on what the memory acts.                             [(19.1)]
 *
 *   HELD    x - x0: the body rested at x0 until t = 0, when it got the momentum p0
 *   CAPUTO  x - x0, and x - x0 - t v0 where 2 alpha > 1: it came along the
 *           straight line of its start, at which the memory does not look
 *   RIEMANN_LIOUVILLE  x: it was at 0 until t = 0, when it was put at x0. For
 *           alpha = 1/2, D^1 is d/dt */
typedef enum {
    FVI_INITIAL_HISTORY_HELD,
    FVI_INITIAL_HISTORY_CAPUTO,
    FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
} fvi_initial_history;

/* fvi_initial_history_solvable -- 0 if no motion with a finite velocity starts there:
 * Riemann-Liouville, rho > 0, x0 != 0 and alpha > 1/2; else 1.      [(19.2)] */
int fvi_initial_history_solvable(fvi_initial_history past, double alpha, double rho, double x0);

/* fvi_initial_history_amplitude -- A of (19.3): v0 for HELD and RIEMANN_LIOUVILLE with
 * 2 alpha > 1, x0 for RIEMANN_LIOUVILLE with 2 alpha < 1, else 0. The start is one
 * that has a solution. */
double fvi_initial_history_amplitude(fvi_initial_history past, double alpha, double x0, double v0);

/* fvi_initial_history_acts -- 1 if A of (19.3) is not zero, but for starts at rest or at 0. */
int fvi_initial_history_acts(fvi_initial_history past, double alpha);

/* fvi_kernel_impulse -- the impulses of the pull, to be prepared once a run. */
enum { FVI_KERNEL_IMPULSE_NODES = 8, FVI_KERNEL_IMPULSE_TERMS = 37 };
typedef struct {
    double e;    /* its exponent */
    double size; /* 1 / Gamma(1 + e) */
    double series[FVI_KERNEL_IMPULSE_TERMS]
                 [FVI_KERNEL_IMPULSE_NODES / 2];            /* of its moments, k > 0 */
    size_t nodes;                                 /* n */
    double first[FVI_KERNEL_IMPULSE_NODES];                 /* the impulses of step 0 */
    double basis[FVI_KERNEL_IMPULSE_NODES][FVI_KERNEL_IMPULSE_NODES]; /* of P_degree(2 s - 1) in l_i, at [degree][i] */
} fvi_kernel_impulse;

/* fvi_kernel_impulse_prepare -- for one order and the nodes of one method.
 *
 *   alpha  0 <= alpha <= 1, not 1/2
 *   n, c   2 <= n <= FVI_KERNEL_IMPULSE_NODES nodes in [0, 1], all different
 *   pull   output
 *
 * Nothing is checked. */
void fvi_kernel_impulse_prepare(double alpha, size_t n, const double *c,
                      fvi_kernel_impulse *pull);

/* fvi_kernel_impulses -- what the pull gives to the nodes of step k.   [(19.5)]
 *
 *     b_i = int_0^1 l_i(s) (k + s)^e / Gamma(1 + e) ds,   i = 1, ..., n,
 *
 * l_i Lagrange's polynomials on the nodes; times rho A h^{1 + e} they are impulses.
 * For alpha = 1 the pull is one impulse at t = 0: 1, 0, ... and then zeros.
 *
 *   k        the step, >= 0
 *   impulse  output, n numbers
 *
 * Accuracy: 16 u of their sum; 5.5 u was the most on Lobatto's nodes. Cost: one
 * power, and from 3 (k > 2 10^5) to 36 (k = 1) terms of a series. */
void fvi_kernel_impulses(const fvi_kernel_impulse *pull, size_t k, double *impulse);

/* fvi_kernel_impulses_by_order -- their derivatives by the exponent e = pull->e.  [(23.12)]
 *
 *   k, rate  as k and impulse above
 *
 * Accuracy: of the order of u (1 + ln(1 + k)) of their sum; no proof. */
void fvi_kernel_impulses_by_order(const fvi_kernel_impulse *pull, size_t k, double *rate);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
