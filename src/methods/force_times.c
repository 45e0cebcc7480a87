/* src/methods/force_times.c -- The times at which a step of given length evaluates its force. [H 2, 13, 17] */
#include "force_times.h"

#include "run/step_times.h"
#include "stages/lobatto_weights.h"

size_t fvi_step_force_times(const fvi_method *method, double h, size_t k, double t[FVI_MOST_FORCE_TIMES])
{
    const double left = (double)k * h, right = (double)(k + 1) * h;
    const size_t stages = (size_t)method->stages;
    if (method->dense)
        return 0;
    if (method->scheme == FVI_SCHEME_CLASSICAL || method->scheme == FVI_SCHEME_FVI) {
        t[0] = method->scheme == FVI_SCHEME_FVI || method->implicit ? right : left; /* left: Euler's explicit method */
        return 1;
    }
    t[0] = fvi_just_after(left);
    t[1] = fvi_just_before(right);
    for (size_t i = 0; i < stages; i++)
        t[i] = fvi_inner_time(left, right, h, left + fvi_lobatto(stages)->c[i] * h, i, stages);
    return stages ? stages : 2;
}
