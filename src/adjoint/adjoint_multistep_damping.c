/* src/adjoint/adjoint_multistep_damping.c -- The derivatives by dampers, alpha and laws, from the histories of the
 * adjoint run. [H 23, 27]
 *
 * The sums N_j of (23.6) come from the history of the adjoint run. By a method of order 2 the history gives H_k, the
 * sums of lambda - J_p, and (23.7) says
 *
 *     N_j = (1 - theta) H_j + theta H_{j-1} + the history of the constant J_p.
 *
 * So z_j N_j is summed as ((1 - theta) z_k + theta z_{k+1}) H_k.
 *
 * The order of a power stands in four places: in the weights of its history, in the factor h^(1 - 2 alpha), in the
 * shift of fvi-shifted, and in the impulses of its past. The terms of a law have histories of their own
 * (node_terms.h). */
#include "adjoint_multistep.h"

#include "system/all_zero.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the damping matrix C = rho S B^T ---- */

/* rho of the damper; without matrices rho of coordinate i. */
static double rho_of(const fvi_adjoint_multistep *m, const fvi_adjoint_damper *a, size_t i)
{
    return a->of.matrix.select_history ? a->of.rho : m->run->system->damping[i];
}

/* Find B^T x, r numbers: in `room`, or x itself without matrices. */
static int select_history(const fvi_adjoint_multistep *m, const fvi_adjoint_damper *a, const double *x, double *room,
                          const double **selected)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    *selected = C->select_history ? room : x;
    return C->select_history ? C->select_history(m->d, x, m->zeros, C->params, room) : FVI_SUCCESS;
}

/* Find S y, d numbers: in `room`, or y itself without matrices. */
static int multiply(const fvi_adjoint_multistep *m, const fvi_adjoint_damper *a, const double *y, double *room,
                    const double **product)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    *product = C->apply_damping ? room : y;
    if (!C->apply_damping)
        return FVI_SUCCESS;
    memset(room, 0, m->d * sizeof *room);
    return C->apply_damping(m->d, -1, y, C->params, room);
}

/* Write share S B^T x to `to`, d numbers. */
static int multiply_whole(const fvi_adjoint_multistep *m, const fvi_adjoint_damper *a, double share, const double *x,
                          double *to)
{
    const double *selected, *product = NULL;
    int status = select_history(m, a, x, a->in, &selected);
    if (!status)
        status = multiply(m, a, selected, to, &product);
    for (size_t i = 0; !status && i < m->d; i++)
        to[i] = share * product[i];
    return status;
}

/* Write z_j = x_j - origin - t_j drift. */
static void find_elongation(const fvi_adjoint_multistep *m, const fvi_adjoint_damper *a, size_t j, const double *x,
                            double *z)
{
    const double *x0 = m->run->x0, t = (double)j * m->run->h;
    for (size_t i = 0; i < m->d; i++)
        z[i] = x[i] - (m->is_liouville ? 0 : x0[i]) - (a->has_drift ? t * m->v0[i] : 0);
}

/* ---- the start ---- */

