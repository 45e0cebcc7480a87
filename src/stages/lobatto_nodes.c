/* src/stages/lobatto_nodes.c -- Weights on Lobatto nodes as sums of powers. [H 17] */
#include "lobatto_weights.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */

#include <gsl/gsl_math.h>
#include <string.h>

enum { LANES = FVI_MODE_LANES };

/* (mu + A^(-1)) a = e_1 / b_1 for eight mu side by side. The rows need no exchange, because the symmetric part of
 * B (mu + A^(-1)) is positive (17.2), and so is that of what is left after each pivot. */
FVI_VECTORS static void solve_nodes(size_t s, const double *mu, double a[FVI_STAGES][LANES])
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    double m[FVI_STAGES][FVI_STAGES][LANES], factor[LANES];
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++)
#pragma omp simd
            for (size_t l = 0; l < LANES; l++)
                m[i][j][l] = rule->D[i][j] + (i == j ? mu[l] : 0);
    memset(a, 0, s * sizeof *a);
    for (size_t l = 0; l < LANES; l++) {
        m[0][0][l] += 1 / rule->b[0];
        a[0][l] = 1 / rule->b[0];
    }
    for (size_t j = 0; j < s; j++)
        for (size_t i = j + 1; i < s; i++) {
#pragma omp simd
            for (size_t l = 0; l < LANES; l++) {
                factor[l] = m[i][j][l] / m[j][j][l];
                a[i][l] -= factor[l] * a[j][l];
            }
            for (size_t n = j + 1; n < s; n++)
#pragma omp simd
                for (size_t l = 0; l < LANES; l++)
                    m[i][n][l] -= factor[l] * m[j][n][l];
        }
    for (size_t i = s; i-- > 0;) {
        for (size_t n = i + 1; n < s; n++)
#pragma omp simd
            for (size_t l = 0; l < LANES; l++)
                a[i][l] -= m[i][n][l] * a[n][l];
        for (size_t l = 0; l < LANES; l++)
            a[i][l] /= m[i][i][l];
    }
}

void fvi_lobatto_solve_nodes(size_t s, size_t count, double *p, double *a, size_t stride)
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    for (size_t from = 0; from < count; from += LANES) {
        const size_t few = count - from < LANES ? count - from : LANES;
        double mu[LANES], entry[FVI_STAGES][LANES];
        for (size_t l = 0; l < LANES; l++)
            mu[l] = p[from + (l < few ? l : 0)];
        solve_nodes(s, mu, entry);
        for (size_t l = 0; l < few; l++) {
            p[from + l] = 0;
            for (size_t i = 0; i < s; i++) {
                a[i * stride + from + l] = entry[i][l];
                p[from + l] += mu[l] * rule->b[i] * entry[i][l]; /* 1 - r(-mu), to all digits */
            }
        }
    }
}

//> tail
/* (x coth x - 1) / x^2 for y = x^2, and (1 - x cot x) / x^2 for y = -x^2: Lambert's
 * continued fraction. */
static double lambert(double y)
{
    double f = 43;
    for (int n = 41; n >= 3; n -= 2)
        f = n + y / f;
    return 1 / f;
}

/* All nodes below mu, the next, stand at `low`, where q[0] has their sum and their first
 * moment. Those of the rates are others: R[0] and R[1], by shares of both nodes. factor is
 * step sin(pi e) / pi, and slope its derivative; at e = 0 factor / expm1 is 0/0. */
static void tail_rates(double e, double step, double mu, double low,
                       double factor, double slope, const double *q,
                       double *rate)
{
    const double y = M_PI * M_PI, w = step * step / 4;
    double R[2];
    for (int i = 0; i < 2; i++)
        R[i] = pow(mu, e + i) / expm1((e + i) * step)
               * (slope + factor * (log(mu) - step / -expm1(-(e + i) * step)));
    if (e < 0.25)
        R[0] = q[0]
               * (log(mu) - step / 2
                  - e * (y * lambert(-y * e * e) + w * lambert(w * e * e)));
    const double share = (R[1] - low * R[0]) / (mu - low);
    rate[0] = R[0] - share;
    rate[1] += share;
}
//< tail

fvi_lobatto_span fvi_lobatto_span_of(size_t s, double least, double most,
                                     double N, double tolerance, double width)
{
    const double L = -log(tolerance),
                 decay = (double)(s * (s - 1)); /* r(-mu) ~ decay/mu^2 */
    const double end = 2 * log((double)s / fvi_lobatto(s)->b[0]);
    return (fvi_lobatto_span){ .first = -L / (3 + least) - log(N),
                               .last = fmax((L + FVI_LAGS * log(decay) + end)
                                                / (2 * FVI_LAGS + 1 - most),
                                            M_LN2 * 3),
                               .step = width * M_PI * M_PI / (L + M_LN10) };
}

//> nodes
size_t fvi_lobatto_nodes(size_t s, double beta, double N, double tolerance,
                         int by_order, double *q, double *rate, double *p,
                         double *a, size_t stride)
{
    const fvi_lobatto_span span =
        fvi_lobatto_span_of(s, beta, beta, N, tolerance, 1);
    const double first = span.first, step = span.step, e0 = 1 + beta;
    const double sine = -sin(M_PI * fmin(fabs(beta), 1 - fabs(beta))) / M_PI;
    const double factor = beta < 0 ? -sine * step : sine * step;
    size_t Q = 1 + (size_t)ceil((span.last - first) / step);
    Q = by_order || (beta != 0 && beta != -1) ? Q + 1 /* and the tail */
                                           : beta == -1;
    const double slope = step * cos(M_PI * e0);
    double low = 0;
    for (size_t j = 0; q && j < Q; j++) {
        double mu = exp(first + ((double)j - 1) * step);
        q[j] = factor * pow(mu, e0);
        if (by_order)
            rate[j] = pow(mu, e0) * (slope + factor * log(mu));
        if (j == 0) { /* all nodes below the first, by two moments: (17.12) */
            mu *= exp(step);
            double S0 = pow(mu, e0) / expm1(e0 * step),
                   S1 = pow(mu, e0 + 1) / expm1((e0 + 1) * step);
            q[j] = beta == -1 ? 1 : factor * S0;
            low = mu = beta == -1 ? 0 : S1 / S0;
        }
        p[j] = mu;
    }
    if (q)
        fvi_lobatto_solve_nodes(s, Q, p, a, stride);
    if (q && by_order)
        tail_rates(e0, step, exp(first), low, factor, slope, q, rate);
    return Q;
}
//< nodes
