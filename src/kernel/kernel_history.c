/* src/kernel/kernel_history.c -- Make the history of a damping law.  [H 26] */
#include <fvi/damping_laws.h>

#include "kernel_general.h"
#include "kernel_ready.h"
#include "memory/history_kinds.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>

#include <math.h>
#include <stdlib.h>

/* ---- the two kinds of history ---- */

/* Return a new array of the first `count` weights divided by w_0, and write w_0 to *first. If w_0 = 0, all weights are
 * 0, and nothing is divided. Return NULL if memory is short. */
static double *weights_of(const fvi_kernel_ready *r, size_t count, double *first)
{
    double *w = calloc(count, sizeof *w);
    double *room = malloc(2 * count * sizeof *room);
    if (!w || !room) {
        free(w);
        free(room);
        return NULL;
    }
    for (size_t i = 0; i < r->terms; i++)
        fvi_kernel_series(&r->term[i], r->kind, r->h, r->increments, count, room,
                       w);
    free(room);
    if (fvi_kernel_general_weights(r->law, r->kind, r->h, r->increments, count,
                                   w)) {
        free(w);
        return NULL;
    }
    *first = w[0];
    for (size_t n = 0; n < count && *first != 0; n++)
        w[n] /= *first;
    return w;
}

static fvi_history_head *make_modes_history(const fvi_kernel_ready *r, size_t d, size_t steps,
                                            double delta, double *first)
{
    fvi_kernel_modes m;
    fvi_history_head *e = NULL;
    const int status = fvi_kernel_ready_modes(r, fmax((double)steps, 128), delta, &m);
    double *w = status ? NULL : weights_of(r, FVI_WINDOW + 1, first);
    for (size_t q = 0; w && q < m.count; q++)
        m.weight[q] /= *first;
    if (w)
        e = fvi_history_modes_of(m.count, m.rate, m.weight, w, d);
    free(w);
    free(m.rate);
    return e;
}

/* Test whether the modes of one term on the cut represent its weights at the lags 33 to 511. They fail to if the symbol
 * has a pole off the cut, a pole near the cut, or another cut. */
static int are_all_modes(const fvi_kernel_ready *r, int *all)
{
    enum { LAGS = 512 };
    fvi_kernel_modes m;
    int status = fvi_kernel_ready_modes(r, LAGS, 1e-14, &m);
    double first, worst = 0, *w = status ? NULL : weights_of(r, LAGS, &first);
    if (!status && !w)
        status = fvi_tell_handler("no memory for the weights", __FILE__, __LINE__, FVI_ENOMEM);
    for (size_t n = FVI_WINDOW + 1; !status && n < LAGS; n++) {
        double sum = 0;
        for (size_t q = 0; q < m.count; q++)
            sum += m.weight[q] * exp(-(double)n * m.rate[q]);
        const double off = fabs(sum / first - w[n]);
        worst = isnan(off) ? GSL_POSINF : larger(worst, off);
    }
    *all = !status && worst < 1e-13;
    free(w);
    free(m.rate);
    return status;
}

/* Find the widest of the four strips 1, 1/2, 1/4 and 1/8 whose modes represent the weights of every term on the cut.
 * Set r->strip = 0 if none does. */
static int find_strip(fvi_kernel_ready *r)
{
    for (size_t i = 0; i < r->law->count; i++) {
        const fvi_kernel alone = { 1, &r->law->term[i] };
        fvi_kernel_ready one = { .law = &alone, .kind = r->kind, .h = r->h, .increments = r->increments };
        int all = !fvi_kernel_is_on_cut(alone.term);
        while (!all && r->strip > 0.1) {
            one.strip = r->strip;
            const int status = are_all_modes(&one, &all);
            if (status)
                return status;
            r->strip /= all ? 1 : 2;
        }
        r->strip = all ? r->strip : 0;
    }
    return FVI_SUCCESS;
}

