/* tests/step_search/test_solve.c -- The function fvi_solve: a motion at given times.
 * Run alone: make test-solve */
#include "harness/ulp.h"
#include "known_motion.h"
#include "run/whole_run.h"

#include <string.h>

static const double some_times[] = { 0, 0.1, 0.7071067811865476, 1.2345, 1.99 };
static fvi_error error;

/* With a tolerance and nothing else: times that are no grid, and the error is what was asked for. */
START_TEST(a_tolerance_is_reached_at_any_times)
{
    const fvi_problem problem = duffing();
    for (double tolerance = 1e-3; tolerance > 1e-12; tolerance /= 1000) {
        double x[LEN(some_times)], p[LEN(some_times)], e[LEN(some_times)];
        const fvi_accuracy accuracy = { .tolerance = tolerance };
        const fvi_outputs outputs = {
            .rows = LEN(some_times), .t = some_times, .x = x, .p = p, .energy = e
        };
        fvi_report report;
        ck_assert_int_eq(
            fvi_solve(&problem, NULL, &accuracy, &outputs, &report, &error), 0);
        ck_assert_ptr_eq(report.method, &fvi_variable_step);
        ck_assert(report.error <= tolerance && report.steps > 5
                  && report.h > 0);
        for (size_t k = 0; k < LEN(some_times); k++) {
            const double t = some_times[k];
            ck_assert_double_le(fabs(x[k] - known_x(t)), report.error);
            ck_assert_double_eq_tol(p[k], mass * (2 * t - t * t),
                                    100 * tolerance + 1e-12);
            ck_assert_double_eq_tol(e[k], p[k] * p[k] / (2 * mass)
                                              + x[k] * x[k] / 2
                                              + x[k] * x[k] * x[k] * x[k] / 8,
                                    1e-14);
        }
    }
}
END_TEST

/* Steps of any length wherever they take the law; else four stages for a small error, order 2 for a large one. Each
 * reaches its tolerance: against a search by other steps, to 1.1 of it. */
START_TEST(a_law_has_the_method_that_takes_it)
{
    const fvi_kernel_term terms[] = { { FVI_KERNEL_ZENER, 1, 0.3, 0.5, 0 }, { FVI_KERNEL_ZENER, 1, 0.6, 0.5, 0 } };
    const double whole = 1, start = 0.5;
    for (size_t i = 0; i < 2 * LEN(terms); i++) {
        const fvi_kernel law = { 1, &terms[i / 2] };
        const double tolerance = i % 2 ? 1e-7 : 1e-3;
        double x[5], other[5];
        fvi_problem problem = duffing();
        problem.law = &law;
        problem.p0 = &start;
        const fvi_accuracy accuracy = { .tolerance = tolerance };
        fvi_outputs outputs = { .rows = LEN(x), .x = x };
        fvi_report report;
        OK(fvi_solve(&problem, NULL, &accuracy, &outputs, &report, &error));
        ck_assert_ptr_eq(report.method, i < 2    ? &fvi_variable_step
                                        : i == 2 ? &fvi_cq_bdf2
                                                 : &fvi_lobatto_m4);
        const fvi_solve_options by_other = { .method = i < 2 ? &fvi_lobatto_m4 : &fvi_lobatto_d4 };
        outputs.x = other;
        OK(fvi_solve(&problem, &by_other, &(fvi_accuracy){ .tolerance = tolerance / 10 }, &outputs, NULL, &error));
        for (size_t k = 0; k < LEN(x); k++)
            ck_assert_double_le(fabs(x[k] - other[k]), 1.1 * tolerance);
        const fvi_solve_options by_kappa = { .kappa = &whole };
        if (tolerance > 1e-4) {
            OK(fvi_solve(&problem, &by_kappa, &accuracy, &outputs, &report, &error));
            ck_assert_ptr_eq(report.method, &fvi_cq_bdf2);
        }
    }
}
END_TEST

