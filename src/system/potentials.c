/* src/system/potentials.c -- The ready-made potentials: harmonic, Duffing, pendulum, chain.          [H 2] */
#include <fvi/system.h>

#include "lanes.h"
#include "vectors.h"

#include <math.h>
#include <stdlib.h>

/* ---- one spring of stretch r: energy c r^2 / 2 + g r^4 / 4, force and stiffness ---- */

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

/* The ready-made potentials only read their params. So the casts below remove const, but no constant is ever
 * written. */

/* ---- harmonic and Duffing: a spring from each mass to its own origin ---- */

static int duffing_value(size_t d, const double *x, void *params, double *value)
{
    const double *cg = params;
    double sum = 0;
    for (size_t i = 0; i < d; i++)
        sum += spring_energy(cg[0], cg[1], x[i]);
    *value = sum;
    return 0;
}

static int duffing_gradient(size_t d, const double *x, void *params,
                            double *grad)
{
    const double *cg = params;
    for (size_t i = 0; i < d; i++)
        grad[i] = spring_force(cg[0], cg[1], x[i]);
    return 0;
}

static int duffing_hessian(size_t d, const double *x, void *params, double *H)
{
    const double *cg = params;
    for (size_t i = 0; i < d; i++)
        H[i] = spring_stiffness(cg[0], cg[1], x[i]);
    return 0;
}

/* Return 1 if the springs of a Duffing potential or a chain have no term r^4. */
static int springs_are_linear(const void *params)
{
    const double *cg = params;
    return cg[1] == 0;
}

/* Compute force and stiffness of the springs. The pair of each lane is (c, g). */
FVI_VECTORS static void slopes_of_springs(const fvi_lane_pairs *p, const double *x, double *f,
                                          double *slope)
{
#pragma omp simd
    for (size_t l = 0; l < FVI_MOST_LANES; l++) {
        f[l] = spring_force(p->first[l], p->second[l], x[l]);
        slope[l] = spring_stiffness(p->first[l], p->second[l], x[l]);
    }
}

static void evaluate_springs(const void *prepared, const double *x, const double *active, double *f, double *slope)
{
    double unused[FVI_MOST_LANES];
    (void)active;
    slopes_of_springs(prepared, x, f, slope ? slope : unused);
}

static const fvi_lane_functions duffing_lanes = { fvi_lane_pairs_prepare, evaluate_springs, free,
                                                  NULL };

fvi_potential fvi_potential_duffing(const double cg[2])
{
    return (fvi_potential){ .value = duffing_value,
                            .gradient = duffing_gradient,
                            .hessian = duffing_hessian,
                            .params = (void *)cg,
                            .quadratic = springs_are_linear,
                            .diagonals = 1,
                            .lanes = &duffing_lanes };
}

/* The harmonic potential has its own functions, because its params are one number, c. Their digits are those of c x,
 * because (c + 0 x x) x is c x. */
static int harmonic_value(size_t d, const double *x, void *params,
                          double *value)
{
    double cg[2] = { *(const double *)params, 0 };
    return duffing_value(d, x, cg, value);
}

static int harmonic_gradient(size_t d, const double *x, void *params,
                             double *grad)
{
    double cg[2] = { *(const double *)params, 0 };
    return duffing_gradient(d, x, cg, grad);
}

static int harmonic_hessian(size_t d, const double *x, void *params, double *H)
{
    double cg[2] = { *(const double *)params, 0 };
    return duffing_hessian(d, x, cg, H);
}

static int always(const void *params)
{
    (void)params;
    return 1;
}

/* The second number of each lane, g, is 0. */
static const fvi_lane_functions harmonic_lanes = { fvi_lane_numbers_prepare, evaluate_springs, free, NULL };

fvi_potential fvi_potential_harmonic(const double *c)
{
    return (fvi_potential){ .value = harmonic_value,
                            .gradient = harmonic_gradient,
                            .hessian = harmonic_hessian,
                            .params = (void *)c,
                            .quadratic = always,
                            .diagonals = 1,
                            .lanes = &harmonic_lanes };
}

/* ---- pendulum ---- */

static int pendulum_value(size_t d, const double *x, void *params,
                          double *value)
{
    double sum = 0;
    for (size_t i = 0; i < d; i++) {
        double s = sin(x[i] / 2);
        sum += 2 * s * s; /* 1 - cos x, without cancellation at small x */
    }
    *value = *(const double *)params * sum;
    return 0;
}

static int pendulum_gradient(size_t d, const double *x, void *params,
                             double *grad)
{
    for (size_t i = 0; i < d; i++)
        grad[i] = *(const double *)params * sin(x[i]);
    return 0;
}

static int pendulum_hessian(size_t d, const double *x, void *params, double *H)
{
    for (size_t i = 0; i < d; i++)
        H[i] = *(const double *)params * cos(x[i]);
    return 0;
}

/* The first number of each lane is g. The loop skips lanes that are not active, because sine and cosine are expensive.
 * The compiler computes both in one call. */
static void evaluate_pendulums(const void *prepared, const double *x, const double *active, double *f, double *slope)
{
    const fvi_lane_pairs *p = prepared;
    for (size_t l = 0; l < FVI_MOST_LANES; l++) {
        if (active && active[l] == 0)
            continue;
        const double sine = sin(x[l]), cosine = cos(x[l]);
        f[l] = p->first[l] * sine;
        if (slope)
            slope[l] = p->first[l] * cosine;
    }
}

static const fvi_lane_functions pendulum_lanes = { fvi_lane_numbers_prepare, evaluate_pendulums, free, NULL };

fvi_potential fvi_potential_pendulum(const double *g)
{
    return (fvi_potential){ .value = pendulum_value,
                            .gradient = pendulum_gradient,
                            .hessian = pendulum_hessian,
                            .params = (void *)g,
                            .diagonals = 1,
                            .lanes = &pendulum_lanes };
}

/* ---- chain: spring i connects mass i - 1 to mass i; masses -1 and d are the walls ---- */

static double stretch(size_t d, const double *x, size_t i)
{
    return (i < d ? x[i] : 0) - (i > 0 ? x[i - 1] : 0);
}

static int chain_value(size_t d, const double *x, void *params, double *value)
{
    const double *cg = params;
    double sum = 0;
    for (size_t i = 0; i <= d; i++)
        sum += spring_energy(cg[0], cg[1], stretch(d, x, i));
    *value = sum;
    return 0;
}

static int chain_gradient(size_t d, const double *x, void *params, double *grad)
{
    const double *cg = params;
    double left = spring_force(cg[0], cg[1], stretch(d, x, 0));
    for (size_t i = 0; i < d; i++) {
        double right = spring_force(cg[0], cg[1], stretch(d, x, i + 1));
        grad[i] = left - right;
        left = right;
    }
    return 0;
}

/* Row i holds k_i + k_{i+1} and -k_{i+1}, where k_i and k_{i+1} are the stiffnesses of the two springs at mass i. */
static int chain_hessian(size_t d, const double *x, void *params, double *H)
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
    return 0;
}

fvi_potential fvi_potential_chain(const double cg[2])
{
    return (fvi_potential){ .value = chain_value,
                            .gradient = chain_gradient,
                            .hessian = chain_hessian,
                            .params = (void *)cg,
                            .quadratic = springs_are_linear,
                            .diagonals = 2 };
}
