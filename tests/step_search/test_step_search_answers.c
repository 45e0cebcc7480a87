/* tests/step_search/test_step_search_answers.c -- H 18: the results of a search, and searches that are refused.
 * Run alone: make test-step_search_answers */
#include "step_search_runs.h"
#include "run/whole_run.h"
#include "error_control/step_search.h"

/* Two Duffing oscillators, one damped, with a force: a run in R^2. */
static const double mass[] = { 1, 2 }, damping[] = { 0.5, 0 }, cg[] = { 1, 1 },
                    start[] = { 1, -0.5 }, momentum[] = { 0, 1 },
                    drive[] = { 0.5, 1 };

static fvi_system pair(void)
{
    return (fvi_system){
        2, mass, damping, fvi_potential_chain(cg), fvi_force_cosine(drive), NULL, NULL
    };
}

static fvi_run pair_run(const fvi_system *system)
{
    return (fvi_run){ .system = system,
                      .x0 = start,
                      .p0 = momentum,
                      .h = 0.25,
                      .steps = 40,
                      .kappa = 0.5,
                      .alpha = 0.3,
                      .past = FVI_INITIAL_HISTORY_CAPUTO };
}

/* What is given out is that very run: parts divides each step exactly. */
START_TEST(the_rows_are_those_of_the_run_that_was_found)
{
    enum { MOST = 40 << 12 };
    static double x[82], p[82], all[2 * (MOST + 1)], all_p[2 * (MOST + 1)];
    const fvi_system system = pair();
    fvi_run run = pair_run(&system);
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_cq2_shifted, &run, 1e-5, MOST, x, p, &found),
        FVI_SUCCESS);
    ck_assert(found.parts >= 4 && found.parts <= 1 << 12);
    ck_assert(found.estimate <= 1e-5 && found.order <= 2);
    run.h /= (double)found.parts;
    run.steps *= found.parts;
    ck_assert_int_eq(fvi_trajectory(&fvi_cq2_shifted, &run, all, all_p, NULL),
                     FVI_SUCCESS);
    for (size_t k = 0; k <= 40; k++)
        for (size_t i = 0; i < 2; i++) {
            ck_assert_ulp(x[2 * k + i], all[2 * k * found.parts + i], 0,
                          "x, k=%zu", k);
            ck_assert_ulp(p[2 * k + i], all_p[2 * k * found.parts + i], 0,
                          "p, k=%zu", k);
        }
}
END_TEST

/* Nothing is solved here, but order 6 at 1e-11 knows better than order 2. Each
 * keeps to what was asked, so they differ by no more than both together. */
START_TEST(two_methods_agree_to_what_was_asked_of_them)
{
    double x[82], y[82];
    const fvi_system system = pair();
    const fvi_run run = pair_run(&system);
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_cq2_shifted, &run, 1e-6, 1 << 24, x, NULL, &found),
        FVI_SUCCESS);
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto_m4, &run, 1e-11, 1 << 24, y, NULL, &found),
        FVI_SUCCESS);
    ck_assert(found.order == 6 - 2 * run.alpha); /* more is not believed */
    for (size_t i = 0; i < 82; i++)
        ck_assert_near(x[i], y[i], 1e-6 + 1e-11, "row %zu", i / 2);
}
END_TEST

/* Of a method the numbers are read; the words may be missing. */
START_TEST(the_order_is_a_number_of_the_method)
{
    const fvi_system system = pair();
    const fvi_run run = pair_run(&system);
    const fvi_method *const all[] = {
        &fvi_midpoint_variational,    &fvi_lagrange_dalembert, &fvi_euler_explicit,
        &fvi_euler_implicit, &fvi_fractional,         &fvi_cq2_shifted,
        &fvi_cq_bdf2,           &fvi_lobatto_m2,           &fvi_lobatto_m3,
        &fvi_lobatto_m4
    };
    const char *const words[] = { "%d", "%d or %d", "%d to %d" };
    for (size_t i = 0; i < LEN(all); i++) {
        char order[3][32];
        int same = 0;
        for (int n = 0; n < 3; n++) {
            snprintf(order[n], sizeof order[n], words[n], all[i]->lowest,
                     all[i]->highest);
            same |= strcmp(order[n], all[i]->order) == 0
                    && (n > 0) == (all[i]->lowest < all[i]->highest);
        }
        ck_assert_msg(same, "%s: %s", all[i]->name, all[i]->order);
        ck_assert_int_eq(all[i]->stages != 0,
                         strncmp(all[i]->name, "fvi-lobatto", 11) == 0);
    }
    fvi_method nameless = fvi_cq2_shifted;
    nameless.name = nameless.order = nameless.memory = NULL;
    double x[82], y[82];
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&nameless, &run, 1e-4, 1 << 20, x, NULL, &found),
        FVI_SUCCESS);
    ck_assert_int_eq(
        fvi_step_search(&fvi_cq2_shifted, &run, 1e-4, 1 << 20, y, NULL, &found),
        FVI_SUCCESS);
    for (size_t i = 0; i < 82; i++) /* and the same question has one answer */
        ck_assert_ulp(x[i], y[i], 0, "row %zu", i / 2);
}
END_TEST

