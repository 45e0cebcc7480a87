/* tests/stability/stability_forms.h -- H 14: forms of one integrator that differ by
 * rounding only, for the tests and the figure.
 *
 * Bagley-Torvik: x'' + x + D^{3/2} x = 8 for t <= 1, then 0, from rest, kappa = 1/2,
 * in N steps of length h. */
#ifndef STABILITY_FORMS_H
#define STABILITY_FORMS_H

#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include <math.h>

enum { FORMS_MOST = 16384 };

static double forms_force(size_t k, double h)
{
    return (double)k * h <= 1 ? 8 : 0;
}

/* The momentum form in long double: 64 bits of mantissa where the machine has
 * them. */
static void forms_truth(size_t N, double h, long double *x)
{
    static long double w[FORMS_MOST + 1], d[FORMS_MOST + 1];
    const long double H = h, factor = 1 / sqrtl(H);
    long double p = 0;
    w[0] = 1;
    for (size_t n = 1; n <= N; n++)
        w[n] = w[n - 1] * ((long double)n - 1.5L) / (long double)n;
    x[0] = 0;
    for (size_t k = 0; k < N; k++) {
        long double sum = 0;
        d[k] = (p - H / 2 * x[k]) / (1 / H + H / 4);
        x[k + 1] = x[k] + d[k];
        for (size_t n = 0; n <= k; n++)
            sum += w[n] * d[k - n];
        p += H * ((long double)forms_force(k + 1, h) - (x[k] + d[k] / 2))
             - factor * sum;
    }
}

/* (m/h^2 + c/4) x_{k+1} = 2 x_k/h^2 - x_{k-1}/h^2 - (x_k/2 + x_{k-1}/4) - D + F,
 * memory on the positions. */
static void forms_second_difference(size_t N, double h, double *x)
{
    static double w[FORMS_MOST + 1];
    fvi_gl_weights(1.5, N + 1, w);
    x[0] = x[1] = 0;
    for (size_t k = 1; k < N; k++) {
        double sum = 0;
        for (size_t n = 0; n <= k; n++)
            sum += w[n] * x[k - n];
        x[k + 1] = ((2 * x[k] - x[k - 1]) / (h * h) - (x[k] / 2 + x[k - 1] / 4)
                    - pow(h, -1.5) * sum + forms_force(k, h))
                   / (1 / (h * h) + 0.25);
    }
}

/* The library: momentum form, memory on the increments. */
static void forms_momentum(size_t N, double h, double *x)
{
    const double one = 1, zero = 0, aT[2] = { 8, 1 };
    const fvi_system system = {
        1, &one, &one, fvi_potential_harmonic(&one), fvi_force_step(aT), NULL, NULL
    };
    const fvi_run run = { .system = &system,
                          .x0 = &zero,
                          .p0 = &zero,
                          .h = h,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = 0.75,
                          .memory = FVI_HISTORY_DIRECT };
    fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
}

/* s + rest += term, exact but for the rounding of rest (Neumaier). */
static void forms_add(double *s, double *rest, double term)
{
    double sum = *s + term, back = sum - *s;
    *rest += (*s - (sum - back)) + (term - back);
    *s = sum;
}

/* The same with compensated sums for x and p. */
static void forms_compensated(size_t N, double h, double *x)
{
    fvi_history *memory;
    double s = 0, s_rest = 0, p = 0, p_rest = 0, zero = 0, sum;
    if (fvi_history_alloc(1.5, 1, N, FVI_HISTORY_DIRECT, 0, &memory))
        return;
    fvi_history_push(memory, &zero, &zero, &sum);
    x[0] = 0;
    for (size_t k = 0; k < N; k++) {
        double d =
            ((p - h / 2 * s) + (p_rest - h / 2 * s_rest)) / (1 / h + h / 4);
        double midpoint = s + (d / 2 + s_rest);
        forms_add(&s, &s_rest, d);
        x[k + 1] = s + s_rest;
        fvi_history_push(memory, &s, &d, &sum);
        forms_add(&p, &p_rest, h * (forms_force(k + 1, h) - midpoint));
        forms_add(&p, &p_rest, -pow(h, -0.5) * sum);
    }
    fvi_history_free(memory);
}

/* max |x_k - truth_k| / max |truth_k|. */
static double forms_error(size_t N, const double *x, const long double *truth)
{
    double size = 0, error = 0;
    for (size_t k = 0; k <= N; k++) {
        size = larger(size, fabs((double)truth[k]));
        error = larger(error, fabs((double)(x[k] - truth[k])));
    }
    return error / size;
}

#endif
