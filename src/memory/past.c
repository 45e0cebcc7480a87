/* src/memory/past.c -- Compute the force of the initial history, that is, of the motion before t = 0. [H 19] */
#include <fvi/past.h>

#include "system/digamma.h"
#include "system/lagrange_polynomial.h"
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

/* Compute the Lagrange polynomial l_i(s), s in [0, 1], as a sum of Legendre polynomials P_degree(2 s - 1), by
 * multiplying the factors (s - c_j) / (c_i - c_j). A sum of powers of s would lose digits by cancellation: with eight
 * nodes, the impulses of the first step would be 1 / 3700 of its terms. */
static void lagrange(size_t n, const double *c, size_t i, double *l)
{
    for (size_t degree = 0; degree < n; degree++)
        l[degree] = degree == 0;
    for (size_t j = 0; j < n; j++) {
        if (j == i)
            continue;
        const double middle = 0.5 - c[j], apart = c[i] - c[j];
        double below = 0; /* coefficient of P_degree in l[degree - 1] (2 s - 1) P_{degree - 1} */
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

/* Return l_i(c) by the recurrence of the Legendre polynomials. At the nodes it is 1 or 0, up to the
 * rounding errors of lagrange. */
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

/* Compute basis, which holds all l_i. It is the inverse of the matrix P_degree(2 c_i - 1), so one Newton step for the
 * inverse corrects it. Without this step eight nodes have an error of 240 u in the first step. */
static void prepare_basis(const double *c, fvi_kernel_impulse *table)
{
    const size_t n = table->nodes;
    double l[NODES][NODES];
    for (size_t i = 0; i < n; i++)
        lagrange(n, c, i, l[i]);
    for (size_t i = 0; i < n; i++)
        for (size_t degree = 0; degree < n; degree++)
            table->basis[degree][i] = l[i][degree];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            const double off = lagrange_at(n, l[i], c[j]) - (i == j);
            for (size_t degree = 0; degree < n; degree++)
                table->basis[degree][i] -= off * l[j][degree];
        }
}

/* Return the ratio of int_0^1 s^e P_degree(2 s - 1) ds to the same integral with degree - 1. */
static double part_of_lower(double e, size_t degree)
{
    return (e - (double)degree + 1) / (e + (double)degree + 1);
}

/* Return int_0^1 y^j P_degree(y) dy for even j + degree. `lower` is the same integral with degree - 2; it is not used
 * for degree 0 and 1. The integral is 0 for degree > j. */
static double power_times_legendre(size_t j, size_t degree, double lower)
{
    const double above = (double)j + (double)degree + 1;
    return degree < 2 ? 1 / above
                      : lower * ((double)j - (double)degree + 2) / above;
}

/* Fill `series` with the binomial series of (1 + x y)^e times these integrals. */
static void prepare_series(fvi_kernel_impulse *table)
{
    double binomial = 1;
    for (size_t j = 0; j < FVI_KERNEL_IMPULSE_TERMS; j++) {
        double integral = 0;
        for (size_t degree = j % 2; degree < table->nodes; degree += 2) {
            integral = power_times_legendre(j, degree, integral);
            table->series[j][degree / 2] = binomial * integral;
        }
        binomial *= (table->e - (double)j) / (double)(j + 1);
    }
}

void fvi_kernel_impulse_prepare(double alpha, size_t n, const double *c,
                      fvi_kernel_impulse *table)
{
    const double e = alpha < 0.5 ? -2 * alpha : 1 - 2 * alpha;
    const double whole = 1 / tgamma(2 + e); /* int_0^1 s^e / Gamma(1 + e) ds */
    *table = (fvi_kernel_impulse){ .e = e, .size = (1 + e) * whole, .nodes = n };
    prepare_series(table);
    prepare_basis(c, table);
    for (size_t i = 0; i < n; i++) {
        double moment = whole;
        for (size_t degree = 0; degree < n; degree++) {
            if (degree > 0)
                moment *= part_of_lower(e, degree);
            table->first[i] += table->basis[degree][i] * moment;
        }
        if (table->size == 0) /* for alpha = 1 the initial-history force is one impulse at t = 0 */
            table->first[i] = fvi_lagrange_polynomial(n, c, i, 0);
    }
}

//> impulses
/* Compute moments[degree] = int_0^1 (k + s)^e P_degree(2 s - 1) ds for k > 0, by the binomial series about k + 1/2. The
 * terms decrease at least like (2 k + 1)^-j. The sum ends when a term is below u / 8, after 37 terms at most. The loop
 * contains no division. Term j contains only degrees with the parity of j, so all degrees of one parity are summed side
 * by side; degrees that the nodes do not reach have zeros. */
static inline void legendre_moments(const fvi_kernel_impulse *table, size_t k, double *moments)
{
    const double middle = (double)k + 0.5, x = 0.5 / middle;
    const double scale = pow(middle, table->e);
    double x_j = 1, sum[2][NODES / 2] = { { 0 } };
    for (size_t j = 0; j < FVI_KERNEL_IMPULSE_TERMS; j++, x_j *= x) {
        const double *series = table->series[j];
        if (!(fabs(series[0] * x_j) > GSL_DBL_EPSILON / 16))
            break;
#pragma omp simd
        for (size_t l = 0; l < NODES / 2; l++)
            sum[j % 2][l] += series[l] * x_j;
    }
    for (size_t degree = 0; degree < NODES; degree++)
        moments[degree] = sum[degree % 2][degree / 2] * scale;
}

/* Add the impulses of all nodes side by side. The caller has set impulse to zero. */
FVI_VECTORS static void find_impulses(const fvi_kernel_impulse *table, size_t k, double *impulse)
{
    double moments[NODES];
    legendre_moments(table, k, moments);
    for (size_t degree = 0; degree < table->nodes; degree++) {
        const double moment = table->size * moments[degree];
#pragma omp simd
        for (size_t i = 0; i < NODES; i++)
            impulse[i] += table->basis[degree][i] * moment;
    }
}

void fvi_kernel_impulses(const fvi_kernel_impulse *table, size_t k, double *impulse)
{
    double all[NODES] = { 0 };
    if (k > 0 && table->size != 0) /* for alpha = 1 the whole impulse acts at t = 0 */
        find_impulses(table, k, all);
    memcpy(impulse, k > 0 ? all : table->first, table->nodes * sizeof *impulse);
}
//< impulses

/* Compute the moments of legendre_moments and their derivatives by e, term by term. */
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

/* Compute the derivatives of the moments for k = 0, divided by Gamma(1 + e). This division removes the pole at e =
 * -1. */
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
/* The factor 1 / Gamma(z) is computed as z / Gamma(1 + z), whose derivative is finite at z = 1 + e = 0. */
void fvi_kernel_impulses_by_order(const fvi_kernel_impulse *table, size_t k, double *rate)
{
    const double z = 1 + table->e;
    const double slope = (1 - z * fvi_digamma(1 + z)) / tgamma(1 + z);
    double moments[NODES], rates[NODES];
    if (k == 0)
        first_moments_rate(table->e, table->nodes, rates);
    else
        legendre_moments_rate(table->e, k, table->nodes, moments, rates);
    for (size_t degree = 0; k > 0 && degree < table->nodes; degree++)
        rates[degree] = table->size * rates[degree] + slope * moments[degree];
    for (size_t i = 0; i < table->nodes; i++) {
        rate[i] = 0;
        for (size_t degree = 0; degree < table->nodes; degree++)
            rate[i] += table->basis[degree][i] * rates[degree]; /* (23.12) */
    }
}
//< impulses-rate
