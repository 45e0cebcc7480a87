/* figures/course/course_weights.c -- Chapter 1: how strongly each node of the past acts on the next step.
 *
 * Computes the body of Chapter 1 up to the node NOW. Prints for each node its t, the distance x - x0 from the
 * place where the body was held, and the absolute value of the weight that the step at NOW gives to this node. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_02.c"
#undef main

enum { NOW = 40 };

int main(void)
{
    run(NOW);
    printf("# t, x - x0, weight without its sign\n");
    for (int k = 0; k <= NOW; k++)
        printf("%.17g %.17g %.17g\n", k * h, z[k], fabs(w[NOW - k]));
    return 0;
}
