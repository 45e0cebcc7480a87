/* src/memory/kernel_history.c -- One set of modes for all terms of a law.  [H 26] */
#include <fvi/damping_laws.h>

#include "kernel_terms.h"
#include "history_kinds.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>

#include <math.h>
#include <stdlib.h>

/* A law at one step, ready to be summed. */
typedef struct {
    fvi_kernel_simple *term;
    size_t terms;
    fvi_delta kind;
    double h;
    int increments;
} ready;

static int is_whole(double x)
{
    return x == floor(x);
}

static int has_cut(const fvi_kernel_simple *t)
{
    return t->rho > 0
           && !(is_whole(2 * t->alpha)
                && (t->time == 0 || is_whole(2 * t->below)));
}

/* A fraction's symbol has poles where 1 + time s^{2 below} = 0, on the sheet of the cut
 * this many radians beyond it; of a power's there are none. */
static double strip(const fvi_kernel_simple *t)
{
    return t->time == 0 ? M_PI_2
                        : 0.9 * fmin(M_PI_2, M_PI * (0.5 / t->below - 1));
}

/* ---- the cut ---- */

/* The same of all terms. */
static double on_the_cut(const ready *r, double ln_radius)
{
    double sum = 0;
    for (size_t i = 0; i < r->terms; i++)
        if (has_cut(&r->term[i]))
            sum += fvi_kernel_on_the_cut(&r->term[i], r->term[i].rho,
                                         ln_radius);
    return sum;
}

/* Below 1/N the nodes fall off doubly fast, and the strip in which a fraction is analytic
 * is crushed there: its poles, at |s| = h time^(-1/2 below), shall be well above. */
static double longest(const ready *r, double N)
{
    for (size_t i = 0; i < r->terms; i++) {
        const fvi_kernel_simple *t = &r->term[i];
        if (has_cut(t) && t->time > 0)
            N = larger(N, 20 * pow(t->time, 0.5 / t->below) / r->h);
    }
    return N;
}

/* A thousand nodes, at most, for a pole that low. */
#define MOST 1e90

/* BDF2's symbol has poles of its own where a time is short, at |z| = 2.4 for the longest
 * orders: their powers are not gone within the window, and on no cut. */
static int is_short(const ready *r, double time)
{
    return r->kind == FVI_DELTA_BDF2 && 4 * r->h > time;
}

/* Can the tail be a sum of decaying modes? (26.6) */
static int has_modes(const ready *r)
{
    for (size_t i = 0; i < r->terms; i++) {
        const fvi_kernel_simple *t = &r->term[i];
        if (t->rho == 0 || t->time == 0)
            continue;
        if ((t->below > 0.45 && !fvi_kernel_is_relaxation(t))
            || (has_cut(t) && longest(r, 1) > MOST))
            return 0; /* poles too near, or off the cut, or too low */
        if (has_cut(t) && t->below > 0.4
            && is_short(r, pow(t->time, 0.5 / t->below)))
            return 0;
        if (fvi_kernel_is_relaxation(t) && is_short(r, t->time))
            return 0;
    }
    return 1;
}

/* Modes on the cut: Q of them, or with s == NULL their number alone. */
static size_t modes_of_cut(const ready *r, double N, double delta, double *s,
                           double *c)
{
    double least = 1, width = M_PI_2;
    int any = 0;
    for (size_t i = 0; i < r->terms; i++)
        if (has_cut(&r->term[i])) {
            any = 1;
            least = smaller(least, 2 * r->term[i].alpha - r->increments);
            width = smaller(width, strip(&r->term[i]));
        }
    if (!any)
        return 0;
    N = longest(r, N);
    const fvi_node_range g = fvi_node_range_of(least, N, delta, width / M_PI_2);
    const int bdf2 = r->kind == FVI_DELTA_BDF2;
    size_t Q = 0;
    for (size_t q = 0; q < g.Q; q++) { /* (26.6) */
        const double t = g.left + (double)q * g.step, ln_s = t - exp(-t);
        const double node = exp(ln_s) / N, half = (3 - exp(node)) / 2;
        if (bdf2 && half <= 0)
            break; /* 3^(-33) of the rest is below all rounding */
        const double grows = node > 0 ? expm1(node) / node : 1;
        const double ln_radius =
            ln_s - log(N) + log(grows * (bdf2 ? half : 1) / r->h);
        const double weight = -g.step / M_PI * (1 + exp(-t))
                              * on_the_cut(r, ln_radius);
        if (s) {
            s[Q] = node;
            c[Q] = weight * (r->increments ? -1 / grows : node);
        }
        Q++;
    }
    return Q;
}

/* ---- the poles ---- */

