/* src/fvi/exact_solution.h -- The linear problem, solved exactly.    [H 11] */
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
 *   c        stiffness, finite, >= 0 (0: a free particle)
 *   rho      damping, finite, >= 0
 *   alpha    0 <= alpha <= 1
 *   past     on what D acts (past.h); zeroed: on x - x0
 *   x0, v0   start, finite. Riemann-Liouville with x0 != 0 has a solution for
 *            alpha < 1/2 only, and for alpha = 1/2 where D^1 means d/dt
 *   forcing  which F
 *   A        its size, finite       (read for STEP and COSINE)
 *   T        finite, >= 0           (read for STEP)
 *   w        finite                 (read for COSINE)
 *   law      NULL; or C(D) in place of D^{2 alpha} (damping_laws.h), on x - x0: alpha is
 *            not read then, and the past is HELD
 *
 * What is left out of an initialiser is zero and does nothing. */
typedef struct {
    double m, c, rho, alpha;
    fvi_initial_history past;
    double x0, v0;
    fvi_forcing forcing;
    double A, T, w;
    const fvi_kernel *law;
} fvi_linear_oscillator;

/* fvi_exact_at -- the solution at n times.                    [(11.7), (11.10)]
 *
 *   problem  as above
 *   n        number of times, n >= 1
 *   t        n times, finite, >= 0, in any order
 *   x, v     outputs, n numbers each, x(t[i]) and x'(t[i]); one of them may be
 *            NULL, one of them may be t
 *
 * At t = 0 the start is returned (x' jumps there to m v0 / (m + rho) if
 * alpha = 1 and the past is not Caputo's).
 * Residues of the complex poles and a contour integral around the rest of the
 * singularities. Accuracy: the error of x is at most 4e-14 max|x|, that of x'
 * at most 4e-14 (max|x'| + max|x| / t), the maxima over [0, t], for all m, c,
 * rho, alpha, while w t < 10^8 for every frequency w there is (a double pole on
 * the cut and resonance included). Seen: 1e-15. Near t = 0 also relative to x.
 * Cost: O(1) a time, a sum over at most 160 nodes that are computed once; no sum
 * where rho = 0 or 2 alpha is an integer and the formula closes.
 * With a law that is not one power: poles by (26.11), 1 ms; the sum has up to 288 nodes
 * and a C(s) in each. There the errors are at most 2e-13 + 4 u w t of the same, u = 2^-53,
 * w the largest frequency there is (no proof; seen 4e-14).
 * Memory: 80 kB of stack.
 *
 * error says what is wrong, in the names of fvi_linear_oscillator or "t", "h", "n"; NULL is allowed.
 * Returns FVI_SUCCESS; FVI_EFAULT if problem or t is NULL, or x and v both are;
 * FVI_EINVAL if n == 0 or forcing is unknown; FVI_EDOM if a number is out of its
 * range, or for Riemann-Liouville with x0 != 0, rho > 0 and alpha > 1/2. On
 * these errors x and v are untouched, and on those of a law: what fvi_kernel_check returns;
 * FVI_EUNSUP for another past, and for more than three zeros of (26.11), which a sum of
 * three ZENERs with alpha > 1/2 may have; FVI_EMAXITER if they were not found.
 * FVI_EOVRFLW if x or x' is not finite, also if only the other one is asked for, and
 * FVI_ELOSS if the body has swung so often, w t above 8e17, that twice the digits of a
 * double do not hold the phase (not where the swing has died away): the values before it
 * stand. */
int fvi_exact_at(const fvi_linear_oscillator *problem, size_t n, const double *t, double *x,
                 double *v, fvi_error *error);

/* fvi_exact_grid -- the solution at t_k, the doubles nearest to k h, k = 0, ..., n.
 *                                                          [(11.15) to (11.19)]
 *
 *   problem    as above
 *   h          > 0, finite, as n h is
 *   n          n >= 1
 *   tolerance  in [0, 1): the error of x is at most the larger of this and 7e-14, times max|x|
 *              over [0, n h]; that of x' at t times max|x'| + max|x| / t. 0: as fvi_exact_at
 *   x, v       outputs, n + 1 numbers each, x and x' at t_k; one of them may be NULL
 *
 * Accuracy: no proof; 0.7 of the tolerance was seen in 26 000 random problems, and at 0
 * 1e-14, where the bound is a count of roundings. With a law that is not one power: what
 * fvi_exact_at promises, or the tolerance, the larger.
 * Cost: some microseconds a window, of times up to a factor of 100, and then 4 operations
 * a node, row and output, and for a law its poles, as there; 80 rows took as long as one to
 * five times of fvi_exact_at. Row by row, as there, goes what is out of range: c t^2 / m > 10^70
 * for one.
 * Memory: 80 kB of stack, and 352 bytes a node, by (11.16) at most 350 of them, with a law 620.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if problem is NULL, or x and v both are; FVI_EINVAL if
 * n == 0; FVI_EDOM if h or tolerance is out of its range; and as fvi_exact_at for the problem.
 * On these errors x and v are untouched. FVI_ENOMEM: they then hold nothing of use.
 * FVI_EOVRFLW, here for what is asked for, and FVI_ELOSS as fvi_exact_at: the values before it
 * stand, and then come NaNs. */
int fvi_exact_grid(const fvi_linear_oscillator *problem, double h, size_t n,
                   double tolerance, double *x, double *v,
                 fvi_error *error);

/* fvi_exact_oscillation -- the part 2 Re(a e^{s t}) of the solution.  [(11.7)]
 *
 * Only the two complex poles s, conj(s) of the equation; of a law all those of (26.11).
 * What is left, after the answer A Re(e^{iwt} / Q(iw)) to a cosine is also taken away, is
 * the integral along the branch cut: the tail. Arguments, errors: as fvi_exact_at;
 * also FVI_EDOM if there are no complex poles (see fvi_exact_pole). */
int fvi_exact_oscillation(const fvi_linear_oscillator *problem, size_t n, const double *t,
                          double *x, double *v,
                 fvi_error *error);

/* fvi_exact_pole -- s = re + i im with m s^2 + c + rho s^{2 alpha} = 0, the only
 * such number with 0 < arg s < pi; -re is the rate of decay.         [(11.4)]
 * Of a law the one that decays most slowly, with arg s <= 2.95.      [(26.11)]
 *
 *   re, im  outputs, one number each
 *
 * Accuracy: nearest doubles but for some units of roundoff of |re|.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL, FVI_EDOM as
 * fvi_exact_at for the problem; FVI_EDOM if there is none: alpha = 1/2 and
 * rho >= 2 sqrt(m c), or c = 0 and alpha >= 1/2, or c = rho = 0. On error re and
 * im are untouched. */
int fvi_exact_pole(const fvi_linear_oscillator *problem, double *re, double *im,
                 fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
