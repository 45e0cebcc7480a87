/* src/sensitivity/adjoint_lobatto.c -- The run that goes backwards through stages.
 *                                                                     [H 23] */
#include "adjoint_lobatto.h"

#include "methods/lobatto_stages.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

enum { LONG = 5, SHORT = 11 }; /* arrays of s d and of d numbers */

static int allocate(fvi_adjoint_lobatto *m)
{
    const size_t s = m->s, d = m->d;
    const fvi_system *system = m->run->system;
    const size_t hessian =
        system->potential.hessian ? fvi_potential_hessian_size(system) : 0;
    double **longs[LONG] = { &m->Lambda, &m->T, &m->past, &m->pastdot, &m->r };
    double **shorts[SHORT] = { &m->column, &m->Q,       &m->mass,   &m->after,
                               &m->last,   &m->kinetic, &m->sum,    &m->sumdot,
                               &m->plain,  &m->pull,    &m->impulse_sum_by_order };
    m->block = calloc((LONG * s + SHORT) * d + s * hessian, sizeof *m->block);
    if (!m->block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    double *next = m->block;
    for (size_t i = 0; i < LONG; i++, next += s * d)
        *longs[i] = next;
    for (size_t i = 0; i < SHORT; i++, next += d)
        *shorts[i] = next;
    m->G = hessian ? next : NULL;
    const size_t w =
        system->potential.diagonals ? system->potential.diagonals : d;
    const size_t n = m->damped_inertia ? s : s - 1; /* unknown stages */
    if (fvi_band_alloc(n * d, n * w, &m->J))
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

static int start_memory(fvi_adjoint_lobatto *m)
{
    const fvi_run *run = m->run;
    const size_t s = m->s;
    const double beta = 2 * run->alpha - 1;
    m->is_damped = m->want->damping != NULL || m->want->alpha != NULL;
    for (size_t i = 0; i < m->d; i++)
        m->is_damped |= run->system->damping[i] > 0;
    m->unit = run->law ? 1 : pow(run->h, -beta);
    for (size_t i = 0; i < s; i++)
        m->W[i][i] = !m->mass_plus_damping; /* beta = 0; nothing */
    if (!m->is_damped || m->mass_plus_damping
        || (!run->law && beta == 0 && !m->want->alpha))
        return FVI_SUCCESS;
    const double keep = fvi_lobatto_history_tolerance(run);
    int status =
        run->law
            ? fvi_lobatto_history_of_kernel(s, run->law, run->h, m->d, run->steps,
                                        run->memory, keep, &m->memory)
            : (m->want->alpha ? fvi_lobatto_history_alloc_by_order
                              : fvi_lobatto_history_alloc)(
                s, beta, m->d, run->steps, run->memory, keep, &m->memory);
    if (!status)
        status = fvi_adjoint_terms_start(m);
    for (size_t i = 0; !status && i < s; i++) {
        memcpy(m->W[i], fvi_lobatto_history_now(m->memory) + i * s,
               s * sizeof(double));
        if (m->want->alpha)
            memcpy(m->rate[i], fvi_lobatto_history_now_by_order(m->memory) + i * s,
                   s * sizeof(double));
    }
    return status;
}

int fvi_adjoint_lobatto_start(const fvi_method *method, const fvi_run *run,
                            const fvi_sensitivities *want, const double *p,
                            const double *Jp, fvi_adjoint_lobatto *m)
{
    const size_t s = (size_t)method->stages;
    *m = (fvi_adjoint_lobatto){ .own = *run,
                              .run = &m->own,
                              .want = want,
                              .rule = fvi_lobatto(s),
                              .s = s,
                              .d = run->system->d,
                              .damped_inertia = method->damped_inertia,
                              .mass_plus_damping = run->alpha == 1 && !run->law
                                       && !method->damped_inertia };
    run = m->run;
    if (run->law) /* as the run does: nothing pulls */
        m->own.alpha = 0.5;
    int status = allocate(m);
    if (!status)
        status = start_memory(m);
    if (status)
        return status;
    fvi_adjoint_lobatto_matrices(m);
    for (size_t j = 0; j < m->d; j++) { /* lambda_N, as the first of a step N */
        const double mass = run->system->mass[j];
        m->mass[j] = mass + (m->mass_plus_damping ? run->system->damping[j] : 0);
        m->Lambda[j * s] = Jp[j] * mass / m->mass[j];
        m->last[j] = Jp[j] * p[j];
    }
    m->has_initial_impulses = m->is_damped && fvi_initial_history_acts(run->past, run->alpha);
    if (m->has_initial_impulses)
        fvi_kernel_impulse_prepare(run->alpha, m->s, m->rule->c, &m->initial_impulse);
    return FVI_SUCCESS;
}

void fvi_adjoint_lobatto_stop(fvi_adjoint_lobatto *m)
{
    fvi_lobatto_history_free(m->memory);
    fvi_adjoint_terms_stop(m);
    fvi_band_free(&m->J);
    free(m->block);
}

/* ---- a step ---- */

/* Where the stages are: behind x_k in form D, from x_k on in form M. */
static const double *positions(const fvi_adjoint_lobatto *m, const double *rows)
{
    return rows + (m->damped_inertia ? m->d : 0);
}

static int evaluate_hessians(fvi_adjoint_lobatto *m, const double *rows)
{
    const fvi_potential *u = &m->run->system->potential;
    const size_t room = fvi_potential_hessian_size(m->run->system);
    const double *X = positions(m, rows);
    int status = FVI_SUCCESS;
    for (size_t i = 0; m->G && !status && i < m->s; i++)
        status = u->hessian(m->d, X + i * m->d, u->params, m->G + i * room);
    return status;
}

/* The velocities of all stages of coordinate j: D X / h, of form D with the penalty of
 * (17.3), as x_k is not X_1 there. */
static void velocities(const fvi_adjoint_lobatto *m, size_t j, const double *rows,
                       double *v)
{
    const double *X = positions(m, rows) + j;
    for (size_t i = 0; i < m->s; i++) {
        v[i] = 0;
        for (size_t l = 0; l < m->s; l++)
            v[i] += m->rule->D[i][l] * (X[l * m->d] - rows[j]) / m->run->h;
    }
    if (m->damped_inertia)
        v[0] += (X[0] - rows[j]) / m->rule->b[0] / m->run->h;
}

/* dJ/dm but for v_0, times h: Lambda . K X in form M; in form D what m multiplies. */
static double inertia(const fvi_adjoint_lobatto *m, size_t j, const double *rows,
                      const double *v)
{
    const double *Lambda = m->Lambda + j * m->s;
    double sum = 0;
    for (size_t i = 0; i < m->s; i++)
        for (size_t l = 0; l < m->s; l++)
            sum += m->damped_inertia ? -m->run->h * Lambda[i] * m->rule->b[i]
                                           * m->rule->D[i][l] * v[l]
                                     : Lambda[i] * m->K[i][l]
                                           * (rows[l * m->d + j] - rows[j]);
    if (m->damped_inertia) /* v_{k+1} is v[s-1] */
        sum += m->run->h * (m->after[j] * v[m->s - 1] - Lambda[0] * v[0]);
    return sum;
}

/* T = W_0 P Lambda + what was known, and what it and Lambda meet. */
static void accumulate_damping(fvi_adjoint_lobatto *m, const double *rows)
{
    const size_t s = m->s;
    for (size_t j = 0; j < m->d; j++) {
        const double *Lambda = m->Lambda + j * s;
        const double v0 =
            m->run->alpha > 0.5 ? m->run->p0[j] / m->run->system->mass[j] : 0;
        double v[FVI_STAGES] = { 0 };
        velocities(m, j, rows, v);
        m->kinetic[j] += inertia(m, j, rows, v);
        for (size_t i = 0; i < s; i++) {
            double T = m->past[j * s + i], Tdot = m->pastdot[j * s + i];
            for (size_t l = 0; l < s; l++) {
                T += m->W[i][l] * Lambda[s - 1 - l];
                Tdot += m->rate[i][l] * Lambda[s - 1 - l];
            }
            m->sum[j] += m->rule->b[i] * (v[s - 1 - i] - v0) * T;
            m->sumdot[j] += m->rule->b[i] * (v[s - 1 - i] - v0) * Tdot;
            m->plain[j] += m->rule->b[i] * T;
        }
        fvi_adjoint_terms_accumulate(m, j, v);
    }
}

/* What the force and the past give to the stages. */
static void accumulate_force(fvi_adjoint_lobatto *m, size_t k)
{
    const size_t s = m->s, d = m->d;
    double at[FVI_STAGES] = { 0 }, slope[FVI_STAGES] = { 0 };
    double *force = m->want->force;
    if (m->has_initial_impulses)
        fvi_kernel_impulses(&m->initial_impulse, k, at);
    if (m->has_initial_impulses && m->want->alpha)
        fvi_kernel_impulses_by_order(&m->initial_impulse, k, slope);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < d; j++) {
            const double Lambda = m->Lambda[j * s + i];
            if (force)
                force[(k * (s - 1) + i) * d + j] +=
                    m->run->h * m->rule->b[i] * Lambda;
            m->pull[j] += at[i] * Lambda;
            m->impulse_sum_by_order[j] += slope[i] * Lambda;
        }
}

static int accumulate_parameters(fvi_adjoint_lobatto *m, const double *rows)
{
    const fvi_parameter_gradient *by = &m->want->sensitivity;
    const size_t d = m->d;
    int status = FVI_SUCCESS;
    for (size_t i = 0; m->want->parameters && i < m->s; i++)
        for (size_t p = 0; !status && p < by->count; p++) {
            status = by->column(p, d, positions(m, rows) + i * d,
                                m->run->system->potential.params, m->column);
            for (size_t j = 0; j < d; j++)
                m->want->parameters[p] -= m->run->h * m->rule->b[i]
                                          * m->column[j]
                                          * m->Lambda[j * m->s + i];
        }
    return status;
}

/* P Lambda goes into the memory, and out comes what is known of the next T. */
static int update_history(fvi_adjoint_lobatto *m)
{
    const size_t s = m->s;
    if (!m->memory)
        return FVI_SUCCESS;
    for (size_t j = 0; j < m->d; j++)
        for (size_t i = 0; i < s; i++)
            m->T[j * s + i] = m->Lambda[j * s + s - 1 - i];
    const int status = fvi_lobatto_history_push_by_order(
        m->memory, m->T, m->past, m->want->alpha ? m->pastdot : NULL);
    return status ? status : fvi_adjoint_terms_update_history(m);
}

int fvi_adjoint_lobatto_step(fvi_adjoint_lobatto *m, size_t k, const double *rows,
                           const double *Jx)
{
    for (size_t j = 0; j < m->d; j++) {
        m->Q[j] += Jx[j];
        m->after[j] = m->Lambda[j * m->s]; /* lambda_{k+1} */
    }
    int status = evaluate_hessians(m, rows);
    if (!status)
        status = fvi_adjoint_lobatto_solve(m);
    if (!status)
        status = accumulate_parameters(m, rows);
    if (status)
        return status;
    accumulate_force(m, k);
    if (m->is_damped || m->want->mass)
        accumulate_damping(m, rows);
    return update_history(m);
}

/* ---- the end ---- */

/* What depends on rho, on alpha and on v0 through the damping of coordinate j. */
static void end_damping(const fvi_adjoint_lobatto *m, size_t j, double pulled,
                        double v0)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const double rho = run->system->damping[j], mass = run->system->mass[j];
    const double A = fvi_initial_history_amplitude(run->past, run->alpha, run->x0[j], v0),
                 log_h = log(run->h);
    if (want->damping) {
        want->damping[j] = -A * pulled * m->pull[j];
        want->damping[j] += m->mass_plus_damping ? m->kinetic[j] / run->h
                                           + m->Lambda[j * m->s] * v0
                                           - m->last[j] / m->mass[j]
                                     : -run->h * m->unit * m->sum[j];
    }
    if (want->alpha) /* e falls by 2 dalpha, beta grows by it */
        *want->alpha +=
            2 * rho
            * (A * pulled * (log_h * m->pull[j] + m->impulse_sum_by_order[j])
               - run->h * m->unit * (m->sumdot[j] - log_h * m->sum[j]));
    if (m->mass_plus_damping && want->mass)
        want->mass[j] +=
            rho / mass * (m->last[j] / m->mass[j] - m->Lambda[j * m->s] * v0);
    if (m->mass_plus_damping && want->p0)
        want->p0[j] += m->Lambda[j * m->s] * rho / mass;
}

