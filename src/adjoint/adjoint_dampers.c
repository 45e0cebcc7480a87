/* src/adjoint/adjoint_dampers.c -- The adjoint run of a structure with several dampers: its steps and its end. [H 23,
 * 27] */
#include "adjoint_dampers.h"

#include "system/dot.h"

#include <string.h>

/* ---- a node ---- */

void fvi_adjoint_dampers_elongation(const fvi_adjoint_dampers *m, const fvi_adjoint_damper *a,
                                    size_t k, const double *x, double *z)
{
    const double t = (double)k * m->run->h;
    for (size_t i = 0; i < m->d; i++)
        z[i] = x[i] - m->run->x0[i] - (a->has_drift ? t * m->v0[i] : 0);
}

/* Add share z . C N to the sum of a damper, and share t C N to by_drift. CN: d numbers. */
static void accumulate_products(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, double share,
                                const double *z, const double *CN, double t)
{
    a->sum += share * fvi_dot(m->d, z, CN);
    for (size_t i = 0; a->has_drift && i < m->d; i++)
        a->by_drift[i] += share * t * CN[i];
}

/* Write C times the last sums of the history of a damper. */
static int multiply_sums(fvi_adjoint_dampers *m, const fvi_adjoint_damper *a, double *CN)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    memset(CN, 0, m->d * sizeof *CN);
    return C->apply_damping(m->d, -1, a->damping->H, C->params, CN);
}

int fvi_adjoint_dampers_first_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, const double *x)
{
    const size_t N = m->run->steps;
    fvi_adjoint_dampers_elongation(m, a, N, x, m->z);
    int status = fvi_damping_apply_force(a->damping, 1, a->damping->H, m->stepper->p);
    if (!status)
        status = multiply_sums(m, a, m->column);
    if (!status)
        accumulate_products(m, a, 1, m->z, m->column, (double)N * m->run->h);
    return status || !m->by_numbers
               ? status
               : fvi_adjoint_dampers_numbers_sums(m, a, m->z, NULL);
}

/* Add the history of the constant J_p: subtract its force from the momentum, and multiply it by z_{k+1}. */
static int add_constant(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k,
                        const double *x)
{
    const double one = 1, change = k + 1 == m->run->steps;
    if (!a->constant.memory)
        return FVI_SUCCESS;
    const int status = fvi_constant_history_next(&a->constant, &one, &change);
    const double value = *a->constant.value;
    fvi_adjoint_dampers_elongation(m, a, k + 1, x, m->z);
    for (size_t i = 0; i < m->d; i++)
        m->stepper->p[i] -= a->unit * a->of.rho * value * a->CJ[i];
    accumulate_products(m, a, value, m->z, a->CJ, (double)(k + 1) * m->run->h);
    const double product = fvi_dot(m->d, m->z, a->CJ);
    a->sum_by_order += *a->constant.rate * product;
    a->sum_by_theta += m->is_shifted ? *a->constant.by_theta * product : 0;
    return status;
}

/* The same for the history of the jumps of lambda, C B. */
static int add_jumps(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k, const double *x)
{
    fvi_constant_history *c = &a->jumped;
    const fvi_damping_matrix *C = &a->of.matrix;
    if (!c->memory)
        return FVI_SUCCESS;
    int status = fvi_constant_history_next(c, a->B, a->dB);
    fvi_adjoint_dampers_elongation(m, a, k + 1, x, m->z);
    if (!status && c->by_order)
        status = fvi_adjoint_dampers_multiply(m, a, m->z, c->rate, &a->sum_by_order);
    if (!status && c->by_order && m->is_shifted)
        status = fvi_adjoint_dampers_multiply(m, a, m->z, c->by_theta, &a->sum_by_theta);
    memset(m->column, 0, m->d * sizeof *m->column);
    if (!status)
        status = C->apply_damping(m->d, -1, c->value, C->params, m->column);
    for (size_t i = 0; i < m->d; i++)
        m->stepper->p[i] -= a->unit * a->of.rho * m->column[i];
    accumulate_products(m, a, 1, m->z, m->column, (double)(k + 1) * m->run->h);
    memset(a->dB, 0, C->history_size * sizeof *a->dB);
    return status;
}

