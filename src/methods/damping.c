/* src/methods/damping.c -- The damped coordinates of a run and their memory.
 *                                                                 [Chapter 9] */
#include "damping.h"

#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void fvi_damping_free(fvi_damping *d)
{
    if (!d)
        return;
    fvi_memory_free(d->memory);
    free(d->index);
    free(d->factor);
    free(d);
}

/* Zeros for the numbers of `count` coordinates. */
static int damping_alloc(size_t count, fvi_damping **damping)
{
    fvi_damping *d = *damping = calloc(1, sizeof *d);
    if (!d)
        FVI_FAIL("no memory for the damping", FVI_ENOMEM);
    d->index = malloc(count * sizeof *d->index);
    d->factor = calloc(5 * count, sizeof *d->factor);
    if (!d->index || !d->factor)
        FVI_FAIL("no memory for the damping", FVI_ENOMEM);
    d->origin = d->factor + count;
    d->drift = d->factor + 2 * count;
    d->z = d->factor + 3 * count;
    d->dz = d->factor + 4 * count;
    return FVI_SUCCESS;
}

/* The memory of a law; its first weight goes into the factors. */
static int law_of(const fvi_stepper *s, fvi_damping *d)
{
    const fvi_run *run = &s->run;
    double first = 0;
    int status = fvi_law_memory(run->law, s->method->quadrature, run->h,
                                d->count, run->steps, run->memory,
                                run->tolerance, &first, &d->memory);
    for (size_t j = 0; j < d->count; j++)
        d->factor[j] *= first;
    return status;
}

int fvi_damping_start(const fvi_stepper *s, fvi_past past,
                      fvi_damping **damping)
{
    const fvi_run *run = &s->run;
    const fvi_system *system = run->system;
    const double order = 2 * run->alpha;
    size_t count = 0;
    *damping = NULL;
    for (size_t i = 0; i < system->d; i++)
        count += system->damping[i] > 0;
    if (count == 0) /* nothing damped: no memory at all */
        return FVI_SUCCESS;
    int status = damping_alloc(count, damping);
    if (status)
        return status;
    fvi_damping *d = *damping;
    //> start
    for (size_t i = 0; i < system->d; i++) {
        if (system->damping[i] == 0)
            continue;
        size_t j = d->count++;
        d->index[j] = i;
        d->factor[j] =
            system->damping[i] * (run->law ? run->h : pow(run->h, 1 - order));
        if (past != FVI_PAST_RIEMANN_LIOUVILLE)
            d->origin[j] = s->x[i]; /* (9.6) */
        if (past == FVI_PAST_CAPUTO && order > 1)
            d->drift[j] = run->h * s->p[i] / system->mass[i];
        d->z[j] = d->dz[j] = s->x[i] - d->origin[j]; /* the term k = 0 */
    }
    //< start
    status = run->law ? law_of(s, d)
                      : fvi_memory_alloc(order, count, run->steps, run->memory,
                                         run->tolerance, &d->memory);
    if (!status)
        status = fvi_memory_push(d->memory, d->z, d->dz, d->dz);
    return status;
}

int fvi_damping_copy(const fvi_damping *from, fvi_damping **to)
{
    *to = NULL;
    if (!from)
        return FVI_SUCCESS;
    int status = damping_alloc(from->count, to);
    if (status)
        return status;
    (*to)->count = from->count;
    memcpy((*to)->index, from->index, from->count * sizeof *from->index);
    memcpy((*to)->factor, from->factor, 5 * from->count * sizeof *from->factor);
    return fvi_memory_copy(from->memory, &(*to)->memory);
}

/* z and dz are of one step only. */
int fvi_damping_visit(fvi_damping *d, fvi_visitor *v)
{
    return d ? fvi_memory_visit(d->memory, v) : FVI_SUCCESS;
}
