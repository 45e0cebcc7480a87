/* src/estimation/rheology_search.c -- Find the least squares of a law.         [H 24] */
#include "rheology_search.h"

#include <fvi/error.h>
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ITERATIONS = 150, TRIES = 12 };
#define LONGEST 2 /* longest step, in units of scale: 0.2 for an order, a factor of 7 for a time */
#define AMPLITUDES 40 /* largest change of ln c from where it began */

int fvi_rheology_work_alloc(const fvi_material_data *data, fvi_rheology_work *o)
{
    *o = (fvi_rheology_work){ .r = NULL };
    int status = fvi_rheology_alloc(data, &o->model);
    if (status)
        return status;
    const size_t rows = o->model.rows, P = o->model.elements + o->model.shapes;
    o->block = malloc(rows * (2 + P) * sizeof *o->block);
    if (!o->block)
        return FVI_ENOMEM;
    o->r = o->block;
    o->trial = o->r + rows;
    o->J = o->trial + rows;
    return FVI_SUCCESS;
}

void fvi_rheology_work_free(fvi_rheology_work *o)
{
    fvi_rheology_free(&o->model);
    free(o->block);
}

/* ---- one problem, of u alone or of z ---- */

/* P numbers x within bounds. `evaluate` computes residuals and Jacobian. */
typedef struct {
    fvi_rheology_work *work;
    int projects; /* nonzero: x is u, and the best amplitudes are found for each u */
    size_t P;
    double low[FVI_LAW_MOST], high[FVI_LAW_MOST], scale[FVI_LAW_MOST];
    double c[FVI_MATERIAL_ELEMENTS];
    fvi_rheology_constraint *v;
    const void *params;
    double target;
} problem;

static double evaluate(problem *p, const double *x, double *r, double *J)
{
    fvi_rheology *m = &p->work->model;
    const double sum = p->projects ? fvi_rheology_project(m, x, p->c, r, J)
                                   : fvi_rheology_residuals(m, x, r, J);
    return isfinite(sum) ? sum : INFINITY;
}

/* Compute the normal equations from r and J. A number at a bound stays there if the descent would leave the bounds. */
static void normal_equations(const problem *p, const double *x, double A[][FVI_LAW_MOST],
                             double *b, int *stays)
{
    const fvi_rheology_work *o = p->work;
    const size_t P = p->P, rows = o->model.rows;
    fvi_rheology_products(rows, P, o->J, A);
    for (size_t i = 0; i < P; i++) {
        b[i] = 0;
        for (size_t k = 0; k < rows; k++)
            b[i] -= o->J[k * P + i] * o->r[k];
        stays[i] = (x[i] <= p->low[i] && b[i] < 0) || (x[i] >= p->high[i] && b[i] > 0);
    }
}

/* Compute a step of Levenberg and Marquardt. With a constraint the step must satisfy g . step = missing: it is
 * corrected along M^-1 g, which is the shortest correction in the metric of the damped matrix M. */
static int step_along(const problem *p, double A[][FVI_LAW_MOST], const double *b, const int *stays,
                      double lambda, const double *g, double missing, double *step)
{
    const size_t P = p->P;
    double M[FVI_LAW_MOST][FVI_LAW_MOST], along[FVI_LAW_MOST];
    for (size_t i = 0; i < P; i++) {
        for (size_t j = 0; j < P; j++)
            M[i][j] = stays[i] || stays[j] ? 0 : A[i][j];
        M[i][i] = stays[i] ? 1
                           : A[i][i] * (1 + lambda) + lambda * 1e-6 / (p->scale[i] * p->scale[i])
                                 + 1e-300;
        step[i] = stays[i] ? 0 : b[i];
        along[i] = stays[i] ? 0 : g[i];
    }
    double copy[FVI_LAW_MOST][FVI_LAW_MOST];
    memcpy(copy, M, sizeof M);
    if (!fvi_rheology_solve(P, 0, M, step))
        return 0;
    if (!p->v)
        return 1;
    if (!fvi_rheology_solve(P, 0, copy, along))
        return 0;
    double gg = 0, gs = 0;
    for (size_t i = 0; i < P; i++) {
        gg += stays[i] ? 0 : g[i] * along[i];
        gs += g[i] * step[i];
    }
    for (size_t i = 0; i < P && gg > 0; i++)
        step[i] += along[i] * (missing - gs) / gg;
    return 1;
}

static void clip_to_bounds(const problem *p, double *x)
{
    for (size_t i = 0; i < p->P; i++)
        x[i] = fmin(fmax(x[i], p->low[i]), p->high[i]);
}

/* Go back onto the constraint, whose slope is nearly constant. */
static void project_on_constraint(const problem *p, double *x)
{
    double g[FVI_LAW_MOST];
    for (int times = 0; p->v && times < 3; times++) {
        const double missing = p->target - p->v(p->params, x, g);
        double gg = 0;
        for (size_t i = 0; i < p->P; i++)
            gg += g[i] * g[i] * p->scale[i] * p->scale[i];
        for (size_t i = 0; i < p->P && gg > 0; i++)
            x[i] += missing * g[i] * p->scale[i] * p->scale[i] / gg;
        clip_to_bounds(p, x);
    }
}

