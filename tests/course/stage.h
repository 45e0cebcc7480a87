/* tests/course/stage.h -- A stage of the Course's program inside its test.
 *
 * STAGE is the file, such as "course/body_06.c", or a student's own: its main becomes
 * body_main, so that the test can call its functions. The harness comes first, because
 * the stage has a function U of its own. */
#ifndef STAGE_H
#define STAGE_H

#include <fvi/fvi.h>
#include "harness/ulp.h"
#include "course_ref.h"

/* One rounding. */
#define ROUNDING 0x1p-53

/* What rounding may do to a run of N steps of a damped body, m = c = 1, |x|, |p| <= 2. In a
 * step the memory, a sum of N terms whose weights add up to at most 2 in absolute value, of
 * displacements of at most 4, is off by 8 (N + 6) roundings times h rho h^(-2 alpha); the
 * rest of the step by some 16. A kick moves a body on a spring of stiffness 1 by at most
 * its own size, so N steps are off by at most N times as much. Roundings partly cancel:
 * seen are at most 6e-4 of this bound. */
static inline double rounding_of_run(int N, double unit)
{
    return N * (16 + 8 * (N + 6) * unit) * ROUNDING;
}

#undef U
#define main body_main
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include STAGE
#pragma GCC diagnostic pop
#undef main

#endif
