/* src/variable_step/variable_mechanism_dense.c -- A mechanism between the ends of a step. [H 29, 22] */
#include "variable_mechanism.h"

#include "system/dot.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Return sum_k w_k g_k, where g are the Legendre coefficients converted to powers. */
static double combine_powers(size_t s, const double *coefficients, const double *w)
{
    double g[FVI_LANES];
    fvi_variable_step_powers(s, coefficients, g);
    return fvi_dot(s, w, g);
}

void fvi_mesh_momentum(const fvi_stepper *s, const fvi_variable_step_state *o, double theta,
                       int is_tried, double *p)
{
    const struct fvi_mesh_mechanism *m = o->mechanism;
    const double *from = is_tried ? s->p : m->p0, *slope = is_tried ? m->slope : m->slope0;
    double w[FVI_LANES];
    fvi_variable_step_once(theta, w);
    for (size_t j = 0; j < o->d; j++)
        p[j] = from[j] + combine_powers(o->rule->s, slope + j * FVI_LANES, w);
}

/* Take the impulses of the constraints into p, at the end of the step that is tried. */
static int subtract_constraint_momentum(const fvi_stepper *s, const double *x, double *p)
{
    const fvi_mechanism_state *of = s->mechanism;
    double *C = malloc(of->m * of->d * sizeof *C), *v = malloc(of->d * sizeof *v);
    int status = C && v ? fvi_mechanism_subtract_multipliers(s, C, p) : FVI_ENOMEM;
    if (!status) {
        memcpy(v, of->V + (of->s - 1) * of->d, of->d * sizeof *v);
        status = fvi_mesh_project(s, fvi_mechanism_stage_time(s, of->s - 1), x, p, v);
    }
    free(v);
    free(C);
    return status;
}

int fvi_mesh_end(const fvi_stepper *s, const fvi_variable_step_state *o, double *x, double *p)
{
    const fvi_mechanism_state *of = s->mechanism;
    const size_t d = o->d, n = o->rule->s;
    for (size_t j = 0; j < d; j++) {
        x[j] = o->y[j] + of->u[(n - 1) * d + j];
        p[j] = s->p[j];
        for (size_t i = 0; i < n; i++)
            p[j] += o->length.h * o->rule->b[i] * of->f[i * d + j];
    }
    return of->m ? subtract_constraint_momentum(s, x, p) : FVI_SUCCESS;
}

/* Return theta of the time t in the last step. */
static double theta_of_time(const fvi_stepper *s, double t)
{
    const fvi_variable_step_state *o = s->method_state;
    return s->t > o->t0 ? (t - o->t0) / (s->t - o->t0) : 0;
}

void fvi_mesh_sums(const fvi_stepper *s, size_t j, double t, double *force, double *impulse,
                   double *work)
{
    const fvi_variable_step_state *o = s->method_state;
    const struct fvi_mesh_mechanism *m = o->mechanism;
    const double theta = theta_of_time(s, t), h = s->t - o->t0;
    double w[FVI_LANES], power[FVI_LANES] = { 1 };
    fvi_variable_step_once(theta, w);
    for (size_t k = 1; k < FVI_LANES; k++)
        power[k] = theta * power[k - 1];
    const double *force0 = m->force0 + j * FVI_LANES, *power0 = m->power0 + j * FVI_LANES;
    *force = h > 0 ? combine_powers(o->rule->s, force0, power) / h : 0;
    *impulse = t == s->t ? s->mechanism->impulse[j]
                         : m->impulse0[j] + combine_powers(o->rule->s, force0, w);
    *work = t == s->t ? s->mechanism->work[j] : m->work0[j] + combine_powers(o->rule->s, power0, w);
}

double fvi_mesh_work_of_forces(const fvi_stepper *s, double t)
{
    const fvi_variable_step_state *o = s->method_state;
    const struct fvi_mesh_mechanism *m = o->mechanism;
    double w[FVI_LANES];
    fvi_variable_step_once(theta_of_time(s, t), w);
    return t == s->t ? m->by_force
                     : m->by_force_begin + combine_powers(o->rule->s, m->by_force0, w);
}

double fvi_mesh_multiplier(const fvi_stepper *s, size_t i, double t)
{
    const fvi_variable_step_state *o = s->method_state;
    const double theta = theta_of_time(s, t), h = s->t - o->t0;
    double power[FVI_LANES] = { 1 };
    for (size_t k = 1; k < FVI_LANES; k++)
        power[k] = theta * power[k - 1];
    return combine_powers(o->rule->s, o->mechanism->multiplier0 + i * FVI_LANES, power) / h;
}

int fvi_mesh_project(const fvi_stepper *s, double t, const double *x, double *p, double *v)
{
    fvi_stepper *own = (fvi_stepper *)(uintptr_t)s; /* its room is used */
    const fvi_mechanism_state *of = s->mechanism;
    double *C = calloc(of->m * (of->d + 1), sizeof *C);
    int status = C ? fvi_mechanism_tie_gradients(s, t, x, C, NULL) : FVI_ENOMEM;
    if (!status)
        status = fvi_mechanism_project_momentum(own, t, x, C, p, v, C + of->m * of->d);
    free(C);
    return status;
}

/* A contact that closed or opened at the end of the last step was open or closed within this step. */
int fvi_mesh_project_within(const fvi_stepper *s, double t, const double *x, double *p, double *v)
{
    fvi_mechanism_state *own = ((fvi_stepper *)(uintptr_t)s)->mechanism;
    int status = FVI_SUCCESS;
    fvi_mechanism_swap_contacts(own);
    if (own->m)
        status = fvi_mesh_project(s, t, x, p, v);
    fvi_mechanism_swap_contacts(own);
    return status;
}

int fvi_mesh_velocity(const fvi_stepper *s, double t, const double *x, const double *p,
                      double *v)
{
    const fvi_variable_step_state *o = s->method_state;
    double w[FVI_LANES];
    fvi_variable_step_once(theta_of_time(s, t), w);
    for (size_t j = 0; j < o->d; j++)
        v[j] = t == s->t ? o->v[j]
                         : o->v0[j]
                               + combine_powers(o->rule->s, o->accel_legendre0 + j * FVI_LANES, w);
    const fvi_mechanism_state *of = s->mechanism;
    if ((t == s->t ? of->m : of->last_m) == 0)
        return fvi_velocity_of_momentum(s->run.system, t, x, p, v);
    double *same = malloc(o->d * sizeof *same); /* p is projected already */
    if (!same)
        return FVI_ENOMEM;
    memcpy(same, p, o->d * sizeof *p);
    const int status = (t == s->t ? fvi_mesh_project : fvi_mesh_project_within)(s, t, x, same, v);
    free(same);
    return status;
}
