/* src/memory/past.c -- What the body did before t = 0.                  [Chapter 19] */
#include <fvi/past.h>

#include <gsl/gsl_machine.h>
#include <gsl/gsl_sf_psi.h>
#include <math.h>
#include <string.h>

int fvi_past_has_solution(fvi_past past, double alpha, double rho, double x0)
{
    return past != FVI_PAST_RIEMANN_LIOUVILLE || alpha <= 0.5 || rho == 0
           || x0 == 0;
}

//> amplitude
double fvi_past_amplitude(fvi_past past, double alpha, double x0, double v0)
{
    if (past == FVI_PAST_CAPUTO || alpha == 0.5)
        return 0;
    if (alpha > 0.5)
        return v0;
    return past == FVI_PAST_RIEMANN_LIOUVILLE ? x0 : 0; /* (19.3) */
}
//< amplitude

int fvi_past_pulls(fvi_past past, double alpha)
{
    return fvi_past_amplitude(past, alpha, 1, 1) != 0;
}

/* l_i as a polynomial in s - origin: a product of (s - c_j) / (c_i - c_j). */
static void lagrange(size_t n, const double *c, size_t i, double origin,
                     double *l)
{
    for (size_t degree = 0; degree < n; degree++)
        l[degree] = degree == 0;
    for (size_t j = 0; j < n; j++) {
        if (j == i)
            continue;
        for (size_t degree = n - 1; degree > 0; degree--)
            l[degree] =
                (l[degree - 1] - (c[j] - origin) * l[degree]) / (c[i] - c[j]);
        l[0] *= (origin - c[j]) / (c[i] - c[j]);
    }
}

void fvi_past_prepare(double alpha, size_t n, const double *c,
                      fvi_past_pull *pull)
{
    const double e = alpha < 0.5 ? -2 * alpha : 1 - 2 * alpha;
    const double whole = 1 / tgamma(2 + e); /* int_0^1 s^e / Gamma(1 + e) ds */
    *pull = (fvi_past_pull){
        .e = e, .size = (1 + e) * whole, .binomial = { 1 }, .nodes = n
    };
    for (size_t j = 0; j + 1 < FVI_PAST_TERMS; j++)
        pull->binomial[j + 1] =
            pull->binomial[j] * (e - (double)j) / (double)(j + 1);
    for (size_t i = 0; i < n; i++) {
        double l[FVI_PAST_NODES];
        lagrange(n, c, i, 0, l);
        pull->first[i] = l[0] * whole;
        for (size_t degree = 1; degree < n; degree++)
            pull->first[i] += l[degree] * pull->size / (1 + e + (double)degree);
        lagrange(n, c, i, 0.5, pull->basis[i]);
    }
}

//> impulses
/* moments[degree] = int (k + 1/2 + x)^e x^degree dx over |x| <= 1/2, k > 0, by the
 * binomial series. Its terms fall at least like (2 k + 1)^-j; the first that is left
 * out is below u / 8, and it is the 37th at most. No term waits for a division. */
static void power_moments(const fvi_past_pull *pull, size_t k, double *moments)
{
    const double middle = (double)k + 0.5, x = 0.5 / middle;
    double term = 1, x_j = 1, scale = pow(middle, pull->e);
    for (size_t j = 0; fabs(term) > GSL_DBL_EPSILON / 16;) {
        for (size_t degree = j % 2; degree < pull->nodes; degree += 2)
            moments[degree] += term / (double)(j + degree + 1);
        if (++j == FVI_PAST_TERMS)
            break;
        x_j *= x;
        term = pull->binomial[j] * x_j;
    }
    for (size_t degree = 0; degree < pull->nodes; degree++, scale /= 2)
        moments[degree] *= scale;
}

void fvi_past_impulses(const fvi_past_pull *pull, size_t k, double *impulse)
{
    if (k == 0) {
        memcpy(impulse, pull->first, pull->nodes * sizeof *impulse);
        return;
    }
    double moments[FVI_PAST_NODES] = { 0 };
    if (pull->size != 0) /* alpha = 1: all was at t = 0 */
        power_moments(pull, k, moments);
    for (size_t i = 0; i < pull->nodes; i++) {
        impulse[i] = 0;
        for (size_t degree = 0; degree < pull->nodes; degree++)
            impulse[i] +=
                pull->basis[i][degree] * (pull->size * moments[degree]);
    }
}
//< impulses

/* What power_moments sums, differentiated by e, and those sums: term by term. */
static void power_moments_rate(double e, size_t k, size_t count,
                               double *moments, double *rates)
{
    const double middle = 0.5 + (double)k, power = pow(middle, e);
    double term = 1, slope = 0;
    for (size_t degree = 0; degree < count; degree++)
        moments[degree] = rates[degree] = 0;
    for (size_t j = 0; fabs(term) + fabs(slope) > GSL_DBL_EPSILON / 16 || j < 2;
         j++) {
        for (size_t degree = j % 2; degree < count; degree += 2) {
            moments[degree] += term / (double)(j + degree + 1);
            rates[degree] += slope / (double)(j + degree + 1);
        }
        const double by = (double)(j + 1) * 2 * middle;
        slope = (slope * (e - (double)j) + term) / by;
        term *= (e - (double)j) / by;
    }
    for (size_t degree = 0; degree < count; degree++) {
        const double scale = power * exp2(-(double)degree);
        rates[degree] = (rates[degree] + log(middle) * moments[degree]) * scale;
        moments[degree] *= scale;
    }
}

//> impulses-rate
/* 1 / Gamma(z) is z / Gamma(1 + z), whose slope is finite at z = 1 + e = 0. */
void fvi_past_impulses_rate(const fvi_past_pull *pull, const double *c,
                            size_t k, double *rate)
{
    const double e = pull->e, z = 1 + e;
    const double slope = (1 - z * gsl_sf_psi(1 + z)) / tgamma(1 + z);
    double moments[FVI_PAST_NODES], rates[FVI_PAST_NODES], l[FVI_PAST_NODES];
    if (k > 0)
        power_moments_rate(e, k, pull->nodes, moments, rates);
    for (size_t i = 0; i < pull->nodes; i++) {
        rate[i] = 0;
        for (size_t degree = 0; k > 0 && degree < pull->nodes; degree++)
            rate[i] += pull->basis[i][degree] /* (23.12) */
                       * (pull->size * rates[degree] + slope * moments[degree]);
        if (k > 0)
            continue;
        lagrange(pull->nodes, c, i, 0, l);
        rate[i] = -l[0] * gsl_sf_psi(1 + z) / tgamma(1 + z);
        for (size_t degree = 1; degree < pull->nodes; degree++) {
            const double by = z + (double)degree;
            rate[i] += l[degree] * (slope - pull->size / by) / by;
        }
    }
}
//< impulses-rate
