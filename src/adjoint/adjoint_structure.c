/* src/adjoint/adjoint_structure.c -- The adjoint run of a structure with stages: its steps and its end. [H 23, 27] */
#include "adjoint_structure.h"

#include "system/dot.h"

#include <math.h>
#include <string.h>

/* Let lambda, the velocity of the adjoint run, jump by J_p at node k. No history gets the jump. (23.27) */
int fvi_adjoint_structure_jump(fvi_adjoint_structure *m, const double *Jp)
{
    for (size_t i = 0; i < m->d; i++)
        m->state->v[i] += Jp[i];
    return FVI_SUCCESS;
}

/* ---- a step ---- */

/* Return the velocities at stage i of step k of the run. */
static double *stage_velocity(const fvi_adjoint_structure *m, size_t i)
{
    return m->v + (m->s - 1 - i) * m->d;
}

/* Fill in m->v. rows has x_k, the velocities at the stages 0 to s - 2, and x_{k+1}, d numbers each. The velocity at the
 * last stage follows from x_{k+1} = x_k + h sum_i b_i v_i. */
static void find_velocities(fvi_adjoint_structure *m, const double *rows)
{
    const size_t d = m->d, s = m->s;
    const double *b = m->rule->b, *left = rows, *right = rows + s * d, h = m->run->h;
    double *last = stage_velocity(m, s - 1);
    for (size_t n = 0; n < d; n++)
        last[n] = (right[n] - left[n]) / h;
    for (size_t i = 0; i + 1 < s; i++) {
        const double *v = rows + (i + 1) * d;
        memcpy(stage_velocity(m, i), v, d * sizeof *v);
        for (size_t n = 0; n < d; n++)
            last[n] -= b[i] * v[n];
    }
    for (size_t n = 0; n < d; n++)
        last[n] /= b[s - 1];
}

/* Write the position of stage i, X = x_k + h (A v)_i. */
static void find_stage_position(const fvi_adjoint_structure *m, const double *rows, size_t i, double *X)
{
    memcpy(X, rows, m->d * sizeof *X);
    for (size_t l = 0; l < m->s; l++) {
        const double share = m->run->h * m->A[i][l], *v = stage_velocity(m, l);
        for (size_t n = 0; n < m->d; n++)
            X[n] += share * v[n];
    }
}

/* Add the derivative by a factor of K: b_i times the multiplier times K X at each stage of the run. */
static int add_stiffness(fvi_adjoint_structure *m, const double *rows)
{
    const fvi_matrices *matrices = m->run->system->matrices;
    const size_t d = m->d, s = m->s;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < s; i++) { /* the multiplier of stage s - 1 - i is V_i, and b is symmetric */
        find_stage_position(m, rows, s - 1 - i, m->room);
        status = matrices->stiffness(d, m->room, matrices->params, m->product);
        m->by_K += m->rule->b[i] * fvi_dot(d, m->state->V + i * d, m->product);
    }
    return status;
}

/* Add the derivative by a factor of M: the multipliers times M b (D v) at each stage of the run, with v at the first
 * stage added there, and lambda_{k+1} times M v at the last stage. */
static int add_inertia(fvi_adjoint_structure *m)
{
    const fvi_matrices *matrices = m->run->system->matrices;
    const size_t d = m->d, s = m->s;
    const double *b = m->rule->b;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < s; i++) { /* stage s - 1 - i */
        memset(m->room, 0, d * sizeof *m->room);
        for (size_t l = 0; l < s; l++) {
            const double share = b[i] * m->rule->D[s - 1 - i][l] + (i == s - 1 && l == 0 ? 1 : 0),
                         *v = stage_velocity(m, l);
            for (size_t n = 0; n < d; n++)
                m->room[n] += share * v[n];
        }
        status = matrices->inertia(d, m->room, matrices->params, m->product);
        m->by_M -= fvi_dot(d, m->state->V + i * d, m->product);
    }
    if (!status)
        status = matrices->inertia(d, stage_velocity(m, s - 1), matrices->params, m->product);
    m->by_M += fvi_dot(d, m->lambda_after, m->product);
    return status;
}

/* Compute *sum = sum_i b_i (v_i - line) . S y_i over the stages of a step, where C = S B^T is the matrix of the damper.
 *
 *   y     the numbers of the damper, the last stage of the run first; number n of stage i stands at
 *         [n * per_number + i * per_stage]
 *   sums  NULL, or d numbers to which b_i S y_i is added */
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

