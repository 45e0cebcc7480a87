/* src/sensitivity/adjoint_multistep.c -- The run that goes backwards.                 [H 23] */
#include "adjoint_multistep.h"

#include "methods/damping.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

enum { ARRAYS = 24 };

static int allocate(fvi_adjoint_multistep *m)
{
    const size_t d = m->d;
    const fvi_potential *u = &m->run->system->potential;
    double **each[ARRAYS] = { &m->c,      &m->lambda,  &m->delta,   &m->q,
                              &m->nu,     &m->dnu,     &m->N,       &m->Ndot,
                              &m->M,      &m->S,       &m->work,    &m->sum,
                              &m->rate,   &m->plain,   &m->linear,  &m->kinetic,
                              &m->pull,   &m->shift,   &m->impulse_sum_by_order, &m->before,
                              &m->column, &m->inertia, &m->origin,  &m->drift };
    double *block = calloc(ARRAYS * d, sizeof *block);
    if (!block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    for (size_t i = 0; i < ARRAYS; i++)
        *each[i] = block + i * d;
    m->block = block;
    if (u->hessian)
        m->G = malloc(fvi_potential_hessian_size(m->run->system) * sizeof *m->G);
    if (u->hessian && !m->G)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    if (u->hessian && u->diagonals != 1
        && fvi_band_alloc(d, (u->diagonals ? u->diagonals : d) - 1, &m->J))
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* That of the law, and those of each term if its derivatives are asked for. */
static int start_law(fvi_adjoint_multistep *m, fvi_delta kind)
{
    const fvi_run *run = m->run;
    double first = 0;
    int status =
        fvi_kernel_history(run->law, kind, run->h, m->d, run->steps, run->memory,
                       run->tolerance, &first, &m->memory);
    m->unit = run->h * first;
    if (status || !fvi_adjoint_kernel_is_wanted(m->want))
        return status;
    m->each = calloc(run->law->count, sizeof *m->each);
    if (!m->each)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    for (; !status && m->terms < run->law->count; m->terms++)
        status = fvi_adjoint_term_start(run, m->want, kind, m->terms, m->d,
                                       &m->each[m->terms]);
    return status;
}

/* The memory of the run, with its rates only if alpha is asked for. All coordinates
 * are remembered, even those whose damping is zero: their derivatives are not. */
static int start_memories(fvi_adjoint_multistep *m, const fvi_method *method)
{
    const fvi_run *run = m->run;
    int is_damped = m->want->damping != NULL;
    for (size_t i = 0; i < m->d; i++)
        is_damped |= run->system->damping[i] > 0;
    if (!is_damped)
        return FVI_SUCCESS;
    if (run->law)
        return start_law(m, fvi_damping_quadrature(method));
    const double beta = 2 * run->alpha;
    int status = (m->want->alpha ? fvi_history_alloc_by_order : fvi_history_alloc)(
        beta, m->d, run->steps, run->memory, run->tolerance, &m->memory);
    if (!status && m->want->alpha && method->scheme == FVI_SCHEME_CQ2_SHIFTED)
        status = fvi_history_alloc(beta, m->d, run->steps, run->memory,
                                  run->tolerance, &m->slope);
    return status;
}

/* g = ((3 - z)/2)^beta by powers of z, and g ln((3 - z)/2). */
static size_t factor_bdf2(double beta, double *g, double *gdot)
{
    double power = 1, l[FVI_BDF2_TAPS] = { log(1.5) };
    fvi_cq_bdf2_factor(beta, g);
    for (size_t n = 1; n < FVI_BDF2_TAPS; n++)
        l[n] = -(power /= 3) / (double)n;
    for (size_t n = 0; n < FVI_BDF2_TAPS; n++)
        for (size_t j = 0; j <= n; j++)
            gdot[n] += l[j] * g[n - j];
    return FVI_BDF2_TAPS;
}

size_t fvi_adjoint_factor(fvi_scheme scheme, double alpha, double *g,
                         double *gdot)
{
    if (scheme == FVI_SCHEME_CQ_BDF2)
        return factor_bdf2(2 * alpha, g, gdot);
    g[0] = 1;
    if (scheme != FVI_SCHEME_CQ2_MIDPOINT)
        return 1;
    g[0] = 0.5 + alpha; /* (13.16) */
    g[1] = 0.5 - alpha;
    gdot[0] = 0.5;
    gdot[1] = -0.5;
    return 2;
}

static int start_factor(fvi_adjoint_multistep *m, fvi_scheme scheme)
{
    if (scheme != FVI_SCHEME_CQ2_MIDPOINT
        && (scheme != FVI_SCHEME_CQ_BDF2 || m->run->law))
        return FVI_SUCCESS;
    m->taps = fvi_adjoint_factor(scheme, m->run->law ? 0 : m->run->alpha, m->g,
                                m->gdot); /* (26.15) */
    m->sums = calloc(2 * FVI_BDF2_TAPS * m->d, sizeof *m->sums);
    if (!m->sums)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    m->rates = m->sums + FVI_BDF2_TAPS * m->d;
    return FVI_SUCCESS;
}

/* Does the memory know p0/m? */
static int drifts(const fvi_adjoint_multistep *m)
{
    return !m->run->law && 2 * m->run->alpha > 1
           && (!m->paper_convention || m->run->past == FVI_INITIAL_HISTORY_CAPUTO);
}

/* z_j = x_j - origin - j drift, on which the memory of the run acts, and c. */
static void start_terms(fvi_adjoint_multistep *m)
{
    const fvi_run *run = m->run;
    const int whole = m->paper_convention && run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    for (size_t i = 0; i < m->d; i++) {
        const double mass = run->system->mass[i];
        m->c[i] = run->system->damping[i] * m->unit;
        m->inertia[i] =
            mass / run->h + m->theta * m->c[i] * (m->taps ? m->g[0] : 1);
        m->origin[i] = whole ? 0 : run->x0[i];
        m->drift[i] = drifts(m) ? run->h * run->p0[i] / mass : 0;
    }
}

int fvi_adjoint_multistep_start(const fvi_method *method, const fvi_run *run,
                     const fvi_sensitivities *want, const double *Jp, fvi_adjoint_multistep *m)
{
    static const double ends[] = { 0, 1 };
    const fvi_scheme scheme = method->scheme;
    const int paper_convention = scheme == FVI_SCHEME_FVI,
              stable = scheme == FVI_SCHEME_CQ2_MIDPOINT;
    *m = (fvi_adjoint_multistep){ .run = run,
                       .want = want,
                       .d = run->system->d,
                       .theta = scheme == FVI_SCHEME_CQ2_SHIFTED ? run->alpha
                                : stable                     ? 0.5
                                                             : 0,
                       .kappa = stable ? 0.5 : run->kappa,
                       .end = paper_convention ? 1 : 0.5,
                       .unit =
                           run->law ? run->h : pow(run->h, 1 - 2 * run->alpha),
                       .paper_convention = paper_convention };
    int status = allocate(m);
    if (!status)
        status = start_memories(m, method);
    if (!status)
        status = start_factor(m, scheme);
    if (status)
        return status;
    const fvi_potential *u = &run->system->potential;
    m->is_quadratic = u->quadratic && u->quadratic(u->params);
    start_terms(m);
    memcpy(m->lambda, Jp, m->d * sizeof *Jp);
    m->has_initial_impulses = !paper_convention && m->memory && !run->law
                   && fvi_initial_history_acts(run->past, run->alpha);
    if (m->has_initial_impulses)
        fvi_kernel_impulse_prepare(run->alpha, 2, ends, &m->initial_impulse);
    return FVI_SUCCESS;
}

void fvi_adjoint_multistep_free(fvi_adjoint_multistep *m)
{
    fvi_history_free(m->memory);
    fvi_history_free(m->slope);
    for (size_t i = 0; i < m->terms; i++)
        fvi_adjoint_term_stop(&m->each[i]);
    free(m->each);
    fvi_band_free(&m->J);
    free(m->block);
    free(m->sums);
    free(m->G);
}

/* ---- the end ---- */

/* The damping of coordinate i: what of its derivatives the memory and the pull give. */
static void end_damping(const fvi_adjoint_multistep *m, size_t i)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const double rho = run->system->damping[i], mass = run->system->mass[i];
    const double h = run->h, v0 = run->p0[i] / mass;
    if (want->damping)
        want->damping[i] = -m->unit * m->sum[i];
    if (want->alpha)
        *want->alpha -= 2 * rho * m->unit * (m->rate[i] - log(h) * m->sum[i])
                        + m->c[i] * m->shift[i];
    if (drifts(m)) {
        const double slope = m->c[i] * h * m->linear[i] / mass;
        if (want->p0)
            want->p0[i] += slope;
        if (want->mass)
            want->mass[i] -= slope * v0;
    }
    if (want->x0 && !(m->paper_convention && run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE))
        want->x0[i] += m->c[i] * m->plain[i]; /* the origin */
}

/* J has the impulses -rho A h^(1 + e) at[] of the past, times lambda; A is v0, or x0 of
 * Riemann-Liouville's past with alpha < 1/2. */
static void end_pull(const fvi_adjoint_multistep *m, size_t i)
{
    const fvi_run *run = m->run;
    const fvi_sensitivities *want = m->want;
    const double rho = run->system->damping[i], mass = run->system->mass[i];
    const double v0 = run->p0[i] / mass, log_h = log(run->h);
    const double A = fvi_initial_history_amplitude(run->past, run->alpha, run->x0[i], v0);
    const double unit = pow(run->h, 1 + m->initial_impulse.e),
                 slope = -rho * unit * m->pull[i]; /* by A */
    if (want->damping)
        want->damping[i] -= A * unit * m->pull[i];
    if (want->alpha) /* de = -2 dalpha */
        *want->alpha +=
            2 * rho * A * unit * (log_h * m->pull[i] + m->impulse_sum_by_order[i]);
    if (run->alpha < 0.5) {
        if (want->x0)
            want->x0[i] += slope;
        return;
    }
    if (want->p0)
        want->p0[i] += slope / mass;
    if (want->mass)
        want->mass[i] -= slope * v0 / mass;
    if (want->x0 && rho > 0 && run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
        want->x0[i] = NAN; /* (19.2): no run begins elsewhere */
}

//> end
int fvi_adjoint_multistep_end(fvi_adjoint_multistep *m, const double *Jx)
{
    const fvi_sensitivities *want = m->want;
    const int whole = m->paper_convention && m->run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    int status = m->memory ? fvi_adjoint_last(m) : FVI_SUCCESS;
    for (size_t i = 0; i < m->d; i++) {
        m->q[i] += Jx[i] - (whole ? m->c[i] * m->N[i] : 0); /* (23.6) */
        if (want->x0)
            want->x0[i] = m->q[i];
        if (want->p0)
            want->p0[i] = m->lambda[i];
        if (want->mass)
            want->mass[i] = m->kinetic[i] / m->run->h;
        if (m->memory)
            end_damping(m, i);
        if (m->has_initial_impulses)
            end_pull(m, i);
    }
    return status || fvi_all_finite(m->d, m->q) ? status : FVI_EOVRFLW;
}
//< end
