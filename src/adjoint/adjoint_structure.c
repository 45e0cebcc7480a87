/* src/adjoint/adjoint_structure.c -- The adjoint run of a structure with stages: its steps and its end. [H 23, 27] */
#include "adjoint_structure.h"

#include "system/dot.h"

#include <math.h>
#include <string.h>

/* Let lambda, the velocity of the adjoint run, jump by J_p. No history gets the jump. (23.27) */
int fvi_adjoint_structure_jump(fvi_adjoint_structure *m, const double *Jp)
{
    for (size_t i = 0; i < m->d; i++)
        m->o->v[i] += Jp[i];
    return FVI_SUCCESS;
}

/* ---- a step ---- */

/* Write the velocities of the stages. The last one follows from x_{k+1} = x_k + h sum_i b_i v_i. */
static void find_velocities(fvi_adjoint_structure *m, const double *rows)
{
    const size_t d = m->d, s = m->s;
    const double *b = m->rule->b, *end = rows + s * d, h = m->run->h;
    for (size_t n = 0; n < d; n++)
        m->v[n] = (end[n] - rows[n]) / h;
    for (size_t i = 0; i + 1 < s; i++)
        for (size_t n = 0; n < d; n++) {
            m->v[(s - 1 - i) * d + n] = rows[(i + 1) * d + n];
            m->v[n] -= b[i] * rows[(i + 1) * d + n];
        }
    for (size_t n = 0; n < d; n++)
        m->v[n] /= b[s - 1];
}

/* Write the position of stage i, X = x_k + h (A v)_i. */
static void find_stage_position(const fvi_adjoint_structure *m, const double *rows, size_t i, double *X)
{
    memcpy(X, rows, m->d * sizeof *X);
    for (size_t l = 0; l < m->s; l++) {
        const double share = m->run->h * m->A[i][l], *v = m->v + (m->s - 1 - l) * m->d;
        for (size_t n = 0; n < m->d; n++)
            X[n] += share * v[n];
    }
}

/* Add the derivatives by factors of M and K. `after` is lambda_{k+1}, and V has the multipliers of the stages. */
static int add_matrices(fvi_adjoint_structure *m, const double *rows)
{
    const fvi_matrices *matrices = m->run->system->matrices;
    const size_t d = m->d, s = m->s;
    const double *b = m->rule->b, *V = m->o->V;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && m->want->parameters && i < s; i++) {
        find_stage_position(m, rows, s - 1 - i, m->room);
        status = matrices->stiffness(d, m->room, matrices->params, m->product);
        m->by_K += b[i] * fvi_dot(d, V + i * d, m->product);
    }
    if (status || !m->want->mass)
        return status;
    for (size_t i = 0; !status && i < s; i++) { /* b D v at stage s - 1 - i, plus v_1 at the first stage */
        memset(m->room, 0, d * sizeof *m->room);
        for (size_t l = 0; l < s; l++) {
            const double share = b[i] * m->rule->D[s - 1 - i][l] + (i == s - 1 && l == 0 ? 1 : 0),
                         *v = m->v + (s - 1 - l) * d;
            for (size_t n = 0; n < d; n++)
                m->room[n] += share * v[n];
        }
        status = matrices->inertia(d, m->room, matrices->params, m->product);
        m->by_M -= fvi_dot(d, V + i * d, m->product);
    }
    if (!status)
        status = matrices->inertia(d, m->v, matrices->params, m->product);
    m->by_M += fvi_dot(d, m->after, m->product);
    return status;
}

/* Compute sum_i b_i (v - line) . S y_i. Number n of stage i of y stands at
 * [n * per_number + i * per_stage]. If `sums`
 * is not NULL, b_i S y_i is added to it. */
static int multiply_strided(fvi_adjoint_structure *m, const fvi_adjoint_structure_damper *a, const double *y,
                            size_t per_number, size_t per_stage, double *sums, double *sum)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    const size_t d = m->d;
    int status = FVI_SUCCESS;
    *sum = 0;
    for (size_t i = 0; !status && i < m->s; i++) {
        const double *v = m->v + i * d;
        for (size_t n = 0; n < C->history_size; n++)
            m->y[n] = m->rule->b[i] * y[n * per_number + i * per_stage];
        memset(m->product, 0, d * sizeof *m->product);
        status = C->apply_damping(d, -1, m->y, C->params, m->product);
        *sum += fvi_dot(d, v, m->product) - (a->has_line ? fvi_dot(d, m->v0, m->product) : 0);
        for (size_t n = 0; sums && n < d; n++)
            sums[n] += m->product[n];
    }
    return status;
}

