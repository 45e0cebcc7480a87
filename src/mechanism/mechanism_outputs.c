/* src/mechanism/mechanism_outputs.c -- What a run with a mechanism tells besides x and p. [H 29] */
#include <fvi/dampers.h>

int fvi_stepper_velocity(const fvi_stepper *s, double *v)
{
    return !s || !v ? FVI_EFAULT : FVI_EUNSUP;
}

int fvi_stepper_damper(const fvi_stepper *s, size_t j, double *impulse,
                       double *work)
{
    (void)j;
    (void)impulse;
    (void)work;
    return !s ? FVI_EFAULT : FVI_EUNSUP;
}

int fvi_stepper_multipliers(const fvi_stepper *s, double *begin, double *end)
{
    (void)begin;
    (void)end;
    return !s ? FVI_EFAULT : FVI_EUNSUP;
}

int fvi_stepper_energy(const fvi_stepper *s, double *E)
{
    return !s || !E ? FVI_EFAULT
                    : fvi_energy_at(s->run.system, s->t, s->x, s->p, E);
}
