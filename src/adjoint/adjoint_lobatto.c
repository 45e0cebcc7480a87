/* src/adjoint/adjoint_lobatto.c -- The adjoint run of a chain with stages. [H 23] */
#include "adjoint_lobatto.h"

#include "parameter_derivatives/potential_derivatives.h"
#include "methods/lobatto_stages.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

static int allocate(fvi_adjoint_lobatto *m)
{
    const size_t s = m->s, d = m->d;
    m->block = FVI_ARRAYS({ &m->Lambda, s * d }, { &m->reversed, s * d }, { &m->column, d }, { &m->Q, d },
                          { &m->mass, d }, { &m->after, d }, { &m->last, d }, { &m->hessian_product, d },
                          { &m->T, d }, { &m->Tdot, d }, { &m->kinetic, d }, { &m->sum, d }, { &m->sumdot, d },
                          { &m->plain, d }, { &m->impulse_sum, d }, { &m->impulse_sum_by_order, d }, { &m->jump, d },
                          { &m->G, s * m->linearised.size });
    if (!m->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    if (m->linearised.size == 0)
        m->G = NULL;
    return FVI_SUCCESS;
}

/* Start the adjoint run at node N. In form M it begins at J_p, or at m/(m + rho) J_p at alpha = 1. In form D it begins
 * with the velocity J_p. The run starts with p0 = 0, so that no history takes J_p for the velocity of a line. */
static int start_stepper(fvi_adjoint_lobatto *m, const fvi_method *method,
                         const double *Jp)
{
    fvi_run back = *m->run;
    double *x0 = m->reversed; /* still zeros */
    m->linearised.G = m->G;
    m->linearised.reversed = 1;
    m->linearised.by_order = m->want->alpha != NULL;
    m->linearised.history_includes_undamped = m->is_damped;
    m->linearised.from_zero = !m->damped_inertia;
    m->linearised.is_dual = m->damped_inertia;
    m->system = fvi_linearised_system(m->run->system, &m->linearised);
    back.system = &m->system;
    back.p0 = m->after;
    back.x0 = m->damped_inertia ? m->after : x0;
    back.past = FVI_INITIAL_HISTORY_HELD;
    for (size_t j = 0; j < m->d; j++)
        x0[j] = Jp[j] * m->run->system->mass[j] / m->mass[j];
    int status = fvi_stepper_start(method, &back, &m->stepper, NULL);
    for (size_t j = 0; !status && m->damped_inertia && j < m->d; j++)
        m->stepper->p[j] = m->run->system->mass[j] * x0[j];
    for (size_t j = 0; j < m->d; j++)
        m->Lambda[j * m->s] = x0[j]; /* lambda_N, as if it were the first stage of a step N */
    return status;
}

int fvi_adjoint_lobatto_start(const fvi_method *method, const fvi_run *run,
                            const fvi_sensitivities *want, int has_jumps, const double *p,
                            const double *Jp, fvi_adjoint_lobatto *m)
{
    const size_t s = (size_t)method->stages;
    *m = (fvi_adjoint_lobatto){ .run_copy = *run,
                              .run = &m->run_copy,
                              .want = want,
                              .rule = fvi_lobatto(s),
                              .s = s,
                              .d = run->system->d,
                              .damped_inertia = method->damped_inertia,
                              .mass_plus_damping =
                                  run->alpha == 1 && !method->damped_inertia,
                              .linearised = fvi_linearised_begin(run->system, s) };
    run = m->run;
    int status = allocate(m);
    if (status)
        return status;
    m->is_damped = want->damping != NULL || want->alpha != NULL;
    for (size_t j = 0; j < m->d; j++) {
        const double mass = run->system->mass[j], rho = run->system->damping[j];
        m->is_damped |= rho > 0;
        m->mass[j] = mass + (m->mass_plus_damping ? rho : 0);
        m->last[j] = Jp[j] * p[j];
    }
    status = start_stepper(m, method, Jp);
    if (!status && has_jumps && !m->damped_inertia) {
        fvi_lobatto_stages *o = m->stepper->method_state;
        o->jump = m->jump; /* none at node N, where x0 is the jump */
    }
    if (!status && m->is_damped && fvi_wanted_kernel_numbers(want))
        status = fvi_stage_terms_start(run, want, s, m->d, fvi_lobatto_history_tolerance(run), run->law,
                                       &m->terms);
    fvi_lobatto_table(m->rule, s, m->A);
    m->has_initial_impulses = m->is_damped && fvi_initial_history_acts(run->past, run->alpha);
    if (m->has_initial_impulses)
        fvi_kernel_impulse_prepare(run->alpha, m->s, m->rule->c, &m->initial_impulse);
    return status;
}

void fvi_adjoint_lobatto_stop(fvi_adjoint_lobatto *m)
{
    fvi_stepper_free(m->stepper);
    fvi_stage_terms_stop(&m->terms);
    free(m->block);
}

/* ---- a step ---- */

/* The positions of the stages: they begin behind x_k in form D, and with x_k in form M. */
static const double *find_stage_positions(const fvi_adjoint_lobatto *m, const double *rows)
{
    return rows + (m->damped_inertia ? m->d : 0);
}

/* Write the velocities of all stages of coordinate j, D X / h. In form D the first one has the penalty of (17.3),
 * because X_1 is not x_k there. */
static void find_stage_velocities(const fvi_adjoint_lobatto *m, size_t j, const double *rows,
                                  double *v)
{
    const double *X = find_stage_positions(m, rows) + j;
    for (size_t i = 0; i < m->s; i++) {
        v[i] = 0;
        for (size_t l = 0; l < m->s; l++)
            v[i] += m->rule->D[i][l] * (X[l * m->d] - rows[j]) / m->run->h;
    }
    if (m->damped_inertia)
        v[0] += (X[0] - rows[j]) / m->rule->b[0] / m->run->h;
}

/* h dJ/dm of one step, without the part of v_0: h D Lambda . B v in form M, and minus the multipliers times the factor
 * of m in form D. */
static double inertia(const fvi_adjoint_lobatto *m, size_t j, const double *v)
{
    const double *Lambda = m->Lambda + j * m->s;
    double sum = 0;
    for (size_t i = 0; i < m->s; i++) {
        double slope = 0; /* of Lambda in form M, of v in form D */
        for (size_t l = 0; l < m->s; l++)
            slope += m->rule->D[i][l] * (m->damped_inertia ? v[l] : Lambda[l]);
        sum += m->rule->b[i] * slope * (m->damped_inertia ? -Lambda[i] : v[i]);
    }
    if (m->damped_inertia) /* v_{k+1} is v[s - 1] */
        sum += m->after[j] * v[m->s - 1] - Lambda[0] * v[0];
    return m->run->h * sum;
}

/* Read T of coordinate j and its derivative by the order from the adjoint run, in reverse order. In form D its history
 * sums Lambda, and gives T. In form M it sums DD Lambda and gives DD T, so T is an integral. */
static void read_history(fvi_adjoint_lobatto *m, size_t j, double *T, double *Tdot)
{
    const fvi_lobatto_stages *o = m->stepper->method_state;
    const size_t s = m->s;
    const double *v = o->v + j * s, *Wdot = NULL, h = m->run->h;
    double Y[FVI_STAGES], Ydot[FVI_STAGES] = { 0 };
    if (o->Ydot && o->memory)
        Wdot = fvi_lobatto_history_w0_by_order(o->memory);
    for (size_t i = 0; i < s; i++) {
        Y[i] = o->scale * o->Y[j * s + i];
        for (size_t c = 0; c < s; c++)
            Y[i] += o->W[i][c] * v[c];
        if (!Wdot)
            continue;
        Ydot[i] = o->Ydot[j * s + i];
        for (size_t c = 0; c < s; c++)
            Ydot[i] += Wdot[i * s + c] * v[c];
        Ydot[i] *= o->scale;
    }
    for (size_t i = 0; i < s; i++) {
        T[i] = m->damped_inertia ? Y[i] : m->T[j];
        Tdot[i] = m->damped_inertia ? Ydot[i] : m->Tdot[j];
        for (size_t c = 0; !m->damped_inertia && c < s; c++) {
            T[i] += h * m->A[i][c] * Y[c];
            Tdot[i] += h * m->A[i][c] * Ydot[c];
        }
    }
    m->T[j] = T[s - 1];
    m->Tdot[j] = Tdot[s - 1];
}

/* Add the products of T and the velocities, and the derivatives by masses and by terms of a law. */
static void accumulate_damping(fvi_adjoint_lobatto *m, const double *rows)
{
    const size_t s = m->s;
    for (size_t j = 0; j < m->d; j++) {
        const double v0 =
            m->run->alpha > 0.5 ? m->run->p0[j] / m->run->system->mass[j] : 0;
        double v[FVI_STAGES] = { 0 }, T[FVI_STAGES], Tdot[FVI_STAGES];
        find_stage_velocities(m, j, rows, v);
        m->kinetic[j] += inertia(m, j, v);
        if (!m->is_damped || m->mass_plus_damping)
            continue;
        read_history(m, j, T, Tdot);
        for (size_t i = 0; i < s; i++) {
            m->sum[j] += m->rule->b[i] * (v[s - 1 - i] - v0) * T[i];
            m->sumdot[j] += m->rule->b[i] * (v[s - 1 - i] - v0) * Tdot[i];
            m->plain[j] += m->rule->b[i] * T[i];
        }
        double nu[FVI_STAGES];
        for (size_t i = 0; i < s; i++)
            nu[i] = m->Lambda[j * s + s - 1 - i];
        fvi_stage_terms_accumulate(&m->terms, j, nu, m->run->h * m->run->system->damping[j], v, m->want, 0);
    }
}

/* Add the derivatives by the force, and the products of the impulses of the past with the multipliers. */
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
            m->impulse_sum[j] += at[i] * Lambda;
            m->impulse_sum_by_order[j] += slope[i] * Lambda;
        }
}

