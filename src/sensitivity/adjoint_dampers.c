/* src/sensitivity/adjoint_dampers.c -- The run of a structure with several dampers, backwards.
 *                                                                     [H 23, 27] */
#include "adjoint_dampers.h"

#include "kernel/kernel_terms.h"
#include "system/all_zero.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_adjoint_dampers_check(const fvi_method *method, const fvi_run *run,
                              const fvi_objective *objective,
                              const fvi_sensitivities *want)
{
    const fvi_mechanism *m = run->system->mechanism;
    if (want->alpha)
        FVI_FAIL("several dampers have orders, and no alpha", FVI_EINVAL);
    if (objective->has_momenta)
        FVI_FAIL("with several dampers J depends on positions and p_N; with one damping on "
                 "every momentum",
                 FVI_EUNSUP);
    if (want->mass && !run->system->matrices->inertia)
        FVI_FAIL("no derivative by a factor of M without its products", FVI_EUNSUP);
    for (size_t j = 0; j < m->damper_count; j++) {
        const fvi_kernel *kernel = m->damper[j].kernel;
        if (m->damper[j].past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
            continue;
        if (method->scheme == FVI_SCHEME_FVI)
            FVI_FAIL("no adjoint by fvi with Riemann and Liouville's past of one of "
                     "several dampers; by fvi-bdf2 and fvi-stable there is",
                     FVI_EUNSUP);
        if (!fvi_kernel_is_power(kernel) || kernel->term->alpha > 0.5)
            FVI_FAIL("no adjoint with Riemann and Liouville's past of a law that other starts would "
                     "stretch: no method of an adjoint knows them",
                     FVI_EUNSUP);
    }
    return FVI_SUCCESS;
}

/* ---- the start ---- */

static int allocate(fvi_adjoint_dampers *m)
{
    double **each[] = { &m->Jp, &m->v0, &m->right, &m->by_start,
                        &m->z,  &m->work, &m->column, &m->moved, &m->zeros,
                        &m->multipliers.nu, &m->multipliers.behind,
                        &m->multipliers.mean, &m->multipliers.change };
    enum { ARRAYS = sizeof each / sizeof *each, OF_A_DAMPER = 5 };
    const size_t d = m->d;
    m->each = calloc(m->count, sizeof *m->each);
    m->held = calloc(m->count, sizeof *m->held);
    m->block = calloc((ARRAYS + 2 + OF_A_DAMPER * m->count) * d, sizeof *m->block);
    if (!m->each || !m->held || !m->block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    double *next = m->block;
    for (size_t i = 0; i < ARRAYS; i++, next += d)
        *each[i] = next;
    m->remembered = next;
    next += 2 * d;
    for (size_t j = 0; j < m->count; j++, next += OF_A_DAMPER * d) {
        m->each[j].by_drift = next;
        m->each[j].pull = next + d;
        m->each[j].CJ = next + 2 * d;
        m->each[j].pull_by_order = next + 3 * d;
        m->each[j].CA = next + 4 * d;
    }
    return FVI_SUCCESS;
}

/* The mirrored run at node N, at rest at J_p; all its dampers were held. */
static int start_stepper(fvi_adjoint_dampers *m, const fvi_method *method)
{
    fvi_run back = *m->run;
    const fvi_system *system = m->run->system;
    for (size_t j = 0; j < m->count; j++) {
        m->held[j] = system->mechanism->damper[j];
        m->held[j].past = FVI_INITIAL_HISTORY_HELD;
    }
    m->mechanism = (fvi_mechanism){ .damper_count = m->count, .damper = m->held };
    m->linearised = fvi_linearised_begin(system, 1);
    m->linearised.from_zero = m->paper_convention;
    m->linearised.by_order = m->want->orders != NULL;
    m->system = fvi_linearised_system(system, &m->linearised);
    m->system.mechanism = &m->mechanism;
    back.system = &m->system;
    back.x0 = m->Jp;
    back.p0 = m->work; /* zeros */
    back.kappa = 1 - m->kappa;
    return fvi_stepper_start(method, &back, &m->stepper, NULL);
}

/* The impulses of the past, for an amplitude of 1. */
static int start_impulses(const fvi_adjoint_dampers *m, fvi_adjoint_damper *a)
{
    static const double ends[] = { 0, 1 };
    if (m->paper_convention || !fvi_initial_history_acts(a->of.past, a->of.growth / 2))
        return FVI_SUCCESS;
    return fvi_initial_history_force_prepare(&a->of, m->run->h, 2, ends, &a->history_force,
                                             &a->impulse_unit);
}

/* What the memory held at J_p leaves out, (23.23). */
static int start_constant(const fvi_adjoint_dampers *m, const fvi_method *method,
                          fvi_adjoint_damper *a)
{
    if (m->paper_convention || fvi_all_zero(m->d, m->Jp))
        return FVI_SUCCESS;
    const int by_order = m->want->orders && !a->of.law,
              status = fvi_adjoint_constant_start(method, m->run, &a->of, 1, by_order,
                                                  &a->constant);
    return status ? status
                  : fvi_damping_multiply(&a->of.matrix, m->d, 1, m->Jp, a->CJ);
}

static int start_damper(fvi_adjoint_dampers *m, const fvi_method *method, size_t j)
{
    fvi_adjoint_damper *a = m->each + j;
    a->of = fvi_run_damper_of(m->run, j);
    a->first = j > 0 ? a[-1].first + m->run->system->mechanism->damper[j - 1].kernel->count : 0;
    a->damping = fvi_damping_of(m->stepper);
    while (a->damping && a->damping->number != j)
        a->damping = a->damping->next;
    if (!a->damping)
        return FVI_SUCCESS;
    a->unit = a->of.law ? a->damping->unit : pow(m->run->h, 1 - 2 * a->of.alpha);
    a->theta = method->scheme == FVI_SCHEME_CQ2_SHIFTED    ? a->of.growth / 2
               : method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5
                                                           : 0;
    a->has_drift = a->of.growth > 1
                   && (a->of.past == FVI_INITIAL_HISTORY_CAPUTO || !m->paper_convention);
    int status = start_impulses(m, a);
    if (!status)
        status = start_constant(m, method, a);
    return status || !m->by_numbers ? status
                                    : fvi_adjoint_dampers_numbers_start(m, method, a);
}

/* ---- a node ---- */

void fvi_adjoint_dampers_elongation(const fvi_adjoint_dampers *m, const fvi_adjoint_damper *a,
                                    size_t k, const double *x, double *z)
{
    const double t = (double)k * m->run->h;
    for (size_t i = 0; i < m->d; i++)
        z[i] = x[i] - m->run->x0[i] - (a->has_drift ? t * m->v0[i] : 0);
}

static double dot(size_t d, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += a[i] * b[i];
    return sum;
}

/* C N, d numbers, meets z and the time of the node. */
static void accumulate(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, double share,
                       const double *z, const double *CN, double t)
{
    a->sum += share * dot(m->d, z, CN);
    for (size_t i = 0; a->has_drift && i < m->d; i++)
        a->by_drift[i] += share * t * CN[i];
}

/* C times the last sums of a memory. */
static int multiply_sums(fvi_adjoint_dampers *m, const fvi_adjoint_damper *a, double *CN)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    memset(CN, 0, m->d * sizeof *CN);
    return C->damp(m->d, -1, a->damping->H, C->params, CN);
}

/* Of Algorithm 3 at node N, whose memory has taken in lambda_N. */
static int first_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, const double *x)
{
    const size_t N = m->run->steps;
    fvi_adjoint_dampers_elongation(m, a, N, x, m->z);
    int status = fvi_damping_apply_force(a->damping, 1, a->damping->H, m->stepper->p);
    if (!status)
        status = multiply_sums(m, a, m->column);
    if (!status)
        accumulate(m, a, 1, m->z, m->column, (double)N * m->run->h);
    return status || !m->by_numbers
               ? status
               : fvi_adjoint_dampers_numbers_sums(m, a, m->z, NULL);
}

