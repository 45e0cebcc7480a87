/* src/run/step_times.h -- The times at which a step evaluates its force. [H 13, 17]
 *
 * A force may jump at a node, and the jump belongs to neither of the two steps beside the node. So a step evaluates the
 * force at times within the step, close to its ends. h, the product k h and the time of a jump may each be off by half
 * an ulp, and h may be off by as much again if it is T / N. So four ulp on either side are enough. (13.12) */
#ifndef FVI_STEP_TIMES_H
#define FVI_STEP_TIMES_H

#include <gsl/gsl_machine.h>
#include <math.h>
#include <stddef.h>

/* fvi_just_before, fvi_just_after -- a time just below, and just above, a node t >= 0. */
static inline double fvi_just_before(double t)
{
    return t * (1 - 4 * GSL_DBL_EPSILON);
}

static inline double fvi_just_after(double t)
{
    return fmax(t * (1 + 4 * GSL_DBL_EPSILON), GSL_DBL_MIN);
}

/* fvi_inner_time -- the time of stage i of s in the step from `left` to `right`, of length h. At the first and the last
 * stage it lies just within the step; between them it is `middle`, the time of the stage. If a step is shorter than the
 * rounding errors of its times, the result is the time just after `left`. */
static inline double fvi_inner_time(double left, double right, double h, double middle,
                                    size_t i, size_t s)
{
    const double in = 4 * GSL_DBL_EPSILON, after = left + in * fmax(left, h),
                 t = i + 1 == s ? right - in * right : middle;
    return i == 0 || t < after ? after : t;
}

#endif
