/* figures/stability/stability_rounding.c -- H 14: the rounding errors of three forms of the same integrator.
 *
 * The problem is that of Bagley and Torvik on [0, 20] in N steps. Prints N, then max |x_k - truth_k| / max
 * |truth| for
 *     the second difference x_{k+1} = 2 x_k - x_{k-1} + ..., memory on positions;
 *     the momentum form of the library, memory on increments;
 *     the same with compensated sums for x and p.
 * The truth is the momentum form in long double with the same step, so the differences are rounding errors
 * alone. */
#include <fvi/error.h>
#include "../tests/stability/stability_forms.h"

#include <stdio.h>

static double x[3][FORMS_MOST + 1];
static long double truth[FORMS_MOST + 1];

int main(void)
{
    printf(
        "# N, max|x - truth| / max|truth|: second difference, momentum form, "
        "compensated\n");
    for (size_t N = 125; N <= FORMS_MOST; N *= 2) {
        double h = 20.0 / (double)N;
        forms_truth(N, h, truth);
        forms_second_difference(N, h, x[0]);
        forms_momentum(N, h, x[1]);
        forms_compensated(N, h, x[2]);
        printf("%zu %.17g %.17g %.17g\n", N, forms_error(N, x[0], truth),
               forms_error(N, x[1], truth), forms_error(N, x[2], truth));
    }
    return 0;
}
