/* src/methods/damping_matrices.c -- Start the dampers of a run with matrices.  [H 27] */
#include "damping.h"

#include <string.h>

int fvi_damping_begin_matrices(const fvi_stepper *s, fvi_initial_history past,
                               fvi_damping *d)
{
    const fvi_run *run = &s->run;
    d->factor[0] = d->unit;
    int status = FVI_SUCCESS;
    if (past == FVI_INITIAL_HISTORY_CAPUTO && d->of.growth > 1) {
        double *v = s->dx; /* workspace: dx is not used before the first step */
        status = fvi_divide_by_mass(run->system, s->p, v);
        for (size_t i = 0; i < run->system->d; i++)
            v[i] *= run->h;
        if (!status) /* z is still zero */
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
