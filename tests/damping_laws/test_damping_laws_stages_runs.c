/* tests/damping_laws/test_damping_laws_stages_runs.c -- H 26: runs on Lobatto nodes
 * with a law.
 * Run alone: make test-damping_laws_stages_runs */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "error_control/step_search.h"
#include "harness/ulp.h"
#include "law_runs.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <stdlib.h>

static const double one = 1;

/* x at t = 4, from x = 1, by so many steps. */
static double end_of(const fvi_method *method, const fvi_kernel *law,
                     fvi_potential potential, double p0, fvi_history_kind kind,
                     size_t steps)
{
    const fvi_system system = { 1, &one, &one, potential, { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &p0, 4 / (double)steps, steps);
    run.law = law;
    run.memory = kind;
    double *x = malloc((steps + 1) * sizeof *x);
    ck_assert_ptr_nonnull(x);
    ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL), 0);
    const double last = x[steps];
    free(x);
    return last;
}

/* Against the exact solution at t = 4, kicked off: orders 2, 4 and 6 as for a power, and
 * for every law, while the errors are above 1e-14; and with 8 stages 32 steps leave
 * no more than the exact solution may be off. */
START_TEST(eq_26_12_orders_at_a_fixed_time)
{
    const fvi_method *const methods[] = { &fvi_lobatto_d2, &fvi_lobatto_d3,
                                          &fvi_lobatto_d4 };
    const fvi_potential spring = fvi_potential_harmonic(&one);
    for (size_t l = 0; l < LAWS; l++) {
        const fvi_kernel *law = law_of(l);
        const fvi_linear_oscillator p = {
            .m = 1, .c = 1, .rho = 1, .x0 = 1, .v0 = 0.7, .law = law
        };
        const double t = 4;
        double x;
        ck_assert_int_eq(fvi_exact_at(&p, 1, &t, &x, NULL, NULL), 0);
        for (int m = 0; m < 3; m++) {
            double left[2];
            for (int i = 0; i < 2; i++)
                left[i] = end_of(methods[m], law, spring, 0.7, FVI_HISTORY_AUTO,
                                 (size_t)(m == 2 ? 24 : 128) << i)
                          - x;
            const double order = log2(fabs(left[0] / left[1]));
            seen(2 * m + 2 - order, "short of the order");
            /* above: two powers of h meet at one law, else 0.09 */
            ck_assert_msg(order > 2 * m + 1.6 && order < 2 * m + 2.8,
                          "law %zu %s: %g, %g", l, methods[m]->name, left[0],
                          left[1]);
        }
        for (int direct = 0; direct <= 1; direct++) {
            const double last =
                end_of(&fvi_lobatto_d8, law, spring, 0.7,
                       direct ? FVI_HISTORY_DIRECT : FVI_HISTORY_AUTO, 32);
            ck_assert_near(last, x, 2e-13, "law %zu, %d", l, direct);
            seen(fabs(last - x), "left");
        }
    }
}
END_TEST

/* The order that x(4) of 1, 2 and 4 times N steps shows in a Duffing spring c = 1, g. */
static double changes(const fvi_method *method, const fvi_kernel *law, double g,
                      double p0, size_t N)
{
    const double spring[] = { 1, g };
    double x[3];
    for (int i = 0; i < 3; i++)
        x[i] = end_of(method, law, fvi_potential_duffing(spring), p0,
                      FVI_HISTORY_AUTO, N << i);
    return log2(fabs((x[1] - x[0]) / (x[2] - x[1])));
}

/* A Duffing oscillator, kicked off, by the changes of x(4) when steps are halved: orders
 * 2, 4 and 6 for the laws of orders up to 1; above, at least 3 and not 4, though there are
 * six stages: what the memory of the kick does to the first nodes is not paid back. */
START_TEST(eq_26_12_orders_of_a_nonlinear_problem)
{
    const fvi_method *const methods[] = { &fvi_lobatto_d2, &fvi_lobatto_d3,
                                          &fvi_lobatto_d4 };
    for (size_t l = 0; l < 6; l++)
        for (int m = 0; m < 3; m++) {
            const fvi_kernel *law = l < 5 ? law_of(l) : &steep_laws[0];
            const double order =
                changes(methods[m], law, 1, 0.7, (size_t)(m < 2 ? 160 : 80));
            seen(2 * m + 2 - order, "short of the order");
            ck_assert_msg(order > 2 * m + 1.6 && order < 2 * m + 2.8,
                          "law %zu %s: %g", l, methods[m]->name, order);
        }
    for (double alpha = 0.8; alpha < 0.96; alpha += 0.05) {
        const fvi_kernel_term term = { FVI_KERNEL_POWER, 2, alpha, 0, 0 };
        const double order =
            changes(&fvi_lobatto_d6, &(fvi_kernel){ 1, &term }, 10, 3, 80);
        seen(order, "order of a kick");
        seen(-order, "order of a kick, below");
        ck_assert_msg(order > 2.8 && order < 4, "%g: %g", alpha, order);
    }
}
END_TEST

