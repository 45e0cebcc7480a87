/* src/mechanism/mechanism_point.c -- Evaluate the Lagrangian, the forces and the elongations at one point.  [H 29] */
#include "mechanism_state.h"
#include "system/dot.h"
#include "system/lagrangian_point.h"

#include <math.h>
#include <string.h>

int fvi_mechanism_point(fvi_stepper *s, size_t i, double t, int with_forces)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_state_force *force = s->run.system->mechanism->force_on;
    const size_t d = o->d, dd = d * d;
    const double *x = o->X + i * d, *v = o->V + i * d;
    double *f = o->f + i * d, *fx = o->has_root ? NULL : o->fx + i * dd,
           *fv = o->fv + i * dd, *Lxv = fx ? o->Lxv + i * dd : NULL,
           *Lvv = fx ? o->Lvv + i * dd : NULL;
    int status = fvi_lagrangian_point(s->run.system, t, x, v, NULL, f,
                                      o->Lv + i * d, fx, Lxv, Lvv);
    if (fx)
        memcpy(fv, Lxv, dd * sizeof *fv);
    if (status || !with_forces || !force)
        return status;
    double *F = o->room, *Fx = fx ? F + d : NULL, *Fv = fx ? Fx + dd : NULL;
    status = force->at(t, d, x, v, force->params, F, Fx, Fv);
    for (size_t j = 0; j < d; j++)
        f[j] += F[j];
    for (size_t j = 0; fx && j < dd; j++) {
        fx[j] += Fx[j];
        fv[j] += Fv[j];
    }
    return status;
}

int fvi_mechanism_elongations(const fvi_stepper *s, double t, const double *x,
                              double *z, double *G)
{
    const fvi_mechanism *mechanism = s->run.system->mechanism;
    const size_t d = s->run.system->d;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < mechanism->damper_count && !status; j++, G += d) {
        const fvi_elongation *of = &mechanism->damper[j].of;
        if (of->row) {
            z[j] = fvi_dot(d, of->row, x);
            memcpy(G, of->row, d * sizeof *G);
            continue;
        }
        status = of->value(t, d, x, of->params, &z[j]);
        if (!status)
            status = of->gradient(t, d, x, of->params, G);
    }
    return status;
}

int fvi_mechanism_force(fvi_stepper *s, double t, double *F)
{
    const int status = fvi_force_value(s, t);
    memcpy(F, s->F, s->run.system->d * sizeof *F);
    return status;
}
