/* src/adjoint/adjoint_multistep.c -- The adjoint run of a method without stages. [H 23, 27] */
#include "adjoint_multistep.h"

#include "held_dampers.h"
#include "parameter_derivatives/potential_derivatives.h"
#include "system/arrays.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/quadratic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

static int allocate(fvi_adjoint_multistep *m)
{
    const size_t d = m->d;
    m->each = calloc(m->count + 1, sizeof *m->each);
    m->held = calloc(m->count + 1, sizeof *m->held);
    m->block = FVI_ARRAYS({ &m->Jp, d }, { &m->v0, d }, { &m->jump, d }, { &m->right, d }, { &m->S, d }, { &m->M, d },
                          { &m->by_start, d }, { &m->by_line, d }, { &m->kinetic, d }, { &m->z, d },
                          { &m->z_next, d }, { &m->zeros, d }, { &m->work, d }, { &m->column, d },
                          { &m->multipliers.nu, d }, { &m->multipliers.behind, d }, { &m->multipliers.mean, d },
                          { &m->multipliers.change, d }, { &m->G, m->linearised.size });
    if (!m->each || !m->held || !m->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* Start the adjoint run at node N, with lambda = J_p and the momentum 0. In Algorithm 3 its histories begin at 0. In
 * the other methods they take in lambda - J_p, and end_history has the part that this leaves out. The same holds for
 * the jumps of lambda and jump_history. */
static int start_stepper(fvi_adjoint_multistep *m, const fvi_method *method)
{
    const fvi_system *system = m->run->system;
    fvi_run back = *m->run;
    m->linearised.G = m->has_hessian ? m->G : NULL;
    m->linearised.is_constant = m->is_quadratic;
    m->linearised.by_order = m->by_order;
    m->linearised.from_zero = m->paper_convention;
    m->system = fvi_linearised_system(system, &m->linearised);
    fvi_hold_dampers(system, m->held, &m->mechanism, &m->system);
    back.system = &m->system;
    back.x0 = m->Jp;
    back.p0 = m->zeros;
    back.kappa = 1 - m->kappa;
    back.past = FVI_INITIAL_HISTORY_HELD;
    return fvi_stepper_start(method, &back, &m->stepper, NULL);
}

/* Fill in the sizes and flags of m. */
static void describe_run(const fvi_method *method, const fvi_run *run,
                         fvi_adjoint_multistep *m)
{
    const fvi_system *system = run->system;
    const fvi_potential *potential = &system->potential;
    m->d = system->d;
    m->count = fvi_run_damper_count(run);
    m->paper_convention = method->scheme == FVI_SCHEME_FVI;
    m->is_shifted = method->scheme == FVI_SCHEME_CQ2_SHIFTED;
    m->is_liouville = m->paper_convention && !system->mechanism
                      && run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    m->by_order = m->want->alpha || m->want->orders;
    m->by_numbers = fvi_wanted_kernel_numbers(m->want);
    m->kappa = method->takes_kappa ? run->kappa : 0.5;
    m->multipliers = (fvi_adjoint_multipliers){
        .d = m->d,
        .is_first_order = m->paper_convention,
        .is_mean = method->scheme == FVI_SCHEME_CQ2_MIDPOINT,
        .theta = method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5 : 0
    };
    m->linearised = fvi_linearised_begin(system, 1);
    m->has_hessian = !system->matrices && potential->hessian;
    m->is_quadratic = fvi_potential_is_quadratic(potential);
    m->linearised.history_includes_undamped = m->want->damping != NULL;
    for (size_t i = 0; i < m->d && !system->matrices; i++)
        m->linearised.history_includes_undamped |= system->damping[i] > 0;
}

int fvi_adjoint_multistep_start(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want, int has_jumps,
                                const double *rows, const double *Jp,
                                fvi_adjoint_multistep *m)
{
    *m = (fvi_adjoint_multistep){ .run = run, .want = want, .has_jumps = has_jumps };
    describe_run(method, run, m);
    if (run->system->matrices && want->mass && !run->system->matrices->inertia)
        FVI_FAIL("no derivative by a factor of M without its products",
                 FVI_EUNSUP);
    int status = allocate(m);
    if (status)
        return status;
    memcpy(m->Jp, Jp, m->d * sizeof *Jp);
    status = start_stepper(m, method);
    for (size_t j = 0; !status && j < m->count; j++)
        status = fvi_adjoint_damper_start(m, method, j);
    for (size_t j = 0; !status && m->paper_convention && j < m->count; j++)
        status = fvi_adjoint_damper_first(m, m->each + j, rows + m->d);
    if (status) /* there may be no stepper to ask below */
        return status;
    m->walks_in_blocks = m->paper_convention && m->d == 1 && m->each->damping && !m->by_numbers
                         && !run->system->matrices && !has_jumps;
    m->steps_one_coordinate = fvi_adjoint_multistep_has_one_coordinate(m);
    m->inertia = m->walks_in_blocks ? *fvi_newton_diagonal(m->stepper->newton) : 0;
    return FVI_SUCCESS;
}

void fvi_adjoint_multistep_free(fvi_adjoint_multistep *m)
{
    fvi_stepper_free(m->stepper);
    for (size_t j = 0; m->each && j < m->count; j++)
        fvi_adjoint_damper_free(m->each + j);
    free(m->each);
    free(m->held);
    free(m->block);
}

/* ---- a step ---- */

/* Begin the step from node k + 1 to node k: add J_{k+1} to the momentum, where it acts as an impulse. Add the parts of
 * the damping at node k + 1 that the histories of the stepper leave out. Jx is J_{k+1}, d numbers. */
static int apply_slopes(fvi_adjoint_multistep *m, size_t k, const double *rows,
                        const double *Jx)
{
    const double t = (double)(k + 1) * m->run->h;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < m->d; i++) {
        m->stepper->p[i] += Jx[i];
        m->by_start[i] += Jx[i];
        m->by_line[i] += t * Jx[i];
    }
    for (size_t j = 0; !status && j < m->count; j++)
        status = fvi_adjoint_damper_left_out(m, m->each + j, k + 1, rows + m->d);
    return status;
}

/* Evaluate G at S = kappa x_k + (1 - kappa) x_{k+1}; only once if U is quadratic. */
static int evaluate_hessian(fvi_adjoint_multistep *m, size_t k, const double *rows)
{
    for (size_t i = 0; i < m->d; i++)
        m->S[i] = rows[i] + (1 - m->kappa) * (rows[m->d + i] - rows[i]);
    if (!m->has_hessian || (m->is_quadratic && k + 1 < m->run->steps))
        return FVI_SUCCESS;
    return fvi_potential_evaluate_hessians(m->run->system, 1, m->S, m->linearised.size,
                                           m->G);
}

/* Add the derivatives by the parameters of U in this step. With matrices add the derivative by a factor of K instead;
 * stepper->g is K M_k. */
static int accumulate_parameters(fvi_adjoint_multistep *m)
{
    if (!m->run->system->matrices)
        return fvi_potential_accumulate_parameters(m->want, m->run->system, 1, m->run->h,
                                                   NULL, m->S, m->M, 1, m->column);
    m->by_K += fvi_dot(m->d, m->S, m->stepper->g);
    return FVI_SUCCESS;
}

/* Add the derivatives by the masses, or by a factor of M, in this step. They lack the factor 1/h, see write_mass. */
static int accumulate_mass(fvi_adjoint_multistep *m, const double *rows)
{
    const fvi_matrices *matrices = m->run->system->matrices;
    const double *left = m->stepper->x; /* lambda_k */
    double *moved = m->column, *momentum = matrices ? m->work : moved;
    int status = FVI_SUCCESS;
    if (!m->want->mass)
        return status;
    for (size_t i = 0; i < m->d; i++)
        moved[i] = m->right[i] - left[i];
    if (matrices)
        status = matrices->inertia(m->d, moved, matrices->params, momentum);
    for (size_t i = 0; i < m->d; i++)
        m->kinetic[i] += (rows[m->d + i] - rows[i]) * momentum[i];
    return status;
}

/* Add the derivatives by the force at the two ends of step k. Algorithm 3 applies h F(t_{k+1}), the other methods half
 * of it at each end. */
static void accumulate_forces(fvi_adjoint_multistep *m, size_t k)
{
    const double *left = m->stepper->x, *right = m->right, h = m->run->h; /* lambda_k and lambda_{k+1} */
    const size_t d = m->d;
    double *force = m->want->force ? m->want->force + k * d : NULL;
    for (size_t i = 0; force && i < d; i++) {
        force[d + i] += m->paper_convention ? h * right[i] : h / 2 * right[i];
        force[i] += m->paper_convention ? 0 : h / 2 * left[i];
    }
}

//> step
int fvi_adjoint_multistep_step(fvi_adjoint_multistep *m, size_t k, const double *rows,
                               const double *Jx)
{
    fvi_stepper *s = m->stepper;
    const double h = m->run->h, t = ((double)k + 1 - m->kappa) * h; /* the time of S */
    int status = evaluate_hessian(m, k, rows);
    if (!status)
        status = apply_slopes(m, k, rows, Jx);
    memcpy(m->right, s->x, m->d * sizeof *m->right);
    if (!status)
        status = m->steps_one_coordinate ? fvi_adjoint_multistep_step_one_coordinate(m)
                                : fvi_stepper_step(s);
    for (size_t i = 0; i < m->d; i++) { /* s->g is G M_k */
        m->M[i] = m->right[i] + m->kappa * (s->x[i] - m->right[i]);
        m->by_start[i] -= h * s->g[i];
        m->by_line[i] -= h * t * s->g[i];
    }
    accumulate_forces(m, k);
    if (!status)
        status = accumulate_parameters(m);
    if (!status)
        status = accumulate_mass(m, rows);
    if (m->by_numbers)
        fvi_adjoint_multipliers_next(&m->multipliers, k + 1 == m->run->steps, m->right, s->x,
                                     m->has_jumps ? m->jump : NULL);
    for (size_t j = 0; !status && j < m->count; j++)
        status = fvi_adjoint_damper_step(m, m->each + j, k, rows);
    return status;
}
//< step

//> jump
/* A run that ends at node k has an adjoint run that begins there, at J_p. The adjoint runs of all p_k that J depends on
 * are added up, so lambda jumps. The history of the stepper does not get the jump, because the origin of the history
 * jumps, too. The jump_history of each damper has the part that this leaves out. (23.27) */
int fvi_adjoint_multistep_jump(fvi_adjoint_multistep *m, const double *Jp)
{
    int status = FVI_SUCCESS;
    memcpy(m->jump, Jp, m->d * sizeof *Jp);
    for (size_t i = 0; i < m->d; i++) {
        m->stepper->x[i] += Jp[i];
        m->Jp[i] += Jp[i];
    }
    for (size_t j = 0; !status && j < m->count; j++)
        status = fvi_adjoint_damper_jump(m, m->each + j, Jp);
    return status || !fvi_damping_of(m->stepper) ? status : fvi_damping_move_origin(m->stepper, Jp);
}
//< jump

/* ---- the end ---- */

/* Complete the derivative by x0 in m->by_start, but for the dampers. (23.17) A constant that is added to all x_k
 * changes grad U, and the force of the past if its amplitude A (19.3) is x0; it changes nothing else. In Algorithm 3
 * with Riemann-Liouville's past the history takes in x0 itself. There the derivative is the momentum that arrives,
 * without the part of lambda_0, which N_0 does not contain. (23.6) */
static int finish_start_derivative(fvi_adjoint_multistep *m, const double *Jx)
{
    const fvi_stepper *s = m->stepper;
    const int status = m->is_liouville ? fvi_adjoint_damper_left_out(m, m->each, 0, m->run->x0) : FVI_SUCCESS;
    for (size_t i = 0; i < m->d; i++)
        m->by_start[i] = Jx[i] + (m->is_liouville ? s->p[i] : m->by_start[i]);
    return status;
}

/* Write the derivative by p0 through v0 = M^-1 p0 to by_drift, after the dampers have completed m->by_line. It is 0
 * unless the line t v0 is subtracted from x for a history. Then a line that is added to x and to this line changes grad
 * U, by (13.7) the force of the past, and the histories of other dampers that subtract no line. */
static int compute_drift_derivative(fvi_adjoint_multistep *m, double *by_drift)
{
    int status = FVI_SUCCESS;
    memset(by_drift, 0, m->d * sizeof *by_drift);
    if (!m->needs_velocity)
        return status;
    status = fvi_divide_by_mass(m->run->system, m->by_line, by_drift);
    for (size_t i = 0; i < m->d; i++)
        by_drift[i] += m->Jp[i] - m->stepper->x[i];
    return status;
}

/* Write the derivatives by the masses, or by a factor of M, if they are wanted. v0 depends on them, too. */
static void write_mass(const fvi_adjoint_multistep *m, const double *by_drift)
{
    const fvi_run *run = m->run;
    const int is_whole = run->system->matrices != NULL;
    double *mass = m->want->mass;
    if (mass)
        memset(mass, 0, (is_whole ? 1 : m->d) * sizeof *mass);
    for (size_t i = 0; mass && i < m->d; i++)
        mass[is_whole ? 0 : i] += m->kinetic[i] / run->h
                                  - by_drift[i] * (is_whole ? run->p0[i] : m->v0[i]);
}

//> end
int fvi_adjoint_multistep_end(fvi_adjoint_multistep *m, const double *Jx)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    double *by_drift = m->M;
    int status = finish_start_derivative(m, Jx);
    for (size_t j = 0; !status && j < m->count; j++)
        status = fvi_adjoint_damper_end(m, m->each + j);
    if (!status)
        status = compute_drift_derivative(m, by_drift);
    for (size_t i = 0; i < m->d; i++) {
        const int exists = m->paper_convention || run->system->mechanism /* a run with x0 != 0 has a solution (19.2) */
                           || fvi_initial_history_solvable(run->past, run->alpha,
                                                           run->system->damping[i], 1);
        if (want->x0)
            want->x0[i] = exists ? m->by_start[i] : NAN;
        if (want->p0)
            want->p0[i] = m->stepper->x[i] + by_drift[i]; /* stepper->x is lambda_0 */
    }
    write_mass(m, by_drift);
    if (want->parameters && run->system->matrices)
        *want->parameters = -run->h * m->by_K;
    return status || fvi_all_finite(m->d, m->by_start) ? status : FVI_EOVRFLW;
}
//< end
