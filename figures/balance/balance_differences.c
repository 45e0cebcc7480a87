/* figures/balance/balance_differences.c -- The errors of schemes that replace derivatives by differences, beside
 * schemes that come from an action.
 *
 * The equation is x'' + x + x^3 + rho D^{2 alpha} x = 0 with rho = 1/2 and alpha = 0.3, for a body held at x_0
 * = 1 and let go with p_0 = 1/2, 0 <= t <= 10.
 * - Block 0: N, then max |x_k - x(t_k)| of the difference schemes NODE, MEAN and BACK
 *   (tests/balance/differences.h), of fvi, fvi-shifted and fvi-lobatto4.
 * - Block 1: N, then for NODE, MEAN, BACK and fvi the error of a gradient. The gradient is computed by the same
 *   scheme, linearised about the trajectory and run backwards, and is compared with the gradient of the run
 *   itself. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/convolution_quadrature_methods.h>
#include <fvi/lobatto.h>
#include "../tests/balance/differences.h"
#include "system/larger.h"

#include <stdio.h>
#include <stdlib.h>

enum { MOST = 2048 };
static const double T = 10, cg[] = { 1, 1 }, rho = 0.5, one = 1, half = 0.5;
static double truth[MOST + 1], x[MOST + 1], H[MOST + 1], back[MOST + 1],
    v[MOST + 1];

static int varied(const fvi_method *method, const differenced *o, double *z)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_duffing(cg) };
    fvi_run run = fvi_run_default(&system, &one, &half, o->h, o->steps);
    run.alpha = o->alpha;
    return fvi_trajectory(method, &run, z, NULL, NULL);
}

static void differenced_run(differences kind, const differenced *o)
{
    x[0] = one;
    x[1] = one + o->h * half - o->h * o->h / 2 * (cg[0] + cg[1]);
    difference(kind, o, x);
}

static double error(size_t N)
{
    double worst = 0;
    for (size_t k = 0; k <= N; k++)
        worst = larger(worst, fabs(x[k] - truth[k * (MOST / N)]));
    return worst;
}

static differenced problem(size_t N)
{
    return (differenced){ 1, N, cg[1], rho, 0.3, T / (double)N };
}

int main(void)
{
    const fvi_method *methods[] = { &fvi_fractional, &fvi_cq2_shifted,
                                    &fvi_lobatto_m4 };
    const differenced fine = problem(MOST);
    if (varied(&fvi_lobatto_m4, &fine, truth))
        return EXIT_FAILURE;
    printf("# N, error of NODE MEAN BACK fvi fvi-shifted fvi-lobatto4\n");
    for (size_t N = 32; N <= 512; N *= 2) {
        const differenced o = problem(N);
        printf("%zu", N);
        for (int kind = NODE; kind <= BACK; kind++) {
            differenced_run((differences)kind, &o);
            printf(" %.6g", error(N));
        }
        for (int i = 0; i < 3; i++) {
            if (varied(methods[i], &o, x))
                return EXIT_FAILURE;
            printf(" %.6g", error(N));
        }
        printf("\n");
    }
    printf("\n\n# N, error of the gradient: NODE MEAN BACK fvi\n");
    for (size_t N = 32; N <= 512; N *= 2) {
        const differenced o = problem(N);
        printf("%zu", N);
        for (int kind = NODE; kind <= VARIED; kind++) {
            if (kind != VARIED)
                differenced_run((differences)kind, &o);
            else if (varied(&fvi_fractional, &o, x))
                return EXIT_FAILURE;
            printf(" %.2g",
                   gradient_error((differences)kind, &o, x, H, back, v));
        }
        printf("\n");
    }
    return EXIT_SUCCESS;
}
