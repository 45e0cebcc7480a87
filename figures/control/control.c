/* figures/control/control.c -- H 25: bring a spring to rest with the least force, then let it go; and swing up a
 * pendulum.
 *
 * - Block 0: t, x and the least force u, for 0 < t <= T.
 * - Block 1: t, x without a force after T.
 * - Block 2: t, the force that would hold the body at rest after T. It is not zero because the damping
 *   remembers the motion.
 * - Block 3: t, x / pi and the least torque u of a pendulum, for 0 < t <= T. */
#include <fvi/fvi.h>
#include "run/whole_run.h"

#include <stdio.h>
#include <string.h>

enum { N = 320 };

typedef struct {
    double h, u[2 * N + 1];
} table;

static int table_value(double t, size_t d, void *params, double *F)
{
    const table *f = params;
    (void)d;
    F[0] = f->u[(size_t)(t / f->h + 0.5)];
    return 0;
}

/* Print how a spring moves from x = 1 to rest in T = 10, and what happens afterwards. */
static int spring(void)
{
    static table f;
    static double x[2 * N + 1], w[2 * N + 1];
    const double m = 1, rho = 0.375, x0 = 1, p0 = 0.25, rest = 0;
    fvi_system system = { .d = 1,
                          .mass = &m,
                          .damping = &rho,
                          .potential = fvi_potential_harmonic(&m) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 1. / 32, N);
    run.alpha = 0.3125;
    fvi_control_result found;
    if (fvi_control_solve(&fvi_fractional, &run, &rest, &rest, f.u, &found))
        return 1;
    f.h = run.h;
    system.force = (fvi_force){ .value = table_value, .params = &f };
    run.steps = 2 * N;
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL))
        return 1;
    for (size_t k = 0; k <= 2 * N; k++) {
        if (k > 0 && k <= N)
            printf("%.6g %.6g %.6g\n", (double)k * run.h, x[k], f.u[k]);
        if (k == N)
            printf("\n\n");
        if (k >= N)
            printf("%.6g %.6g\n", (double)k * run.h, x[k]);
    }
    printf("\n\n");
    fvi_gl_weights(2 * run.alpha, 2 * N + 1, w);
    for (size_t k = N + 1; k <= 2 * N; k++) { /* the body is held at x_j = 0 for j >= N */
        double H = 0;
        for (size_t j = 0; j <= k; j++)
            H += w[k - j] * ((j < N ? x[j] : 0) - x0);
        printf("%.6g %.6g\n", (double)k * run.h,
               rho * pow(run.h, -2 * run.alpha) * H);
    }
    printf("\n\n");
    return 0;
}

/* Print how a pendulum moves from hanging to standing in T = 16. */
static int pendulum(void)
{
    static double u[N + 1], x[N + 1];
    static table f;
    const double m = 1, g = 1, rho = 0.2, zero = 0, up = M_PI;
    fvi_system system = { .d = 1,
                          .mass = &m,
                          .damping = &rho,
                          .potential = fvi_potential_pendulum(&g) };
    fvi_run run = fvi_run_default(&system, &zero, &zero, 0.05, N);
    run.alpha = 0.3;
    fvi_control_result found;
    if (fvi_control_solve(&fvi_fractional, &run, &up, &zero, u, &found))
        return 1;
    f.h = run.h;
    memcpy(f.u, u, sizeof u);
    system.force = (fvi_force){ .value = table_value, .params = &f };
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL))
        return 1;
    for (size_t k = 1; k <= N; k++)
        printf("%.6g %.6g %.6g\n", (double)k * run.h, x[k] / M_PI, u[k]);
    return 0;
}

int main(void)
{
    printf("# t x u; t x; t hold; t x/pi u\n");
    return spring() || pendulum();
}
