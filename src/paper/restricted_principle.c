/* src/paper/restricted_principle.c -- Compute the action of two curves and its variation.        [H 3] */
#include <fvi/paper/restricted_principle.h>

#include <fvi/paper/fractional_derivative.h>
#include "system/fail.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* ---- sums of powers ---- */

/* Return the factor of s^(e - beta) in the derivative of order beta of s^e. */
static double factor(double e, double beta)
{
    double c = 0;
    fvi_power_derivative(beta, e, 1, &c); /* (1.6) at s = 1 */
    return c;
}

double fvi_powers_derivative(const fvi_powers *f, double beta, double s)
{
    double sum = 0;
    for (size_t j = 0; j < f->terms; j++) {
        double e = f->exponent[j], c = f->coefficient[j] * factor(e, beta);
        if (c != 0)
            sum += c * pow(s, e - beta); /* (3.2) */
    }
    return sum;
}

int fvi_powers_reflect(size_t count, double T, const double *c, double *out)
{
    if (!c || !out)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (count == 0)
        FVI_FAIL("count must be at least 1", FVI_EINVAL);
    if (!gsl_finite(T))
        FVI_FAIL("T must be finite", FVI_EDOM);
    for (size_t n = 0; n < count; n++)
        out[n] = c[n];
    for (size_t n = 0; n + 1 < count; n++) /* Horner's scheme: powers of s - T instead of s */
        for (size_t i = count - 1; i-- > n;)
            out[i] += T * out[i + 1];
    for (size_t n = 1; n < count; n += 2) /* and s - T = -(T - s) */
        out[n] = -out[n];
    return FVI_SUCCESS;
}

int fvi_damped_powers(double alpha, double C, double R, size_t order,
                      double *exponent, double *coefficient)
{
    if (!exponent || !coefficient)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(order >= 1 && order <= 32))
        FVI_FAIL("order must be between 1 and 32", FVI_EINVAL);
    if (!(alpha >= 0 && alpha < 1))
        FVI_FAIL("alpha must be in [0, 1)", FVI_EDOM);
    if (!gsl_finite(C) || !gsl_finite(R))
        FVI_FAIL("C and R must be finite", FVI_EDOM);
    //> series
    double first = 1; /* (-R)^k, j = 0 */
    for (size_t k = 0; k < order; k++, first *= -R) {
        double c = first; /* (-1)^{j+k} binom(j+k, k) C^j R^k */
        for (size_t j = 0; j < order; j++) {
            size_t i = k * order + j;
            exponent[i] = 1 + 2 * (double)j + (2 - 2 * alpha) * (double)k;
            coefficient[i] = c / tgamma(exponent[i] + 1); /* (3.9) */
            c *= -C * (double)(j + 1 + k) / (double)(j + 1);
        }
    }
    //< series
    return FVI_SUCCESS;
}

/* ---- the action ---- */

/* A curve at one time, as seen from its own end: f, df/ds, and the derivative of order alpha. */
typedef struct {
    double value, slope, fractional;
} sample;

static sample sample_at(const fvi_powers *f, const double *factors,
                        double alpha, double s)
{
    sample z = { 0, 0, 0 };
    for (size_t j = 0; j < f->terms; j++) {
        double e = f->exponent[j], c = f->coefficient[j];
        double power = c * pow(s, e); /* one power for all three */
        z.value += power;
        z.slope += e * power / s;
        z.fractional += factors[j] * power;
    }
    z.fractional *= pow(s, -alpha);
    return z;
}

/* Compute the integrand of the action. d/dt is d/ds for x and xi, and -d/ds for y and eta. In the product of two
 * velocities of the same end the signs cancel. z[0], z[1], z[2], z[3] are x, y and their variations xi, eta. */
static int density(const fvi_system *system, const sample *z, double *f)
{
    const double m = *system->mass, rho = *system->damping;
    double sum = -z[0].fractional * rho * z[1].fractional;
    for (size_t i = 0; i < 2; i++) {
        double U;
        int status = fvi_potential_value(system, &z[i].value, &U);
        if (status)
            return status;
        sum += m * z[i].slope * z[i].slope / 2 - U;
    }
    *f = sum; /* (3.3) */
    return FVI_SUCCESS;
}

