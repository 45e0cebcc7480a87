/* src/fvi/exact_solution.h -- The exact motion of one linear oscillator.    [H 11]
 *
 *     const fvi_linear_oscillator problem = { .m = 1, .c = 1, .rho = 0.2, .alpha = 0.3, .x0 = 1 };
 *     const double t = 10;
 *     double x;
 *     status = fvi_exact_at(&problem, 1, &t, &x, NULL, &error);
 *
 * The solution is the part of the two complex poles and an integral around the branch cut. For several masses see
 * exact_motion.h. */
#ifndef FVI_EXACT_SOLUTION_H
#define FVI_EXACT_SOLUTION_H

#include "error.h"
#include "damping_laws.h"
#include "past.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

typedef enum {
    FVI_FORCING_NONE,
    FVI_FORCING_STEP,  /* F = A for 0 <= t <= T, then 0 */
    FVI_FORCING_COSINE /* F = A cos(w t) */
} fvi_forcing;

/* fvi_linear_oscillator -- one linear problem in one dimension.               [(11.1)]
 *
 *     m x'' + c x + rho D^{2 alpha} x = F(t),   x(0) = x0,  x'(0) = v0
 *
 *   m        mass, finite, > 0 and not subnormal
 *   c        stiffness, finite, >= 0; 0: a free particle
 *   rho      damping, finite, >= 0
 *   alpha    0 <= alpha <= 1
 *   past     on what D acts (past.h); zeroed: on x - x0
 *   x0, v0   start, finite. RIEMANN_LIOUVILLE with x0 != 0 and rho > 0 has a solution for alpha <= 1/2 only. At
 *            alpha = 1/2 D^1 means d/dt
 *   forcing  which F
 *   A        the size of F, finite  (read for STEP and COSINE)
 *   T        finite, >= 0           (read for STEP)
 *   w        finite                 (read for COSINE)
 *   law      NULL; or a law C(D) in the place of D^{2 alpha} (damping_laws.h), which acts on x - x0. Then alpha is not
 *            read, and the past is HELD, or CAPUTO if no order is above 1
 *
 * What an initialiser leaves out is zero and does nothing. */
typedef struct {
    double m, c, rho, alpha;
    fvi_initial_history past;
    double x0, v0;
    fvi_forcing forcing;
    double A, T, w;
    const fvi_kernel *law;
} fvi_linear_oscillator;

/* fvi_exact_at -- compute the solution at n times.                    [(11.7), (11.10)]
 *
 *   problem  see above
 *   n        number of times, n >= 1
 *   t        n times, finite, >= 0, in any order
 *   x, v     outputs, n numbers each, owned by the caller: x(t[i]) and x'(t[i]). One of them may be NULL, one may be t
 *   error    output or NULL: what is wrong. The field is a member of fvi_linear_oscillator, or "problem", "t", "h", "n"
 *
 * At t = 0 the start is returned. (If alpha = 1 and the past is not CAPUTO, x' jumps there to m v0 / (m + rho).)
 * Method: residues of the complex poles, and a contour integral around all other singularities. Accuracy: the error of
 * x is at most 4e-14 max|x|, and the error of x' at most 4e-14 (max|x'| + max|x| / t), with the maxima over [0, t], for
 * all m, c, rho, alpha, while w t < 10^8 for every frequency w of the problem, including a double pole on the cut and
 * resonance. Seen: 1e-15. Near t = 0 the error of x is also small relative to x.
 * Cost: O(1) for each time, a sum over at most 160 nodes that are computed once; no sum where rho = 0, or where 2 alpha
 * is an integer and a closed formula exists.
 * With a law that is not one power: the poles are found by (26.11) in 1 ms, and the sum has up to 288 nodes, each with
 * a C(s). The errors are then at most 2e-13 + 4 u w t of the same maxima, u = 2^-53, w the largest frequency (no proof;
 * seen 4e-14). Memory: 80 kB of stack.
 *
 * Returns FVI_SUCCESS; or
 *   FVI_EFAULT    problem or t is NULL, or x and v both are
 *   FVI_EINVAL    n == 0, or forcing or past is unknown
 *   FVI_EDOM      a number is out of its range; RIEMANN_LIOUVILLE with x0 != 0, rho > 0 and alpha > 1/2
 *   FVI_EUNSUP    a law with another past than above, or with more than three zeros of (26.11), which a sum of three
 *                 ZENERs with alpha > 1/2 may have
 *   FVI_EMAXITER  the zeros of (26.11) were not found
 *   FVI_EOVRFLW   x or x' is not finite, also if it is not wanted
 *   FVI_ELOSS     the body has swung so often, w t above 8e17, that twice the digits of a double do not hold the phase.
 *                 This is no error where the oscillation has died away
 *   what fvi_kernel_check returns for a law, or the interrupter (error.h)
 * After FVI_EOVRFLW, FVI_ELOSS and the number of the interrupter the values before that time stand. After any other
 * error x and v are untouched. */
