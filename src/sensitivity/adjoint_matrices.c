/* src/sensitivity/adjoint_matrices.c -- The run that goes backwards, with matrices.
 *                                                                     [H 23]
 * K is constant, so that (23.2) can be taken at its word: the mirrored run is a run, by the
 * same stepper, of the same M, C and K, with 1 - kappa. It begins at J_p, its past is held,
 * and the slopes of J are its forces. What its memory should have of J_p and has not, as it
 * was held there, are impulses that are known beforehand, (23.23). */
#include "adjoint_matrices.h"

#include <fvi/fvi.h>
#include "methods/damping.h"
#include "adjoint_constant.h"
#include "adjoint_factors.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ARRAYS = 13 };

/* d numbers each. */
typedef struct {
    const fvi_run *run;
    int paper_convention;          /* Algorithm 3 */
    double kappa;         /* of the method, or of the run */
    size_t reached;       /* node N - reached is the last that was asked */
    fvi_kernel_impulse initial_impulse; /* of a past that pulls; the pull is linear in A */
    int has_initial_impulses;
    double unit;          /* h^(1 + e) of a past that pulls, else 0 */
    double *start, *push; /* J_p, of the first node; the momentum there */
    double *J, *slope;    /* J_k; the force of node k */
    double *before;       /* that of the node before, at first 2 J_N / h */
    double *pull,
        *pull_rate;       /* impulses of the past times lambda; slope by e */
    double *right;        /* lambda_{k+1} */
    double *CJ;           /* C J_p */
    double *sum, *moment; /* sum_k J_k, sum_k t_k J_k */
    double *M, *M_moment; /* sum_k M_k, sum_k (t_k + (1 - kappa) h) M_k */
    double *block;        /* all these; owned */
    fvi_adjoint_factors factors;
    fvi_adjoint_constant constant;
} adjoint_run;

/* What the stepper asks for: J_k / h is there, and with two limits at each node that of the
 * one before, too. */
static int slope_now(double t, size_t d, void *params, double *F)
{
    const adjoint_run *m = params;
    const int now = m->paper_convention || t / m->run->h > (double)m->reached - 0.5;
    memcpy(F, now ? m->slope : m->before, d * sizeof *F);
    return 0;
}

/* p -= share C x. */
static int apply_damping(const fvi_system *system, double share, const double *x,
                double *p)
{
    const fvi_matrices *C = system->matrices;
    if (C->remembered == 0)
        return FVI_SUCCESS;
    double *z = calloc(2 * C->remembered, sizeof *z);
    if (!z)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    int status = C->remember(system->d, x, z + C->remembered, C->params, z);
    if (!status)
        status = C->damp(system->d, share, z, C->params, p);
    free(z);
    return status;
}

/* J_k, what it gives to the sums, and the force of the node. */
static int evaluate_slopes(adjoint_run *m, const fvi_objective *objective, size_t k,
               const double *x, const double *p, double *Jp)
{
    const size_t d = m->run->system->d;
    const double h = m->run->h, t = (double)k * h;
    m->reached = m->run->steps - k;
    for (size_t i = 0; i < d; i++)
        m->before[i] = m->reached == 1 ? 2 * m->slope[i] : m->slope[i];
    memset(m->J, 0, d * sizeof *m->J);
    double held = 0;
    int status = objective->slopes(k, d, x, p, objective->params, m->J, Jp);
    if (!status && Jp)
        status = apply_damping(m->run->system, -1, Jp, m->CJ);
    if (!status)
        status = fvi_adjoint_constant_next(&m->constant, &held);
    for (size_t i = 0; i < d; i++) {
        m->slope[i] = (m->J[i] - held * m->CJ[i]) / h; /* (23.23) */
        m->sum[i] += m->J[i];
        m->moment[i] += t * m->J[i];
    }
    return status;
}

/* lambda at one end of a step, which has this share in M_k and meets it at time t. */
static void accumulate_end(adjoint_run *m, const double *lambda, double share, double t,
                 double impulse, double rate)
{
    for (size_t i = 0; i < m->run->system->d; i++) {
        m->M[i] += share * lambda[i];
        m->M_moment[i] += t * share * lambda[i];
        m->pull[i] += impulse * lambda[i];
        m->pull_rate[i] += rate * lambda[i];
    }
}

