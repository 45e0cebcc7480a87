/* figures/coefficients/coefficients_weights.c -- H 4: the weights alpha_n, their power law, and their sum.
 *
 * Prints a block for each alpha = 1/4, 1/2, 3/4. Its columns are n, alpha_n, the power law (4.5), and the sum
 * (4.3) of the first n + 1 weights. */
#include <fvi/fvi.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 100000 };

int main(void)
{
    static double w[N + 1];
    for (int i = 1; i <= 3; i++) {
        const double alpha = i / 4.0;
        double sum = 0;
        if (fvi_gl_weights(alpha, N + 1, w))
            return EXIT_FAILURE;
        printf("%s# n, alpha_n, power law, sum; alpha = %g\n",
               i > 1 ? "\n\n" : "", alpha);
        for (size_t n = 0, next = 0; n <= N; n++) {
            sum += w[n];
            if (n < next)
                continue;
            printf("%zu %.17g %.17g %.17g\n", n, w[n],
                   pow((double)n, -1 - alpha) / tgamma(-alpha), sum);
            next = n < 10 ? n + 1 : n + n / 8;
        }
    }
    return EXIT_SUCCESS;
}
