/* src/stages/lobatto_nodes.c -- Approximate the weights on Lobatto nodes by sums of powers. [H 17] */
#include "lobatto_weights.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */

#include <gsl/gsl_math.h>
#include <string.h>

enum { LANES = FVI_MODE_LANES };

/* Solve (mu + A^(-1)) a = e_1 / b_1 for eight mu side by side. The elimination needs no row exchange. The symmetric
 * part of B (mu + A^(-1)) is positive (17.2), and it stays positive after each pivot. */
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
/* Return (x coth x - 1) / x^2 for y = x^2, and (1 - x cot x) / x^2 for y = -x^2, by Lambert's continued fraction. */
static double lambert(double y)
{
    double f = 43;
    for (int n = 41; n >= 3; n -= 2)
        f = n + y / f;
    return 1 / f;
}

/* Compute rate[0], and change rate[1]. One node at `low` replaces all nodes below mu, the next node, and its q[0] has
 * their sum and their first moment. The derivatives have another sum R[0] and first moment R[1], so they are shared
 * between the nodes low and mu. factor is step sin(pi e) / pi, and slope is its derivative by e. For small e, R[0] is
 * computed by the function lambert, because factor / expm1(e step) is 0/0 at e = 0. */
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
                 decay = (double)(s * (s - 1)); /* r(-mu) is about decay / mu^2 */
    const double end = 2 * log((double)s / fvi_lobatto(s)->b[0]);
    return (fvi_lobatto_span){ .first = -L / (3 + least) - log(N),
                               .last = fmax((L + FVI_LAGS * log(decay) + end)
                                                / (2 * FVI_LAGS + 1 - most),
                                            M_LN2 * 3),
                               .step = width * M_PI * M_PI / (L + M_LN10) };
}

/* Return the factor of mu^(1 + beta) in the weight of a node. */
static double factor_of(double beta, double step)
{
    const double sine = -sin(M_PI * fmin(fabs(beta), 1 - fabs(beta))) / M_PI;
    return beta < 0 ? -sine * step : sine * step;
}

