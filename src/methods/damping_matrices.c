/* src/methods/damping_matrices.c -- What a run with matrices begins with.  [H 27] */
#include "damping.h"
#include "initial_history_force.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_damping_begin_matrices(const fvi_stepper *s, fvi_initial_history past,
                               fvi_damping *d)
{
    const fvi_run *run = &s->run;
    const double order = 2 * run->alpha;
    d->factor[0] = d->unit;
    int status = FVI_SUCCESS;
    if (past == FVI_INITIAL_HISTORY_CAPUTO && order > 1) {
        double *v = s->dx; /* nothing stands there yet */
        status = fvi_damping_velocity(run->system, s->p, v);
        for (size_t i = 0; i < run->system->d; i++)
            v[i] *= run->h;
        if (!status) /* from z, which is still zero */
            status = fvi_damping_gather(d, v, d->z, d->drift);
        memset(v, 0, run->system->d * sizeof *v);
    }
    if (!status && past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
        status = fvi_damping_gather(d, s->x, d->z, d->origin);
    if (!status)
        status = fvi_damping_gather(d, s->x, d->origin, d->dz);
    memcpy(d->z, d->dz, d->count * sizeof *d->z);
    return status;
}

/* C A h^(1 + e), A the amplitudes of all coordinates. (19.3) */
int fvi_initial_history_force_of_matrices(const fvi_stepper *s, size_t n, const double *c,
                         fvi_initial_history_force *history_force)
{
    const fvi_run *run = &s->run;
    const fvi_matrices *m = run->system->matrices;
    const size_t d = run->system->d;
    int any = 0, status = FVI_SUCCESS;
    double *A = calloc(d + 2 * m->remembered, sizeof *A), *z = A ? A + d : NULL,
           *none = A ? z + m->remembered : NULL;
    history_force->size = calloc(d, sizeof *history_force->size);
    if (!A || !history_force->size)
        status = FVI_ENOMEM;
    else if (run->alpha > 0.5) /* else no velocity is asked for */
        status = fvi_damping_velocity(run->system, s->p, A);
    for (size_t i = 0; !status && i < d; i++) {
        A[i] = fvi_initial_history_amplitude(run->past, run->alpha, s->x[i], A[i]);
        any |= A[i] != 0;
    }
    if (any) {
        fvi_kernel_impulse_prepare(run->alpha, n, c, &history_force->initial_impulse);
        status = m->remember(d, A, none, m->params, z);
    }
    if (any && !status)
        status = m->damp(d, -pow(run->h, 1 + history_force->initial_impulse.e), z, m->params,
                         history_force->size);
    free(A);
    if (!any || status) {
        free(history_force->size);
        history_force->size = NULL;
    }
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the past", FVI_ENOMEM);
    return status;
}
