/* src/memory/memory_nodes.c -- Approximate the weights of a power by a sum of exponentials.        [H 12] */
#include "history_kinds.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_sf_lambert.h>
#include <math.h>

//> step
/* Return the step for which (12.8) promises an error of delta / 2, with the eps that is optimal for the
 * step h. order is 1 + nu. */
static double next_spacing(double h, double order, double delta)
{
    const double eps = order * h / (2 * M_PI);
    return 2 * M_PI * (M_PI_2 - eps)
           / log1p(24 / (delta * pow(sin(eps), order)));
}

/* Solve h = next(h) by fixed-point iteration. One iteration reduces the error to a fifth or less. Aitken's formula
 * extrapolates from two iterations, and three extrapolations give all digits. */
static double solve_spacing(double order, double delta)
{
    double h = 0.3;
    for (int i = 0; i < 3; i++) {
        const double one = next_spacing(h, order, delta), two = next_spacing(one, order, delta);
        const double bend = (two - one) - (one - h);
        h = bend != 0 ? two - (two - one) * (two - one) / bend : two;
    }
    return h;
}
//< step

/* Return ln W for the solution of W + ln W = A, which is A - W0(e^A). For large A, e^A would overflow, so Newton's
 * method is used from A = 700 on. It gains all digits in three steps. */
static double log_of_lambert(double A)
{
    if (A < 700)
        return A - gsl_sf_lambert_W0(exp(A));
    double W = A - log(A);
    for (int i = 0; i < 3; i++)
        W -= (W + log(W) - A) * W / (W + 1);
    return log(W);
}

//> nodes
fvi_node_range fvi_node_range_of(double nu, double order, double most, double N, double delta,
                                 double strip)
{
    const double x = FVI_TAIL - most, L = log(4 / delta);
    const double h = strip * solve_spacing(order, delta);
    const double A = (L - gsl_sf_lngamma(2 + nu)) / order + 0.04;
    const double left = -log_of_lambert(A); /* (12.9) */
    const double X =
        N * (L + most * log(x + 1) - gsl_sf_lngamma(1 + most)) / x; /* (12.10) */
    const double right = log(X) + 1 / X;
    return (fvi_node_range){ left, h, 1 + (size_t)ceil((right - left) / h) };
}

void fvi_history_modes_rule(const fvi_node_range *g, double nu, double N, double *s,
                           double *c, double *rate)
{
    const double sine = sin(M_PI * fmin(nu, 1 - nu)) / M_PI;
    const double cosine = cos(M_PI * nu);
    //> rule
    for (size_t q = 0; q < g->Q; q++) {
        const double t = g->left + (double)q * g->step, e = exp(-t);
        s[q] = exp(t - e) / N;
        const double base = expm1(s[q]), power = pow(base, nu);
        c[q] = -sine * g->step * s[q] * (1 + e) * power; /* (12.7) */
        if (rate)                                        /* (23.11) */
            rate[q] =
                -g->step * s[q] * (1 + e) * power * (cosine + sine * log(base));
    }
    //< rule
}
//< nodes

size_t fvi_history_modes_nodes(double nu, double N, double delta, double *s,
                              double *c, double *rate)
{
    const fvi_node_range g = fvi_node_range_of(nu, 1 + nu, nu, N, delta, 1);
    if (s)
        fvi_history_modes_rule(&g, nu, N, s, c, rate);
    return g.Q;
}

//> delta
/* (12.11): a tenth of the tolerance, but small enough for the proof of (12.13) */
double fvi_history_modes_delta(size_t steps, double tolerance)
{
    const double wanted = tolerance == 0 ? 1e-14 : tolerance / 10;
    return fmin(wanted, 16 / fmax((double)steps, 32000));
}
//< delta
