/* src/adjoint_mechanism/adjoint_mechanism.c -- The adjoint run of a system with a mechanism: its checks, its record and
 * the walk back. [H 23, 29] */
#include "adjoint_mechanism.h"

#include "system/arrays.h"
#include "system/fail.h"
#include "system/lagrangian_point.h"

#include <stdlib.h>
#include <string.h>

/* ---- which derivatives are known ---- */

static int check_dampers(const fvi_method *method, const fvi_mechanism *mechanism,
                         const fvi_sensitivities *want)
{
    const int by_numbers = want->orders || want->times || want->ends || want->terms;
    for (size_t j = 0; j < mechanism->damper_count; j++) {
        const fvi_damper *damper = mechanism->damper + j;
        const fvi_kernel *kernel = damper->kernel;
        const int is_power = kernel->count == 1 && kernel->term->kind == FVI_KERNEL_POWER;
        if (!damper->of.row && !damper->of.hessian)
            FVI_FAIL("the adjoint of a damper asks for the second derivatives of its elongation",
                     FVI_EUNSUP);
        if (method->stages && by_numbers && !is_power && fvi_kernel_growth(kernel) > 1)
            FVI_FAIL("with stages a sum of laws that grows faster than s has no derivative by "
                     "its numbers; by fvi-stable it has",
                     FVI_EUNSUP);
    }
    return FVI_SUCCESS;
}

int fvi_adjoint_mechanism_check(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want)
{
    const fvi_mechanism *mechanism = run->system->mechanism;
    if (want->alpha)
        FVI_FAIL("several dampers have orders, and no alpha", FVI_EINVAL);
    if (mechanism->constraints && mechanism->constraints->count > 0
        && !mechanism->constraints->hessian)
        FVI_FAIL("the adjoint of constraints asks for their second derivatives", FVI_EUNSUP);
    if (mechanism->lagrangian && want->mass)
        FVI_FAIL("a Lagrangian has no masses to differentiate by", FVI_EINVAL);
    if (mechanism->lagrangian && want->parameters && !want->lagrangian)
        FVI_FAIL("derivatives by the parameters of a Lagrangian need its sensitivity",
                 FVI_EINVAL);
    const fvi_mechanism_columns *by = want->columns;
    if (want->names && (!by || (mechanism->force_on && !by->force)
                        || (mechanism->damper_count && !by->elongation)
                        || (mechanism->constraints && !by->constraint)))
        FVI_FAIL("derivatives by the numbers of a mechanism need its columns", FVI_EINVAL);
    return check_dampers(method, mechanism, want);
}

/* ---- the run and its record ---- */

