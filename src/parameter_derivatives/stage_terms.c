/* src/parameter_derivatives/stage_terms.c -- The derivatives of a law by the numbers of its terms, on stages. [H 23] */
#include "stage_terms.h"

#include "system/arrays.h"
#include "system/fail.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdlib.h>

/* ---- the start ---- */

static int convolve(const fvi_stage_term *t, const fvi_run *run, double keep, const fvi_kernel *alone,
                    fvi_stage_convolution *c)
{
    return fvi_lobatto_history_of_kernel(t->s, alone, run->h, t->d, run->steps, run->memory, keep,
                                         &c->memory);
}

static int is_davidson(const fvi_stage_term *t)
{
    return t->unit.term.kind == FVI_KERNEL_DAVIDSON;
}

/* Return nonzero for a HAVRILIAK that is a power or a ZENER. Its derivatives by the order and by the time are those of
 * a ZENER, products of histories; if time = 0, that by the time has the factor `end`. */
static int is_simple_havriliak(const fvi_stage_term *t)
{
    const fvi_kernel_term *term = &t->unit.term;
    return term->kind == FVI_KERNEL_HAVRILIAK && (term->time == 0 || term->end == 1);
}

/* Write ln(1 + T s) as a sum of Maxwell elements. (23.34) It is the integral of s/(1 + tau s) over tau from 0 to T. The
 * rule of Gauss and Legendre has 12 points below `least`, where |least s| < 1/2 for all s = lambda/h. Above, it has 12
 * points on each piece of ln tau, and no piece is longer than 1. There the pole ln tau = -ln s +- pi i is at least 1.8
 * away, because |arg lambda| < 1.3. So the error is 1e-16. */
static int find_relaxation(fvi_stage_term *t, fvi_kernel *sum)
{
    enum { POINTS = 12 };
    const double T = t->unit.term.time, least = fmin(T, t->h / (4 * (double)(t->s * t->s))),
                 pieces = ceil(log(T / least)), length = pieces > 0 ? log(T / least) / pieces : 0;
    fvi_quiet();
    gsl_integration_glfixed_table *gauss = gsl_integration_glfixed_table_alloc(POINTS);
    fvi_loud();
    sum->count = POINTS * (1 + (size_t)pieces);
    sum->term = t->relaxation = calloc(sum->count, sizeof *t->relaxation);
    if (!gauss || !t->relaxation) {
        gsl_integration_glfixed_table_free(gauss);
        FVI_FAIL("no memory for the terms of a law", FVI_ENOMEM);
    }
    for (size_t i = 0; i < sum->count; i++) {
        const size_t piece = i / POINTS;
        const double from = piece ? log(least) + (double)(piece - 1) * length : 0;
        double at, weight;
        gsl_integration_glfixed_point(from, piece ? from + length : least, i % POINTS, &at, &weight, gauss);
        const double tau = piece ? exp(at) : at;
        t->relaxation[i] = (fvi_kernel_term){ FVI_KERNEL_MAXWELL, piece ? weight * tau : weight, 0, tau, 0 };
    }
    gsl_integration_glfixed_table_free(gauss);
    return FVI_SUCCESS;
}

/* Cole and Davidson's kernel C = V^(2 alpha) with V = s/(1 + time s). Its derivative by the time is -2 alpha V C, and
 * by the order 2 (ln s - ln(1 + time s)) C. */
static int start_davidson(const fvi_run *run, const fvi_sensitivities *want, double keep, fvi_stage_term *t)
{
    const fvi_kernel_term maxwell = { FVI_KERNEL_MAXWELL, 1, 0, t->unit.term.time, 0 };
    const fvi_kernel alone = { 1, &maxwell };
    int status = FVI_SUCCESS;
    t->factor[2] *= 2 * t->unit.term.alpha;
    fvi_kernel sum;
    if (want->times)
        status = convolve(t, run, keep, &alone, &t->again);
    if (!status && want->orders && t->unit.term.time > 0)
        status = find_relaxation(t, &sum);
    return status || !t->relaxation ? status : convolve(t, run, keep, &sum, &t->less);
}

