/* src/observer/observer_mechanism.c -- The work of the forces on a mechanism in a step. */
#include "observer_state.h"

#include "mechanism/mechanism_state.h"

#include <string.h>

/* F on coordinate j at point i of the last step; for the node scheme the mean of F at both ends. */
static double force_of_time(const fvi_stepper *s, const fvi_mechanism_state *o,
                            size_t i, size_t j)
{
    return o->form == FVI_MECHANISM_FIRST_ORDER ? s->F[j]
           : o->form == FVI_MECHANISM_NODES
               ? (o->load[j] + o->load[o->d + j]) / 2
               : o->load[i * o->d + j];
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

int fvi_observer_mechanism_work(fvi_observer *by, const fvi_stepper *s, double *work)
{
    const fvi_mechanism_state *o = fvi_mechanism_of(s);
    const fvi_state_force *of_velocity = s->run.system->mechanism->force_on;
    const size_t d = o->d;
    const int has_stages = o->form != FVI_MECHANISM_FIRST_ORDER
                           && o->form != FVI_MECHANISM_NODES;
    double *F = memset(by->g, 0, d * sizeof *F);
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < o->q && !status; i++) {
        const double w = s->run.h * (has_stages ? o->rule->b[i] : 1);
        if (of_velocity)
            status = of_velocity->at(time_of_point(s, o, i), d, o->X + i * d,
                                     o->V + i * d, of_velocity->params, F, NULL,
                                     NULL);
        for (size_t j = 0; j < d && !status; j++)
            *work += w * (force_of_time(s, o, i, j) + F[j]) * o->V[i * d + j];
    }
    return status;
}
