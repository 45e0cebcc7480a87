/* src/adjoint_mechanism/adjoint_mechanism_nodes.c -- A step of the adjoint run by the method of order 1 or the node
 * scheme. [H 23, 29]
 *
 * With f = L_x + F at the point of the step, and kappa' = 1 - kappa, the momenta at its two ends are
 *
 *     p_k     = L_v - kappa h f  - h/2 F_k     + sum (h/2 lambda + I_0) grad g(x_k),
 *     p_{k+1} = L_v + kappa' h f + h/2 F_{k+1} - sum (h/2 lambda + I_1) grad g(x_{k+1})    (29.6)
 *
 * and their multipliers are alpha and beta. In the method of order 1, (29.5), F and h lambda act at x_{k+1} alone. */
#include "adjoint_mechanism.h"

#include "system/dot.h"
#include "system/lagrangian_point.h"

#include <string.h>

static int is_node(const fvi_adjoint_mechanism *m)
{
    return m->o->form == FVI_MECHANISM_NODES;
}

/* The part of x_{k+1} in the point of the step. */
static double weight_of_end(const fvi_adjoint_mechanism *m)
{
    return is_node(m) ? 0.5 : 1 - m->run->kappa;
}

double fvi_adjoint_mechanism_share(const fvi_adjoint_mechanism *m, size_t e, size_t end)
{
    const fvi_mechanism_state *o = m->o;
    const double h = m->run->h;
    return is_node(m) ? h / 2 * o->lambda[e] + o->start_impulse[2 * e + end]
                      : (end ? h * o->lambda[e] : 0);
}

/* to -= factor (Hess g) y, for damper e at x. */
static int subtract_curvature(fvi_adjoint_mechanism *m, size_t e, double t, const double *x,
                              double factor, const double *y, double *to)
{
    const size_t d = m->d;
    const fvi_elongation *of = &m->run->system->mechanism->damper[e].of;
    double *H = m->room;
    if (of->row || factor == 0)
        return FVI_SUCCESS;
    memset(H, 0, d * d * sizeof *H);
    const int status = of->hessian(t, d, x, factor, of->params, H);
    for (size_t i = 0; i < d; i++)
        to[i] -= fvi_dot(d, H + i * d, y);
    return status;
}

/* Add the derivatives through the point of the step by one of its ends, which has `part` of the point and moves V by
 * sign / h. y = beta - alpha is the multiplier of L_v, and z that of the force. */
static void add_point(const fvi_adjoint_mechanism *m, double part, double sign, const double *y,
                      const double *z, double *to)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    const double h = m->run->h;
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            to[j] += y[i] * (part * o->Lxv[j * d + i] + sign / h * o->Lvv[i * d + j])
                     + h * z[i] * (part * o->fx[i * d + j] + sign / h * o->fv[i * d + j]);
}

/* In the method of order 1 the forces of velocity act at x_{k+1}, with the slope of the step as velocity. */
static int force_at_end(fvi_adjoint_mechanism *m, const double *x, double t, double *to,
                        double *before)
{
    const fvi_state_force *force = m->run->system->mechanism->force_on;
    const size_t d = m->d;
    const double h = m->run->h;
    double *F = m->room, *Fx = F + d, *Fv = Fx + d * d;
    if (!force || is_node(m))
        return FVI_SUCCESS;
    const int status = force->at(t, d, x, m->o->V, force->params, F, Fx, Fv);
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++) {
            to[j] += m->beta[i] * (h * Fx[i * d + j] + Fv[i * d + j]);
            before[j] -= m->beta[i] * Fv[i * d + j];
        }
    return status;
}

/* Write the right-hand side of the equation for alpha: all derivatives by x_{k+1} that are known, with beta. */
static int assemble_right_hand_side(fvi_adjoint_mechanism *m, size_t k, const double *x, double *right)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    const double h = m->run->h, t = (double)(k + 1) * h, ahead = weight_of_end(m);
    double *scaled = m->phi;
    int status = FVI_SUCCESS;
    memcpy(right, m->g, d * sizeof *right);
    for (size_t i = 0; i < d; i++)
        scaled[i] = ahead * m->beta[i];
    add_point(m, ahead, 1, m->beta, scaled, right);
    for (size_t e = 0; !status && e < m->r; e++) {
        fvi_adjoint_mechanism_damper *a = m->damper + e;
        const double *G = o->gradient + e * d;
        double eta = 0;
        if (is_node(m)) {
            a->nu[0] = h / 2 * fvi_dot(d, G, m->beta);
            status = fvi_adjoint_mechanism_damper_ahead(a, &eta);
            eta = (eta + a->weight * a->nu[0]) / 2;
        } else {
            const double zeta =
                o->elongation[e] - o->z0[e] - t * (a->needs_start_slope ? a->A : 0);
            a->nu[0] = h * fvi_dot(d, G, m->beta);
            status = fvi_adjoint_mechanism_damper_push(m, a, &zeta);
            a->by_drift += t * a->eta[0];
            eta = a->eta[0];
        }
        for (size_t i = 0; i < d; i++)
            right[i] -= eta * G[i];
        if (!status)
            status = subtract_curvature(m, e, t, x, fvi_adjoint_mechanism_share(m, e, 1), m->beta, right);
    }
    return status;
}

