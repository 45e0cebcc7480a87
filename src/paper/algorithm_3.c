/* src/paper/algorithm_3.c -- Compute Algorithm 3 as the paper prints it. [H 9] */
#include <fvi/paper/algorithm_3.h>

#include <fvi/fvi.h>
#include <fvi/paper/half_derivative.h>
#include <fvi/paper/legendre.h>
#include "system/fail.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The loop of Algorithm 3. c contains the weights of the derivative of order alpha applied twice. */
//> algorithm-3
static int three_terms(const fvi_system *system, double kappa, double h,
                       size_t N, double p0, const double *c, double factor,
                       double *x)
{
    const fvi_force *force = &system->force;
    int status = FVI_SUCCESS;
    double p = p0, F = 0; /* p_0 = -D1 L_d(x_0, x_1) determines x_1 */
    for (size_t k = 0; k < N; k++) {
        if (k > 0) {
            double D = 0; /* Delta_-^alpha Delta_-^alpha x_k */
            for (size_t n = 0; n <= k; n++)
                D += factor * c[n] * x[k - n];
            if (force->value)
                status = force->value((double)k * h, 1, force->params, &F);
            /* p = D2 L_d(x_{k-1}, x_k) - h rho D + h F(t_k) */
            if (!status)
                status = fvi_legendre_plus(system, kappa, h, x + k - 1, x + k,
                                           &D, &F, &p);
            if (status)
                return status;
        }
        if (!gsl_finite(p))
            FVI_FAIL("a value is no longer finite", FVI_EOVRFLW);
        /* x_{k+1} from -D1 L_d(x_k, x_{k+1}) = p */
        status = fvi_legendre_inverse(system, kappa, h, x + k, &p, x + k + 1);
        if (status)
            return status;
    }
    return FVI_SUCCESS;
}
//< algorithm-3

int fvi_algorithm_3(const fvi_system *system, double alpha, double kappa,
                    double h, size_t N, double x0, double p0, double *x)
{
    if (!x)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = fvi_system_require(system);
    if (status)
        return status;
    if (system->d != 1)
        FVI_FAIL("Algorithm 3 as printed is in one dimension", FVI_EINVAL);
    if (system->force.impulse_count)
        FVI_FAIL("Algorithm 3 as printed has no impulses", FVI_EUNSUP);
    if (N >= SIZE_MAX / sizeof(double) / 2 - 1)
        FVI_FAIL("N must be addressable", FVI_EINVAL);
    const fvi_run run = { .system = system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = h,
                          .steps = N,
                          .kappa = kappa,
                          .alpha = alpha,
                          .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    fvi_stepper *s;
    status = fvi_stepper_start(&fvi_fractional, &run, &s,
                               NULL); /* only to check the arguments */
    if (status)
        return status;
    fvi_stepper_free(s);
    double *c = malloc(2 * (N + 1) * sizeof *c);
    if (!c)
        FVI_FAIL("no memory for the weights", FVI_ENOMEM);
    double *path = c + N + 1;
    path[0] = x0;
    status = fvi_gl_weights_product(alpha, alpha, N + 1, c);
    if (!status)
        status =
            three_terms(system, kappa, h, N, p0, c, pow(h, -2 * alpha), path);
    if (!status)
        memcpy(x, path, (N + 1) * sizeof *x);
    free(c);
    return status;
}
