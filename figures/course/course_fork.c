/* figures/course/course_fork.c -- Chapter 1: the same position and the same velocity, and two futures.
 *
 * - Block 0: t and x of a body that was held at 1 until t = 0.
 * - Block 1: t and x of a second body. It was held where the first body is at t = 2.8, and it is let go at t =
 *   2.8 with the momentum of the first body. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_02.c"
#undef main

enum { LAST = 140, LEAVES = 28 };

int main(void)
{
    run(LAST);
    printf("# t, x of the body that was held at 1\n");
    for (int k = 0; k <= LAST; k++)
        printf("%.17g %.17g\n", k * h, x[k]);
    x0 = x[LEAVES], p0 = p[LEAVES];
    run(LAST - LEAVES);
    printf("\n\n# t, x of the body that was held at %.6f\n0 %.17g\n", x0, x0);
    for (int k = 0; k <= LAST - LEAVES; k++)
        printf("%.17g %.17g\n", (k + LEAVES) * h, x[k]);
    return 0;
}
