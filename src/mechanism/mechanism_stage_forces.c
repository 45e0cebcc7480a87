/* src/mechanism/mechanism_stage_forces.c -- Compute all forces at the stages of a step.   [H 29]
 *
 *     V = E (X - x_k) / h,     zdot = E (g(X) - g(x_k)) / h,     lambda = known + W zdot */
#include "mechanism_state.h"
#include "run/step_times.h"

#include <gsl/gsl_machine.h>
#include <math.h>

double fvi_mechanism_stage_time(const fvi_stepper *s, size_t i)
{
    const fvi_mechanism_state *o = s->mechanism;
    return o->is_on_mesh ? o->t + o->rule->c[i] * o->h
                         : ((double)s->k + o->rule->c[i]) * o->h;
}

double fvi_mechanism_inner_time(const fvi_stepper *s, size_t i)
{
    const fvi_mechanism_state *o = s->mechanism;
    const double h = o->h, left = o->is_on_mesh ? o->t : (double)s->k * h,
                 right = o->is_on_mesh ? o->t + h : (double)(s->k + 1) * h;
    return fvi_inner_time(left, right, h, fvi_mechanism_stage_time(s, i), i, o->s);
}

double fvi_mechanism_increment(const fvi_mechanism_state *o, const double *u, size_t i,
                        size_t j)
{
    return i < o->begin ? 0 : u[(i - o->begin) * o->d + j];
}

static void find_stage_positions(const fvi_stepper *s, const double *u)
{
    const fvi_mechanism_state *o = s->mechanism;
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < o->d; j++) {
            double V = 0;
            for (size_t l = o->begin; l < o->s; l++)
                V += o->E[i][l] * fvi_mechanism_increment(o, u, l, j);
            o->X[i * o->d + j] = s->x[j] + fvi_mechanism_increment(o, u, i, j);
            o->V[i * o->d + j] = V / o->h;
        }
}

/* Add to *sum the change of the elongation of damper e between x_k and stage l that is due to t alone: the mean rate of
 * both ends times the time. */
static int add_change_by_time(const fvi_stepper *s, size_t l, size_t e, double *sum)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_elongation *of = &s->run.system->mechanism->damper[e].of;
    double first, last;
    if (of->row || !of->rate)
        return FVI_SUCCESS;
    int status = of->rate(o->t, o->d, s->x, of->params, &first);
    if (!status)
        status = of->rate(fvi_mechanism_stage_time(s, l), o->d, o->X + l * o->d, of->params, &last);
    *sum += status ? 0 : o->rule->c[l] * o->h * (first + last) / 2;
    return status;
}

/* Compute change = g(X_l) - g(x_k) of damper e. On a mesh a step may be so short that this difference has lost its
 * digits. Then it is replaced by the increments times the mean gradient of both ends, which is exact up to O(u^3). The
 * replacement is used if both agree up to the rounding errors of g. */
static int find_elongation_change(const fvi_stepper *s, const double *u, size_t l, size_t e, double *change)
{
    const fvi_mechanism_state *o = s->mechanism;
    const double z = o->elongation[l * o->r + e], *first = o->G + e * o->d,
                 *last = o->gradient + (l * o->r + e) * o->d;
    double sum = 0, size = fabs(o->z[e]);
    *change = z - o->z[e];
    if (!o->is_on_mesh)
        return FVI_SUCCESS;
    for (size_t j = 0; j < o->d; j++) {
        sum += fvi_mechanism_increment(o, u, l, j) * (first[j] + last[j]) / 2;
        size += fabs(first[j] * s->x[j]);
    }
    const int status = add_change_by_time(s, l, e, &sum);
    if (!status && fabs(sum - *change) <= 4 * GSL_DBL_EPSILON * size)
        *change = sum;
    return status;
}

/* Compute zdot and lambda of every damper at every stage. */
static int evaluate_dampers(const fvi_stepper *s, const double *u)
{
    const fvi_mechanism_state *o = s->mechanism;
    const size_t n = o->s, r = o->r;
    int status = FVI_SUCCESS;
    for (size_t e = 0; e < r && !status; e++) {
        double change[FVI_STAGES] = { 0 };
        for (size_t l = o->begin; l < n && !status; l++)
            status = find_elongation_change(s, u, l, e, &change[l]);
        for (size_t i = 0; i < n; i++) {
            double slope = 0;
            for (size_t l = o->begin; l < n; l++)
                slope += o->E[i][l] * change[l];
            o->zdot[e * n + i] = slope / o->h;
        }
    }
    for (size_t e = 0; e < r; e++)
        for (size_t i = 0; i < n; i++) {
            double force = o->known[e * n + i];
            for (size_t l = 0; l < n; l++)
                force += o->W[(e * n + i) * n + l] * o->zdot[e * n + l];
            o->lambda[e * n + i] = force;
        }
    return status;
}

int fvi_mechanism_evaluate_stages(fvi_stepper *s, const double *u)
{
    const fvi_mechanism_state *o = s->mechanism;
    const size_t d = o->d, r = o->r;
    int status = FVI_SUCCESS;
    find_stage_positions(s, u);
    for (size_t i = 0; i < o->s && !status; i++) {
        status = fvi_mechanism_point(s, i, fvi_mechanism_inner_time(s, i), 1);
        if (!status)
            status = fvi_mechanism_elongations(s, fvi_mechanism_stage_time(s, i), o->X + i * d,
                                               o->elongation + i * r,
                                               o->gradient + i * r * d);
    }
    if (!status)
        status = evaluate_dampers(s, u);
    for (size_t i = 0; i < o->s && !status; i++)
        for (size_t j = 0; j < d; j++) {
            double f = o->load[i * d + j];
            for (size_t e = 0; e < r; e++)
                f -= o->gradient[(i * r + e) * d + j] * o->lambda[e * o->s + i];
            o->f[i * d + j] += f;
        }
    return status;
}

int fvi_mechanism_add_curvature(fvi_stepper *s, const double *u)
{
    const fvi_mechanism_state *o = s->mechanism;
    const fvi_mechanism *mechanism = s->run.system->mechanism;
    const size_t d = o->d, inner = o->s - o->begin;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < o->s && !status; i++) {
        double *fx = o->fx + i * d * d;
        const double *x = o->X + i * d, t = fvi_mechanism_stage_time(s, i);
        for (size_t e = 0; e < o->r && !status; e++) {
            const fvi_elongation *of = &mechanism->damper[e].of;
            if (!of->row)
                status = of->hessian(t, d, x, -o->lambda[e * o->s + i],
                                     of->params, fx);
        }
        if (o->m == 0 || i >= inner || status)
            continue;
        for (size_t l = 0; l < o->m; l++)
            o->room[l] = -u[inner * d + i * o->m + l]
                         / (o->h * o->h * o->rule->b[i]);
        status = fvi_mechanism_tie_hessians(s, t, x, o->room, fx);
    }
    return status;
}

