/* tests/blocks/test_blocks_wave.c -- Chapter 28: a string against one oscillator.
 * Run alone: make test-blocks_wave */
#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <stdlib.h>

enum { POINTS = 199, STEPS = 2000 };
static const double step = 0.5, rho = 0.05, zero = 0, one = 1;

/* Algorithm 3 at kappa = 1 for one oscillator: x_0, ..., x_STEPS from 1 at rest. */
static void oscillator(double c, double alpha, double *x)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &one, &zero, step, STEPS);
    run.kappa = 1;
    run.alpha = alpha;
    run.memory = FVI_MEMORY_EXPONENTIALS;
    fvi_stepper *s;
    ck_assert_int_eq(fvi_start(&fvi_fractional, &run, &s), FVI_SUCCESS);
    for (x[0] = 1; s->k < STEPS; x[s->k] = s->x[0])
        ck_assert_int_eq(fvi_step(s), FVI_SUCCESS);
    fvi_stop(s);
}

/* u'' + rho D^{2 alpha} u = second difference of u, ends fixed: from an eigenvector each
 * point is one oscillator. The string's step is written out here and knows nothing of
 * steppers. Its roundings make an error of a few u in p a step, and, the wave being stable,
 * one of a few u / omega in u, omega > 0.04 for the slowest: at worst 100 u STEPS.
 * Roundings go both ways, and 4 u STEPS is demanded, 9e-13. Seen: 0.014 of that. */
START_TEST(eq_28_1_every_point_of_a_wave_is_one_oscillator)
{
    static double u[POINTS + 2], p[POINTS + 2], z[POINTS + 2], dz[POINTS + 2];
    static double u0[POINTS + 2], x[STEPS + 1];
    const double pi = acos(-1);
    for (size_t waves = 3; waves < 200; waves += 49) {
        const double alpha = waves % 2 ? 0.25 : 0.75;
        const double half = sin(pi * (double)waves / (2 * (POINTS + 1)));
        oscillator(4 * half * half, alpha, x);
        fvi_memory *m;
        ck_assert_int_eq(fvi_memory_alloc(2 * alpha, POINTS, STEPS,
                                          FVI_MEMORY_EXPONENTIALS, 0, &m),
                         FVI_SUCCESS);
        for (size_t i = 0; i < POINTS + 2; i++) {
            u0[i] = sin(pi * (double)(waves * i % (2 * (POINTS + 1)))
                        / (POINTS + 1));
            u[i] = i % (POINTS + 1) ? u0[i] : 0;
            p[i] = z[i] = dz[i] = 0;
        }
        fvi_memory_push(m, z + 1, dz + 1, z + 1);
        for (size_t k = 1; k <= STEPS; k++) {
            double left = 0;
            for (size_t i = 1; i <= POINTS; i++) {
                const double here = u[i];
                p[i] -= step * ((here - left) - (u[i + 1] - here));
                u[i] += step * p[i];
                z[i] = u[i] - u0[i];
                dz[i] = u[i] - here;
                left = here;
            }
            fvi_memory_push(m, z + 1, dz + 1, z + 1);
            for (size_t i = 1; i <= POINTS; i++) {
                p[i] -= rho * pow(step, 1 - 2 * alpha) * z[i];
                ck_assert_near(u[i], x[k] * u0[i], 4 * U * STEPS,
                               "waves %zu, step %zu, point %zu", waves, k, i);
            }
        }
        fvi_memory_free(m);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("28 blocks: a wave");
    ADD_CASE(suite, "runs", eq_28_1_every_point_of_a_wave_is_one_oscillator);
    return run_suite(suite);
}
