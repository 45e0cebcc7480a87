/* figures/course/course_front.c -- README.md: course_seven.c with the points of stage 12, whose damping
 * is on time. */
#define STAGE "course/body_12.c"
#define SET_UP_STAGE second = 1
#include "course_seven.c"
