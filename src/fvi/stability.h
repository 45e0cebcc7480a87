/* src/fvi/stability.h -- The stability of a step: the load, the longest stable step, and the growth of unstable modes.
 *                                                                                                       [H 14]
 * The **load** of a step is a number: no mode grows from step to step if the load is below 1, and a mode grows if the
 * load is above 1. For example, fvi_fractional with kappa = 0 on an undamped spring has the load h^2 c / (4 m). */
#ifndef FVI_STABILITY_H
#define FVI_STABILITY_H

#include "trajectory.h"

#include <gsl/gsl_math.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_stability_number -- Compute the load of a step of a run.                                             [(14.3)]
 *
 *     load = lambda / 4,  lambda = the largest eigenvalue of
 *         M^{-1/2} ((1 - 2 kappa)^2 h^2 K + share 4^alpha h^(2 - 2 alpha) rho) M^{-1/2}
 *
 * with K = Hess U(x0) and, by method,
 *
 *     share = 1               fvi_fractional, fvi_lagrange_dalembert, fvi_midpoint_variational (rho = 0)
 *             1 - 2 alpha     fvi_cq2_shifted (a negative load counts as 0) [(13.14)]
 *             4^alpha         fvi_cq_bdf2
 *
 * These methods are stable if load < 1. If load > 1 they have a growing mode whose sign alternates. This is exact if U
 * is quadratic and convex; for any other U it holds for small motions about x0. In one dimension
 * load = (W (1 - 2 kappa)^2 + share 4^alpha R) / 4 with W = h^2 c / m and R = rho h^(2 - 2 alpha) / m.
 *
 * The loads of the other methods:
 *
 *   fvi_lobatto_m2 to fvi_lobatto_m8   that of fvi_stability_lobatto, with its cost, accuracy and errors
 *   fvi_lobatto_d2 to fvi_lobatto_d8, fvi_cq2_midpoint, fvi_euler_implicit   0 (17.28)
 *   fvi_euler_explicit   (14.8): load = h max |s|^2 / (-2 Re s) over the solutions s of det(s^2 M + s rho + K) = 0 that
 *             are not 0, and not real and positive. It is GSL_POSINF if such an s is imaginary, because undamped
 *             motions grow at every step. In one dimension, with a = rho h / m and b = h^2 c / m, load <= 1 means
 *             b <= a and 2 a - b <= 4
 *   fvi_variable_step    not known (FVI_EUNSUP)
 *
 *   method  stability_number, alpha_least, alpha_most and takes_laws are read
 *   run     system, x0, h, kappa, alpha and law are read; the other members may have any value
 *   load    output, >= 0 if K is positive semidefinite
 *
 *     double load;
 *     if (fvi_stability_number(&fvi_fractional, &run, &load) == FVI_SUCCESS && load > 1)
 *         puts("a mode of this run grows");
 *
 * With matrices (system.h) the load is a lower bound, within some percent. It takes 64 products with K and C, and 64
 * solutions with M.
 * Cost O(d) if the Hessian has one or two diagonals, by bisection, or if kappa = 1/2 or U = 0; else O(d^3) by GSL's
 * symmetric eigenvalues.
 * Accuracy: 8 d u relative to the larger term, u = 2^-53. For fvi_euler_explicit 8 u if the Hessian has one diagonal,
 * or d = 1, and rho^2 and 4 m c are normal numbers. Otherwise it takes the eigenvalues s of a matrix of 2 d rows, which
 * are off by some d u of the largest (not proved). So -Re s below 1e-13 of the largest counts as 0, and |s| below 1e-7
 * of the largest counts as a body at rest.
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer is NULL; FVI_EDOM if h, kappa or alpha is
 * out of range, or if the method does not take this alpha; FVI_EUNSUP if method->stability_number is NULL, if the
 * method does not take run->law, for a mechanism without matrices, for fvi_euler_explicit and more than 64 masses with
 * springs between them, and for fvi_cq2_shifted with matrices, alpha > 1/2 and kappa other than 1/2; FVI_EOVRFLW if an
 * entry is not finite; FVI_ENOMEM; what the Hessian returned. On error *load is untouched. */
int fvi_stability_number(const fvi_method *method, const fvi_run *run,
                       double *load);

/* fvi_stability_longest_step -- Compute the longest stable step: the h with load = 1.                     [(14.4)]
 *
 *   method  a method with stability_number_grows: all but fvi_variable_step and fvi_lobatto_m3 to fvi_lobatto_m8
 *   run     as above; its h is not read
 *   h       output: finite, > 0; GSL_POSINF if every step is stable; 0 if no step above 2^-500 is stable. That happens
 *           for strong damping with alpha = 1 or very near 1, and for fvi_euler_explicit without damping
 *
 * The function bisects log2 h to 2^-51 max(1, |log2 h|). Cost: about 60 loads and one Hessian. The rounding error of a
 * load, 8 d u, changes h by 8 d u / (2 - 2 alpha) of h (for fvi_lobatto_m2 read 1e-12 for 8 d u). With matrices the
 * function bisects to 2^-12, with 22 loads. Their load is too small by some percent. So h is too long by some
 * percent, because the load grows like a power of h between h^(2 - 2 alpha) and h^2. A load that overflows counts as a
 * load above 1, but the error handler is called for it. Returns as fvi_stability_number; FVI_EUNSUP, too, if the load
 * of the method may fall while h grows. On error *h is untouched. */
