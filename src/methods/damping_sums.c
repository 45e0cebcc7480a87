/* src/methods/damping_sums.c -- Sum the impulses and the work of the dampers of a structure.    [H 27] */
#include "damping.h"

#include "system/fail.h"

#include <stdlib.h>
#include <string.h>

int fvi_damping_keep_sums(fvi_stepper *s)
{
    for (fvi_damping *d = fvi_damping_of(s); d; d = d->next) {
        free(d->impulse_sums);
        d->work = 0;
        d->impulse_sums = calloc(3 * d->system->d, sizeof *d->impulse_sums);
        if (!d->impulse_sums)
            FVI_FAIL("no memory for the sums of the dampers", FVI_ENOMEM);
    }
    return FVI_SUCCESS;
}

void fvi_damping_sums_note_momentum(fvi_damping *d, const double *p)
{
    const size_t n = d->system->d;
    memcpy(d->impulse_sums + 2 * n, p, n * sizeof *p);
}

void fvi_damping_sums_add_impulse(fvi_damping *d, const double *p)
{
    const size_t n = d->system->d;
    for (size_t i = 0; i < n; i++)
        d->impulse_sums[n + i] += d->impulse_sums[2 * n + i] - p[i];
}

void fvi_damping_sums_add_work(fvi_damping *d, double h, const double *dx)
{
    const size_t n = d->system->d;
    double work = 0;
    for (size_t i = 0; i < n; i++) {
        d->impulse_sums[i] += d->impulse_sums[n + i];
        work += d->impulse_sums[n + i] * dx[i];
        d->impulse_sums[n + i] = 0;
    }
    d->work += work / h;
}

/* Return the component of an impulse, d numbers, along a row. */
static double project_on_row(size_t n, const double *row, const double *impulse)
{
    double product = 0, square = 0;
    for (size_t i = 0; i < n; i++) {
        product += row[i] * impulse[i];
        square += row[i] * row[i];
    }
    return square > 0 ? product / square : 0;
}

void fvi_damping_impulse(const fvi_damper *damper, size_t d, const double *sum,
                         double *impulse)
{
    if (!damper->matrix)
        *impulse = sum ? project_on_row(d, damper->of.row, sum) : 0;
    else if (sum)
        memcpy(impulse, sum, d * sizeof *impulse);
    else
        memset(impulse, 0, d * sizeof *impulse);
}

int fvi_damping_sums(const fvi_stepper *s, size_t j, double *impulse, double *work)
{
    const fvi_system *system = s->run.system;
    const fvi_damping *d = fvi_damping_of(s);
    if (!system->mechanism)
        return FVI_EUNSUP;
    if (j >= system->mechanism->damper_count)
        return FVI_EINVAL;
    while (d && d->number != j)
        d = d->next;
    if (d && !d->impulse_sums)
        return FVI_EUNSUP;
    if (work)
        *work = d ? d->work : 0;
    if (impulse)
        fvi_damping_impulse(system->mechanism->damper + j, system->d, d ? d->impulse_sums : NULL,
                            impulse);
    return FVI_SUCCESS;
}