int fvi_exact_at(const fvi_linear_oscillator *problem, size_t n, const double *t, double *x,
                 double *v, fvi_error *error);

/* fvi_exact_grid -- compute the solution at t_k, the doubles nearest to k h, k = 0, ..., n. Many rows take much less
 * time than with fvi_exact_at.
 *                                                          [(11.15) to (11.19)]
 *
 *   problem    see above
 *   h          > 0, finite; n h must be finite, too
 *   n          n >= 1
 *   tolerance  in [0, 1): the error of x is at most the larger of tolerance and 7e-14, times max|x| over [0, n h]. The
 *              error of x' at t is at most the same number times max|x'| + max|x| / t. 0: as accurate as fvi_exact_at
 *   x, v       outputs, n + 1 numbers each, owned by the caller: x and x' at t_k. One of them may be NULL
 *   error      as for fvi_exact_at
 *
 *     static double x[100001];
 *     status = fvi_exact_grid(&problem, 0.01, 100000, 0, x, NULL, &error);
 *
 * Accuracy: no proof; 0.7 of the tolerance was seen in 26,000 random problems, and 1e-14 at tolerance 0, where the
 * bound counts rounding errors. With a law that is not one power: the larger of the tolerance and what fvi_exact_at
 * promises.
 * Cost: some microseconds for each window, a range of times up to a factor of 100; then 4 operations for each node, row
 * and output; with a law also its poles, as for fvi_exact_at. 80 rows took as long as one to five times of
 * fvi_exact_at. A problem whose numbers are out of range, for example c t^2 / m > 10^70, is computed row by row as in
 * fvi_exact_at. Memory: 80 kB of stack, and 352 bytes for each node, at most 350 nodes by (11.16), or 620 with a law.
 *
 * Returns FVI_SUCCESS; or
 *   FVI_EFAULT    problem is NULL, or x and v both are
 *   FVI_EINVAL    n == 0
 *   FVI_EDOM      h or tolerance is out of its range
 *   FVI_EOVRFLW   an output that is wanted is not finite
 *   FVI_ELOSS     as for fvi_exact_at
 *   FVI_ENOMEM
 *   what fvi_exact_at returns for the problem
 * After FVI_EOVRFLW and FVI_ELOSS the values before the wrong time stand, and all others are NaN. After FVI_ENOMEM and
 * the number of the interrupter (error.h) x and v are of no use. After any other error they are untouched. */
int fvi_exact_grid(const fvi_linear_oscillator *problem, double h, size_t n,
                   double tolerance, double *x, double *v,
                 fvi_error *error);

/* fvi_exact_oscillation -- compute the part 2 Re(a e^{s t}) of the solution, a decaying oscillation.  [(11.7)]
 *
 * It belongs to the two complex poles s and conj(s) of the equation; with a law to all poles of (26.11). Take it away
 * from the solution, and for a cosine also the steady answer A Re(e^{iwt} / Q(iw)). What is left is the integral along
 * the branch cut: the tail.
 *
 *     status = fvi_exact_oscillation(&problem, 1, &t, &swing, NULL, &error);
 *     tail = x - swing;
 *
 * Arguments and errors are those of fvi_exact_at; also FVI_EDOM if there are no complex poles (see fvi_exact_pole). */
int fvi_exact_oscillation(const fvi_linear_oscillator *problem, size_t n, const double *t,
                          double *x, double *v,
                 fvi_error *error);

/* fvi_exact_pole -- compute the pole s = re + i im of the oscillation, with m s^2 + c + rho s^{2 alpha} = 0. It is the
 * only such number with 0 < arg s < pi, and -re is its rate of decay.         [(11.4)]
 *
 * With a law: the pole that decays most slowly, with arg s <= 2.95.      [(26.11)]
 *
 *   re, im  outputs, one number each
 *   error   as for fvi_exact_at
 *
 *     const fvi_linear_oscillator spring = { .m = 1, .c = 4 };
 *     status = fvi_exact_pole(&spring, &re, &im, NULL);   // re = 0, im = 2
 *
 * Accuracy: the nearest doubles, except for some units of roundoff of |re|.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; what fvi_exact_at returns for the problem; FVI_EDOM if there is
 * no such pole: alpha = 1/2 and rho >= 2 sqrt(m c), or c = 0 and alpha >= 1/2, or c = rho = 0. On error re and im are
 * untouched. */
int fvi_exact_pole(const fvi_linear_oscillator *problem, double *re, double *im,
                 fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