static int density_variation(const fvi_system *system, const sample *z,
                             double *f)
{
    const double m = *system->mass, rho = *system->damping;
    double sum = -z[2].fractional * rho * z[1].fractional
                 - z[0].fractional * rho * z[3].fractional;
    for (size_t i = 0; i < 2; i++) {
        double dU;
        int status = fvi_potential_gradient(system, &z[i].value, &dU);
        if (status)
            return status;
        sum += m * z[i].slope * z[i + 2].slope - dU * z[i + 2].value;
    }
    *f = sum; /* (3.5) */
    return FVI_SUCCESS;
}

enum { HALF = 96, PER_UNIT = 16 }; /* nodes i/16, i = -96, ..., 96 */

//> rule
/* Integrate with s = T/(1 + exp(-pi sinh tau)). T - s is computed without a subtraction. */
static int integrate(const fvi_system *system, double alpha, double T,
                     size_t count, const fvi_powers *const *curve,
                     double *const *factors, double *out)
{
    double sum = 0;
    for (int i = -HALF; i <= HALF; i++) {
        double tau = (double)i / PER_UNIT, v = M_PI * sinh(tau);
        double p = 1 / (1 + exp(-v)), q = 1 / (1 + exp(v));
        double weight = T * M_PI * cosh(tau) * p * q / PER_UNIT;
        sample z[4];
        for (size_t c = 0; c < count; c++)
            z[c] = sample_at(curve[c], factors[c], alpha,
                             c % 2 == 0 ? T * p : T * q);
        double f;
        int status = count == 2 ? density(system, z, &f)
                                : density_variation(system, z, &f);
        if (status)
            return status;
        sum += weight * f;
    }
    *out = sum;
    return FVI_SUCCESS;
}
//< rule

static int check_curve(const fvi_powers *f)
{
    if (!f || (f->terms && (!f->exponent || !f->coefficient)))
        FVI_FAIL("null pointer", FVI_EFAULT);
    for (size_t j = 0; j < f->terms; j++) {
        double e = f->exponent[j];
        if (!(e == 0 || (e >= 1 && e <= 150)))
            FVI_FAIL("an exponent must be 0 or in [1, 150]", FVI_EDOM);
        if (!gsl_finite(f->coefficient[j]))
            FVI_FAIL("a coefficient must be finite", FVI_EDOM);
    }
    return FVI_SUCCESS;
}

static int check(const fvi_system *system, double alpha, double T, size_t count,
                 const fvi_powers *const *curve, const double *out)
{
    int status = fvi_system_require(system);
    if (!status && !out)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!status && system->d != 1)
        FVI_FAIL("the action is written for one dimension", FVI_EINVAL);
    if (!status && !(alpha >= 0 && alpha < 1))
        FVI_FAIL("alpha must be in [0, 1)", FVI_EDOM);
    if (!status && !(gsl_finite(T) && T > 0))
        FVI_FAIL("T must be finite and positive", FVI_EDOM);
    for (size_t c = 0; c < count && !status; c++)
        status = check_curve(curve[c]);
    return status;
}

/* Do the work of both public functions: check the arguments, compute the factors, and integrate. */
static int evaluate(const fvi_system *system, double alpha, double T,
                    size_t count, const fvi_powers *const *curve, double *out)
{
    int status = check(system, alpha, T, count, curve, out);
    if (status)
        return status;
    int all = 1;
    double *factors[4] = { NULL, NULL, NULL, NULL };
    for (size_t c = 0; c < count; c++) {
        factors[c] = calloc(curve[c]->terms + 1, sizeof *factors[c]);
        all &= factors[c] != NULL;
        for (size_t j = 0; factors[c] && j < curve[c]->terms; j++)
            factors[c][j] = factor(curve[c]->exponent[j], alpha);
    }
    if (all)
        status = integrate(system, alpha, T, count, curve, factors, out);
    for (size_t c = 0; c < count; c++)
        free(factors[c]);
    if (!all)
        FVI_FAIL("no memory for the factors", FVI_ENOMEM);
    return status;
}

int fvi_action(const fvi_system *system, double alpha, double T,
               const fvi_powers *x, const fvi_powers *y, double *S)
{
    const fvi_powers *const curve[] = { x, y };
    return evaluate(system, alpha, T, 2, curve, S);
}

int fvi_action_variation(const fvi_system *system, double alpha, double T,
                         const fvi_powers *x, const fvi_powers *y,
                         const fvi_powers *xi, const fvi_powers *eta,
                         double *dS)
{
    const fvi_powers *const curve[] = { x, y, xi, eta };
    return evaluate(system, alpha, T, 4, curve, dS);
}
