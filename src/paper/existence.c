/* src/paper/existence.c -- Iterate Picard's map for motion with memory.   [H 15] */
#include <fvi/paper/existence.h>

#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>

/* ---- the product trapezoidal rule ---- */

//> bend
/* Return (1 + z)^p - 1 - p z for |z| <= 1/2 by its series, because the difference would cancel. */
static double bend(double p, double z)
{
    double term = p * (p - 1) / 2 * z * z, sum = 0;
    for (int m = 2; fabs(term) > 0x1p-60 * fabs(sum); m++) {
        sum += term;
        term *= (p - m) / (m + 1) * z;
    }
    return sum;
}
//< bend

/* Compute the weights of (15.10) without h^gamma / Gamma(2 + gamma): middle[n] belongs to the node n steps ago, and
 * first[n] to the node n = k steps ago, at t = 0. */
static void weights(double gamma, size_t N, double *middle, double *first)
{
    const double p = gamma + 1;
    middle[0] = 1, first[0] = 0;
    middle[1] = 2 * expm1(gamma * M_LN2), first[1] = gamma;
    //> weights
    for (size_t n = 2; n <= N; n++) {
        double z = 1 / (double)n, scale = pow((double)n, p);
        first[n] = scale * bend(p, -z);            /* a_n */
        middle[n] = scale * bend(p, z) + first[n]; /* b_n */
    }
    //< weights
}

static int check_grid(double gamma, double h, size_t N, const double *v,
                      const double *out)
{
    if (!v || !out)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (N == 0 || N >= SIZE_MAX / 4 / sizeof *v - 1)
        FVI_FAIL("N must be at least 1 and N + 1 addressable", FVI_EINVAL);
    if (!(gamma >= 0 && gamma <= 2))
        FVI_FAIL("the order must be in range", FVI_EDOM);
    if (!(gsl_finite(h) && h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    return FVI_SUCCESS;
}

/* Apply (15.10) without checks. work has room for 2 (N + 1) numbers. */
static void integrate(double gamma, double h, size_t N, const double *v,
                      double *work, double *out)
{
    double *middle = work, *first = work + N + 1;
    double scale = pow(h, gamma) / tgamma(2 + gamma);
    weights(gamma, N, middle, first);
    //> rule
    out[0] = gamma == 0 ? v[0] : 0;
    for (size_t k = 1; k <= N; k++) {
        double sum = first[k] * v[0];
        for (size_t j = 1; j <= k; j++)
            sum += middle[k - j] * v[j];
        out[k] = scale * sum; /* (15.10) */
    }
    //< rule
}

int fvi_fractional_integral(double gamma, double h, size_t N, const double *v,
                            double *out)
{
    int status = check_grid(gamma, h, N, v, out);
    if (status)
        return status;
    double *work = malloc(2 * (N + 1) * sizeof *work);
    if (!work)
        FVI_FAIL("no memory for the weights", FVI_ENOMEM);
    integrate(gamma, h, N, v, work, out);
    free(work);
    return FVI_SUCCESS;
}

/* ---- the Picard map ---- */

static int check_problem(const fvi_picard_problem *p)
{
    if (!p || !p->f)
        FVI_FAIL("there is no problem", FVI_EFAULT);
    if (!(p->alpha >= 0 && p->alpha <= 1))
        FVI_FAIL("alpha must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(p->R) && p->R >= 0))
        FVI_FAIL("R must be finite and not negative", FVI_EDOM);
    if (!(gsl_finite(p->x0) && gsl_finite(p->v0)))
        FVI_FAIL("the start must be finite", FVI_EDOM);
    return FVI_SUCCESS;
}

int fvi_picard(const fvi_picard_problem *p, double h, size_t N, const double *v,
               double *x, double *next)
{
    int status = check_problem(p);
    if (!status)
        status = check_grid(1, h, N, v, next);
    if (status)
        return status;
    if (!x)
        FVI_FAIL("null pointer", FVI_EFAULT);
    double *f = malloc(4 * (N + 1) * sizeof *f);
    if (!f)
        FVI_FAIL("no memory", FVI_ENOMEM);
    double *impulse = f + N + 1, *work = impulse + N + 1;
    //> picard
    integrate(1, h, N, v, work, x); /* x - x0 = I v */
    for (size_t k = 0; k <= N; k++) {
        x[k] += p->x0;
        f[k] = p->f(x[k], v[k], p->params);
    }
    integrate(1, h, N, f, work, impulse);
    integrate(2 - 2 * p->alpha, h, N, v, work, next);
    for (size_t k = 0; k <= N; k++)
        next[k] = p->v0 + impulse[k] - p->R * next[k]; /* (15.4) */
    //< picard
    free(f);
    for (size_t k = 0; k <= N; k++)
        if (!gsl_finite(x[k]) || !gsl_finite(next[k]))
            FVI_FAIL("a value is not finite", FVI_EOVRFLW);
    return FVI_SUCCESS;
}

/* ---- its constants ---- */

//> constants
double fvi_picard_constant(double alpha, double R, double Kx, double Kv,
                           double d)
{
    double gamma = 2 - 2 * alpha;
    return Kx * d * d / 2 + Kv * d + R * pow(d, gamma) / tgamma(1 + gamma);
}

double fvi_picard_weighted(double alpha, double R, double Kx, double Kv,
                           double lambda)
{
    return Kx / (lambda * lambda) + Kv / lambda
           + R * pow(lambda, 2 * alpha - 2);
}
//< constants

/* Return ln(a^n / n!), with 0^0 = 1. */
static double log_share(double a, size_t n)
{
    return (n > 0 ? (double)n * log(a) : 0) - lgamma((double)n + 1);
}

double fvi_picard_bound(double alpha, double R, double Kx, double Kv, double d,
                        size_t n)
{
    const double gamma = 2 - 2 * alpha;
    double sum = 0;
    //> bound
    for (size_t i = 0; i <= n; i++)
        for (size_t j = 0; i + j <= n; j++) {
            size_t k = n - i - j;
            double shares = log_share(Kx * d * d, i) + log_share(Kv * d, j)
                            + log_share(R * pow(d, gamma), k);
            double power = 2 * (double)i + (double)j + gamma * (double)k;
            sum += exp(shares + lgamma((double)n + 1) - lgamma(1 + power));
        }
    //< bound
    return sum; /* (15.8) */
}