/* Add the derivatives by the numbers of term l of the kernel. The histories of the term have taken in the step. */
static int add_numbers_of_term(fvi_adjoint_structure *m, fvi_adjoint_structure_damper *a, size_t l)
{
    const fvi_stage_term *t = a->terms.each + l;
    double sum;
    int status = FVI_SUCCESS;
    for (size_t by = 0; !status && by < FVI_NUMBERS_OF_TERM; by++) {
        if (!t->by[by])
            continue;
        status = multiply_strided(m, a, t->by[by], m->s, 1, NULL, &sum);
        a->by_number[by][l] -= m->run->h * t->factor[by] * sum;
    }
    return status;
}

/* Add the derivatives by all numbers of the kernel of a damper in this step. */
static int add_numbers(fvi_adjoint_structure *m, fvi_adjoint_structure_damper *a)
{
    const double *nu = a->adjoint->slope; /* the multipliers that the histories take in */
    int status = FVI_SUCCESS;
    for (size_t l = 0; !status && l < a->terms.count; l++) {
        fvi_stage_term *t = a->terms.each + l;
        for (size_t n = 0; n < t->d; n++)
            fvi_stage_term_next(t, n, nu + n * m->s);
        status = add_numbers_of_term(m, a, l);
    }
    return status ? status : fvi_stage_terms_update_history(&a->terms, nu);
}

/* Add the products of the impulses of a damper's past in step k with the multipliers. */
static void add_impulses(const fvi_adjoint_structure *m, size_t k, fvi_adjoint_structure_damper *a)
{
    const size_t d = m->d, s = m->s;
    double impulse[FVI_STAGES], by_order[FVI_STAGES] = { 0 }; /* at the stages of the run */
    fvi_initial_history_force_impulses(&a->history_force, k, impulse);
    if (m->by_order && !a->of.law)
        fvi_kernel_impulses_by_order(&a->history_force.initial_impulse, k, by_order);
    for (size_t i = 0; i < s; i++)
        for (size_t n = 0; n < d; n++) {
            a->impulse_sum[n] += impulse[s - 1 - i] * m->state->V[i * d + n];
            a->impulse_sum_by_order[n] += by_order[s - 1 - i] * m->state->V[i * d + n];
        }
}

/* Add what a damper gives to the derivatives in step k. */
static int add_damper(fvi_adjoint_structure *m, size_t k, fvi_adjoint_structure_damper *a)
{
    double sum = 0;
    int status = FVI_SUCCESS;
    if (!a->adjoint)
        return FVI_SUCCESS;
    if (a->impulse_unit != 0)
        add_impulses(m, k, a);
    if (m->want->damping || a->has_line || m->by_numbers)
        status = multiply_strided(m, a, a->adjoint->force, 1, a->adjoint->r, a->force_sum, &sum);
    a->product += sum;
    if (!status && a->adjoint->Ydot) {
        status = multiply_strided(m, a, a->adjoint->force_by_order, 1, a->adjoint->r, NULL, &sum);
        a->product_by_order += sum;
    }
    return status || !m->by_numbers ? status : add_numbers(m, a);
}

int fvi_adjoint_structure_step(fvi_adjoint_structure *m, size_t k, const double *rows, const double *Jx)
{
    fvi_stepper *stepper = m->stepper;
    const fvi_sensitivities *want = m->want;
    const size_t d = m->d, s = m->s;
    double *force = want->force ? want->force + k * (s - 1) * d : NULL; /* a node is the last stage and a first one */
    for (size_t i = 0; i < d; i++)
        stepper->x[i] += Jx[i]; /* in dual variables x is the force that drives lambda (23.15) */
    memcpy(m->lambda_after, m->state->v, d * sizeof *m->lambda_after);
    int status = fvi_stepper_step(stepper);
    if (!status && (want->damping || want->mass || want->parameters || m->by_numbers))
        find_velocities(m, rows);
    if (!status && want->parameters)
        status = add_stiffness(m, rows);
    if (!status && want->mass)
        status = add_inertia(m);
    for (size_t i = 0; force && i < s; i++)
        for (size_t n = 0; n < d; n++)
            force[(s - 1 - i) * d + n] += m->run->h * m->rule->b[i] * m->state->V[i * d + n];
    for (size_t j = 0; !status && j < m->count; j++)
        status = add_damper(m, k, m->each + j);
    return status;
}

/* ---- the end ---- */

/* Write the derivatives by the numbers of a kernel. For a power add those through the impulses of its past, whose e
 * falls by 2 dalpha.
 *
 *   impulses, impulses_by_order  the impulses times the amplitude, and their derivative by e
 *   first                        the place of the kernel's first term among the terms of all dampers */