/* Start the history of a derivative that is a kernel of its own, if the term has it. */
static int start_slope(const fvi_run *run, double keep, fvi_slope_by by, fvi_stage_term *t)
{
    if (!fvi_kernel_derivative_of(&t->unit.term, by, &t->slope[by]))
        return FVI_SUCCESS;
    t->by[1 + by] = t->slopes[by].now;
    t->factor[1 + by] = t->slope[by].sign * t->rho;
    return convolve(t, run, keep, &t->slope[by].kernel, &t->slopes[by]);
}

/* The derivative of s^{2 alpha} / (1 + time s^{2 alpha})^end by end is -ln(1 + time s^{2 alpha}) times the kernel. It
 * is 0 for time = 0. For a Maxwell element it has a pole on the cut, and it is a product with the sum of
 * find_relaxation. */
static int start_end_of_havriliak(const fvi_run *run, double keep, fvi_stage_term *t)
{
    fvi_kernel sum;
    if (t->unit.term.time == 0)
        return FVI_SUCCESS;
    if (t->unit.term.alpha != 0.5)
        return start_slope(run, keep, FVI_SLOPE_BY_END, t);
    t->end_is_product = 1;
    t->by[1 + FVI_SLOPE_BY_END] = t->slopes[FVI_SLOPE_BY_END].now;
    t->factor[1 + FVI_SLOPE_BY_END] = -t->rho;
    const int status = find_relaxation(t, &sum);
    return status ? status : convolve(t, run, keep, &sum, &t->slopes[FVI_SLOPE_BY_END]);
}

/* Start the histories of the derivatives that are kernels of their own. */
static int start_slopes(const fvi_run *run, const fvi_sensitivities *want, double keep,
                        fvi_stage_term *t)
{
    const double *const wanted[] = { want->orders, want->times, want->ends };
    int status = FVI_SUCCESS;
    if (is_simple_havriliak(t))
        status = want->ends ? start_end_of_havriliak(run, keep, t) : FVI_SUCCESS;
    for (int by = 0; !status && by < FVI_KERNEL_DERIVATIVES && !is_davidson(t) && !is_simple_havriliak(t); by++)
        if (wanted[by])
            status = start_slope(run, keep, (fvi_slope_by)by, t);
    if (status == FVI_EUNSUP)
        FVI_FAIL("the derivative of this law by one of its numbers is no sum of decaying modes, which stages need; "
                 "fvi, fvi-bdf2 and fvi-stable have it", FVI_EUNSUP);
    return status;
}