/* From node k + 1 to node k: M_k and the derivative by F_{k+1} on the way. */
static int step(adjoint_run *m, fvi_stepper *s, size_t k, const double *rows,
                double *force)
{
    const fvi_run *run = m->run;
    const size_t d = run->system->d;
    const double h = run->h, after = 1 - m->kappa, t = ((double)k + after) * h;
    double at[2] = { 0, 0 }, slope[2] = { 0, 0 };
    if (m->has_initial_impulses)
        fvi_kernel_impulses(&m->initial_impulse, k, at);
    if (m->has_initial_impulses && m->factors.want.alpha)
        fvi_kernel_impulses_by_order(&m->initial_impulse, k, slope);
    memcpy(m->right, s->x, d * sizeof *m->right);
    accumulate_end(m, s->x, after, t, at[1], slope[1]);
    const double share = m->paper_convention || k + 1 < run->steps ? h : h / 2;
    for (size_t i = 0; force && i < d; i++)
        force[(k + 1) * d + i] = share * s->x[i];
    const int status = fvi_stepper_step(s);
    accumulate_end(m, s->x, m->kappa, t, at[0], slope[0]);
    return status
               ? status
               : fvi_adjoint_factors_step(&m->factors, k, rows, m->right, s->x);
}

//> matrices
/* By x0, from what it leaves alone: x + const changes K x only, and where A of (19.3) is x0
 * the pull. By Algorithm 3 Riemann-Liouville's memory knows x0 itself, and the derivative is
 * what arrives; lambda_0 is no part of N_0. (23.6) */
static int by_start(adjoint_run *m, const fvi_stepper *s, double *by_x)
{
    const fvi_run *run = m->run;
    const int whole = run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && !run->law;
    int status = fvi_potential_gradient(run->system, m->M, by_x);
    for (size_t i = 0; i < run->system->d; i++)
        by_x[i] = m->sum[i] - run->h * by_x[i];
    if (!status && whole && m->has_initial_impulses && run->alpha < 0.5)
        status = apply_damping(run->system, m->unit, m->pull, by_x);
    if (status || !whole || !m->paper_convention)
        return status;
    memcpy(by_x, s->p, run->system->d * sizeof *by_x);
    return apply_damping(run->system, -pow(run->h, 1 - 2 * run->alpha), s->x, by_x);
}

/* By p0: lambda_0, but where the memory knows the line x + t M^-1 p. That changes K x only,
 * and by (13.7) what the past pulls. */
static int by_momentum(adjoint_run *m, const fvi_stepper *s, double *by_p)
{
    const fvi_run *run = m->run;
    const size_t d = run->system->d;
    memcpy(by_p, s->x, d * sizeof *by_p);
    if (run->law || run->alpha <= 0.5
        || (m->paper_convention && run->past != FVI_INITIAL_HISTORY_CAPUTO))
        return FVI_SUCCESS;
    int status = fvi_potential_gradient(run->system, m->M_moment, m->slope);
    for (size_t i = 0; i < d; i++)
        m->slope[i] = m->moment[i] - run->h * m->slope[i];
    if (!status && m->has_initial_impulses)
        status = apply_damping(run->system, m->unit, m->pull, m->slope);
    if (!status)
        status = fvi_damping_velocity(run->system, m->slope, by_p);
    for (size_t i = 0; i < d; i++)
        by_p[i] += m->start[i];
    return status;
}
//< matrices

static int end(adjoint_run *m, const fvi_stepper *s, const fvi_sensitivities *want)
{
    const fvi_run *run = m->run;
    const fvi_system *system = run->system;
    const size_t d = system->d;
    double *by_x = m->push, *by_p = m->J;
    int status = by_start(m, s, by_x);
    if (!status)
        status = by_momentum(m, s, by_p);
    for (size_t i = 0; i < d; i++)
        m->right[i] = by_p[i] - s->x[i];
    if (!status)
        status = fvi_adjoint_factors_end(&m->factors, m->right, m->unit, m->pull,
                                        m->pull_rate);
    if (!status && !(fvi_all_finite(d, by_x) && fvi_all_finite(d, by_p)))
        status = FVI_EOVRFLW;
    for (size_t i = 0; i < d; i++) {
        const int has = run->law || m->paper_convention
                        || fvi_initial_history_solvable(run->past, run->alpha,
                                                 system->damping[i], 1);
        if (want->x0)
            want->x0[i] = has ? by_x[i] : NAN; /* (19.2) */
        if (want->p0)
            want->p0[i] = by_p[i];
    }
    return status;
}

