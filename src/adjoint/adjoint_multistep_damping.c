/* src/adjoint/adjoint_multistep_damping.c -- The derivatives by dampings, alpha and laws, from the history of the
 * adjoint run. [H 23]
 *
 * The sums N_j of (23.6) come from the history of the adjoint run. By a method of order 2 the history gives H_k, the
 * sums of lambda - J_p, and (23.7) says
 *
 *     N_j = (1 - theta) H_j + theta H_{j-1} + the history of the constant J_p.
 *
 * So z_j N_j is summed as ((1 - theta) z_k + theta z_{k+1}) H_k. */
#include "adjoint_multistep.h"

#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the damping matrix C ---- */

int fvi_adjoint_multistep_apply_damping(const fvi_adjoint_multistep *m, double share,
                                        const double *x, double *to)
{
    const fvi_system *system = m->run->system;
    const fvi_matrices *C = system->matrices;
    for (size_t i = 0; !C && i < m->d; i++)
        to[i] -= share * system->damping[i] * x[i];
    if (!C || C->history_size == 0)
        return FVI_SUCCESS;
    double *z = calloc(2 * C->history_size, sizeof *z);
    if (!z)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    int status = C->select_history(system->d, x, z + C->history_size, C->params, z);
    if (!status)
        status = C->apply_damping(system->d, share, z, C->params, to);
    free(z);
    return status;
}

/* Add share z . C N to *sum, and without matrices each share z_i N_i to each[i]. N: r numbers. */
static int multiply(fvi_adjoint_multistep *m, const double *z, const double *N,
                    double share, double *each, double *sum)
{
    const fvi_system *system = m->run->system;
    const fvi_matrices *C = system->matrices;
    int status = FVI_SUCCESS;
    if (C) {
        memset(m->work, 0, m->d * sizeof *m->work);
        status = C->apply_damping(m->d, -share, N, C->params, m->work);
        for (size_t i = 0; i < m->d; i++)
            *sum += z[i] * m->work[i];
        return status;
    }
    for (size_t i = 0; i < m->d; i++) {
        const double product = share * z[i] * N[i];
        *sum += system->damping[i] * product;
        if (each)
            each[i] += product;
    }
    return status;
}

/* ---- the start ---- */

int fvi_adjoint_multistep_damping_start(fvi_adjoint_multistep *m, const fvi_method *method)
{
    const fvi_run *run = m->run;
    int status = FVI_SUCCESS;
    if (run->system->matrices)
        status = fvi_adjoint_multistep_apply_damping(m, -1, m->Jp, m->CJ);
    else
        memcpy(m->CJ, m->Jp, m->d * sizeof *m->CJ);
    if (!status && m->want->alpha)
        status = fvi_order_filter_start(m->scheme, run->alpha, m->r, &m->filter);
    if (status || !fvi_wanted_kernel_numbers(m->want))
        return status;
    m->each = calloc(run->law->count, sizeof *m->each);
    if (!m->each)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    for (; !status && m->terms < run->law->count; m->terms++) {
        fvi_node_term *t = &m->each[m->terms];
        status = fvi_node_term_start(run, m->want, fvi_damping_quadrature(method),
                                     run->law->term + m->terms, m->d, NULL, t);
        if (!status && m->has_initial_impulses)
            status = fvi_node_term_start_impulses(t, run->h, m->want);
    }
    return status || !m->has_initial_impulses
               ? status
               : fvi_adjoint_multistep_apply_damping(m, -1, m->v0, m->CA);
}

/* ---- a node ---- */

/* Add the products of z with the sums of this node. */
static int accumulate_sums(fvi_adjoint_multistep *m, const double *z)
{
    int status = multiply(m, z, m->damping->H, 1, m->sum, &m->sum_of_C);
    if (!status && m->damping->Hdot)
        status = multiply(m, z,
                          fvi_order_filter_next(&m->filter, m->damping->H,
                                                m->damping->Hdot, m->Ndot),
                          1, NULL, &m->sum_by_order);
    return status;
}

