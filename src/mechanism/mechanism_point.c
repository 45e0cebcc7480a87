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

int fvi_elongation_rate_is_fixed(const fvi_elongation *of, size_t d, const double *x0, double *room, int *is_fixed)
{
    double here, there;
    *is_fixed = 1;
    if (of->row || !of->rate)
        return FVI_SUCCESS;
    memcpy(room, x0, d * sizeof *room);
    int status = of->rate(0, d, room, of->params, &here);
    for (size_t i = 0; i < 2 * d && !status; i++) {
        room[i / 2] = x0[i / 2] + (i % 2 ? 1e-3 : -1e-3);
        status = of->rate(0, d, room, of->params, &there);
        room[i / 2] = x0[i / 2];
        if (!status)
            *is_fixed &= there == here;
    }
    return status;
}

int fvi_mechanism_force(fvi_stepper *s, double t, double *F)
{
    const int status = fvi_force_value(s, t);
    memcpy(F, s->F, s->run.system->d * sizeof *F);
    return status;
}

/* ---- why a step failed ---- */

int fvi_mechanism_finite_forces(const fvi_stepper *s, double t, const double *F)
{
    return fvi_check_finite(s, "force_on", "the force", " on coordinate ", t, s->run.system->d, F);
}

int fvi_mechanism_finite_elongations(const fvi_stepper *s, double t, const double *z)
{
    return fvi_check_finite(s, "damper", "the elongation", " of damper ", t, s->run.system->mechanism->damper_count, z);
}

/* Check the slopes of L and the forces of velocity at the beginning of the step, for the time t. */
static int check_forces(fvi_stepper *s, double t)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_state_force *force = s->run.system->mechanism->force_on;
    const size_t d = o->d;
    int status = fvi_lagrangian_point(s->run.system, t, s->x, o->v, NULL, o->f, o->Lv, NULL, NULL, NULL);
    if (!status)
        status = fvi_check_finite(s, "lagrangian", "the slope of the Lagrangian", " by coordinate ", t, d, o->f);
    if (!status && force)
        status = force->at(t, d, s->x, o->v, force->params, o->room, NULL, NULL);
    if (!status && force)
        status = fvi_mechanism_finite_forces(s, t, o->room);
    return status;
}

/* Check the elongations and the constraints there. */
static int check_places(const fvi_stepper *s, double t)
{
    const fvi_mechanism_state *o = s->mechanism;
    int status = fvi_mechanism_elongations(s, t, s->x, o->elongation, o->gradient);
    if (!status)
        status = fvi_mechanism_finite_elongations(s, t, o->elongation);
    if (!status && o->m)
        status = fvi_mechanism_tie_values(s, t, s->x, o->room);
    if (!status && o->m)
        status = fvi_check_finite(s, "constraint", "the constraint", " number ", t, o->m, o->room);
    return status;
}

int fvi_mechanism_explain(fvi_stepper *s, int status)
{
    const fvi_mechanism_state *o = s->mechanism;
    const double h = s->run.h, ahead = o->form == FVI_MECHANISM_NODES ? 0.5 : 1 - s->run.kappa;
    if (status != FVI_EMAXITER && status != FVI_ESING && status != FVI_EOVRFLW)
        return status;
    for (size_t i = 0; i < (o->rule ? o->s : 2); i++) {
        const double end = o->rule ? fvi_mechanism_stage_time(s, i) : (double)(s->k + 1) * h,
                     inner = o->rule ? fvi_mechanism_inner_time(s, i) : (double)s->k * h + ahead * h;
        if (check_forces(s, inner) == FVI_EBADFUNC || check_places(s, end) == FVI_EBADFUNC)
            return FVI_EBADFUNC;
    }
    return status;
}
