/* figures/course/course_sums.c -- Chapter 2: half a derivative of x = t, by sums with 4 and with 16 steps.
 *
 * Prints a block for each number of steps, with t and the sum D_h of order 1/2 of the path x = t at each node.
 * The last block is the limit, 2 sqrt(t / pi). */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_02.c"
#undef main

int main(void)
{
    for (int N = 4; N <= 16; N *= 4) {
        h = 1.0 / N;
        weights(0.5, N + 1);
        for (int k = 0; k <= N; k++)
            z[k] = k * h;
        printf("# t, half a derivative of t with %d steps\n", N);
        for (int k = 0; k <= N; k++)
            printf("%.17g %.17g\n", k * h, derivative(0.5, k, z));
        printf("\n\n");
    }
    printf("# t, 2 sqrt(t / pi)\n");
    for (int k = 0; k <= 200; k++)
        printf("%.17g %.17g\n", k / 200.0, sqrt(k / 200.0) / tgamma(1.5));
    return 0;
}