/* Allocate all arrays that a term may need. */
static int allocate(fvi_stage_term *t)
{
    const size_t n = t->s * t->d;
    t->block = FVI_ARRAYS({ &t->self.past, n }, { &t->again.past, n }, { &t->slopes[0].past, n },
                          { &t->slopes[1].past, n }, { &t->slopes[2].past, n }, { &t->log.past, n },
                          { &t->slopes[0].now, n }, { &t->slopes[1].now, n }, { &t->slopes[2].now, n },
                          { &t->again.now, n }, { &t->log.now, n }, { &t->self.now, n }, { &t->rate, n },
                          { &t->left, n }, { &t->by_order, n }, { &t->room, n }, { &t->less.past, n },
                          { &t->less.now, n }, { &t->before, t->d });
    if (!t->block)
        FVI_FAIL("no memory for the terms of a law", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* Start the histories for the wanted derivatives by a term, with the tolerance `keep`. The caller gives t back with
 * stop_term, also after an error, and t must stay where it is. */
static int start_term(const fvi_run *run, const fvi_sensitivities *want, size_t s, size_t d,
                         double keep, const fvi_kernel_term *of, fvi_stage_term *t)
{
    *t = (fvi_stage_term){ .s = s, .d = d, .h = run->h, .log_h = log(run->h), .rule = fvi_lobatto(s) };
    fvi_kernel_unit_term(of, &t->unit, &t->rho);
    const fvi_kernel_term *term = &t->unit.term;
    const fvi_kernel alone = { 1, term };
    const int is_product = is_simple_havriliak(t),
              by_order = want->orders && (fvi_kernel_is_power_or_zener(term) || is_davidson(t) || is_product),
              by_time = want->times && (fvi_kernel_is_zener_or_maxwell(term) || is_davidson(t) || is_product);
    int status = allocate(t);
    t->by[0] = want->terms ? t->self.now : NULL;
    t->factor[0] = 1;
    t->by[1] = by_order ? t->by_order : NULL;
    t->factor[1] = 2 * t->rho;
    t->by[2] = by_time ? t->again.now : NULL;
    t->factor[2] = is_product && term->time == 0 ? -term->end * t->rho : -t->rho;
    if (!status)
        status = convolve(t, run, keep, &alone, &t->self);
    if (!status && (fvi_kernel_is_zener_or_maxwell(term) || is_product)
        && (want->times || (by_order && term->time > 0)))
        status = convolve(t, run, keep, &alone, &t->again);
    if (!status && by_order)
        status = fvi_lobatto_history_alloc(s, 0, d, run->steps, run->memory, 1, keep, &t->log.memory);
    if (!status && is_davidson(t))
        status = start_davidson(run, want, keep, t);
    return status ? status : start_slopes(run, want, keep, t);
}

static void stop_term(fvi_stage_term *t)
{
    fvi_lobatto_history_free(t->self.memory);
    fvi_lobatto_history_free(t->again.memory);
    for (int by = 0; by < FVI_KERNEL_DERIVATIVES; by++)
        fvi_lobatto_history_free(t->slopes[by].memory);
    fvi_lobatto_history_free(t->log.memory);
    fvi_lobatto_history_free(t->less.memory);
    free(t->relaxation);
    free(t->block);
}

/* ---- a step ---- */

/* now = past + W in, for number j. */
static void add_present(const fvi_stage_term *t, size_t j, const double *W, const double *in,
                        fvi_stage_convolution *c)
{
    const size_t s = t->s;
    for (size_t i = 0; i < s; i++) {
        double sum = c->past[j * s + i];
        for (size_t l = 0; l < s; l++)
            sum += W[i * s + l] * in[l];
        c->now[j * s + i] = sum;
    }
}

/* Write (Delta/h) u to out, by the two coefficients of (17.5). `before` is the last u of the step before. */
static void differentiate(const fvi_stage_term *t, const double *u, double before, double *out)
{
    const fvi_lobatto_rule *rule = t->rule;
    for (size_t i = 0; i < t->s; i++) {
        double sum = i == 0 ? (u[0] - before) / rule->b[0] : 0;
        for (size_t c = 0; c < t->s; c++)
            sum += rule->D[i][c] * u[c];
        out[i] = sum / t->h;
    }
}

/* Return what the history of a derivative takes in: nu, or (Delta/h) u if the derivative is a product. */
static const double *input_of(const fvi_stage_term *t, int by, const double *nu, const double *rate)
{
    return t->end_is_product && by == FVI_SLOPE_BY_END ? rate : nu;
}

//> stage-term
/* The derivatives of W nu by the numbers of a term, for number j. (23.21) */
void fvi_stage_term_next(fvi_stage_term *t, size_t j, const double *nu)
{
    const size_t s = t->s;
    const double *W = fvi_lobatto_history_w0(t->self.memory);
    double *u = t->self.now + j * s, *rate = t->rate + j * s, *left = t->left + j * s;
    add_present(t, j, W, nu, &t->self);
    if (t->again.memory || t->less.memory || t->end_is_product)
        differentiate(t, u, t->before[j], rate);
    if (t->again.memory)
        add_present(t, j, fvi_lobatto_history_w0(t->again.memory), rate, &t->again);
    if (t->less.memory)
        add_present(t, j, fvi_lobatto_history_w0(t->less.memory), rate, &t->less);
    for (size_t i = 0; i < s; i++)
        left[i] = u[i] - (is_davidson(t) ? 0 : t->unit.term.time * t->again.now[j * s + i]);
    if (t->log.memory)
        add_present(t, j, fvi_lobatto_history_w0_by_order(t->log.memory), left, &t->log);
    for (size_t i = j * s; t->log.memory && i < (j + 1) * s; i++)
        t->by_order[i] = t->log.now[i] - t->log_h * t->left[i] - t->less.now[i];
    for (int by = 0; by < FVI_KERNEL_DERIVATIVES; by++)
        if (t->slopes[by].memory)
            add_present(t, j, fvi_lobatto_history_w0(t->slopes[by].memory), input_of(t, by, nu, rate), &t->slopes[by]);
}
//< stage-term

static int push(fvi_stage_convolution *c, const double *in)
{
    return c->memory ? fvi_lobatto_history_push(c->memory, in, c->past, NULL)
                     : FVI_SUCCESS;
}

static int update_history_of_term(fvi_stage_term *t, const double *nu)
{
    int status = push(&t->self, nu);
    for (int by = 0; !status && by < FVI_KERNEL_DERIVATIVES; by++)
        status = push(&t->slopes[by], input_of(t, by, nu, t->rate));
    if (!status)
        status = push(&t->again, t->rate);
    if (!status)
        status = push(&t->less, t->rate);
    if (!status && t->log.memory)
        status = fvi_lobatto_history_push(t->log.memory, t->left, t->room, t->log.past);
    for (size_t j = 0; j < t->d; j++)
        t->before[j] = t->self.now[j * t->s + t->s - 1];
    return status;
}

/* ---- all terms of one law ---- */

int fvi_stage_terms_start(const fvi_run *run, const fvi_sensitivities *want, size_t s, size_t d,
                          double keep, const fvi_kernel *law, fvi_stage_terms *terms)
{
    int status = FVI_SUCCESS;
    *terms = (fvi_stage_terms){ 0 };
    terms->each = calloc(law->count, sizeof *terms->each);
    if (!terms->each)
        FVI_FAIL("no memory for the terms of a law", FVI_ENOMEM);
    for (; !status && terms->count < law->count; terms->count++)
        status = start_term(run, want, s, d, keep, law->term + terms->count,
                                      terms->each + terms->count);
    return status;
}

/* The sum over the stages of b_i times the velocity, which runs in the opposite order, times T_i. */
static double dot(const fvi_stage_term *t, const double *v, const double *T)
{
    double sum = 0;
    for (size_t i = 0; i < t->s; i++)
        sum += t->rule->b[i] * v[t->s - 1 - i] * T[i];
    return sum;
}

void fvi_stage_terms_accumulate(fvi_stage_terms *terms, size_t j, const double *nu, double weight,
                                const double *v, const fvi_sensitivities *want, size_t first)
{
    double *const to[] = { want->terms, want->orders, want->times, want->ends };
    for (size_t l = 0; l < terms->count; l++) {
        fvi_stage_term *t = terms->each + l;
        fvi_stage_term_next(t, j, nu);
        for (size_t by = 0; by < sizeof to / sizeof *to; by++)
            if (t->by[by])
                to[by][first + l] -= weight * t->factor[by] * dot(t, v, t->by[by] + j * t->s);
    }
}

int fvi_stage_terms_update_history(fvi_stage_terms *terms, const double *nu)
{
    int status = FVI_SUCCESS;
    for (size_t l = 0; !status && l < terms->count; l++)
        status = update_history_of_term(terms->each + l, nu);
    return status;
}

void fvi_stage_terms_stop(fvi_stage_terms *terms)
{
    for (size_t l = 0; l < terms->count; l++)
        stop_term(terms->each + l);
    free(terms->each);
}
