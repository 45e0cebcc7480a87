/* figures/structures/structures_membrane.c -- H 27: a membrane that is bent and let go.
 *
 * The equation is u_tt + tau (-Laplace) D^{2 alpha} u = Laplace u on a square, with u = 0 at the edges, by
 * five-point differences on 95 x 95 points. A bump is let go; the run is by fvi-stable with h = dx. Prints x,
 * y, u at three times, with the edges; an empty line ends each row of points. */
#include <fvi/fvi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { M = 95, D = M * M, TIMES = 3 };

static const double alpha = 0.25, tau = 0.004;
static const size_t at[TIMES] = { 0, 30, 72 };

static void fail(int status)
{
    if (status)
        exit(EXIT_FAILURE);
}

/* Assemble A, `factor` times the five-point differences for -Laplace, which are divided by dx^2 = 1 / (M + 1)^2. */
static void laplace(double factor, fvi_sparse *A)
{
    fvi_triplet *list = malloc(5 * (size_t)D * sizeof *list);
    const double k = factor * (M + 1) * (M + 1);
    size_t count = 0;
    for (int i = 0; list && i < D; i++) {
        const int beside[] = { i % M > 0 ? i - 1 : -1,
                               i % M < M - 1 ? i + 1 : -1, i - M, i + M };
        list[count++] = (fvi_triplet){ i, i, 4 * k };
        for (int l = 0; l < 4; l++)
            if (beside[l] >= 0 && beside[l] < D)
                list[count++] = (fvi_triplet){ i, beside[l], -k };
    }
    fail(fvi_sparse_assemble(D, count, list, A));
    free(list);
}

static void snapshot(const double *x)
{
    for (int j = -1; j <= M; j++) {
        for (int i = -1; i <= M; i++) {
            const int inside = i >= 0 && i < M && j >= 0 && j < M;
            printf("%.4f %.4f %.4f\n", (i + 1.0) / (M + 1), (j + 1.0) / (M + 1),
                   inside ? x[j * M + i] : 0);
        }
        printf("\n");
    }
    printf("\n");
}

int main(void)
{
    static double x0[D], p0[D];
    fvi_triplet *ones = malloc(D * sizeof *ones);
    fvi_sparse mass, K, C;
    fvi_structure *structure;
    for (int i = 0; ones && i < D; i++) {
        const double x = (i % M + 1.0) / (M + 1) - 0.35,
                     y = ((int)(i / M) + 1.0) / (M + 1) - 0.4;
        x0[i] = exp(-150 * (x * x + y * y));
        ones[i] = (fvi_triplet){ i, i, 1 };
    }
    fail(fvi_sparse_assemble(D, D, ones, &mass));
    free(ones);
    laplace(1, &K);
    laplace(tau, &C);
    fail(fvi_structure_alloc(&mass, &K, &C, &structure, NULL));
    const fvi_system system = fvi_structure_system(structure);
    fvi_run run =
        fvi_run_default(&system, x0, p0, 1.0 / (M + 1), at[TIMES - 1]);
    run.alpha = alpha;
    fvi_stepper *s;
    fail(fvi_stepper_start(&fvi_cq2_midpoint, &run, &s, NULL));
    for (int l = 0; l < TIMES; l++) {
        while (s->k < at[l])
            fail(fvi_stepper_step(s));
        snapshot(s->x);
    }
    fvi_stepper_free(s);
    fvi_structure_free(structure);
    fvi_sparse_free(&mass);
    fvi_sparse_free(&K);
    fvi_sparse_free(&C);
    return 0;
}
