/* tests/program/test_fvi_grid.c -- The program build/fvi: the times of the rows, and the steps between them.
 * Run alone: make test-fvi_grid */
#define _GNU_SOURCE
#include "program.h"

/* --time T is --h T/N, and the head says which h that is; a word of exact too. */
START_TEST(a_time_is_as_good_as_a_step)
{
    ck_assert_int_eq(fvi("run --steps 8 --h 0.25"), 0);
    char *want = strdup(first_row());
    ck_assert_int_eq(fvi("run --steps 8 --time 2"), 0);
    ck_assert_str_eq(first_row(), want);
    ck_assert_ptr_nonnull(
        strstr(out, "# h = 0.25\n# steps = 8\n# time = 2\n# columns"));
    free(want);
    ck_assert_int_eq(fvi("exact --steps 8 --time 2 --columns t"), 0);
    ck_assert(cell(8, 0) == 2);
}
END_TEST

/* --h and --time together say how many steps there are; --steps may repeat it. */
START_TEST(a_step_and_a_time_are_a_number_of_steps)
{
    ck_assert_int_eq(fvi("run --steps 30 --h 0.1 --alpha 0.3"), 0);
    char *want = strdup(first_row());
    ck_assert_int_eq(fvi("run --time 3 --h 0.1 --alpha 0.3"), 0);
    ck_assert_str_eq(first_row(), want);
    ck_assert_ptr_nonnull(
        strstr(out, "# h = 0.1\n# steps = 30\n# time = 3\n# columns"));
    ck_assert_int_eq(fvi("run --time 3 --h 0.1 --steps 30 --alpha 0.3"), 0);
    ck_assert_str_eq(first_row(), want);
    free(want);
    ck_assert_int_eq(fvi("run --time 3.0000000029 --h 0.1"), 0);
    ck_assert_refused("run --time 3.0000000031 --h 0.1",
                      "fvi: --time: '3.0000000031' is not a whole number of "
                      "steps of --h 0.1");
    ck_assert_refused("run --time 3 --h 0.1 --steps 29",
                      "fvi: --steps: '29' is not 30, which --time by --h is");
    ck_assert_refused("run --time 1e9 --h 1e-9",
                      "fvi: --time: '1e9' is more than 9.007e+15 steps of --h 1e-9");
}
END_TEST

/* The error that was asked for, against the exact solution on the same rows. */
START_TEST(an_error_is_as_good_as_a_step)
{
    const char *rest = "--alpha 0.3 --derivative caputo --steps 10 --time 5 "
                       "--columns t,x,p,y";
    char line[200];
    double want[11], x[11], p[11];
    snprintf(line, sizeof line, "exact %s", rest);
    ck_assert_int_eq(fvi(line), 0);
    for (size_t k = 0; k <= 10; k++)
        want[k] = cell(k, 1);
    snprintf(line, sizeof line, "run --method fvi-lobatto3 --error 1e-8 %s",
             rest);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_uint_eq(count_rows(), 11);
    double said = 0, step = 0, estimate = 0;
    ck_assert_int_eq(
        sscanf(err, "fvi: the error of x is about %lg, with the step %lg\n",
               &said, &step),
        2);
    ck_assert_uint_eq(count_lines(err), 1);
    const char *head = strstr(out, "# error estimate = ");
    ck_assert(head && sscanf(head, "# error estimate = %lg", &estimate) == 1);
    ck_assert(said == estimate && estimate <= 1e-8);
    ck_assert_ptr_nonnull(strstr(out, "# time = 5\n# error = 1e-8\n"));
    for (size_t k = 0; k <= 10; k++) {
        x[k] = cell(k, 1);
        p[k] = cell(k, 2);
        ck_assert(cell(k, 0) == (double)k * 0.5);
        ck_assert_near(x[k], want[k], 1e-8, "k=%zu", k);
    }
    for (size_t k = 0; k <= 10; k++)
        ck_assert(cell(k, 3) == x[10 - k]);
    /* the same rows by hand, from the step that was reported */
    const char *line_of_step = strstr(out, "# step = ");
    ck_assert(line_of_step && sscanf(line_of_step, "# step = %lg", &step) == 1);
    snprintf(line, sizeof line,
             "run --method fvi-lobatto3 --alpha 0.3 --h %.17g --steps %.0f "
             "--every %.0f",
             step, 5 / step, 0.5 / step);
    ck_assert_int_eq(fvi(line), 0);
    for (size_t k = 0; k <= 10; k++) {
        ck_assert_ulp(cell(k, 1), x[k], 0, "x, k=%zu", k);
        ck_assert_ulp(cell(k, 2), p[k], 0, "p, k=%zu", k);
    }
    ck_assert_int_eq(fvi("run --error 0.1 --steps 10"), 0);
    ck_assert(cell(10, 0) == 20);
}
END_TEST

START_TEST(every_keeps_each_kth_row_and_the_last)
{
    ck_assert_int_eq(fvi("run --steps 10 --h 1 --every 4 --columns t,x,y"), 0);
    ck_assert_uint_eq(count_rows(), 4);
    const double t[4] = { 0, 4, 8, 10 };
    double x10 = cell(3, 1), x0 = cell(0, 1);
    for (size_t i = 0; i < 4; i++)
        ck_assert_ulp(cell(i, 0), t[i], 0, "row %zu", i);
    ck_assert_ulp(cell(0, 2), x10, 0, "y_0 = x_N");
    ck_assert_ulp(cell(3, 2), x0, 0, "y_N = x_0");
    double y4 = cell(1, 2); /* y_4 = x_6 */
    ck_assert_int_eq(fvi("run --steps 10 --h 1 --every 6 --columns x"), 0);
    ck_assert_ulp(y4, cell(1, 0), 0, "y_4 = x_6");
    ck_assert_int_eq(fvi("run --steps 3 --every 100 --columns t"), 0);
    ck_assert_uint_eq(count_rows(), 2);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: rows and steps");
    ADD_CASE(suite, "grid", a_time_is_as_good_as_a_step,
             a_step_and_a_time_are_a_number_of_steps,
             an_error_is_as_good_as_a_step,
             every_keeps_each_kth_row_and_the_last);
    return run_suite_of_program(suite);
}
