/* src/estimation/identification_motion.c -- Compute what the sensors show of a motion. [H 24] */
#include "identification_model.h"
#include "identification_tangent.h"

#include "system/arrays.h"

#include <fvi/error.h>
#include <fvi/lagrangian.h>
#include <fvi/methods.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Return Hermite's cubic at the share s of a step, from x and h v at its ends. */
static double hermite(double s, double x, double hv, double next, double hnext)
{
    const double r = 1 - s;
    return r * r * (1 + 2 * s) * x + s * s * (1 + 2 * r) * next
           + s * r * (r * hv - s * hnext);
}

/* Return h times the slope of that cubic. */
static double hermite_slope(double s, double x, double hv, double next, double hnext)
{
    return 6 * s * (1 - s) * (next - x) + (1 + s * (3 * s - 4)) * hv + s * (3 * s - 2) * hnext;
}

/* Return nonzero if fvi_stepper_start will accept the values. A trial of the search may be out of range, or have no
 * solution (19.2). */
static int is_possible(const fvi_estimation_model *m)
{
    const int is_plain = !m->system.matrices && !m->system.mechanism,
              may_be_massless = !m->system.matrices && m->system.mechanism;
    for (size_t i = 0; i < m->system.d; i++) {
        const double x0 = m->x0[i];
        const int has_mass = m->mass[i] > 0 || (may_be_massless && m->mass[i] == 0);
        if (!has_mass || !isfinite(m->mass[i]) || !isfinite(m->damping[i])
            || !isfinite(x0) || !isfinite(m->p0[i]))
            return 0;
        if (is_plain && !m->fit->method->paper_convention
            && !fvi_initial_history_solvable(m->run.past, m->run.alpha, m->damping[i], x0))
            return 0;
    }
    return 1;
}

/* ---- the run of one record ---- */

/* The run of a record. x and p are those before the last step of the stepper. Rows between the two ends of that step
 * are interpolated. */
typedef struct {
    fvi_run run;
    fvi_system system;
    fvi_stepper *s;
    double *x, *p;       /* x and p before the last step, d numbers each; owned, with the other arrays */
    double *hv, *hnext;  /* h v at the beginning and at the end of the last step */
    double *now;         /* x, v, t at the present row */
    int asks_velocities; /* nonzero if a sensor needs velocities; 0 if x is enough */
} motion;

static int start_motion(const fvi_estimation_model *m, size_t r, motion *o)
{
    const fvi_record record = fvi_estimation_record(m->fit, r);
    const size_t d = m->system.d;
    o->run = m->run;
    o->system = m->system;
    o->run.system = &o->system;
    if (record.x0)
        o->run.x0 = record.x0;
    if (record.p0)
        o->run.p0 = record.p0;
    if (record.force)
        o->system.force = *record.force;
    if (r > 0) {
        const double T = record.t[fvi_estimation_model_rows(m, record.n) - 1];
        o->run.steps = (size_t)fmax(1, ceil(T / m->run.h - 1e-6));
        o->run.h = T > 0 ? T / (double)o->run.steps : m->run.h;
    }
    for (size_t c = 0; c < fvi_estimation_columns(m->fit); c++)
        o->asks_velocities |= fvi_estimation_piece_of(m->fit, r, c).shows != NULL;
    /* FVI_ARRAYS sets all numbers to 0, so the velocity of a coordinate without inertia stays 0. */
    o->x = FVI_ARRAYS({ &o->x, d }, { &o->p, d }, { &o->hv, d }, { &o->hnext, d }, { &o->now, 2 * d + 1 });
    if (!o->x)
        return FVI_ENOMEM;
    const int status = fvi_stepper_start(m->fit->method, &o->run, &o->s, NULL);
    if (status)
        return status;
    memcpy(o->x, o->s->x, d * sizeof *o->x);
    memcpy(o->p, o->s->p, d * sizeof *o->p);
    return FVI_SUCCESS;
}

static void stop_motion(motion *o)
{
    fvi_stepper_free(o->s);
    free(o->x);
}

static int has_lagrangian(const motion *o)
{
    return o->system.mechanism && o->system.mechanism->lagrangian;
}

