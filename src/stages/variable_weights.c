/* src/stages/variable_weights.c -- Compute the weights of the modes of variable steps.       [H 22] */
#include "variable_weights.h"

#include "variable_table.h"

#include <gsl/gsl_math.h>
#include <math.h>

/* The weights are size sigma^beta with size = L sin(pi nu)/pi. At the lower end of the modes, a weight times its factor
 * a_i y falls like sigma^nu. For beta = -1 the weights are 0/0, and `tiny` gives their limit. */
static const double tiny = 1e-100;

static double lower_exponent(double beta)
{
    return fmax(beta > 0 ? beta : 1 + beta, tiny);
}

static double weight_of_unit_rate(double L, double beta)
{
    const double least = fmin(fabs(beta), 1 - fabs(beta));
    return sin(M_PI * fmax(least, tiny)) / M_PI * L;
}

/* Return M: at the upper end of the modes, the factor a_i y of a weight falls like sigma^-M. */
static double upper_exponent(double beta)
{
    return beta > 0 ? 2 : 1;
}

static double spacing(const fvi_mode_ladder *ladder)
{
    return fvi_variable_spacing() * (double)ladder->every;
}

/* Compute sigma_q and weight_q. Each exponential is the product of one of FVI_RUNGS fine exponentials and one of the
 * coarse exponentials, because exponentials take a large part of the set-up of a run. */
void fvi_mode_weights(const fvi_mode_ladder *ladder, double *sigma,
                      double *weight, double *top)
{
    const size_t apart = fvi_variable_apart(ladder->every);
    const double L = spacing(ladder), beta = ladder->beta,
                 first = fvi_variable_spacing() * ladder->first,
                 nu = lower_exponent(beta), size = weight_of_unit_rate(L, beta);
    double finer[FVI_RUNGS], c[FVI_ENDS];
    for (size_t l = 0; l < FVI_RUNGS; l++)
        finer[l] = exp(L * beta * (double)l);
    for (size_t q = 0; q < ladder->Q; q += FVI_RUNGS) {
        const double ln = first + L * (double)q, here = exp(ln),
                     first_weight = size * exp(beta * ln);
        for (size_t l = 0; l < FVI_RUNGS && q + l < ladder->Q; l++) {
            sigma[q + l] = here * ladder->up[l];
            weight[q + l] = first_weight * finer[l];
        }
    }
    const double w0 = weight[0], step = -L * (double)apart;
    fvi_variable_ends(ladder->every, nu, c);
    for (size_t l = 0; l < FVI_ENDS; l++)
        weight[apart * l] += w0 * c[l] * (beta > 0 ? 1 : exp(step * (double)l));
    const double M = upper_exponent(beta);
    fvi_variable_ends(ladder->every, M - beta, c);
    for (size_t l = 0; l < FVI_ENDS; l++) /* the correction relative to the weight of the last mode is r^{-3 l M} c_l */
        top[l] = c[l] * exp(step * (double)l * M);
}

/* Return the derivatives by x of sin(x)/x and of x/(e^x - 1). Near 0 they are computed by their series, for |x| <= 0.1
 * and |x| <= 1. */
static double sinc_rate(double x)
{
    const double y = x * x;
    if (fabs(x) > 0.1)
        return (cos(x) - sin(x) / x) / x;
    return -x / 3 * (1 - y / 10 * (1 - y / 28 * (1 - y / 54)));
}

static double bernoulli_rate(double x)
{
    static const double B[] = { 1. / 6,         -1. / 180,
                                1. / 5040,      -1. / 151200,
                                1. / 4790016,   -691. / 108972864000,
                                1. / 5337446400 }; /* 2k B_2k / (2k)! */
    double sum = 0;
    for (size_t k = sizeof B / sizeof *B; k-- > 0;)
        sum = B[k] + x * x * sum;
    return x * sum - 0.5;
}

//> lower
/* Compute the derivative by nu of the contribution sum_n c_n of the modes below the first one. The n-th sum is L sin(pi
 * nu)/pi / (r^(nu + n) - 1), and for n = 0 it is 0/0 at nu = 0. ln is the logarithm of the sigma whose power beta is
 * the common factor. */
static void lower_tail_rates(size_t every, double L, double nu, double ln, double *c)
{
    const double sinc = sin(M_PI * nu) / (M_PI * nu), size = sinc * nu * L,
                 slope = cos(M_PI * nu) * L, x = L * nu, share = x / expm1(x);
    double sum[FVI_ENDS];
    sum[0] = M_PI * sinc_rate(M_PI * nu) * share + sinc * L * bernoulli_rate(x)
             + ln * sinc * share;
    for (size_t n = 1; n < FVI_ENDS; n++) {
        const double E = 1 / expm1(L * (nu + (double)n));
        sum[n] = slope * E - size * L * E * (1 + E) + ln * size * E;
    }
    fvi_variable_spread(every, sum, c);
}
//< lower

//> rate
void fvi_mode_weights_by_order(const fvi_mode_ladder *ladder, double *rate,
                           double *top_rate)
{
    const size_t apart = fvi_variable_apart(ladder->every);
    const double L = spacing(ladder), beta = ladder->beta, nu = lower_exponent(beta),
                 first = fvi_variable_spacing() * ladder->first,
                 size = weight_of_unit_rate(L, beta), slope = cos(M_PI * nu) * L;
    for (size_t q = 0; q < ladder->Q; q++) {
        const double ln = first + L * (double)q;
        rate[q] = (slope + size * ln) * exp(beta * ln); /* (23.18) */
    }
    const double step = -L * (double)apart, power = exp(beta * first);
    double c[FVI_ENDS], sum[FVI_ENDS];
    lower_tail_rates(ladder->every, L, nu, first, c);
    for (size_t l = 0; l < FVI_ENDS; l++)
        rate[apart * l] +=
            power * c[l] * (beta > 0 ? 1 : exp(step * (double)l));
    const double M = upper_exponent(beta);
    for (size_t n = 0; n < FVI_ENDS; n++) {
        const double E = 1 / expm1(L * (M - beta + (double)n));
        sum[n] = L * E * (1 + E);
    }
    fvi_variable_spread(ladder->every, sum, c);
    for (size_t l = 0; l < FVI_ENDS; l++)
        top_rate[l] = c[l] * exp(step * (double)l * M);
}
//< rate