/* Push the dampers of the node scheme, after alpha is known. */
static int push_dampers(fvi_adjoint_mechanism *m, size_t k)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    const double h = m->run->h, t = ((double)k + 0.5) * h;
    int status = FVI_SUCCESS;
    for (size_t e = 0; !status && e < m->r; e++) {
        fvi_adjoint_mechanism_damper *a = m->damper + e;
        const double left = fvi_dot(d, o->G + e * d, m->multiplier),
                     right = fvi_dot(d, o->gradient + e * d, m->beta),
                     zeta = (o->z[e] + o->elongation[e]) / 2 - o->z0[e]
                            - t * (a->needs_start_slope ? a->A : 0);
        a->nu[0] = h / 2 * (left + right);
        fvi_adjoint_mechanism_damper_impulses(m, k, a, (double[]){ -left, -right });
        a->factor -= o->start_impulse[2 * e] * left + o->start_impulse[2 * e + 1] * right;
        for (size_t l = 0; a->term && a->needs_start_slope && l < a->kernel->count; l++)
            fvi_node_term_accumulate_impulses(a->term + l, k, a->A * left, a->A * right,
                                              m->want, a->first + l);
        status = fvi_adjoint_mechanism_damper_push(m, a, &zeta);
        a->by_drift += t * a->eta[0];
    }
    return status;
}

/* Add the derivatives by the force: h/2 at either end; in the method of order 1 h at the later end. */
static void add_force(fvi_adjoint_mechanism *m, size_t k)
{
    const double h = m->run->h;
    double *force = m->want->force ? m->want->force + k * m->d : NULL;
    for (size_t i = 0; force && i < m->d; i++) {
        force[m->d + i] += (is_node(m) ? h / 2 : h) * m->beta[i];
        force[i] += is_node(m) ? h / 2 * m->multiplier[i] : 0;
    }
}

/* Subtract the derivatives through the gradients of the constraints at x_k, with which their impulses turn. */
static int subtract_constraints(fvi_adjoint_mechanism *m, double t, const double *x)
{
    const fvi_constraints *c = m->run->system->mechanism->constraints;
    const size_t d = m->d;
    double *H = m->room;
    for (size_t l = 0; l < m->o->m; l++)
        m->factors[l] = m->unknown[d + l] / m->run->h;
    memset(H, 0, d * d * sizeof *H);
    const int status = c->hessian(t, d, x, m->factors, c->params, H);
    for (size_t i = 0; i < d; i++)
        m->next[i] -= fvi_dot(d, H + i * d, m->multiplier);
    return status;
}

/* Write the derivatives by x_k through this step to m->next. */
static int find_left_end_forces(fvi_adjoint_mechanism *m, size_t k, const double *x)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d;
    const double h = m->run->h, t = (double)k * h, ahead = weight_of_end(m), kappa = 1 - ahead;
    double *y = m->tau, *z = m->phi;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < d; i++) {
        y[i] = m->beta[i] - m->multiplier[i];
        z[i] = ahead * m->beta[i] + kappa * m->multiplier[i];
    }
    add_point(m, kappa, -1, y, z, m->next);
    for (size_t e = 0; !status && e < m->r && is_node(m); e++) {
        for (size_t i = 0; i < d; i++)
            m->next[i] -= m->damper[e].eta[0] / 2 * o->G[e * d + i];
        status = subtract_curvature(m, e, t, x, fvi_adjoint_mechanism_share(m, e, 0), m->multiplier, m->next);
    }
    for (size_t i = 0; i < d; i++)
        z[i] *= h;
    if (!status && o->m)
        status = subtract_constraints(m, t, x);
    return status ? status
                  : fvi_adjoint_mechanism_point(m, 0, ((double)k + ahead) * h, y, z);
}

//> nodes
int fvi_adjoint_mechanism_nodes(fvi_adjoint_mechanism *m, size_t k)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d, n = m->n;
    const double h = m->run->h, *x = m->stepper->x, *end = o->X + d;
    memset(m->next, 0, d * sizeof *m->next);
    int status = assemble_right_hand_side(m, k, end, m->multiplier);
    if (!status)
        status = force_at_end(m, end, (double)(k + 1) * h, m->multiplier, m->next);
    for (size_t i = 0; i < n; i++) {
        m->multiplier[i] = i < d ? h * m->multiplier[i] : 0; /* the rows of the matrix are h times the rows of p_k */
        for (size_t j = 0; j < n; j++)
            m->matrix[j * n + i] = o->matrix[i * n + j];
    }
    if (!status)
        status = fvi_solve_matrix(n, m->matrix, m->multiplier, m->order);
    if (!status && is_node(m))
        status = push_dampers(m, k);
    if (!status)
        status = find_left_end_forces(m, k, x);
    if (!status)
        status = fvi_adjoint_mechanism_names_nodes(m, k, weight_of_end(m));
    add_force(m, k);
    memcpy(m->g, m->next, d * sizeof *m->g);
    memcpy(m->beta, m->multiplier, d * sizeof *m->beta);
    return status;
}
//< nodes
