/* src/fvi/past.h -- The initial history: what the body did before t = 0.                   [H 19]
 *
 * A damping with memory depends on the motion before t = 0. Every initial history of this header is Caputo's damping
 * plus a force that decays with time and is known beforehand:
 *
 *     rho D^{2 alpha} x = rho D_C^{2 alpha} x + rho A t^e / Gamma(1 + e),                   (19.3)
 *     e = -2 alpha if 2 alpha < 1,   1 - 2 alpha if 2 alpha > 1.
 *
 * We call the last term of (19.3) the **force of the initial history**. For example, a body that was held and starts
 * with the velocity v0 = 1 has A = 1 for alpha = 3/4, and the force is rho t^(-1/2) / sqrt(pi). */
#ifndef FVI_PAST_H
#define FVI_PAST_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_initial_history -- the past, and the function of time on which the derivative of the damping acts.  [(19.1)]
 *
 *   HELD    The body rested at x0 until t = 0, when it got the momentum p0. The derivative acts on x - x0.
 *   CAPUTO  The body came along the straight line of its start, and the memory ignores this line. The derivative
 *           acts on x - x0, or on x - x0 - t v0 where 2 alpha > 1.
 *   RIEMANN_LIOUVILLE  The body rested at 0 until t = 0, when it was put at x0. The derivative acts on x. For
 *           alpha = 1/2, D^1 is d/dt. */
typedef enum {
    FVI_INITIAL_HISTORY_HELD,
    FVI_INITIAL_HISTORY_CAPUTO,
    FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
} fvi_initial_history;

/* fvi_initial_history_solvable -- Return 0 if no motion with a finite velocity starts at x0, else 1.     [(19.2)]
 *
 * There is none for RIEMANN_LIOUVILLE with rho > 0, x0 != 0 and alpha > 1/2. The arguments are those of one
 * coordinate. */
int fvi_initial_history_solvable(fvi_initial_history past, double alpha, double rho, double x0);

/* fvi_initial_history_amplitude -- Return A of (19.3) for one coordinate.
 *
 * It is v0 for HELD and RIEMANN_LIOUVILLE with 2 alpha > 1, x0 for RIEMANN_LIOUVILLE with 2 alpha < 1, and 0 in all
 * other cases. The start must have a solution (fvi_initial_history_solvable). */
double fvi_initial_history_amplitude(fvi_initial_history past, double alpha, double x0, double v0);

/* fvi_initial_history_acts -- Return 1 if the past has a force of the initial history at all: if A of (19.3) is not
 * zero for x0 = v0 = 1. Else return 0. */
int fvi_initial_history_acts(fvi_initial_history past, double alpha);

/* fvi_kernel_impulse -- numbers for the impulses of the force of the initial history; prepared once for each run. */
enum { FVI_KERNEL_IMPULSE_NODES = 8, FVI_KERNEL_IMPULSE_TERMS = 37 };
typedef struct {
    double e;    /* the exponent of (19.3) */
    double size; /* 1 / Gamma(1 + e) */
    double series[FVI_KERNEL_IMPULSE_TERMS]
                 [FVI_KERNEL_IMPULSE_NODES / 2];            /* of the moments of step k > 0 */
    size_t nodes;                                 /* the number n of nodes */
    double first[FVI_KERNEL_IMPULSE_NODES];                 /* the impulses of step 0 */
    double basis[FVI_KERNEL_IMPULSE_NODES][FVI_KERNEL_IMPULSE_NODES]; /* l_i in P_degree(2 s - 1), at [degree][i] */
} fvi_kernel_impulse;

/* fvi_kernel_impulse_prepare -- Prepare the impulses for one order and for the nodes of one method.
 *
 *   alpha  0 <= alpha <= 1, not 1/2
 *   n, c   2 <= n <= FVI_KERNEL_IMPULSE_NODES nodes in [0, 1], all different
 *   table  output
 *
 *     const double ends[] = { 0, 1 };
 *     fvi_kernel_impulse prepared;
 *     fvi_kernel_impulse_prepare(0.75, 2, ends, &prepared);
 *
 * Nothing is checked. Cost O(n^3). */
void fvi_kernel_impulse_prepare(double alpha, size_t n, const double *c,
                      fvi_kernel_impulse *table);

/* fvi_kernel_impulses -- Compute the shares b_i of the nodes of step k in the impulse of this force.     [(19.5)]
 *
 *     b_i = int_0^1 l_i(s) (k + s)^e / Gamma(1 + e) ds,   i = 1, ..., n,
 *
 * where l_i are Lagrange's polynomials on the nodes. The impulse at node i is rho A h^{1 + e} b_i. For alpha = 1 the
 * force is one impulse at t = 0. With c_1 = 0 step 0 then has the shares 1, 0, ..., 0, and every later step has
 * zeros.
 *
 *   k        the step, >= 0
 *   impulse  output, n numbers
 *
 * Accuracy: 16 u of the sum of the shares, u = 2^-53; the largest error seen on Lobatto nodes is 5.5 u. Cost: one
 * power, and from 3 (k > 2 10^5) to 36 (k = 1) terms of a series. */
void fvi_kernel_impulses(const fvi_kernel_impulse *table, size_t k, double *impulse);

/* fvi_kernel_impulses_by_order -- Compute the derivatives of these shares by the exponent e = table->e.  [(23.12)]
 *
 *   k     the step, >= 0
 *   rate  output, n numbers
 *
 * Accuracy: of the order of u (1 + ln(1 + k)) of the sum of the shares (not proved). */
void fvi_kernel_impulses_by_order(const fvi_kernel_impulse *table, size_t k, double *rate);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
