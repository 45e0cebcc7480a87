/* figures/structures/wave.h -- A damped wave on a line, without matrices. [H 27]
 *
 *     u_tt + rho D^{2 alpha} u = u_xx,   u = 0 at both ends of [0, 1],
 *
 * by differences on d points, dx = 1/(d + 1): M = 1, C = rho, K x = (2 x_i - x_{i-1} - x_{i+1}) / dx^2. A
 * method that takes K explicitly (kappa = 0 or 1) solves each step by dividing by a number. */
#ifndef WAVE_H
#define WAVE_H

#include <fvi/system.h>
#include <stdlib.h>
#include <string.h>

//> wave
static int wave_stiffness(size_t d, const double *x, const void *params,
                          double *y)
{
    const double n = (double)d + 1, k = n * n;
    (void)params;
    for (size_t i = 1; i + 1 < d; i++)
        y[i] = k * (2 * x[i] - x[i - 1] - x[i + 1]);
    y[0] = k * (2 * x[0] - (d > 1 ? x[1] : 0));
    y[d - 1] = d > 1 ? k * (2 * x[d - 1] - x[d - 2]) : y[0];
    return 0;
}

/* C = S B^T with B = 1: the history keeps all coordinates of x. */
static int wave_select_history(size_t d, const double *x, const double *from,
                               const void *params, double *z)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        z[i] = x[i] - from[i];
    return 0;
}

static int wave_apply_damping(size_t d, double a, const double *z, const void *params,
                              double *p)
{
    const double rho = *(const double *)params;
    for (size_t i = 0; i < d; i++)
        p[i] -= a * rho * z[i];
    return 0;
}

/* The factor of an explicit step is the number m + c[0] rho. Returns -1 if k is not 0: K has no factor here. */
static int wave_factorise(size_t d, double m, const double *c, double k,
                          const void *params, void **factors)
{
    double *number = malloc(sizeof *number);
    (void)d;
    if (!number || k != 0) {
        free(number);
        return -1; /* a user's code: the library passes it on */
    }
    *number = m + (c ? c[0] * *(const double *)params : 0);
    *factors = number;
    return 0;
}

static int wave_solve(size_t d, void *factors, double *r)
{
    const double inverse = 1 / *(const double *)factors;
    for (size_t i = 0; i < d; i++)
        r[i] *= inverse;
    return 0;
}

static void wave_free_factors(void *factors)
{
    free(factors);
}

/* Return the wave as matrices for a system. rho must outlive the result. */
static inline fvi_matrices wave_matrices(size_t d, const double *rho)
{
    return (fvi_matrices){ .damping = { .history_size = d,
                                        .select_history = wave_select_history,
                                        .apply_damping = wave_apply_damping,
                                        .params = rho },
                           .stiffness = wave_stiffness,
                           .factorise = wave_factorise,
                           .solve = wave_solve,
                           .free_factors = wave_free_factors,
                           .params = rho };
}
//< wave

#endif