//> nodes
size_t fvi_lobatto_nodes(size_t s, double beta, double N, double tolerance,
                         int by_order, double *q, double *rate, double *p,
                         double *a, size_t stride)
{
    const fvi_lobatto_span span =
        fvi_lobatto_span_of(s, beta, beta, N, tolerance, 1);
    const double first = span.first, step = span.step, e0 = 1 + beta;
    const double factor = factor_of(beta, step);
    size_t Q = 1 + (size_t)ceil((span.last - first) / step);
    Q = by_order || (beta != 0 && beta != -1) ? Q + 1 /* one node more for the tail */
                                           : beta == -1;
    const double slope = step * cos(M_PI * e0);
    double low = 0;
    for (size_t j = 0; q && j < Q; j++) {
        double mu = exp(first + ((double)j - 1) * step);
        q[j] = factor * pow(mu, e0);
        if (by_order)
            rate[j] = pow(mu, e0) * (slope + factor * log(mu));
        if (j == 0) { /* one node replaces all nodes below the first by two moments: (17.12) */
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

/* ---- fewer nodes ---- */

/* The nodes with mu N <= SLOW hardly decay within the run: there exp(-mu n) is nearly a polynomial in mu, and a Gauss
 * rule with a few nodes replaces all of them. For N >= LONG the other factors of W_n are smooth there, too. */
enum { SLOW = 8, LONG = 64, MOST_FEW = 16, MOST_SLOW = 192 };

/* Compute entry n of the diagonal (here) and of the side diagonal (beside) of the Jacobi matrix of the slow nodes.
 * Relative to the largest node they stand at e^(-k step) with the weights e^(-k step (1 + beta)), k = 0, 1, ... The
 * orthogonal polynomials of this measure are the little q-Jacobi polynomials with q = e^(-step), whose recurrence is
 * known. (17.29) */
//> gauss
static void find_recurrence(double beta, double step, size_t n, double *here, double *beside)
{
    const double q = exp(-step), a = pow(q, beta), k = (double)n, q_k = pow(q, k);
    const double up = gsl_pow_2(1 - a * q * q_k) / ((1 - a * q * q_k * q_k) * (1 - a * gsl_pow_2(q * q_k))),
                 down = n > 0 ? gsl_pow_2(1 - q_k) / ((1 - a * q_k * q_k) * (1 - a * q * q_k * q_k)) : 0,
                 next = gsl_pow_2(1 - q * q_k) / ((1 - a * gsl_pow_2(q * q_k)) * (1 - a * q * gsl_pow_2(q * q_k)));
    *here = q_k * (up + a * down);
    *beside = q_k * sqrt(a * q * up * next);
}
//< gauss

/* Return the number of Gauss nodes that integrate exp(-SLOW x) to a tenth of the tolerance. The error contains the
 * derivative SLOW^(2 few) and the norm of the orthogonal polynomial, whose square is the product of the squares of the
 * side diagonal. */
static size_t count_few_nodes(double beta, double step, double tolerance)
{
    double left = 1, here, beside;
    size_t few = 0;
    while (left > tolerance / 10 && few < MOST_FEW) {
        find_recurrence(beta, step, few++, &here, &beside);
        left *= gsl_pow_2(SLOW * beside) / (double)(2 * few * (2 * few - 1));
    }
    return few;
}

/* Do one sweep of the QL method over the rows from, ..., to. */
static void ql_sweep(double *a, double *b, double *first, size_t from, size_t to)
{
    const double half = (a[from + 1] - a[from]) / (2 * b[from]);
    double g = a[to] - a[from] + b[from] / (half + copysign(sqrt(half * half + 1), half)), s = 1, c = 1, moved = 0;
    for (size_t i = to; i-- > from;) {
        const double f = s * b[i], beside = c * b[i], r = sqrt(f * f + g * g);
        b[i + 1] = r;
        s = f / r;
        c = g / r;
        g = a[i + 1] - moved;
        const double turn = (a[i] - g) * s + 2 * c * beside, kept = first[i + 1];
        moved = s * turn;
        a[i + 1] = g + moved;
        g = c * turn - beside;
        first[i + 1] = s * first[i] + c * kept;
        first[i] = c * first[i] - s * kept;
    }
    a[from] -= moved;
    b[from] = g;
    b[to] = 0;
}

/* Compute the eigenvalues of the tridiagonal matrix with the diagonal a and the side diagonal b, and write
 * them to a. They are the Gauss nodes, and the squares of the first entries of the eigenvectors are their
 * weights (Golub and Welsch). */
static void find_eigenvalues(size_t n, double *a, double *b, double *first)
{
    enum { SWEEPS = 40 };
    for (size_t i = 0; i < n; i++)
        first[i] = i == 0;
    b[n - 1] = 0;
    for (size_t from = 0; from < n; from++)
        for (int i = 0; i < SWEEPS; i++) {
            size_t to = from;
            while (to + 1 < n && fabs(b[to]) > GSL_DBL_EPSILON * (fabs(a[to]) + fabs(a[to + 1])))
                to++;
            if (to == from)
                break;
            ql_sweep(a, b, first, from, to);
        }
}

/* Write the Gauss rule with this recurrence to q and p, scaled to the interval from 0 to mu and to
 * the total weight `sum`. */
static void find_gauss_nodes(size_t few, double *here, double *beside, double sum, double mu, double *q, double *p)
{
    double first[MOST_FEW];
    find_eigenvalues(few, here, beside, first);
    for (size_t j = 0; j < few; j++) {
        p[j] = here[j] * mu;
        q[j] = sum * first[j] * first[j];
    }
}

/* Write the few nodes that replace all nodes up to mu to q and p. */
static void find_few_nodes(double beta, double step, double mu, size_t few, double *q, double *p)
{
    const double sum = factor_of(beta, step) * pow(mu, 1 + beta) / -expm1(-(1 + beta) * step);
    double here[MOST_FEW], beside[MOST_FEW];
    for (size_t j = 0; j < few; j++)
        find_recurrence(beta, step, j, &here[j], &beside[j]);
    find_gauss_nodes(few, here, beside, sum, mu, q, p);
}

size_t fvi_lobatto_few_nodes(size_t s, double beta, double N, double tolerance, double *q, double *p, double *a,
                             size_t stride)
{
    if (beta == 0 || beta == -1 || N < LONG)
        return fvi_lobatto_nodes(s, beta, N, tolerance, 0, q, NULL, p, a, stride);
    const fvi_lobatto_span span = fvi_lobatto_span_of(s, beta, beta, N, tolerance, 1);
    const double slow = log(SLOW / N), factor = factor_of(beta, span.step);
    const size_t few = count_few_nodes(beta, span.step, tolerance), Q = few + (size_t)ceil((span.last - slow) / span.step);
    if (!q)
        return Q;
    find_few_nodes(beta, span.step, exp(slow), few, q, p);
    for (size_t j = few; j < Q; j++) {
        const double mu = exp(slow + (double)(j - few + 1) * span.step);
        q[j] = factor * pow(mu, 1 + beta);
        p[j] = mu;
    }
    fvi_lobatto_solve_nodes(s, Q, p, a, stride);
    return Q;
}

/* ---- fewer nodes of any weights ---- */

/* Compute the recurrence of a discrete measure with the weights w at x by Stieltjes's method. The weights have the sum
 * 1, and `slow` is mu N of the largest node. Return the number of Gauss nodes that is enough for the tolerance. */
static size_t find_recurrence_of(size_t count, const double *x, const double *w, double slow, double tolerance,
                                 double *here, double *beside)
{
    double polynomial[2][MOST_SLOW] = { { 0 } }, left = 1, before = 0;
    size_t k = 0;
    for (size_t j = 0; j < count; j++)
        polynomial[0][j] = sqrt(w[j]);
    for (; left > tolerance / 10 && k < MOST_FEW; k++) {
        double *now = polynomial[k % 2], *other = polynomial[1 - k % 2], mean = 0, square = 0;
        for (size_t j = 0; j < count; j++)
            mean += x[j] * now[j] * now[j];
        for (size_t j = 0; j < count; j++) { /* the polynomial before the last is overwritten by the next one */
            other[j] = (x[j] - mean) * now[j] - before * other[j];
            square += other[j] * other[j];
        }
        here[k] = mean;
        beside[k] = before = sqrt(square);
        for (size_t j = 0; j < count; j++)
            other[j] /= before;
        left *= slow * slow * square / (double)((2 * k + 2) * (2 * k + 1));
    }
    return k;
}

size_t fvi_lobatto_gauss(size_t count, double N, double tolerance, double *q, double *mu)
{
    size_t slow = 0, positive = 0;
    double x[MOST_SLOW], w[MOST_SLOW], here[MOST_FEW], beside[MOST_FEW], sum = 0;
    while (slow < count && mu[slow] * N <= SLOW) {
        sum += q[slow];
        positive += q[slow++] > 0;
    }
    if (N < LONG || slow <= MOST_FEW || slow > MOST_SLOW || (positive > 0 && positive < slow) || sum == 0)
        return count;
    const double scale = mu[slow - 1];
    for (size_t j = 0; j < slow; j++) {
        x[j] = mu[j] / scale;
        w[j] = q[j] / sum;
    }
    const size_t few = find_recurrence_of(slow, x, w, scale * N, tolerance, here, beside);
    find_gauss_nodes(few, here, beside, sum, scale, q, mu);
    memmove(q + few, q + slow, (count - slow) * sizeof *q);
    memmove(mu + few, mu + slow, (count - slow) * sizeof *mu);
    return count - slow + few;
}