/* Take a step of the adjoint run: write Lambda, and add its part of dJ/dx0 to Q. */
//> stages
static int advance_adjoint(fvi_adjoint_lobatto *m, const double *Jx)
{
    fvi_stepper *s = m->stepper;
    fvi_lobatto_stages *o = s->method_state;
    const size_t d = m->d, end = m->s - 1;
    for (size_t j = 0; j < d; j++) {
        m->Q[j] += Jx[j];
        m->after[j] = m->Lambda[j * m->s]; /* lambda_{k+1} */
        if (m->damped_inertia)
            s->x[j] += Jx[j];
        else
            s->p[j] += o->share[j] * Jx[j];
    }
    m->linearised.stage = 0;
    fvi_linearised_gradient(d, s->x, &m->linearised, m->hessian_product);
    if (!m->damped_inertia) /* no step before has evaluated this gradient */
        memcpy(o->grad, m->hessian_product, d * sizeof *o->grad);
    const int status = fvi_stepper_step(s);
    for (size_t i = 0; i <= end; i++)
        for (size_t j = 0; j < d; j++) {
            const double *g = i == 0 && !m->damped_inertia ? m->hessian_product : o->grad + i * d;
            m->Lambda[j * m->s + end - i] =
                o->dX[i * d + j] + (m->damped_inertia ? 0 : m->after[j]);
            m->reversed[j * m->s + i] = m->Lambda[j * m->s + end - i];
            m->Q[j] -= m->run->h * m->rule->b[i] * g[j];
        }
    return status;
}
//< stages

