/* src/estimation/rheology_search.c -- Find the least squares of a law.         [H 24] */
#include "rheology_search.h"

#include "system/dot.h"
#include "system/larger.h"

#include <math.h>
#include <string.h>

enum { ITERATIONS = 150, TRIES = 12 };
#define LONGEST 2 /* longest step, in units of scale: 0.2 for an order, a factor of 7 for a time */
#define AMPLITUDES 40 /* largest change of ln c from where it began */

/* ---- one problem, of u alone or of z ---- */

/* P numbers x within bounds. `evaluate` computes residuals and Jacobian, whose columns are those of the model from
 * `first` on. */
typedef struct {
    fvi_rheology *model;
    int projects; /* nonzero: x is u, and the best amplitudes are found for each u */
    size_t P, first;
    double low[FVI_LAW_MOST], high[FVI_LAW_MOST], scale[FVI_LAW_MOST];
    double c[FVI_MATERIAL_ELEMENTS];
    fvi_rheology_constraint *v;
    const void *params;
    double target;
} problem;

static double evaluate(problem *p, const double *x, double *r, int with_slopes)
{
    const double sum = p->projects ? fvi_rheology_project(p->model, x, p->c, r, with_slopes)
                                   : fvi_rheology_residuals(p->model, x, r, with_slopes);
    return isfinite(sum) ? sum : INFINITY;
}

/* Compute the normal equations from residuals and Jacobian. A number at a bound stays there if the descent would leave
 * the bounds. */
static void normal_equations(const problem *p, const double *x, double A[][FVI_LAW_MOST],
                             double *b, int *stays)
{
    const fvi_rheology *o = p->model;
    fvi_rheology_products(o, p->first, p->P, A);
    for (size_t i = 0; i < p->P; i++) {
        b[i] = -fvi_dot(o->rows, fvi_rheology_column(o, p->first + i), o->r);
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
    fvi_rheology *o = p->model;
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
            const double there = evaluate(p, next, o->trial, 0);
            if (there <= *sum * (1 + 1e-14)) {
                *change = 0;
                for (size_t i = 0; i < p->P; i++)
                    *change = larger(*change, fabs(next[i] - x[i]) / p->scale[i]);
                memcpy(x, next, p->P * sizeof *x);
                *lambda = fmax(*lambda / 10, 1e-15);
                *sum = evaluate(p, x, o->r, 1);
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
    double sum = evaluate(p, x, p->model->r, 1);
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

static problem problem_of_all(fvi_rheology *o, const double *z)
{
    problem p = { .model = o, .P = o->elements + o->shapes };
    for (size_t n = 0; n < o->elements; n++) {
        p.low[n] = z[n] - AMPLITUDES;
        p.high[n] = z[n] + AMPLITUDES;
        p.scale[n] = 1;
    }
    bound_shapes(o, o->elements, &p);
    return p;
}

double fvi_rheology_descend(fvi_rheology *o, fvi_rheology_constraint *v, const void *params,
                            double target, double *z)
{
    problem p = problem_of_all(o, z);
    p.v = v;
    p.params = params;
    p.target = target;
    return descend(&p, z);
}

/* Multiply all amplitudes by one factor, by which creep is divided. The factor follows from linear least squares. */
static void scale_creep(fvi_rheology *o, double *z)
{
    double xy = 0, xx = 0;
    fvi_rheology_residuals(o, z, o->r, 0);
    for (size_t i = 0; i < o->rows; i++) {
        const double x = o->r[i] + o->y[i];
        xy += x * o->y[i];
        xx += x * x;
    }
    for (size_t n = 0; n < o->elements; n++)
        z[n] -= xy > 0 && xx > 0 ? log(xy / xx) : 0;
}

double fvi_rheology_search(fvi_rheology *o, const double *u, const double *random, double *z)
{
    const size_t E = o->elements;
    memcpy(z + E, u, o->shapes * sizeof *u);
    if (o->data->test == FVI_MATERIAL_CREEP) {
        for (size_t n = 0; n < E; n++)
            z[n] = 6 * random[n] - 3;
        scale_creep(o, z);
        return fvi_rheology_descend(o, NULL, NULL, 0, z);
    }
    problem p = { .model = o, .projects = 1, .P = o->shapes, .first = E };
    bound_shapes(o, 0, &p);
    const double sum = descend(&p, z + E);
    fvi_rheology_project(o, z + E, p.c, o->r, 0);
    for (size_t n = 0; n < E; n++)
        z[n] = log(p.c[n]); /* minus infinity for an amplitude of 0: the element is not needed */
    return sum;
}
