/* src/estimation/identification_model.c -- The motion as a function of its parameters.
 *                                                                     [H 24] */
#include "identification_model.h"
#include "identification_tangent.h"
#include "system/fail.h"
#include "system/larger.h"

#include <fvi/error.h>

#include <math.h>
#include <string.h>

/* Is parameter j a number of the law? */
static int is_of_law(const fvi_estimation_model *m, size_t j)
{
    return m->fit->which[j] >= FVI_FREE_PARAMETER_LAW
           && m->fit->which[j] < FVI_FREE_PARAMETER_CONSTANT;
}

void fvi_estimation_model_init(fvi_estimation_model *m, const fvi_estimation *fit, double *motion)
{
    double size = 0;
    *m = (fvi_estimation_model){ .fit = fit, .motion = motion };
    m->mass = fit->run->system->mass[0];
    m->damping = fit->run->system->damping[0];
    m->x0 = fit->run->x0[0];
    m->p0 = fit->run->p0[0];
    m->system = *fit->run->system;
    m->system.mass = &m->mass;
    m->system.damping = &m->damping;
    m->run = *fit->run;
    if (m->run.most_steps == 0)
        m->run.most_steps = FVI_FIT_MOST_STEPS;
    m->run.system = &m->system;
    m->run.x0 = &m->x0;
    m->run.p0 = &m->p0;
    m->rows = fit->n;
    for (size_t j = 0; j < fit->parameters; j++)
        if (is_of_law(m, j)) {
            m->law = (fvi_kernel){ fit->run->law->count, m->term };
            memcpy(m->term, fit->run->law->term, m->law.count * sizeof *m->term);
            m->run.law = &m->law;
        }
    for (size_t i = 0; i < fit->n; i++)
        size = larger(size, fabs(fit->x[i]));
    m->scale = fit->sigma > 0 ? fit->sigma : size > 0 ? size : 1;
    m->hopeless = 1e8 * fmax(1, size / m->scale);
}

void fvi_estimation_model_step(fvi_estimation_model *m, double h)
{
    const double T = m->fit->t[m->rows - 1];
    m->run.steps = (size_t)ceil(T / h - 1e-6);
    m->run.h = T / (double)m->run.steps;
}

/* ---- one parameter ---- */

fvi_estimation_kind fvi_estimation_kind_of(fvi_free_parameter which)
{
    if (which == FVI_FREE_PARAMETER_ALPHA)
        return FVI_ESTIMATION_ORDER;
    if (which == FVI_FREE_PARAMETER_RHO || which == FVI_FREE_PARAMETER_MASS)
        return FVI_ESTIMATION_SIZE;
    if (which < FVI_FREE_PARAMETER_LAW || which >= FVI_FREE_PARAMETER_CONSTANT)
        return FVI_ESTIMATION_NUMBER;
    return (which - FVI_FREE_PARAMETER_LAW) % 2 ? FVI_ESTIMATION_ORDER /* alpha, end */
                                                : FVI_ESTIMATION_SIZE;
}

/* A number of the law. Of two springpots in series time is r1 / r2, and the third number r2. */
static double get_law(const fvi_estimation_model *m, size_t which)
{
    const fvi_kernel_term *t = &m->term[which / 4];
    switch (which % 4) {
    case 0:
        return t->rho;
    case 1:
        return t->alpha;
    case 2:
        return t->kind == FVI_KERNEL_MAXWELL2 ? t->rho / t->time : t->time;
    default:
        return t->end;
    }
}

static void set_law(fvi_estimation_model *m, size_t which, double theta)
{
    fvi_kernel_term *t = &m->term[which / 4];
    switch (which % 4) {
    case 0:
        if (t->kind == FVI_KERNEL_MAXWELL2)
            t->time *= theta / t->rho;
        t->rho = theta;
        break;
    case 1:
        t->alpha = theta;
        break;
    case 2:
        t->time = t->kind == FVI_KERNEL_MAXWELL2 ? t->rho / theta : theta;
        break;
    default:
        t->end = theta;
    }
}