int fvi_adjoint_dampers_start(const fvi_method *method, const fvi_run *run,
                              const fvi_sensitivities *want, const double *rows,
                              const double *Jp, fvi_adjoint_dampers *m)
{
    *m = (fvi_adjoint_dampers){ .run = run,
                                .want = want,
                                .d = run->system->d,
                                .count = run->system->mechanism->damper_count,
                                .paper_convention = method->scheme == FVI_SCHEME_FVI,
                                .is_shifted = method->scheme == FVI_SCHEME_CQ2_SHIFTED,
                                .by_numbers = fvi_adjoint_kernel_is_wanted(want),
                                .kappa = method->takes_kappa ? run->kappa : 0.5 };
    m->multipliers = (fvi_adjoint_multipliers){
        .d = m->d,
        .is_first_order = m->paper_convention,
        .is_mean = method->scheme == FVI_SCHEME_CQ2_MIDPOINT,
        .theta = method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5 : 0
    };
    int status = allocate(m);
    if (status)
        return status;
    memcpy(m->Jp, Jp, m->d * sizeof *Jp);
    status = start_stepper(m, method);
    if (!status)
        status = fvi_damping_velocity(run->system, run->p0, m->v0);
    for (size_t j = 0; !status && j < m->count; j++) {
        status = start_damper(m, method, j);
        if (!status && m->paper_convention && m->each[j].damping)
            status = first_sums(m, m->each + j, rows + m->d);
    }
    return status;
}

