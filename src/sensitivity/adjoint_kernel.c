/* src/sensitivity/adjoint_kernel.c -- What a term of a law gives, going backwards. [H 23] */
#include "adjoint_kernel.h"

#include "memory/kernel_terms.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_adjoint_kernel_is_wanted(const fvi_sensitivities *want)
{
    return want->terms || want->orders || want->ends || want->times;
}

int fvi_adjoint_is_fraction(const fvi_kernel_term *t)
{
    return t->kind == FVI_KERNEL_ZENER || t->kind == FVI_KERNEL_MAXWELL;
}

int fvi_adjoint_has_order(const fvi_kernel_term *t)
{
    return t->kind == FVI_KERNEL_POWER || t->kind == FVI_KERNEL_ZENER;
}

void fvi_adjoint_unit_term(const fvi_kernel_term *of, fvi_kernel_term *unit,
                          double *rho)
{
    *unit = *of;
    *rho = of->rho;
    unit->rho = 1;
    if (of->kind == FVI_KERNEL_POWER || of->kind == FVI_KERNEL_DISTRIBUTED)
        unit->time = 0;
}

/* ---- the start ---- */

static int convolve(const fvi_run *run, fvi_kernel_term term, fvi_delta kind,
                    size_t d, fvi_adjoint_convolution *c)
{
    const fvi_kernel alone = { 1, &term };
    return fvi_kernel_history(&alone, kind, run->h, d, run->steps, run->memory,
                          run->tolerance, &c->first, &c->memory);
}

/* ln(delta/h) = ln(1 - z) - ln h, of BDF2 with ln((3 - z)/2) besides. */
static int start_log(const fvi_run *run, fvi_delta kind,
                     fvi_adjoint_term *t)
{
    t->log_h = log(run->h);
    if (kind == FVI_DELTA_BDF2) {
        double power = 1;
        t->taps = FVI_BDF2_TAPS;
        t->l[0] = log(1.5);
        for (size_t n = 1; n < t->taps; n++)
            t->l[n] = -(power /= 3) / (double)n;
    }
    return fvi_history_alloc_by_order(0, t->d, run->steps, run->memory,
                                 run->tolerance, &t->log);
}

static int start_range(const fvi_run *run, const fvi_sensitivities *want,
                       fvi_delta kind, fvi_adjoint_term *t)
{
    const fvi_kernel_term from = { FVI_KERNEL_POWER, 1, t->term.alpha, 0, 0 },
                       to = { FVI_KERNEL_POWER, 1, t->term.end, 0, 0 };
    int status = FVI_SUCCESS;
    if (want->orders)
        status = convolve(run, from, kind, t->d, &t->lower);
    if (!status && want->ends)
        status = convolve(run, to, kind, t->d, &t->upper);
    return status;
}

int fvi_adjoint_term_start(const fvi_run *run, const fvi_sensitivities *want,
                          fvi_delta kind, size_t i, size_t d,
                          fvi_adjoint_term *t)
{
    enum { ROWS = 6 };
    *t = (fvi_adjoint_term){ .d = d };
    fvi_adjoint_unit_term(&run->law->term[i], &t->term, &t->rho);
    t->block = calloc((ROWS + FVI_BDF2_TAPS) * d, sizeof *t->block);
    if (!t->block)
        FVI_FAIL("no memory for the mirrored run", FVI_ENOMEM);
    double **each[ROWS] = { &t->sum,  &t->change, &t->square,
                            &t->left, &t->moved,  &t->rate };
    for (size_t j = 0; j < ROWS; j++)
        *each[j] = t->block + j * d;
    t->past = t->block + ROWS * d;
    const int by_order = want->orders && fvi_adjoint_has_order(&t->term),
              is_squared = fvi_adjoint_is_fraction(&t->term)
                           && (want->times || (by_order && t->term.time > 0));
    int status = convolve(run, t->term, kind, d, &t->self);
    if (!status && is_squared)
        status = convolve(run, t->term, kind, d, &t->again);
    if (!status && by_order)
        status = start_log(run, kind, t);
    if (!status && t->term.kind == FVI_KERNEL_DISTRIBUTED)
        status = start_range(run, want, kind, t);
    return status;
}

void fvi_adjoint_term_stop(fvi_adjoint_term *t)
{
    fvi_history_free(t->self.memory);
    fvi_history_free(t->again.memory);
    fvi_history_free(t->lower.memory);
    fvi_history_free(t->upper.memory);
    fvi_history_free(t->log);
    for (size_t l = 0; l < sizeof t->impulses / sizeof *t->impulses; l++)
        fvi_impulses_of_kernel_free(t->impulses[l]);
    free(t->block);
}

/* ---- the impulses of a start with a velocity ---- */

static double complex unit_symbol(const void *term, double complex s)
{
    return fvi_kernel_at(&(fvi_kernel){ 1, term }, s, NULL);
}

/* dC/d alpha and dC/d time of a power, a fraction or a Maxwell element; dC/da and dC/de of a
 * range of orders. (23.21) */
static double complex symbol_by_order(const void *term, double complex s)
{
    const fvi_kernel_term *t = term;
    const double complex C = unit_symbol(t, s);
    return t->kind == FVI_KERNEL_DISTRIBUTED ? -cpow(s, 2 * t->alpha)
                                             : 2 * clog(s) * C * (1 - t->time * C);
}

static double complex symbol_by_time(const void *term, double complex s)
{
    const double complex C = unit_symbol(term, s);
    return -C * C;
}

