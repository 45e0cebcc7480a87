/* figures/integration_by_parts/integration_by_parts.c -- H 5: the two half derivatives of a bump, and the boundary
 * term of fractional integration by parts.
 *
 * - Block 0: t, a bump, its half derivative that looks back and the one that looks ahead.
 * - Block 1: h, and for each order the boundary term of the first identity, for two functions that do not
 *   vanish at the ends. */
#include <fvi/paper/integration_by_parts.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 400, ORDERS = 4 };

static int bump(void)
{
    static double f[N + 1], back[N + 1], ahead[N + 1];
    const double pi = acos(-1), h = 1.0 / N, alpha = 0.5;
    for (size_t k = 0; k <= N; k++) {
        double s = ((double)k * h - 0.5) / 0.15;
        f[k] = fabs(s) < 1 ? pow(cos(pi * s / 2), 2) : 0;
    }
    if (fvi_delta_minus(alpha, h, N, 1, f, back)
        || fvi_delta_plus(alpha, h, N, 1, f, ahead))
        return EXIT_FAILURE;
    printf("# t  bump  Delta_- bump  Delta_+ bump  (alpha = 1/2, N = %d)\n", N);
    for (size_t k = 0; k <= N; k++)
        printf("%.17g %.17g %.17g %.17g\n", (double)k * h, f[k], back[k],
               ahead[k]);
    printf("\n\n");
    return EXIT_SUCCESS;
}

/* Compute h sum (Delta_+ G) F - h sum G (Delta_- F), with F = 1 + t, G = 3 - t^2 and M steps of [0, 1]. */
static int leftover(double alpha, size_t M, double *left)
{
    double F[N + 1], G[N + 1], dF[N + 1], dG[N + 1], h = 1 / (double)M;
    for (size_t k = 0; k <= M; k++) {
        F[k] = 1 + (double)k * h;
        G[k] = 3 - pow((double)k * h, 2);
    }
    if (fvi_delta_minus(alpha, h, M, 1, F, dF)
        || fvi_delta_plus(alpha, h, M, 1, G, dG))
        return EXIT_FAILURE;
    *left = h
            * (fvi_sum_of_products(0, M - 1, 1, dG, F)
               - fvi_sum_of_products(1, M, 1, G, dF));
    return EXIT_SUCCESS;
}

int main(void)
{
    const double orders[ORDERS] = { 0.25, 0.5, 0.75, 1 };
    int status = bump();
    printf("# h, then |what is left over| for alpha = 1/4, 1/2, 3/4, 1;\n"
           "# F = 1 + t, G = 3 - t^2 on [0, 1]; last |F_0 G_0 - F_N G_N|\n");
    for (size_t M = 4; M <= 256 && !status; M *= 2) {
        printf("%.17g", 1 / (double)M);
        for (size_t i = 0; i < ORDERS && !status; i++) {
            double left;
            status = leftover(orders[i], M, &left);
            printf(" %.17g", fabs(left));
        }
        printf(" %.17g\n", fabs(1.0 * 3 - 2.0 * 2));
    }
    return status;
}