/* What is named has a higher order and takes the run. */
START_TEST(another_method_is_named_if_its_order_is_higher)
{
    const fvi_system system = pair();
    fvi_run run = pair_run(&system);
    ck_assert(fvi_step_search_other(&fvi_fractional, &run) == &fvi_variable_step);
    ck_assert(fvi_step_search_other(&fvi_lobatto_m4, &run) == &fvi_variable_step);
    ck_assert(fvi_step_search_other(&fvi_variable_step, &run) == NULL);
    const double alpha = run.alpha;
    run.alpha = 0.5; /* where eight stages have order 14 */
    ck_assert(fvi_step_search_other(&fvi_fractional, &run) == &fvi_variable_step);
    run.alpha = alpha;
    const fvi_kernel_term term = { .kind = FVI_KERNEL_MAXWELL, .rho = 1, .time = 2 };
    const fvi_kernel law = { 1, &term };
    run.law = &law;
    ck_assert(fvi_step_search_other(&fvi_cq_bdf2, &run) == &fvi_variable_step);
    const fvi_kernel_term steep = { .kind = FVI_KERNEL_POWER, .rho = 1, .alpha = 0.7 };
    const fvi_kernel power = { 1, &steep };
    run.law = &power; /* not for fvi-adaptive where a velocity jumps */
    const fvi_method *other = fvi_step_search_other(&fvi_cq_bdf2, &run);
    ck_assert(other && other->takes_laws && !other->dense);
    run.law = NULL;
    const fvi_matrices matrices = { 0 };
    fvi_system with_matrices = system; /* fvi-adaptive takes them, and of the stages form D */
    with_matrices.matrices = &matrices;
    run.system = &with_matrices;
    ck_assert(fvi_step_search_other(&fvi_fractional, &run) == &fvi_variable_step);
    ck_assert(fvi_step_search_other(&fvi_cq_bdf2, &run) == &fvi_variable_step);
    run.kappa = 1; /* leaves order 1 to those that have a kappa */
    ck_assert(fvi_step_search_other(&fvi_fractional, &run) == &fvi_variable_step);
    ck_assert(fvi_step_search_other(&fvi_variable_step, &run) == NULL);
    run.memory = FVI_HISTORY_DIRECT; /* not for fvi-adaptive */
    ck_assert(fvi_step_search_other(&fvi_fractional, &run) == &fvi_lobatto_d8);
}
END_TEST

/* Algorithm 3 has its order 1 from a start that was held away from 0. */
START_TEST(eq_18_2_a_held_start_is_no_kick)
{
    const fvi_system system = pair();
    fvi_run run = pair_run(&system);
    double x[82];
    fvi_step_found found;
    run.alpha = 0.3;
    run.past = FVI_INITIAL_HISTORY_HELD;
    ck_assert_int_eq(fvi_step_search(&fvi_fractional, &run, 1e-3, 1 << 20, x, NULL, &found), FVI_SUCCESS);
    ck_assert_near(found.order, 1, 0.2, "order"); /* seen: 0.90 */
    run.kappa = 1; /* and so have methods of order 2 with such a kappa */
    ck_assert_int_eq(fvi_step_search(&fvi_cq_bdf2, &run, 1e-3, 1 << 20, x, NULL, &found), FVI_SUCCESS);
    ck_assert_near(found.order, 1, 0.2, "order");
}
END_TEST

/* ---- errors ---- */

static size_t forces;

static int count(double t, size_t d, void *params, double *F)
{
    fvi_force_cosine(params).value(t, d, params, F);
    forces++;
    return 0;
}

