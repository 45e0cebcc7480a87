/* src/adjoint_forces/adjoint_forces_mechanism.c -- A mechanism whose dampers push walls. [H 23, 29] */
#include "adjoint_forces.h"

#include <fvi/dampers.h>

#include <stdlib.h>
#include <string.h>

/* The elongation of a damper minus the position of its wall. */
typedef struct {
    fvi_elongation of;
    size_t d, wall;
} long_elongation;

typedef struct {
    size_t d, whole;
    const fvi_system *of;
    const fvi_mechanism *m;
    const fvi_sensitivities *want;
    double *rows, *room; /* room for one function at a time */
    fvi_damper *damper;
    long_elongation *elongation;
    fvi_lagrangian lagrangian;
    fvi_state_force force_on;
    fvi_constraints constraints;
    fvi_mechanism mechanism;
} parts;

static void stop(void *params)
{
    parts *o = params;
    free(o->rows);
    free(o->room);
    free(o->damper);
    free(o->elongation);
    free(o);
}

/* Extend a matrix of `rows` rows from d to `whole` numbers a row, and to rows_to rows; the new entries are 0. */
static void widen_rows(const parts *o, size_t rows, const double *from, size_t rows_to, double *to)
{
    memset(to, 0, rows_to * o->whole * sizeof *to);
    for (size_t i = 0; i < rows; i++)
        memcpy(to + i * o->whole, from + i * o->d, o->d * sizeof *to);
}

/* ---- elongations ---- */

static int value(double t, size_t d, const double *x, void *params, double *g)
{
    const long_elongation *o = params;
    (void)d;
    const int status = o->of.value(t, o->d, x, o->of.params, g);
    *g -= x[o->wall];
    return status;
}

static int gradient(double t, size_t d, const double *x, void *params, double *G)
{
    const long_elongation *o = params;
    memset(G + o->d, 0, (d - o->d) * sizeof *G);
    G[o->wall] = -1;
    return o->of.gradient(t, o->d, x, o->of.params, G);
}

static int hessian(double t, size_t d, const double *x, double factor, void *params, double *H)
{
    const long_elongation *o = params;
    double *own = calloc(o->d * o->d, sizeof *own);
    if (!own)
        return FVI_ENOMEM;
    const int status = o->of.hessian(t, o->d, x, factor, o->of.params, own);
    for (size_t i = 0; i < o->d; i++)
        for (size_t j = 0; j < o->d; j++)
            H[i * d + j] += own[i * o->d + j];
    free(own);
    return status;
}

static int rate(double t, size_t d, const double *x, void *params, double *gt)
{
    const long_elongation *o = params;
    (void)d;
    return o->of.rate(t, o->d, x, o->of.params, gt);
}

static void connect(parts *o, size_t j)
{
    const fvi_damper *from = o->m->damper + j;
    fvi_damper *to = o->damper + j;
    *to = *from;
    if (from->of.row) {
        double *row = o->rows + j * o->whole;
        memcpy(row, from->of.row, o->d * sizeof *row);
        row[o->d + j] = -1;
        to->of = fvi_elongation_row(row);
        return;
    }
    o->elongation[j] = (long_elongation){ from->of, o->d, o->d + j };
    to->of = (fvi_elongation){ .value = value,
                               .gradient = gradient,
                               .hessian = from->of.hessian ? hessian : NULL,
                               .rate = from->of.rate ? rate : NULL,
                               .params = &o->elongation[j] };
}

/* ---- the Lagrangian: that of the run, plus the kinetic energy of the walls ---- */

static int lagrangian(double t, size_t d, const double *x, const double *v, void *params, double *L, double *Lx,
                      double *Lv, double *Lxx, double *Lxv, double *Lvv)
{
    const parts *o = params;
    const fvi_lagrangian *of = o->m->lagrangian;
    const size_t n = o->d * o->d;
    double *xx = o->room, *xv = xx + n, *vv = xv + n;
    const int status =
        of->at(t, o->d, x, v, of->params, L, Lx, Lv, Lxx ? xx : NULL, Lxv ? xv : NULL, Lvv ? vv : NULL);
    if (Lxx)
        widen_rows(o, o->d, xx, d, Lxx);
    if (Lxv)
        widen_rows(o, o->d, xv, d, Lxv);
    if (Lvv)
        widen_rows(o, o->d, vv, d, Lvv);
    for (size_t i = o->d; i < d; i++) {
        if (L)
            *L += FVI_WALL_MASS * v[i] * v[i] / 2;
        if (Lx)
            Lx[i] = 0;
        if (Lv)
            Lv[i] = FVI_WALL_MASS * v[i];
        if (Lvv)
            Lvv[i * d + i] = FVI_WALL_MASS;
    }
    return status;
}