static int choose_kind(const fvi_kernel_ready *r, size_t steps, double tolerance,
                       fvi_history_kind *how)
{
    int has = 0;
    const int status = *how == FVI_HISTORY_DIRECT
                           ? FVI_SUCCESS
                           : fvi_kernel_ready_has_modes(r, &has);
    if (status)
        return status;
    if (*how == FVI_HISTORY_MODES && !has)
        FVI_FAIL("the tail of this law is no sum of decaying modes", FVI_EUNSUP);
    if (*how == FVI_HISTORY_AUTO)
        *how = has ? fvi_history_choose(0.5, steps) : FVI_HISTORY_DIRECT;
    if (*how == FVI_HISTORY_MODES && steps > FVI_LONGEST)
        FVI_FAIL("the compressed memory reaches back 10^9 steps at most", FVI_EINVAL);
    if (*how == FVI_HISTORY_MODES && tolerance != 0
        && tolerance < FVI_LEAST_TOLERANCE)
        FVI_FAIL("the compressed memory keeps tolerances from 1e-14 on", FVI_ETOL);
    return FVI_SUCCESS;
}

static int make_history(const fvi_kernel_ready *r, size_t d, size_t steps, fvi_history_kind how,
                        double tolerance, double *first, fvi_history **memory)
{
    int status = choose_kind(r, steps, tolerance, &how);
    if (status)
        return status;
    double w0, *weights = NULL;
    fvi_history_head *e = NULL;
    if (how == FVI_HISTORY_MODES)
        e = make_modes_history(r, d, steps, fvi_history_modes_delta(steps, tolerance),
                               &w0);
    else if ((weights = weights_of(r, steps + 1, &w0)))
        e = fvi_history_direct_of(d, steps, weights, fvi_kernel_has_general(r->law));
    free(weights);
    status = fvi_history_of_engine(r->increments, steps, e, memory);
    if (!status)
        *first = w0;
    return status;
}

/* Prepare a law for the step h. The caller adds the simple terms. */
static fvi_kernel_ready prepare_for_step(const fvi_kernel *law, fvi_delta kind, double h)
{
    return (fvi_kernel_ready){ .law = law,
                               .kind = kind,
                               .h = h,
                               .strip = 1,
                               .increments = fvi_kernel_growth(law) > 1 };
}

int fvi_kernel_has_modes(const fvi_kernel *law, fvi_delta kind, double h, int *has)
{
    fvi_kernel_ready r = prepare_for_step(law, kind, h);
    int status = fvi_kernel_flatten(law, &r.term, &r.terms);
    if (status)
        return status;
    status = find_strip(&r);
    if (!status)
        status = fvi_kernel_ready_has_modes(&r, has);
    free(r.term);
    return status;
}

int fvi_kernel_history(const fvi_kernel *law, fvi_delta kind, double h, size_t d,
                   size_t steps, fvi_history_kind how, double tolerance,
                   double *first, fvi_history **memory)
{
    int status = fvi_kernel_check_weights(law, kind, h);
    if (status)
        return status;
    if (!first || !memory)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (how > FVI_HISTORY_MODES)
        FVI_FAIL("unknown kind of memory", FVI_EINVAL);
    if (!(tolerance >= 0 && tolerance < 1))
        FVI_FAIL("tolerance must be in [0, 1)", FVI_EDOM);
    if (d == 0 || steps >= (size_t)-1 / sizeof(double) / 4 / d - 1)
        FVI_FAIL("d must be at least 1, and all be addressable", FVI_EINVAL);
    fvi_kernel_ready r = prepare_for_step(law, kind, h);
    status = fvi_kernel_flatten(law, &r.term, &r.terms);
    if (status)
        return status;
    if (how == FVI_HISTORY_MODES
        || (how == FVI_HISTORY_AUTO
            && fvi_history_choose(0.5, steps) == FVI_HISTORY_MODES))
        status = find_strip(&r);
    if (!status)
        status = make_history(&r, d, steps, how, tolerance, first, memory);
    free(r.term);
    return status;
}