int fvi_stability_longest_step(const fvi_method *method, const fvi_run *run, double *h);

/* fvi_stability_along_run -- Compute the load at the place that a run has reached, if the system is stiffer there than
 * at all earlier places. This can happen if U is not quadratic.                                               [(14.6)]
 *
 *   method, run  as for fvi_stability_number; x0 of the run is not read
 *   x         d numbers: the load is that of small motions about x
 *   stiffest  in: the largest stiffness max_i sum_j |U_ij| / m_i so far, 0 at first; out: the stiffness at x, if it is
 *             more than 1.05 times as large
 *   load      output: the load at x, if *stiffest has changed; else 0
 *
 * Cost: one Hessian, and one load if *stiffest changes. Along a run whose stiffness grows by a factor q that is at most
 * ln q / ln 1.05 loads.
 * Returns as fvi_stability_number; FVI_EUNSUP for every system with matrices or a mechanism. On error *stiffest and
 * *load are untouched. */
int fvi_stability_along_run(const fvi_method *method, const fvi_run *run,
                        const double *x, double *stiffest, double *load);

/* fvi_stability_lobatto -- Compute the load of a step of form M (fvi_lobatto_m2 to fvi_lobatto_m8, lobatto.h).
 *                                                                                                             [(17.18)]
 *
 * For a quadratic convex U in one dimension at least one mode grows if load > 1, and no mode grows if load <= 1.
 *
 * s = 2: both statements are proved, also in R^d. There
 *
 *     load = lambda / 4 of the matrix of (14.3), with 1 for (1 - 2 kappa)^2 and the number of (17.16) for 4^alpha, or 0
 *            if that is negative.
 *
 * With a law (26.13) replaces (17.16), and the statements are proved for laws whose fractions have 2 alpha <= 1.
 *
 * s >= 3: it is proved that a mode grows if load > 1. That no mode grows if load <= 1 is measured, for W and R up to
 * 1000 (for s >= 5, W up to 10^4 and R up to 30). The stable steps do not always form an interval. Where the load first
 * passes 1 it is continuous in h; beyond it jumps. In R^d the load is exact if M^{-1} K and M^{-1} rho commute, and an
 * estimate otherwise. K = Hess U(x0), so for a U that is not quadratic the load is that of small motions about x0.
 *
 *   stages  s = 2, ..., 8
 *   run     system, x0, h, and law or alpha are read; the other members may have any value
 *   load    output, >= 0
 *
 * Cost: O(s^5), which is 17 us for s = 4 and 170 us for s = 8, and O(d^3); O(d s^3) without U. Accuracy:
 * 1e-12 max(1, load) (not proved; seen 4e-15 for s <= 4, 4e-14 for s = 8).
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if s is out of range;
 * FVI_EDOM if h or alpha is out of range; what fvi_kernel_check returns; FVI_EOVRFLW if W or R is not finite;
 * FVI_ENOMEM; FVI_EMAXITER if eigenvalues were not found; what the Hessian returned. On error *load is untouched. */
int fvi_stability_lobatto(size_t stages, const fvi_run *run, double *load);

/* fvi_unstable_roots -- Count the growing solutions z^{-k} of the scalar recurrence of fvi_fractional. They are the
 * zeros in |z| < 1 of Q(z) = z P(z),                                                                [(14.2)]
 *
 *     P(z) = (1 + kappa (1 - kappa) W) (1/z - 2 + z) + W + R (1 - z)^{2 alpha}.
 *
 * The function counts them by the argument principle along |z| = 1.
 *
 *   alpha, kappa  in [0, 1]
 *   W, R          h^2 c / m and rho h^(2 - 2 alpha) / m, finite, > 0
 *   modes         output: the number of growing modes
 *
 *     int modes;
 *     status = fvi_unstable_roots(0.3, 0, 5, 0.1, &modes);
 *
 * The count is not defined for values on the boundary of stability, where P vanishes on the circle. Cost: 4096 values
 * of P. Returns FVI_SUCCESS; FVI_EFAULT if the output is NULL; FVI_EDOM if a number is out of range. */
int fvi_unstable_roots(double alpha, double kappa, double W, double R,
                       int *modes);

/* fvi_amplification -- Compute the factor 1/|z| by which the unstable mode grows in a step; 1 if no mode is unstable.
 *                                                                                                          [(14.5)]
 *   alpha, kappa, W, R  as fvi_unstable_roots
 *   growth              output, >= 1
 *
 * Cost and accuracy as fvi_amplification_of_kernel. Returns FVI_SUCCESS; FVI_EFAULT and FVI_EDOM as fvi_unstable_roots;
 * FVI_ENOMEM. */
int fvi_amplification(double alpha, double kappa, double W, double R, double *growth);

/* fvi_amplification_of_kernel -- Compute the same factor for any symbol.                                  [(14.5)]
 *
 *   Q       Q(z) = z P(z) for real z in (end, 0); Q(0) > 0. If Q(end) < 0, Q must change its sign exactly once there
 *   end     -1, or a number just above -1 if Q is infinite at -1
 *   growth  output: 1/|z| at the zero z of Q; 1 if Q(end) >= 0
 *
 * GSL's Brent solver finds z to 8 ulp. Returns FVI_SUCCESS; FVI_ENOMEM; FVI_EBADFUNC if Q is not finite; FVI_EINVAL if
 * Q(0) < 0. On error *growth is untouched. */
int fvi_amplification_of_kernel(gsl_function Q, double end, double *growth);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