static int walk(adjoint_run *m, const fvi_method *method, fvi_checkpointing *path,
                const fvi_objective *objective, const fvi_sensitivities *want,
                const fvi_run *back)
{
    const size_t d = m->run->system->d;
    fvi_stepper *s;
    int status = fvi_stepper_start(method, back, &s);
    if (status)
        return status;
    for (size_t k = m->run->steps; !status && k-- > 0;) {
        const double *rows;
        status = fvi_checkpointing_step(path, k, &rows);
        if (!status)
            status = evaluate_slopes(m, objective, k, rows, NULL, NULL);
        if (!status)
            status = step(m, s, k, rows, want->force);
    }
    if (!status)
        status = end(m, s, want);
    for (size_t i = 0; want->force && i < d; i++) /* half of F_0, or none */
        want->force[i] = m->paper_convention ? 0 : m->run->h / 2 * s->x[i];
    fvi_stepper_free(s);
    return status;
}

/* The last node: where the mirrored run begins, and with which momentum. */
static int begin(adjoint_run *m, fvi_checkpointing *path, const fvi_objective *objective)
{
    const fvi_run *run = m->run;
    const size_t d = run->system->d;
    const double *rows;
    int status = fvi_checkpointing_step(path, run->steps - 1, &rows);
    if (!status)
        status = evaluate_slopes(m, objective, run->steps, rows + d,
                     fvi_checkpointing_momentum(path), m->start);
    for (size_t i = 0; i < d; i++) /* else a force of the first half step */
        m->push[i] = m->paper_convention ? run->h * m->slope[i] : 0;
    return status;
}

int fvi_adjoint_matrices(const fvi_method *method, const fvi_run *run,
                        fvi_checkpointing *path, const fvi_objective *objective,
                        const fvi_sensitivities *want)
{
    static const double ends[] = { 0, 1 };
    const size_t d = run->system->d;
    adjoint_run m = { .run = run,
                 .paper_convention = method->scheme == FVI_SCHEME_FVI,
                 .kappa = method->takes_kappa ? run->kappa : 0.5 };
    double **each[ARRAYS] = { &m.start,  &m.push,   &m.J,         &m.slope,
                              &m.sum,    &m.moment, &m.M,         &m.M_moment,
                              &m.before, &m.pull,   &m.pull_rate, &m.right,
                              &m.CJ };
    m.has_initial_impulses =
        !m.paper_convention && !run->law && fvi_initial_history_acts(run->past, run->alpha);
    if (m.has_initial_impulses) {
        fvi_kernel_impulse_prepare(run->alpha, 2, ends, &m.initial_impulse);
        m.unit = pow(run->h, 1 + m.initial_impulse.e);
    }
    m.block = calloc(ARRAYS * d, sizeof *m.block);
    if (!m.block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    for (size_t i = 0; i < ARRAYS; i++)
        *each[i] = m.block + i * d;
    fvi_system system = *run->system;
    system.force = (fvi_force){ .value = slope_now, .params = &m };
    fvi_run back = *run;
    back.system = &system;
    back.x0 = m.start;
    back.p0 = m.push;
    back.kappa = 1 - m.kappa;
    back.past = FVI_INITIAL_HISTORY_HELD;
    int status = fvi_adjoint_factors_start(method, run, want, &m.factors);
    if (!status)
        status = fvi_adjoint_constant_start(method, run, &m.constant);
    if (!status)
        status = begin(&m, path, objective);
    if (!status)
        status = walk(&m, method, path, objective, want, &back);
    fvi_adjoint_factors_stop(&m.factors);
    fvi_adjoint_constant_stop(&m.constant);
    free(m.block);
    return status;
}
