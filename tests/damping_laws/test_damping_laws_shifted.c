/* tests/damping_laws/test_damping_laws_shifted.c -- H 26: fvi-shifted with every kernel.
 * Run alone: make test-damping_laws_shifted */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "damping_laws_ref.h"
#include "harness/ulp.h"

#include <stdlib.h>

static const double one = 1;

/* x at t = 4 of so many steps, from x = 1. */
static double end_of(const fvi_kernel *law, fvi_potential potential, double p0,
                     size_t steps)
{
    const fvi_system system = { 1, &one, &one, potential, { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &p0, 4 / (double)steps, steps);
    double *x = malloc((steps + 1) * sizeof *x);
    run.law = law;
    ck_assert_int_eq(fvi_trajectory(&fvi_cq2_shifted, &run, x, NULL, NULL), 0);
    const double last = x[steps];
    free(x);
    return last;
}

/* Against (26.9) in 40 digits, with a body that was held and let go: an order of 2 for every
 * law, also of those that grow faster than s, as no velocity jumps. Seen: see make seen. */
START_TEST(eq_26_19_order_two_at_a_fixed_time)
{
    size_t ran = 0;
    for (size_t i = 0; i < LEN(ref_motions); i++) {
        if (ref_motions[i].t != 4 || ref_motions[i].x0 != 1)
            continue;
        const fvi_kernel *law = &ref_laws[ref_motions[i].law];
        const fvi_potential spring = fvi_potential_harmonic(&one);
        const double few = end_of(law, spring, 0, 400) - ref_motions[i].x,
                     many = end_of(law, spring, 0, 1600) - ref_motions[i].x,
                     order = log2(fabs(few / many)) / 2;
        seen(fabs(2 - order), "of the order");
        ck_assert_msg(order > 1.9 && order < 2.1, "law %zu: %g, %g",
                      ref_motions[i].law, few, many);
        ran++;
    }
    ck_assert_uint_eq(ran, LEN(ref_laws));
}
END_TEST

/* The same by halved steps of a Duffing oscillator, and with a push for laws up to s. */
START_TEST(eq_26_19_orders_of_a_nonlinear_problem)
{
    const double spring[] = { 1, 1 };
    const fvi_potential duffing = fvi_potential_duffing(spring);
    for (size_t l = 0; l < LEN(ref_laws); l++) {
        const double p0 = fvi_kernel_growth(&ref_laws[l]) > 1 ? 0 : 0.7;
        double x[3];
        for (size_t i = 0; i < 3; i++)
            x[i] = end_of(&ref_laws[l], duffing, p0, (size_t)400 << i);
        const double order = log2(fabs((x[1] - x[0]) / (x[2] - x[1])));
        seen(fabs(2 - order), "of the order");
        ck_assert_msg(order > 1.9 && order < 2.1, "law %zu: %g", l, order);
    }
}
END_TEST

/* One power needs no correction: the run is that of alpha, but for two ways to have weights. */
START_TEST(eq_26_19_a_power_is_alpha)
{
    for (double alpha = 0.1; alpha < 1; alpha += 0.2) {
        const fvi_kernel_term term = { FVI_KERNEL_POWER, 1, alpha, 0, 0 };
        const fvi_kernel law = { 1, &term };
        const double zero = 0;
        const fvi_system system = { 1, &one, &one, fvi_potential_harmonic(&one),
                                    { 0 }, NULL, NULL };
        fvi_run run = fvi_run_default(&system, &one, &zero, 0.02, 200);
        double x[201];
        run.alpha = alpha;
        ck_assert_int_eq(fvi_trajectory(&fvi_cq2_shifted, &run, x, NULL, NULL),
                         0);
        ck_assert_near(end_of(&law, fvi_potential_harmonic(&one), 0, 200), x[200],
                       1e-12, "alpha %g", alpha);
    }
}
END_TEST

/* A run with a step 2 percent above the longest stable one grows, one 2 percent below does
 * not. */
START_TEST(eq_26_19_the_stability_number)
{
    const double stiff = 100;
    for (size_t l = 0; l < LEN(ref_laws); l++)
        for (int above = 0; above <= 1; above++) {
            const double zero = 0;
            const fvi_system system = {
                1, &one, &one, fvi_potential_harmonic(&stiff), { 0 }, NULL, NULL
            };
            fvi_run run = fvi_run_default(&system, &one, &zero, 1e-3, 3000);
            double longest, x[3001];
            run.law = &ref_laws[l];
            run.kappa = 1;
            ck_assert_int_eq(
                fvi_stability_longest_step(&fvi_cq2_shifted, &run, &longest), 0);
            run.h = longest * (above ? 1.02 : 0.98);
            const int status =
                fvi_trajectory(&fvi_cq2_shifted, &run, x, NULL, NULL);
            const double most = status ? INFINITY : fabs(x[3000]);
            ck_assert_msg(above ? most > 1e3 : most < 10, "law %zu, %d: %g", l,
                          above, most);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws: fvi-shifted");
    ADD_CASE(suite, "orders", eq_26_19_order_two_at_a_fixed_time,
             eq_26_19_orders_of_a_nonlinear_problem, eq_26_19_a_power_is_alpha,
             eq_26_19_the_stability_number);
    return run_suite(suite);
}