static int allocate(const fvi_adjoint_multistep *m, fvi_adjoint_damper *a)
{
    const size_t d = m->d, r = a->r;
    a->block = FVI_ARRAYS({ &a->sum, d }, { &a->sum_by_order, d }, { &a->sum_by_theta, d }, { &a->by_line, d },
                          { &a->impulse_sum, d }, { &a->impulse_sum_by_order, d }, { &a->SJ, d }, { &a->CA, d },
                          { &a->B, r }, { &a->dB, r }, { &a->Ndot, r }, { &a->in, r }, { &a->change, r });
    if (!a->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* Prepare the impulses by which the past of the damper acts on the two ends of each step, for an amplitude of 1. */
static int start_impulses(const fvi_adjoint_multistep *m, fvi_adjoint_damper *a)
{
    static const double ends[] = { 0, 1 }; /* of a step */
    return m->paper_convention || !fvi_initial_history_acts(a->of.past, a->of.growth / 2)
               ? FVI_SUCCESS
               : fvi_initial_history_force_prepare(&a->of, m->run->h, 2, ends, &a->history_force, &a->impulse_unit);
}

/* Start the histories of J_p and of the jumps of lambda, which a history held at J_p leaves out, (23.23). */
static int start_left_out(const fvi_adjoint_multistep *m, const fvi_method *method, fvi_adjoint_damper *a)
{
    int status = FVI_SUCCESS;
    if (!m->paper_convention && !fvi_all_zero(m->d, m->Jp)) {
        status = fvi_constant_history_start(method, m->run, &a->of, 1, a->damping->Hdot != NULL, &a->end_history);
        if (!status)
            status = multiply_whole(m, a, 1, m->Jp, a->SJ);
    }
    return status || !m->has_jumps
               ? status
               : fvi_constant_history_start(method, m->run, &a->of, a->r, a->damping->Hdot != NULL, &a->jump_history);
}

static int start_terms(fvi_adjoint_multistep *m, const fvi_method *method, fvi_adjoint_damper *a)
{
    const fvi_kernel *law = a->of.law;
    int status = FVI_SUCCESS;
    a->term = calloc(law->count, sizeof *a->term);
    if (!a->term)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    for (; !status && a->terms < law->count; a->terms++) {
        fvi_node_term *t = a->term + a->terms;
        status = fvi_node_term_start(m->run, m->want, fvi_damping_quadrature(method), law->term + a->terms, a->r,
                                     a->of.matrix.select_history ? &a->of.matrix : NULL, t);
        if (!status && a->impulse_unit != 0)
            status = fvi_node_term_start_impulses(t, m->run->h, m->want);
    }
    if (!status && a->impulse_unit != 0)
        status = multiply_whole(m, a, 1, m->v0, a->CA);
    for (size_t i = 0; i < m->d; i++)
        a->CA[i] *= rho_of(m, a, i);
    return status;
}

int fvi_adjoint_damper_start(fvi_adjoint_multistep *m, const fvi_method *method, size_t j)
{
    fvi_adjoint_damper *a = m->each + j;
    a->of = fvi_run_damper_of(m->run, j);
    a->first = j > 0 ? a[-1].first + m->run->system->mechanism->damper[j - 1].kernel->count : 0;
    a->damping = fvi_damping_of(m->stepper);
    while (a->damping && a->damping->number != j)
        a->damping = a->damping->next;
    if (!a->damping)
        return FVI_SUCCESS;
    a->r = a->damping->count;
    a->unit = a->of.law ? a->damping->unit : pow(m->run->h, 1 - 2 * a->of.alpha);
    a->theta = method->scheme == FVI_SCHEME_CQ2_SHIFTED    ? a->of.growth / 2
               : method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5
                                                           : 0;
    a->has_drift = a->of.growth > 1 && (a->of.past == FVI_INITIAL_HISTORY_CAPUTO || !m->paper_convention);
    int status = allocate(m, a);
    if (!status && a->has_drift && !m->needs_velocity)
        status = fvi_divide_by_mass(m->run->system, m->run->p0, m->v0);
    m->needs_velocity |= a->has_drift;
    if (!status)
        status = start_impulses(m, a);
    if (!status)
        status = start_left_out(m, method, a);
    if (!status && a->damping->Hdot)
        status = fvi_order_filter_start(method->scheme, a->of.alpha, a->r, &a->filter);
    return status || !m->by_numbers || !a->of.law ? status : start_terms(m, method, a);
}

void fvi_adjoint_damper_free(fvi_adjoint_damper *a)
{
    fvi_constant_history_stop(&a->end_history);
    fvi_constant_history_stop(&a->jump_history);
    fvi_initial_history_force_stop(&a->history_force);
    fvi_order_filter_stop(&a->filter);
    for (size_t l = 0; l < a->terms; l++)
        fvi_node_term_stop(a->term + l);
    free(a->term);
    free(a->block);
}

/* ---- a node ---- */

/* Add share z S N to a sum; SN has d numbers. */
static void add_products(size_t d, double share, const double *z, const double *SN, double *sum)
{
    for (size_t i = 0; i < d; i++)
        sum[i] += share * (z[i] * SN[i]);
}

/* Add share z S N to the sum of a damper, and share t S N to its by_line if that is needed. */
static void add_sum(const fvi_adjoint_multistep *m, fvi_adjoint_damper *a, double share, const double *z,
                    const double *SN, double t)
{
    add_products(m->d, share, z, SN, a->sum);
    for (size_t i = 0; m->needs_velocity && !a->has_drift && i < m->d; i++)
        a->by_line[i] += share * t * SN[i];
}

/* Add the products of z with the last sums of the history, and with their derivatives by the order. `moved` has the
 * derivative of z by theta, or is NULL. */
static int add_last_sums(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, const double *z, const double *moved,
                         double t)
{
    const fvi_damping *of = a->damping;
    const double *SN;
    int status = multiply(m, a, of->H, m->column, &SN);
    add_sum(m, a, 1, z, SN, t);
    if (status || !of->Hdot)
        return status;
    if (moved)
        add_products(m->d, 1, moved, SN, a->sum_by_theta);
    status = multiply(m, a, fvi_order_filter_next(&a->filter, of->H, of->Hdot, a->Ndot), m->column, &SN);
    add_products(m->d, 1, z, SN, a->sum_by_order);
    return status;
}

int fvi_adjoint_damper_first(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, const double *x)
{
    const size_t N = m->run->steps;
    if (!a->damping)
        return FVI_SUCCESS;
    find_elongation(m, a, N, x, m->z);
    const int status = fvi_damping_apply_force(a->damping, 1, a->damping->H, m->stepper->p);
    return status ? status : add_last_sums(m, a, m->z, NULL, (double)N * m->run->h);
}

/* Add the history of the constant J_p: subtract its force from the momentum, and multiply it by z_j. */
static int add_constant(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, size_t j, const double *x)
{
    fvi_constant_history *c = &a->end_history;
    const double one = 1, change = j == m->run->steps;
    const int status = fvi_constant_history_next(c, &one, &change);
    find_elongation(m, a, j, x, m->z);
    for (size_t i = 0; i < m->d; i++)
        m->stepper->p[i] -= a->unit * *c->value * rho_of(m, a, i) * a->SJ[i];
    add_sum(m, a, *c->value, m->z, a->SJ, (double)j * m->run->h);
    add_products(m->d, *c->rate, m->z, a->SJ, a->sum_by_order);
    add_products(m->d, *c->by_theta, m->z, a->SJ, a->sum_by_theta);
    return status;
}

/* The same for the history of B, the sum of all jumps of lambda so far. */
static int add_jumps(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, size_t j, const double *x)
{
    fvi_constant_history *c = &a->jump_history;
    double *const to[] = { a->sum_by_order, a->sum_by_theta };
    const double *const rates[] = { c->rate, c->by_theta }, *SN = NULL;
    int status = fvi_constant_history_next(c, a->B, a->dB);
    find_elongation(m, a, j, x, m->z);
    for (size_t l = 0; c->by_order && !status && l < sizeof to / sizeof *to; l++) {
        status = multiply(m, a, rates[l], m->column, &SN);
        add_products(m->d, 1, m->z, SN, to[l]);
    }
    if (!status)
        status = multiply(m, a, c->value, m->column, &SN);
    if (status)
        return status;
    for (size_t i = 0; i < m->d; i++)
        m->stepper->p[i] -= a->unit * rho_of(m, a, i) * SN[i];
    add_sum(m, a, 1, m->z, SN, (double)j * m->run->h);
    memset(a->dB, 0, a->r * sizeof *a->dB);
    return FVI_SUCCESS;
}

int fvi_adjoint_damper_left_out(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, size_t j, const double *x)
{
    const int status = a->end_history.memory ? add_constant(m, a, j, x) : FVI_SUCCESS;
    return status || !a->jump_history.memory ? status : add_jumps(m, a, j, x);
}

int fvi_adjoint_damper_jump(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, const double *Jp)
{
    if (!a->jump_history.memory)
        return FVI_SUCCESS;
    const double *selected;
    const int status = select_history(m, a, Jp, a->in, &selected);
    for (size_t i = 0; !status && i < a->r; i++) {
        a->dB[i] = selected[i];
        a->B[i] += selected[i];
    }
    return status;
}

/* ---- a step ---- */

/* Add the products of the impulses of the past with lambda at the two ends of step k. */
static void add_impulses(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, size_t k)
{
    const double *left = m->stepper->x, *right = m->right;
    double impulse[2] = { 0 }, slope[2] = { 0 }; /* at the two ends; their derivatives by e */
    if (a->impulse_unit == 0)
        return;
    fvi_initial_history_force_impulses(&a->history_force, k, impulse);
    if (a->damping->Hdot)
        fvi_kernel_impulses_by_order(&a->history_force.initial_impulse, k, slope);
    for (size_t i = 0; i < m->d; i++) {
        a->impulse_sum[i] += impulse[0] * left[i] + impulse[1] * right[i];
        a->impulse_sum_by_order[i] += slope[0] * left[i] + slope[1] * right[i];
    }
}

/* Add the derivatives by the numbers of each term of the law: the products of h rho z_{k+1} with the sums of its own
 * histories, and of its impulses with lambda. */
static int accumulate_terms(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, size_t k)
{
    double *weight = m->z_next, left = 0, right = 0;
    const double *in, *change = NULL;
    int status = select_history(m, a, m->multipliers.mean, a->in, &in);
    if (!status)
        status = select_history(m, a, m->multipliers.change, a->change, &change);
    for (size_t i = 0; i < m->d; i++) {
        weight[i] *= m->run->h * rho_of(m, a, i);
        left += a->CA[i] * m->stepper->x[i];
        right += a->CA[i] * m->right[i];
    }
    for (size_t l = 0; !status && l < a->terms; l++) {
        status = fvi_node_term_accumulate(a->term + l, in, change, weight, m->want, a->first + l);
        if (a->impulse_unit != 0)
            fvi_node_term_accumulate_impulses(a->term + l, k, left, right, m->want, a->first + l);
    }
    return status;
}

int fvi_adjoint_damper_step(fvi_adjoint_multistep *m, fvi_adjoint_damper *a, size_t k, const double *rows)
{
    double *moved = m->work;
    if (!a->damping)
        return FVI_SUCCESS;
    add_impulses(m, a, k);
    find_elongation(m, a, k, rows, m->z);
    find_elongation(m, a, k + 1, rows + m->d, m->z_next);
    for (size_t i = 0; i < m->d; i++) {
        moved[i] = m->z_next[i] - m->z[i];
        m->z[i] += a->theta * moved[i];
    }
    const int status =
        add_last_sums(m, a, m->z, m->is_shifted ? moved : NULL, ((double)k + a->theta) * m->run->h);
    return status || a->terms == 0 ? status : accumulate_terms(m, a, k);
}

/* ---- the end ---- */

/* For Riemann and Liouville's past in Algorithm 3: N_0 acts, too, because the history of the run begins at 0. But N_0
 * does not contain lambda_0, which the history has taken in. */
static int subtract_last_multiplier(fvi_adjoint_multistep *m, fvi_adjoint_damper *a)
{
    double *last = m->column;
    const int status = multiply_whole(m, a, 1, m->stepper->x, last);
    find_elongation(m, a, 0, m->run->x0, m->z);
    add_products(m->d, -1, m->z, last, a->sum);
    for (size_t i = 0; i < m->d; i++)
        m->by_start[i] += a->unit * rho_of(m, a, i) * last[i];
    return status;
}

/* Write the derivatives by rho and by the order, from the impulses of the past, whose amplitude is A, and from their
 * derivatives by e. The order is 2 alpha, and e falls by 2 dalpha. */
static void write_derivatives(const fvi_adjoint_multistep *m, const fvi_adjoint_damper *a, const double *A,
                              const double *impulses, const double *rates)
{
    const fvi_sensitivities *want = m->want;
    const int is_chain = !a->of.matrix.select_history;
    const double log_h = log(m->run->h);
    double by_factor = 0, sum = 0, by_order = 0, by_theta = 0, at = 0, rate = 0;
    for (size_t i = 0; i < m->d; i++) {
        const double rho = rho_of(m, a, i), by_rho = -a->unit * a->sum[i] - A[i] * impulses[i];
        sum += rho * a->sum[i];
        by_order += rho * a->sum_by_order[i];
        by_theta += rho * a->sum_by_theta[i];
        at += rho * A[i] * impulses[i];
        rate += rho * A[i] * rates[i];
        by_factor += by_rho;
        if (want->damping && is_chain)
            want->damping[i] = by_rho;
    }
    if (want->damping && !is_chain)
        want->damping[a->damping->number] = a->of.rho * by_factor;
    if (a->of.law)
        return;
    if (want->terms)
        want->terms[a->first] = by_factor;
    if (m->by_order)
        (want->alpha ? want->alpha : want->orders)[a->first] =
            -a->unit * (2 * by_order - 2 * log_h * sum + (m->is_shifted ? by_theta : 0))
            + 2 * (log_h * at + rate);
}

int fvi_adjoint_damper_end(fvi_adjoint_multistep *m, fvi_adjoint_damper *a)
{
    const int is_place = a->of.growth < 1;
    const double *A = is_place ? m->run->x0 : m->v0;
    double *by_amplitude = is_place ? m->by_start : m->by_line, *impulses = m->column, *rates = m->work;
    if (!a->damping)
        return FVI_SUCCESS;
    int status = m->is_liouville ? subtract_last_multiplier(m, a) : FVI_SUCCESS;
    if (!status)
        status = multiply_whole(m, a, a->impulse_unit, a->impulse_sum, impulses);
    if (!status)
        status = multiply_whole(m, a, a->impulse_unit, a->impulse_sum_by_order, rates);
    for (size_t i = 0; i < m->d; i++) {
        by_amplitude[i] -= rho_of(m, a, i) * impulses[i];
        m->by_line[i] -= rho_of(m, a, i) * a->unit * a->by_line[i];
    }
    write_derivatives(m, a, A, impulses, rates);
    return status;
}
