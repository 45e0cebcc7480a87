/* src/convolution_quadrature.c -- Weights, and their stability.  [Chapter 13] */
#include "convolution_quadrature.h"

#include "coefficients.h"
#include "stability.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <math.h>

/* ---- weights ---- */

//> factor
size_t fvi_bdf2_factor(double beta, double g[FVI_BDF2_TAPS])
{
    double power = pow(1.5, beta); /* (3/2)^beta (1 - z/3)^beta */
    fvi_coefficients(beta, FVI_BDF2_TAPS, g);
    for (size_t n = 0; n < FVI_BDF2_TAPS; n++) {
        g[n] *= power; /* (13.11) */
        power /= 3;
    }
    size_t taps = FVI_BDF2_TAPS;
    while (taps > 1 && g[taps - 1] == 0)
        taps--;
    return taps;
}
//< factor

/* delta = (1 - z) (3 - z)/2: from the end, so that w_n is read before it is
 * written. */
static void bdf2(double beta, size_t count, double *w)
{
    double g[FVI_BDF2_TAPS];
    const size_t taps = fvi_bdf2_factor(beta, g);
    fvi_coefficients(beta, count, w);
    for (size_t n = count; n-- > 0;) {
        double sum = 0;
        for (size_t j = 0; j < taps && j <= n; j++)
            sum += g[j] * w[n - j];
        w[n] = sum;
    }
}

/* (1 - z^2) f' = -2 beta f for f = ((1 - z)/(1 + z))^beta, term by term. */
static void trapezoid(double beta, size_t count, double *w)
{
    w[0] = pow(2, beta);
    if (count > 1)
        w[1] = -2 * beta * w[0];
    for (size_t n = 2; n < count; n++)
        w[n] = (-2 * beta * w[n - 1] + ((double)n - 2) * w[n - 2]) / (double)n;
}

/* (13.5): the slopes of a piecewise linear path under the integral. */
static void l1(double beta, size_t count, double *w)
{
    const double unit = 1 / tgamma(2 - beta);
    double before = 0, after = 1; /* (n+1)^(1-beta) - n^(1-beta), at n - 1, n */
    w[0] = unit;
    for (size_t n = 1; n < count; n++) {
        before = after;
        after = pow((double)n + 1, 1 - beta) - pow((double)n, 1 - beta);
        w[n] = unit * (after - before);
    }
}

int fvi_quadrature_weights(fvi_quadrature kind, double beta, size_t count,
                           double *w)
{
    if (!w)
        GSL_ERROR("w is a null pointer", GSL_EFAULT);
    if (count == 0)
        GSL_ERROR("count must be at least 1", GSL_EINVAL);
    if (kind != FVI_QUADRATURE_EULER && kind != FVI_QUADRATURE_BDF2
        && kind != FVI_QUADRATURE_TRAPEZOID && kind != FVI_QUADRATURE_L1)
        GSL_ERROR("unknown quadrature", GSL_EINVAL);
    if (!(beta >= 0 && (kind == FVI_QUADRATURE_L1 ? beta < 1 : beta <= 2)))
        GSL_ERROR("beta is out of range", GSL_EDOM);
    if (kind == FVI_QUADRATURE_EULER)
        fvi_coefficients(beta, count, w);
    else if (kind == FVI_QUADRATURE_BDF2)
        bdf2(beta, count, w);
    else if (kind == FVI_QUADRATURE_TRAPEZOID)
        trapezoid(beta, count, w);
    else
        l1(beta, count, w);
    return GSL_SUCCESS;
}

/* ---- stability ---- */

static int check(double theta, double kappa, double W, double R)
{
    if (!(theta >= 0 && theta <= 1 && kappa >= 0 && kappa <= 1))
        GSL_ERROR("theta and kappa must be in [0, 1]", GSL_EDOM);
    if (!(gsl_finite(W) && W >= 0 && gsl_finite(R) && R >= 0))
        GSL_ERROR("W and R must be finite and not negative", GSL_EDOM);
    return GSL_SUCCESS;
}

//> oscillator
int fvi_quadrature_oscillator(const double *w, double theta, double kappa,
                              double W, double R, size_t N, double *x)
{
    if (!w || !x)
        GSL_ERROR("null pointer", GSL_EFAULT);
    if (N == 0)
        GSL_ERROR("N must be at least 1", GSL_EINVAL);
    int status = check(theta, kappa, W, R);
    if (status)
        return status;
    const double inertia = 1 + kappa * (1 - kappa) * W;
    double D = w[0]; /* of x_1 = 1 */
    x[0] = 0;
    x[1] = 1;
    for (size_t k = 1; k < N; k++) {
        double ahead = 0; /* D of step k + 1 without x_{k+1} */
        for (size_t n = 1; n <= k; n++)
            ahead += w[n] * x[k + 1 - n];
        x[k + 1] = (inertia * (2 * x[k] - x[k - 1]) - W * x[k]
                    - R * ((1 - theta) * D + theta * ahead))
                   / (inertia + R * theta * w[0]); /* (13.13) */
        D = ahead + w[0] * x[k + 1];
    }
    return GSL_SUCCESS;
}
//< oscillator

typedef struct {
    fvi_quadrature kind;
    double theta, alpha, kappa, W, R;
} symbol;

static double delta_of(fvi_quadrature kind, double z)
{
    if (kind == FVI_QUADRATURE_EULER)
        return 1 - z;
    if (kind == FVI_QUADRATURE_BDF2)
        return (1 - z) * (3 - z) / 2;
    return 2 * (1 - z) / (1 + z);
}

//> symbol
/* Q(z) on the real axis, -1 < z <= 0; there every delta is positive. */
static double q_real(double z, void *params)
{
    const symbol *s = params;
    const double delta = delta_of(s->kind, z);
    return (1 + s->kappa * (1 - s->kappa) * s->W) * gsl_pow_2(1 - z) + z * s->W
           + s->R * pow(delta, 2 * s->alpha)
                 * ((1 - s->theta) * z + s->theta); /* (13.15) */
}
//< symbol

int fvi_quadrature_growth(fvi_quadrature kind, double theta, double alpha,
                          double kappa, double W, double R, double *growth)
{
    if (!growth)
        GSL_ERROR("null pointer", GSL_EFAULT);
    if (kind != FVI_QUADRATURE_EULER && kind != FVI_QUADRATURE_BDF2
        && kind != FVI_QUADRATURE_TRAPEZOID)
        GSL_ERROR("no symbol of this quadrature", GSL_EINVAL);
    int status = check(theta, kappa, W, R);
    if (status)
        return status;
    if (!(alpha >= 0 && alpha <= 1) || W == 0 || R == 0)
        GSL_ERROR("alpha must be in [0, 1], W and R positive", GSL_EDOM);
    symbol s = { kind, theta, alpha, kappa, W, R };
    /* Q(0) > 0. The trapezoidal delta is infinite at -1. */
    const double end = -1 + 0x1p-53;
    return fvi_growth_of_symbol((gsl_function){ q_real, &s }, end, growth);
}
