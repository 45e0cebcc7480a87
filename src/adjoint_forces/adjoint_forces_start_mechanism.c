/* src/adjoint_forces/adjoint_forces_start_mechanism.c -- The derivatives of the forces of a mechanism's dampers through
 * the start. [H 23, 29]
 *
 * line_j = grad g_j(x_0) . v_0 + (g_j)_t and jump_j = g_j(x_0), where L_v(x_0, v_0) = p_0. */
#include "adjoint_forces_start.h"

#include <fvi/dampers.h>

#include "mechanism/mechanism_state.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/lagrangian_point.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    const fvi_stepper *s;
    const fvi_sensitivities *want;
    size_t d;
    double *v, *by_v, *by_x, *G, *H, *Lxv, *Lvv;
    size_t *order;
} start;

static int allocate(start *o)
{
    const size_t d = o->d;
    double *room = calloc(4 * d + 2 + 3 * d * d, sizeof *room);
    o->v = room;
    o->order = calloc(d, sizeof *o->order);
    if (!room || !o->order)
        return FVI_ENOMEM;
    o->by_v = room + d;
    o->by_x = o->by_v + d;
    o->G = o->by_x + d; /* and g_t behind it */
    o->H = o->G + d + 2;
    o->Lxv = o->H + d * d;
    o->Lvv = o->Lxv + d * d;
    return FVI_SUCCESS;
}

/* Add the derivatives by names through the jump and the line of an elongation. */
static int add_names(start *o, size_t j, double jump, double line)
{
    const fvi_mechanism_columns *by = o->want->columns;
    int status = FVI_SUCCESS;
    for (size_t i = 0; o->want->names && i < by->count && !status; i++) {
        double g = 0;
        memset(o->G, 0, (o->d + 2) * sizeof *o->G);
        status = by->elongation(i, j, 0, o->d, o->s->run.x0, by->params, &g, o->G, o->G + o->d);
        o->want->names[i] += jump * g + line * (fvi_dot(o->d, o->G, o->v) + o->G[o->d]);
    }
    return status;
}

/* Refuse the derivative by x_0 through the line of an elongation whose rate changes with the place, because no callback
 * gives that derivative of the rate. */
static int check_rate(start *o, const fvi_elongation *of, double line)
{
    int is_fixed = 1;
    const int status = line != 0 && o->want->x0
                           ? fvi_elongation_rate_is_fixed(of, o->d, o->s->run.x0, o->G, &is_fixed) : FVI_SUCCESS;
    if (!status && !is_fixed)
        FVI_FAIL("no derivative by x0 of the force of a damper if the rate of its elongation changes with the place",
                 FVI_EUNSUP);
    return status;
}

/* Add the derivatives of damper j; `jump` and `line` are the derivatives of L by its jump and its line. */
static int add_damper(start *o, size_t j, double jump, double line)
{
    const size_t d = o->d;
    const double *x0 = o->s->run.x0;
    const fvi_elongation *of = &o->s->run.system->mechanism->damper[j].of;
    const double *G = of->row ? of->row : o->G;
    double g = 0, rate = 0;
    int status = check_rate(o, of, line);
    if (!status)
        status = add_names(o, j, jump, line);
    memset(o->H, 0, d * d * sizeof *o->H);
    if (!status && !of->row)
        status = of->value(0, d, x0, of->params, &g);
    if (!status && !of->row)
        status = of->gradient(0, d, x0, of->params, o->G);
    if (!status && !of->row)
        status = of->hessian(0, d, x0, line, of->params, o->H);
    if (!status && !of->row && of->rate)
        status = of->rate(0, d, x0, of->params, &rate);
    for (size_t i = 0; i < d && !status; i++) {
        o->by_v[i] += line * G[i];
        o->by_x[i] += jump * G[i] + fvi_dot(d, o->H + i * d, o->v);
    }
    if (!status && o->want->damping)
        o->want->damping[j] += jump * (of->row ? fvi_dot(d, of->row, x0) : g) + line * (fvi_dot(d, G, o->v) + rate);
    return status;
}

/* Turn by_v into the derivative by p_0. A coordinate without inertia starts with the velocity 0. */
static int solve_for_momentum(start *o)
{
    const fvi_system *system = o->s->run.system;
    const size_t d = o->d;
    int status = fvi_lagrangian_point(system, 0, o->s->run.x0, o->v, NULL, NULL, NULL, NULL, o->Lxv, o->Lvv);
    for (size_t i = 0; i < d; i++) {
        int is_zero = 1;
        for (size_t k = 0; k < d; k++)
            is_zero &= o->Lvv[i * d + k] == 0;
        if (is_zero) {
            o->Lvv[i * d + i] = 1;
            o->by_v[i] = 0;
        }
    }
    return status ? status : fvi_solve_matrix(d, o->Lvv, o->by_v, o->order);
}

/* Add the derivatives by the other numbers in L_v(x_0, v_0) = p_0. */
static int add_velocity(start *o)
{
    const fvi_sensitivities *want = o->want;
    const fvi_lagrangian *L = fvi_lagrangian_of(o->s->run.system);
    const size_t d = o->d;
    double *Sx = o->H, *Sv = o->G;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < d; i++) {
        o->by_x[i] -= fvi_dot(d, o->Lxv + i * d, o->by_v);
        if (want->p0)
            want->p0[i] += o->by_v[i];
        if (want->x0)
            want->x0[i] += o->by_x[i];
        if (want->mass)
            want->mass[i] -= o->by_v[i] * o->v[i];
    }
    for (size_t p = 0; L && want->parameters && !status && p < want->sensitivity.count; p++) {
        memset(Sx, 0, d * sizeof *Sx);
        memset(Sv, 0, d * sizeof *Sv);
        status = want->lagrangian(p, 0, d, o->s->run.x0, o->v, L->params, Sx, Sv);
        want->parameters[p] -= fvi_dot(d, Sv, o->by_v);
    }
    return status;
}

int fvi_force_start_of_mechanism(const fvi_stepper *s, const fvi_force_shares *shares, const fvi_sensitivities *want)
{
    start o = { .s = s, .want = want, .d = s->run.system->d };
    int status = allocate(&o);
    if (!status)
        status = fvi_stepper_velocity(s, o.v);
    for (size_t j = 0; j < shares->n && !status; j++)
        status = add_damper(&o, j, shares->jump[j], shares->line[j]);
    if (!status)
        status = solve_for_momentum(&o);
    if (!status)
        status = add_velocity(&o);
    free(o.v);
    free(o.order);
    return status;
}
