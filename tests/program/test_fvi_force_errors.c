/* tests/program/test_fvi_force_errors.c -- The program fvi names the time at which a force is not finite.
 * Run alone: make test-fvi_force_errors */
#define _GNU_SOURCE
#include "program.h"

START_TEST(an_expression_that_is_not_finite_in_a_run_is_bad_use)
{
    static const char *const bad[] = {
        "run --force '1/(t-1)'", "run --force '1/(t-1)' --method lda", "run --force '1/(t-1)' --method fvi-stable",
        "run --force '1/(t-1)' --error 1e-3", "run --force '1/(t-1)' --error 1e-3 --method fvi",
        "gradient --force '1/(t-1)'", "sweep --force '1/(t-1)' --vary rho=0.1,0.2", "fit DATA --force '1/(t-1)'",
        "fit DATA --force '1/(t-1)' --method fvi --h 0.25", "fit --design --sigma 0.1 --force '1/(t-1)'"
    };
    ck_assert_int_eq(fvi("run --time 5 --steps 10 -o DATA"), 0);
    for (size_t i = 0; i < LEN(bad); i++) {
        const int is_adaptive = strstr(bad[i], "--error 1e-3") && !strstr(bad[i], "--method");
        ck_assert_msg(fvi(bad[i]) == (is_adaptive ? 1 : 2), "%s: %s", bad[i], err);
        const char *said = is_adaptive ? "fvi: the force is infinite at t = 1\n"
                                       : "fvi: --force: '1/(t-1)' is infinite at t = 1, where ";
        ck_assert_msg(strncmp(err, said, strlen(said)) == 0, "%s: %s", bad[i], err);
        ck_assert_str_eq(out, "");
    }
    ck_assert_int_eq(fvi("run --ground 'sqrt(1-t)'"), 2);
    ck_assert_ptr_nonnull(strstr(err, "--ground: 'sqrt(1-t)' is not a number at t = 1.1, where fvi asks for it\n"));
    ck_assert_int_eq(fvi("run --force '1/(t-1.05)'"), 0);
    ck_assert_int_eq(fvi("sweep --force '1/(t-1.05)' --vary h=0.1,0.05"), 2);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --force: '1/(t-1.05)' is infinite at t = 1.05, where fvi asks for it\n"));
}
END_TEST

START_TEST(a_step_that_meets_a_number_that_is_not_finite_says_so)
{
    static const char *const bad[][2] = {
        { "run --force-on '1=1/(t-1)'", "fvi: step 10: the force is infinite at t = 1\n" },
        { "run --force-on '1=1/(t-1)' --error 1e-3 --method fvi", "fvi: the force is infinite at t = 1\n" },
        { "gradient --force-on '1=1/(t-1)'", "fvi: step 10: the force is infinite at t = 1\n" },
        { "sweep --force-on '1=1/(t-1)' --vary rho=0.1,0.2",
          "fvi: with rho = 0.1: step 10: the force is infinite at t = 1\n" },
        { "run --force '1/(t-1.05)' --method fvi-adaptive", "fvi: step 11: the force is infinite at t = 1.05\n" },
        { "sweep --force '1/(t-1.05)' --method fvi-adaptive --error 1e-3 --vary rho=0.1",
          "fvi: with rho = 0.1: the force is infinite at t = 1.05\n" },
        { "run --damper 'x1-sqrt(1-t) : viscous:1'", "fvi: step 11: the elongation is not a number at t = 1.1\n" },
        { "run --impose 'x1=1/(t-1)' --x0 -1 --v0 -1", "fvi: step 10: the constraint is infinite at t = 1\n" },
        { "fit DATA --force-on '1=1/(t-1)' --method fvi",
          "fvi: no start gives a motion that can be computed: the force is infinite at t = 1\n" },
        { "fit DATA --force '1/(t-1.1)' --method fvi-adaptive",
          "fvi: no start gives a motion that can be computed: the force is infinite at t = 1.1\n" }
    };
    ck_assert_int_eq(fvi("run --time 5 --steps 10 -o DATA"), 0);
    for (size_t i = 0; i < LEN(bad); i++) {
        ck_assert_msg(fvi(bad[i][0]) == 1, "%s: %s", bad[i][0], err);
        ck_assert_msg(strcmp(err, bad[i][1]) == 0, "%s: %s", bad[i][0], err);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: forces that are not finite");
    ADD_CASE(suite, "forces", an_expression_that_is_not_finite_in_a_run_is_bad_use,
             a_step_that_meets_a_number_that_is_not_finite_says_so);
    return run_suite_of_program(suite);
}
