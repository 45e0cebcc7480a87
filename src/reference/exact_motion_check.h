/* src/reference/exact_motion_check.h -- Has a system an exact motion here?   [H 11] */
#ifndef FVI_EXACT_MOTION_CHECK_H
#define FVI_EXACT_MOTION_CHECK_H

#include <fvi/exact_motion.h>

/* fvi_exact_motion_check -- of a motion of which there is a response: is it linear, were its dampers
 * held, are its numbers in range, is K positive semidefinite? Returns as fvi_exact_motion_alloc. */
int fvi_exact_motion_check(const fvi_exact_problem *problem, fvi_error *error);

/* fvi_exact_motion_start -- v_0 = M^-1 p_0 and K x_0, d numbers each. */
int fvi_exact_motion_start(const fvi_system *system, const double *x0, const double *p0,
                           double *v0, double *spring_force);

#endif
