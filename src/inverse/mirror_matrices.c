/* src/inverse/mirror_matrices.c -- The run that goes backwards, with matrices.
 *                                                                     [Chapter 23]
 * K is constant, so that (23.2) can be taken at its word: the mirrored run is a run, by the
 * same stepper, of the same M, C and K, with 1 - kappa and Riemann-Liouville's past. By
 * Algorithm 3 it begins at J_p, with J_N less the kick of chapter 9, and the slopes of J are
 * its forces. By (13.7), whose past is that only from rest at 0, it begins there, and J_N is
 * a force as well; p_N, of which (23.7) has another share, is not for these. */
#include "mirror_matrices.h"

#include <fvi/fvi.h>
#include "methods/damping.h"
#include "mirror_factors.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ARRAYS = 12 };

/* d numbers each. */
typedef struct {
    const fvi_run *run;
    int printed;          /* Algorithm 3 */
    double kappa;         /* of the method, or of the run */
    size_t reached;       /* node N - reached is the last that was asked */
    fvi_past_pull fading; /* of a past that pulls; the pull is linear in v0 */
    int is_pulled;
    double *start, *push; /* J_p, of the first node; J_N less the kick */
    double *J, *slope;    /* J_k; J_k / h, the force */
    double *before;       /* that of the node before, at first 2 J_N / h */
    double *pull,
        *pull_rate;       /* impulses of the past times lambda; slope by e */
    double *right;        /* lambda_{k+1} */
    double *sum, *moment; /* sum_k J_k, sum_k t_k J_k */
    double *M, *M_moment; /* sum_k M_k, sum_k (t_k + (1 - kappa) h) M_k */
    double *block;        /* all these; owned */
    fvi_mirror_factors factors;
} mirror;

/* What the stepper asks for: J_k / h is there, and with two limits at each node that of the
 * one before, too. */
static int slope_now(double t, size_t d, void *params, double *F)
{
    const mirror *m = params;
    const int now = m->printed || t / m->run->h > (double)m->reached - 0.5;
    memcpy(F, now ? m->slope : m->before, d * sizeof *F);
    return 0;
}

/* J_k, and what it gives to the sums. */
static int ask(mirror *m, const fvi_objective *objective, size_t k,
               const double *x, const double *p, double *Jp)
{
    const size_t d = m->run->system->d;
    const double h = m->run->h, t = (double)k * h;
    m->reached = m->run->steps - k;
    for (size_t i = 0; i < d; i++)
        m->before[i] = m->reached == 1 ? 2 * m->slope[i] : m->slope[i];
    memset(m->J, 0, d * sizeof *m->J);
    const int status =
        objective->slopes(k, d, x, p, objective->params, m->J, Jp);
    for (size_t i = 0; i < d; i++) {
        m->slope[i] = m->J[i] / h;
        m->sum[i] += m->J[i];
        m->moment[i] += t * m->J[i];
    }
    return status;
}

