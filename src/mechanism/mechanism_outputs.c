/* src/mechanism/mechanism_outputs.c -- The outputs of a run with a mechanism besides x and p. [H 29] */
#include "mechanism_state.h"

#include <stdlib.h>
#include <string.h>

const fvi_mechanism_state *fvi_mechanism_of(const fvi_stepper *s)
{
    return s->mechanism;
}

int fvi_stepper_velocity(const fvi_stepper *s, double *v)
{
    if (!s || !v)
        return FVI_EFAULT;
    const fvi_mechanism_state *o = fvi_mechanism_of(s);
    if (!o)
        return FVI_EUNSUP;
    memcpy(v, o->v, o->d * sizeof *v);
    if (o->m > 0) /* the projection to the hidden constraint has computed it */
        return FVI_SUCCESS;
    return fvi_velocity_of_momentum(s->run.system, s->t, s->x, s->p, v);
}

int fvi_stepper_keep_dampers(fvi_stepper *s)
{
    if (!s)
        return FVI_EFAULT;
    if (!fvi_has_dampers_of_matrices(s->run.system))
        return fvi_mechanism_of(s) ? FVI_SUCCESS : FVI_EUNSUP;
    if (s->k > 0)
        return FVI_EINVAL;
    return s->method->keep_dampers ? s->method->keep_dampers(s) : FVI_EUNSUP;
}

int fvi_stepper_damper(const fvi_stepper *s, size_t j, double *impulse,
                       double *work)
{
    if (!s)
        return FVI_EFAULT;
    const fvi_mechanism_state *o = fvi_mechanism_of(s);
    if (!o && fvi_has_dampers_of_matrices(s->run.system) && s->method->damper)
        return s->method->damper(s, j, impulse, work);
    if (!o)
        return FVI_EUNSUP;
    if (j >= o->r)
        return FVI_EINVAL;
    if (impulse)
        *impulse = o->impulse[j];
    if (work)
        *work = o->work[j];
    return FVI_SUCCESS;
}

int fvi_stepper_multipliers(const fvi_stepper *s, double *begin, double *end)
{
    if (!s)
        return FVI_EFAULT;
    const fvi_mechanism_state *o = fvi_mechanism_of(s);
    if (!o)
        return FVI_EUNSUP;
    if (begin)
        memcpy(begin, o->begun, o->permanent * sizeof *begin);
    if (end)
        memcpy(end, o->ended, o->permanent * sizeof *end);
    return FVI_SUCCESS;
}

int fvi_stepper_tie(const fvi_stepper *s, size_t i, double *impulse)
{
    if (!s || !impulse)
        return FVI_EFAULT;
    const fvi_mechanism_state *o = fvi_mechanism_of(s);
    if (!o)
        return FVI_EUNSUP;
    if (i >= o->permanent)
        return FVI_EINVAL;
    *impulse = o->tie[i];
    return FVI_SUCCESS;
}

int fvi_mechanism_work_of_impulse(const fvi_stepper *s, double t, const double *x, const double *p,
                                  const double *J, double *work)
{
    const fvi_system *system = s->run.system;
    const size_t d = system->d;
    double before = 0, after = 0;
    if (!system->mechanism->lagrangian) {
        for (size_t j = 0; j < d; j++)
            *work += system->mass[j] > 0 ? J[j] * (p[j] - J[j] / 2) / system->mass[j] : 0;
        return FVI_SUCCESS;
    }
    double *less = malloc(d * sizeof *less);
    if (!less)
        return FVI_ENOMEM;
    for (size_t j = 0; j < d; j++)
        less[j] = p[j] - J[j];
    int status = fvi_energy_at(system, t, x, less, &before);
    if (!status)
        status = fvi_energy_at(system, t, x, p, &after);
    free(less);
    *work += after - before;
    return status;
}

int fvi_stepper_energy(const fvi_stepper *s, double *E)
{
    return !s || !E ? FVI_EFAULT
                    : fvi_energy_at(s->run.system, s->t, s->x, s->p, E);
}
