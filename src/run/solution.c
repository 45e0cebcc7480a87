/* src/run/solution.c -- Is there a motion that starts so?            [H 19, 27] */
#include "solution.h"
#include <fvi/dampers.h>
#include "system/all_zero.h"
#include "system/fail.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>

/* C x0 = S B^T x0, to y; z has room for what is remembered, and as many zeros. */
static int product(const fvi_run *run, double *y, double *z)
{
    const fvi_matrices *m = run->system->matrices;
    const size_t d = run->system->d;
    int status = m->remember(d, run->x0, z + m->remembered, m->params, z);
    if (!status)
        status = m->damp(d, -1, z, m->params, y);
    return status;
}

/* Is y = C x0 more than roundings, where C has this diagonal? */
static int is_felt(const fvi_run *run, const double *C, const double *y)
{
    double largest = 0;
    int felt = 0;
    for (size_t i = 0; i < run->system->d; i++)
        largest = larger(largest, sqrt(C[i]) * fabs(run->x0[i]));
    for (size_t i = 0; i < run->system->d; i++)
        felt |= !(fabs(y[i]) <= FVI_FELT * sqrt(C[i]) * largest);
    return felt;
}

int fvi_run_start_is_damped(const fvi_run *run, int *felt)
{
    const fvi_system *system = run->system;
    const size_t d = system->d;
    *felt = 0;
    if (!system->matrices) {
        for (size_t i = 0; i < d; i++)
            *felt |= system->damping[i] > 0 && run->x0[i] != 0;
        return FVI_SUCCESS;
    }
    const size_t r = system->matrices->remembered;
    if (r == 0)
        return FVI_SUCCESS;
    double *y = calloc(d + 2 * r, sizeof *y);
    if (!y)
        FVI_FAIL("no memory for C x0", FVI_ENOMEM);
    const int status = product(run, y, y + d);
    if (!status)
        *felt = is_felt(run, system->damping, y);
    free(y);
    return status;
}

/* C_j x_0 of a damper of a system with matrices: is it not 0? */
static int is_pulled(const fvi_run *run, size_t j, int *is_stretched)
{
    const fvi_damping_matrix *C = &run->system->matrices->damper[j];
    const size_t d = run->system->d, r = C->remembered;
    *is_stretched = 0;
    if (C->remembered == 0)
        return FVI_SUCCESS;
    double *y = calloc(2 * d + 2 * r, sizeof *y);
    if (!y)
        FVI_FAIL("no memory for C x0", FVI_ENOMEM);
    double *diagonal = y + d, *z = diagonal + d;
    int status = C->remember(d, run->x0, z + r, C->params, z);
    if (!status)
        status = C->damp(d, -1, z, C->params, y);
    if (!status && C->diagonal)
        status = C->diagonal(d, C->params, diagonal);
    *is_stretched = C->diagonal ? is_felt(run, diagonal, y) : !fvi_all_zero(d, y);
    free(y);
    return status;
}

/* The elongation at x0, and the size of what it is a sum of, if its gradient stayed what it is there. */
static int find_elongation(const fvi_run *run, const fvi_elongation *of, double *z, double *size)
{
    const size_t d = run->system->d;
    double *G = calloc(d, sizeof *G);
    int status = FVI_SUCCESS;
    *z = *size = 0;
    if (!G)
        FVI_FAIL("no memory for an elongation", FVI_ENOMEM);
    if (!of->row)
        status = of->value(0, d, run->x0, of->params, z);
    if (!of->row && !status)
        status = of->gradient(0, d, run->x0, of->params, G);
    for (size_t i = 0; i < d && !status; i++) {
        const double term = (of->row ? of->row[i] : G[i]) * run->x0[i];
        *z += of->row ? term : 0;
        *size += fabs(term);
    }
    free(G);
    return status;
}

int fvi_damper_is_stretched(const fvi_run *run, size_t j, int *is_stretched)
{
    double z = 0, size = 0;
    if (run->system->matrices)
        return is_pulled(run, j, is_stretched);
    const int status = find_elongation(run, &run->system->mechanism->damper[j].of, &z, &size);
    *is_stretched = !status && !(fabs(z) <= FVI_FELT * size);
    return status;
}

/* With dampers: a law that grows faster than s has no motion that begins stretched, (19.2). */
static int has_solution_of_dampers(const fvi_run *run, int *has)
{
    const fvi_mechanism *m = run->system->mechanism;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < m->damper_count && *has && !status; j++) {
        int is_stretched = 0;
        if (m->damper[j].past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
            && fvi_kernel_growth(m->damper[j].kernel) > 1)
            status = fvi_damper_is_stretched(run, j, &is_stretched);
        *has = !is_stretched;
    }
    return status;
}

int fvi_run_has_solution(const fvi_run *run, int *has)
{
    int felt, status;
    *has = 1;
    if (run->system->mechanism)
        return has_solution_of_dampers(run, has);
    if (fvi_initial_history_solvable(run->past, run->alpha, 1, 1))
        return FVI_SUCCESS; /* from everywhere */
    status = fvi_run_start_is_damped(run, &felt);
    if (!status)
        *has = !felt;
    return status;
}
