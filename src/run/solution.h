/* src/run/solution.h -- Check whether a motion exists that starts as the run does. [H 19, 27] */
#ifndef FVI_SOLUTION_H
#define FVI_SOLUTION_H

#include <fvi/trajectory.h>

#include <float.h>

/* A sum counts as zero up to 64 u times the size of its terms, because it may consist of rounding errors. */
#define FVI_ROUNDING_SHARE (64 * (DBL_EPSILON / 2))

/* fvi_run_start_is_damped -- find out whether the damping acts on x0 itself: rho_i x0_i != 0 for some i, or C x0 != 0.
 *
 *   run        of a system that fvi_system_check_any accepts, x0 finite
 *   is_damped  output, 0 or 1
 *
 * A damper between two bodies that start at the same place does not act on x0, so C x0 may be zero for an x0 != 0. But
 * C x0 is a sum of rounded products. It counts as zero while
 *
 *     |(C x0)_i| <= 64 u sqrt(C_ii) max_j sqrt(C_jj) |x0_j|   for all i:
 *
 * because |C_ij| is at most sqrt(C_ii C_jj). So the rounding error of a sum of n products is at most n^2 u times the
 * right side without 64 u, even if signs do not help. This proves the criterion for rows of up to eight entries, if C
 * is summed row by row. If C acts as B B^T (27.4), no such bound is known; seen: 4 u, up to 400 unknowns. A force on x0
 * that is really so small, relative to the coordinate with the strongest damping, counts as none.
 *
 * Cost O(d), one product by C. Returns FVI_SUCCESS; FVI_ENOMEM; or what the matrices returned. */
int fvi_run_start_is_damped(const fvi_run *run, int *is_damped);

/* fvi_run_has_solution -- write 0 to *has if no motion with a finite velocity starts as the run does, else 1. [(19.2)]
 *
 * No motion starts so with the past RIEMANN_LIOUVILLE if alpha > 1/2 and the damping acts on x0; or if a damper has
 * this past and a law that grows faster than s, and x0 stretches it. Arguments and codes as above. */
int fvi_run_has_solution(const fvi_run *run, int *has);

/* fvi_damper_is_stretched -- find out whether the elongation z of damper j at x0, or with matrices C_j x0, is not 0.
 *
 * C_j x0 counts as zero as above if C_j tells its diagonal; without a diagonal it must be exactly zero. An elongation
 * counts as zero while
 *
 *     |z| <= 64 u sum_i |dg/dx_i x0_i|.
 *
 * Codes as above, and what the elongation returned. */
int fvi_damper_is_stretched(const fvi_run *run, size_t j, int *is_stretched);

#endif
