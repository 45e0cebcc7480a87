/* src/variable_step/variable_step_guess.c -- The initial guess of the iteration of a step. [H 22] */
#include "variable_step.h"

#include <fvi/error.h>

#include <math.h>
#include <string.h>

void fvi_variable_step_extrapolate(fvi_variable_step_state *o)
{
    const size_t n = o->rule->s;
    const double before = o->t - o->t0, /* 0 in the first step */
        ratio = o->length.h / before;
    memset(o->delta, 0, o->d * FVI_LANES * sizeof *o->delta);
    if (!(ratio < 2.1) || o->first_after_event)
        return;
    double theta[FVI_LANES] = { 0 };
    fvi_square R;
    for (size_t i = 0; i < n; i++)
        theta[i] = 1 + o->rule->c[i] * ratio;
    fvi_variable_step_shapes(n, theta, &R);
    for (size_t j = 0; j < o->d; j++) {
        double *delta = o->delta + j * FVI_LANES,
               *accel_legendre = o->accel_legendre0 + j * FVI_LANES;
        fvi_square_apply(n, &R, accel_legendre, delta);
        for (size_t i = 0; i < FVI_LANES; i++)
            delta[i] = i < n ? delta[i] - accel_legendre[0] : 0;
    }
}

/* ---- from stage to stage ---- */

/* The leapfrog method goes astray if springs are stiff for its steps. Then a stage is so much farther from the stage of
 * a free body than all the motion so far, the allowed error and the way of the free body together. From there an
 * iteration may not come back; a Hessian may overflow; and the solution may be a rest in another valley of the
 * potential. */
static const double FAR = 10;

static int is_far(const fvi_variable_step_state *o, size_t i)
{
    for (size_t j = 0; j < o->d; j++) {
        const double *base = o->base + j * FVI_LANES,
                     away = o->point[i * o->d + j] - base[i];
        if (!(fabs(away)
              <= FAR * (o->scale + o->allowed + fabs(base[i] - base[0]))))
            return 1;
    }
    return 0;
}

int fvi_variable_step_is_astray(const fvi_variable_step_state *o)
{
    int astray = 0;
    for (size_t i = 0; i < o->rule->s; i++)
        astray = astray || is_far(o, i);
    return astray;
}

/* Compute x at stage i from stage i - 1, which is dt earlier. */
static void leapfrog_positions(fvi_variable_step_state *o, size_t i, double dt)
{
    const double *before = o->point + (i - 1) * o->d;
    for (size_t j = 0; j < o->d; j++) {
        const size_t at = j * FVI_LANES + i;
        o->point[i * o->d + j] =
            before[j] + (o->base[at] - o->base[at - 1])
            + dt * (o->delta[at - 1] + dt / 2 * o->accel_legendre[at - 1]);
    }
}

/* Compute V - v and its derivative at stage i, from the force at this stage and from the present part damping_coeff W0
 * of the memory, up to this stage. The derivatives take the room of accel_legendre, which is computed later. */
static void leapfrog_velocities(fvi_variable_step_state *o, size_t i, double dt, double by_h)
{
    for (size_t j = 0; j < o->d; j++) {
        const fvi_coordinate_group *group = &o->group[o->group_of[j]];
        const double by_m = 1 / group->mass, damping_coeff = group->damping_coeff * by_h,
                     w = by_m * damping_coeff * o->W0.column[i][i],
                     held = 1 / (1 + dt / 2 * w);
        double *v = o->delta + j * FVI_LANES, *a = o->accel_legendre + j * FVI_LANES,
               past = 0;
        for (size_t l = 0; l < i; l++)
            past += o->W0.column[l][i] * v[l];
        const double f = by_m
                         * (o->R[j * FVI_LANES + i] * by_h - damping_coeff * past
                            - o->gradient[i * o->d + j]);
        if (i > 0)
            v[i] = (v[i - 1] + dt / 2 * (a[i - 1] + f)) * held;
        a[i] = f - w * v[i];
    }
}

int fvi_variable_step_guess_by_leapfrog(const fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const fvi_variable_rule *rule = o->rule;
    const double by_h = 1 / o->length.h;
    memset(o->delta, 0, o->d * FVI_LANES * sizeof *o->delta);
    for (size_t j = 0; j < o->d; j++)
        o->point[j] = o->base[j * FVI_LANES];
    for (size_t i = 0; i < rule->s; i++) {
        const double dt =
            i > 0 ? o->length.h * (rule->c[i] - rule->c[i - 1]) : 0;
        if (i > 0)
            leapfrog_positions(o, i, dt);
        if (is_far(o, i))
            return FVI_EMAXITER;
        const int status = u->gradient(o->d, o->point + i * o->d, u->params,
                                       o->gradient + i * o->d);
        if (status)
            return status;
        leapfrog_velocities(o, i, dt, by_h);
    }
    return FVI_SUCCESS;
}