/* A linear motion against the exact solution; of a law that fvi-adaptive may not take, too. */
START_TEST(a_tolerance_is_reached_whatever_the_method)
{
    static const double t[] = { 0.5, 1.25, 2 };
    static const fvi_method *const methods[] = { NULL, &fvi_lobatto_m4,
                                                 &fvi_cq_bdf2 };
    const fvi_kernel_term zener = { FVI_KERNEL_ZENER, 1, 0.3, 0.5, 0 };
    const fvi_kernel law = { 1, &zener };
    for (size_t i = 0; i < 2 * LEN(methods); i++) {
        fvi_problem problem = duffing();
        problem.system.potential = fvi_potential_harmonic(spring);
        problem.system.force = (fvi_force){ 0 };
        problem.law = i % 2 ? &law : NULL;
        const fvi_linear_oscillator truth = { .m = mass, .c = spring[0],
                                              .rho = rho, .alpha = alpha,
                                              .x0 = x0, .v0 = 0,
                                              .law = problem.law };
        double x[LEN(t)], want[LEN(t)], v[LEN(t)];
        const fvi_solve_options options = { .method = methods[i / 2] };
        const fvi_accuracy accuracy = { .tolerance = 1e-6 };
        const fvi_outputs outputs = { .rows = LEN(t), .t = t, .x = x };
        fvi_report report;
        ck_assert_int_eq(
            fvi_solve(&problem, &options, &accuracy, &outputs, &report, &error),
            0);
        ck_assert_int_eq(fvi_exact_at(&truth, LEN(t), t, want, v, NULL), 0);
        for (size_t k = 0; k < LEN(t); k++)
            ck_assert_msg(fabs(x[k] - want[k]) <= 1e-6, "%s: %g",
                          report.method->name, x[k] - want[k]);
    }
}
END_TEST

/* A method and a step: the digits are those of the steps, at each of them or at some. */
START_TEST(a_method_and_a_step_are_steps)
{
    const fvi_problem problem = duffing();
    const double twentieth = 0.05;
    fvi_run run =
        fvi_run_default(&problem.system, &x0, &p0, twentieth, 40);
    run.alpha = alpha;
    static const fvi_method *const methods[] = { &fvi_fractional,
                                                 &fvi_lobatto_d3,
                                                 &fvi_variable_step };
    for (size_t i = 0; i < LEN(methods); i++) {
        double want[41], x[41], at[2];
        static const double t[] = { 0.5, 1.25 };
        const fvi_solve_options options = { .method = methods[i],
                                            .h = twentieth };
        const fvi_outputs all = { .rows = 41, .x = x },
                          some = { .rows = 2, .t = t, .x = at };
        fvi_report report;
        ck_assert_int_eq(fvi_trajectory(methods[i], &run, want, NULL, NULL), 0);
        ck_assert_int_eq(
            fvi_solve(&problem, &options, NULL, &all, &report, &error), 0);
        ck_assert_int_eq(memcmp(x, want, sizeof x), 0);
        ck_assert(report.steps > 0 && isinf(report.error));
        ck_assert_int_eq(
            fvi_solve(&problem, &options, NULL, &some, NULL, &error), 0);
        const double off = methods[i]->dense ? 1e-9 : 0;
        ck_assert_double_le(fabs(at[0] - want[10]), off);
        ck_assert_double_le(fabs(at[1] - want[25]), off);
    }
}
END_TEST

/* Between two steps of a method with stages, by their path: the same as fvi_lobatto_within says, and near the known motion. With
 * h = 1/20 and four stages x is off by h^4 times some 0.1 (seen: 3e-7), and p by h^3 (seen: 3e-5). */
START_TEST(stages_give_out_any_time)
{
    const fvi_problem problem = duffing();
    const fvi_solve_options options = { .method = &fvi_lobatto_m4, .h = 0.05 };
    double x[LEN(some_times)], p[LEN(some_times)], e[LEN(some_times)];
    const fvi_outputs outputs = { .rows = LEN(some_times), .t = some_times, .x = x, .p = p, .energy = e };
    fvi_report report;
    OK(fvi_solve(&problem, &options, NULL, &outputs, &report, &error));
    ck_assert_uint_eq(report.rows, LEN(some_times));
    for (size_t k = 0; k < LEN(some_times); k++) {
        const double t = some_times[k];
        ck_assert_double_eq_tol(x[k], known_x(t), 1e-6);
        ck_assert_double_eq_tol(p[k], mass * (2 * t - t * t), 1e-4);
        ck_assert_double_eq_tol(e[k], p[k] * p[k] / (2 * mass) + x[k] * x[k] / 2 + x[k] * x[k] * x[k] * x[k] / 8, 1e-14);
    }
}
END_TEST

/* Times without a common step: the tolerance is held there, between the steps, too. The error is no more than the
 * estimate, which is the difference of two runs. */