/* The memory of the constant J_p: on the momentum, and on z_{k+1}. */
static int add_constant(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k,
                        const double *x)
{
    const double one = 1, change = k + 1 == m->run->steps;
    if (!a->constant.memory)
        return FVI_SUCCESS;
    const int status = fvi_adjoint_constant_next(&a->constant, &one, &change);
    const double value = *a->constant.value;
    fvi_adjoint_dampers_elongation(m, a, k + 1, x, m->z);
    for (size_t i = 0; i < m->d; i++)
        m->stepper->p[i] -= a->unit * a->of.rho * value * a->CJ[i];
    accumulate(m, a, value, m->z, a->CJ, (double)(k + 1) * m->run->h);
    const double product = dot(m->d, m->z, a->CJ);
    a->sum_by_order += *a->constant.rate * product;
    a->sum_by_theta += m->is_shifted ? *a->constant.by_theta * product : 0;
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
        a->pull[i] += at[0] * left[i] + at[1] * right[i];
    if (!m->want->orders || a->of.law)
        return;
    fvi_kernel_impulses_by_order(&a->history_force.initial_impulse, k, slope);
    for (size_t i = 0; i < m->d; i++)
        a->pull_by_order[i] += slope[0] * left[i] + slope[1] * right[i];
}

/* The memory is at node k: N = (1 - theta) H_k + theta H_{k-1}. */
static int add_sums(fvi_adjoint_dampers *m, fvi_adjoint_damper *a, size_t k,
                    const double *rows)
{
    const double t = ((double)k + a->theta) * m->run->h;
    fvi_adjoint_dampers_elongation(m, a, k, rows, m->z);
    fvi_adjoint_dampers_elongation(m, a, k + 1, rows + m->d, m->work);
    for (size_t i = 0; i < m->d; i++)
        m->z[i] += a->theta * (m->work[i] - m->z[i]);
    int status = multiply_sums(m, a, m->column);
    accumulate(m, a, 1, m->z, m->column, t);
    if (!status && m->by_numbers)
        status = fvi_adjoint_dampers_numbers_sums(m, a, m->z, rows);
    return status || !m->by_numbers ? status
                                    : fvi_adjoint_dampers_numbers_step(m, a, k, rows);
}

/* By factors of M and K; stepper->g is K M_k. */
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
                                     NULL);
    for (size_t j = 0; !status && j < m->count; j++) {
        add_impulses(m, m->each + j, k);
        if (m->each[j].damping)
            status = add_sums(m, m->each + j, k, rows);
    }
    return status;
}

/* ---- the end ---- */

/* By a factor of C_j; and what the impulses of its past have of the start: of x0 itself, or of v0,
 * into `by_velocity`. */
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
                     ? fvi_damping_multiply(&a->of.matrix, m->d, a->impulse_unit, a->pull,
                                            m->column)
                     : FVI_SUCCESS;
    for (size_t i = 0; i < m->d; i++)
        to[i] -= a->of.rho * m->column[i];
    const double at = dot(m->d, A, m->column);
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
        status = fvi_damping_velocity(m->run->system, by_velocity, m->work);
    for (size_t i = 0; i < d; i++) {
        m->by_start[i] += Jx[i];
        if (want->x0)
            want->x0[i] = m->by_start[i];
        if (want->p0)
            want->p0[i] = m->stepper->x[i] + m->work[i];
    }
    if (want->mass) /* v0 is M^-1 p0 */
        *want->mass = m->by_M / m->run->h - dot(d, m->run->p0, m->work);
    if (want->parameters)
        *want->parameters = -m->run->h * m->by_K;
    return status || fvi_all_finite(d, m->by_start) ? status : FVI_EOVRFLW;
}

void fvi_adjoint_dampers_free(fvi_adjoint_dampers *m)
{
    fvi_stepper_free(m->stepper);
    for (size_t j = 0; m->each && j < m->count; j++) {
        fvi_adjoint_constant_stop(&m->each[j].constant);
        fvi_initial_history_force_stop(&m->each[j].history_force);
        fvi_adjoint_dampers_numbers_stop(m->each + j);
    }
    free(m->each);
    free(m->held);
    free(m->block);
}
