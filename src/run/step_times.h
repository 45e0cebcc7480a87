/* src/run/step_times.h -- When a step asks for its force.                  [H 13, 17]
 *
 * A force may jump at a node, and the jump belongs to neither of the steps beside it. So a step asks
 * from within. h, the product k h and the place of a jump may each be off by half an ulp, and
 * T / N for h by as much again: four ulp on either side are enough. (13.12) */
#ifndef FVI_STEP_TIMES_H
#define FVI_STEP_TIMES_H

#include <gsl/gsl_machine.h>
#include <math.h>
#include <stddef.h>

/* fvi_just_before, fvi_just_after -- a node t >= 0 from below, and from above. */
static inline double fvi_just_before(double t)
{
    return t * (1 - 4 * GSL_DBL_EPSILON);
}

static inline double fvi_just_after(double t)
{
    return fmax(t * (1 + 4 * GSL_DBL_EPSILON), GSL_DBL_MIN);
}

/* fvi_inner_time -- of stage i of s in the step from left to right, of length h: from within at its
 * ends, and between them `middle`, which is that of the stage. A step that is shorter than the roundings of
 * its times sees what is after `left`. */
static inline double fvi_inner_time(double left, double right, double h, double middle,
                                    size_t i, size_t s)
{
    const double in = 4 * GSL_DBL_EPSILON, after = left + in * fmax(left, h),
                 t = i + 1 == s ? right - in * right : middle;
    return i == 0 || t < after ? after : t;
}

#endif