START_TEST(stages_reach_a_tolerance_at_any_times)
{
    static const fvi_method *const methods[] = { &fvi_lobatto_m2, &fvi_lobatto_m4, &fvi_lobatto_d3 };
    for (size_t m = 0; m < LEN(methods); m++)
        for (double tolerance = 1e-3; tolerance > 1e-8; tolerance /= 100) {
            const fvi_problem problem = duffing();
            const fvi_solve_options options = { .method = methods[m] };
            const fvi_accuracy accuracy = { .tolerance = tolerance };
            double x[LEN(some_times)], p[LEN(some_times)];
            const fvi_outputs outputs = { .rows = LEN(some_times), .t = some_times, .x = x, .p = p };
            fvi_report report;
            OK(fvi_solve(&problem, &options, &accuracy, &outputs, &report, &error));
            ck_assert(report.error <= tolerance && report.rows == LEN(some_times));
            ck_assert_double_eq_tol((double)report.steps * report.h, problem.T, 1e-14);
            for (size_t k = 0; k < LEN(some_times); k++) {
                const double t = some_times[k];
                ck_assert_double_le(fabs(x[k] - known_x(t)), report.error);
                ck_assert_double_eq_tol(p[k], mass * (2 * t - t * t), 10 * sqrt(tolerance)); /* two stages: of order 1 */
            }
        }
    ck_assert_uint_eq(fvi_common_steps(2, (double[]){ 0.5, 0.75 }, 1), 4);
    ck_assert_uint_eq(fvi_common_steps(LEN(some_times), some_times, 2), 0);
}
END_TEST

/* Two stages fall as they should at the ends of their steps, and along straight lines between them: only the times that are
 * asked for show the error, which is h^2/8 at most. */
START_TEST(the_error_between_steps_is_seen_where_their_ends_have_none)
{
    static const double aT[] = { 1, 9 }, none = 0, tolerance = 1e-6;
    double x[LEN(some_times)];
    fvi_problem problem = duffing();
    problem.system.damping = &none;
    problem.system.potential = (fvi_potential){ 0 };
    problem.system.force = fvi_force_step(aT);
    const fvi_solve_options options = { .method = &fvi_lobatto_m2 };
    const fvi_accuracy accuracy = { .tolerance = tolerance }, few = { .tolerance = 1e-9, .most_steps = 4096 };
    const fvi_outputs outputs = { .rows = LEN(some_times), .t = some_times, .x = x };
    fvi_report report;
    OK(fvi_solve(&problem, &options, &accuracy, &outputs, &report, &error));
    for (size_t k = 0; k < LEN(some_times); k++)
        ck_assert_double_le(fabs(x[k] - (x0 + some_times[k] * some_times[k] / (2 * mass))), report.error);
    ck_assert(report.error <= tolerance && report.error > report.h * report.h / 100);
    ck_assert_int_eq(fvi_solve(&problem, &options, &few, &outputs, &report, &error), FVI_ETOL);
    ck_assert(report.error > 1e-9 && report.error < 1e-6 && report.steps <= 4096);
    ck_assert_double_eq(report.until, 0); /* the ends of the steps are right up to T, and the times are not */
}
END_TEST

/* What cannot be meant has a field, a number and a place. */
START_TEST(what_is_wrong_has_field_value_and_index)
{
    double x[9];
    static const double falling[] = { 0, 1, 0.5 }, outside[] = { 0, 3 },
                        between[] = { 0.1, 0.25 };
    const struct {
        const double *t;
        size_t rows;
        double T, h, tolerance, alpha, start;
        const fvi_method *method;
        int code;
        const char *field;
        double value;
        size_t index;
    } bad[] = {
        { NULL, 9, -1, 0, 1e-6, 0.3, 1, NULL, FVI_EDOM, "T", -1, 0 },
        { NULL, 9, 2, 0, NAN, 0.3, 1, NULL, FVI_EDOM, "tolerance", NAN, 0 },
        { NULL, 9, 2, 0, 0, 0.3, 1, NULL, FVI_EDOM, "h", 0, 0 },
        { NULL, 9, 2, 0.3, 0, 0.3, 1, NULL, FVI_EDOM, "T", 2, 0 },
        { NULL, 9, 2, 0.1, 0, 0.3, 1, NULL, FVI_EINVAL, "rows", 9, 0 },
        { NULL, 9, 2, 0, 1e-6, 1.5, 1, NULL, FVI_EDOM, "alpha", 1.5, 0 },
        { NULL, 9, 2, 0, 1e-6, 0.3, INFINITY, NULL, FVI_EDOM, "x0", INFINITY,
          0 },
        { falling, 3, 2, 0, 1e-6, 0.3, 1, NULL, FVI_EDOM, "t", 0.5, 2 },
        { outside, 2, 2, 0, 1e-6, 0.3, 1, NULL, FVI_EDOM, "t", 3, 1 },
        { between, 2, 2, 0.1, 0, 0.3, 1, NULL, FVI_EDOM, "t", 0.25, 1 },
        { some_times, 5, 2, 0, 1e-6, 0.3, 1, &fvi_cq2_midpoint, FVI_EDOM, "t",
          0.7071067811865476, 2 },
        { between, 2, 2, 0.1, 0, 0.3, 1, &fvi_cq_bdf2, FVI_EDOM, "t", 0.25, 1 },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        fvi_problem problem = duffing();
        problem.T = bad[i].T;
        problem.alpha = bad[i].alpha;
        problem.x0 = &bad[i].start;
        const fvi_solve_options options = { .method = bad[i].method,
                                            .h = bad[i].h };
        const fvi_accuracy accuracy = { .tolerance = bad[i].tolerance };
        const fvi_outputs outputs = { .rows = bad[i].rows, .t = bad[i].t,
                                      .x = x };
        ck_assert_int_eq(
            fvi_solve(&problem, &options, &accuracy, &outputs, NULL, &error),
            bad[i].code);
        ck_assert_msg(error.code == bad[i].code
                          && strcmp(error.field, bad[i].field) == 0,
                      "%zu: %s: %s", i, error.field, error.text);
        ck_assert_msg(error.value == bad[i].value
                          || (isnan(error.value) && isnan(bad[i].value)),
                      "%zu: %g", i, error.value);
        ck_assert_msg(error.index == bad[i].index, "%zu: %zu", i, error.index);
    }
    ck_assert_int_eq(fvi_solve(NULL, NULL, NULL, NULL, NULL, NULL), FVI_EFAULT);
}
END_TEST