/* Make a step that does not increase the sum. Return 0 if none is found. */
static int advance(problem *p, double *x, double *sum, double *lambda, double *change)
{
    fvi_rheology_work *o = p->work;
    double A[FVI_LAW_MOST][FVI_LAW_MOST], b[FVI_LAW_MOST], g[FVI_LAW_MOST] = { 0 },
        step[FVI_LAW_MOST];
    int stays[FVI_LAW_MOST];
    normal_equations(p, x, A, b, stays);
    const double missing = p->v ? p->target - p->v(p->params, x, g) : 0;
    for (int tries = 0; tries < TRIES; tries++) {
        double next[FVI_LAW_MOST];
        if (step_along(p, A, b, stays, *lambda, g, missing, step)) {
            for (size_t i = 0; i < p->P; i++)
                next[i] = x[i] + fmin(fmax(step[i], -LONGEST * p->scale[i]), LONGEST * p->scale[i]);
            clip_to_bounds(p, next);
            project_on_constraint(p, next);
            const double there = evaluate(p, next, o->trial, NULL);
            if (there <= *sum * (1 + 1e-14)) {
                *change = 0;
                for (size_t i = 0; i < p->P; i++)
                    *change = larger(*change, fabs(next[i] - x[i]) / p->scale[i]);
                memcpy(x, next, p->P * sizeof *x);
                *lambda = fmax(*lambda / 10, 1e-15);
                *sum = evaluate(p, x, o->r, o->J);
                return 1;
            }
        }
        *lambda = fmax(*lambda * 10, 1e-9);
    }
    return 0;
}

static double descend(problem *p, double *x)
{
    double lambda = 1e-2, change = INFINITY;
    clip_to_bounds(p, x);
    project_on_constraint(p, x);
    double sum = evaluate(p, x, p->work->r, p->work->J);
    for (int i = 0; i < ITERATIONS && sum < INFINITY; i++) {
        const double before = sum;
        if (!advance(p, x, &sum, &lambda, &change))
            break;
        if (change < 1e-9 || (before - sum <= 1e-13 * sum && change < 1e-4))
            break;
    }
    return sum;
}

/* ---- both problems ---- */

static void bound_shapes(const fvi_rheology *m, size_t from, problem *p)
{
    memcpy(p->low + from, m->low, m->shapes * sizeof *m->low);
    memcpy(p->high + from, m->high, m->shapes * sizeof *m->high);
    memcpy(p->scale + from, m->scale, m->shapes * sizeof *m->scale);
}

static problem problem_of_all(fvi_rheology_work *o, const double *z)
{
    problem p = { .work = o, .P = o->model.elements + o->model.shapes };
    for (size_t n = 0; n < o->model.elements; n++) {
        p.low[n] = z[n] - AMPLITUDES;
        p.high[n] = z[n] + AMPLITUDES;
        p.scale[n] = 1;
    }
    bound_shapes(&o->model, o->model.elements, &p);
    return p;
}

double fvi_rheology_descend(fvi_rheology_work *o, fvi_rheology_constraint *v, const void *params,
                            double target, double *z)
{
    problem p = problem_of_all(o, z);
    p.v = v;
    p.params = params;
    p.target = target;
    return descend(&p, z);
}

/* Multiply all amplitudes by one factor, by which creep is divided. The factor follows from linear least squares. */
static void scale_creep(fvi_rheology_work *o, double *z)
{
    fvi_rheology *m = &o->model;
    double xy = 0, xx = 0;
    fvi_rheology_residuals(m, z, o->r, NULL);
    for (size_t i = 0; i < m->rows; i++) {
        const double x = o->r[i] + m->y[i];
        xy += x * m->y[i];
        xx += x * x;
    }
    for (size_t n = 0; n < m->elements; n++)
        z[n] -= xy > 0 && xx > 0 ? log(xy / xx) : 0;
}

double fvi_rheology_search(fvi_rheology_work *o, const double *u, const double *random, double *z)
{
    const fvi_rheology *m = &o->model;
    const size_t E = m->elements;
    memcpy(z + E, u, m->shapes * sizeof *u);
    if (m->data->test == FVI_MATERIAL_CREEP) {
        for (size_t n = 0; n < E; n++)
            z[n] = 6 * random[n] - 3;
        scale_creep(o, z);
        return fvi_rheology_descend(o, NULL, NULL, 0, z);
    }
    problem p = { .work = o, .projects = 1, .P = m->shapes };
    bound_shapes(m, 0, &p);
    const double sum = descend(&p, z + E);
    fvi_rheology_project(&o->model, z + E, p.c, o->r, NULL);
    for (size_t n = 0; n < E; n++)
        z[n] = log(p.c[n]); /* minus infinity for an amplitude of 0: the element is not needed */
    return sum;
}
