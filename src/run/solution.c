/* src/run/solution.c -- Check whether a motion exists that starts as the run does. [H 19, 27] */
#include "solution.h"
#include <fvi/dampers.h>
#include "system/all_zero.h"
#include "system/arrays.h"
#include "system/damping_matrix.h"
#include "system/fail.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>

/* Return nonzero if y = C x0 is more than rounding errors. C here is the diagonal of the matrix. */
static int is_above_rounding(const fvi_run *run, const double *C, const double *y)
{
    double largest = 0;
    int is_damped = 0;
    for (size_t i = 0; i < run->system->d; i++)
        largest = larger(largest, sqrt(C[i]) * fabs(run->x0[i]));
    for (size_t i = 0; i < run->system->d; i++)
        is_damped |= !(fabs(y[i]) <= FVI_ROUNDING_SHARE * sqrt(C[i]) * largest);
    return is_damped;
}

/* Find out whether C x0 is more than rounding errors. If `diagonal` is NULL, C is asked for its diagonal. If C does not
 * know it, C x0 must be exactly zero. */
static int acts_on_start(const fvi_run *run, const fvi_damping_matrix *C, const double *diagonal, int *acts)
{
    const size_t d = run->system->d;
    double *y, *own_diagonal, *block = FVI_ARRAYS({ &y, d }, { &own_diagonal, d });
    if (!block)
        FVI_FAIL("no memory for C x0", FVI_ENOMEM);
    int status = fvi_damping_multiply(C, d, 1, run->x0, y);
    if (!status && !diagonal && C->diagonal) {
        status = C->diagonal(d, C->params, own_diagonal);
        diagonal = own_diagonal;
    }
    *acts = !status && (diagonal ? is_above_rounding(run, diagonal, y) : !fvi_all_zero(d, y));
    free(block);
    return status;
}

int fvi_run_start_is_damped(const fvi_run *run, int *is_damped)
{
    const fvi_system *system = run->system;
    if (system->matrices)
        return acts_on_start(run, &system->matrices->damping, system->damping, is_damped);
    *is_damped = 0;
    for (size_t i = 0; i < system->d; i++)
        *is_damped |= system->damping[i] > 0 && run->x0[i] != 0;
    return FVI_SUCCESS;
}

/* The elongation z at x0, and the size of its terms: the sum of |dg/dx_i x0_i| with the gradient at x0. */
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
        return acts_on_start(run, &run->system->matrices->damper[j], NULL, is_stretched);
    const int status = find_elongation(run, &run->system->mechanism->damper[j].of, &z, &size);
    *is_stretched = !status && !(fabs(z) <= FVI_ROUNDING_SHARE * size);
    return status;
}

/* With dampers: no motion begins with a stretched damper if its law grows faster than s, (19.2). */
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
    int is_damped, status;
    *has = 1;
    if (run->system->mechanism)
        return has_solution_of_dampers(run, has);
    if (fvi_initial_history_solvable(run->past, run->alpha, 1, 1))
        return FVI_SUCCESS; /* a motion starts from every x0 */
    status = fvi_run_start_is_damped(run, &is_damped);
    if (!status)
        *has = !is_damped;
    return status;
}
