/* src/parameter_derivatives/node_terms.c -- The derivatives of a law by the numbers of its terms, at nodes. [H 23] */
#include "node_terms.h"

#include "constant_history.h"
#include "system/arrays.h"
#include "system/dot.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_wanted_kernel_numbers(const fvi_sensitivities *want)
{
    return want->terms || want->orders || want->ends || want->times;
}

int fvi_kernel_is_zener_or_maxwell(const fvi_kernel_term *t)
{
    return t->kind == FVI_KERNEL_ZENER || t->kind == FVI_KERNEL_MAXWELL;
}

int fvi_kernel_is_power_or_zener(const fvi_kernel_term *t)
{
    return t->kind == FVI_KERNEL_POWER || t->kind == FVI_KERNEL_ZENER;
}

void fvi_kernel_unit_term(const fvi_kernel_term *of, fvi_kernel_function *unit,
                          double *rho)
{
    if (of->kind == FVI_KERNEL_SYMBOL)
        *unit = *(const fvi_kernel_function *)of;
    else
        unit->term = *of;
    *rho = of->rho;
    unit->term.rho = 1;
    if (!fvi_kernel_number_of(of, 2))
        unit->term.time = 0;
}

/* ---- the start ---- */

static int convolve(const fvi_run *run, const fvi_kernel *single_term, fvi_delta kind,
                    size_t d, fvi_node_convolution *c)
{
    return fvi_kernel_history(single_term, kind, run->h, d, run->steps, run->memory,
                          run->tolerance, &c->first, &c->memory);
}

/* Start the history of ln(delta/h), which is ln(1 - z) - ln h, plus ln((3 - z)/2) for BDF2. */
static int start_log(const fvi_run *run, fvi_delta kind,
                     fvi_node_term *t)
{
    t->log_h = log(run->h);
    if (kind == FVI_DELTA_BDF2)
        t->taps = fvi_bdf2_log(t->l);
    return fvi_history_alloc_by_order(0, t->d, run->steps, run->memory,
                                 run->tolerance, &t->log);
}

static int start_slopes(const fvi_run *run, const fvi_sensitivities *want, fvi_delta kind,
                        fvi_node_term *t)
{
    const double *const wanted[] = { want->orders, want->times, want->ends };
    int status = FVI_SUCCESS;
    for (int by = 0; !status && by < FVI_KERNEL_DERIVATIVES; by++) {
        fvi_kernel_derivative *slope = &t->slope[by];
        if (!wanted[by] || !fvi_kernel_derivative_of(&t->unit.term, (fvi_slope_by)by, slope))
            continue;
        fvi_kernel_derivative_begin_at(slope, (kind == FVI_DELTA_BDF2 ? 1.5 : 1) / run->h);
        status = convolve(run, &slope->kernel, kind, t->d, &t->slopes[by]);
        t->by[1 + by] = t->by_slope[by];
        t->factor[1 + by] = slope->sign * t->rho;
    }
    return status;
}

