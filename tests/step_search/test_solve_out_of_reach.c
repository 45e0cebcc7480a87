/* tests/step_search/test_solve_out_of_reach.c -- The function fvi_solve with a tolerance that cannot be reached.
 * Run alone: make test-solve_out_of_reach */
#include "harness/ulp.h"
#include "known_motion.h"

#include <string.h>

static fvi_error error;

/* What cannot be reached is said with what can. */
START_TEST(the_smallest_estimate_is_reported)
{
    const fvi_problem problem = duffing();
    double x[3] = { 0 };
    const fvi_solve_options options = { .method = &fvi_cq_bdf2 };
    const fvi_accuracy accuracy = { .tolerance = 1e-12, .most_steps = 4096 };
    const fvi_outputs outputs = { .rows = 3, .x = x };
    fvi_report report;
    ck_assert_int_eq(
        fvi_solve(&problem, &options, &accuracy, &outputs, &report, &error),
        FVI_ETOL);
    ck_assert(report.error > 1e-12 && report.error < 1e-4 && report.other
              && x[0] == 0);
    ck_assert_ptr_nonnull(strstr(error.text, "smallest estimate"));
    ck_assert_str_eq(error.field, "tolerance");
}
END_TEST

/* A double well that is driven is chaotic: near motions part like e^(0.2 t). The time up to which the tolerance is reached
 * grows with it, and a motion up to there has it. */
START_TEST(the_time_up_to_which_a_tolerance_is_reached_is_told)
{
    static const double well[] = { -1, 1 }, aw[] = { 0.5, 1.2 };
    static const fvi_method *const methods[] = { &fvi_variable_step, &fvi_lobatto_m4 };
    for (size_t m = 0; m < LEN(methods); m++) {
        double x[401], until = 0;
        fvi_problem problem = duffing();
        problem.system.potential = fvi_potential_duffing(well);
        problem.system.force = fvi_force_cosine(aw);
        problem.T = 400;
        const fvi_solve_options options = { .method = methods[m] };
        const fvi_outputs outputs = { .rows = LEN(x), .x = x };
        for (double tolerance = 1e-9; tolerance < 1e-2; tolerance *= 1000) {
            const fvi_accuracy accuracy = { .tolerance = tolerance, .most_steps = 1 << 14 };
            fvi_report report = { .until = 0 };
            ck_assert_int_eq(fvi_solve(&problem, &options, &accuracy, &outputs, &report, &error), FVI_ETOL);
            ck_assert(report.until > until && report.until < problem.T);
            ck_assert_ptr_nonnull(strstr(error.text, "is reached: end there, or allow a larger error"));
            until = report.until;
        }
        problem.T = floor(until * 0.9);
        const fvi_accuracy accuracy = { .tolerance = 1e-3 };
        const fvi_outputs shorter = { .rows = (size_t)problem.T + 1, .x = x };
        OK(fvi_solve(&problem, &options, &accuracy, &shorter, NULL, &error));
    }
}
END_TEST

/* Two runs agree up to T, and there is no third run that shows an order: no shorter motion is advised. */
START_TEST(no_time_is_told_where_runs_agree_to_the_end)
{
    double x[17];
    const fvi_problem problem = duffing();
    const fvi_solve_options options = { .method = &fvi_lobatto_m4 };
    const fvi_outputs outputs = { .rows = LEN(x), .x = x };
    const fvi_accuracy two_runs = { .tolerance = 1e-6, .most_steps = 256 };
    fvi_report report;
    ck_assert_int_eq(fvi_solve(&problem, &options, &two_runs, &outputs, &report, &error), FVI_ETOL);
    ck_assert(isinf(report.error) && report.until == 0);
    ck_assert_ptr_null(strstr(error.text, "it is reached"));
}
END_TEST

/* The shortest step is 1e-14 T, and the fastest decay rate is 2e4 / (1e-14 T), which is no number below T = 1.1e-290. */
START_TEST(a_motion_that_is_too_short_for_a_memory_is_no_lack_of_memory)
{
    double x[3];
    fvi_problem problem = duffing();
    problem.alpha = 0.3;
    problem.T = 1e-291;
    const fvi_accuracy accuracies[] = { { .tolerance = 1e-9 }, { .tolerance = 0 } };
    const fvi_solve_options options = { .method = &fvi_variable_step };
    const fvi_outputs outputs = { .rows = LEN(x), .x = x };
    for (size_t i = 0; i < LEN(accuracies); i++) {
        ck_assert_int_eq(fvi_solve(&problem, &options, &accuracies[i], &outputs, NULL, &error), FVI_EDOM);
        ck_assert_str_eq(error.field, "T");
        ck_assert(error.value == 1e-291 && strstr(error.text, "too short: the fastest decay rate of its memory"));
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the one call, out of reach");
    ADD_CASE(suite, "solve", the_smallest_estimate_is_reported, the_time_up_to_which_a_tolerance_is_reached_is_told,
             no_time_is_told_where_runs_agree_to_the_end,
             a_motion_that_is_too_short_for_a_memory_is_no_lack_of_memory);
    return run_suite(suite);
}