static void add_impulses(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k)
{
    const double *left = m->stepper->x, *right = m->right;
    double at[2], slope[2];
    if (a->impulse_unit == 0)
        return;
    fvi_initial_history_force_impulses(&a->history_force, k, at);
    for (size_t i = 0; i < m->d; i++)
        a->impulse_sum[i] += at[0] * left[i] + at[1] * right[i];
    if (!m->want->orders || a->of.law)
        return;
    fvi_kernel_impulses_by_order(&a->history_force.initial_impulse, k, slope);
    for (size_t i = 0; i < m->d; i++)
        a->impulse_sum_by_order[i] += slope[0] * left[i] + slope[1] * right[i];
}

/* Add the sums of node k, up to which the history has come: N = (1 - theta) H_k + theta H_{k-1}, so that z is the mean
 * of z_k and z_{k+1}. */
static int add_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k,
                    const double *rows)
{
    const double t = ((double)k + a->theta) * m->run->h;
    fvi_adjoint_dampers_elongation(m, a, k, rows, m->z);
    fvi_adjoint_dampers_elongation(m, a, k + 1, rows + m->d, m->work);
    for (size_t i = 0; i < m->d; i++)
        m->z[i] += a->theta * (m->work[i] - m->z[i]);
    int status = multiply_sums(m, a, m->column);
    accumulate_products(m, a, 1, m->z, m->column, t);
    if (!status && m->by_numbers)
        status = fvi_adjoint_dampers_numbers_sums(m, a, m->z, rows);
    return status || !m->by_numbers ? status
                                    : fvi_adjoint_dampers_numbers_step(m, a, k, rows);
}

/* Add to the derivatives by factors of M and K; stepper->g is K M_k. */
static int add_matrices(fvi_adjoint_dampers *m, const double *rows)
{
    const size_t d = m->d;
    const fvi_matrices *matrices = m->run->system->matrices;
    for (size_t i = 0; i < d; i++) {
        const double S = rows[i] + (1 - m->kappa) * (rows[d + i] - rows[i]);
        m->by_K += S * m->stepper->g[i];
        m->column[i] = m->right[i] - m->stepper->x[i];
    }
    if (!m->want->mass)
        return FVI_SUCCESS;
    const int status = matrices->inertia(d, m->column, matrices->params, m->work);
    for (size_t i = 0; i < d; i++)
        m->by_M += (rows[d + i] - rows[i]) * m->work[i];
    return status;
}

static void add_force(fvi_adjoint_dampers *m, size_t k)
{
    const double h = m->run->h;
    double *force = m->want->force ? m->want->force + k * m->d : NULL;
    for (size_t i = 0; force && i < m->d; i++) {
        force[m->d + i] += m->paper_convention ? h * m->right[i] : h / 2 * m->right[i];
        force[i] += m->paper_convention ? 0 : h / 2 * m->stepper->x[i];
    }
}

int fvi_adjoint_dampers_step(fvi_adjoint_dampers *m, size_t k, const double *rows,
                             const double *Jx)
{
    fvi_stepper *s = m->stepper;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->d; i++) {
        s->p[i] += Jx[i];
        m->by_start[i] += Jx[i];
    }
    for (size_t j = 0; !status && j < m->count; j++)
        status = add_constant(m, m->each + j, k, rows + m->d);
    for (size_t j = 0; !status && j < m->count; j++)
        status = add_jumps(m, m->each + j, k, rows + m->d);
    memcpy(m->right, s->x, m->d * sizeof *m->right);
    if (!status)
        status = fvi_stepper_step(s);
    for (size_t i = 0; i < m->d; i++)
        m->by_start[i] -= m->run->h * s->g[i];
    add_force(m, k);
    if (!status)
        status = add_matrices(m, rows);
    if (m->by_numbers)
        fvi_adjoint_multipliers_next(&m->multipliers, k + 1 == m->run->steps, m->right, s->x,
                                     m->has_jumps ? m->jump : NULL);
    for (size_t j = 0; !status && j < m->count; j++) {
        add_impulses(m, m->each + j, k);
        if (m->each[j].damping)
            status = add_sums(m, m->each + j, k, rows);
    }
    return status;
}