static int lagrangian_column(size_t j, double t, size_t d, const double *x, const double *v, void *params, double *Sx,
                             double *Sv)
{
    const parts *o = params;
    (void)d;
    return o->want->lagrangian(j, t, o->d, x, v, o->m->lagrangian->params, Sx, Sv);
}

/* ---- the potential ---- */

static int potential(size_t d, const double *x, void *params, double *U)
{
    const parts *o = params;
    (void)d;
    return o->of->potential.value(o->d, x, o->of->potential.params, U);
}

static int potential_gradient(size_t d, const double *x, void *params, double *g)
{
    const parts *o = params;
    memset(g + o->d, 0, (d - o->d) * sizeof *g);
    return o->of->potential.gradient(o->d, x, o->of->potential.params, g);
}

static int potential_hessian(size_t d, const double *x, void *params, double *H)
{
    const parts *o = params;
    const fvi_potential *U = &o->of->potential;
    if (U->diagonals) {
        memset(H, 0, ((d - 1) * U->diagonals + 1) * sizeof *H);
        return U->hessian(o->d, x, U->params, H);
    }
    const int status = U->hessian(o->d, x, U->params, o->room);
    widen_rows(o, o->d, o->room, d, H);
    return status;
}

static int is_quadratic(const void *params)
{
    const parts *o = params;
    return o->of->potential.quadratic(o->of->potential.params);
}

static int column(size_t j, size_t d, const double *x, void *params, double *S)
{
    const parts *o = params;
    memset(S + o->d, 0, (d - o->d) * sizeof *S);
    return o->want->sensitivity.column(j, o->d, x, o->of->potential.params, S);
}

/* ---- forces of velocity, constraints ---- */

static int force_on(double t, size_t d, const double *x, const double *v, void *params, double *F, double *Fx,
                    double *Fv)
{
    const parts *o = params;
    const fvi_state_force *of = o->m->force_on;
    double *by_x = o->room, *by_v = by_x + o->d * o->d;
    const int status = of->at(t, o->d, x, v, of->params, F, Fx ? by_x : NULL, Fv ? by_v : NULL);
    memset(F + o->d, 0, (d - o->d) * sizeof *F);
    if (Fx)
        widen_rows(o, o->d, by_x, d, Fx);
    if (Fv)
        widen_rows(o, o->d, by_v, d, Fv);
    return status;
}

static int constraint_value(double t, size_t d, const double *x, void *params, double *c)
{
    const parts *o = params;
    (void)d;
    return o->m->constraints->value(t, o->d, x, o->m->constraints->params, c);
}

static int constraint_gradient(double t, size_t d, const double *x, void *params, double *C, double *ct)
{
    const parts *o = params;
    const fvi_constraints *of = o->m->constraints;
    (void)d;
    const int status = of->gradient(t, o->d, x, of->params, C ? o->room : NULL, ct);
    if (C)
        widen_rows(o, of->count, o->room, of->count, C);
    return status;
}

static int constraint_hessian(double t, size_t d, const double *x, const double *factor, void *params, double *H)
{
    const parts *o = params;
    const fvi_constraints *of = o->m->constraints;
    memset(o->room, 0, o->d * o->d * sizeof *o->room);
    const int status = of->hessian(t, o->d, x, factor, of->params, o->room);
    for (size_t i = 0; i < o->d; i++)
        for (size_t j = 0; j < o->d; j++)
            H[i * d + j] += o->room[i * o->d + j];
    return status;
}

/* ---- derivatives of all this by numbers ---- */

static int column_of_force(size_t j, double t, size_t d, const double *x, const double *v, void *params, double *F)
{
    const parts *o = params;
    (void)d;
    return o->want->columns->force(j, t, o->d, x, v, o->want->columns->params, F);
}

