/* tests/structures/structures_runs.h -- Systems of matrices, for the tests of H 27. */
#ifndef STRUCTURES_RUNS_H
#define STRUCTURES_RUNS_H

#include <fvi/fvi.h>
#include <fvi/structures.h>
#include <stdlib.h>
#include <string.h>

#include "../../figures/structures/cantilever.h"
#include "harness/seen.h"
#include "harness/ulp.h"

static const fvi_method *const takers[] = { &fvi_fractional, &fvi_cq2_shifted,
                                            &fvi_cq_bdf2, &fvi_cq2_midpoint };

/* Three matrices, and the structure of them. */
typedef struct {
    fvi_sparse M, K, C;
    fvi_structure *structure;
    fvi_system system;
} matrices;

static inline void make(matrices *m)
{
    char fault;
    OK(fvi_structure_alloc(&m->M, &m->K, &m->C, &m->structure, &fault));
    ck_assert_int_eq(fault, 0);
    m->system = fvi_structure_system(m->structure);
}

static inline void drop(matrices *m)
{
    fvi_structure_free(m->structure);
    fvi_sparse_free(&m->M);
    fvi_sparse_free(&m->K);
    fvi_sparse_free(&m->C);
}

/* A bar of n masses between two walls, dx = 1/(n + 1): M with a consistent part, K, C a sum
 * of both: tridiagonal matrices with a on the diagonal and b beside it. */
static inline void tridiagonal(int n, double a, double b, fvi_sparse *A)
{
    fvi_triplet *list = malloc(3 * (size_t)n * sizeof *list);
    size_t count = 0;
    for (int i = 0; i < n; i++)
        for (int j = i > 0 ? i - 1 : 0; j <= i + 1 && j < n; j++)
            list[count++] = (fvi_triplet){ i, j, i == j ? a : b };
    OK(fvi_sparse_assemble((size_t)n, count, list, A));
    free(list);
}

/* Such a bar whose M has a consistent part. */
static inline void make_consistent(int n, matrices *m)
{
    tridiagonal(n, 1, 0.2, &m->M);
    tridiagonal(n, 4, -2, &m->K);
    tridiagonal(n, 0.2, -0.1, &m->C);
    make(m);
}

static inline fvi_run run_of(const fvi_system *system, double alpha, double h,
                             size_t steps, const double *x0, const double *p0)
{
    fvi_run run = fvi_run_default(system, x0, p0, h, steps);
    run.alpha = alpha;
    return run;
}

#endif
