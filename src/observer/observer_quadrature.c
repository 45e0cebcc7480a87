/* src/observer/observer_quadrature.c -- Impulse and work of the forces in a step that the method chose. */
#include "observer_state.h"

/* Gauss's rule of eight nodes. It is exact up to the degree 15, which is above the orders of fvi-adaptive. */
static const double node[] = { 0.18343464249564980, 0.52553240991632899,
                               0.79666647741362674, 0.96028985649753623 },
                    weight[] = { 0.36268378337836198, 0.31370664587788729,
                                 0.22238103445337447, 0.10122853629037626 };

int fvi_observer_quadrature(fvi_observer *o, const fvi_stepper *s, double from,
                            double to, double *known, double *by_force)
{
    const double middle = from + (to - from) / 2, half = (to - from) / 2;
    int status = FVI_SUCCESS;
    for (int i = 0; i < 8 && half > 0 && !status; i++) {
        const double t = middle + (i % 2 ? half : -half) * node[i / 2],
                     w = half * weight[i / 2];
        status = s->method->dense(s, t, o->begin.x, o->begin.p);
        if (!status)
            status = fvi_step_force(s, t, o->begin.F);
        if (!status)
            status =
                fvi_potential_gradient(s->run.system, o->begin.x, o->g);
        if (!status && o->matrices && o->wanted & FVI_OBSERVE_WORK)
            status = o->matrices->solve(o->d, o->factors, o->begin.p); /* v = M^-1 p */
        for (size_t j = 0; j < o->d && !status; j++) {
            known[j] += w * (o->begin.F[j] - o->g[j]);
            *by_force += w * o->begin.F[j] * o->begin.p[j]
                         / (o->matrices ? 1 : s->run.system->mass[j]);
        }
    }
    return status;
}
