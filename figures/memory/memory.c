/* figures/memory/memory.c -- H 12: the weights of the memory as a sum of exponentials.
 *
 * nu = 1/2 and N = 10^6. Prints the weights and their sum of exponentials; then the relative error of this sum
 * for three tolerances delta; then the exponentials one by one, the modes. */
#include <fvi/coefficients.h>
#include "memory/history_kinds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 1000000, DELTAS = 3, MOST = 200 };

static const double nu = 0.5, deltas[DELTAS] = { 1e-4, 1e-8, 1e-12 };

static size_t next(size_t n, size_t per_e)
{
    return n + 1 + n / per_e;
}

static double sum(size_t Q, const double *s, const double *c, size_t n)
{
    double total = 0;
    for (size_t q = 0; q < Q; q++)
        total += c[q] * exp(-(double)n * s[q]);
    return total;
}

static void print_weights(const double *w, size_t Q, const double *s,
                          const double *c)
{
    printf("# nu = 1/2, N = 10^6, delta = %g: n, |w_n|, |sum of modes|\n",
           deltas[0]);
    for (size_t n = 1; n <= 100 * N; n = next(n, 8))
        printf("%zu %.17g %.17g\n", n, n <= N ? fabs(w[n]) : NAN,
               fabs(sum(Q, s, c, n)));
}

static void print_errors(const double *w, size_t Q[], double s[][MOST],
                         double c[][MOST])
{
    printf("\n\n# n, relative error of the sum for delta =");
    for (size_t i = 0; i < DELTAS; i++)
        printf(" %g", deltas[i]);
    for (size_t n = 1; n <= N; n = next(n, 25)) {
        printf("\n%zu", n);
        for (size_t i = 0; i < DELTAS; i++)
            printf(" %.17g", fabs(sum(Q[i], s[i], c[i], n) / w[n] - 1));
    }
    printf("\n");
}

static void print_modes(size_t Q, const double *s, const double *c)
{
    printf("\n\n# the modes for delta = %g, one after the other: n, |c| e^(-n "
           "s)\n",
           deltas[0]);
    for (size_t q = 0; q < Q; q++) {
        for (size_t n = 1; n <= 100 * N; n = next(n, 4))
            if (fabs(c[q]) * exp(-(double)n * s[q]) > 1e-14)
                printf("%zu %.17g\n", n, fabs(c[q]) * exp(-(double)n * s[q]));
        printf("\n");
    }
}

int main(void)
{
    static double s[DELTAS][MOST], c[DELTAS][MOST];
    size_t Q[DELTAS];
    double *w = malloc((N + 1) * sizeof *w);
    if (!w || fvi_gl_weights(nu, N + 1, w))
        return EXIT_FAILURE;
    for (size_t i = 0; i < DELTAS; i++)
        Q[i] = fvi_history_modes_nodes(nu, N, deltas[i], s[i], c[i], NULL);
    print_weights(w, Q[0], s[0], c[0]);
    print_errors(w, Q, s, c);
    print_modes(Q[0], s[0], c[0]);
    free(w);
    return EXIT_SUCCESS;
}