int fvi_node_term_start(const fvi_run *run, const fvi_sensitivities *want,
                        fvi_delta kind, const fvi_kernel_term *term, size_t d,
                        const fvi_damping_matrix *matrix, fvi_node_term *t)
{
    *t = (fvi_node_term){ .d = d,
                          .matrix = matrix,
                          .whole = matrix ? run->system->d : 0 };
    fvi_kernel_unit_term(term, &t->unit, &t->rho);
    t->single_term = (fvi_kernel){ 1, &t->unit.term };
    t->block = FVI_ARRAYS({ &t->sum, d }, { &t->change, d }, { &t->square, d }, { &t->left, d }, { &t->moved, d },
                          { &t->rate, d }, { &t->by_slope[0], d }, { &t->by_slope[1], d }, { &t->by_slope[2], d },
                          { &t->past, FVI_BDF2_TAPS * d }, { &t->product, t->whole });
    if (!t->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    const int by_order = want->orders && fvi_kernel_is_power_or_zener(&t->unit.term),
              is_squared = fvi_kernel_is_zener_or_maxwell(&t->unit.term)
                           && (want->times || (by_order && t->unit.term.time > 0));
    t->by[0] = want->terms ? t->sum : NULL;
    t->factor[0] = 1;
    t->by[1] = by_order ? t->rate : NULL;
    t->factor[1] = 2 * t->rho;
    t->by[2] = is_squared && want->times ? t->square : NULL;
    t->factor[2] = -t->rho;
    int status = convolve(run, &t->single_term, kind, d, &t->self);
    if (!status && is_squared)
        status = convolve(run, &t->single_term, kind, d, &t->again);
    if (!status && by_order)
        status = start_log(run, kind, t);
    return status ? status : start_slopes(run, want, kind, t);
}

void fvi_node_term_stop(fvi_node_term *t)
{
    fvi_history_free(t->self.memory);
    fvi_history_free(t->again.memory);
    for (int by = 0; by < FVI_KERNEL_DERIVATIVES; by++)
        fvi_history_free(t->slopes[by].memory);
    fvi_history_free(t->log);
    for (size_t l = 0; l < sizeof t->impulses / sizeof *t->impulses; l++)
        fvi_impulses_of_kernel_free(t->impulses[l]);
    free(t->block);
}

/* ---- the impulses of a start with a velocity ---- */

int fvi_node_term_start_impulses(fvi_node_term *t, double h,
                                 const fvi_sensitivities *want)
{
    const double *const wanted[] = { want->orders, want->times, want->ends };
    int status = want->terms
                     ? fvi_impulses_of_kernel_alloc(&t->single_term, h, &t->impulses[0])
                     : FVI_SUCCESS;
    for (int by = 0; !status && by < FVI_KERNEL_DERIVATIVES; by++) {
        fvi_symbol_function *symbol = fvi_kernel_derivative_symbol(&t->unit.term, (fvi_slope_by)by);
        if (wanted[by] && symbol)
            status = fvi_impulses_of_slope_alloc(symbol, &t->unit.term, (fvi_slope_by)by, h, &t->impulses[1 + by]);
    }
    return status;
}

void fvi_node_term_accumulate_impulses(fvi_node_term *t, size_t k, double left,
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

static int push(const fvi_node_term *t, const fvi_node_convolution *c,
                const double *in, const double *change, double *out)
{
    const int status = fvi_history_push(c->memory, in, change, out);
    for (size_t i = 0; i < t->d; i++)
        out[i] *= c->first;
    return status;
}

/* Subtract factor times weight . v, or weight . S v with a matrix, from *to. */
static int subtract_product(const fvi_node_term *t, double factor, const double *weight,
                            const double *v, double *to)
{
    int status = FVI_SUCCESS;
    if (t->matrix) {
        memset(t->product, 0, t->whole * sizeof *t->product);
        status = t->matrix->apply_damping(t->whole, -1, v, t->matrix->params, t->product);
        v = t->product;
    }
    *to -= factor * fvi_dot(t->matrix ? t->whole : t->d, weight, v);
    return status;
}

/* rate += ln((3 - z)/2) left. The last terms of left stand in a ring. */
static void add_factor(fvi_node_term *t)
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
/* Write L C (1 - time C) nu to rate. sum is C nu, and square is C^2 nu. */
static int by_order(fvi_node_term *t)
{
    for (size_t i = 0; i < t->d; i++) {
        const double now = t->sum[i] - t->unit.term.time * t->square[i];
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

static int next_slopes(fvi_node_term *t, const double *nu, const double *dnu)
{
    int status = FVI_SUCCESS;
    for (int by = 0; !status && by < FVI_KERNEL_DERIVATIVES; by++) {
        if (!t->slopes[by].memory)
            continue;
        status = push(t, &t->slopes[by], nu, dnu, t->by_slope[by]);
        for (size_t j = 0; j < t->d; j++)
            t->by_slope[by][j] -= t->slope[by].more * t->sum[j];
    }
    return status;
}

int fvi_node_term_next(fvi_node_term *t, const double *nu, const double *dnu)
{
    for (size_t j = 0; j < t->d; j++)
        t->change[j] = -t->sum[j];
    int status = push(t, &t->self, nu, dnu, t->sum);
    for (size_t j = 0; j < t->d; j++)
        t->change[j] += t->sum[j];
    if (!status && t->again.memory)
        status = push(t, &t->again, t->sum, t->change, t->square);
    if (!status && t->log)
        status = by_order(t);
    return status ? status : next_slopes(t, nu, dnu);
}

int fvi_node_term_accumulate(fvi_node_term *t, const double *nu,
                             const double *dnu, const double *weight,
                             const fvi_sensitivities *want, size_t i)
{
    double *const to[] = { want->terms, want->orders, want->times, want->ends };
    int status = fvi_node_term_next(t, nu, dnu);
    for (size_t l = 0; !status && l < sizeof to / sizeof *to; l++)
        if (t->by[l])
            status = subtract_product(t, t->factor[l], weight, t->by[l], &to[l][i]);
    return status;
}
