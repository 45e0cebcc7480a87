/* src/parameter_derivatives/constant_history.c -- The history of a constant, which a history of differences leaves out.
 * [H 23] */
#include "constant_history.h"

#include "methods/damping.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t fvi_bdf2_log(double *l)
{
    double power = 1;
    l[0] = log(1.5);
    for (size_t n = 1; n < FVI_BDF2_TAPS; n++)
        l[n] = -(power /= 3) / (double)n;
    return FVI_BDF2_TAPS;
}

/* The coefficients of g = ((3 - z)/2)^beta, and of g ln((3 - z)/2), its derivative by beta. */
static size_t factor_bdf2(double beta, double *g, double *gdot)
{
    double l[FVI_BDF2_TAPS];
    const size_t taps = fvi_bdf2_log(l);
    fvi_cq_bdf2_factor(beta, g);
    for (size_t n = 0; n < taps; n++)
        for (size_t j = 0; j <= n; j++)
            gdot[n] += l[j] * g[n - j];
    return taps;
}

size_t fvi_power_factor(fvi_scheme scheme, double alpha, double *g,
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

double fvi_power_factor_sum_by_fours(size_t taps, const double *g, const double *past)
{
    double sum[4] = { g[0] * past[0] }; /* no vector operation waits for the latest term */
    size_t n = 1;
    for (; n + 4 <= taps; n += 4)
#pragma GCC unroll 4
        for (size_t l = 0; l < 4; l++)
            sum[l] += g[n + l] * past[n + l];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]) + fvi_dot(taps - n, g + n, past + n);
}

static int allocate(fvi_constant_history *c)
{
    const size_t n = c->width;
    c->block = FVI_ARRAYS({ &c->sum, n }, { &c->sum_by_order, n }, { &c->value, n }, { &c->rate, n },
                          { &c->by_theta, n }, { &c->now, n }, { &c->now_by_order, n },
                          { &c->past, 2 * c->taps * n }, { &c->past_by_order, 2 * c->taps * n });
    if (!c->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    return FVI_SUCCESS;
}

int fvi_constant_history_start(const fvi_method *method, const fvi_run *run,
                               const fvi_run_damper *of, size_t width, int by_order,
                               fvi_constant_history *c)
{
    const fvi_scheme scheme = method->scheme;
    *c = (fvi_constant_history){ .width = width,
                                 .by_order = by_order,
                                 .theta = scheme == FVI_SCHEME_CQ2_SHIFTED ? of->alpha
                                          : scheme == FVI_SCHEME_CQ2_MIDPOINT
                                                  || scheme == FVI_SCHEME_FVI
                                              ? 0.5
                                              : 0 };
    c->taps = fvi_power_factor(scheme, of->alpha, c->g, c->gdot);
    const int status = allocate(c);
    return status ? status
                  : fvi_run_damper_history(of, run, fvi_damping_quadrature(method),
                                           by_order, width, &c->first, &c->memory);
}

void fvi_constant_history_stop(fvi_constant_history *c)
{
    fvi_history_free(c->memory);
    free(c->block);
}

/* Store one more term of number i. Returns the last terms, the latest first. */
static const double *store_term(const fvi_constant_history *c, double *past, size_t i,
                                double term)
{
    double *row = past + i * 2 * c->taps + c->place;
    row[0] = row[c->taps] = term;
    return row;
}

//> next
int fvi_constant_history_next(fvi_constant_history *c, const double *B,
                              const double *change)
{
    const double theta = c->theta;
    c->has_begun = 1;
    c->place = (c->place ? c->place : c->taps) - 1;
    const int status = c->by_order
                           ? fvi_history_push_by_order(c->memory, B, change, c->now,
                                                       c->now_by_order)
                           : fvi_history_push(c->memory, B, change, c->now);
    for (size_t i = 0; i < c->width; i++) {
        const double *past = store_term(c, c->past, i, c->now[i]), before = c->sum[i];
        const double sum = fvi_power_factor_sum(c->taps, c->g, past);
        c->sum[i] = sum;
        c->value[i] = (0.5 + theta) * sum + (0.5 - theta) * before;
        c->by_theta[i] = sum - before;
    }
    for (size_t i = 0; c->by_order && i < c->width; i++) {
        const double *past = c->past + i * 2 * c->taps + c->place,
                     *rated = store_term(c, c->past_by_order, i, c->now_by_order[i]),
                     before = c->sum_by_order[i],
                     by_order = fvi_power_factor_sum(c->taps, c->g, rated)
                                + fvi_power_factor_sum(c->taps, c->gdot, past);
        c->sum_by_order[i] = by_order;
        c->rate[i] = (0.5 + theta) * by_order + (0.5 - theta) * before;
    }
    return status;
}
//< next
