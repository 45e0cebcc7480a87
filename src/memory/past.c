/* src/memory/past.c -- What the body did before t = 0.                  [H 19] */
#include <fvi/past.h>

#include "system/digamma.h"
#include "system/vectors.h"

#include <gsl/gsl_machine.h>
#include <math.h>
#include <string.h>

enum { NODES = FVI_KERNEL_IMPULSE_NODES };

int fvi_initial_history_solvable(fvi_initial_history past, double alpha, double rho, double x0)
{
    return past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE || alpha <= 0.5 || rho == 0
           || x0 == 0;
}

//> amplitude
double fvi_initial_history_amplitude(fvi_initial_history past, double alpha, double x0, double v0)
{
    if (past == FVI_INITIAL_HISTORY_CAPUTO || alpha == 0.5)
        return 0;
    if (alpha > 0.5)
        return v0;
    return past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE ? x0 : 0; /* (19.3) */
}
//< amplitude

int fvi_initial_history_acts(fvi_initial_history past, double alpha)
{
    return fvi_initial_history_amplitude(past, alpha, 1, 1) != 0;
}

/* l_i(s), s in [0, 1], by Legendre's polynomials P_degree(2 s - 1): a product of
 * (s - c_j) / (c_i - c_j). Powers of s would cancel: with eight nodes, all but 1 / 3700 of
 * the terms of the first step. */
static void lagrange(size_t n, const double *c, size_t i, double *l)
{
    for (size_t degree = 0; degree < n; degree++)
        l[degree] = degree == 0;
    for (size_t j = 0; j < n; j++) {
        if (j == i)
            continue;
        const double middle = 0.5 - c[j], apart = c[i] - c[j];
        double below = 0; /* what (2 s - 1) P_degree has of P_{degree + 1} */
        for (size_t degree = 0; degree < n; degree++) {
            const double q = (double)degree;
            const double above =
                degree + 1 < n ? l[degree + 1] * (q + 1) / (2 * q + 3) : 0;
            const double mean = (below + above) / 2;
            below = l[degree] * (q + 1) / (2 * q + 1);
            l[degree] = (mean + middle * l[degree]) / apart;
        }
    }
}

/* l_i(c_j), 1 or 0 but for the roundings of lagrange. */
static double lagrange_at(size_t n, const double *l, double c)
{
    const double y = (c - 0.5) * 2;
    double lower = 0, P = 1, sum = 0;
    for (size_t degree = 0; degree < n; degree++) {
        const double q = (double)degree;
        sum += l[degree] * P;
        const double next = ((2 * q + 1) * y * P - q * lower) / (q + 1);
        lower = P;
        P = next;
    }
    return sum;
}

/* All l_i. Then Newton's step for the inverse of the matrix P_degree(2 c_i - 1), which basis is: with eight nodes the
 * products of lagrange alone leave 240 u in the first step. */
static void prepare_basis(const double *c, fvi_kernel_impulse *pull)
{
    const size_t n = pull->nodes;
    double l[NODES][NODES];
    for (size_t i = 0; i < n; i++)
        lagrange(n, c, i, l[i]);
    for (size_t i = 0; i < n; i++)
        for (size_t degree = 0; degree < n; degree++)
            pull->basis[degree][i] = l[i][degree];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            const double off = lagrange_at(n, l[i], c[j]) - (i == j);
            for (size_t degree = 0; degree < n; degree++)
                pull->basis[degree][i] -= off * l[j][degree];
        }
}

/* l_i(0): for alpha = 1 the pull is one impulse there. */
static double lagrange_at_zero(size_t n, const double *c, size_t i)
{
    double value = 1;
    for (size_t j = 0; j < n; j++)
        if (j != i)
            value *= -c[j] / (c[i] - c[j]);
    return value;
}

/* int_0^1 s^e P_degree(2 s - 1) ds is this part of that of degree - 1. */
static double part_of_lower(double e, size_t degree)
{
    return (e - (double)degree + 1) / (e + (double)degree + 1);
}

/* int_0^1 y^j P_degree(y) dy, j + degree even, from that of degree - 2, and of degree 0 or
 * 1 from anything. It is 0 where degree > j. */
static double power_times_legendre(size_t j, size_t degree, double lower)
{
    const double above = (double)j + (double)degree + 1;
    return degree < 2 ? 1 / above
                      : lower * ((double)j - (double)degree + 2) / above;
}

/* pull->series: the binomial series of (1 + x y)^e, times those integrals. */
static void prepare_series(fvi_kernel_impulse *pull)
{
    double binomial = 1;
    for (size_t j = 0; j < FVI_KERNEL_IMPULSE_TERMS; j++) {
        double integral = 0;
        for (size_t degree = j % 2; degree < pull->nodes; degree += 2) {
            integral = power_times_legendre(j, degree, integral);
            pull->series[j][degree / 2] = binomial * integral;
        }
        binomial *= (pull->e - (double)j) / (double)(j + 1);
    }
}

