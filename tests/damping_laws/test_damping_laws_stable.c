/* tests/damping_laws/test_damping_laws_stable.c -- H 26: fvi-stable with laws.
 * Run alone: make test-damping_laws_stable */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"
#include "law_runs.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <stdlib.h>

enum { MOST = 3200 };

static const double one = 1;

/* x and p at t = 4 of a spring c, g, kicked off. */
static void end_of(const fvi_kernel *law, const double spring[2], size_t steps,
                   double end[2])
{
    static double x[MOST + 1], p[MOST + 1];
    const double p0 = 0.7;
    const fvi_system system = { 1,
                                &one,
                                &one,
                                spring[1] == 0 ? fvi_potential_harmonic(spring)
                                               : fvi_potential_duffing(spring),
                                { 0 },
                                NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &p0, 4 / (double)steps, steps);
    run.law = law;
    ck_assert_int_eq(fvi_trajectory(&fvi_cq2_midpoint, &run, x, p, NULL), 0);
    end[0] = x[steps];
    end[1] = p[steps];
}

/* Order 2 against the exact solution, x and p, twelve laws: to 0.1. */
START_TEST(eq_26_15_the_order_is_two)
{
    const double spring[2] = { 1, 0 }, t = 4;
    for (size_t l = 0; l < LAWS; l++) {
        const fvi_linear_oscillator exact = {
            .m = 1, .c = 1, .rho = 1, .x0 = 1, .v0 = 0.7, .law = law_of(l)
        };
        double want[2], end[2][2];
        ck_assert_int_eq(fvi_exact_at(&exact, 1, &t, &want[0], &want[1],
                                      NULL), 0);
        for (int i = 0; i < 2; i++)
            end_of(law_of(l), spring, (size_t)1600 << i, end[i]);
        for (int i = 0; i < 2; i++) {
            const double order =
                log2(fabs((end[0][i] - want[i]) / (end[1][i] - want[i])));
            seen(order, "order");
            ck_assert_near(order, 2, 0.1, "law %zu, %c", l, "xp"[i]);
            ck_assert_double_lt(fabs(end[1][i] - want[i]), 1e-5);
        }
    }
}
END_TEST

/* A Duffing oscillator, by the changes of x and p when steps are halved. */
START_TEST(eq_26_15_the_order_of_a_nonlinear_problem)
{
    const double spring[2] = { 1, 1 };
    for (size_t l = 0; l < LAWS; l++) {
        double end[3][2];
        for (int i = 0; i < 3; i++)
            end_of(law_of(l), spring, (size_t)800 << i, end[i]);
        for (int i = 0; i < 2; i++) {
            const double order =
                log2(fabs((end[1][i] - end[0][i]) / (end[2][i] - end[1][i])));
            seen(order, "order");
            ck_assert_near(order, 2, 0.1, "law %zu, %c", l, "xp"[i]);
        }
    }
}
END_TEST

/* Theorem 26.4 on 300 random laws, springs and steps over decades, two masses on a chain:
 * let go, both alike, in 600 steps |x| is never above the start but for roundings; and no
 * load is told of. */
START_TEST(eq_26_15_no_step_is_too_long)
{
    enum { STEPS = 600, D = 2 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_taus2);
    static double x[D * (STEPS + 1)];
    for (int n = 0; n < 300; n++) {
        fvi_kernel_term t[2];
        for (int i = 0; i < 2; i++) {
            const double a = 0.02 + 0.97 * gsl_rng_uniform(random);
            t[i] = (fvi_kernel_term){ (fvi_kernel_kind)gsl_rng_uniform_int(random, 4),
                                   pow(10, 8 * gsl_rng_uniform(random) - 2), a,
                                   pow(10, 4 * gsl_rng_uniform(random) - 2),
                                   a + (1 - a) / 2 };
        }
        const fvi_kernel law = { 2, t };
        const double spring[] = { pow(10, 8 * gsl_rng_uniform(random) - 2), 0 },
                     mass[D] = { 1, 1 }, x0[D] = { 1, 1 }, p0[D] = { 0, 0 };
        const fvi_system system = { D,     mass,
                                    mass,  fvi_potential_chain(spring),
                                    { 0 }, NULL, NULL };
        fvi_run run = fvi_run_default(
            &system, x0, p0, pow(10, 3 * gsl_rng_uniform(random) - 2), STEPS);
        run.law = &law;
        run.memory = FVI_HISTORY_DIRECT;
        double load = 7, most = 0;
        ck_assert_int_eq(fvi_stability_number(&fvi_cq2_midpoint, &run, &load), 0);
        ck_assert_double_eq(load, 0);
        ck_assert_int_eq(fvi_trajectory(&fvi_cq2_midpoint, &run, x, NULL, NULL), 0);
        for (size_t k = 1; k <= STEPS; k++)
            most = larger(most, fabs(x[D * k]));
        ck_assert_msg(most < 1 + 1e-9, "%d: %g", n, most);
        seen(most, "largest");
    }
    gsl_rng_free(random);
}
END_TEST

