/* src/methods/lobatto_momenta.c -- Correct the momenta of form M by the term that the scheme leaves out. [H 17] */
#include <fvi/lobatto.h>
#include "stages/lobatto_weights.h"
#include "system/fail.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>

//> constant
/* Return c_{s,beta} = sum_j r_j lambda_j^beta over the nonzero eigenvalues of Delta(1): a real one for s = 2, a
 * conjugate pair for s = 3, and both for s = 4. (17.14) */
static double momentum_constant(size_t s, double beta)
{
    static const struct {
        double r, lambda, re, im, modulus, angle;
    } pole[] = {
        { -0.25, 2, 0, 0, 1, 0 },
        { 0, 1, 0, 0.010758287072798380, 4.8989794855663560,
          0.91173829096848764 },
        { -7.4644209827367479e-4, 9.6484952478611654, 3.7322104913683672e-4,
          1.6757515440112947e-4, 6.1083154448395596, 1.3771035724321275 },
    };
    const double turn = beta * pole[s - 2].angle;
    return pole[s - 2].r * pow(pole[s - 2].lambda, beta)
           + 2 * pow(pole[s - 2].modulus, beta)
                 * (pole[s - 2].re * cos(turn) - pole[s - 2].im * sin(turn));
}
//< constant

int fvi_lobatto_correct_momenta(const fvi_method *method, const fvi_run *run,
                        const double *x, double *p)
{
    /* h^s x^(s)(t_k) from x_{k-2}, ..., x_{k+2} */
    static const double difference[][5] = { { 0, 1, -2, 1, 0 },
                                            { -0.5, 1, 0, -1, 0.5 },
                                            { 1, -4, 6, -4, 1 } };
    if (!method || !run || !x || !p)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = fvi_system_require(run->system);
    if (status)
        return status;
    const size_t s = (size_t)method->stages;
    if (s < 2 || s > 4 || method->damped_inertia)
        FVI_FAIL("not fvi-lobatto2, 3 or 4", FVI_EINVAL);
    if (!(run->alpha >= 0 && run->alpha <= 1))
        FVI_FAIL("alpha must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(run->h) && run->h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    if (run->steps == 0)
        FVI_FAIL("a run has at least one step", FVI_EINVAL);
    if (run->law)
        FVI_FAIL("momenta of a law of damping are not corrected", FVI_EUNSUP);
    const double beta = 2 * run->alpha - 1;
    if (beta == 0 || fabs(beta) == 1 || (s == 2 && beta < 0))
        return FVI_SUCCESS;
    const size_t d = run->system->d, reach = s == 2 ? 1 : 2;
    const double factor = momentum_constant(s, beta) * pow(run->h, -beta);
    for (size_t k = reach; k + reach <= run->steps; k++)
        for (size_t j = 0; j < d; j++) {
            double sum = 0;
            for (size_t i = 2 - reach; i <= 2 + reach; i++)
                sum += difference[s - 2][i] * x[(k + i - 2) * d + j];
            p[k * d + j] +=
                run->system->damping[j] * factor * sum; /* (17.14) */
        }
    if (!fvi_all_finite((run->steps + 1) * d, p))
        FVI_FAIL("a momentum is not finite", FVI_EOVRFLW);
    return FVI_SUCCESS;
}

double fvi_lobatto_abscissa(size_t s, size_t i)
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    return rule && i < s ? rule->c[i] : 0;
}