static double *place(fvi_estimation_model *m, size_t j)
{
    const fvi_free_parameter which = m->fit->which[j];
    switch (which) {
    case FVI_FREE_PARAMETER_ALPHA:
        return &m->run.alpha;
    case FVI_FREE_PARAMETER_RHO:
        return &m->damping;
    case FVI_FREE_PARAMETER_MASS:
        return &m->mass;
    case FVI_FREE_PARAMETER_X0:
        return &m->x0;
    case FVI_FREE_PARAMETER_P0:
        return &m->p0;
    case FVI_FREE_PARAMETER_OFFSET:
        return &m->offset;
    case FVI_FREE_PARAMETER_DRIFT:
        return &m->drift;
    default:
        return &m->fit->constants[which - FVI_FREE_PARAMETER_CONSTANT];
    }
}

double fvi_estimation_model_get(const fvi_estimation_model *m, size_t j)
{
    return is_of_law(m, j) ? get_law(m, m->fit->which[j] - FVI_FREE_PARAMETER_LAW)
                           : *place((fvi_estimation_model *)m, j);
}

void fvi_estimation_model_set(fvi_estimation_model *m, size_t j, double theta)
{
    if (is_of_law(m, j))
        set_law(m, m->fit->which[j] - FVI_FREE_PARAMETER_LAW, theta);
    else
        *place(m, j) = theta; /* in *m, or in fit->constants */
}

/* The orders that are possible for parameter j, which is one. */
static void orders(const fvi_estimation_model *m, size_t j, double *low, double *high)
{
    *low = is_of_law(m, j) ? 0 : m->fit->method->alpha_least;
    *high = is_of_law(m, j) ? 1 : m->fit->method->alpha_most;
}

//> bound
double fvi_estimation_model_bound(const fvi_estimation_model *m, size_t j, double u)
{
    double low, high;
    switch (fvi_estimation_kind_of(m->fit->which[j])) {
    case FVI_ESTIMATION_ORDER:
        orders(m, j, &low, &high);
        return low + (high - low) / (1 + exp(-u));
    case FVI_ESTIMATION_SIZE:
        return exp(u);
    default:
        return u;
    }
}
//< bound

double fvi_estimation_model_free(const fvi_estimation_model *m, size_t j, double theta)
{
    double low, high;
    switch (fvi_estimation_kind_of(m->fit->which[j])) {
    case FVI_ESTIMATION_ORDER:
        orders(m, j, &low, &high);
        return log((theta - low) / (high - theta));
    case FVI_ESTIMATION_SIZE:
        return log(theta);
    default:
        return theta;
    }
}

double fvi_estimation_model_slope(const fvi_estimation_model *m, size_t j, double theta)
{
    double low, high;
    switch (fvi_estimation_kind_of(m->fit->which[j])) {
    case FVI_ESTIMATION_ORDER:
        orders(m, j, &low, &high);
        return (theta - low) * (high - theta) / (high - low);
    case FVI_ESTIMATION_SIZE:
        return theta;
    default:
        return 1;
    }
}

/* ---- the motion ---- */

/* Hermite's cubic at s of a step: x and h v at its ends. */
static double hermite(double s, double x, double hv, double next, double hnext)
{
    const double r = 1 - s;
    return r * r * (1 + 2 * s) * x + s * s * (1 + 2 * r) * next
           + s * r * (r * hv - s * hnext);
}

/* A trial may be out of range, or have no solution (19.2). */
static int is_possible(const fvi_estimation_model *m)
{
    return m->mass > 0 && isfinite(m->mass) && isfinite(m->damping)
           && isfinite(m->x0) && isfinite(m->p0)
           && (m->fit->method->paper_convention
               || fvi_initial_history_solvable(m->run.past, m->run.alpha, m->damping,
                                        m->x0));
}

