/* src/inverse/mirror_factors.c -- Derivatives by factors of M, C and K. [Chapter 23] */
#include "mirror_factors.h"

#include "methods/damping.h"
#include "mirror.h"
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
static int across(fvi_mirror_factors *f, const double *x, const double *z,
                  double *value)
{
    const fvi_matrices *m = f->run->system->matrices;
    memset(f->work, 0, f->d * sizeof *f->work);
    const int status = m->damp(f->d, -1, z, m->params, f->work);
    *value = dot(f->d, x, f->work);
    return status;
}

/* ---- the start ---- */

/* (23.7) and the factor of the weights as one polynomial, by powers of the shift to the
 * node after; the sum of lambda_{j-1} stands first. */
static void make_taps(fvi_mirror_factors *f, fvi_scheme scheme)
{
    const double alpha = f->run->alpha;
    const int stable = scheme == FVI_SCHEME_STABLE,
              shifted = scheme == FVI_SCHEME_SHIFTED;
    const double theta = shifted ? alpha : stable ? 0.5 : 0, by = shifted;
    double g[FVI_BDF2_TAPS] = { 0 }, dg[FVI_BDF2_TAPS] = { 0 };
    const size_t count = fvi_mirror_factor(scheme, alpha, g, dg);
    f->taps = count + 1;
    for (size_t n = 0; n < count;
         n++) { /* d/d alpha is twice that by 2 alpha */
        f->f[n] += theta * g[n];
        f->f[n + 1] += (1 - theta) * g[n];
        f->df[n] += by * g[n] + 2 * theta * dg[n];
        f->df[n + 1] += -by * g[n] + 2 * (1 - theta) * dg[n];
    }
}

