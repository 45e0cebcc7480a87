/* src/paper/legendre.c -- Compute the discrete Legendre transformation and its inverse.        [H 8] */
#include <fvi/paper/legendre.h>

#include <fvi/discrete_mechanics.h>
#include "system/fail.h"
#include "system/system_check.h"
#include "newton/newton.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

int fvi_legendre_minus(const fvi_system *system, double kappa, double h,
                       const double *x, const double *y, double *p)
{
    if (!p)
        FVI_FAIL("null pointer", FVI_EFAULT);
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
        FVI_FAIL("null pointer", FVI_EFAULT);
    //> plus
    int status = fvi_discrete_slopes(system, kappa, h, x, y, NULL, p);
    for (size_t i = 0; !status && i < system->d; i++) {
        p[i] -= D ? h * system->damping[i] * D[i] : 0; /* (8.2) */
        p[i] += F ? h * F[i] : 0;
    }
    //< plus
    return status;
}

/* Solve for delta = y - x. The array has room for delta, grad U and m / h, d numbers each. */
static int solve_for_next(const fvi_system *system, double kappa, double h,
                          const double *x, const double *p, double *delta)
{
    const size_t d = system->d;
    double *g = delta + d, *A = delta + 2 * d;
    fvi_newton *newton;
    //> inverse
    for (size_t i = 0; i < d; i++)
        A[i] = system->mass[i] / h;
    int status = fvi_newton_alloc(system, A, kappa * h, 1 - kappa, &newton);
    if (status)
        return status;
    status = fvi_newton_solve(newton, x, p, delta, g); /* (2.10) */
    fvi_newton_free(newton);
    //< inverse
    return status;
}

int fvi_legendre_inverse(const fvi_system *system, double kappa, double h,
                         const double *x, const double *p, double *y)
{
    int status = fvi_system_require(system);
    if (status)
        return status;
    if (!x || !p || !y)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(kappa >= 0 && kappa <= 1))
        FVI_FAIL("kappa must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(h) && h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    const size_t d = system->d;
    if (!fvi_all_finite(d, x) || !fvi_all_finite(d, p))
        FVI_FAIL("x and p must be finite", FVI_EDOM);
    double *delta = calloc(3 * d, sizeof *delta); /* the initial guess is zero */
    if (!delta)
        FVI_FAIL("no memory for the step", FVI_ENOMEM);
    status = solve_for_next(system, kappa, h, x, p, delta);
    for (size_t i = 0; i < d; i++)
        delta[i] += x[i];
    if (!status && !fvi_all_finite(d, delta))
        status = FVI_EOVRFLW;
    if (!status)
        memcpy(y, delta, d * sizeof *y);
    free(delta);
    if (status == FVI_EOVRFLW)
        FVI_FAIL("the next position is not finite", FVI_EOVRFLW);
    return status;
}
