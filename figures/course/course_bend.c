/* figures/course/course_bend.c -- Chapter 4: a body and its mirror image, and the action when both or one of them
 * is varied.
 *
 * - Block 0: t, x, y, and x and y with a bump added to each. The bump is 0.3 * 4 s^2 (1 - s), s = t / T, so its
 *   height is 0.18.
 * - Block 1: e, the change of the action if e times a bump is added to both x and y, and if it is added to x
 *   alone. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_04.c"
#undef main

enum { N = 100 };

int main(void)
{
    run(N);
    for (int k = 0; k <= N; k++)
        y[k] = x[N - k];
    printf("# t, x, y, x bent, y bent\n");
    for (int k = 0; k <= N; k++) {
        double s = (double)k / N, bump = 4 * s * s * (1 - s);
        printf("%.17g %.17g %.17g %.17g %.17g\n", k * h, x[k], y[k], x[k] + 0.3 * bump, y[k] + 0.3 * bump);
    }
    printf("\n\n# e, S(x + e, y + e) - S(x, y), S(x + e, y) - S(x, y)\n");
    double middle = bent(N, 0, 0);
    for (int i = -25; i <= 25; i++) {
        double e = i / 50.0;
        printf("%.17g %.17g %.17g\n", e, bent(N, e, e) - middle, bent(N, e, 0) - middle);
    }
    return 0;
}