static double complex symbol_by_end(const void *term, double complex s)
{
    return cpow(s, 2 * ((const fvi_kernel_term *)term)->end);
}

int fvi_adjoint_term_start_impulses(fvi_adjoint_term *t, double h,
                                    const fvi_sensitivities *want)
{
    const int is_range = t->term.kind == FVI_KERNEL_DISTRIBUTED;
    fvi_symbol_function *const symbol[] = {
        want->terms ? unit_symbol : NULL,
        want->orders && (fvi_adjoint_has_order(&t->term) || is_range) ? symbol_by_order
                                                                      : NULL,
        want->times && fvi_adjoint_is_fraction(&t->term) ? symbol_by_time : NULL,
        want->ends && is_range ? symbol_by_end : NULL
    };
    static const fvi_slope_by by[] = { 0, FVI_SLOPE_BY_ORDER, FVI_SLOPE_BY_TIME,
                                       FVI_SLOPE_BY_END };
    int status = FVI_SUCCESS;
    t->alone = (fvi_kernel){ 1, &t->term };
    if (symbol[0])
        status = fvi_impulses_of_kernel_alloc(&t->alone, h, &t->impulses[0]);
    for (size_t l = 1; !status && l < sizeof symbol / sizeof *symbol; l++)
        if (symbol[l])
            status = fvi_impulses_of_slope_alloc(symbol[l], &t->term, by[l], h,
                                                 &t->impulses[l]);
    return status;
}

void fvi_adjoint_term_accumulate_impulses(fvi_adjoint_term *t, size_t k, double left,
                                          double right, const fvi_sensitivities *want,
                                          size_t i)
{
    double *const to[] = { want->terms, want->orders, want->times, want->ends };
    for (size_t l = 0; l < sizeof to / sizeof *to; l++) {
        double at[2];
        if (!t->impulses[l])
            continue;
        fvi_impulses_of_kernel_at(t->impulses[l], k, at);
        to[l][i] -= (l == 0 ? 1 : t->rho) * (at[0] * left + at[1] * right);
    }
}

/* ---- a node ---- */

static int push(const fvi_adjoint_term *t, const fvi_adjoint_convolution *c,
                const double *in, const double *change, double *out)
{
    const int status = fvi_history_push(c->memory, in, change, out);
    for (size_t i = 0; i < t->d; i++)
        out[i] *= c->first;
    return status;
}

/* Takes weight . v away. */
static void subtract_product(const fvi_adjoint_term *t, double factor, const double *weight,
                 const double *v, double *to)
{
    double sum = 0;
    for (size_t i = 0; i < t->d; i++)
        sum += weight[i] * v[i];
    *to -= factor * sum;
}

/* rate += ln((3 - z)/2) left, whose last terms stand in a ring. */
static void add_factor(fvi_adjoint_term *t)
{
    const size_t d = t->d;
    if (t->taps == 0)
        return;
    t->place = (t->place + t->taps - 1) % t->taps;
    memcpy(t->past + t->place * d, t->left, d * sizeof *t->left);
    for (size_t n = 0; n < t->taps; n++) {
        const double *past = t->past + (t->place + n) % t->taps * d;
        for (size_t i = 0; i < d; i++)
            t->rate[i] += t->l[n] * past[i];
    }
}

//> by-order
/* L C (1 - time C) nu into rate: sum is C nu, square C^2 nu. */
static int by_order(fvi_adjoint_term *t)
{
    for (size_t i = 0; i < t->d; i++) {
        const double now = t->sum[i] - t->term.time * t->square[i];
        t->moved[i] = now - t->left[i];
        t->left[i] = now;
    }
    int status =
        fvi_history_push_by_order(t->log, t->left, t->moved, t->moved, t->rate);
    for (size_t i = 0; i < t->d; i++)
        t->rate[i] -= t->log_h * t->left[i];
    add_factor(t); /* (23.22) */
    return status;
}
//< by-order

static int accumulate_range(fvi_adjoint_term *t, const double *nu, const double *dnu,
                      const double *weight, const fvi_sensitivities *want, size_t i)
{
    int status = FVI_SUCCESS;
    if (t->lower.memory) {
        status = push(t, &t->lower, nu, dnu, t->square);
        subtract_product(t, -t->rho, weight, t->square, &want->orders[i]);
    }
    if (t->upper.memory && !status) {
        status = push(t, &t->upper, nu, dnu, t->square);
        subtract_product(t, t->rho, weight, t->square, &want->ends[i]);
    }
    return status;
}

int fvi_adjoint_term_accumulate(fvi_adjoint_term *t, const double *nu,
                         const double *dnu, const double *weight,
                         const fvi_sensitivities *want, size_t i)
{
    for (size_t j = 0; j < t->d; j++)
        t->change[j] = -t->sum[j];
    int status = push(t, &t->self, nu, dnu, t->sum);
    for (size_t j = 0; j < t->d; j++)
        t->change[j] += t->sum[j];
    if (want->terms)
        subtract_product(t, 1, weight, t->sum, &want->terms[i]);
    if (!status && t->again.memory)
        status = push(t, &t->again, t->sum, t->change, t->square);
    if (t->again.memory && want->times)
        subtract_product(t, -t->rho, weight, t->square, &want->times[i]);
    if (!status && t->log) {
        status = by_order(t);
        subtract_product(t, 2 * t->rho, weight, t->rate, &want->orders[i]);
    }
    return status ? status : accumulate_range(t, nu, dnu, weight, want, i);
}