/* By modes and by all weights, and a copy half way: three masses, 1e-11 of a motion of the
 * order of 1. Seen: 3e-15. */
START_TEST(modes_and_copies_go_the_same_way)
{
    enum { STEPS = 600, D = 3 };
    static double x[2][D * (STEPS + 1)];
    const double spring[] = { 2, 0 }, mass[D] = { 1, 2, 0.5 },
                 rho[D] = { 0.3, 0, 1 }, x0[D] = { 1, 0, -0.5 },
                 p0[D] = { 0.2, 0.7, 0 };
    const fvi_system system = { D,     mass, rho, fvi_potential_chain(spring),
                                { 0 }, NULL, NULL };
    for (size_t l = 0; l < LEN(ref_laws); l++) {
        fvi_run run = fvi_run_default(&system, x0, p0, 0.02, STEPS);
        fvi_stepper *s, *copy;
        run.law = &ref_laws[l];
        for (int i = 0; i < 2; i++) {
            run.memory = i ? FVI_HISTORY_MODES : FVI_HISTORY_DIRECT;
            ck_assert_int_eq(
                fvi_trajectory(&fvi_cq2_midpoint, &run, x[i], NULL, NULL), 0);
        }
        for (size_t k = 0; k < D * (STEPS + 1); k++)
            ck_assert_near(x[1][k], x[0][k], 1e-11, "law %zu, %zu", l, k);
        ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_midpoint, &run, &s,
                                           NULL), 0);
        while (s->k < STEPS / 2)
            ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert_int_eq(fvi_stepper_copy(s, &copy), 0);
        fvi_stepper_free(s);
        while (copy->k < STEPS)
            ck_assert_int_eq(fvi_stepper_step(copy), 0);
        for (size_t i = 0; i < D; i++)
            ck_assert(copy->x[i] == x[1][D * STEPS + i]);
        fvi_stepper_free(copy);
    }
}
END_TEST

/* ---- derivatives ---- */

/* x_60 of a Duffing oscillator, by laws below and above the order 1, and by fractions: the
 * differences are off by some 1e-8 of derivatives of the order of 1. Seen: 2e-8. */
START_TEST(eq_23_6_derivatives_of_laws)
{
    const fvi_method *const methods[] = { &fvi_cq2_midpoint, &fvi_cq_bdf2,
                                          &fvi_fractional };
    const fvi_kernel_term terms[][2] = {
        { { FVI_KERNEL_POWER, 0.5, 0.3, 0, 0 },
          { FVI_KERNEL_MAXWELL, 0.25, 0, 0.5, 0 } },
        { { FVI_KERNEL_POWER, 0.5, 0.8, 0, 0 },
          { FVI_KERNEL_ZENER, 0.25, 0.3, 0.5, 0 } },
        { { FVI_KERNEL_ZENER, 0.5, 0.7, 0.5, 0 },
          { FVI_KERNEL_DISTRIBUTED, 0.25, 0.1, 0, 0.6 } },
    };
    for (size_t l = 0; l < LEN(terms); l++)
        for (size_t m = 0; m < LEN(methods); m++)
            ck_assert_law_slopes(methods[m], &(fvi_kernel){ 2, terms[l] }, 60,
                                 1e-6);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws, fvi-stable");
    ADD_CASE(suite, "runs", eq_26_15_the_order_is_two,
             eq_26_15_the_order_of_a_nonlinear_problem,
             eq_26_15_no_step_is_too_long, modes_and_copies_go_the_same_way);
    ADD_CASE(suite, "derivatives", eq_23_6_derivatives_of_laws);
    return run_suite(suite);
}
