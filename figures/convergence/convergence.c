/* figures/convergence/convergence.c -- H 20: the errors of fvi under a force that jumps, and their bounds.
 *
 * The system is a pendulum with m = 1, U = 1 - cos x, rho = 0.3, x0 = 1, p0 = 1/2 and Caputo's past. The force
 * jumps from 0 to 1/2 at t = 1, which is not a node of any run. The reference motion is a run of fvi-lobatto4
 * with a node at the jump.
 * - Blocks 0 and 1, for alpha = 1/4 and 3/4: h, the largest errors of x and of v on [0, 3], and their bounds
 *   (20.8).
 * - Blocks 2 to 4, for alpha = 3/4 and T / h = 64, 256, 1024: t, |error of x| / h.
 * - Block 5, for T / h = 1024: t, the sum of the E_k that satisfy (20.7) as an equation, and the bound (20.8)
 *   divided by h. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FINE = 12288, N = 1024 };

static const double one = 1, rho = 0.3, x0 = 1, p0 = 0.5, T = 3, height = 0.5;
static double x[FINE + 1], p[FINE + 1], want_x[FINE + 1], want_p[FINE + 1];

static int jump(double t, size_t d, void *params, double *F)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        F[i] = t > 1 ? height : t == 1 ? height / 2 : 0;
    return FVI_SUCCESS;
}

static void solve(const fvi_method *method, double alpha, size_t steps,
                  double *at_x, double *at_p)
{
    const fvi_system system = {
        1, &one, &rho, fvi_potential_pendulum(&one), { .value = jump }, NULL, NULL
    };
    fvi_run run = fvi_run_default(&system, &x0, &p0, T / (double)steps, steps);
    run.alpha = alpha;
    run.past = FVI_INITIAL_HISTORY_CAPUTO;
    if (fvi_trajectory(method, &run, at_x, at_p, NULL))
        exit(EXIT_FAILURE);
}

/* Compute the reference motion into want_x and want_p, and the constants of the theorem into *q. Return the bound. */
static fvi_error_bound compute_reference(double alpha, fvi_smoothness *q)
{
    solve(&fvi_lobatto_m4, alpha, FINE, want_x, want_p);
    *q = (fvi_smoothness){ .alpha = alpha,
                       .kappa = 0.5,
                       .T = T,
                       .damping = rho,
                       .lipschitz = 1,
                       .gradient = 1,
                       .variation = height,
                       .start = p0,
                       .room = GSL_POSINF };
    for (size_t k = 8; k <= FINE; k++) {
        const double a = (want_p[k] - want_p[k - 8]) / (8 * T / FINE);
        q->speed = larger(q->speed, 1.01 * fabs(want_p[k]));
        q->acceleration = larger(q->acceleration, 1.05 * fabs(a));
    }
    fvi_error_bound bound;
    if (fvi_error_bound_compute(q, &bound))
        exit(EXIT_FAILURE);
    return bound;
}

static void over_steps(double alpha)
{
    fvi_smoothness q;
    const fvi_error_bound bound = compute_reference(alpha, &q);
    const double C = bound.C, l = bound.lambda;
    printf("# alpha = %g: h, errors of x, v, their bounds; C = %.3g, "
           "lambda = %.3g\n",
           alpha, C, l);
    for (size_t steps = 16; steps <= 2048; steps *= 2) {
        const double h = T / (double)steps;
        double off_x = 0, off_p = 0;
        solve(&fvi_fractional, alpha, steps, x, p);
        for (size_t k = 0; k <= steps; k++) {
            const size_t there = k * (FINE / steps);
            off_x = larger(off_x, fabs(x[k] - want_x[there]));
            off_p = larger(off_p, fabs(p[k] - want_p[there]));
        }
        printf("%.9g %.9g %.9g %.9g %.9g\n", h, off_x, off_p,
               2 * C * h * expm1(l * T) / l, 2 * C * h * exp(l * T));
    }
    printf("\n\n");
}

static void over_time(double alpha)
{
    fvi_smoothness q;
    const fvi_error_bound bound = compute_reference(alpha, &q);
    for (size_t steps = 64; steps <= N; steps *= 4) {
        const double h = T / (double)steps;
        solve(&fvi_fractional, alpha, steps, x, p);
        for (size_t k = 1; k <= steps; k++)
            printf("%.9g %.9g\n", (double)k * h,
                   fabs(x[k] - want_x[k * (FINE / steps)]) / h);
        printf("\n\n");
    }
    /* Solve (20.7) with = instead of <=. */
    const double h = T / N, gamma = 2 - 2 * alpha, C = bound.C,
                 l = bound.lambda;
    double b[N], E[N + 1], fed = 0;
    b[0] = 1;
    for (size_t n = 1; n < N; n++)
        b[n] = b[n - 1] * ((double)n - 1 + gamma) / (double)n;
    for (size_t k = 0; k < N; k++) {
        E[k + 1] = C * h;
        for (size_t j = 1; j <= k; j++)
            E[k + 1] += (rho * pow(h, gamma) * b[k - j]
                         + q.lipschitz * h * h * (double)(k + 1 - j))
                        * E[j];
        const double t = (double)(k + 1) * h;
        fed += E[k + 1];
        printf("%.9g %.9g %.9g\n", t, fed, 2 * C * expm1(l * t) / l);
    }
}

int main(void)
{
    over_steps(0.25);
    over_steps(0.75);
    over_time(0.75);
    return EXIT_SUCCESS;
}