/* Compute h v from x and p at the time t. It is 0 for a mass of 0, whose velocity does not follow from p. */
static int step_velocity(const motion *o, double t, const double *x, const double *p, double *hv)
{
    const size_t d = o->system.d;
    const double h = o->run.h;
    const int is_solved = o->system.matrices || has_lagrangian(o);
    int status = FVI_SUCCESS;
    if (has_lagrangian(o))
        status = fvi_velocity_of_momentum(&o->system, t, x, p, hv);
    else if (o->system.matrices)
        status = fvi_velocity(&o->system, p, hv);
    for (size_t i = 0; i < d && !status; i++)
        hv[i] = is_solved                 ? h * hv[i]
                : o->system.mass[i] == 0 ? 0
                                         : h / o->system.mass[i] * p[i];
    return status;
}

static int is_mass_zero(const motion *o, size_t i)
{
    return !o->system.matrices && !has_lagrangian(o) && o->system.mass[i] == 0;
}

/* Interpolate x and, if it is needed, v at the time t, which lies within the last step or is the start. */
static int read_between(motion *o, double t)
{
    const size_t d = o->system.d;
    const double h = o->run.h, share = (t - o->s->t) / h + 1;
    const int is_node = o->s->k == 0 || (o->system.matrices && fabs(share - 1) < 1e-9);
    int status = is_node && !o->asks_velocities ? FVI_SUCCESS
                                                : step_velocity(o, o->s->t, o->s->x, o->s->p, o->hnext);
    if (!status && !is_node)
        status = step_velocity(o, o->s->t - h, o->x, o->p, o->hv);
    for (size_t i = 0; i < d && !status; i++) {
        const double next = o->s->x[i];
        if (is_mass_zero(o, i)) /* linear interpolation */
            o->hv[i] = o->hnext[i] = next - o->x[i];
        o->now[i] = is_node ? next
                            : hermite(share, o->x[i], o->hv[i], next, o->hnext[i]);
        o->now[d + i] = !o->asks_velocities ? 0
                        : is_node           ? o->hnext[i] / h
                                            : hermite_slope(share, o->x[i], o->hv[i], next,
                                                            o->hnext[i]) / h;
    }
    return status;
}

/* Do the same for a method that knows the motion between its steps. */
static int read_dense(motion *o, double t)
{
    const size_t d = o->system.d;
    const double last = (double)o->run.steps * o->run.h;
    int status = fvi_stepper_advance_to(o->s, fmin(t, last), o->now,
                                        o->asks_velocities ? o->p : NULL);
    if (!status && o->asks_velocities && has_lagrangian(o))
        return fvi_velocity_of_momentum(&o->system, fmin(t, last), o->now, o->p, o->now + d);
    for (size_t i = 0; i < d && !status && o->asks_velocities; i++)
        o->now[d + i] = is_mass_zero(o, i) ? 0 : o->p[i] / o->system.mass[i];
    return status;
}

//> run
/* Step until the time t is within the last step, and read the motion there. */
static int advance(const fvi_estimation_model *m, motion *o, double t)
{
    const size_t bytes = o->system.d * sizeof *o->x;
    int status = FVI_SUCCESS;
    if (m->fit->method->dense)
        return read_dense(o, t);
    while (o->s->t < t - 1e-9 * o->run.h && o->s->k < o->run.steps && !status) {
        memcpy(o->x, o->s->x, bytes);
        memcpy(o->p, o->s->p, bytes);
        status = fvi_stepper_step(o->s);
    }
    return status ? status : read_between(o, t);
}

static int run_record(fvi_estimation_model *m, size_t r)
{
    const fvi_record record = fvi_estimation_record(m->fit, r);
    const size_t rows = fvi_estimation_model_rows(m, record.n);
    motion o = { .s = NULL };
    int status = start_motion(m, r, &o);
    for (size_t i = 0; i < rows && !status; i++) {
        const double t = record.t[i];
        status = advance(m, &o, t);
        o.now[2 * m->system.d] = t;
        for (size_t c = 0; c < fvi_estimation_columns(m->fit); c++) {
            const fvi_estimation_piece p = fvi_estimation_piece_of(m->fit, r, c);
            m->motion[p.first + i] =
                (p.shows ? fvi_expression_value(p.shows, o.now) : o.now[0])
                + (m->offset[c] + m->drift[c] * t);
        }
    }
    m->reached = o.s ? o.s->t : 0;
    stop_motion(&o);
    return status;
}
//< run