/* (17.28) asks only that C be passive: random laws of any order, up to 10^6 strong, springs
 * and steps over decades. Of 600 steps the second half is below the first, and all below the start. */
START_TEST(eq_17_28_form_d_with_a_law_is_stable_for_every_step)
{
    const fvi_method *const methods[] = { &fvi_lobatto_d2, &fvi_lobatto_d3,
                                          &fvi_lobatto_d4, &fvi_lobatto_d6 };
    gsl_rng *random = gsl_rng_alloc(gsl_rng_taus2);
    static double x[601];
    for (int n = 0; n < 200; n++) {
        const double c = pow(10, 6 * gsl_rng_uniform(random) - 2), zero = 0;
        fvi_kernel_term t[2];
        for (int i = 0; i < 2; i++)
            t[i] =
                (fvi_kernel_term){ (fvi_kernel_kind)((n + i) % 4),
                                pow(10, 8 * gsl_rng_uniform(random) - 2),
                                0.02 + 0.97 * gsl_rng_uniform(random),
                                pow(10, 4 * gsl_rng_uniform(random) - 2), 1 };
        const fvi_kernel law = { 2, t };
        const fvi_system system = { 1,     &one,
                                    &one,  fvi_potential_harmonic(&c),
                                    { 0 }, NULL, NULL };
        fvi_run run = fvi_run_default(&system, &one, &zero, 0.3, 600);
        double load = 7, half[2] = { 0, 0 };
        run.law = &law;
        const fvi_method *const method = methods[n / 4 % 4];
        ck_assert_int_eq(fvi_stability_number(method, &run, &load), 0);
        ck_assert_double_eq(load, 0);
        ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, NULL), 0);
        for (size_t k = 1; k <= 600; k++)
            half[k > 300] = larger(half[k > 300], fabs(x[k]));
        ck_assert_msg(half[0] < 1 + 1e-9 && half[1] <= half[0], "%d: %g %g", n,
                      half[0], half[1]);
    }
    gsl_rng_free(random);
}
END_TEST

/* A fraction with a pole near its cut, or off it, has no modes; the others have. */
START_TEST(what_stages_do_not_take_is_refused)
{
    const fvi_kernel_term terms[] = { { FVI_KERNEL_ZENER, 1, 0.47, 1, 0 },
                                   { FVI_KERNEL_ZENER, 1, 0.7, 1, 0 },
                                   { FVI_KERNEL_POWER, 1, 0.6, 0, 0 },
                                   { FVI_KERNEL_ZENER, 1, 0.6, 0, 0 },
                                   { FVI_KERNEL_DISTRIBUTED, 1, 0.1, 0, 0.6 },
                                   { FVI_KERNEL_ZENER, 0, 0.7, 1, 0 },
                                   { FVI_KERNEL_ZENER, 1, 0.5, 1, 0 } };
    const fvi_system system = { 1,     &one, &one, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &one, 0.1, 100);
    for (size_t i = 0; i < LEN(terms); i++) {
        const fvi_kernel law = { 1, &terms[i] };
        fvi_stepper *s = NULL;
        run.law = &law;
        for (int modes = 0; modes <= 1; modes++) {
            run.memory = modes ? FVI_HISTORY_MODES : FVI_HISTORY_AUTO;
            const int refused = modes && i < 2;
            ck_assert_int_eq(
                fvi_stepper_start(i % 2 ? &fvi_lobatto_m4 : &fvi_lobatto_d4, &run, &s,
                                  NULL),
                refused ? FVI_EUNSUP : FVI_SUCCESS);
            ck_assert_int_eq(s == NULL, refused);
            fvi_stepper_free(s);
            s = NULL;
        }
    }
}
END_TEST

/* A search with a law reads no alpha: the same estimate with any, to the bit. */
START_TEST(a_search_with_a_law_reads_no_alpha)
{
    const double rho = 1, p0 = 0.5, spring[] = { 1, 0.5 };
    const fvi_kernel_term power = { FVI_KERNEL_POWER, 1, 0.3, 0, 0 };
    const fvi_kernel law = { 1, &power };
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_duffing(spring) };
    const double alphas[] = { 0.05, 0.5, 1 };
    double estimate[3], x[11];
    for (int i = 0; i < 3; i++) {
        fvi_run run = fvi_run_default(&system, &one, &p0, 1.9, 10);
        fvi_step_found found;
        run.alpha = alphas[i];
        run.law = &law;
        ck_assert_int_eq(fvi_step_search(&fvi_lobatto_d6, &run, 1e-3, 1 << 14, x,
                                         NULL, &found),
                         0);
        estimate[i] = found.estimate;
    }
    ck_assert(estimate[0] == estimate[1] && estimate[1] == estimate[2]);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws: runs with stages");
    ADD_CASE(suite, "motions", eq_26_12_orders_at_a_fixed_time,
             eq_26_12_orders_of_a_nonlinear_problem,
             eq_17_28_form_d_with_a_law_is_stable_for_every_step);
    ADD_CASE(suite, "errors", what_stages_do_not_take_is_refused,
             a_search_with_a_law_reads_no_alpha);
    return run_suite(suite);
}
