/* tests/convergence/bound_of_stages.h -- H 20: the bound (20.25) of the errors of form D in all stages, on any mesh. */
#ifndef BOUND_OF_STAGES_H
#define BOUND_OF_STAGES_H

#include "harness/ulp.h"
#include "system/larger.h"

#include "convergence_stages_ref.h"

#include <gsl/gsl_math.h>

/* (20.18), (20.21), (20.24): rows of the resolvent of a step. */
static const double WRITES = 1.34, OWN = 2, STAGE = 2.37;

enum { MOST_DERIVATIVES = 9 };

/* What (20.25) has to know. With phi = x' for 2 alpha < 1 and x'' above, and q = g(x) - f:
 * |phi^(i)| <= A_i t^-i for i <= s, |x'^(i)| <= B_i t^(1-i) and |q^(i)| <= H_i t^(1-i) for
 * i = 1, s - 1 and s. */
typedef struct {
    size_t s;
    double alpha, r, lipschitz, eps;
    double A[MOST_DERIVATIVES], B[MOST_DERIVATIVES], H[MOST_DERIVATIVES];
} stage_motion;

/* theta of (20.24): the memory is an integral of this order. */
static double memory_order(double alpha)
{
    return alpha > 0.5 ? 2 - 2 * alpha : 1 - 2 * alpha;
}

static double integral_of_power(double left, double right, double exponent)
{
    return fabs(exponent + 1) < 1e-9
               ? log(right / left)
               : (pow(right, exponent + 1) - pow(left, exponent + 1)) / (exponent + 1);
}

/* A term of the first kind, from derivatives of order 1, or one of a high order, which the first step lacks. */
static double least_of(size_t k, double first, double high)
{
    return k ? smaller(first, high) : first;
}

/* The largest |Q| of (20.22) over all stages: D[i] bounds the i-th derivative, times t^(i-1). */
static double quadrature_misses(size_t s, size_t n, const double *h, const double *D)
{
    const double S = (double)s, K1 = ref_stages[s - 2].K1, K = ref_stages[s - 2].K, E1 = ref_stages[s - 2].E1,
                 E = ref_stages[s - 2].E;
    double most = 0, ends = 0, t = 0;
    for (size_t k = 0; k < n; k++) {
        const double right = t + h[k], first = h[k] * h[k] * D[1],
                     low = k ? pow(h[k], S - 1) * D[s - 1] * integral_of_power(t, right, 2 - S) : 0,
                     high = k ? pow(h[k], S) * D[s] * integral_of_power(t, right, 1 - S) : 0;
        most = larger(most, ends + least_of(k, K1 * first, K * low));
        ends += least_of(k, E1 * first, E * high);
        t = right;
    }
    return most;
}

/* G_j of (20.23), with `more` = 1 its second form, which has one more rate. */
static double rate_integral(size_t j, size_t more, double theta, const double *A)
{
    const double e = (double)(j + more) - theta;
    double sum = more ? 0 : A[j] * tgamma(1 - theta) / theta;
    for (size_t i = 0; i < j; i++)
        sum += A[i] * tgamma(e - (double)i);
    return A[0] * tgamma(e) * (pow(2, e) - 1) + pow(2, e) * sum;
}

/* (20.24) in step n, times pi / sin(pi theta). */
static double memory_misses_in(const stage_motion *q, size_t n, const double *h)
{
    const size_t s = q->s;
    const double theta = memory_order(q->alpha), S = (double)s, K1 = ref_stages[s - 2].K1,
                 K = ref_stages[s - 2].K, E1 = ref_stages[s - 2].E1, E = ref_stages[s - 2].E,
                 G1 = rate_integral(1, 0, theta, q->A), G = rate_integral(s - 1, 0, theta, q->A),
                 G_end = rate_integral(s, 0, theta, q->A), G_more = rate_integral(s - 1, 1, theta, q->A),
                 rough = M_PI / sin(M_PI * theta) * pow(2, S - 1) * q->A[s - 1];
    double start = 0, sum = 0, t = 0;
    for (size_t k = 0; k < n; k++)
        start += h[k]; /* of step n */
    for (size_t k = 0; k <= n; k++) {
        const double right = t + h[k], first = h[k] * G1 * integral_of_power(t, right, theta - 1),
                     smooth = k ? integral_of_power(t, right, theta - S) : 0;
        if (k == n) {
            const double in = k ? pow(h[k], S - 1) * G * integral_of_power(t, right, theta - S + 1) : 0;
            sum += STAGE * least_of(k, K1 * first, K * in);
        } else {
            const double end = k ? pow(h[k], S) * G_end * smooth : 0,
                         past = k ? pow(h[k], S)
                                        * (G_more * smooth
                                           + rough * pow(start - t, theta - 1)
                                                 * integral_of_power(t, right, 1 - S))
                                  : 0;
            sum += least_of(k, E1 * first, E * end) + WRITES * least_of(k, K1 * first, K * past);
        }
        t = right;
    }
    return sum;
}

/* The largest of (20.24). Nothing is missed for alpha = 1/2. */
static double memory_misses(const stage_motion *q, size_t n, const double *h)
{
    double most = 0;
    if (q->alpha == 0.5)
        return 0;
    for (size_t k = 0; k < n; k++)
        most = larger(most, memory_misses_in(q, k, h));
    return sin(M_PI * memory_order(q->alpha)) / M_PI * most;
}

/* Lambda_theta of (20.21), theta = 0 and 1 included. */
static double integral_norm(double theta, double lambda, double longest)
{
    if (theta == 0)
        return 1;
    return theta == 1 ? 1 / lambda + longest
                      : WRITES * pow(lambda, -theta) + OWN * pow(longest, theta);
}

typedef struct {
    double E, X, lambda; /* (20.25); E is infinite if no lambda serves */
} stage_bound;

/* The lambda that makes the bound of v in the last step least, of powers of 1.05. */
static stage_bound bound_of_stages(const stage_motion *q, size_t n, const double *h)
{
    double longest = 0, T = 0;
    for (size_t k = 0; k < n; k++) {
        longest = larger(longest, h[k]);
        T += h[k];
    }
    const double of_x = quadrature_misses(q->s, n, h, q->B),
                 of_v = q->r * memory_misses(q, n, h) + quadrature_misses(q->s, n, h, q->H)
                        + q->r * q->eps * T;
    stage_bound best = { GSL_POSINF, GSL_POSINF, 0 };
    double least = GSL_POSINF;
    for (double lambda = 0.01; lambda < 1000; lambda *= 1.05) {
        const double once = integral_norm(1, lambda, longest),
                     memory = q->r * integral_norm(memory_order(q->alpha), lambda, longest),
                     by_x = q->lipschitz * once + (q->alpha > 0.5 ? 0 : memory),
                     again = by_x * once + (q->alpha > 0.5 ? memory : 0);
        double weight = 1;
        for (size_t k = 0; k + 1 < n; k++)
            weight *= 1 + lambda * h[k];
        if (again >= 1)
            continue;
        const double E = (of_v + by_x * of_x) / (1 - again);
        if (E * weight < least) {
            least = E * weight;
            best = (stage_bound){ E, once * E + of_x, lambda };
        }
    }
    return best;
}

#endif