int fvi_adjoint_multistep_first_sums(fvi_adjoint_multistep *m, const double *x)
{
    fvi_adjoint_multistep_elongation(m, m->run->steps, x, m->z);
    const int status =
        fvi_damping_apply_force(m->damping, 1, m->damping->H, m->stepper->p);
    return status ? status : accumulate_sums(m, m->z);
}

/* Add the history of the constant J_p: subtract its force from the momentum, and multiply it by z_{k+1}. */
int fvi_adjoint_multistep_add_constant(fvi_adjoint_multistep *m, size_t k, const double *x)
{
    fvi_constant_history *c = &m->end_history;
    const fvi_system *system = m->run->system;
    const double unit = m->damping->unit;
    static const double one = 1;
    const double change = !c->has_begun;
    const int status = fvi_constant_history_next(c, &one, &change);
    fvi_adjoint_multistep_elongation(m, k + 1, x, m->z_next);
    for (size_t i = 0; i < m->d; i++) {
        const double rho = system->matrices ? 1 : system->damping[i],
                     product = m->z_next[i] * m->CJ[i];
        m->stepper->p[i] -= unit * *c->value * rho * m->CJ[i];
        m->sum[i] += *c->value * product;
        m->sum_of_C += *c->value * rho * product;
        m->sum_by_order += *c->rate * rho * product;
        m->sum_by_theta += *c->by_theta * rho * product;
    }
    return status;
}

/* Add z . C v to *sum, where v is a sum of the history of B; C v stays in CB. */
static int multiply_jumps(fvi_adjoint_multistep *m, const double *v, double *sum)
{
    memset(m->CB, 0, m->d * sizeof *m->CB);
    const int status = fvi_adjoint_multistep_apply_damping(m, -1, v, m->CB);
    for (size_t i = 0; i < m->d; i++)
        *sum += m->z_next[i] * m->CB[i];
    return status;
}

int fvi_adjoint_multistep_add_jumps(fvi_adjoint_multistep *m, size_t j, const double *x)
{
    fvi_constant_history *c = &m->jump_history;
    int status = fvi_constant_history_next(c, m->B, m->jump);
    fvi_adjoint_multistep_elongation(m, j, x, m->z_next);
    if (!status && c->by_order)
        status = multiply_jumps(m, c->rate, &m->sum_by_order);
    if (!status && c->by_order)
        status = multiply_jumps(m, c->by_theta, &m->sum_by_theta);
    if (!status)
        status = multiply_jumps(m, c->value, &m->sum_of_C);
    for (size_t i = 0; i < m->d; i++) {
        m->sum[i] += m->z_next[i] * c->value[i];
        m->stepper->p[i] -= m->damping->unit * m->CB[i];
    }
    memset(m->jump, 0, (m->terms ? 0 : m->d) * sizeof *m->jump); /* accumulate_terms needs the jump, too */
    return status;
}

/* Add the derivatives by the numbers of each term of the law: the products of h C z_{k+1} with the sums of its own
 * histories. */
static int accumulate_terms(fvi_adjoint_multistep *m, size_t k)
{
    int status = FVI_SUCCESS;
    fvi_adjoint_multipliers_next(&m->multipliers, k + 1 == m->run->steps, m->right,
                                 m->stepper->x, m->has_jumps ? m->jump : NULL);
    memset(m->jump, 0, m->d * sizeof *m->jump);
    memset(m->column, 0, m->d * sizeof *m->column);
    status = fvi_adjoint_multistep_apply_damping(m, -m->run->h, m->z_next, m->column);
    for (size_t l = 0; !status && l < m->terms; l++)
        status = fvi_node_term_accumulate(&m->each[l], m->multipliers.mean,
                                          m->multipliers.change, m->column, m->want,
                                          l);
    return status;
}

