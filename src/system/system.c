/* src/system/system.c -- A mechanical system, as data.                  [Chapter 2] */
#include <fvi/system.h>

#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <stdint.h>
#include <string.h>

int fvi_system_check(const fvi_system *s)
{
    if (!s || !s->mass || !s->damping)
        FVI_FAIL("a system needs masses and dampings", FVI_EFAULT);
    const fvi_potential *u = &s->potential;
    const size_t row = u->diagonals ? u->diagonals : s->d;
    if (s->d == 0 || s->d > SIZE_MAX / sizeof(double) / 8 / row)
        FVI_FAIL("the dimension must be at least 1 and a Hessian addressable",
                  FVI_EINVAL);
    if (!u->value != !u->gradient || !u->value != !u->hessian)
        FVI_FAIL("a potential needs value, gradient and hessian, or none",
                  FVI_EINVAL);
    for (size_t i = 0; i < s->d; i++) {
        if (!(gsl_finite(s->mass[i]) && s->mass[i] > 0))
            FVI_FAIL("a mass must be finite and positive", FVI_EDOM);
        if (!(gsl_finite(s->damping[i]) && s->damping[i] >= 0))
            FVI_FAIL("a damping must be finite and not negative", FVI_EDOM);
    }
    return FVI_SUCCESS;
}

double fvi_energy(const fvi_system *s, const double *x, const double *p)
{
    double kinetic = 0;
    for (size_t i = 0; i < s->d; i++)
        kinetic += p[i] / s->mass[i] * p[i];
    double potential = s->potential.value
                           ? s->potential.value(s->d, x, s->potential.params)
                           : 0;
    return kinetic / 2 + potential; /* (2.4) */
}

/* Diagonals are spread in place, from the last number up: nothing is written over
 * before it has been read. */
void fvi_hessian(const fvi_system *s, const double *x, double *H)
{
    const fvi_potential *u = &s->potential;
    const size_t d = s->d, m = u->diagonals;
    memset(H, 0, d * d * sizeof *H);
    if (u->hessian)
        u->hessian(d, x, u->params, H);
    for (size_t i = d; m > 0 && i-- > 0;)
        for (size_t j = i + (m < d - i ? m : d - i); j-- > i;) {
            double value = H[i * m + j - i];
            H[i * m + j - i] = 0;
            H[i * d + j] = H[j * d + i] = value;
        }
}

/* ---- one spring of stretch r: (c + g r^2) r, and what belongs to it ---- */

static double spring_energy(double c, double g, double r)
{
    return (c / 2 + g / 4 * r * r) * r * r;
}

static double spring_force(double c, double g, double r)
{
    return (c + g * r * r) * r;
}

static double spring_stiffness(double c, double g, double r)
{
    return c + 3 * g * r * r;
}

/* ---- harmonic and Duffing: a spring from each mass to its own origin ---- */

static double duffing_value(size_t d, const double *x, const void *params)
{
    const double *cg = params;
    double sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += spring_energy(cg[0], cg[1], x[i]);
    return sum;
}

static void duffing_gradient(size_t d, const double *x, const void *params,
                             double *grad)
{
    const double *cg = params;
    for (size_t i = 0; i < d; i++)
        grad[i] = spring_force(cg[0], cg[1], x[i]);
}

static void duffing_hessian(size_t d, const double *x, const void *params,
                            double *H)
{
    const double *cg = params;
    for (size_t i = 0; i < d; i++)
        H[i] = spring_stiffness(cg[0], cg[1], x[i]);
}

/* Of springs that are ready to use, duffing and chain: is there no r^4? */
static int springs_are_linear(const void *params)
{
    const double *cg = params;
    return cg[1] == 0;
}

fvi_potential fvi_potential_duffing(const double cg[2])
{
    return (fvi_potential){ .value = duffing_value,
                            .gradient = duffing_gradient,
                            .hessian = duffing_hessian,
                            .params = cg,
                            .quadratic = springs_are_linear,
                            .diagonals = 1 };
}

/* Harmonic has its own functions because its parameter is one number. */
static double harmonic_value(size_t d, const double *x, const void *params)
{
    const double cg[2] = { *(const double *)params, 0 };
    return duffing_value(d, x, cg);
}

