/* figures/stability_rounding.c -- Chapter 14: what rounding does to three forms
 * of the same integrator.
 *
 * Bagley-Torvik, x'' + x + D^{3/2} x = 8 on [0, 1], [0, 20] in N steps. Prints N,
 * then max |x_k - truth_k| / max |truth| for
 *   the second difference x_{k+1} = 2 x_k - x_{k-1} + ..., memory on positions;
 *   the momentum form of the library, memory on increments;
 *   the same with compensated sums for x and p.
 * The truth is the momentum form in long double (64 bits of mantissa where the
 * machine has them) with the same step: only rounding is measured. */
#include "coefficients.h"
#include "fvi.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MANY = 16000 };

static double w[MANY + 1], x[3][MANY + 1];
static long double lw[MANY + 1], ld[MANY + 1], truth[MANY + 1];

static double force(size_t k, double h)
{
    return (double)k * h <= 1 ? 8 : 0;
}

static void run_truth(size_t N, double h)
{
    long double H = h, p = 0, factor = 1 / sqrtl(H);
    lw[0] = 1;
    for (size_t n = 1; n <= N; n++)
        lw[n] = lw[n - 1] * ((long double)n - 1.5L) / (long double)n;
    ld[0] = 0;
    truth[0] = 0;
    for (size_t k = 0; k < N; k++) {
        long double d = (p - H / 2 * truth[k]) / (1 / H + H / 4), sum = 0;
        truth[k + 1] = truth[k] + d;
        ld[k + 1] = d;
        for (size_t n = 0; n <= k; n++)
            sum += lw[n] * ld[k + 1 - n];
        p += H * ((long double)force(k + 1, h) - (truth[k] + d / 2))
             - factor * sum;
    }
}

/* (m/h^2 + c/4) x_{k+1} = 2 x_k/h^2 - x_{k-1}/h^2 - (x_k/2 + x_{k-1}/4) - D + F */
static void run_second_difference(size_t N, double h, double *y)
{
    fvi_coefficients(1.5, N + 1, w);
    y[0] = y[1] = 0;
    for (size_t k = 1; k < N; k++) {
        double sum = 0;
        for (size_t n = 0; n <= k; n++)
            sum += w[n] * y[k - n];
        y[k + 1] = ((2 * y[k] - y[k - 1]) / (h * h) - (y[k] / 2 + y[k - 1] / 4)
                    - pow(h, -1.5) * sum + force(k, h))
                   / (1 / (h * h) + 0.25);
    }
}

static void run_library(size_t N, double h, double *y)
{
    const double one = 1, zero = 0, aT[2] = { 8, 1 };
    const fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one),
                                fvi_force_step(aT) };
    const fvi_run run = { .system = &system,
                          .x0 = &zero,
                          .p0 = &zero,
                          .h = h,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = 0.75,
                          .memory = FVI_MEMORY_DIRECT };
    fvi_trajectory(&fvi_fractional, &run, y, NULL, NULL);
}

/* s + rest += term, exact but for the rounding of rest (Neumaier). */
static void add(double *s, double *rest, double term)
{
    double sum = *s + term, back = sum - *s;
    *rest += (*s - (sum - back)) + (term - back);
    *s = sum;
}

static void run_compensated(size_t N, double h, double *y)
{
    fvi_memory *memory;
    double s = 0, s_rest = 0, p = 0, p_rest = 0, zero = 0, sum;
    if (fvi_memory_alloc(1.5, 1, N, FVI_MEMORY_DIRECT, 0, &memory))
        return;
    fvi_memory_push(memory, &zero, &zero, &sum);
    y[0] = 0;
    for (size_t k = 0; k < N; k++) {
        double d =
            ((p - h / 2 * s) + (p_rest - h / 2 * s_rest)) / (1 / h + h / 4);
        double midpoint = s + (d / 2 + s_rest);
        add(&s, &s_rest, d);
        y[k + 1] = s + s_rest;
        fvi_memory_push(memory, &s, &d, &sum);
        add(&p, &p_rest, h * (force(k + 1, h) - midpoint));
        add(&p, &p_rest, -pow(h, -0.5) * sum);
    }
    fvi_memory_free(memory);
}

int main(void)
{
    gsl_set_error_handler_off();
    printf(
        "# N, max|x - truth| / max|truth|: second difference, momentum form, "
        "compensated\n");
    for (size_t N = 125; N <= MANY; N *= 2) {
        double h = 20.0 / (double)N, size = 0, error[3] = { 0 };
        run_truth(N, h);
        run_second_difference(N, h, x[0]);
        run_library(N, h, x[1]);
        run_compensated(N, h, x[2]);
        for (size_t k = 0; k <= N; k++) {
            size = fmax(size, fabs((double)truth[k]));
            for (size_t i = 0; i < 3; i++)
                error[i] = fmax(error[i], fabs((double)(x[i][k] - truth[k])));
        }
        printf("%zu %.17g %.17g %.17g\n", N, error[0] / size, error[1] / size,
               error[2] / size);
    }
    return 0;
}
