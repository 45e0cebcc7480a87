/* src/memory/lobatto_law.c -- Laws of damping on Lobatto nodes.          [Chapter 26] */
#include "lobatto_law.h"

#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

static int has_cut(const fvi_law_simple *t)
{
    return t->rho > 0 && t->alpha > 0 && t->alpha < 0.5;
}

int fvi_lobatto_law_of(const fvi_law *law, double h, fvi_lobatto_law *ready)
{
    int status = fvi_law_flatten(law, &ready->term, &ready->terms);
    if (status)
        return status;
    ready->h = h;
    for (size_t i = 0; i < ready->terms; i++) {
        const fvi_law_simple *t = &ready->term[i];
        if (t->rho > 0
            && (t->alpha > 0.5
                || (t->time > 0 && t->alpha > 0.45 && t->alpha < 0.5))) {
            fvi_lobatto_law_free(ready);
            FVI_FAIL(
                "on stages a law has orders up to 1, its fractions up to 0.9",
                FVI_EUNSUP);
        }
    }
    return FVI_SUCCESS;
}

void fvi_lobatto_law_free(fvi_lobatto_law *ready)
{
    free(ready->term);
    ready->term = NULL;
}

/* ---- nodes ---- */

/* h Im C(-mu/h + i0) / pi of one term, by ln mu. */
static double on_the_cut(const fvi_law_simple *t, double h, double ln_mu)
{
    const double beta = 2 * t->alpha, q = exp(beta * (ln_mu - log(h)));
    const double re = 1 + t->time * q * cos(M_PI * beta),
                 im = t->time * q * sin(M_PI * beta);
    return t->rho * h / M_PI * q * sin(M_PI * beta) / (re * re + im * im);
}

/* The sums of that, and of mu times that, over ln mu = first - step, first - 2 step, ...:
 * of a power a geometric sequence, of a fraction one in the end. (17.12) */
static void add_tail(const fvi_law_simple *t, double h, double first,
                     double step, double *S0, double *S1)
{
    const double beta = 2 * t->alpha;
    double at = first, now = on_the_cut(t, h, at);
    if (t->time > 0) /* until the fraction is a power to all digits */
        while (t->time * exp(beta * (at - log(h))) > 1e-17 && now > 0) {
            at -= step;
            now = on_the_cut(t, h, at);
            *S0 += now;
            *S1 += now * exp(at);
        }
    *S0 += now / expm1(beta * step);
    *S1 += now * exp(at) / expm1((1 + beta) * step);
}

/* The cut's: (17.10) with all terms on one set of nodes. */
static size_t nodes_of_cut(size_t s, const fvi_lobatto_law *r, double N,
                           double tolerance, double *q, double *p, double *a,
                           size_t stride)
{
    double least = 1, most = -1, width = 1;
    for (size_t i = 0; i < r->terms; i++) {
        const fvi_law_simple *t = &r->term[i];
        if (!has_cut(t))
            continue;
        least = fmin(least, 2 * t->alpha - 1);
        most = fmax(most, 2 * t->alpha - 1);
        if (t->time > 0) /* poles on the sheet beyond the cut */
            width = fmin(width, 0.9 * fmin(1, 1 / t->alpha - 2));
    }
    if (most < least)
        return 0;
    const fvi_lobatto_span span =
        fvi_lobatto_span_of(s, least, most, N, tolerance, width);
    const double first = span.first, step = span.step;
    const size_t Q = 2 + (size_t)ceil((span.last - first) / step);
    for (size_t j = 0; q && j < Q; j++) {
        const double ln_mu = first + ((double)j - 1) * step;
        double S0 = 0, S1 = 0;
        for (size_t i = 0; i < r->terms; i++)
            if (has_cut(&r->term[i])) {
                if (j > 0)
                    S0 += on_the_cut(&r->term[i], r->h, ln_mu);
                else
                    add_tail(&r->term[i], r->h, first, step, &S0, &S1);
            }
        q[j] = step * S0;
        fvi_lobatto_node(s, j > 0 ? exp(ln_mu) : S1 / S0, &p[j], a + j, stride);
    }
    return Q;
}

size_t fvi_lobatto_law_nodes(size_t s, const fvi_lobatto_law *ready, double N,
                             double tolerance, double *q, double *p, double *a,
                             size_t stride)
{
    size_t Q = nodes_of_cut(s, ready, N, tolerance, q, p, a, stride);
    double springs = 0;
    for (size_t i = 0; i < ready->terms; i++) {
        const fvi_law_simple *t = &ready->term[i];
        if (t->rho > 0 && t->alpha == 0)
            springs += t->rho / (1 + t->time);
        if (!(t->rho > 0 && t->alpha == 0.5 && t->time > 0))
            continue;
        if (q) { /* rho / (1 + T s) = (rho/T) / (s + 1/T): a residue */
            q[Q] = t->rho * ready->h / t->time;
            fvi_lobatto_node(s, ready->h / t->time, &p[Q], a + Q, stride);
        }
        Q++;
    }
    if (springs > 0 && q) { /* of order -1: the sum of all velocities */
        q[Q] = springs * ready->h;
        fvi_lobatto_node(s, 0, &p[Q], a + Q, stride);
    }
    return Q + (springs > 0);
}

/* ---- weights ---- */

int fvi_lobatto_law_weights(size_t s, const fvi_lobatto_law *ready, size_t n,
                            double *W)
{
    const double N = (double)n;
    const size_t Q =
        fvi_lobatto_law_nodes(s, ready, N, 1e-16, NULL, NULL, NULL, 0);
    double *q = calloc((2 + s) * Q + 1, sizeof *q);
    if (!q)
        FVI_FAIL("no memory for the nodes", FVI_ENOMEM);
    fvi_lobatto_law_nodes(s, ready, N, 1e-16, q, q + Q, q + 2 * Q, Q);
    memset(W, 0, (FVI_LAGS + 1) * s * s * sizeof *W);
    for (size_t i = 0; i < ready->terms; i++) {
        const fvi_law_simple *t = &ready->term[i];
        if (t->rho > 0)
            fvi_lobatto_near(s, t->rho, t->alpha, t->time, ready->h, W);
    }
    for (size_t k = 2; k < n; k++) {
        for (size_t j = 0; j < Q; j++)
            q[j] -= q[Q + j] * q[j]; /* q_j r_j^(k-1) */
        if (k > FVI_LAGS)
            fvi_lobatto_sum(s, Q, q, q + 2 * Q, W + k * s * s);
    }
    free(q);
    return FVI_SUCCESS;
}
