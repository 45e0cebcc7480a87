/* src/stability/stability_matrices.c -- The load of a system with matrices, by the power iteration. [H 27] */
#include "stability_share.h"

#include "system/damping_matrix.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/seeded.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ITERATIONS = 64 };

/* The matrix A = spring K + sum_j damper_j C_j. */
typedef struct {
    const fvi_run *run;
    double spring;
    size_t count;
    const double *damper;
    const fvi_damping_matrix *C;
} weighed;

/* y = spring K v + sum_j damper_j C_j v. */
static int multiply_sum(const weighed *w, const double *v, double *y)
{
    const size_t d = w->run->system->d;
    int status = fvi_potential_gradient(w->run->system, v, y);
    for (size_t i = 0; i < d; i++)
        y[i] *= w->spring;
    for (size_t j = 0; !status && j < w->count; j++)
        if (w->damper[j] != 0)
            status = fvi_damping_multiply(w->C + j, d, w->damper[j], v, y);
    return status;
}

//> power
/* The power iteration v <- M^-1 A v. It estimates the largest eigenvalue by Rayleigh's quotient in the product v^T A w,
 * (A v)^T M^-1 (A v) / v^T A v. The estimate is a lower bound, and it never falls. (27.9) */
static int iterate(const weighed *w, void *factors, double *room, double *largest)
{
    const fvi_system *system = w->run->system;
    const size_t d = system->d;
    double *v = room, *y = v + d;
    uint64_t seed = 27;
    for (size_t i = 0; i < d; i++)
        v[i] = (double)(int64_t)fvi_seeded_next(&seed) * 0x1p-63;
    *largest = 0;
    for (int k = 0; k < ITERATIONS; k++) {
        int status = multiply_sum(w, v, y);
        const double before = fvi_dot(d, v, y);
        memcpy(v, y, d * sizeof *v);
        if (!status)
            status = system->matrices->solve(d, factors, v);
        if (status || !(before > 0)) /* A v = 0: nothing acts on v */
            return status;
        *largest = fvi_dot(d, y, v) / before;
        const double size = sqrt(fvi_dot(d, v, v));
        for (size_t i = 0; i < d; i++)
            v[i] /= size;
    }
    return FVI_SUCCESS;
}
//< power

static int has_negative_damping(const weighed *w)
{
    for (size_t j = 0; j < w->count; j++)
        if (w->damper[j] < 0)
            return 1;
    return 0;
}

static int is_active(const weighed *w)
{
    int any = w->spring != 0;
    for (size_t j = 0; j < w->count; j++)
        any |= w->damper[j] > 0;
    return any;
}

static int find_number(weighed *w, double *load)
{
    const fvi_matrices *m = w->run->system->matrices;
    const size_t d = w->run->system->d;
    if (!is_active(w)) {
        *load = 0;
        return FVI_SUCCESS;
    }
    if (has_negative_damping(w))
        FVI_FAIL("a load whose damping helps is not known for matrices", FVI_EUNSUP);
    double *room = calloc(2 * d, sizeof *room), largest = 0;
    void *factors = NULL;
    int status =
        room ? m->factorise(d, 1, NULL, 0, m->params, &factors) : FVI_ENOMEM;
    if (!status)
        status = iterate(w, factors, room, &largest);
    if (factors)
        m->free_factors(factors);
    free(room);
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the load", FVI_ENOMEM);
    if (!status && !isfinite(largest))
        FVI_FAIL("the load is not finite", FVI_EOVRFLW);
    if (!status)
        *load = largest / 4;
    return status;
}

int fvi_stability_of_matrices(double spring, const double *damper, const fvi_run *run,
                              double *load)
{
    const fvi_matrices *m = run->system->matrices;
    weighed w = { .run = run,
                  .spring = spring,
                  .count = !damper ? 0 : m->damper_count > 0 ? m->damper_count : 1,
                  .damper = damper,
                  .C = m->damper_count > 0 ? m->damper : &m->damping };
    return find_number(&w, load);
}
