/* src/adjoint/adjoint_multistep_alone.c -- The adjoint run of one coordinate, without stages. [H 23]
 *
 * For one coordinate a step of the adjoint run, (9.4) or (13.10), is one division. This file takes such steps without
 * loops over coordinates. It has the same digits as adjoint_multistep.c and the methods of order 2, and needs between a
 * third and two thirds of their time. */
#include "adjoint_multistep.h"

#include "methods/convolution_quadrature_dampers.h"
#include "system/dot.h"
#include "system/fail.h"

/* ---- Algorithm 3, many steps at once ---- */

enum { BLOCK = 64 }; /* steps; so few that their numbers stay in the cache */

/* Steps that are taken together, from node `last` down to node last - count; i = 0 is the latest one. The functions of
 * U and J are called before and after the recurrence. So nothing between two steps of the recurrence waits for them,
 * and no registers are saved. */
typedef struct {
    size_t last, count;
    double Jx[BLOCK + 1];                    /* dJ/dx of node last - i */
    double moved[BLOCK], S[BLOCK], G[BLOCK]; /* x_{k+1} - x_k; the point where U is evaluated; Hess U there */
    double z[BLOCK];                         /* of node k, what the history of the run takes in */
    double lambda[BLOCK + 1];                /* of node last - i */
    double delta[BLOCK], M[BLOCK], g[BLOCK]; /* the increment of lambda; the multiplier of S; h G M */
    double N[BLOCK], Ndot[BLOCK];            /* the sum of the history at node k, and its derivative by 2 alpha */
} block;

/* Read the path. x points to node `last`; the nodes before stand before it. */
static void read_path(const fvi_adjoint_multistep *m, const double *x, block *b)
{
    const double share = 1 - m->kappa, origin = m->is_liouville ? 0 : *m->run->x0;
    for (size_t i = 0; i < b->count; i++, x--) {
        b->moved[i] = x[0] - x[-1];
        b->S[i] = x[-1] + share * b->moved[i];
        b->z[i] = x[-1] - origin;
    }
    for (size_t i = 0; m->each->has_drift && i < b->count; i++)
        b->z[i] -= (double)(b->last - 1 - i) * m->run->h * *m->v0;
}

/* Evaluate G at each S; for a quadratic U once in a run. */
static int evaluate_hessians(const fvi_adjoint_multistep *m, block *b)
{
    const fvi_potential *u = &m->run->system->potential;
    const int varies = m->has_hessian && !m->is_quadratic;
    int status = FVI_SUCCESS;
    for (size_t i = 0; varies && !status && i < b->count; i++)
        status = u->hessian(1, &b->S[i], u->params, &b->G[i]);
    if (m->has_hessian && m->is_quadratic && b->last == m->run->steps)
        status = u->hessian(1, b->S, u->params, m->G);
    for (size_t i = 0; !varies && i < b->count; i++)
        b->G[i] = m->has_hessian ? *m->G : 0;
    return status;
}

/* Evaluate dJ/dx at all nodes but the latest; x as above. */
static int evaluate_slopes(const fvi_objective *J, const double *x, block *b)
{
    int status = FVI_SUCCESS;
    for (size_t i = 1; !status && i <= b->count; i++) {
        b->Jx[i] = 0;
        status = J->slopes(b->last - i, 1, x - i, NULL, J->params, &b->Jx[i], NULL);
    }
    return status;
}

/* Push lambda_k. Writes N_k, and its derivative by 2 alpha if that is wanted. */
static int push_multiplier(const fvi_adjoint_multistep *m, size_t i, block *b)
{
    const fvi_damping *damping = m->each->damping;
    const double *lambda = &b->lambda[i + 1], *delta = &b->delta[i];
    return damping->Hdot ? fvi_history_push_by_order(damping->memory, lambda, delta, &b->N[i], &b->Ndot[i])
                         : fvi_history_push(damping->memory, lambda, delta, &b->N[i]);
}

//> alone
/* The recurrence (9.4) of lambda, from node `last` on. */
static int step_multipliers(fvi_adjoint_multistep *m, block *b)
{
    const double h = m->run->h, kappa = m->kappa, share = (1 - kappa) * h,
                 factor = *m->each->damping->factor;
    double p = *m->stepper->p;
    int status = FVI_SUCCESS;
    b->lambda[0] = *m->stepper->x;
    for (size_t i = 0; !status && i < b->count; i++) {
        const double G = b->G[i], J = m->inertia + share * kappa * G, right = b->lambda[i];
        p += b->Jx[i];
        b->delta[i] = (p - share * (G * right)) / J;
        b->lambda[i + 1] = right + b->delta[i];
        b->M[i] = right + kappa * b->delta[i];
        b->g[i] = h * (G * b->M[i]);
        status = J == 0 ? FVI_ESING : push_multiplier(m, i, b);
        p = p - b->g[i] - factor * b->N[i];
    }
    *m->stepper->x = b->lambda[b->count];
    *m->stepper->p = p;
    return status;
}
//< alone

/* Add to all sums, in the order of the steps. */
static void accumulate_sums(fvi_adjoint_multistep *m, const block *b)
{
    const double h = m->run->h;
    fvi_adjoint_damper *a = m->each;
    double start = *m->by_start, kinetic = *m->kinetic, sum = *a->sum, by_order = *a->sum_by_order,
           *force = m->want->force;
    for (size_t i = 0; i < b->count; i++) {
        start += b->Jx[i] - b->g[i];
        kinetic -= b->moved[i] * b->delta[i];
        sum += b->z[i] * b->N[i];
        by_order += b->z[i] * b->Ndot[i];
    }
    for (size_t i = 0; a->has_drift && i < b->count; i++)
        *m->by_line +=
            (double)(b->last - i) * h * (b->Jx[i] - b->g[i]) + m->kappa * h * b->g[i];
    for (size_t i = 0; force && i < b->count; i++)
        force[b->last - i] += h * b->lambda[i];
    *m->by_start = start;
    *m->kinetic = kinetic;
    *a->sum = sum;
    *a->sum_by_order = by_order;
}