int fvi_adjoint_dampers_jump(fvi_adjoint_dampers *m, const double *Jp)
{
    int status = FVI_SUCCESS;
    memcpy(m->jump, Jp, m->d * sizeof *Jp);
    for (size_t i = 0; i < m->d; i++)
        m->stepper->x[i] += Jp[i];
    for (size_t j = 0; !status && j < m->count; j++) {
        fvi_adjoint_damper *a = m->each + j;
        const fvi_damping_matrix *C = &a->of.matrix;
        if (a->jumped.memory)
            status = C->select_history(m->d, Jp, m->zeros, C->params, a->dB);
        for (size_t i = 0; a->jumped.memory && i < C->history_size; i++)
            a->B[i] += a->dB[i];
    }
    return status || !fvi_damping_of(m->stepper) ? status
                                                 : fvi_damping_move_origin(m->stepper, Jp);
}

/* ---- the end ---- */

/* Write the derivative by a factor of C_j. Add the derivatives through the impulses of its past: by x0 if the amplitude
 * is x0, and otherwise by v0, to `by_velocity`. */
static int end_damper(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, double *by_damper,
                      double *by_velocity)
{
    const int by_place = a->of.growth < 1;
    const double *A = by_place ? m->run->x0 : m->v0;
    double *to = by_place ? m->by_start : by_velocity;
    memset(m->column, 0, m->d * sizeof *m->column);
    for (size_t i = 0; a->has_drift && i < m->d; i++)
        by_velocity[i] += a->of.rho * a->unit * a->by_drift[i];
    int status = a->impulse_unit != 0
                     ? fvi_damping_multiply(&a->of.matrix, m->d, a->impulse_unit, a->impulse_sum,
                                            m->column)
                     : FVI_SUCCESS;
    for (size_t i = 0; i < m->d; i++)
        to[i] -= a->of.rho * m->column[i];
    const double at = fvi_dot(m->d, A, m->column);
    if (by_damper)
        *by_damper = -a->of.rho * (a->unit * a->sum + at);
    return status || !m->by_numbers ? status : fvi_adjoint_dampers_numbers_end(m, a, at);
}

int fvi_adjoint_dampers_end(fvi_adjoint_dampers *m, const double *Jx)
{
    const fvi_sensitivities *want = m->want;
    const size_t d = m->d;
    double *by_velocity = m->z;
    int status = FVI_SUCCESS;
    memset(by_velocity, 0, d * sizeof *by_velocity);
    for (size_t j = 0; !status && j < m->count; j++)
        status = end_damper(m, m->each + j, want->damping ? want->damping + j : NULL,
                            by_velocity);
    if (!status)
        status = fvi_divide_by_mass(m->run->system, by_velocity, m->work);
    for (size_t i = 0; i < d; i++) {
        m->by_start[i] += Jx[i];
        if (want->x0)
            want->x0[i] = m->by_start[i];
        if (want->p0)
            want->p0[i] = m->stepper->x[i] + m->work[i];
    }
    if (want->mass) /* because v0 = M^-1 p0 */
        *want->mass = m->by_M / m->run->h - fvi_dot(d, m->run->p0, m->work);
    if (want->parameters)
        *want->parameters = -m->run->h * m->by_K;
    return status || fvi_all_finite(d, m->by_start) ? status : FVI_EOVRFLW;
}