static int third_ends(size_t k, double t, const double *x, const double *p,
                      void *params)
{
    double *rows = params;
    (void)p;
    rows[k] = x[0] + t;
    return k == 2 ? -7 : 0;
}

/* The text of an error says which number is wanted instead. */
START_TEST(what_is_wrong_says_what_is_right)
{
    double x[9];
    const struct {
        size_t rows, most_steps;
        double h, tolerance, alpha;
        const fvi_method *method;
        int code;
        const char *text;
    } bad[] = {
        { 0, 0, 0, 1e-6, 0.3, NULL, FVI_EINVAL, "rows is 0; at least one time must be asked for" },
        { 1, 0, 0, 1e-6, 0.3, NULL, FVI_EINVAL, "rows is 1; without times it must be 2 or more, for the times 0 and T" },
        { 9, 0, 0.1, 0, 0.3, NULL, FVI_EINVAL,
          "rows is 9; without times it must be 21, one row for each step and one for t = 0" },
        { 9, 0, 0, 1e-6, 1.5, NULL, FVI_EDOM, "alpha is 1.5; it must be in [0, 1]" },
        { 9, 0, 0.25, 0, 0.3, &fvi_euler_explicit, FVI_EDOM, "alpha is 0.3; it must be 0.5 for this method" },
        { 9, 10, 0, 1e-9, 0.3, NULL, FVI_ETOL,
          "1e-09 is out of reach in at most 10 steps: no step gives a result that can be trusted" },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        fvi_problem problem = duffing();
        problem.alpha = bad[i].alpha;
        const fvi_solve_options options = { .method = bad[i].method, .h = bad[i].h };
        const fvi_accuracy accuracy = { .tolerance = bad[i].tolerance, .most_steps = bad[i].most_steps };
        const fvi_outputs outputs = { .rows = bad[i].rows, .x = x };
        ck_assert_int_eq(fvi_solve(&problem, &options, &accuracy, &outputs, NULL, &error), bad[i].code);
        ck_assert_str_eq(error.text, bad[i].text);
    }
}
END_TEST

/* Rows come in order, and a row may end the call; no array need be there. */
START_TEST(rows_come_in_order)
{
    const fvi_problem problem = duffing();
    for (int to_tolerance = 0; to_tolerance < 2; to_tolerance++) {
        double rows[5] = { 0 };
        const fvi_solve_options options = { .h = 0.5 };
        const fvi_accuracy accuracy = { .tolerance = to_tolerance ? 1e-8 : 0 };
        const fvi_outputs outputs = { .rows = 5, .row = third_ends,
                                      .params = rows };
        ck_assert_int_eq(
            fvi_solve(&problem, &options, &accuracy, &outputs, NULL, &error),
            -7);
        ck_assert(rows[0] == 1 && rows[2] > 2 && rows[3] == 0);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the one call");
    ADD_CASE(suite, "solve", a_tolerance_is_reached_at_any_times,
             stages_give_out_any_time, stages_reach_a_tolerance_at_any_times,
             the_error_between_steps_is_seen_where_their_ends_have_none, a_law_has_the_method_that_takes_it,
             a_tolerance_is_reached_whatever_the_method,
             a_method_and_a_step_are_steps,
             what_is_wrong_has_field_value_and_index,
             what_is_wrong_says_what_is_right, rows_come_in_order);
    return run_suite(suite);
}