static int make_room(fvi_mirror_factors *f)
{
    const size_t d = f->d, r = f->r;
    f->block = calloc(3 * d + (4 + 2 * FVI_FACTOR_TAPS) * r, sizeof *f->block);
    if (!f->block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    f->v0 = f->block;
    f->z = f->v0 + d;
    f->work = f->z + d;
    f->entered = f->work + d;
    f->change = f->entered + r;
    f->N = f->change + r;
    f->dN = f->N + r;
    f->sums = f->dN + r;
    f->rates = f->sums + FVI_FACTOR_TAPS * r;
    return FVI_SUCCESS;
}

int fvi_mirror_factors_start(const fvi_method *method, const fvi_run *run,
                             const fvi_gradients *want, fvi_mirror_factors *f)
{
    const fvi_system *system = run->system;
    const int printed = method->scheme == FVI_SCHEME_ALGORITHM_3;
    *f = (fvi_mirror_factors){ .run = run,
                               .want = want,
                               .d = system->d,
                               .r = system->matrices->remembered,
                               .kappa = method->takes_kappa ? run->kappa : 0.5,
                               .is_late = !printed };
    f->has_drift =
        run->alpha > 0.5 && (run->past == FVI_PAST_CAPUTO || !printed);
    if (want->mass && !system->matrices->inertia)
        FVI_FAIL("no derivative by a factor of M without its products",
                 FVI_EUNSUP);
    int status = make_room(f);
    if (!status && f->has_drift)
        status = fvi_damping_velocity(system, run->p0, f->v0);
    if (status || f->r == 0 || (!want->damping && !want->alpha))
        return status;
    make_taps(f, method->scheme);
    return (want->alpha ? fvi_memory_alloc_rate : fvi_memory_alloc)(
        2 * run->alpha, f->r, run->steps, run->memory, run->tolerance,
        &f->memory);
}

void fvi_mirror_factors_stop(fvi_mirror_factors *f)
{
    fvi_memory_free(f->memory);
    free(f->block);
}

/* ---- a step ---- */

/* z_j, on which the memory of the run acts. */
static void find_term(fvi_mirror_factors *f, size_t j, const double *x)
{
    const fvi_run *run = f->run;
    const double t = (double)j * run->h;
    const int whole = !f->is_late && run->past == FVI_PAST_RIEMANN_LIOUVILLE;
    for (size_t i = 0; i < f->d; i++)
        f->z[i] =
            x[i] - (whole ? 0 : run->x0[i]) - (f->has_drift ? t * f->v0[i] : 0);
}

/* The sums of the memory become N_j and its derivative by alpha. */
static void filter(fvi_mirror_factors *f)
{
    const size_t r = f->r;
    memset(f->N, 0, 2 * r * sizeof *f->N); /* dN stands behind it */
    for (size_t n = !f->is_late; n < f->taps; n++) {
        const size_t lag = f->is_late ? n : n - 1;
        const size_t at = (f->place + lag) % FVI_FACTOR_TAPS * r;
        for (size_t i = 0; i < r; i++) {
            f->N[i] += f->f[n] * f->sums[at + i];
            f->dN[i] +=
                2 * f->f[n] * f->rates[at + i] + f->df[n] * f->sums[at + i];
        }
    }
}

/* lambda, NULL for zeros, enters; what z_j and N_j give to the sums of (23.6). */
static int remember(fvi_mirror_factors *f, size_t j, const double *x,
                    const double *lambda)
{
    const fvi_matrices *m = f->run->system->matrices;
    f->place = (f->place + FVI_FACTOR_TAPS - 1) % FVI_FACTOR_TAPS;
    double *sum = f->sums + f->place * f->r, by_N = 0, by_dN = 0;
    for (size_t i = 0; i < f->r; i++)
        f->change[i] = -f->entered[i];
    int status = FVI_SUCCESS;
    if (lambda)
        status = m->remember(f->d, lambda, f->entered, m->params, f->change);
    for (size_t i = 0; i < f->r; i++)
        f->entered[i] = lambda ? f->entered[i] + f->change[i] : 0;
    if (!status)
        status = f->want->alpha
                     ? fvi_memory_push_rate(f->memory, f->entered, f->change,
                                            sum, f->rates + f->place * f->r)
                     : fvi_memory_push(f->memory, f->entered, f->change, sum);
    filter(f);
    find_term(f, j, x);
    if (!status)
        status = across(f, f->z, f->N, &by_N);
    if (!status && f->want->alpha)
        status = across(f, f->z, f->dN, &by_dN);
    f->by_C += by_N;
    f->by_alpha += by_dN - 2 * log(f->run->h) * by_N;
    return status;
}

/* By the factors of M and K; z is room. */
static int meet(fvi_mirror_factors *f, const double *rows, const double *right,
                const double *left)
{
    const fvi_matrices *m = f->run->system->matrices;
    const double kappa = f->kappa;
    const size_t d = f->d;
    double *v = f->z;
    int status = FVI_SUCCESS;
    if (f->want->mass) {
        for (size_t i = 0; i < d; i++)
            v[i] = right[i] - left[i];
        status = m->inertia(d, v, m->params, f->work);
        for (size_t i = 0; i < d; i++)
            f->by_M += (rows[d + i] - rows[i]) * f->work[i];
    }
    if (f->want->parameters && !status) {
        for (size_t i = 0; i < d; i++)
            v[i] = kappa * left[i] + (1 - kappa) * right[i];
        status = m->stiffness(d, v, m->params, f->work);
        for (size_t i = 0; i < d; i++)
            f->by_K +=
                (kappa * rows[i] + (1 - kappa) * rows[d + i]) * f->work[i];
    }
    return status;
}

int fvi_mirror_factors_step(fvi_mirror_factors *f, size_t k, const double *rows,
                            const double *right, const double *left)
{
    const int status = meet(f, rows, right, left);
    return status || !f->memory
               ? status
               : remember(f, k + 1, rows + f->d, f->is_late ? left : right);
}

/* ---- the end ---- */

//> factors
int fvi_mirror_factors_end(fvi_mirror_factors *f, const double *drag,
                           double unit, const double *pull,
                           const double *pull_rate)
{
    const fvi_run *run = f->run;
    const fvi_gradients *want = f->want;
    const double h = run->h, c = pow(h, 1 - 2 * run->alpha);
    double at = 0, rate = 0;
    int status = FVI_SUCCESS;
    if (f->memory && !f->is_late) /* lambda_0 is no part of N_0 */
        status = remember(f, 0, run->x0, NULL);
    if (f->memory && unit > 0) { /* e = 1 - 2 alpha, C v0 its size */
        const fvi_matrices *m = run->system->matrices;
        memset(f->N, 0, f->r * sizeof *f->N);
        status = m->remember(f->d, f->v0, f->N, m->params, f->dN);
        if (!status)
            status = across(f, pull, f->dN, &at);
        if (!status)
            status = across(f, pull_rate, f->dN, &rate);
    }
    if (want->mass) /* v0 is M^-1 p0 */
        *want->mass = f->by_M / h - dot(f->d, run->p0, drag);
    if (want->damping)
        *want->damping = -c * f->by_C - unit * at;
    if (want->alpha)
        *want->alpha = -c * f->by_alpha + 2 * unit * (log(h) * at + rate);
    if (want->parameters)
        *want->parameters = -h * f->by_K;
    return status;
}
//< factors
