/* tests/workshop/curves.c -- A curve for each chapter of the workshop: what its functions
 * make, to be drawn over what those of the course make. `curves 04` prints x and y, line
 * by line, an empty line between two curves, up to the first function that is not there
 * yet. */
#include <fvi/coefficients.h>
#include "run/whole_run.h"
#include <fvi/convolution_quadrature_methods.h>
#include <fvi/discrete_mechanics.h>
#include <fvi/fvi.h>
#include <fvi/paper/experiments.h>
#include <fvi/paper/half_derivative.h>
#include <fvi/paper/integration_by_parts.h>
#include <fvi/paper/legendre.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 60 };

static const double mass = 1, damping = 0.2, one = 1, x0 = 1, p0 = 0.5;

static int trajectory(const fvi_method *method, fvi_potential potential,
                      double alpha, fvi_history_kind memory, size_t every)
{
    enum { MOST = 2000 };
    static double x[MOST + 1];
    const fvi_system system = {
        .d = 1, .mass = &mass, .damping = &damping, .potential = potential
    };
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = 15. / (double)(N * every),
                          .steps = N * every,
                          .kappa = 0.5,
                          .alpha = alpha,
                          .memory = memory,
                          .tolerance = 1e-12,
                          .past = FVI_INITIAL_HISTORY_HELD };
    int status = fvi_trajectory(method, &run, x, NULL, NULL);
    for (size_t k = 0; k <= N && !status; k++)
        printf("%.17g %.17g\n", (double)k * 15. / N, x[k * every]);
    puts("");
    return status;
}

static int weights(void)
{
    double w[N];
    int status = fvi_gl_weights_simple(0.3, N, w);
    for (size_t n = 1; n < N && !status; n++)
        printf("%zu %.17g\n", n, w[n] / 0.3);
    puts("");
    if (!status)
        status = fvi_gl_weights(0.6, N, w);
    for (size_t n = 1; n < N && !status; n++)
        printf("%zu %.17g\n", n, w[n] / 0.6);
    return status;
}

static int derivatives(int twice)
{
    double z[N + 1], out[N + 1];
    for (size_t k = 0; k <= N; k++)
        z[k] = sin(0.1 * (double)k);
    int status = twice ? fvi_delta_twice(0.5, 0.1, N, 1, z, out)
                       : fvi_delta_minus(0.5, 0.1, N, 1, z, out);
    for (size_t k = 0; k <= N && !status; k++)
        printf("%.17g %.17g\n", 0.1 * (double)k, out[k]);
    puts("");
    if (!status)
        status = twice ? fvi_backward_difference(0.05, N, 1, z, out)
                       : fvi_delta_plus(0.5, 0.1, N, 1, z, out);
    for (size_t k = 0; k <= N && !status; k++)
        printf("%.17g %.17g\n", 0.1 * (double)k, out[k]);
    return status;
}

static int momenta(void)
{
    const fvi_system system = { .d = 1,
                                .mass = &mass,
                                .damping = &damping,
                                .potential = fvi_potential_pendulum(&one) };
    double x = x0, p = p0;
    int status = 0;
    for (size_t k = 0; k < N && !status; k++) {
        double y, D;
        status = fvi_legendre_inverse(&system, 0.5, 0.25, &x, &p, &y);
        D = (y - x) / 0.25;
        if (!status)
            status =
                fvi_legendre_plus(&system, 0.5, 0.25, &x, &y, &D, NULL, &p);
        x = y;
        if (!status)
            printf("%.17g %.17g\n", 0.25 * (double)(k + 1), p);
    }
    return status;
}

static int matrix(void)
{
    const double force[] = { 8, 1 };
    double x[N + 1];
    int status =
        fvi_matrix_method(1, 1, 1, 0.75, fvi_force_step(force), 0.25, N, x);
    for (size_t k = 0; k <= N && !status; k++)
        printf("%.17g %.17g\n", 0.25 * (double)k, x[k]);
    return status;
}

int main(int argc, char **argv)
{
    const fvi_potential spring = fvi_potential_harmonic(&one);
    switch (argc == 2 ? atoi(argv[1]) : 0) {
    case 2:
        return trajectory(&fvi_lagrange_dalembert, fvi_potential_pendulum(&one),
                          0.5, FVI_HISTORY_DIRECT, 1);
    case 4:
        return weights();
    case 5:
        return derivatives(0);
    case 7:
        return derivatives(1);
    case 8:
        return momenta();
    case 9:
        return trajectory(&fvi_fractional, spring, 0.25, FVI_HISTORY_DIRECT, 1);
    case 10:
        return matrix();
    case 12:
        return trajectory(&fvi_fractional, spring, 0.25, FVI_HISTORY_DIRECT, 1)
               || trajectory(&fvi_fractional, spring, 0.75,
                             FVI_HISTORY_MODES, 30);
    case 13:
        return trajectory(&fvi_cq2_shifted, spring, 0.25, FVI_HISTORY_DIRECT, 1);
    default:
        return -1;
    }
}
