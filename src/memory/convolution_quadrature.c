/* src/memory/convolution_quadrature.c -- Compute the weights of other convolution quadratures. [H 13] */
#include <fvi/convolution_quadrature.h>

#include <fvi/coefficients.h>
#include "history_kinds.h"
#include "system/fail.h"

#include <math.h>

//> factor
size_t fvi_cq_bdf2_factor(double beta, double g[FVI_BDF2_TAPS])
{
    double power = pow(1.5, beta); /* (3/2)^beta (1 - z/3)^beta */
    fvi_gl_weights(beta, FVI_BDF2_TAPS, g);
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

/* The loop runs from the last coefficient to the first, because w_n must be read before it is overwritten. */
void fvi_multiply_by_bdf2_factor(double beta, size_t count, double *w)
{
    double g[FVI_BDF2_TAPS];
    const size_t taps = fvi_cq_bdf2_factor(beta, g);
    for (size_t n = count; n-- > 0;) {
        double sum = 0;
        for (size_t j = 0; j < taps && j <= n; j++)
            sum += g[j] * w[n - j];
        w[n] = sum;
    }
}

//> trapezoid
/* The weights of f = ((1 - z)/(1 + z))^beta follow term by term from (1 - z^2) f' = -2 beta f. */
static void trapezoid_weights(double beta, size_t count, double *w)
{
    w[0] = pow(2, beta);
    if (count > 1)
        w[1] = -2 * beta * w[0];
    for (size_t n = 2; n < count; n++)
        w[n] = (-2 * beta * w[n - 1] + ((double)n - 2) * w[n - 2]) / (double)n;
}
//< trapezoid

/* Weights of (13.5): the integral contains the slopes of a piecewise linear path. */
static void l1_weights(double beta, size_t count, double *w)
{
    const double unit = 1 / tgamma(2 - beta);
    double before = 0, after = 1; /* (n+1)^(1-beta) - n^(1-beta) for n - 1 and for n */
    w[0] = unit;
    for (size_t n = 1; n < count; n++) {
        before = after;
        after = pow((double)n + 1, 1 - beta) - pow((double)n, 1 - beta);
        w[n] = unit * (after - before);
    }
}

int fvi_cq_weights(fvi_delta kind, double beta, size_t count,
                           double *w)
{
    if (!w)
        FVI_FAIL("w is a null pointer", FVI_EFAULT);
    if (count == 0)
        FVI_FAIL("count must be at least 1", FVI_EINVAL);
    if (kind != FVI_DELTA_EULER && kind != FVI_DELTA_BDF2
        && kind != FVI_DELTA_TRAPEZOID && kind != FVI_DELTA_L1)
        FVI_FAIL("unknown quadrature", FVI_EINVAL);
    if (!(beta >= 0 && (kind == FVI_DELTA_L1 ? beta < 1 : beta <= 2)))
        FVI_FAIL("beta is out of range", FVI_EDOM);
    if (kind == FVI_DELTA_TRAPEZOID)
        trapezoid_weights(beta, count, w);
    else if (kind == FVI_DELTA_L1)
        l1_weights(beta, count, w);
    else
        fvi_gl_weights(beta, count, w);
    if (kind == FVI_DELTA_BDF2) /* delta = (1 - z) (3 - z) / 2 */
        fvi_multiply_by_bdf2_factor(beta, count, w);
    return FVI_SUCCESS;
}