int fvi_adjoint_mechanism_allocate(fvi_adjoint_mechanism *m)
{
    const size_t d = m->d, r = m->r, s = m->s, n = m->n, c = m->o->m;
    m->block = FVI_ARRAYS({ &m->last, 3 * d + c }, { &m->G0, r * d }, { &m->v0, d + c }, { &m->z0, r }, { &m->g, d },
                          { &m->beta, d }, { &m->next, d }, { &m->multiplier, n + d }, { &m->phi, s * d },
                          { &m->kappa, s * d }, { &m->tau, s * d }, { &m->matrix, n * n },
                          { &m->projection, (d + c) * (d + c) }, { &m->gradient, c * d }, { &m->factors, c },
                          { &m->column, (2 + c) * (d + 2) }, { &m->room, 2 * (d + 1) * (d + 1) + 2 * d });
    m->order = calloc(n + d + c, sizeof *m->order);
    m->damper = calloc(r + 1, sizeof *m->damper);
    if (!m->block || !m->order || !m->damper)
        FVI_FAIL("no memory for the steps of the run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* The record of step k: x_k, u, the forces of the dampers, their impulses of the start, and v_k and w_k, one after
 * another. */
static double *record_at(const fvi_adjoint_mechanism *m, size_t k)
{
    return m->record + k * m->row;
}

static int start(const fvi_method *method, fvi_adjoint_mechanism *m)
{
    int status = fvi_stepper_start(method, m->run, &m->stepper, NULL);
    if (status)
        return status;
    fvi_mechanism_state *o = m->o = m->stepper->method_state;
    m->r = o->r;
    m->s = o->s;
    m->n = o->n;
    m->row = 2 * m->d + m->n + m->r * m->s + 2 * m->r + o->m;
    if (o->any_massless)
        FVI_FAIL("no adjoint by fvi-stable of a coordinate without inertia; by fvi-lobatto2d to 8d "
                 "there is",
                 FVI_EUNSUP);
    status = fvi_adjoint_mechanism_allocate(m);
    if (status)
        return status;
    m->record = malloc((m->run->steps * m->row + 1) * sizeof *m->record);
    if (!m->record)
        FVI_FAIL("no memory for the steps of the run", FVI_ENOMEM);
    memcpy(m->G0, o->G, m->r * m->d * sizeof *m->G0);
    memcpy(m->z0, o->z, m->r * sizeof *m->z0);
    memcpy(m->v0, o->v, m->d * sizeof *m->v0);
    if (m->want->mass)
        memset(m->want->mass, 0, m->d * sizeof *m->want->mass);
    for (size_t j = 0; !status && j < m->r; j++)
        status = fvi_adjoint_mechanism_damper_start(m, j);
    return status;
}

/* Write v and w at the node of the stepper. */
static void store_velocity(const fvi_adjoint_mechanism *m, double *to)
{
    const fvi_mechanism_state *o = m->o;
    const double last = o->rule ? o->rule->b[m->s - 1] : 0.5;
    memcpy(to, o->v, m->d * sizeof *to);
    for (size_t l = 0; l < o->m; l++)
        to[m->d + l] = m->run->h * last * o->ended[l];
    for (size_t l = 0; o->rule && o->begin == 0 && l < o->m; l++) /* the last stage of form D has an impulse of its
                                                                     own */
        to[m->d + l] -= o->u[o->s * m->d + (o->s - 1) * o->m + l] / m->run->h;
}

static int run_forwards(fvi_adjoint_mechanism *m)
{
    const fvi_mechanism_state *o = m->o;
    const size_t d = m->d, force = m->r * m->s, behind = d + m->n + force + 2 * m->r;
    int status = FVI_SUCCESS;
    for (size_t k = 0; !status && k < m->run->steps; k++) {
        double *to = record_at(m, k);
        memcpy(to, m->stepper->x, d * sizeof *to);
        store_velocity(m, to + behind);
        status = fvi_stepper_step(m->stepper);
        memcpy(to + d, o->u, m->n * sizeof *to);
        memcpy(to + d + m->n, o->rule ? o->known : o->lambda, force * sizeof *to);
        memcpy(to + d + m->n + force, o->start_impulse, 2 * m->r * sizeof *to);
    }
    memcpy(m->last, m->stepper->x, d * sizeof *m->last);
    memcpy(m->last + d, m->stepper->p, d * sizeof *m->last);
    store_velocity(m, m->last + 2 * d);
    return status;
}

/* Put the stepper back to step k, and linearise its equation at the root. */
static int restore_step(fvi_adjoint_mechanism *m, size_t k)
{
    const double *from = record_at(m, k);
    const size_t d = m->d, force = m->r * m->s;
    fvi_stepper *s = m->stepper;
    fvi_mechanism_state *o = m->o;
    s->k = k;
    m->unknown = from + d;
    memcpy(s->x, from, d * sizeof *from);
    memcpy(o->rule ? o->known : o->lambda, from + d + m->n, force * sizeof *from);
    memcpy(o->start_impulse, from + d + m->n + force, 2 * m->r * sizeof *from);
    const fvi_constraints *c = m->run->system->mechanism->constraints;
    const double t = (double)k * m->run->h;
    int status = fvi_mechanism_elongations(s, t, s->x, o->z, o->G);
    if (!status && o->m)
        status = c->gradient(t, d, s->x, c->params, o->C, NULL);
    return status ? status : fvi_mechanism_linearise(s, from + d);
}

/* ---- masses and parameters ---- */

int fvi_adjoint_mechanism_point(fvi_adjoint_mechanism *m, size_t i, double t, const double *tau,
                                const double *phi)
{
    const fvi_system *system = m->run->system;
    const fvi_lagrangian *L = fvi_lagrangian_of(system);
    const fvi_sensitivities *want = m->want;
    const size_t d = m->d;
    const double *X = m->o->X + i * d, *V = m->o->V + i * d;
    double *S = m->room, *Sv = S + d;
    int status = FVI_SUCCESS;
    for (size_t j = 0; want->mass && j < d; j++)
        want->mass[j] += tau[j] * V[j];
    for (size_t p = 0; want->parameters && !status && p < want->sensitivity.count; p++) {
        memset(S, 0, 2 * d * sizeof *S);
        if (L)
            status = want->lagrangian(p, t, d, X, V, L->params, S, Sv);
        else
            status = want->sensitivity.column(p, d, X, system->potential.params, S);
        for (size_t j = 0; j < d; j++)
            want->parameters[p] += (L ? S[j] : -S[j]) * phi[j] + Sv[j] * tau[j];
    }
    return status;
}

/* ---- the start of the run ---- */

/* v0 is the velocity of p0, as at every node, and the multipliers w are 0 there. */
int fvi_adjoint_mechanism_add_velocity(fvi_adjoint_mechanism *m, const double *by_v)
{
    int moves = 0;
    for (size_t i = 0; i < m->d; i++)
        moves |= by_v[i] != 0;
    return moves ? fvi_adjoint_mechanism_project(m, 0, m->run->x0, m->v0, m->v0 + m->d, by_v) : FVI_SUCCESS;
}

static int finish(fvi_adjoint_mechanism *m)
{
    const fvi_sensitivities *want = m->want;
    const size_t d = m->d;
    double *by_v = m->next;
    int status = FVI_SUCCESS;
    memset(by_v, 0, d * sizeof *by_v);
    for (size_t j = 0; !status && j < m->r; j++)
        status = fvi_adjoint_mechanism_damper_end(m, m->damper + j, m->g, by_v);
    if (!status)
        status = fvi_adjoint_mechanism_names_check(m);
    if (!status)
        status = fvi_adjoint_mechanism_add_velocity(m, by_v);
    if (want->x0)
        memcpy(want->x0, m->g, d * sizeof *m->g);
    for (size_t j = 0; j < m->r && !status; j++)
        status = fvi_adjoint_mechanism_damper_bar(m, m->damper + j, want->x0);
    if (want->p0)
        memcpy(want->p0, m->beta, d * sizeof *m->beta);
    return status;
}

/* ---- the walk back ---- */

/* Add dJ/dx_k and dJ/dp_k to g and beta. */
static int add_slopes(fvi_adjoint_mechanism *m, size_t k)
{
    const fvi_objective *J = m->J;
    const size_t d = m->d, N = m->run->steps;
    double *Jx = m->next, *Jp = m->room;
    memset(Jx, 0, d * sizeof *Jx);
    memset(Jp, 0, d * sizeof *Jp);
    const int is_last = k == N;
    const int status =
        J->slopes(k, d, is_last ? m->last : record_at(m, k), is_last ? m->last + d : NULL,
                  J->params, Jx, is_last || J->has_momenta ? Jp : NULL);
    for (size_t i = 0; i < d; i++) {
        m->g[i] += Jx[i];
        m->beta[i] += Jp[i];
    }
    const double *v = is_last ? m->last + 2 * d : record_at(m, k) + m->row - d - m->o->m;
    return status ? status
                  : fvi_adjoint_mechanism_project(m, (double)k * m->run->h,
                                                  is_last ? m->last : record_at(m, k), v, v + d, NULL);
}

void fvi_adjoint_mechanism_stop(fvi_adjoint_mechanism *m)
{
    for (size_t j = 0; m->damper && j < m->r; j++)
        fvi_adjoint_mechanism_damper_stop(m->damper + j);
    fvi_stepper_free(m->stepper);
    free(m->damper);
    free(m->record);
    free(m->block);
    free(m->order);
}

//> walk-mechanism
int fvi_adjoint_mechanism_run(const fvi_method *method, const fvi_run *run,
                              const fvi_objective *J, const fvi_sensitivities *want)
{
    fvi_adjoint_mechanism m = { .run = run, .want = want, .J = J, .d = run->system->d };
    int status = start(method, &m);
    if (!status)
        status = run_forwards(&m);
    if (!status)
        status = add_slopes(&m, run->steps);
    for (size_t k = run->steps; !status && k-- > 0;) {
        if (k % 64 == 0)
            status = fvi_interrupted();
        if (!status)
            status = restore_step(&m, k);
        if (!status)
            status = (m.o->rule ? fvi_adjoint_mechanism_stages : fvi_adjoint_mechanism_nodes)(&m, k);
        if (!status)
            status = add_slopes(&m, k);
    }
    if (!status)
        status = finish(&m);
    fvi_adjoint_mechanism_stop(&m);
    return status;
}
//< walk-mechanism