//> run
static int run_motion(fvi_estimation_model *m)
{
    fvi_stepper *s;
    if (!is_possible(m)) /* what fvi_stepper_start would tell the handler */
        return FVI_EDOM;
    int status = fvi_stepper_start(m->fit->method, &m->run, &s, NULL);
    if (status)
        return status;
    const double h = m->run.h, drift = h / m->mass;
    double x = s->x[0], p = s->p[0]; /* a step before s */
    for (size_t i = 0; i < m->rows && !status; i++) {
        const double t = m->fit->t[i];
        if (m->fit->method->dense) { /* it has the motion between its steps */
            status = fvi_stepper_advance_to(s, fmin(t, (double)m->run.steps * h),
                                m->motion + i, NULL);
            continue;
        }
        while (s->t < t - 1e-9 * h && s->k < m->run.steps && !status) {
            x = s->x[0];
            p = s->p[0];
            status = fvi_stepper_step(s);
        }
        m->motion[i] = s->k > 0 ? hermite((t - s->t) / h + 1, x, drift * p,
                                          s->x[0], drift * s->p[0])
                                : s->x[0];
    }
    m->reached = s->t;
    fvi_stepper_free(s);
    for (size_t i = 0; i < m->rows; i++)
        m->motion[i] += m->offset + m->drift * m->fit->t[i];
    return status;
}
//< run

/* A motion for which there was no memory is no bad one: the fit ends. So it does after some that
 * took all the steps that they may. */
static int ended_by(fvi_estimation_model *m, int status)
{
    if (status == FVI_ENOMEM)
        m->ended = status;
    if (fvi_is_own_code(status))
        m->own = status;
    if (status == FVI_ERUNAWAY && ++m->ran_away == FVI_FIT_RUNAWAYS)
        m->ended = status;
    return status;
}

int fvi_estimation_model_run(fvi_estimation_model *m)
{
    return m->ended ? m->ended : ended_by(m, run_motion(m));
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
                && !fit->run->law;
    for (size_t j = 0; j < fit->parameters; j++)
        known &= fit->which[j] < FVI_FREE_PARAMETER_CONSTANT + constants;
    return known;
}

//> tangents
/* Hermite's cubic is linear in what it is made of. before: s and pi a step before. */
static void read_slopes(const fvi_estimation_model *m, const fvi_tangent_run *o,
                        double share, double p_before, const double *before,
                        double *slope)
{
    const size_t P = o->P;
    const double drift = m->run.h / m->mass, p = o->stepper->p[0];
    for (size_t j = 0; j < P; j++) {
        const double by =
            o->which[j] == FVI_FREE_PARAMETER_MASS ? -drift / m->mass : 0;
        slope[j] =
            hermite(share, before[j], drift * before[P + j] + by * p_before,
                    o->s[j], drift * o->pi[j] + by * p);
    }
}

static int run_tangents(const fvi_estimation_model *m, double *slope)
{
    fvi_tangent_run o;
    const size_t P = m->fit->parameters;
    const double h = m->run.h;
    double before[2 * FVI_ESTIMATION_MOST] = { 0 }, p_before = 0;
    if (!is_possible(m))
        return FVI_EDOM;
    int status =
        fvi_tangent_start(m->fit->method, &m->run, P, m->fit->which, &o);
    for (size_t i = 0; i < m->rows && !status; i++, slope += P) {
        const double t = m->fit->t[i];
        while (o.stepper->t < t - 1e-9 * h && o.stepper->k < m->run.steps
               && !status) {
            memcpy(before, o.s, 2 * P * sizeof *before); /* pi is behind s */
            p_before = o.stepper->p[0];
            status = fvi_tangent_step(&o);
        }
        const int first = o.stepper->k == 0;
        read_slopes(m, &o, first ? 1 : (t - o.stepper->t) / h + 1, p_before,
                    before, slope);
        for (size_t j = 0; j < P; j++)
            slope[j] += o.which[j] == FVI_FREE_PARAMETER_OFFSET  ? 1
                        : o.which[j] == FVI_FREE_PARAMETER_DRIFT ? t
                                                                 : 0;
    }
    fvi_tangent_stop(&o);
    return status;
}

int fvi_estimation_model_tangents(fvi_estimation_model *m, double *slope)
{
    return m->ended ? m->ended : ended_by(m, run_tangents(m, slope));
}
//< tangents
