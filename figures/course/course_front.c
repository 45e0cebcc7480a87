/* figures/course/course_front.c -- The first picture of README.md: the curves of course_seven.c, with the points of
 * a run of stage 12.
 *
 * second = 1 switches on (12b), the damping on time, so that the run has order 2. */
#define STAGE "course/body_12.c"
#define SET_UP_STAGE second = 1
#include "course_seven.c"