/* Of rho s / (1 + T s) the weights are powers of one number, or of two. */
static size_t modes_of_relaxation(const ready *r, const fvi_kernel_simple *t,
                                  double *s, double *c)
{
    const double h = r->h, T = t->time, rho = t->rho;
    if (r->kind == FVI_DELTA_EULER) { /* (26.7) */
        if (s) {
            s[0] = log1p(h / T);
            c[0] = r->increments ? rho / (h + T) : -rho / T * h / (h + T);
        }
        return 1;
    }
    const double x = 2 * h / T, root = sqrt(1 - x); /* z = 2 -+ root */
    const double z[] = { 2 - root, 2 + root }, sign[] = { 1, -1 };
    for (size_t i = 0; s && i < 2; i++) {
        s[i] = i ? log(z[1]) : log1p(x / (1 + root));
        c[i] = sign[i] * rho / (T * root * z[i])
               * (r->increments ? (3 - z[i]) / 2 : -h / T);
    }
    return 2;
}

/* All modes: first the cut's, then the poles', then a spring among increments. */
static size_t all_modes(const ready *r, double N, double delta, double *s,
                        double *c)
{
    size_t Q = modes_of_cut(r, N, delta, s, c);
    for (size_t i = 0; i < r->terms; i++) {
        const fvi_kernel_simple *t = &r->term[i];
        double *to = s ? s + Q : NULL, *worth = s ? c + Q : NULL;
        if (fvi_kernel_is_relaxation(t))
            Q += modes_of_relaxation(r, t, to, worth);
        if (t->alpha == 0 && r->increments && t->rho > 0) {
            if (s) { /* their sum, for ever */
                to[0] = 0;
                worth[0] = t->rho / (1 + t->time);
            }
            Q++;
        }
    }
    return Q;
}

/* ---- the two kinds of memory ---- */

/* The first `count` weights, w_0 taken out, if it is not 0 as all the others. */
static double *weights_of(const ready *r, size_t count, double *first)
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
    *first = w[0];
    for (size_t n = 0; n < count && *first > 0; n++)
        w[n] /= *first;
    return w;
}

static fvi_history_modes *compressed(const ready *r, size_t d, size_t steps,
                                    double delta, double *first)
{
    const double N = fmax((double)steps, 128);
    const size_t Q = all_modes(r, N, delta, NULL, NULL);
    double *w = weights_of(r, FVI_WINDOW + 1, first);
    double *s = malloc(2 * (Q + 1) * sizeof *s);
    fvi_history_modes *e = NULL;
    if (w && s) {
        all_modes(r, N, delta, s, s + Q);
        for (size_t q = 0; q < Q; q++)
            s[Q + q] /= *first;
        e = fvi_history_modes_of(Q, s, s + Q, w, d);
    }
    free(w);
    free(s);
    return e;
}

static int choose(const ready *r, size_t steps, double tolerance,
                  fvi_history_kind *how)
{
    if (*how == FVI_HISTORY_MODES && !has_modes(r))
        FVI_FAIL("the tail of this law is no sum of decaying modes",
                 FVI_EUNSUP);
    if (*how == FVI_HISTORY_AUTO)
        *how = !has_modes(r) ? FVI_HISTORY_DIRECT
                             : fvi_history_choose(0.5, steps);
    if (*how == FVI_HISTORY_MODES && steps > FVI_LONGEST)
        FVI_FAIL("the compressed memory reaches back 10^9 steps at most",
                 FVI_EINVAL);
    if (*how == FVI_HISTORY_MODES && tolerance != 0
        && tolerance < FVI_LEAST_TOLERANCE)
        FVI_FAIL("the compressed memory keeps tolerances from 1e-14 on",
                 FVI_ETOL);
    return FVI_SUCCESS;
}

static int make(const ready *r, size_t d, size_t steps, fvi_history_kind how,
                double tolerance, double *first, fvi_history **memory)
{
    int status = choose(r, steps, tolerance, &how);
    if (status)
        return status;
    double w0;
    double *weights = NULL;
    fvi_history_modes *e = NULL;
    if (how == FVI_HISTORY_MODES)
        e = compressed(r, d, steps, fvi_history_modes_delta(steps, tolerance),
                       &w0);
    else
        weights = weights_of(r, steps + 1, &w0);
    if (!e && !weights)
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    status = fvi_history_of_weights(r->increments, d, steps, weights, e, memory);
    if (!status)
        *first = w0;
    return status;
}

int fvi_kernel_has_modes(const fvi_kernel *law, fvi_delta kind, double h)
{
    ready r = { .kind = kind, .h = h };
    if (fvi_kernel_flatten(law, &r.term, &r.terms))
        return 0;
    const int modes = has_modes(&r);
    free(r.term);
    return modes;
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
    ready r = { .kind = kind,
                .h = h,
                .increments = fvi_kernel_growth(law) > 1 };
    status = fvi_kernel_flatten(law, &r.term, &r.terms);
    if (status)
        return status;
    status = make(&r, d, steps, how, tolerance, first, memory);
    free(r.term);
    return status;
}
