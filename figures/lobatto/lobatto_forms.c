/* figures/lobatto/lobatto_forms.c -- H 17: the two forms of the inertia, form M and form D.
 *
 * - Blocks 0 to 3, for s = 3 to 6 stages: h, the largest errors of x and p with form M, the largest errors of x
 *   and p with form D, on 2 <= t <= 20, for x'' + x + D^{3/2} x = 8 for t <= 1, then 0, from rest.
 * - Block 4: t, the energy of x'' + x^3 = 0 divided by its value at the start, with form M and with form D, s =
 *   3, h = 1/2. */
#include <fvi/exact_solution.h>
#include "run/whole_run.h"
#include <fvi/lobatto.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 1280 };
static double x[MOST + 1], p[MOST + 1], t[MOST + 1], exact_x[MOST + 1],
    exact_p[MOST + 1], energy[2][MOST + 1];

static void errors(const fvi_method *method, size_t N)
{
    const double one = 1, zero = 0, aT[] = { 8, 1 };
    const fvi_system system = {
        1, &one, &one, fvi_potential_harmonic(&one), fvi_force_step(aT), NULL, NULL
    };
    fvi_run run = fvi_run_default(&system, &zero, &zero, 20 / (double)N, N);
    const fvi_linear_oscillator problem = { .m = 1,
                                 .c = 1,
                                 .rho = 1,
                                 .alpha = 0.75,
                                 .forcing = FVI_FORCING_STEP,
                                 .A = 8,
                                 .T = 1 };
    run.alpha = 0.75;
    for (size_t k = 0; k <= N; k++)
        t[k] = (double)k * run.h;
    if (fvi_trajectory(method, &run, x, p, NULL)
        || fvi_exact_at(&problem, N + 1, t, exact_x, exact_p, NULL))
        exit(EXIT_FAILURE);
    double of_x = 0, of_p = 0;
    for (size_t k = N / 10; k <= N; k++) {
        of_x = larger(of_x, fabs(x[k] - exact_x[k]));
        of_p = larger(of_p, fabs(p[k] - exact_p[k]));
    }
    printf(" %.10g %.10g", of_x, of_p);
}

int main(void)
{
    const fvi_method *const forms[][2] = { { &fvi_lobatto_m3, &fvi_lobatto_d3 },
                                           { &fvi_lobatto_m4, &fvi_lobatto_d4 },
                                           { &fvi_lobatto_m5, &fvi_lobatto_d5 },
                                           { &fvi_lobatto_m6, &fvi_lobatto_d6 } };
    for (size_t i = 0; i < 4; i++) {
        printf("# h, errors of x and p: M, D; s = %zu\n", i + 3);
        for (size_t N = 20; N <= MOST; N *= 2) {
            printf("%.17g", 20 / (double)N);
            errors(forms[i][0], N);
            errors(forms[i][1], N);
            putchar('\n');
        }
        printf("\n\n");
    }
    const double one = 1, zero = 0, cg[] = { 0, 1 };
    const fvi_system free = {
        1, &one, &zero, fvi_potential_duffing(cg), { .value = NULL }, NULL, NULL
    };
    const fvi_run run = fvi_run_default(&free, &one, &zero, 0.5, 400);
    for (size_t i = 0; i < 2; i++)
        if (fvi_trajectory(forms[0][i], &run, NULL, NULL, energy[i]))
            return EXIT_FAILURE;
    printf("# t, energy over that of the start, s = 3: M, D\n");
    for (size_t k = 0; k <= 400; k++)
        printf("%g %.10g %.10g\n", (double)k * run.h,
               energy[0][k] / energy[0][0], energy[1][k] / energy[1][0]);
    return EXIT_SUCCESS;
}