static int column_of_elongation(size_t j, size_t e, double t, size_t d, const double *x, void *params, double *g,
                                double *G, double *gt)
{
    const parts *o = params;
    memset(G + o->d, 0, (d - o->d) * sizeof *G);
    return o->want->columns->elongation(j, e, t, o->d, x, o->want->columns->params, g, G, gt);
}

static int column_of_constraint(size_t j, double t, size_t d, const double *x, void *params, double *c, double *C,
                                double *ct)
{
    const parts *o = params;
    const size_t count = o->m->constraints->count;
    (void)d;
    const int status = o->want->columns->constraint(j, t, o->d, x, o->want->columns->params, c, o->room, ct);
    widen_rows(o, count, o->room, count, C);
    return status;
}

/* ---- the mechanism ---- */

static void describe_mechanism(parts *o)
{
    const fvi_mechanism *m = o->m;
    o->mechanism = (fvi_mechanism){ .damper_count = m->damper_count, .damper = o->damper };
    if (m->lagrangian) {
        o->lagrangian = (fvi_lagrangian){ lagrangian, o };
        o->mechanism.lagrangian = &o->lagrangian;
    }
    if (m->force_on) {
        o->force_on = (fvi_state_force){ force_on, o };
        o->mechanism.force_on = &o->force_on;
    }
    if (m->constraints) {
        o->constraints = *m->constraints;
        o->constraints.value = constraint_value;
        o->constraints.gradient = constraint_gradient;
        o->constraints.hessian = m->constraints->hessian ? constraint_hessian : NULL;
        o->constraints.params = o;
        o->mechanism.constraints = &o->constraints;
    }
}

static void describe_system(fvi_walls *w, parts *o)
{
    const fvi_potential *U = &o->of->potential;
    const fvi_mechanism_columns *by = o->want->columns;
    w->system.mechanism = &o->mechanism;
    if (!o->m->lagrangian && U->gradient)
        w->system.potential = (fvi_potential){ .value = potential,
                                               .gradient = potential_gradient,
                                               .hessian = potential_hessian,
                                               .params = o,
                                               .quadratic = U->quadratic ? is_quadratic : NULL,
                                               .diagonals = U->diagonals };
    w->sensitivity = o->want->sensitivity;
    w->sensitivity.column = o->want->sensitivity.column ? column : NULL;
    w->lagrangian = o->want->lagrangian ? lagrangian_column : NULL;
    if (by)
        w->columns = (fvi_mechanism_columns){ .count = by->count,
                                              .force = by->force ? column_of_force : NULL,
                                              .elongation = by->elongation ? column_of_elongation : NULL,
                                              .constraint = by->constraint ? column_of_constraint : NULL,
                                              .params = o };
}

int fvi_walls_of_mechanism(fvi_walls *w, const fvi_run *run, const fvi_sensitivities *want)
{
    const fvi_system *of = run->system;
    const fvi_mechanism *m = of->mechanism;
    const size_t d = of->d, r = m->damper_count, c = m->constraints ? m->constraints->count : 0;
    int status = fvi_walls_places(w, d, r, d + r);
    if (status)
        return status;
    parts *o = w->parts = calloc(1, sizeof *o);
    if (!o)
        return FVI_ENOMEM;
    w->stop = stop;
    *o = (parts){ .d = d, .whole = d + r, .of = of, .m = m, .want = want };
    o->rows = calloc(r * (d + r) + 1, sizeof *o->rows);
    o->room = calloc(3 * d * d + c * d, sizeof *o->room);
    o->damper = calloc(r + 1, sizeof *o->damper);
    o->elongation = calloc(r + 1, sizeof *o->elongation);
    if (!o->rows || !o->room || !o->damper || !o->elongation)
        return FVI_ENOMEM;
    for (size_t j = 0; j < r; j++) {
        w->wall[j] = d + j;
        connect(o, j);
    }
    describe_mechanism(o);
    status = fvi_walls_allocate(w, run);
    if (!status) {
        describe_system(w, o);
        status = fvi_walls_force(w, &of->force);
    }
    return status;
}
