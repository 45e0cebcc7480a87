/* src/observer/observer_motion.c -- Accelerations and multipliers of a mechanism from its equation of motion. [H 29]
 *
 *     L_vv a + C^T lambda = L_x - L_xv^T v - L_vt + F - the forces of the dampers,
 *     C a                 = -(v^T c_xx v + 2 C_t v + c_tt).                   (29.23)
 *
 * The second line is the second derivative by t of c(x, t) = 0. Differences of velocities and of impulses need rows
 * before them. The first rows have too few rows before them, and the equation of motion needs none. */
#include "observer_state.h"

#include "mechanism/mechanism_state.h"
#include "system/arrays.h"
#include "system/lagrangian_point.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The arrays for one time; n = d + m. All arrays of numbers stand in one block. */
typedef struct {
    const fvi_system *system;
    size_t d, m, n;
    double t;
    const double *x;
    double *numbers;
    double *v, *G, *Q, *C, *Lxv, *Lvv, *H, *J, *r, *w;
    double *damper; /* the forces of the dampers */
    size_t *order;
} point;

static int allocate(point *o, size_t dampers)
{
    const size_t d = o->d, m = o->m, n = o->n = d + m;
    o->numbers = FVI_ARRAYS({ &o->v, d }, { &o->G, d }, { &o->Q, d }, { &o->C, m * d }, { &o->Lxv, d * d },
                            { &o->Lvv, d * d }, { &o->H, d * d }, { &o->J, n * n }, { &o->r, n }, { &o->w, n },
                            { &o->damper, dampers });
    o->order = calloc(n, sizeof *o->order);
    return o->numbers && o->order ? FVI_SUCCESS : FVI_ENOMEM;
}

/* Replace r by the solution y of [L_vv C^T; C 0] y = r. */
static int solve(point *o)
{
    const size_t d = o->d, n = o->n;
    memset(o->J, 0, n * n * sizeof *o->J);
    for (size_t i = 0; i < d; i++) {
        memcpy(o->J + i * n, o->Lvv + i * d, d * sizeof *o->J);
        for (size_t l = 0; l < o->m; l++)
            o->J[i * n + d + l] = o->J[(d + l) * n + i] = o->C[l * d + i];
    }
    return fvi_solve_matrix(n, o->J, o->r, o->order);
}

/* ---- derivatives by t alone ---- */

/* Write L_v, d numbers, and 2 C v + c_t, m numbers, at the time t and at the same x and v. */
static int evaluate_explicit_terms(point *o, double t, double *value)
{
    const fvi_constraints *c = o->system->mechanism->constraints;
    const size_t d = o->d;
    int status = fvi_lagrangian_point(o->system, t, o->x, o->v, NULL, NULL, value, NULL, NULL, NULL);
    if (!status && o->m > 0)
        status = c->gradient(t, d, o->x, c->params, o->H, value + d);
    for (size_t l = 0; l < o->m; l++)
        for (size_t i = 0; i < d; i++)
            value[d + l] += 2 * o->H[l * d + i] * o->v[i];
    return status;
}

enum { LEVELS = 14 };

/* The derivative by t of column i of a table of differences f(t + e) - f(t), in which e is halved from row to row. It
 * is Richardson's extrapolation, up to the row where the change and the rounding error of f, whose size is `size`, are
 * least. */
static double extrapolate(const double *differences, size_t n, size_t i, double e, double size)
{
    double row[LEVELS] = { 0 }, best = 0, least = INFINITY;
    for (size_t k = 0; k < LEVELS; k++, e /= 2) {
        double before = row[0], factor = 2;
        const double last = k > 0 ? row[k - 1] : 0;
        row[0] = differences[k * n + i] / e;
        for (size_t j = 1; j <= k; j++, factor *= 2) {
            const double better = row[j - 1] + (row[j - 1] - before) / (factor - 1);
            before = row[j];
            row[j] = better;
        }
        const double change = fabs(row[k] - last) + 4 * DBL_EPSILON * size / fabs(e);
        if (k > 0 && change < least) {
            least = change;
            best = row[k];
        }
    }
    return best;
}

/* Subtract the derivatives of the explicit terms by t from r, by differences between t and t + e. */
static int subtract_explicit_slopes(point *o, double e)
{
    const size_t n = o->n;
    double *table = calloc((LEVELS + 1) * n, sizeof *table), *now = table + LEVELS * n;
    int status = table ? evaluate_explicit_terms(o, o->t, now) : FVI_ENOMEM;
    double most = 0;
    for (size_t k = 0; k < LEVELS && !status && (k < 2 || most > 0); k++) {
        status = evaluate_explicit_terms(o, o->t + ldexp(e, -(int)k), table + k * n);
        for (size_t i = 0; i < n && !status; i++) {
            table[k * n + i] -= now[i];
            most += fabs(table[k * n + i]);
        }
    }
    for (size_t i = 0; i < n && !status && most > 0; i++)
        o->r[i] -= extrapolate(table, n, i, e, fabs(now[i]) + fabs(table[i]));
    free(table);
    return status;
}

/* ---- the equation ---- */

/* r -= factor_j G_j for all dampers j. */
static int subtract_dampers(point *o, const double *factor, const double *rate)
{
    const fvi_mechanism *m = o->system->mechanism;
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < m->damper_count && !status; j++) {
        const fvi_elongation *of = &m->damper[j].of;
        const double *G = of->row ? of->row : o->G;
        if (!of->row)
            status = of->gradient(o->t, o->d, o->x, of->params, o->G);
        for (size_t i = 0; i < o->d && !status; i++)
            o->r[i] -= factor[j] * (rate ? rate[j] : 1) * G[i];
    }
    return status;
}

