/* src/exact/exact_rows.c -- The linear problem, solved at evenly spaced times. [Chapter 11] */
#include "exact_inverse.h"
#include "system/fail.h"

#include <gsl/gsl_math.h>

static int check_rows(double h, size_t n, double tolerance, const double *x,
                      const double *v)
{
    if (!x && !v)
        FVI_FAIL("there are no outputs", FVI_EFAULT);
    if (n == 0)
        FVI_FAIL("n must be at least 1", FVI_EINVAL);
    if (!(h > 0) || !gsl_finite(h) || !gsl_finite(h * (double)n))
        FVI_FAIL("h must be finite and positive, and n h finite", FVI_EDOM);
    if (!(tolerance >= 0 && tolerance < 1))
        FVI_FAIL("the tolerance must be in [0, 1)", FVI_EDOM);
    return FVI_SUCCESS;
}

int fvi_exact_rows(const fvi_linear *problem, double h, size_t n,
                   double tolerance, double *x, double *v)
{
    fvi_inverse S;
    int status = fvi_exact_check(problem);
    if (!status)
        status = check_rows(h, n, tolerance, x, v);
    if (!status)
        status = fvi_inverse_prepare(problem, &S);
    for (size_t k = 0; k <= n && !status; k++) {
        const double t = (double)k * h;
        double xk, vk;
        if (fvi_exact_phase_is_lost(&S, t))
            FVI_FAIL("the phase of the oscillation is lost", FVI_ELOSS);
        fvi_exact_at(&S, t, &xk, &vk);
        if (!gsl_finite(xk) || !gsl_finite(vk))
            FVI_FAIL("a value is not finite", FVI_EOVRFLW);
        if (x)
            x[k] = xk;
        if (v)
            v[k] = vk;
    }
    return status;
}
