/* src/sensitivity/adjoint_factors.c -- Derivatives by factors of M, C and K. [H 23] */
#include "adjoint_factors.h"

#include "methods/damping.h"
#include "adjoint_multistep.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double dot(size_t d, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += a[i] * b[i];
    return sum;
}

/* x^T S z, of C = S B^T. */
static int damping_product(fvi_adjoint_factors *f, const double *x, const double *z,
                  double *value)
{
    const fvi_matrices *m = f->run->system->matrices;
    memset(f->work, 0, f->d * sizeof *f->work);
    const int status = m->damp(f->d, -1, z, m->params, f->work);
    *value = dot(f->d, x, f->work);
    return status;
}

/* ---- the start ---- */

static int make_room(fvi_adjoint_factors *f)
{
    double **longs[] = { &f->v0, &f->z,    &f->work,   &f->room,
                         &f->nu, &f->tilt, &f->behind, &f->change };
    double **shorts[] = { &f->N,          &f->dN,
                          &f->sum.in,     &f->sum.change,
                          &f->sum.out,    &f->sum.rate,
                          &f->tilted.in,  &f->tilted.change,
                          &f->tilted.out, &f->tilted.rate };
    enum { LONG = sizeof longs / sizeof *longs };
    enum { SHORT = sizeof shorts / sizeof *shorts };
    const size_t rows = SHORT + 2 * FVI_BDF2_TAPS;
    f->block = calloc(LONG * f->d + rows * f->r, sizeof *f->block);
    if (!f->block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    double *next = f->block;
    for (size_t i = 0; i < LONG; i++, next += f->d)
        *longs[i] = next;
    for (size_t i = 0; i < SHORT; i++, next += f->r)
        *shorts[i] = next;
    f->past = next;
    f->past_rate = next + FVI_BDF2_TAPS * f->r;
    return FVI_SUCCESS;
}

/* The memory of B^T nu, and, where theta is alpha, of its derivative. */
static int start_power(fvi_adjoint_factors *f, fvi_scheme scheme)
{
    const fvi_run *run = f->run;
    const double beta = 2 * run->alpha;
    f->taps = fvi_adjoint_factor(scheme, run->alpha, f->g, f->dg);
    int status = (f->want.alpha ? fvi_history_alloc_by_order : fvi_history_alloc)(
        beta, f->r, run->steps, run->memory, run->tolerance, &f->sum.memory);
    if (!status && f->want.alpha && scheme == FVI_SCHEME_CQ2_SHIFTED)
        status = fvi_history_alloc(beta, f->r, run->steps, run->memory,
                                  run->tolerance, &f->tilted.memory);
    return status;
}

/* Those of the terms of a law, of nu; C is taken to z. By the factor of C as by all terms. */
static int start_law(fvi_adjoint_factors *f, const fvi_method *method)
{
    const fvi_run *run = f->run;
    const size_t count = run->law->count;
    int status = FVI_SUCCESS;
    f->each = calloc(count, sizeof *f->each);
    f->by_terms = calloc(count, sizeof *f->by_terms);
    if (!f->each || !f->by_terms)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    f->taps = method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 2 : 1; /* (26.15) */
    if (!f->want.terms)
        f->want.terms = f->by_terms;
    for (; !status && f->terms < count; f->terms++)
        status =
            fvi_adjoint_term_start(run, &f->want, fvi_damping_quadrature(method),
                                  f->terms, f->d, &f->each[f->terms]);
    return status;
}

int fvi_adjoint_factors_start(const fvi_method *method, const fvi_run *run,
                             const fvi_sensitivities *want, fvi_adjoint_factors *f)
{
    const fvi_system *system = run->system;
    const fvi_scheme scheme = method->scheme;
    const int paper_convention = scheme == FVI_SCHEME_FVI;
    *f =
        (fvi_adjoint_factors){ .run = run,
                              .want = *want,
                              .d = system->d,
                              .r = system->matrices->remembered,
                              .kappa = method->takes_kappa ? run->kappa : 0.5,
                              .theta = scheme == FVI_SCHEME_CQ2_SHIFTED ? run->alpha
                                       : scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5
                                                                     : 0,
                              .paper_convention = paper_convention };
    f->has_drift = !run->law && run->alpha > 0.5
                   && (run->past == FVI_INITIAL_HISTORY_CAPUTO || !paper_convention);
    if (want->mass && !system->matrices->inertia)
        FVI_FAIL("no derivative by a factor of M without its products",
                 FVI_EUNSUP);
    int status = make_room(f);
    if (!status && f->has_drift)
        status = fvi_damping_velocity(system, run->p0, f->v0);
    if (status || f->r == 0)
        return status;
    if (run->law)
        return want->damping || fvi_adjoint_kernel_is_wanted(want) ? start_law(f, method)
                                                          : status;
    return want->damping || want->alpha ? start_power(f, scheme) : status;
}

void fvi_adjoint_factors_stop(fvi_adjoint_factors *f)
{
    fvi_history_free(f->sum.memory);
    fvi_history_free(f->tilted.memory);
    for (size_t l = 0; l < f->terms; l++)
        fvi_adjoint_term_stop(&f->each[l]);
    free(f->each);
    free(f->by_terms);
    free(f->block);
}

/* ---- a step ---- */

/* z_j, on which the memory of the run acts. */
static void find_term(fvi_adjoint_factors *f, size_t j, const double *x)
{
    const fvi_run *run = f->run;
    const double t = (double)j * run->h;
    const int whole =
        f->paper_convention && !run->law && run->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    for (size_t i = 0; i < f->d; i++)
        f->z[i] =
            x[i] - (whole ? 0 : run->x0[i]) - (f->has_drift ? t * f->v0[i] : 0);
}

/* (23.7), and by theta where that is alpha. */
static void find_nu(fvi_adjoint_factors *f, size_t j, const double *right,
                    const double *left)
{
    const int last = j == f->run->steps;
    const double theta = f->theta, share = f->paper_convention ? 1
                                           : last     ? 0.5
                                                      : 1 - theta;
    for (size_t i = 0; i < f->d; i++) {
        f->nu[i] = share * right[i] + theta * left[i];
        f->tilt[i] = left[i] - (last ? 0 : right[i]);
    }
}

/* B^T of the d numbers v into a memory. */
static int push(fvi_adjoint_factors *f, fvi_adjoint_sum *s, const double *v)
{
    const fvi_matrices *m = f->run->system->matrices;
    int status = m->remember(f->d, v, s->in, m->params, s->change);
    for (size_t i = 0; i < f->r; i++)
        s->in[i] += s->change[i];
    if (status)
        return status;
    return s == &f->sum && f->want.alpha
               ? fvi_history_push_by_order(s->memory, s->in, s->change, s->out,
                                      s->rate)
               : fvi_history_push(s->memory, s->in, s->change, s->out);
}

/* The sums of the memory become N_j and its derivative by alpha. */
static void filter(fvi_adjoint_factors *f)
{
    const size_t r = f->r, bytes = r * sizeof *f->N;
    f->place = (f->place + FVI_BDF2_TAPS - 1) % FVI_BDF2_TAPS;
    memcpy(f->past + f->place * r, f->sum.out, bytes);
    memcpy(f->past_rate + f->place * r, f->sum.rate, bytes);
    memset(f->N, 0, bytes);
    memcpy(f->dN, f->tilted.out, bytes);
    for (size_t n = 0; n < f->taps; n++) {
        const size_t at = (f->place + n) % FVI_BDF2_TAPS * r;
        for (size_t i = 0; i < r; i++) {
            f->N[i] += f->g[n] * f->past[at + i];
            f->dN[i] += 2 * f->g[n] * f->past_rate[at + i]
                        + 2 * f->dg[n] * f->past[at + i];
        }
    }
}

/* nu_j enters; what z_j and N_j give to the sums of (23.6). */
static int update_history(fvi_adjoint_factors *f)
{
    double by_N = 0, by_dN = 0;
    int status = push(f, &f->sum, f->nu);
    if (!status && f->tilted.memory)
        status = push(f, &f->tilted, f->tilt);
    filter(f);
    if (!status)
        status = damping_product(f, f->z, f->N, &by_N);
    if (!status && f->want.alpha)
        status = damping_product(f, f->z, f->dN, &by_dN);
    f->by_C += by_N;
    f->by_alpha += by_dN - 2 * log(f->run->h) * by_N;
    return status;
}

/* The same by each term of a law, C z being what its sums meet; of fvi-stable nu_j and
 * nu_{j+1} in the mean. */
static int update_history_of_terms(fvi_adjoint_factors *f)
{
    const fvi_matrices *m = f->run->system->matrices;
    for (size_t i = 0; i < f->d; i++) {
        const double now =
            f->taps == 2 ? (f->nu[i] + f->behind[i]) / 2 : f->nu[i];
        f->behind[i] = f->nu[i];
        f->change[i] = now - f->room[i];
        f->room[i] = now;
    }
    memset(f->dN, 0, f->r * sizeof *f->dN);
    memset(f->work, 0, f->d * sizeof *f->work);
    int status = m->remember(f->d, f->z, f->dN, m->params, f->N);
    if (!status)
        status = m->damp(f->d, -f->run->h, f->N, m->params, f->work);
    for (size_t l = 0; !status && l < f->terms; l++)
        status = fvi_adjoint_term_accumulate(&f->each[l], f->room, f->change, f->work,
                                      &f->want, l);
    return status;
}

/* By the factors of M and K; z is room. */
static int accumulate_matrices(fvi_adjoint_factors *f, const double *rows, const double *right,
                const double *left)
{
    const fvi_matrices *m = f->run->system->matrices;
    const double kappa = f->kappa;
    const size_t d = f->d;
    double *v = f->z;
    int status = FVI_SUCCESS;
    if (f->want.mass) {
        for (size_t i = 0; i < d; i++)
            v[i] = right[i] - left[i];
        status = m->inertia(d, v, m->params, f->work);
        for (size_t i = 0; i < d; i++)
            f->by_M += (rows[d + i] - rows[i]) * f->work[i];
    }
    if (f->want.parameters && !status) {
        for (size_t i = 0; i < d; i++)
            v[i] = kappa * left[i] + (1 - kappa) * right[i];
        status = m->stiffness(d, v, m->params, f->work);
        for (size_t i = 0; i < d; i++)
            f->by_K +=
                (kappa * rows[i] + (1 - kappa) * rows[d + i]) * f->work[i];
    }
    return status;
}

int fvi_adjoint_factors_step(fvi_adjoint_factors *f, size_t k, const double *rows,
                            const double *right, const double *left)
{
    const int status = accumulate_matrices(f, rows, right, left);
    if (status || !(f->sum.memory || f->terms))
        return status;
    find_nu(f, k + 1, right, left);
    find_term(f, k + 1, rows + f->d);
    return f->terms ? update_history_of_terms(f) : update_history(f);
}

/* ---- the end ---- */

/* A^T C of the impulses of a past that pulls and of their slopes; A into z. */
static int meet_pull(fvi_adjoint_factors *f, const double *pull,
                     const double *pull_rate, double *at, double *rate)
{
    const fvi_run *run = f->run;
    const fvi_matrices *m = run->system->matrices;
    for (size_t i = 0; i < f->d; i++)
        f->z[i] =
            fvi_initial_history_amplitude(run->past, run->alpha, run->x0[i], f->v0[i]);
    memset(f->N, 0, f->r * sizeof *f->N);
    int status = m->remember(f->d, f->z, f->N, m->params, f->dN);
    if (!status)
        status = damping_product(f, pull, f->dN, at);
    return status ? status : damping_product(f, pull_rate, f->dN, rate);
}

//> factors
int fvi_adjoint_factors_end(fvi_adjoint_factors *f, const double *drag,
                           double unit, const double *pull,
                           const double *pull_rate)
{
    const fvi_run *run = f->run;
    const fvi_sensitivities *want = &f->want;
    const double h = run->h, c = pow(h, 1 - 2 * run->alpha);
    double at = 0, rate = 0;
    int status = FVI_SUCCESS;
    if (f->sum.memory && f->paper_convention) { /* lambda_0 is no part of N_0 */
        memset(f->nu, 0, f->d * sizeof *f->nu);
        find_term(f, 0, run->x0);
        status = update_history(f);
    }
    if (f->sum.memory && unit > 0 && !status)
        status = meet_pull(f, pull, pull_rate, &at, &rate);
    if (want->mass) /* v0 is M^-1 p0 */
        *want->mass = f->by_M / h - dot(f->d, run->p0, drag);
    if (want->damping)
        *want->damping = -c * f->by_C - unit * at;
    for (size_t l = 0; want->damping && l < f->terms; l++)
        *want->damping += run->law->term[l].rho * want->terms[l];
    if (want->alpha) /* e falls by 2 dalpha */
        *want->alpha = -c * f->by_alpha + 2 * unit * (log(h) * at + rate);
    if (want->parameters)
        *want->parameters = -h * f->by_K;
    return status;
}
//< factors
