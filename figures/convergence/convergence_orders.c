/* figures/convergence/convergence_orders.c -- H 20: the observed orders of fvi-stable and fvi-lobatto3d for a held
 * body, for every alpha.
 *
 * The system is a spring with m = 1, rho = 1, x_0 = 0.7, v_0 = 1.3 and no force, compared with its exact
 * motion. c is 16 for the times in [1/2, 1] and 1 for the times in [0, 1/4]. Prints a block for each of the two
 * methods: alpha, the orders of x and of p on [1/2, 1], then of x and of p at all nodes of [0, 1/4]. An order
 * is the mean over the last two halvings of h whose errors are above rounding. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 2048 };

static const double one = 1, x0 = 0.7, v0 = 1.3;
static double x[MOST + 1], p[MOST + 1], want_x[MOST + 1], want_p[MOST + 1];
static double times[MOST + 1];

static void solve(const fvi_method *method, double alpha, double c, double T,
                  size_t N)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &one,
                                .potential = fvi_potential_harmonic(&c) };
    const fvi_linear_oscillator motion = { .m = 1,
                                .c = c,
                                .rho = 1,
                                .alpha = alpha,
                                .past = FVI_INITIAL_HISTORY_HELD,
                                .x0 = x0,
                                .v0 = v0 };
    fvi_run run = fvi_run_default(&system, &x0, &v0, T / (double)N, N);
    run.alpha = alpha;
    run.past = FVI_INITIAL_HISTORY_HELD;
    for (size_t k = 0; k <= N; k++)
        times[k] = (double)k * run.h;
    if (fvi_trajectory(method, &run, x, p, NULL)
        || fvi_exact_at(&motion, N + 1, times, want_x, want_p, NULL))
        exit(EXIT_FAILURE);
}

/* Compute the observed orders of x and of p on [T - part T, T], from runs with first, 2 first, ... MOST steps. */
static void orders(const fvi_method *method, double alpha, double c, double T,
                   double part, size_t first, double order[2])
{
    double off[2][12];
    size_t count[2] = { 0, 0 };
    for (size_t N = first; N <= MOST; N *= 2) {
        double error[2] = { 0, 0 };
        solve(method, alpha, c, T, N);
        for (size_t k = 0; k <= N; k++)
            if ((double)k >= (1 - part) * (double)N) {
                error[0] = larger(error[0], fabs(x[k] - want_x[k]));
                error[1] = larger(error[1], fabs(p[k] - want_p[k]));
            }
        for (int of = 0; of < 2; of++)
            if (error[of] > (part < 1 ? 5e-13 : 2e-13))
                off[of][count[of]++] = error[of];
    }
    for (int of = 0; of < 2; of++)
        order[of] = log2(off[of][count[of] - 3] / off[of][count[of] - 1]) / 2;
}

int main(void)
{
    const fvi_method *methods[] = { &fvi_cq2_midpoint, &fvi_lobatto_d3 };
    for (size_t m = 0; m < 2; m++) {
        printf("# %s: alpha, x and p at a fixed time, x and p over all t\n",
               methods[m]->name);
        for (int i = 1; i <= 38; i++) {
            double late[2], all[2];
            const double alpha = i / 40.0;
            orders(methods[m], alpha, 16, 1, 0.5, 8, late);
            orders(methods[m], alpha, 1, 0.25, 1, 8, all);
            printf("%.9g %.9g %.9g %.9g %.9g\n", alpha, late[0], late[1],
                   all[0], all[1]);
        }
        printf("\n\n");
    }
    return EXIT_SUCCESS;
}