START_TEST(an_error_out_of_reach_is_reported_with_the_best)
{
    double x[82] = { -77 };
    fvi_system system = pair();
    system.force.value = count;
    const fvi_run run = pair_run(&system);
    fvi_step_found found = { 0 };
    /* rounding: the run before the estimates grow is near 1e-13 */
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto_m4, &run, 1e-16, 1 << 24, x, NULL, &found),
        FVI_ETOL);
    ck_assert(found.estimate > 1e-13 && found.estimate < 1e-11);
    ck_assert(found.parts < 1 << 10);
    /* three runs more; four values a step, all runs twice the last of them; and
     * three values at each of 128 times for each of 8 runs */
    ck_assert(forces > 0
              && forces < 4 * 2 * 8 * 40 * found.parts + 8 * 3 * 128);
    /* steps: 160, 320, 640 and 1280 are allowed, 2560 are not */
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 1e-9, 2559, x, NULL, &found),
        FVI_ETOL);
    ck_assert_uint_eq(found.parts, 32);
    ck_assert(found.estimate > 1e-4 && found.estimate < 1);
    /* three runs are not enough for two orders */
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 1e9, 1279, x, NULL, &found),
        FVI_ETOL);
    ck_assert(gsl_isinf(found.estimate));
    ck_assert(x[0] == -77);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    double x[82] = { -77 }, p[82] = { -77 };
    const fvi_system system = pair();
    const fvi_run good = pair_run(&system);
    fvi_step_found found = { .parts = 77 };
    const fvi_method *m = &fvi_cq2_shifted;
#define REFUSED(call, code) ck_assert_int_eq(call, code)
    REFUSED(fvi_step_search(NULL, &good, 1, 1000, x, p, &found), FVI_EFAULT);
    REFUSED(fvi_step_search(m, NULL, 1, 1000, x, p, &found), FVI_EFAULT);
    REFUSED(fvi_step_search(m, &good, 1, 1000, NULL, p, &found), FVI_EFAULT);
    REFUSED(fvi_step_search(m, &good, 1, 1000, x, p, NULL), FVI_EFAULT);
    const double errors[] = { 0, -1, GSL_NAN, GSL_POSINF };
    for (size_t i = 0; i < LEN(errors); i++)
        REFUSED(fvi_step_search(m, &good, errors[i], 1000, x, p, &found),
                FVI_EDOM);
    fvi_run bad = good;
    bad.steps = 0;
    REFUSED(fvi_step_search(m, &bad, 1, 1000, x, p, &found), FVI_EINVAL);
    bad.steps = SIZE_MAX / 16;
    REFUSED(fvi_step_search(m, &bad, 1, 1000, x, p, &found), FVI_EINVAL);
    bad.steps = (size_t)1 << 50; /* can be addressed, but not had */
    REFUSED(fvi_step_search(m, &bad, 1, SIZE_MAX, x, p, &found), FVI_ENOMEM);
    bad = good;
    bad.h = -1;
    REFUSED(fvi_step_search(m, &bad, 1, 1000, x, p, &found), FVI_EDOM);
    bad = good;
    bad.memory = FVI_HISTORY_DIRECT; /* not for steps of its own */
    REFUSED(fvi_step_search(&fvi_variable_step, &bad, 1, 1000, x, p, &found),
            FVI_EUNSUP);
    const fvi_method nameless = { .alpha_most = 1,
                                  .start = fvi_cq2_shifted.start,
                                  .step = fvi_cq2_shifted.step,
                                  .stop = fvi_cq2_shifted.stop };
    REFUSED(fvi_step_search(&nameless, &good, 1, 1000, x, p, &found),
            FVI_EINVAL);
    ck_assert(x[0] == -77 && p[0] == -77 && found.parts == 77);
}
END_TEST

/* Riemann-Liouville, x0 != 0, alpha > 1/2: Algorithm 3 runs it and converges to
 * nothing. Where that coordinate is not damped there is a solution. */
START_TEST(what_has_no_solution_has_no_error)
{
    double x[82] = { -77 };
    fvi_system system = pair();
    fvi_run run = pair_run(&system);
    fvi_step_found found;
    run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    run.alpha = 0.75;
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 1, 1 << 16, x, NULL, &found),
        FVI_EDOM);
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto_m3, &run, 1, 1 << 16, x, NULL, &found),
        FVI_EDOM);
    ck_assert(x[0] == -77);
    const double away[] = { 0, -0.5 };
    run.x0 = away;
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 1, 1 << 16, x, NULL, &found),
        FVI_SUCCESS);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the search for a step: answers");
    ADD_CASE(suite, "identities", the_rows_are_those_of_the_run_that_was_found,
             two_methods_agree_to_what_was_asked_of_them,
             the_order_is_a_number_of_the_method,
             another_method_is_named_if_its_order_is_higher,
             eq_18_2_a_held_start_is_no_kick);
    ADD_CASE(suite, "errors", an_error_out_of_reach_is_reported_with_the_best,
             bad_arguments_are_refused, what_has_no_solution_has_no_error);
    return run_suite(suite);
}
