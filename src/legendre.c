/* src/legendre.c -- The discrete Legendre transformation.        [Chapter 8] */
#include "legendre.h"

#include "discrete_mechanics.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>

int fvi_legendre_minus(const fvi_system *system, double kappa, double h,
                       const double *x, const double *y, double *p)
{
    if (!p)
        GSL_ERROR("null pointer", GSL_EFAULT);
    //> minus
    int status = fvi_discrete_slopes(system, kappa, h, x, y, p, NULL);
    for (size_t i = 0; !status && i < system->d; i++)
        p[i] = -p[i]; /* (8.1) */
    //< minus
    return status;
}

int fvi_legendre_plus(const fvi_system *system, double kappa, double h,
                      const double *x, const double *y, const double *D,
                      const double *F, double *p)
{
    if (!p)
        GSL_ERROR("null pointer", GSL_EFAULT);
    //> plus
    int status = fvi_discrete_slopes(system, kappa, h, x, y, NULL, p);
    for (size_t i = 0; !status && i < system->d; i++) {
        p[i] -= D ? h * system->damping[i] * D[i] : 0; /* (8.2) */
        p[i] += F ? h * F[i] : 0;
    }
    //< plus
    return status;
}

int fvi_legendre_inverse(const fvi_system *system, double kappa, double h,
                         const double *x, const double *p, double *y)
{
    int status = fvi_system_check(system);
    if (status)
        return status;
    if (!x || !p || !y)
        GSL_ERROR("null pointer", GSL_EFAULT);
    const fvi_run run = { .system = system,
                          .x0 = x,
                          .p0 = p,
                          .h = h,
                          .steps = 1,
                          .kappa = kappa,
                          .alpha = 0.5 };
    double *x01 = malloc(2 * system->d * sizeof *x01);
    if (!x01)
        GSL_ERROR("no memory for the step", GSL_ENOMEM);
    //> inverse
    status = fvi_trajectory(&fvi_lagrange_dalembert, &run, x01, NULL, NULL);
    //< inverse
    for (size_t i = 0; !status && i < system->d; i++)
        y[i] = x01[system->d + i];
    free(x01);
    return status;
}
