/* figures/course/course_bump.c -- Chapter 5: half a derivative of a bump, looking back and looking ahead.
 *
 * Prints t, the bump, its D_- and its D_+ of order 1/2, for t in [0, 1]. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_05.c"
#undef main

enum { N = 400 };

int main(void)
{
    h = 1.0 / N;
    weights(0.5, N + 1);
    for (int k = 0; k <= N; k++) {
        double s = (k * h - 0.35) / 0.3;
        x[k] = s > 0 && s < 1 ? pow(sin(acos(-1) * s), 2) : 0;
    }
    printf("# t, bump, D_-, D_+ of order 1/2\n");
    for (int k = 0; k <= N; k += 2)
        printf("%.17g %.17g %.17g %.17g\n", k * h, x[k], derivative(0.5, k, x), ahead(0.5, k, N, x));
    return 0;
}