int fvi_adjoint_lobatto_step(fvi_adjoint_lobatto *m, size_t k, const double *rows,
                           const double *Jx)
{
    const fvi_system *system = m->run->system;
    int status = fvi_potential_evaluate_hessians(system, m->s, find_stage_positions(m, rows),
                                                 m->linearised.size, m->G);
    if (!status)
        status = advance_adjoint(m, Jx);
    if (!status)
        status = fvi_potential_accumulate_parameters(
            m->want, system, m->s, m->run->h, m->rule->b, find_stage_positions(m, rows),
            m->Lambda, m->s, m->column);
    if (status)
        return status;
    accumulate_force(m, k);
    if (m->is_damped || m->want->mass)
        accumulate_damping(m, rows);
    return fvi_stage_terms_update_history(&m->terms, m->reversed);
}

/* Let lambda jump by J_p, as at node N. In form M it is the position that jumps, and its history gets the jump in the
 * next step. In form D it is the velocity that jumps, and no history gets it. (23.27) */
int fvi_adjoint_lobatto_jump(fvi_adjoint_lobatto *m, const double *Jp)
{
    fvi_stepper *s = m->stepper;
    for (size_t j = 0; j < m->d; j++) {
        m->Lambda[j * m->s] += Jp[j];
        m->jump[j] = Jp[j];
        if (m->damped_inertia)
            s->p[j] += m->run->system->mass[j] * Jp[j];
        else
            s->x[j] += Jp[j];
    }
    return FVI_SUCCESS;
}

/* ---- the end ---- */

/* Write the derivatives by rho, by alpha, and by v0 through the damping of coordinate j. */
static void end_damping(const fvi_adjoint_lobatto *m, size_t j, double impulse_size,
                        double v0)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const double rho = run->system->damping[j], mass = run->system->mass[j];
    const double A = fvi_initial_history_amplitude(run->past, run->alpha, run->x0[j], v0),
                 log_h = log(run->h);
    if (want->damping) {
        want->damping[j] = -A * impulse_size * m->impulse_sum[j];
        want->damping[j] += m->mass_plus_damping ? m->kinetic[j] / run->h
                                           + m->Lambda[j * m->s] * v0
                                           - m->last[j] / m->mass[j]
                                     : -run->h * m->sum[j];
    }
    if (want->alpha) /* e falls by 2 dalpha, and beta grows by 2 dalpha */
        *want->alpha +=
            2 * rho
            * (A * impulse_size * (log_h * m->impulse_sum[j] + m->impulse_sum_by_order[j])
               - run->h * (m->sumdot[j] - log_h * m->sum[j]));
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
    const double impulse_size = m->has_initial_impulses ? pow(run->h, 1 + m->initial_impulse.e) : 0;
    for (size_t j = 0; j < m->d; j++) {
        const double rho = run->system->damping[j], mass = run->system->mass[j],
                     v0 = run->p0[j] / mass;
        const double by_A = -rho * impulse_size * m->impulse_sum[j];
        const double by_v0 =
            above ? by_A + (m->mass_plus_damping ? 0 : run->h * rho * m->plain[j])
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
        end_damping(m, j, impulse_size, v0);
    }
    return fvi_all_finite(m->d, m->Q) ? FVI_SUCCESS : FVI_EOVRFLW;
}
