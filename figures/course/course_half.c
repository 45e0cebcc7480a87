/* figures/course/course_half.c -- Chapter 8: the weights of half a derivative, taken once and taken twice.
 *
 * Prints n, the weight n of order 1/2, and the weight n of two half derivatives in a row. Both are derivatives
 * of the path 1, 0, 0, ... with h = 1. */
#define main body_main
#pragma GCC diagnostic ignored "-Wreturn-type" /* main alone may end without a return */
#include "course/body_08.c"
#undef main

enum { LAST = 12 };

int main(void)
{
    double path[LAST + 1] = { 1 }, once[LAST + 1];
    h = 1;
    weights(0.5, LAST + 1);
    printf("# n, once, twice\n");
    for (int k = 0; k <= LAST; k++) {
        once[k] = derivative(0.5, k, path);
        printf("%d %.17g %.17g\n", k, once[k], derivative(0.5, k, once));
    }
    return 0;
}
