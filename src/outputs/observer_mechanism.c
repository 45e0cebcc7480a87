/* src/outputs/observer_mechanism.c -- What the forces on a mechanism give in a step. */
#include "observer_state.h"

#include "mechanism/mechanism_state.h"

#include <stdlib.h>

/* F at point i of the last step, less what stands there of it already. */
static const double *force_of_time(const fvi_stepper *s,
                                   const fvi_mechanism_state *o, size_t i)
{
    return o->form == FVI_MECHANISM_FIRST_ORDER ? s->F : o->push + i * o->d;
}

static double time_of_point(const fvi_stepper *s, const fvi_mechanism_state *o,
                            size_t i)
{
    const double begin = ((double)s->k - 1) * s->run.h,
                 part = o->form == FVI_MECHANISM_FIRST_ORDER
                            ? 1 - s->run.kappa
                        : o->form == FVI_MECHANISM_NODES ? 0.5
                                                         : o->rule->c[i];
    return begin + part * s->run.h;
}

int fvi_observer_mechanism_work(const fvi_stepper *s, double *work)
{
    const fvi_mechanism_state *o = fvi_mechanism_of(s);
    const fvi_state_force *of_velocity = s->run.system->mechanism->force_on;
    const size_t d = o->d;
    const int has_stages = o->form != FVI_MECHANISM_FIRST_ORDER
                           && o->form != FVI_MECHANISM_NODES;
    double *F = calloc(d, sizeof *F);
    int status = F ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t i = 0; i < o->q && !status; i++) {
        const double w = s->run.h * (has_stages ? o->rule->b[i] : 1),
                     *push = force_of_time(s, o, i);
        if (of_velocity)
            status = of_velocity->at(time_of_point(s, o, i), d, o->X + i * d,
                                     o->V + i * d, of_velocity->params, F, NULL,
                                     NULL);
        for (size_t j = 0; j < d && !status; j++)
            *work += w * (push[j] + F[j]) * o->V[i * d + j];
    }
    free(F);
    return status;
}
