/* figures/structures/structures.c -- H 27: a clamped beam that is bent and let go.
 *
 * The beam has 32 elements and C = tau K. The runs are by fvi-stable with h = 1/400. tau is chosen so that the
 * first mode has the same loss factor at its own frequency for every alpha.
 * - Blocks 0 to 2, for three alpha: t, the deflection of the tip.
 * - Block 3, for alpha = 1/4: x, w at six times. */
#include <fvi/fvi.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cantilever.h"

enum { N = 32, D = 2 * N, STEPS = 3200 };

static const double alphas[] = { 0.05, 0.25, 0.5 };

static void fail(int status)
{
    if (status)
        exit(EXIT_FAILURE);
}

/* Return the tau for which Im (i w)^{2 alpha} tau = 0.1 at the frequency of the first mode, w = 1.8751^2. */
static double tau_of(double alpha)
{
    const double pi = 3.14159265358979324, w = 3.5160;
    return 0.1 / (pow(w, 2 * alpha) * sin(pi * alpha));
}

/* Compute x0, the shape of the beam under a load at the tip that bends the tip by 1. */
static void bend(const fvi_system *system, double *x0)
{
    const fvi_matrices *m = system->matrices;
    void *factors;
    memset(x0, 0, D * sizeof *x0);
    x0[D - 2] = 3; /* F l^3 / 3 = 1 */
    fail(m->factorise(D, 0, NULL, 1, m->params, &factors));
    fail(m->solve(D, factors, x0));
    m->free_factors(factors);
}

static void shape(const double *x)
{
    printf("0 0\n");
    for (int e = 0; e < N; e++)
        printf("%g %.6g\n", (e + 1.0) / N, x[2 * e]);
    printf("\n");
}

static void swing(double alpha, int shapes)
{
    fvi_sparse M, K, C;
    fvi_structure *structure;
    const double tau = tau_of(alpha);
    fail(cantilever(N, tau, &M, &K, &C));
    fail(fvi_structure_alloc(&M, &K, &C, &structure, NULL));
    fvi_system system = fvi_structure_system(structure);
    const beam b = { N, tau, system.matrices };
    const fvi_matrices by_elements = beam_matrices(&b);
    system.matrices = &by_elements;
    double x0[D], p0[D] = { 0 };
    bend(&system, x0);
    fvi_run run = fvi_run_default(&system, x0, p0, 1.0 / 400, STEPS);
    run.alpha = alpha;
    fvi_stepper *s;
    fail(fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, NULL));
    for (;; fail(fvi_stepper_step(s))) {
        if (!shapes && s->k % 4 == 0)
            printf("%g %.6g\n", s->t, s->x[D - 2]);
        if (shapes && s->k % 71 == 0
            && s->k <= 5 * 71) /* 71 steps are a fifth of half a swing */
            shape(s->x);
        if (s->k == STEPS)
            break;
    }
    printf("\n\n");
    fvi_stepper_free(s);
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
    fvi_sparse_free(&C);
}

int main(void)
{
    for (int i = 0; i < 3; i++)
        swing(alphas[i], 0);
    swing(0.25, 1);
    return 0;
}
