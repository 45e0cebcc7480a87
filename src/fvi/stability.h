/* src/fvi/stability.h -- Is this step stable?                       [H 14] */
#ifndef FVI_STABILITY_H
#define FVI_STABILITY_H

#include "trajectory.h"

#include <gsl/gsl_math.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_stability_number -- how much of the stable range a run takes.   [(14.3)]
 *
 *     load = lambda / 4,  lambda = the largest eigenvalue of
 *         M^{-1/2} ((1 - 2 kappa)^2 h^2 K + share 4^alpha h^(2 - 2 alpha) rho) M^{-1/2}
 *
 * with K = Hess U(x0) and, by method,
 *
 *     share = 1                     fvi, lda, variational (rho = 0)
 *             1 - 2 alpha           fvi-shifted (load 0 if negative) [(13.14)]
 *             4^alpha               fvi-bdf2
 *
 * They are stable if load < 1, and have a growing, sign-alternating mode if load > 1;
 * this is exact if U is quadratic and convex, and speaks of small motions about x0
 * if not. In one dimension: (W (1 - 2 kappa)^2 + share 4^alpha R) / 4,
 * W = h^2 c / m, R = rho h^(2 - 2 alpha) / m. The load of fvi-lobatto2 to 8 is
 * that of fvi_stability_lobatto, with its cost, accuracy and errors; that of
 * fvi-lobatto2d to 8d, fvi-stable and euler-implicit is 0 (17.28). That of
 * euler-explicit is (14.8),
 *
 *     load = h max |s|^2 / (-2 Re s)     over the s with det(s^2 M + s rho + K) = 0 that
 *                                        are not 0, and not real and positive;
 *
 * it is GSL_POSINF if such an s is imaginary: undamped motions grow at every step. In one
 * dimension, a = rho h / m and b = h^2 c / m, load <= 1 is b <= a and 2 a - b <= 4. Of
 * fvi-adaptive none is known here.
 *
 *   method  its load, alpha_least and alpha_most are read
 *   run     system, x0, h, kappa, alpha are read; the rest may be anything
 *   load    output, >= 0 if K is positive semidefinite
 *
 * With matrices (system.h) the load of the methods that take them is a lower bound, within
 * some percent, by 64 products with K and C and solutions with M; FVI_EUNSUP for
 * fvi-shifted with alpha > 1/2 and kappa other than 1/2.
 *
 * Cost O(d) if the Hessian has one or two diagonals, by bisection, or if kappa = 1/2
 * or U = 0; else O(d^3) by GSL's symmetric eigenvalues.
 * Accuracy: 8 d u relative to the larger term, u = 2^-53. euler-explicit: 8 u where the
 * Hessian has one diagonal, or d = 1, and rho^2 and 4 m c are normal; else the eigenvalues
 * of a matrix of 2 d rows, s that are off by some d u of the largest (no proof), so that
 * -Re s below 1e-13 of that counts as 0, and |s| below 1e-7 of it as a body at rest.
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer is
 * NULL; FVI_EDOM if h, kappa or alpha is out of range, or the method does not know
 * this alpha; FVI_EUNSUP if method->load is NULL, or the method
 * does not take run->law, or for euler-explicit and more than 64 masses with springs
 * between them; FVI_EOVRFLW if an entry is not finite; FVI_ENOMEM; what the Hessian
 * returned. On error *load is untouched. */
int fvi_stability_number(const fvi_method *method, const fvi_run *run,
                       double *load);

/* fvi_stability_longest_step -- the largest stable step: the h of load = 1.  [(14.4)]
 *
 *   method  as above, with load_grows: all but fvi-adaptive, fvi-lobatto3 to 8
 *   run  as above; its h is not read
 *   h    output: finite > 0; GSL_POSINF if every step is stable; 0 if none above 2^-500
 *        is (alpha = 1, or very near, and strong damping; euler-explicit and a motion
 *        without any)
 *
 * Bisection of log2 h to 2^-51 max(1, |log2 h|), about 60 loads and one Hessian; a
 * load's own rounding, 8 d u, moves h by 8 d u / (2 - 2 alpha) of it (fvi-lobatto2:
 * 1e-12 takes the place of 8 d u). With matrices to 2^-12, 22 loads: h is too long by
 * what the load is too small, some percent (h^2 to h^(2 - 2 alpha) grow as the load does). A load that overflows on the way is one above 1, and
 * yet told to the error handler. Errors as above, and FVI_EUNSUP if the load of the
 * method may fall while h grows. On error *h is untouched. */
int fvi_stability_longest_step(const fvi_method *method, const fvi_run *run, double *h);

