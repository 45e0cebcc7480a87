/* figures/course/course_work.c -- Chapter 12: the error against the number of products, for three versions of the
 * memory.
 *
 * Prints three blocks: sums with weights of order 1, modes of order 1, modes of order 2. Each row has the
 * number of products in the memory and the error of x(20). */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_12.c"
#undef main

int main(void)
{
    const double want = 0.05685529300399696; /* x(20), from `fvi exact` */
    for (int i = 0; i < 3; i++) {
        printf("%s# products, error of x(20)\n", i ? "\n\n" : "");
        for (int N = 100; N <= (i == 0 ? 6400 : 102400); N *= 2) {
            fast = i > 0, second = i > 1;
            double e = fabs(at(20, N) - want);
            printf("%.17g %.9g\n", fast ? (double)N * (NEAR + 1 + 2 * modes) : N / 2.0 * (N + 1), e);
        }
    }
    return 0;
}
