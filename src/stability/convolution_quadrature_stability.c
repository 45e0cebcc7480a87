/* src/stability/convolution_quadrature_stability.c -- The oscillator by convolution quadrature, and the growth of its
 * unstable mode. [H 13] */
#include <fvi/convolution_quadrature_stability.h>

#include <fvi/stability.h>
#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <math.h>

static int check(double theta, double kappa, double W, double R)
{
    if (!(theta >= 0 && theta <= 1 && kappa >= 0 && kappa <= 1))
        FVI_FAIL("theta and kappa must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(W) && W >= 0 && gsl_finite(R) && R >= 0))
        FVI_FAIL("W and R must be finite and not negative", FVI_EDOM);
    return FVI_SUCCESS;
}

//> oscillator
int fvi_cq_oscillator(const double *w, double theta, double kappa,
                              double W, double R, size_t N, double *x)
{
    if (!w || !x)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (N == 0)
        FVI_FAIL("N must be at least 1", FVI_EINVAL);
    int status = check(theta, kappa, W, R);
    if (status)
        return status;
    const double inertia = 1 + kappa * (1 - kappa) * W;
    double D = w[0]; /* the damping sum at k = 1, of x_1 = 1 */
    x[0] = 0;
    x[1] = 1;
    for (size_t k = 1; k < N; k++) {
        double ahead = 0; /* the damping sum of step k + 1 without the term of x_{k+1} */
        for (size_t n = 1; n <= k; n++)
            ahead += w[n] * x[k + 1 - n];
        x[k + 1] = (inertia * (2 * x[k] - x[k - 1]) - W * x[k]
                    - R * ((1 - theta) * D + theta * ahead))
                   / (inertia + R * theta * w[0]); /* (13.13) */
        D = ahead + w[0] * x[k + 1];
    }
    return FVI_SUCCESS;
}
//< oscillator

typedef struct {
    fvi_delta kind;
    double theta, alpha, kappa, W, R;
} symbol;

static double delta_of(fvi_delta kind, double z)
{
    if (kind == FVI_DELTA_EULER)
        return 1 - z;
    if (kind == FVI_DELTA_BDF2)
        return (1 - z) * (3 - z) / 2;
    return 2 * (1 - z) / (1 + z);
}

//> symbol
/* Q(z) on the real axis, -1 < z <= 0, where delta is positive for every quadrature. */
static double q_real(double z, void *params)
{
    const symbol *s = params;
    const double delta = delta_of(s->kind, z);
    return (1 + s->kappa * (1 - s->kappa) * s->W) * gsl_pow_2(1 - z) + z * s->W
           + s->R * pow(delta, 2 * s->alpha)
                 * ((1 - s->theta) * z + s->theta); /* (13.15) */
}
//< symbol

int fvi_cq_amplification(fvi_delta kind, double theta, double alpha,
                          double kappa, double W, double R, double *growth)
{
    if (!growth)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (kind != FVI_DELTA_EULER && kind != FVI_DELTA_BDF2
        && kind != FVI_DELTA_TRAPEZOID)
        FVI_FAIL("no symbol of this quadrature", FVI_EINVAL);
    int status = check(theta, kappa, W, R);
    if (status)
        return status;
    if (!(alpha >= 0 && alpha <= 1) || W == 0 || R == 0)
        FVI_FAIL("alpha must be in [0, 1], W and R positive", FVI_EDOM);
    symbol s = { kind, theta, alpha, kappa, W, R };
    /* Q(0) > 0. The interval ends inside -1, because the delta of the trapezoidal rule is infinite at -1. */
    const double end = -1 + 0x1p-53;
    return fvi_amplification_of_kernel((gsl_function){ q_real, &s }, end, growth);
}
