/* src/run/solution.c -- Is there a motion that starts so?            [H 19, 27] */
#include "solution.h"
#include "system/fail.h"
#include "system/larger.h"

#include <float.h>
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

static int is_felt(const fvi_run *run, const double *y)
{
    const double *C = run->system->damping; /* its diagonal */
    double largest = 0;
    int felt = 0;
    for (size_t i = 0; i < run->system->d; i++)
        largest = larger(largest, sqrt(C[i]) * fabs(run->x0[i]));
    for (size_t i = 0; i < run->system->d; i++)
        felt |= !(fabs(y[i]) <= 64 * (DBL_EPSILON / 2) * sqrt(C[i]) * largest);
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
        *felt = is_felt(run, y);
    free(y);
    return status;
}

int fvi_run_has_solution(const fvi_run *run, int *has)
{
    int felt, status;
    *has = 1;
    if (fvi_initial_history_solvable(run->past, run->alpha, 1, 1))
        return FVI_SUCCESS; /* from everywhere */
    status = fvi_run_start_is_damped(run, &felt);
    if (!status)
        *has = !felt;
    return status;
}