static void end_numbers(fvi_adjoint_structure *m, fvi_adjoint_structure_damper *a, double impulses,
                        double impulses_by_order, size_t first)
{
    const fvi_sensitivities *want = m->want;
    double *const to[] = { want->terms, want->alpha ? want->alpha : want->orders, want->times, want->ends };
    if (!a->of.law) {
        const double h = m->run->h, log_h = log(h);
        if (a->adjoint && a->adjoint->Ydot) {
            a->by_number[FVI_BY_RHO][0] = -h * a->product / a->of.rho;
            a->by_number[FVI_BY_ORDER][0] = -2 * h * (a->product_by_order - log_h * a->product);
        }
        a->by_number[FVI_BY_RHO][0] -= impulses;
        a->by_number[FVI_BY_ORDER][0] += 2 * a->of.rho * (log_h * impulses + impulses_by_order);
    }
    for (size_t i = 0; i < FVI_NUMBERS_OF_TERM; i++)
        for (size_t l = 0; to[i] && l < a->kernel.count; l++)
            to[i][first + l] = a->by_number[i][l];
}

/* Compute m->product = C times impulse_sum, with the unit of the impulses. Write its product with the amplitude A to
 * *sum. */
static int multiply_impulses(fvi_adjoint_structure *m, const fvi_adjoint_structure_damper *a,
                             const double *impulse_sum, const double *A, double *sum)
{
    int status = FVI_SUCCESS;
    memset(m->product, 0, m->d * sizeof *m->product);
    if (a->impulse_unit != 0)
        status = fvi_damping_multiply(&a->of.matrix, m->d, a->impulse_unit, impulse_sum, m->product);
    *sum = fvi_dot(m->d, A, m->product);
    return status;
}

/* Write the derivative by a factor of C_j, and add the derivatives by the start through the impulses of its past and
 * its line. The impulses have the amplitude x0 or v0 (19.3).
 *
 *   first        see end_numbers
 *   by_velocity  the derivatives by v0, d numbers */
static int end_damper(fvi_adjoint_structure *m, size_t j, size_t first, double *by_velocity)
{
    fvi_adjoint_structure_damper *a = m->each + j;
    const int is_x0 = a->of.growth < 1;
    const double *amplitude = is_x0 ? m->run->x0 : m->v0;
    double *by_amplitude = is_x0 ? m->stepper->x : by_velocity, impulses, impulses_by_order;
    int status = multiply_impulses(m, a, a->impulse_sum_by_order, amplitude, &impulses_by_order);
    if (!status)
        status = multiply_impulses(m, a, a->impulse_sum, amplitude, &impulses);
    if (status)
        return status;
    for (size_t i = 0; i < m->d; i++) {
        by_amplitude[i] -= a->of.rho * m->product[i];
        by_velocity[i] += a->has_line ? m->run->h * a->force_sum[i] : 0;
    }
    if (m->want->damping)
        m->want->damping[j] = -m->run->h * a->product - a->of.rho * impulses;
    if (m->by_numbers)
        end_numbers(m, a, impulses, impulses_by_order, first);
    return FVI_SUCCESS;
}

int fvi_adjoint_structure_end(fvi_adjoint_structure *m, const double *Jx)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const size_t d = m->d;
    double *by_velocity = m->room, *by_x0 = m->stepper->x; /* the sum of all J_k and of what they drive */
    int status = FVI_SUCCESS;
    memset(by_velocity, 0, d * sizeof *by_velocity);
    for (size_t i = 0; i < d; i++)
        by_x0[i] += Jx[i];
    for (size_t j = 0, first = 0; !status && j < m->count; first += m->each[j++].kernel.count)
        status = end_damper(m, j, first, by_velocity);
    if (!status)
        status = fvi_divide_by_mass(run->system, by_velocity, m->lambda_after);
    for (size_t i = 0; i < d; i++) {
        const int exists = run->law || run->system->mechanism /* a run with x0 != 0 has a solution (19.2) */
                           || fvi_initial_history_solvable(run->past, run->alpha, run->system->damping[i], 1);
        if (want->x0)
            want->x0[i] = exists ? by_x0[i] : NAN;
        if (want->p0)
            want->p0[i] = m->state->v[i] + m->lambda_after[i];
    }
    if (want->mass) /* because v0 = M^-1 p0 */
        *want->mass = m->by_M - fvi_dot(d, run->p0, m->lambda_after);
    if (want->parameters)
        *want->parameters = -run->h * m->by_K;
    return status || fvi_all_finite(d, by_x0) ? status : FVI_EOVRFLW;
}
