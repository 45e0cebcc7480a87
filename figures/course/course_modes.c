/* figures/course/course_modes.c -- Chapter 11: a power law as a sum of exponentials.
 *
 * - Block 0: n, the absolute value of the weight of order 1/2, and the sum of COUNT exponentials, the modes.
 * - Blocks 1 to COUNT: n and one mode. The rates s of the modes are 1.5 apart in log s, which is too coarse for
 *   a run but can be seen in the picture. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_11.c"
#undef main

enum { COUNT = 11 };

int main(void)
{
    const double pi = acos(-1), b = 0.5, apart = 1.5;
    weights(b, 100001);
    printf("# n, weight, sum of %d modes\n", COUNT);
    for (double log_n = 0; log_n < 5.01; log_n += 0.05) {
        int n = (int)(pow(10, log_n) + 0.5);
        double sum = 0;
        for (int q = 0; q < COUNT; q++) {
            double s = exp(0.5 - q * apart);
            sum += sin(pi * b) / pi * apart * s * pow(expm1(s), b) * exp(-n * s);
        }
        printf("%d %.17g %.17g\n", n, fabs(w[n]), sum);
    }
    for (int q = 0; q < COUNT; q++) {
        double s = exp(0.5 - q * apart);
        printf("\n\n# n, mode %d\n", q);
        for (double log_n = 0; log_n < 5.01; log_n += 0.1)
            printf("%.17g %.17g\n", pow(10, log_n),
                   sin(pi * b) / pi * apart * s * pow(expm1(s), b) * exp(-pow(10, log_n) * s));
    }
    return 0;
}