static int multiply(fvi_adjoint_structure *m, const fvi_adjoint_structure_damper *a, const double *y,
                    double *sum)
{
    return multiply_strided(m, a, y, m->s, 1, NULL, sum);
}

/* Add the derivatives by the numbers of the kernel, from histories of its single terms. (23.21) */
static int add_numbers(fvi_adjoint_structure *m, fvi_adjoint_structure_damper *a)
{
    const double h = m->run->h, *nu = a->adjoint->slope;
    int status = FVI_SUCCESS;
    for (size_t l = 0; !status && l < a->terms.count; l++) {
        fvi_stage_term *t = a->terms.each + l;
        double sum = 0, left = 0;
        for (size_t n = 0; n < t->d; n++)
            fvi_stage_term_next(t, n, nu + n * m->s);
        status = multiply(m, a, t->self.now, &sum);
        a->number[0][l] -= h * sum;
        if (!status && t->again.memory)
            status = multiply(m, a, t->again.now, &sum);
        a->number[2][l] += t->again.memory ? h * t->by_time * t->rho * sum : 0;
        if (!status && t->log.memory)
            status = multiply(m, a, t->log.now, &sum);
        if (!status && t->log.memory)
            status = multiply(m, a, t->left, &left);
        a->number[1][l] -= t->log.memory ? 2 * h * t->rho * (sum - log(h) * left) : 0;
        if (!status && t->less.memory)
            status = multiply(m, a, t->less.now, &sum);
        a->number[1][l] += t->less.memory ? 2 * h * t->rho * sum : 0;
        for (int by = 0; !status && by < FVI_KERNEL_DERIVATIVES; by++) {
            if (!t->slopes[by].memory)
                continue;
            status = multiply(m, a, t->slopes[by].now, &sum);
            a->number[1 + by][l] -= h * t->slope[by].sign * t->rho * sum;
        }
    }
    return status ? status : fvi_stage_terms_update_history(&a->terms, nu);
}

static int add_damper(fvi_adjoint_structure *m, size_t k, fvi_adjoint_structure_damper *a)
{
    const size_t d = m->d, s = m->s;
    double at[FVI_STAGES], slope[FVI_STAGES] = { 0 }, sum = 0;
    int status = FVI_SUCCESS;
    if (!a->adjoint)
        return FVI_SUCCESS;
    if (a->impulse_unit != 0)
        fvi_initial_history_force_impulses(&a->past, k, at);
    if (a->impulse_unit != 0 && m->by_order && !a->of.law)
        fvi_kernel_impulses_by_order(&a->past.initial_impulse, k, slope);
    for (size_t i = 0; a->impulse_unit != 0 && i < s; i++)
        for (size_t n = 0; n < d; n++) {
            a->impulse_sum[n] += at[s - 1 - i] * m->o->V[i * d + n];
            a->impulse_sum_by_order[n] += slope[s - 1 - i] * m->o->V[i * d + n];
        }
    if (m->want->damping || a->has_line || m->by_numbers)
        status = multiply_strided(m, a, a->adjoint->force, 1, a->adjoint->r, a->plain, &sum);
    a->sum += sum;
    if (!status && a->adjoint->Ydot)
        status = multiply_strided(m, a, a->adjoint->force_by_order, 1, a->adjoint->r, NULL, &sum);
    a->sum_by_order += a->adjoint->Ydot ? sum : 0;
    return status || !m->by_numbers ? status : add_numbers(m, a);
}

int fvi_adjoint_structure_step(fvi_adjoint_structure *m, size_t k, const double *rows, const double *Jx)
{
    fvi_stepper *s = m->stepper;
    const size_t d = m->d, n = m->s;
    double *force = m->want->force;
    for (size_t i = 0; i < d; i++)
        s->x[i] += Jx[i];
    memcpy(m->after, m->o->v, d * sizeof *m->after);
    int status = fvi_stepper_step(s);
    if (!status && (m->want->damping || m->want->mass || m->want->parameters || m->by_numbers))
        find_velocities(m, rows);
    if (!status)
        status = add_matrices(m, rows);
    for (size_t i = 0; force && i < n; i++)
        for (size_t j = 0; j < d; j++)
            force[(k * (n - 1) + n - 1 - i) * d + j] += m->run->h * m->rule->b[i] * m->o->V[i * d + j];
    for (size_t j = 0; !status && j < m->count; j++)
        status = add_damper(m, k, m->each + j);
    return status;
}