void fvi_kernel_impulse_prepare(double alpha, size_t n, const double *c,
                      fvi_kernel_impulse *pull)
{
    const double e = alpha < 0.5 ? -2 * alpha : 1 - 2 * alpha;
    const double whole = 1 / tgamma(2 + e); /* int_0^1 s^e / Gamma(1 + e) ds */
    *pull = (fvi_kernel_impulse){ .e = e, .size = (1 + e) * whole, .nodes = n };
    prepare_series(pull);
    prepare_basis(c, pull);
    for (size_t i = 0; i < n; i++) {
        double moment = whole;
        for (size_t degree = 0; degree < n; degree++) {
            if (degree > 0)
                moment *= part_of_lower(e, degree);
            pull->first[i] += pull->basis[degree][i] * moment;
        }
        if (pull->size == 0)
            pull->first[i] = lagrange_at_zero(n, c, i);
    }
}

//> impulses
/* moments[degree] = int_0^1 (k + s)^e P_degree(2 s - 1) ds, k > 0, by the binomial series
 * about k + 1/2. Its terms fall at least like (2 k + 1)^-j; the first that is left out is
 * below u / 8, and it is the 37th at most. No term waits for a division. Term j has degrees of the parity of j only;
 * degrees that the nodes do not reach have zeros, so all of one parity are summed side by side. */
static inline void legendre_moments(const fvi_kernel_impulse *pull, size_t k, double *moments)
{
    const double middle = (double)k + 0.5, x = 0.5 / middle;
    const double scale = pow(middle, pull->e);
    double x_j = 1, sum[2][NODES / 2] = { { 0 } };
    for (size_t j = 0; j < FVI_KERNEL_IMPULSE_TERMS; j++, x_j *= x) {
        const double *series = pull->series[j];
        if (!(fabs(series[0] * x_j) > GSL_DBL_EPSILON / 16))
            break;
#pragma omp simd
        for (size_t l = 0; l < NODES / 2; l++)
            sum[j % 2][l] += series[l] * x_j;
    }
    for (size_t degree = 0; degree < NODES; degree++)
        moments[degree] = sum[degree % 2][degree / 2] * scale;
}

/* The impulses of all nodes side by side, from zeros. */
FVI_VECTORS static void find_impulses(const fvi_kernel_impulse *pull, size_t k, double *impulse)
{
    double moments[NODES];
    legendre_moments(pull, k, moments);
    for (size_t degree = 0; degree < pull->nodes; degree++) {
        const double moment = pull->size * moments[degree];
#pragma omp simd
        for (size_t i = 0; i < NODES; i++)
            impulse[i] += pull->basis[degree][i] * moment;
    }
}

void fvi_kernel_impulses(const fvi_kernel_impulse *pull, size_t k, double *impulse)
{
    double all[NODES] = { 0 };
    if (k > 0 && pull->size != 0) /* alpha = 1: all was at t = 0 */
        find_impulses(pull, k, all);
    memcpy(impulse, k > 0 ? all : pull->first, pull->nodes * sizeof *impulse);
}
//< impulses

/* What legendre_moments sums, differentiated by e, and those sums: term by term. */
static void legendre_moments_rate(double e, size_t k, size_t count,
                                  double *moments, double *rates)
{
    const double middle = 0.5 + (double)k, power = pow(middle, e);
    double term = 1, slope = 0;
    for (size_t degree = 0; degree < count; degree++)
        moments[degree] = rates[degree] = 0;
    for (size_t j = 0; fabs(term) + fabs(slope) > GSL_DBL_EPSILON / 16 || j < 2;
         j++) {
        double integral = 0;
        for (size_t degree = j % 2; degree < count; degree += 2) {
            integral = power_times_legendre(j, degree, integral);
            moments[degree] += term * integral;
            rates[degree] += slope * integral;
        }
        const double by = (double)(j + 1) * 2 * middle;
        slope = (slope * (e - (double)j) + term) / by;
        term *= (e - (double)j) / by;
    }
    for (size_t degree = 0; degree < count; degree++) {
        rates[degree] = (rates[degree] + log(middle) * moments[degree]) * power;
        moments[degree] *= power;
    }
}

/* The same for k = 0, divided by Gamma(1 + e), which leaves no pole at e = -1. */
static void first_moments_rate(double e, size_t count, double *rates)
{
    double moment = 1 / tgamma(2 + e);
    rates[0] = -fvi_digamma(2 + e) * moment;
    for (size_t degree = 1; degree < count; degree++) {
        const double by = e + 1 + (double)degree;
        const double part = part_of_lower(e, degree);
        rates[degree] =
            rates[degree - 1] * part + moment * 2 * (double)degree / (by * by);
        moment *= part;
    }
}

//> impulses-rate
/* 1 / Gamma(z) is z / Gamma(1 + z), whose slope is finite at z = 1 + e = 0. */
void fvi_kernel_impulses_by_order(const fvi_kernel_impulse *pull, size_t k, double *rate)
{
    const double z = 1 + pull->e;
    const double slope = (1 - z * fvi_digamma(1 + z)) / tgamma(1 + z);
    double moments[NODES], rates[NODES];
    if (k == 0)
        first_moments_rate(pull->e, pull->nodes, rates);
    else
        legendre_moments_rate(pull->e, k, pull->nodes, moments, rates);
    for (size_t degree = 0; k > 0 && degree < pull->nodes; degree++)
        rates[degree] = pull->size * rates[degree] + slope * moments[degree];
    for (size_t i = 0; i < pull->nodes; i++) {
        rate[i] = 0;
        for (size_t degree = 0; degree < pull->nodes; degree++)
            rate[i] += pull->basis[degree][i] * rates[degree]; /* (23.12) */
    }
}
//< impulses-rate
