/* figures/coefficients/coefficients.c -- H 4: the rounding errors of six formulas for alpha_n, up to n = 10^6.
 *
 * Prints, for alpha = 0.1 and alpha = 1/4, the largest relative error up to n of each formula, in units of u =
 * 2^-53. The reference is the recurrence in quadruple precision, whose own relative error is below 10^-27 here. */
#include <fvi/coefficients.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;
#else
typedef long double quad;
#endif

enum { MANY = 1000001, FORMULAS = 6 };

static void race(double alpha, const double *fast)
{
    double s[4] = { -alpha, -alpha, -alpha, -alpha }, worst[FORMULAS] = { 0 };
    quad truth = -(quad)alpha;
    size_t next = 2;
    printf("# alpha = %g: n, then the largest error up to n, in u = 2^-53, of\n"
           "# s(n-1-a)/n  s((n-1-a)/n)  s(1-(1+a)/n)  s-s(1+a)/n  "
           "double-double  exp(lgamma)\n",
           alpha);
    for (size_t n = 2; n < MANY; n++) {
        double x = (double)n;
        truth = truth * ((quad)(n - 1) - (quad)alpha) / (quad)n;
        s[0] = s[0] * (x - 1 - alpha) / x;
        s[1] = s[1] * ((x - 1 - alpha) / x);
        s[2] = s[2] * (1 - (1 + alpha) / x);
        s[3] = s[3] - s[3] * (1 + alpha) / x;
        double gammas =
            -exp(lgamma(x - alpha) - lgamma(-alpha) - lgamma(x + 1));
        double value[FORMULAS] = { s[0], s[1], s[2], s[3], fast[n], gammas };
        for (size_t i = 0; i < FORMULAS; i++) {
            double error =
                fabs((double)(((quad)value[i] - truth) / truth)) * 0x1p53;
            worst[i] = larger(worst[i], error);
        }
        if (n == next || n == MANY - 1) {
            printf("%zu", n);
            for (size_t i = 0; i < FORMULAS; i++)
                printf(" %.17g",
                       larger(worst[i], 0.01)); /* the axis is logarithmic */
            printf(" %.17g\n", alpha);          /* for the title */
            next += 1 + next / 8;
        }
    }
    printf("\n\n");
}

int main(void)
{
    const double alphas[] = { 0.1, 0.25 };
    double *fast = malloc(MANY * sizeof *fast);
    for (size_t i = 0; fast && i < 2; i++)
        if (fvi_gl_weights(alphas[i], MANY, fast) == 0)
            race(alphas[i], fast);
    free(fast);
    return fast ? EXIT_SUCCESS : EXIT_FAILURE;
}
