/* src/adjoint_mechanism/adjoint_mechanism_names.c -- The derivatives by numbers in forces of velocity, elongations and
 * constraints. [H 23, 29]
 *
 * Let an index theta mean the derivative by such a number. alpha and beta are the multipliers of p_k and p_{k+1} in
 * (29.6), phi that of the force f, and eta_k that of the mean elongation of the step. Then a step adds
 *
 *     phi F_theta - share_0 alpha grad g_theta(x_k) - share_1 beta grad g_theta(x_{k+1})
 *         - eta_k (g_theta(x_k) + g_theta(x_{k+1}))/2.                              (23.31)
 *
 * With stages each stage has such terms, and eta_i is the multiplier of zdot_i. */
#include "adjoint_mechanism.h"

#include "system/dot.h"

#include <math.h>
#include <string.h>

/* ---- forces of velocity ---- */

static int add_force(fvi_adjoint_mechanism *m, size_t j, double t, const double *x, const double *v,
                     const double *phi, double factor)
{
    const fvi_mechanism_columns *by = m->want->columns;
    if (!m->run->system->mechanism->force_on)
        return FVI_SUCCESS;
    memset(m->column, 0, m->d * sizeof *m->column);
    const int status = by->force(j, t, m->d, x, v, by->params, m->column);
    m->want->names[j] += factor * fvi_dot(m->d, phi, m->column);
    return status;
}

/* ---- elongations ---- */

/* Write g_theta, its gradient and g_t,theta to `to`, d + 2 numbers. */
static int elongation(fvi_adjoint_mechanism *m, size_t j, size_t e, double t, const double *x,
                      double *to)
{
    const fvi_mechanism_columns *by = m->want->columns;
    return by->elongation(j, e, t, m->d, x, by->params, to, to + 1, to + m->d + 1);
}

static int add_damper_at_nodes(fvi_adjoint_mechanism *m, size_t j, size_t e, double t)
{
    const size_t d = m->d;
    const int is_node = m->o->form == FVI_MECHANISM_NODES;
    const double eta = m->damper[e].eta[0];
    double *begin = m->column, *end = begin + d + 2;
    int status = elongation(m, j, e, t + m->run->h, m->o->X + d, end);
    if (!status && is_node)
        status = elongation(m, j, e, t, m->stepper->x, begin);
    m->want->names[j] -= fvi_adjoint_mechanism_share(m, e, 1) * fvi_dot(d, m->beta, end + 1)
                         + eta * (is_node ? (*begin + *end) / 2 : *end);
    if (is_node)
        m->want->names[j] -= fvi_adjoint_mechanism_share(m, e, 0) * fvi_dot(d, m->multiplier, begin + 1);
    return status;
}

/* The time of x_k. */
static double step_begin_time(const fvi_adjoint_mechanism *m)
{
    return m->mesh ? m->o->t : (double)m->stepper->k * m->run->h;
}

static int add_damper_at_stages(fvi_adjoint_mechanism *m, size_t j, size_t e)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d, s = m->s;
    const double h = m->o->h, *eta = m->damper[e].eta;
    double *begin = m->column, *here = begin + d + 2, *sum = m->want->names + j;
    double spring = 0; /* on a mesh the force of a spring depends on its length, not on a history */
    for (size_t i = 0; m->mesh && i < s; i++)
        spring += m->damper[e].spring * m->damper[e].nu[i];
    int status = elongation(m, j, e, step_begin_time(m), m->stepper->x, begin);
    *sum += spring * *begin;
    for (size_t l = 0; l < s && !status; l++) {
        status = elongation(m, j, e, fvi_mechanism_stage_time(m->stepper, l), o->X + l * d, here);
        *sum -= o->lambda[e * s + l] * fvi_dot(d, m->phi + l * d, here + 1);
        for (size_t i = 0; i < s; i++)
            *sum += eta[i] * o->E[i][l] * (*here - *begin) / h;
    }
    return status;
}

int fvi_adjoint_mechanism_names_start(fvi_adjoint_mechanism *m, size_t j, double by_place,
                                      double by_slope)
{
    const size_t d = m->d;
    double *at = m->column;
    int status = FVI_SUCCESS;
    for (size_t i = 0; m->want->names && i < m->want->columns->count && !status; i++) {
        status = elongation(m, i, j, 0, m->run->x0, at);
        m->want->names[i] += by_place * *at + by_slope * (fvi_dot(d, at + 1, m->v0) + at[d + 1]);
    }
    return status;
}

int fvi_adjoint_mechanism_names_bar(fvi_adjoint_mechanism *m, size_t e)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; m->want->names && j < m->want->columns->count && !status; j++) {
        status = elongation(m, j, e, 0, m->run->x0, m->column);
        if (*m->column != 0)
            m->want->names[j] = NAN;
    }
    return status;
}

/* ---- constraints ---- */