/* fvi_stability_along_run -- the load where a run has come to, if it is stiffer there than it
 * was: U is not quadratic.                                               [(14.6)]
 *
 *   method  as for fvi_stability_number; run  as there, but for x0, which is not read
 *   x         d numbers: small motions about x are what is asked about
 *   stiffest  in: the largest max_i sum_j |U_ij| / m_i so far, 0 at first; out: that at x,
 *             where it is more than 1.05 times as much
 *   load      output: the load at x, if *stiffest has changed; else 0
 *
 * Cost: a Hessian, and where it is stiffer a load: along a run whose stiffness grows by a
 * factor q, ln q / ln 1.05 of them at most. Errors as fvi_stability_number; on error both
 * are untouched. */
int fvi_stability_along_run(const fvi_method *method, const fvi_run *run,
                        const double *x, double *stiffest, double *load);

/* fvi_stability_lobatto -- the same for form M of H 17. [(17.18)]
 *
 * load > 1: at least one mode grows, and load <= 1: none does, for a quadratic
 * convex U in one dimension. For s = 2 both are proved, and in R^d: there
 *
 *     load = lambda / 4 of the matrix of (14.3) with 1 for (1 - 2 kappa)^2 and the
 *            number of (17.16) for 4^alpha,  0 if that is negative.
 *
 * With a law (26.13) is in the place of (17.16); both are proved for s = 2 and laws whose
 * fractions have 2 alpha <= 1. For s >= 3 load > 1 is proved to be a growing mode; that there is none
 * otherwise is measured, W and R up to 1000; for s >= 5, W up to 10^4 and R up to 30.
 * The stable steps are then not always an interval: where the load first passes 1 it is
 * continuous, further on it jumps.
 * In R^d, s >= 3: exact where M^{-1} K and M^{-1} rho commute, an estimate
 * elsewhere. K = Hess U(x0): small motions about x0 if U is not quadratic.
 *
 *   stages  s = 2, ..., 8
 *   run     system, x0, h, and law or alpha are read; the rest may be anything
 *   load    output, >= 0
 *
 * Cost: O(s^5), 17 us for s = 4, 170 us for s = 8, and O(d^3); O(d s^3) without U.
 * Accuracy 1e-12 max(1, load) (no proof; seen 4e-15 for s <= 4, 4e-14 for s = 8).
 * Returns FVI_SUCCESS; what fvi_system_check returns;
 * FVI_EFAULT if a pointer is NULL; FVI_EINVAL if s is another number; FVI_EDOM if h
 * or alpha is out of range; what fvi_kernel_check returns; FVI_EOVRFLW if W or R is not finite; FVI_ENOMEM;
 * FVI_EMAXITER if eigenvalues were not found; what the Hessian returned. On error
 * *load is untouched. */
int fvi_stability_lobatto(size_t stages, const fvi_run *run, double *load);

/* fvi_unstable_roots -- how many solutions z^{-k} of the scalar recurrence grow:
 * the zeros in |z| < 1 of Q(z) = z P(z),                            [(14.2)]
 *
 *     P(z) = (1 + kappa (1 - kappa) W) (1/z - 2 + z) + W + R (1 - z)^{2 alpha},
 *
 * counted by the argument principle along |z| = 1.
 *
 *   alpha, kappa  in [0, 1]
 *   W, R          finite, > 0
 *   modes         output
 *
 * Not for values on the boundary, where P vanishes on the circle. Cost: some
 * thousand values of P. Returns FVI_SUCCESS; FVI_EFAULT if the output is NULL;
 * FVI_EDOM if a number is out of range. */
int fvi_unstable_roots(double alpha, double kappa, double W, double R,
                       int *modes);

/* fvi_amplification -- the factor 1/|z| by which the unstable mode grows in a step, 1
 * if there is none. Arguments as fvi_unstable_roots.               [(14.5)]
 * Cost and accuracy as fvi_amplification_of_kernel. Returns FVI_SUCCESS; FVI_EFAULT and
 * FVI_EDOM as fvi_unstable_roots; FVI_ENOMEM. */
int fvi_amplification(double alpha, double kappa, double W, double R, double *growth);

/* fvi_amplification_of_kernel -- the same for any symbol, with Q(0) > 0 on (end, 0) and
 * one change of sign there if Q(end) < 0.                          [(14.5)]
 *
 *   Q       Q(z) = z P(z) for real z
 *   end     -1, or just inside where Q is infinite at -1
 *   growth  output: 1/|z| at the zero, 1 if Q(end) >= 0
 *
 * By GSL's Brent solver, to 8 ulp of z. Returns FVI_SUCCESS; FVI_ENOMEM;
 * FVI_EBADFUNC if Q is not finite; FVI_EINVAL if Q(0) < 0. On error *growth is
 * untouched. */
int fvi_amplification_of_kernel(gsl_function Q, double end, double *growth);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
