/* src/run/solution.h -- Is there a motion that starts so?            [H 19, 27] */
#ifndef FVI_SOLUTION_H
#define FVI_SOLUTION_H

#include <fvi/trajectory.h>

#include <float.h>

/* Of the size of its terms a sum that is less counts as roundings: 64 u. */
#define FVI_ROUNDING_SHARE (64 * (DBL_EPSILON / 2))

/* fvi_run_start_is_damped -- does the damping act on x0 itself: rho_i x0_i != 0 for some
 * i, or C x0 != 0?
 *
 *   run   of a system that fvi_system_check_any takes, x0 finite
 *   is_damped  output, 0 or 1
 *
 * A damper between bodies that start alike does not act on the start. C x0 is a sum of rounded
 * products, and counts as zero while
 *
 *     |(C x0)_i| <= 64 u sqrt(C_ii) max_j sqrt(C_jj) |x0_j|   for all i:
 *
 * |C_ij| is at most sqrt(C_ii C_jj), so that n products, summed, round by up to n^2 u of
 * that, where signs do not help: rows of up to eight entries are safe if C is summed by its
 * rows. Where it goes as B B^T (27.4) there is no such bound; seen: 4 u, up to 400 unknowns.
 * A smaller force, against the place that is damped most, counts as none.
 * Cost O(d), one product by C. Returns FVI_SUCCESS; FVI_ENOMEM; or what the matrices
 * returned. */
int fvi_run_start_is_damped(const fvi_run *run, int *is_damped);

/* fvi_run_has_solution -- 0 if no motion with a finite velocity starts there:
 * Riemann-Liouville, alpha > 1/2, and a damping that acts on x0; or a damper with this past and a law that
 * grows faster than s, which x0 stretches; else 1.  [(19.2)]
 * Arguments and codes as above. */
int fvi_run_has_solution(const fvi_run *run, int *has);

/* fvi_damper_is_stretched -- is the elongation z of damper j at x0 not 0, or with matrices C_j x0? C_j x0
 * counts as zero as above, where C_j tells its diagonal, and else if it is zero. An elongation does while
 *
 *     |z| <= 64 u sum_i |dg/dx_i x0_i|.
 *
 * Codes as above, and what the elongation returned. */
int fvi_damper_is_stretched(const fvi_run *run, size_t j, int *is_stretched);

#endif