/* Write c, C and c_t, differentiated by theta, to m->column, one after another. */
static int constraints(fvi_adjoint_mechanism *m, size_t j, double t, const double *x)
{
    const fvi_mechanism_columns *by = m->want->columns;
    const size_t c = m->o->m;
    double *to = m->column;
    return by->constraint(j, t, m->d, x, by->params, to, to + c, to + c + c * m->d);
}

/* Add -sum_l impulse_l C_l y: the direction of an impulse of the constraints changes with theta. */
static void add_constraint_rotation(fvi_adjoint_mechanism *m, size_t j, const double *impulse, const double *y)
{
    const size_t d = m->d, c = m->o->m;
    for (size_t l = 0; l < c; l++)
        m->want->names[j] -= impulse[l] * fvi_dot(d, m->column + c + l * d, y);
}

static int add_constraints_at_nodes(fvi_adjoint_mechanism *m, size_t j, double t)
{
    const size_t d = m->d, c = m->o->m;
    const double h = m->run->h;
    int status = constraints(m, j, t, m->stepper->x);
    for (size_t l = 0; l < c; l++)
        m->factors[l] = m->unknown[d + l] / h;
    add_constraint_rotation(m, j, m->factors, m->multiplier);
    if (!status)
        status = constraints(m, j, t + h, m->o->X + d);
    m->want->names[j] -= fvi_dot(c, m->multiplier + d, m->column) / h;
    return status;
}

static int add_constraints_at_stages(fvi_adjoint_mechanism *m, size_t j)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d, s = m->s, c = o->m, inner = s - o->begin;
    const double h = o->h;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < s && !status; i++) {
        status = constraints(m, j, fvi_mechanism_stage_time(m->stepper, i), o->X + i * d);
        for (size_t l = 0; l < c; l++)
            m->factors[l] = i < inner ? m->unknown[inner * d + i * c + l] / h : 0;
        if (i < inner) {
            add_constraint_rotation(m, j, m->factors, m->beta);
            add_constraint_rotation(m, j, m->factors, m->multiplier + i * d);
        }
        if (i >= o->begin)
            m->want->names[j] +=
                fvi_dot(c, m->multiplier + inner * d + (i - o->begin) * c, m->column) / h;
    }
    return status;
}

int fvi_adjoint_mechanism_names_node(fvi_adjoint_mechanism *m, double t, const double *x,
                                     const double *v, const double *w, const double *delta)
{
    const size_t d = m->d, c = m->o->m;
    int status = FVI_SUCCESS;
    for (size_t j = 0; m->want->names && j < m->want->columns->count && !status; j++) {
        status = constraints(m, j, t, x);
        add_constraint_rotation(m, j, w, m->beta);
        add_constraint_rotation(m, j, delta, v);
        m->want->names[j] -= fvi_dot(c, delta, m->column + c + c * d);
    }
    return status;
}

int fvi_adjoint_mechanism_names_check(fvi_adjoint_mechanism *m)
{
    const size_t d = m->d, c = m->o->m;
    int status = FVI_SUCCESS;
    for (size_t j = 0; m->want->names && c && j < m->want->columns->count && !status; j++) {
        status = constraints(m, j, 0, m->run->x0);
        for (size_t l = 0; l < c; l++) {
            const double *C = m->column + c + l * d;
            double size = 0, speed = m->column[c + c * d + l];
            for (size_t i = 0; i < d; i++) {
                speed += C[i] * m->v0[i];
                size += fabs(C[i] * m->v0[i]);
            }
            if (m->column[l] != 0 || fabs(speed) > 1e-12 * size)
                m->want->names[j] = NAN;
        }
    }
    return status;
}

/* ---- a step ---- */

int fvi_adjoint_mechanism_names_nodes(fvi_adjoint_mechanism *m, size_t k, double ahead)
{
    const fvi_mechanism_state *o = m->o;
    const int is_node = o->form == FVI_MECHANISM_NODES;
    const double h = m->run->h, t = (double)k * h;
    int status = FVI_SUCCESS;
    for (size_t j = 0; m->want->names && j < m->want->columns->count && !status; j++) {
        status = is_node ? add_force(m, j, t + ahead * h, o->X, o->V, m->phi, 1)
                         : add_force(m, j, t + h, o->X + m->d, o->V, m->beta, h);
        for (size_t e = 0; e < m->r && !status; e++)
            status = add_damper_at_nodes(m, j, e, t);
        if (!status && o->m)
            status = add_constraints_at_nodes(m, j, t);
    }
    return status;
}

int fvi_adjoint_mechanism_names_stages(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    int status = FVI_SUCCESS;
    for (size_t j = 0; m->want->names && j < m->want->columns->count && !status; j++) {
        for (size_t i = 0; i < m->s && !status; i++)
            status = add_force(m, j, fvi_mechanism_stage_time(m->stepper, i), o->X + i * d,
                               o->V + i * d, m->phi + i * d, 1);
        for (size_t e = 0; e < m->r && !status; e++)
            status = add_damper_at_stages(m, j, e);
        if (!status && o->m)
            status = add_constraints_at_stages(m, j);
    }
    return status;
}
