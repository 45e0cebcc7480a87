/* src/stability/convergence.c -- Bound the distance between a run and the motion. [H 20]
 *
 * The constants of the bound are closed formulas of the smoothness of the motion, (20.4) to (20.6) and (20.14). */
#include <fvi/convergence.h>

#include "system/fail.h"
#include "system/larger.h"

#include <math.h>

static int is_bound(double v)
{
    return isfinite(v) && v >= 0;
}

static int check(const fvi_smoothness *q, const void *output)
{
    if (!q || !output)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(q->alpha >= 0 && q->alpha < 1))
        FVI_FAIL("alpha must be in [0, 1)", FVI_EDOM);
    if (!(q->kappa >= 0 && q->kappa <= 1))
        FVI_FAIL("kappa must be in [0, 1]", FVI_EDOM);
    if (!(q->T > 0 && isfinite(q->T) && q->room > 0))
        FVI_FAIL("T and room must be > 0, T finite", FVI_EDOM);
    if (!is_bound(q->damping) || !is_bound(q->lipschitz)
        || !is_bound(q->gradient) || !is_bound(q->variation)
        || !is_bound(q->start) || !is_bound(q->speed)
        || !is_bound(q->acceleration) || !is_bound(q->velocity_variation))
        FVI_FAIL("a bound must be finite and >= 0", FVI_EDOM);
    return FVI_SUCCESS;
}

//> defect
/* How far the sum of the memory can be from r I^gamma u on the exact path, divided by h. [(20.4)] */
static double defect_of_memory(const fvi_smoothness *q)
{
    const double gamma = 2 - 2 * q->alpha;
    double missed = 2 * q->acceleration * pow(q->T, gamma) / tgamma(gamma + 2);
    if (gamma > 1) /* then u(0) = v0, and otherwise 0 */
        missed += q->start * pow(q->T, gamma - 1) / tgamma(gamma + 1);
    return q->damping * fabs(gamma - 1) * missed;
}

//> miss
/* C of (20.5): each step makes an error of at most C h. */
static double defect_of_step(const fvi_smoothness *q)
{
    return defect_of_memory(q) + q->variation
           + q->lipschitz * q->speed * q->T / 2 + q->acceleration / 2
           + q->kappa * q->gradient; /* (20.5) */
}
//< miss

/* lambda, the rate at which errors make new errors, so that ell / lambda^2 + r / lambda^gamma <= 1/2. (20.6) */
static double growth_rate_of_errors(const fvi_smoothness *q)
{
    const double gamma = 2 - 2 * q->alpha;
    return fmax(2 * sqrt(q->lipschitz),
                pow(4 * q->damping, 1 / gamma)); /* (20.6) */
}
//< defect

/* Write the constants for a given C. The error of x at T is at most 2 C h growth, and it must not exceed `room`. This
 * limits h, unless C = 0. */
static int make_bound(const fvi_smoothness *q, double C, double growth,
                      fvi_error_bound *bound)
{
    const double lambda = growth_rate_of_errors(q), k = q->kappa * (1 - q->kappa) * q->lipschitz;
    if (!isfinite(C) || !isfinite(lambda))
        FVI_FAIL("no finite bound", FVI_EOVRFLW);
    *bound = (fvi_error_bound){ C, lambda, 1 / sqrt(k) };
    if (isfinite(q->room) && C > 0)
        bound->h = smaller(bound->h, q->room / (2 * C * growth));
    return FVI_SUCCESS;
}

int fvi_error_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound)
{
    int status = check(motion, bound);
    if (status)
        return status;
    const double lambda = growth_rate_of_errors(motion), T = motion->T;
    return make_bound(motion, defect_of_step(motion), lambda > 0 ? expm1(lambda * T) / lambda : T,
                      bound);
}

//> variation
/* D: the constant of the bound of positions, from the variation W of the velocity instead of a bound of |x''|. */
static double defect_of_positions(const fvi_smoothness *q)
{
    const double gamma = 2 - 2 * q->alpha, W = q->velocity_variation,
                 memory = q->start + 17. / 8 * W;
    return q->T * (q->variation + q->lipschitz * q->speed * q->T / 2 + q->kappa * q->gradient)
           + W
           + q->damping * fabs(gamma - 1) * pow(q->T, gamma) / tgamma(gamma + 1)
                 * memory; /* (20.14) */
}
//< variation

int fvi_position_bound_compute(const fvi_smoothness *motion, fvi_error_bound *bound)
{
    int status = check(motion, bound);
    if (status)
        return status;
    return make_bound(motion, defect_of_positions(motion), exp(growth_rate_of_errors(motion) * motion->T),
                      bound);
}