/* Add the derivatives by the parameters of U; M is the multiplier of S. */
static int accumulate_parameters(const fvi_adjoint_multistep *m, const block *b)
{
    const fvi_parameter_gradient *by = &m->want->sensitivity;
    void *params = m->run->system->potential.params;
    const double h = m->run->h;
    double *sums = m->want->parameters, column;
    int status = FVI_SUCCESS;
    for (size_t p = 0; sums && p < by->count; p++) {
        double sum = sums[p];
        for (size_t i = 0; !status && i < b->count; i++) {
            status = by->column(p, 1, &b->S[i], params, &column);
            sum -= h * (column * b->M[i]);
        }
        sums[p] = sum;
    }
    return status;
}

/* Take the steps from node `last` to node `first`, whose positions begin at x. Jx: in: dJ/dx of node `last`; out: of
 * node `first`. */
static int walk_piece(fvi_adjoint_multistep *m, const fvi_objective *J, size_t first, size_t last,
                      const double *x, double *Jx)
{
    block b = { .last = last };
    int status = FVI_SUCCESS;
    for (b.Jx[0] = *Jx; !status && b.last > first; b.last -= b.count) {
        const double *latest = x + (b.last - first);
        b.count = b.last - first < BLOCK ? b.last - first : BLOCK;
        read_path(m, latest, &b);
        status = fvi_interrupted();
        if (!status)
            status = evaluate_hessians(m, &b);
        if (!status)
            status = evaluate_slopes(J, latest, &b);
        if (!status)
            status = step_multipliers(m, &b);
        accumulate_sums(m, &b);
        if (!status)
            status = accumulate_parameters(m, &b);
        b.Jx[0] = b.Jx[b.count];
    }
    *Jx = b.Jx[0];
    return status;
}

int fvi_adjoint_multistep_walk_in_blocks(fvi_adjoint_multistep *m, fvi_checkpointing *path,
                                         const fvi_objective *J, double *Jx)
{
    int status = FVI_SUCCESS;
    for (size_t k = m->run->steps, first; !status && k > 0; k = first) {
        const double *rows; /* x_{k-1} and x_k; the rows of the other nodes of the piece stand before them */
        status = fvi_checkpointing_step(path, k - 1, &rows);
        first = fvi_checkpointing_first(path);
        if (!status)
            status = walk_piece(m, J, first, k, rows - (k - 1 - first), Jx);
    }
    return status;
}

/* ---- the step of a method of order 2, (13.10) ---- */

int fvi_adjoint_multistep_has_one_coordinate(const fvi_adjoint_multistep *m)
{
    const fvi_cq_state *o = m->stepper->method_state;
    return !m->paper_convention && m->d == 1 && m->each->damping && m->each->damping->covers_all
           && !m->run->system->matrices && o->count == 1
           && !o->each->history_force.size && *m->each->damping->drift == 0;
}

/* Apply the factor of the weights to the sequence whose latest term is `term`. */
static double filter_term(fvi_cq_damper *a, double term)
{
    if (a->taps == 0)
        return term;
    a->place = (a->place ? a->place : a->taps) - 1;
    double *past = a->past + a->place;
    past[0] = past[a->taps] = term;
    return fvi_dot(a->taps, a->g, past);
}

/* Write the sum of the later end as far as it is known before the step. */
static int predict_history(const fvi_cq_damper *a, double z, double *ahead)
{
    const int status = fvi_history_ahead(a->damping->memory, &z, ahead);
    if (a->taps && a->damping->sums_increments)
        *ahead += a->g[1] * a->past[a->place];
    return status;
}

//> advance
int fvi_adjoint_multistep_step_one_coordinate(fvi_adjoint_multistep *m)
{
    fvi_stepper *s = m->stepper;
    const fvi_newton *n = s->newton;
    fvi_cq_damper *a = ((fvi_cq_state *)s->method_state)->each;
    fvi_damping *d = a->damping;
    const double h = m->run->h, G = m->has_hessian ? *m->G : 0, x = *s->x,
                 J = *n->A + *n->s * n->theta * G;
    double p = *s->p, ahead = 0;
    int status = FVI_SUCCESS;
    if (a->theta != 0.5)
        p -= (0.5 - a->theta) * *d->factor * *a->H;
    if (a->theta != 0)
        status = predict_history(a, x - *d->origin, &ahead);
    const double r = a->theta != 0 ? p - a->theta * *d->factor * ahead : p,
                 dx = (r - *n->s * (G * x)) / J, g = G * (x + n->theta * dx);
    double z = x + dx - *d->origin, dz = dx;
    p -= h * g;
    *(a->damping->sums_increments ? &dz : &z) = filter_term(a, a->damping->sums_increments ? dz : z);
    const int pushed = d->Hdot
                           ? fvi_history_push_by_order(d->memory, &z, &dz, d->H, d->Hdot)
                           : fvi_history_push(d->memory, &z, &dz, d->H);
    *a->H = *d->H;
    *s->x = x + dx;
    *s->p = p - (0.5 + a->theta) * *d->factor * *a->H;
    *s->g = g;
    return J == 0 ? FVI_ESING : status ? status : pushed;
}
//< advance