int fvi_adjoint_multistep_accumulate_damping(fvi_adjoint_multistep *m, size_t k,
                                             const double *rows)
{
    const double theta = m->theta;
    const int by_theta = m->scheme == FVI_SCHEME_CQ2_SHIFTED && m->want->alpha;
    int status = FVI_SUCCESS;
    fvi_adjoint_multistep_elongation(m, k, rows, m->z);
    if (theta > 0 || by_theta || m->terms)
        fvi_adjoint_multistep_elongation(m, k + 1, rows + m->d, m->z_next);
    if (by_theta) {
        for (size_t i = 0; i < m->d; i++)
            m->column[i] = m->z_next[i] - m->z[i];
        status = multiply(m, m->column, m->damping->H, 1, NULL, &m->sum_by_theta);
    }
    for (size_t i = 0; theta > 0 && i < m->d; i++)
        m->z[i] += theta * (m->z_next[i] - m->z[i]);
    if (!status)
        status = accumulate_sums(m, m->z);
    return status || !m->terms ? status : accumulate_terms(m, k);
}

/* ---- the end ---- */

/* Subtract the part of lambda_0 from the sums, because N_0 does not contain lambda_0. N_0 acts if the history of the
 * run begins at 0. */
static int subtract_last_multiplier(fvi_adjoint_multistep *m)
{
    const fvi_system *system = m->run->system;
    const fvi_matrices *C = system->matrices;
    int status = FVI_SUCCESS;
    fvi_adjoint_multistep_elongation(m, 0, m->run->x0, m->z);
    memset(m->Ndot, 0, m->r * sizeof *m->Ndot);
    if (C)
        status = C->select_history(m->d, m->stepper->x, m->Ndot, C->params, m->N);
    else
        memcpy(m->N, m->stepper->x, m->d * sizeof *m->N);
    return status ? status : multiply(m, m->z, m->N, -1, m->sum, &m->sum_of_C);
}

/* The products of the impulses of the past, rho A h^(1 + e), with lambda, and their derivatives by e. A is v0, or x0
 * for Riemann and Liouville's past below alpha = 1/2. */
static int add_impulses(fvi_adjoint_multistep *m, double *at, double *rate)
{
    const fvi_run *run = m->run;
    const fvi_matrices *C = run->system->matrices;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->d; i++)
        m->z[i] = fvi_initial_history_amplitude(run->past, m->growth / 2, run->x0[i],
                                                m->v0[i]);
    memset(m->Ndot, 0, m->r * sizeof *m->Ndot);
    if (C)
        status = C->select_history(m->d, m->z, m->Ndot, C->params, m->N);
    else
        memcpy(m->N, m->z, m->d * sizeof *m->N);
    if (!status)
        status = multiply(m, m->impulse_sum, m->N, 1, m->want->damping && !C ? m->column : NULL,
                          at);
    return status ? status : multiply(m, m->impulse_sum_by_order, m->N, 1, NULL, rate);
}

//> end
int fvi_adjoint_multistep_end_damping(fvi_adjoint_multistep *m)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const double unit = m->damping->unit, log_h = log(run->h), size = m->impulse_size;
    double at = 0, rate = 0;
    if (m->walks_in_blocks) { /* C is rho */
        m->sum_of_C = *run->system->damping * *m->sum;
        m->sum_by_order = *run->system->damping * m->sum_by_order;
    }
    int status = m->is_liouville ? subtract_last_multiplier(m) : FVI_SUCCESS;
    memset(m->column, 0, m->d * sizeof *m->column);
    if (!status && m->has_initial_impulses)
        status = add_impulses(m, &at, &rate);
    if (want->damping && run->system->matrices)
        *want->damping = -unit * m->sum_of_C - size * at;
    for (size_t i = 0; want->damping && !run->system->matrices && i < m->d; i++)
        want->damping[i] = -unit * m->sum[i] - size * m->column[i];
    if (want->alpha) /* the order is 2 alpha; e falls by 2 dalpha */
        *want->alpha =
            -unit * (2 * m->sum_by_order - 2 * log_h * m->sum_of_C
                     + (m->scheme == FVI_SCHEME_CQ2_SHIFTED ? m->sum_by_theta : 0))
            + 2 * size * (log_h * at + rate);
    return status;
}
//< end