/* Write L_vv, L_xv and C at the point, and L_x to r. */
static int evaluate(point *o)
{
    const fvi_constraints *c = o->system->mechanism->constraints;
    const int status = fvi_lagrangian_point(o->system, o->t, o->x, o->v, NULL, o->r, NULL, NULL, o->Lxv, o->Lvv);
    return status || o->m == 0 ? status : c->gradient(o->t, o->d, o->x, c->params, o->C, NULL);
}

/* The first steps subtract too little from p (13.18), so v has an error, too. Write the correction of v, within the
 * constraints, to r. */
static int find_missing_velocity(point *o, const fvi_observer *of)
{
    int status = evaluate(o);
    memset(o->r, 0, o->n * sizeof *o->r);
    if (!status)
        status = subtract_dampers(o, of->lead, of->rate);
    return status ? status : solve(o);
}

static int correct_velocity(point *o, const fvi_observer *of)
{
    const int status = of->bends > 0 ? find_missing_velocity(o, of) : FVI_SUCCESS;
    for (size_t i = 0; i < o->d && of->bends > 0 && !status; i++)
        o->v[i] += o->r[i];
    return status;
}

/* Subtract v^T c_xx v of each constraint from r. */
static int subtract_curvature(point *o)
{
    const fvi_constraints *c = o->system->mechanism->constraints;
    int status = o->m == 0 || c->hessian ? FVI_SUCCESS : FVI_EUNSUP;
    for (size_t l = 0; l < o->m && !status; l++) {
        memset(o->w, 0, o->m * sizeof *o->w);
        memset(o->H, 0, o->d * o->d * sizeof *o->H);
        o->w[l] = 1;
        status = c->hessian(o->t, o->d, o->x, o->w, c->params, o->H);
        for (size_t i = 0; i < o->d && !status; i++)
            for (size_t j = 0; j < o->d; j++)
                o->r[o->d + l] -= o->v[i] * o->H[i * o->d + j] * o->v[j];
    }
    return status;
}

/* Write the right side. Functions of t are evaluated at no time later than `end`. */
static int evaluate_forces(point *o, const fvi_observer *of, double h, double end)
{
    const fvi_state_force *force = o->system->mechanism->force_on;
    int status = evaluate(o);
    memset(o->Q, 0, o->d * sizeof *o->Q);
    if (!status && force)
        status = force->at(o->t, o->d, o->x, o->v, force->params, o->Q, NULL, NULL);
    for (size_t i = 0; i < o->d && !status; i++) {
        o->r[i] += of->F[i] + o->Q[i];
        for (size_t j = 0; j < o->d; j++)
            o->r[i] -= o->Lxv[j * o->d + i] * o->v[j];
    }
    if (!status)
        status = subtract_dampers(o, o->damper, NULL);
    if (!status)
        status = subtract_curvature(o);
    return status ? status : subtract_explicit_slopes(o, o->t + h <= end * (1 + DBL_EPSILON) ? h : -h);
}

static int begin(point *o, const fvi_observer *of, const fvi_stepper *s, double t, const double *x)
{
    const fvi_constraints *c = of->mechanism->constraints;
    *o = (point){ .system = s->run.system, .d = of->d, .m = c ? c->count : 0, .t = t, .x = x };
    /* a closed contact is no constraint of the run */
    const int is_closed = s->mechanism->m > s->mechanism->permanent;
    const int status = s->mechanism->any_massless || is_closed ? FVI_EUNSUP : allocate(o, of->dampers);
    return status ? status : fvi_observer_velocity(of, s, s->p, o->v);
}

static void end(point *o)
{
    free(o->order);
    free(o->numbers);
}

int fvi_observer_bend(fvi_observer *o, const fvi_stepper *s)
{
    const size_t rows = fvi_observer_first_rows(o), d = o->d;
    point at;
    int status = begin(&at, o, s, s->t, s->x);
    if (!status)
        status = find_missing_velocity(&at, o);
    for (size_t j = 0; j < o->dampers && !status; j++) {
        const fvi_elongation *of = &o->mechanism->damper[j].of;
        const double *G = of->row ? of->row : at.G, before = o->bend_rate[j];
        double *bend = o->bend + j * rows + s->k - 1;
        if (!of->row)
            status = of->gradient(s->t, d, s->x, of->params, at.G);
        o->bend_rate[j] = 0;
        for (size_t i = 0; i < d; i++)
            o->bend_rate[j] += G[i] * at.r[i];
        *bend = (s->k > 1 ? bend[-1] : 0) + s->run.h * (before + o->bend_rate[j]) / 2;
    }
    end(&at);
    return status;
}

int fvi_observer_motion(fvi_observer *o, const fvi_stepper *s, double t, const double *x)
{
    point at;
    int status = begin(&at, o, s, t, x);
    if (!status)
        status = correct_velocity(&at, o);
    if (!status)
        memcpy(at.damper, o->force, o->dampers * sizeof *at.damper);
    if (!status && s->k > 0)
        fvi_observer_compare_forces(o, s->k, s->run.h, at.damper);
    if (!status)
        memset(at.r, 0, at.n * sizeof *at.r);
    if (!status)
        status = evaluate_forces(&at, o, s->run.h, s->run.h * (double)s->run.steps);
    if (!status)
        status = solve(&at);
    if (!status && !fvi_all_finite(at.n, at.r))
        status = FVI_EOVRFLW;
    if (!status) {
        memcpy(o->force + o->forces, at.r, o->slopes * sizeof *at.r);
        memcpy(o->force + o->forces + o->slopes, at.r + at.d, o->ties * sizeof *at.r);
    }
    end(&at);
    return status;
}
