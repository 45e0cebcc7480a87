/* src/analysis/stability_matrices.c -- Is this step stable, with matrices?  [H 27] */
#include "stability_share.h"

#include "system/fail.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ITERATIONS = 64 };

/* y = spring K v + damper C v, z and none being room for what is remembered. */
static int weigh(const fvi_run *run, double spring, double damper,
                 const double *v, double *y, double *z, const double *none)
{
    const fvi_matrices *m = run->system->matrices;
    const size_t d = run->system->d;
    int status = fvi_potential_gradient(run->system, v, y);
    for (size_t i = 0; i < d; i++)
        y[i] *= spring;
    if (status || m->remembered == 0 || damper == 0)
        return status;
    status = m->remember(d, v, none, m->params, z);
    return status ? status : m->damp(d, -damper, z, m->params, y);
}

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

//> power
/* The power iteration v <- M^-1 A v. With the product v^T A w the quotient of Rayleigh is
 * (A v)^T M^-1 (A v) / v^T A v: from below, and it never falls. (27.9) */
static int iterate(const fvi_run *run, double spring, double damper,
                   void *factors, double *room, double *largest)
{
    const size_t d = run->system->d;
    double *v = room, *y = v + d, *z = y + d;
    const double *none = z + run->system->matrices->remembered;
    uint64_t seed = 27;
    for (size_t i = 0; i < d; i++) {
        seed = 6364136223846793005u * seed + 1442695040888963407u;
        v[i] = (double)(int64_t)seed * 0x1p-63;
    }
    *largest = 0;
    for (int k = 0; k < ITERATIONS; k++) {
        int status = weigh(run, spring, damper, v, y, z, none);
        const double before = dot(d, v, y);
        memcpy(v, y, d * sizeof *v);
        if (!status)
            status = run->system->matrices->solve(d, factors, v);
        if (status || !(before > 0)) /* nothing that pulls */
            return status;
        *largest = dot(d, y, v) / before;
        const double size = sqrt(dot(d, v, v));
        for (size_t i = 0; i < d; i++)
            v[i] /= size;
    }
    return FVI_SUCCESS;
}
//< power

int fvi_stability_of_matrices(double spring, double damper, const fvi_run *run,
                              double *load)
{
    const fvi_matrices *m = run->system->matrices;
    const size_t d = run->system->d;
    if (spring == 0 && damper <= 0) {
        *load = 0;
        return FVI_SUCCESS;
    }
    if (damper < 0)
        FVI_FAIL("a load whose damping helps is not known for matrices",
                 FVI_EUNSUP);
    double *room = calloc(2 * (d + m->remembered), sizeof *room), largest = 0;
    void *factors = NULL;
    int status =
        room ? m->factorise(d, 1, 0, 0, m->params, &factors) : FVI_ENOMEM;
    if (!status)
        status = iterate(run, spring, damper, factors, room, &largest);
    if (factors)
        m->forget(factors);
    free(room);
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the load", FVI_ENOMEM);
    if (!status && !isfinite(largest))
        FVI_FAIL("the load is not finite", FVI_EOVRFLW);
    if (!status)
        *load = largest / 4;
    return status;
}