/* ---- the end ---- */

/* Write the derivatives by the numbers of a kernel. A power adds the impulses of its past, whose e falls by 2
 * dalpha. */
static void end_numbers(fvi_adjoint_structure *m, fvi_adjoint_structure_damper *a, double at, double rate,
                        size_t first)
{
    const fvi_sensitivities *want = m->want;
    double *const to[] = { want->terms, want->alpha ? want->alpha : want->orders, want->times, want->ends };
    if (!a->of.law) {
        const double h = m->run->h, log_h = log(h);
        if (a->adjoint && a->adjoint->Ydot) {
            a->number[0][0] = -h * a->sum / a->of.rho;
            a->number[1][0] = -2 * h * (a->sum_by_order - log_h * a->sum);
        }
        a->number[0][0] -= at;
        a->number[1][0] += 2 * a->of.rho * (log_h * at + rate);
    }
    for (size_t i = 0; i < 4; i++)
        for (size_t l = 0; to[i] && l < a->kernel.count; l++)
            to[i][first + l] = a->number[i][l];
}

/* Write the derivative by a factor of C_j, and add the derivatives by the start through the impulses of its past and
 * its line. */
static int end_damper(fvi_adjoint_structure *m, size_t j, size_t first, double *by_velocity)
{
    fvi_adjoint_structure_damper *a = m->each + j;
    const size_t d = m->d;
    const int by_place = a->of.growth < 1;
    const double *A = by_place ? m->run->x0 : m->v0;
    double *to = by_place ? m->stepper->x : by_velocity, at = 0, rate = 0;
    int status = FVI_SUCCESS;
    memset(m->product, 0, d * sizeof *m->product);
    if (a->impulse_unit != 0)
        status = fvi_damping_multiply(&a->of.matrix, d, a->impulse_unit, a->impulse_sum_by_order, m->product);
    rate = fvi_dot(d, A, m->product);
    memset(m->product, 0, d * sizeof *m->product);
    if (!status && a->impulse_unit != 0)
        status = fvi_damping_multiply(&a->of.matrix, d, a->impulse_unit, a->impulse_sum, m->product);
    at = fvi_dot(d, A, m->product);
    for (size_t i = 0; i < d; i++) {
        to[i] -= a->of.rho * m->product[i];
        by_velocity[i] += a->has_line ? m->run->h * a->plain[i] : 0;
    }
    if (m->want->damping)
        m->want->damping[j] = -m->run->h * a->sum - a->of.rho * at;
    if (m->by_numbers)
        end_numbers(m, a, at, rate, first);
    return status;
}

int fvi_adjoint_structure_end(fvi_adjoint_structure *m, const double *Jx)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const size_t d = m->d;
    double *by_velocity = m->room, *by_x0 = m->stepper->x;
    int status = FVI_SUCCESS;
    memset(by_velocity, 0, d * sizeof *by_velocity);
    for (size_t i = 0; i < d; i++)
        by_x0[i] += Jx[i];
    for (size_t j = 0, first = 0; !status && j < m->count; first += m->each[j++].kernel.count)
        status = end_damper(m, j, first, by_velocity);
    if (!status)
        status = fvi_damping_velocity(run->system, by_velocity, m->after);
    for (size_t i = 0; i < d; i++) {
        const int has = run->law || run->system->mechanism
                        || fvi_initial_history_solvable(run->past, run->alpha, run->system->damping[i], 1);
        if (want->x0)
            want->x0[i] = has ? by_x0[i] : NAN; /* (19.2) */
        if (want->p0)
            want->p0[i] = m->o->v[i] + m->after[i];
    }
    if (want->mass) /* because v0 = M^-1 p0 */
        *want->mass = m->by_M - fvi_dot(d, run->p0, m->after);
    if (want->parameters)
        *want->parameters = -run->h * m->by_K;
    return status || fvi_all_finite(d, by_x0) ? status : FVI_EOVRFLW;
}