/* Record why a motion failed, and return its status. A lack of memory says nothing about the parameters, so it ends the
 * fit. Several motions that took all the steps that they may take end it, too. */
static int ended_by(fvi_estimation_model *m, int status)
{
    if (status == FVI_ENOMEM)
        m->ended = status;
    if (fvi_is_own_code(status))
        m->callback_status = status;
    if (status == FVI_ERUNAWAY && ++m->ran_away == FVI_FIT_RUNAWAYS)
        m->ended = status;
    return status;
}

int fvi_estimation_model_run(fvi_estimation_model *m)
{
    int status = FVI_SUCCESS;
    if (m->ended)
        return m->ended;
    if (!is_possible(m)) /* otherwise fvi_stepper_start would call the error handler */
        return ended_by(m, FVI_EDOM);
    for (size_t r = 0; r < fvi_estimation_records(m->fit) && !status; r++)
        status = run_record(m, r);
    return ended_by(m, status);
}

/* ---- its slopes ---- */

int fvi_estimation_model_has_tangents(const fvi_estimation_model *m)
{
    const fvi_estimation *fit = m->fit;
    const size_t constants =
        fvi_parameter_gradient_of(&fit->run->system->potential).count;
    const fvi_method *method = fit->method;
    int known = (method->scheme == FVI_SCHEME_LOBATTO
                 || method->scheme == FVI_SCHEME_FVI)
                && !fit->run->law && m->system.d == 1 && !m->system.mechanism
                && !m->system.matrices && fit->records == 0;
    for (size_t j = 0; j < fit->parameters; j++)
        known &= fit->which[j] < FVI_FREE_PARAMETER_CONSTANT + constants;
    return known;
}

//> tangents
/* Interpolate the derivatives of x, because Hermite's cubic is linear in x and v at its ends. before: the derivatives
 * dx and pi a step before. */
static void read_slopes(const fvi_estimation_model *m, const fvi_estimation_tangents *o,
                        double share, double p_before, const double *before,
                        double *slope)
{
    const size_t P = o->P;
    const double mass = m->mass[0], drift = m->run.h / mass, p = o->of.stepper->p[0];
    for (size_t j = 0; j < P; j++) {
        const double by =
            o->which[j] == FVI_FREE_PARAMETER_MASS ? -drift / mass : 0;
        slope[j] =
            hermite(share, before[j], drift * before[P + j] + by * p_before,
                                   o->of.dx[j], drift * o->of.pi[j] + by * p);
    }
}

static int run_tangents(const fvi_estimation_model *m, double *slope)
{
    fvi_estimation_tangents o;
    const size_t P = m->fit->parameters;
    const double h = m->run.h;
    double before[2 * FVI_ESTIMATION_MOST] = { 0 }, p_before = 0;
    if (!is_possible(m))
        return FVI_EDOM;
    /* Differences are used then, so the error handler is not called. */
    if (m->fit->method->stages && m->run.alpha == 1)
        return FVI_EUNSUP;
    int status =
        fvi_estimation_tangents_start(m->fit->method, &m->run, P, m->fit->which, &o);
    const fvi_stepper *s = o.of.stepper;
    const size_t rows = fvi_estimation_model_rows(m, m->fit->n);
    for (size_t i = 0; i < rows && !status; i++, slope += P) {
        const double t = m->fit->t[i];
        while (s->t < t - 1e-9 * h && s->k < m->run.steps
               && !status) {
            memcpy(before, o.of.dx, 2 * P * sizeof *before); /* pi follows dx in memory */
            p_before = s->p[0];
            status = fvi_tangent_step(&o.of);
        }
        const int first = s->k == 0;
        read_slopes(m, &o, first ? 1 : (t - s->t) / h + 1, p_before,
                    before, slope);
        for (size_t j = 0; j < P; j++)
            slope[j] += o.which[j] == FVI_FREE_PARAMETER_OFFSET  ? 1
                        : o.which[j] == FVI_FREE_PARAMETER_DRIFT ? t
                                                                 : 0;
    }
    fvi_estimation_tangents_stop(&o);
    return status;
}

int fvi_estimation_model_tangents(fvi_estimation_model *m, double *slope)
{
    return m->ended ? m->ended : ended_by(m, run_tangents(m, slope));
}
//< tangents