int fvi_adjoint_lobatto_end(fvi_adjoint_lobatto *m, const double *Jx)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const int above = run->alpha > 0.5;
    const double pulled = m->has_initial_impulses ? pow(run->h, 1 + m->initial_impulse.e) : 0;
    for (size_t j = 0; j < m->d; j++) {
        const double rho = run->system->damping[j], mass = run->system->mass[j],
                     v0 = run->p0[j] / mass;
        const double by_A = -rho * pulled * m->pull[j];
        const double by_v0 =
            above ? by_A + (m->mass_plus_damping ? 0 : run->h * rho * m->unit * m->plain[j])
                  : 0;
        m->Q[j] += Jx[j];
        if (want->x0)
            want->x0[j] = m->Q[j] + (above ? 0 : by_A);
        if (want->x0 && above && rho > 0
            && run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
            want->x0[j] = NAN; /* (19.2) */
        if (want->p0)
            want->p0[j] = m->Lambda[j * m->s] + by_v0 / mass;
        if (want->mass)
            want->mass[j] = m->kinetic[j] / run->h - by_v0 * v0 / mass;
        end_damping(m, j, pulled, v0);
    }
    return fvi_all_finite(m->d, m->Q) ? FVI_SUCCESS : FVI_EOVRFLW;
}