/* p -= share C x. */
static int kick(const fvi_system *system, double share, const double *x,
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

/* lambda at one end of a step, which has this share in M_k and meets it at time t. */
static void meet(mirror *m, const double *lambda, double share, double t,
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
static int step(mirror *m, fvi_stepper *s, size_t k, const double *rows,
                double *force)
{
    static const double nodes[] = { 0, 1 };
    const fvi_run *run = m->run;
    const size_t d = run->system->d;
    const double h = run->h, after = 1 - m->kappa, t = ((double)k + after) * h;
    double at[2] = { 0, 0 }, slope[2] = { 0, 0 };
    if (m->is_pulled)
        fvi_past_impulses(&m->fading, k, at);
    if (m->is_pulled && m->factors.want->alpha)
        fvi_past_impulses_rate(&m->fading, nodes, k, slope);
    memcpy(m->right, s->x, d * sizeof *m->right);
    meet(m, s->x, after, t, at[1], slope[1]);
    for (size_t i = 0; force && i < d; i++)
        force[(k + 1) * d + i] = h * s->x[i];
    const int status = fvi_step(s);
    meet(m, s->x, m->kappa, t, at[0], slope[0]);
    return status
               ? status
               : fvi_mirror_factors_step(&m->factors, k, rows, m->right, s->x);
}

//> matrices
/* The derivatives by x0 and p0 from what they leave alone. The past held, or Caputo's:
 * x + const changes K x only, and x + t M^-1 p, Caputo's with alpha > 1/2, too; by (13.7)
 * and held that changes the pull of the past besides. Else lambda_0 is that by p0, and Riemann-Liouville's by x0 what arrives, of which lambda_0
 * itself is no part of N_0. (23.6) */
static int end(mirror *m, const fvi_stepper *s, const fvi_gradients *want)
{
    const fvi_run *run = m->run;
    const fvi_system *system = run->system;
    const size_t d = system->d;
    const int line =
        run->alpha > 0.5 && (run->past == FVI_PAST_CAPUTO || !m->printed);
    double *by_x = m->push, *by_p = m->J;
    int status = fvi_gradient(system, m->M, by_x);
    for (size_t i = 0; i < d; i++)
        by_x[i] = m->sum[i] - run->h * by_x[i];
    if (!status && run->past == FVI_PAST_RIEMANN_LIOUVILLE) {
        memcpy(by_x, s->p, d * sizeof *by_x);
        status = kick(system, -pow(run->h, 1 - 2 * run->alpha), s->x, by_x);
    }
    memcpy(by_p, s->x, d * sizeof *by_p);
    if (!status && line) {
        status = fvi_gradient(system, m->M_moment, m->slope);
        for (size_t i = 0; i < d; i++)
            m->slope[i] = m->moment[i] - run->h * m->slope[i];
        if (!status && m->is_pulled)
            status =
                kick(system, pow(run->h, 1 + m->fading.e), m->pull, m->slope);
        if (!status)
            status = fvi_damping_velocity(system, m->slope, by_p);
        for (size_t i = 0; i < d; i++)
            by_p[i] += m->start[i];
    }
    if (want->x0)
        memcpy(want->x0, by_x, d * sizeof *by_x);
    if (want->p0)
        memcpy(want->p0, by_p, d * sizeof *by_p);
    for (size_t i = 0; i < d; i++)
        m->right[i] = by_p[i] - s->x[i];
    if (!status)
        status = fvi_mirror_factors_end(
            &m->factors, m->right,
            m->is_pulled ? pow(run->h, 1 + m->fading.e) : 0, m->pull,
            m->pull_rate);
    return status || (fvi_all_finite(d, by_x) && fvi_all_finite(d, by_p))
               ? status
               : FVI_EOVRFLW;
}
//< matrices

static int walk(mirror *m, const fvi_method *method, fvi_backward *path,
                const fvi_objective *objective, const fvi_gradients *want,
                const fvi_run *back)
{
    const size_t d = m->run->system->d;
    fvi_stepper *s;
    int status = fvi_start(method, back, &s);
    if (status)
        return status;
    for (size_t k = m->run->steps; !status && k-- > 0;) {
        const double *rows;
        status = fvi_backward_step(path, k, &rows);
        if (!status)
            status = ask(m, objective, k, rows, NULL, NULL);
        if (!status)
            status = step(m, s, k, rows, want->force);
    }
    if (!status)
        status = end(m, s, want);
    for (size_t i = 0; want->force && i < d; i++) /* half of F_0, or none */
        want->force[i] = m->printed ? 0 : m->run->h / 2 * s->x[i];
    fvi_stop(s);
    return status;
}

/* The last node: where the mirrored run begins, and with which momentum. */
static int begin(mirror *m, fvi_backward *path, const fvi_objective *objective)
{
    const fvi_run *run = m->run;
    const size_t d = run->system->d;
    const double *rows;
    int status = fvi_backward_step(path, run->steps - 1, &rows);
    if (!status)
        status = ask(m, objective, run->steps, rows + d,
                     fvi_backward_momentum(path), m->start);
    memcpy(m->push, m->J, d * sizeof *m->push);
    for (size_t i = 0; !status && !m->printed && i < d; i++) {
        m->push[i] = 0;
        if (m->start[i] != 0)
            FVI_FAIL("with matrices this method has no adjoint of p",
                     FVI_EUNSUP);
    }
    return status || !m->printed
               ? status
               : kick(run->system, pow(run->h, 1 - 2 * run->alpha), m->start,
                      m->push);
}

int fvi_mirror_matrices(const fvi_method *method, const fvi_run *run,
                        fvi_backward *path, const fvi_objective *objective,
                        const fvi_gradients *want)
{
    static const double ends[] = { 0, 1 };
    const size_t d = run->system->d;
    mirror m = { .run = run,
                 .printed = method->scheme == FVI_SCHEME_ALGORITHM_3,
                 .kappa = method->takes_kappa ? run->kappa : 0.5 };
    double **each[ARRAYS] = { &m.start,  &m.push,   &m.J,         &m.slope,
                              &m.sum,    &m.moment, &m.M,         &m.M_moment,
                              &m.before, &m.pull,   &m.pull_rate, &m.right };
    m.is_pulled = !m.printed && fvi_past_pulls(run->past, run->alpha);
    if (m.is_pulled)
        fvi_past_prepare(run->alpha, 2, ends, &m.fading);
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
    back.past = m.printed ? FVI_PAST_RIEMANN_LIOUVILLE : FVI_PAST_CAPUTO;
    int status = fvi_mirror_factors_start(method, run, want, &m.factors);
    if (!status)
        status = begin(&m, path, objective);
    if (!status)
        status = walk(&m, method, path, objective, want, &back);
    fvi_mirror_factors_stop(&m.factors);
    free(m.block);
    return status;
}
