/* src/adjoint/adjoint_multistep.c -- The adjoint run of a method without stages. [H 23] */
#include "adjoint_multistep.h"

#include "parameter_derivatives/potential_derivatives.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "system/quadratic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

static int allocate(fvi_adjoint_multistep *m)
{
    const size_t d = m->d;
    m->block = FVI_ARRAYS({ &m->Jp, d }, { &m->CJ, d }, { &m->v0, d }, { &m->right, d }, { &m->S, d }, { &m->M, d },
                          { &m->by_start, d }, { &m->by_line, d }, { &m->kinetic, d }, { &m->impulse_sum, d },
                          { &m->impulse_sum_by_order, d }, { &m->z, d }, { &m->z_next, d }, { &m->sum, d },
                          { &m->work, d }, { &m->column, d }, { &m->multipliers.nu, d },
                          { &m->multipliers.behind, d }, { &m->multipliers.mean, d }, { &m->multipliers.change, d },
                          { &m->CA, d }, { &m->B, d }, { &m->jump, d }, { &m->CB, d }, { &m->N, m->r },
                          { &m->Ndot, m->r }, { &m->G, m->linearised.size });
    if (!m->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* Start the adjoint run at node N, with lambda = J_p and the momentum 0. In Algorithm 3 its history begins at 0. In the
 * other methods the history takes in lambda - J_p, and m->end_history has the part that this leaves out. The same holds
 * for the jumps of lambda and m->jump_history. */
static int start_stepper(fvi_adjoint_multistep *m, const fvi_method *method)
{
    fvi_run back = *m->run;
    const fvi_run_damper damper = fvi_run_damper_of(m->run, 0);
    const int by_order = m->want->alpha != NULL;
    int starts_off_zero = 0;
    m->linearised.G = m->has_hessian ? m->G : NULL;
    m->linearised.is_constant = m->is_quadratic;
    m->linearised.by_order = by_order;
    m->linearised.history_includes_undamped = m->is_damped;
    m->linearised.from_zero = m->paper_convention;
    m->system = fvi_linearised_system(m->run->system, &m->linearised);
    back.system = &m->system;
    back.x0 = m->Jp;
    back.p0 = m->work; /* zeros */
    back.kappa = 1 - m->kappa;
    back.past = FVI_INITIAL_HISTORY_HELD;
    int status = fvi_stepper_start(method, &back, &m->stepper, NULL);
    if (status)
        return status;
    m->damping = fvi_damping_of(m->stepper);
    for (size_t i = 0; i < m->d; i++)
        starts_off_zero |= m->Jp[i] != 0;
    if (m->damping && starts_off_zero && !m->paper_convention)
        status = fvi_constant_history_start(method, m->run, &damper, 1, by_order, &m->end_history);
    if (!status && m->damping && m->has_jumps)
        status = fvi_constant_history_start(method, m->run, &damper, m->d, by_order, &m->jump_history);
    return status;
}

/* Prepare the impulses by which the initial history of the run acts on the two ends of each step. */
static int prepare_initial_impulses(fvi_adjoint_multistep *m)
{
    static const double ends[] = { 0, 1 }; /* of a step */
    const fvi_run *run = m->run;
    const fvi_run_damper damper = fvi_run_damper_of(run, 0);
    m->has_initial_impulses =
        !m->paper_convention && m->is_damped
        && fvi_initial_history_acts(run->past, m->growth / 2);
    if (!m->has_initial_impulses)
        return FVI_SUCCESS;
    return fvi_initial_history_force_prepare(&damper, run->h, 2, ends,
                                             &m->history_force, &m->impulse_size);
}

/* Fill in the sizes and flags of m. */
static void describe_run(const fvi_method *method, const fvi_run *run,
                         fvi_adjoint_multistep *m)
{
    const fvi_system *system = run->system;
    const fvi_potential *potential = &system->potential;
    m->d = m->r = system->d;
    m->scheme = method->scheme;
    m->paper_convention = method->scheme == FVI_SCHEME_FVI;
    m->is_liouville = m->paper_convention
                      && run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    m->growth = fvi_run_damper_of(run, 0).growth;
    m->has_drift = m->growth > 1
                   && (run->past == FVI_INITIAL_HISTORY_CAPUTO || !m->paper_convention);
    m->kappa = method->takes_kappa ? run->kappa : 0.5;
    m->theta = method->scheme == FVI_SCHEME_CQ2_SHIFTED    ? run->alpha
               : method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5
                                                           : 0;
    m->multipliers = (fvi_adjoint_multipliers){
        .d = m->d,
        .is_first_order = m->paper_convention,
        .is_mean = m->scheme == FVI_SCHEME_CQ2_MIDPOINT,
        .theta = m->theta
    };
    m->linearised = fvi_linearised_begin(system, 1);
    m->has_hessian = !system->matrices && potential->hessian;
    m->is_quadratic = fvi_potential_is_quadratic(potential);
    m->is_damped = m->want->damping != NULL;
    if (system->matrices) {
        m->r = system->matrices->history_size;
        m->is_damped = m->r > 0;
    }
    for (size_t i = 0; i < m->d && !system->matrices; i++)
        m->is_damped |= system->damping[i] > 0;
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
    status = prepare_initial_impulses(m);
    if (!status && m->has_drift)
        status = fvi_divide_by_mass(run->system, run->p0, m->v0);
    if (!status)
        status = start_stepper(m, method);
    if (!status && m->is_damped)
        status = fvi_adjoint_multistep_damping_start(m, method);
    if (!status && m->damping && m->paper_convention)
        status = fvi_adjoint_multistep_first_sums(m, rows + m->d);
    if (status) /* there may be no stepper to ask below */
        return status;
    m->walks_in_blocks = m->paper_convention && m->d == 1 && m->damping && m->terms == 0
                         && !run->system->matrices && !has_jumps;
    m->steps_one_coordinate = fvi_adjoint_multistep_has_one_coordinate(m);
    m->inertia = m->walks_in_blocks ? *fvi_newton_diagonal(m->stepper->newton) : 0;
    return FVI_SUCCESS;
}

void fvi_adjoint_multistep_free(fvi_adjoint_multistep *m)
{
    fvi_stepper_free(m->stepper);
    fvi_constant_history_stop(&m->end_history);
    fvi_initial_history_force_stop(&m->history_force);
    fvi_constant_history_stop(&m->jump_history);
    fvi_order_filter_stop(&m->filter);
    for (size_t i = 0; i < m->terms; i++)
        fvi_node_term_stop(&m->each[i]);
    free(m->each);
    free(m->block);
}

/* ---- a step ---- */

/* Begin the step from node k + 1 to node k: add J_{k+1} to the momentum, where it acts as an impulse. Subtract the
 * parts of the damping at node k + 1 that the history of the stepper leaves out. Jx is J_{k+1}, d numbers. */
static int apply_slopes(fvi_adjoint_multistep *m, size_t k, const double *rows,
                        const double *Jx)
{
    const double t = (double)(k + 1) * m->run->h;
    for (size_t i = 0; i < m->d; i++) {
        m->stepper->p[i] += Jx[i];
        m->by_start[i] += Jx[i];
        m->by_line[i] += t * Jx[i];
    }
    int status = FVI_SUCCESS;
    if (m->end_history.memory)
        status = fvi_adjoint_multistep_add_constant(m, k, rows + m->d);
    return status || !m->jump_history.memory
               ? status
               : fvi_adjoint_multistep_add_jumps(m, k + 1, rows + m->d);
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

/* Return a . b. It begins with the first product and not with 0, so that a sum of products -0 is -0. */
static double dot(size_t d, const double *a, const double *b)
{
    double sum = a[0] * b[0];
    for (size_t i = 1; i < d; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Add the derivatives by the parameters of U in this step. With matrices add the derivative by a factor of K instead;
 * stepper->g is K M_k. */
static int accumulate_parameters(fvi_adjoint_multistep *m)
{
    if (!m->run->system->matrices)
        return fvi_potential_accumulate_parameters(m->want, m->run->system, 1, m->run->h,
                                                   NULL, m->S, m->M, 1, m->column);
    m->by_K += dot(m->d, m->S, m->stepper->g);
    return FVI_SUCCESS;
}

/* Add the derivatives by the masses, or by a factor of M, in this step. They lack the factor 1/h, see write_mass. */
static int accumulate_mass(fvi_adjoint_multistep *m, const double *rows)
{
    const fvi_matrices *matrices = m->run->system->matrices;
    const double *left = m->stepper->x; /* lambda_k */
    const size_t d = m->d;
    int status = FVI_SUCCESS;
    if (!matrices)
        for (size_t i = 0; i < d; i++)
            m->kinetic[i] += (rows[d + i] - rows[i]) * (m->right[i] - left[i]);
    if (!matrices || !m->want->mass)
        return status;
    for (size_t i = 0; i < d; i++)
        m->column[i] = m->right[i] - left[i];
    status = matrices->inertia(d, m->column, matrices->params, m->work);
    for (size_t i = 0; i < d; i++)
        m->by_M += (rows[d + i] - rows[i]) * m->work[i];
    return status;
}

/* Add the derivatives by the numbers of a law's terms through the impulses of the initial history in step k. */
static void accumulate_impulses_of_terms(fvi_adjoint_multistep *m, size_t k)
{
    const double left = m->terms ? dot(m->d, m->CA, m->stepper->x) : 0,
                 right = m->terms ? dot(m->d, m->CA, m->right) : 0;
    for (size_t l = 0; l < m->terms; l++)
        fvi_node_term_accumulate_impulses(&m->each[l], k, left, right, m->want, l);
}

/* Add the derivatives by the force at the two ends of step k, and the products of the impulses of the initial history
 * with lambda. Algorithm 3 applies h F(t_{k+1}), the other methods half of it at each end. */
static void accumulate_forces(fvi_adjoint_multistep *m, size_t k)
{
    const double *left = m->stepper->x, *right = m->right, h = m->run->h; /* lambda_k and lambda_{k+1} */
    const size_t d = m->d;
    double *force = m->want->force ? m->want->force + k * d : NULL;
    for (size_t i = 0; force && i < d; i++) {
        force[d + i] += m->paper_convention ? h * right[i] : h / 2 * right[i];
        force[i] += m->paper_convention ? 0 : h / 2 * left[i];
    }
    if (!m->has_initial_impulses)
        return;
    double impulse[2] = { 0 }, slope[2] = { 0 }; /* at the two ends; their derivatives by e */
    accumulate_impulses_of_terms(m, k);
    fvi_initial_history_force_impulses(&m->history_force, k, impulse);
    if (m->want->alpha)
        fvi_kernel_impulses_by_order(&m->history_force.initial_impulse, k, slope);
    for (size_t i = 0; i < d; i++) {
        m->impulse_sum[i] += impulse[0] * left[i] + impulse[1] * right[i];
        m->impulse_sum_by_order[i] += slope[0] * left[i] + slope[1] * right[i];
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
    return status || !m->damping
               ? status
               : fvi_adjoint_multistep_accumulate_damping(m, k, rows);
}
//< step

//> jump
/* A run that ends at node k has an adjoint run that begins there, at J_p. The adjoint runs of all p_k that J depends on
 * are added up, so lambda jumps. The history of the stepper does not get the jump, because the origin of the history
 * jumps, too. m->jump_history has the part that this leaves out. (23.27) */
int fvi_adjoint_multistep_jump(fvi_adjoint_multistep *m, const double *Jp)
{
    memcpy(m->jump, Jp, m->d * sizeof *Jp);
    for (size_t i = 0; i < m->d; i++) {
        m->stepper->x[i] += Jp[i];
        m->Jp[i] += Jp[i];
        m->B[i] += Jp[i];
    }
    return m->damping ? fvi_damping_move_origin(m->stepper, Jp) : FVI_SUCCESS;
}
//< jump

/* ---- the end ---- */

/* Complete the derivative by x0 in m->by_start. (23.17) A constant that is added to all x_k changes grad U, and the
 * force of the past if its amplitude A (19.3) is x0; it changes nothing else. In Algorithm 3 with Riemann-Liouville's
 * past the history takes in x0 itself. There the derivative is the momentum that arrives, without the part of lambda_0,
 * which N_0 does not contain. (23.6) */
static int finish_start_derivative(fvi_adjoint_multistep *m, const double *Jx)
{
    const fvi_stepper *s = m->stepper;
    for (size_t i = 0; i < m->d; i++)
        m->by_start[i] = Jx[i] + (m->is_liouville ? s->p[i] : m->by_start[i]);
    if (m->is_liouville && m->damping)
        return fvi_adjoint_multistep_apply_damping(m, -m->damping->unit, s->x,
                                                   m->by_start);
    return m->has_initial_impulses && m->growth < 1
               ? fvi_adjoint_multistep_apply_damping(m, m->impulse_size, m->impulse_sum,
                                                     m->by_start)
               : FVI_SUCCESS;
}

/* Write the derivative by p0, without its part lambda_0, to by_drift. It is 0 unless the line t p0/m is subtracted from
 * x for the history. Then a line that is added to x and to this line changes grad U only, and by (13.7) the force of
 * the past. */
static int compute_drift_derivative(fvi_adjoint_multistep *m, double *by_drift)
{
    const fvi_run *run = m->run;
    int status = FVI_SUCCESS;
    memset(by_drift, 0, m->d * sizeof *by_drift);
    if (!m->has_drift || !m->damping)
        return status;
    if (m->has_initial_impulses)
        status = fvi_adjoint_multistep_apply_damping(m, m->impulse_size, m->impulse_sum,
                                                     m->by_line);
    if (!status)
        status = fvi_divide_by_mass(run->system, m->by_line, by_drift);
    for (size_t i = 0; i < m->d; i++)
        by_drift[i] += m->Jp[i] - m->stepper->x[i];
    return status;
}

/* Write the derivatives by the masses, or by a factor of M, if they are wanted. The drift depends on v0 = M^-1
 * p0, too. */
static void write_mass(const fvi_adjoint_multistep *m, const double *by_drift)
{
    const fvi_run *run = m->run;
    double *mass = m->want->mass;
    if (mass && run->system->matrices)
        *mass = m->by_M / run->h - dot(m->d, run->p0, by_drift);
    for (size_t i = 0; mass && !run->system->matrices && i < m->d; i++)
        mass[i] = m->kinetic[i] / run->h
                  - by_drift[i] * (run->p0[i] / run->system->mass[i]);
}

//> end
int fvi_adjoint_multistep_end(fvi_adjoint_multistep *m, const double *Jx)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    double *by_drift = m->work;
    int status = m->jump_history.memory && m->paper_convention
                     ? fvi_adjoint_multistep_add_jumps(m, 0, run->x0)
                     : FVI_SUCCESS;
    if (!status)
        status = finish_start_derivative(m, Jx);
    if (!status)
        status = compute_drift_derivative(m, by_drift);
    for (size_t i = 0; i < m->d; i++) {
        const int exists = m->paper_convention /* a run with x0 != 0 has a solution (19.2) */
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
    if (!status && m->damping)
        status = fvi_adjoint_multistep_end_damping(m);
    return status || fvi_all_finite(m->d, m->by_start) ? status : FVI_EOVRFLW;
}
//< end