static void harmonic_gradient(size_t d, const double *x, const void *params,
                              double *grad)
{
    const double c = *(const double *)params;
    for (size_t i = 0; i < d; i++)
        grad[i] = c * x[i];
}

static void harmonic_hessian(size_t d, const double *x, const void *params,
                             double *H)
{
    const double cg[2] = { *(const double *)params, 0 };
    duffing_hessian(d, x, cg, H);
}

static int always(const void *params)
{
    (void)params;
    return 1;
}

fvi_potential fvi_potential_harmonic(const double *c)
{
    return (fvi_potential){ .value = harmonic_value,
                            .gradient = harmonic_gradient,
                            .hessian = harmonic_hessian,
                            .params = c,
                            .quadratic = always,
                            .diagonals = 1 };
}

/* ---- pendulum ---- */

static double pendulum_value(size_t d, const double *x, const void *params)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++) {
        double s = sin(x[i] / 2);
        sum += 2 * s * s; /* 1 - cos x, without the cancellation at small x */
    }
    return *(const double *)params * sum;
}

static void pendulum_gradient(size_t d, const double *x, const void *params,
                              double *grad)
{
    for (size_t i = 0; i < d; i++)
        grad[i] = *(const double *)params * sin(x[i]);
}

static void pendulum_hessian(size_t d, const double *x, const void *params,
                             double *H)
{
    for (size_t i = 0; i < d; i++)
        H[i] = *(const double *)params * cos(x[i]);
}

fvi_potential fvi_potential_pendulum(const double *g)
{
    return (fvi_potential){ .value = pendulum_value,
                            .gradient = pendulum_gradient,
                            .hessian = pendulum_hessian,
                            .params = g,
                            .diagonals = 1 };
}

/* ---- chain: spring i ties mass i - 1 to mass i; -1 and d are the walls ---- */

static double stretch(size_t d, const double *x, size_t i)
{
    return (i < d ? x[i] : 0) - (i > 0 ? x[i - 1] : 0);
}

static double chain_value(size_t d, const double *x, const void *params)
{
    const double *cg = params;
    double sum = 0;
    for (size_t i = 0; i <= d; i++)
        sum += spring_energy(cg[0], cg[1], stretch(d, x, i));
    return sum;
}

static void chain_gradient(size_t d, const double *x, const void *params,
                           double *grad)
{
    const double *cg = params;
    double left = spring_force(cg[0], cg[1], stretch(d, x, 0));
    for (size_t i = 0; i < d; i++) {
        double right = spring_force(cg[0], cg[1], stretch(d, x, i + 1));
        grad[i] = left - right;
        left = right;
    }
}

/* Row i holds k_i + k_{i+1} and -k_{i+1}, the stiffnesses of its two springs. */
static void chain_hessian(size_t d, const double *x, const void *params,
                          double *H)
{
    const double *cg = params;
    double left = spring_stiffness(cg[0], cg[1], stretch(d, x, 0));
    for (size_t i = 0; i < d; i++) {
        double right = spring_stiffness(cg[0], cg[1], stretch(d, x, i + 1));
        H[2 * i] = left + right;
        if (i + 1 < d)
            H[2 * i + 1] = -right;
        left = right;
    }
}

fvi_potential fvi_potential_chain(const double cg[2])
{
    return (fvi_potential){ .value = chain_value,
                            .gradient = chain_gradient,
                            .hessian = chain_hessian,
                            .params = cg,
                            .quadratic = springs_are_linear,
                            .diagonals = 2 };
}

/* ---- forces ---- */

static void step_value(double t, size_t d, const void *params, double *F)
{
    const double *aT = params;
    for (size_t i = 0; i < d; i++)
        F[i] = t >= 0 && t <= aT[1] ? aT[0] : 0;
}

fvi_force fvi_force_step(const double aT[2])
{
    return (fvi_force){ step_value, aT };
}

static void cosine_value(double t, size_t d, const void *params, double *F)
{
    const double *aw = params;
    double value = aw[0] * cos(aw[1] * t);
    for (size_t i = 0; i < d; i++)
        F[i] = value;
}

fvi_force fvi_force_cosine(const double aw[2])
{
    return (fvi_force){ cosine_value, aw };
}
