/* src/reference/exact_motion_check.h -- Check whether a system has an exact motion here.   [H 11] */
#ifndef FVI_EXACT_MOTION_CHECK_H
#define FVI_EXACT_MOTION_CHECK_H

#include <fvi/exact_motion.h>

/* fvi_exact_motion_check -- Check a motion for which there is a response: it must be linear, its dampers were held, its
 * numbers are in range, and K is positive semidefinite. Return what fvi_exact_motion_alloc returns. */
int fvi_exact_motion_check(const fvi_exact_problem *problem, fvi_error *error);

/* fvi_exact_motion_start -- Compute v_0 = M^-1 p_0 and K x_0, d numbers each. Return FVI_SUCCESS or the code of the
 * function that failed. */
int fvi_exact_motion_start(const fvi_system *system, const double *x0, const double *p0,
                           double *v0, double *spring_force);

#endif
