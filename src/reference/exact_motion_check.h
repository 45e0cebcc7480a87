/* src/reference/exact_motion_check.h -- Check whether a system has an exact motion here.   [H 11] */
#ifndef FVI_EXACT_MOTION_CHECK_H
#define FVI_EXACT_MOTION_CHECK_H

#include <fvi/exact_motion.h>

/* fvi_exact_motion_check -- Check a motion that has this response: it must be linear, its dampers were held, its
 * numbers are in range, and K is positive semidefinite. Return what fvi_exact_motion_alloc returns. */
int fvi_exact_motion_check(const fvi_exact_problem *problem, const fvi_response *response,
                           fvi_error *error);

#endif
