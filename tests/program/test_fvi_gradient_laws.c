/* tests/program/test_fvi_gradient_laws.c -- The command fvi gradient: derivatives by the numbers of a law of damping.
 * Run alone: make test-fvi_gradient_laws */
#define _GNU_SOURCE
#include "gradient_rows.h"

/* The rows of a law's numbers, against central differences of two runs, 2e-5 wide. */
static void rows_of_a_law(const char *method)
{
    static const char *const names[] = { "damping_1",   "damping_1_T",
                                         "damping_2",   "damping_2_A",
                                         "damping_2_T", "damping_3",
                                         "damping_3_A", "damping_3_B" };
    enum { COUNT = LEN(names) };
    const double at[COUNT] = { 0.2, 1, 0.3, 0.4, 1.5, 0.1, 0.2, 0.45 };
    char options[300], line[400];
    double got[COUNT];
    for (size_t i = 0; i <= COUNT; i++) { /* at first all as they are */
        double v[2] = { 0, 0 };
        for (int side = 0; side < 2; side++) {
            double n[COUNT];
            for (size_t j = 0; j < COUNT; j++)
                n[j] = at[j] + (j + 1 == i ? (side ? 1e-5 : -1e-5) : 0);
            snprintf(options, sizeof options,
                     "--damping maxwell:%.17g,%.17g --damping "
                     "zener:%.17g,%.17g,%.17g --damping "
                     "distributed:%.17g,%.17g,%.17g ",
                     n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]);
            v[side] = i > 0 ? last(options, "x", method) : 0;
        }
        if (i > 0) {
            ck_assert_near(got[i - 1], (v[1] - v[0]) / 2e-5, 1e-6, "%s",
                           names[i - 1]);
            continue;
        }
        snprintf(line, sizeof line, "gradient %s %s", options, method);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t j = 0; j < COUNT; j++)
            got[j] = derivative(names[j]);
        ck_assert_ptr_null(strstr(out, "rho"));
        ck_assert_ptr_null(strstr(out, "alpha"));
        ck_assert_ptr_null(strstr(out, "damping_1_A"));
        ck_assert_ptr_null(strstr(out, "damping_3_T"));
    }
}

START_TEST(rows_of_a_law_are_differences_of_runs)
{
    rows_of_a_law("--method fvi-bdf2");
    rows_of_a_law("--method fvi-lobatto4d");
    rows_of_a_law("--method fvi-stable");
    ck_assert_int_eq(
        fvi("gradient --damping 'maxwell2:1,0.4,2,0.1 + power:0.2,0.3'"), 0);
    derivative("damping_1_R2");
    ck_assert_ptr_nonnull(strstr(out, "\ndamping_2\t"));
    ck_assert_int_eq(fvi("gradient --damping symbol:s^0.5"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivatives by the numbers of damping\n"));
    ck_assert_int_eq(fvi("gradient --damping davidson:1,0.4,2 --method fvi-lobatto3d"), 0);
    derivative("damping");
    ck_assert_ptr_null(strstr(out, "\ndamping_A\t"));
    ck_assert_int_eq(fvi("gradient --damping zener:1,0.3,2 --method fvi-shifted"),
                     2);
    ck_assert_ptr_nonnull(strstr(err, "has no gradient with --damping"));
    ck_assert_int_eq(fvi("gradient --damping power:0.2,0.7"), 0);
    derivative("damping");
    derivative("damping_A");
    ck_assert_ptr_null(strstr(out, "warning"));
}
END_TEST

/* maxwell2:R1,A,R2,B by its four numbers, against central differences; and where the time of the kernel,
 * R1 / R2, is not wanted. */
START_TEST(two_springpots_in_series_have_rows)
{
    static const char *const names[] = { "damping", "damping_A", "damping_R2", "damping_B" };
    const double at[] = { 1, 0.4, 2, 0.1 };
    const char *methods[] = { "--method fvi", "--method fvi-lobatto3d" };
    for (size_t m = 0; m < LEN(methods); m++)
        for (size_t i = 0; i < LEN(names); i++) {
            char options[200], line[300];
            double v[2];
            for (int side = 0; side < 2; side++) {
                double n[LEN(at)];
                for (size_t j = 0; j < LEN(at); j++)
                    n[j] = at[j] + (j == i ? (side ? 1e-5 : -1e-5) : 0);
                snprintf(options, sizeof options,
                         "--damping maxwell2:%.17g,%.17g,%.17g,%.17g", n[0], n[1], n[2], n[3]);
                v[side] = last(options, "x", methods[m]);
            }
            snprintf(line, sizeof line, "gradient %s --damping maxwell2:1,0.4,2,0.1 --by %s",
                     methods[m], names[i]);
            ck_assert_int_eq(fvi(line), 0);
            ck_assert_near(derivative(names[i]), (v[1] - v[0]) / 2e-5, 1e-6, "%s", names[i]);
        }
}
END_TEST

/* On steps of any length the kernel's own rho is no number of two springpots in series. */
START_TEST(two_springpots_in_series_have_no_row_by_half_a_number)
{
    ck_assert_int_eq(fvi("gradient --method fvi-adaptive --potential x^4/4 --time 3 --steps 3 "
                         "--damping maxwell2:0.7,0.4,0.4,0.2"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "no derivatives by the numbers of damping"));
    ck_assert_ptr_null(strstr(out, "\ndamping\t"));
}
END_TEST

/* The names 1 and 2 would be exchanged where the order that stands second is the larger: no such row; that by x0
 * there is, and of two equal orders those of all numbers. */
START_TEST(the_larger_order_stands_first)
{
    static const char *const laws[] = { "--damping maxwell2:0.4,0.2,0.7,0.4",
                                        "--damper 'd=x : maxwell2:0.4,0.2,0.7,0.4'",
                                        "--damper 'd=x : power:1,0.3 + maxwell2:0.4,0.2,0.7,0.4'" };
    char line[300];
    for (size_t i = 0; i < LEN(laws); i++) {
        const char *by = i ? "" : "--by damping_A";
        snprintf(line, sizeof line, "gradient --potential x^4/4 --method fvi-lobatto4 %s %s", laws[i], by);
        ck_assert_int_eq(fvi(line), 2);
        ck_assert_ptr_nonnull(strstr(err, "write the term of the larger order first"));
        snprintf(line, sizeof line, "gradient --potential x^4/4 --method fvi-lobatto4 %s --by x0", laws[i]);
        ck_assert_int_eq(fvi(line), 0);
        derivative("x0");
    }
    ck_assert_int_eq(fvi("gradient --damping maxwell2:0.4,0.2,0.7,0.2"), 0);
    derivative("damping_R2");
    ck_assert_int_eq(fvi("gradient --damper 'd=x : maxwell2:0.7,0.4,0.4,0.2'"), 0);
    derivative("d.rho1");
}
END_TEST

/* By fvi-adaptive as by another method, but for the numbers of the law behind its factor. */
START_TEST(rows_of_a_law_on_steps_of_any_length)
{
    static const char *const names[] = { "x0", "p0", "mass", "damping", "c", "g" };
    static const char law[] = "--damping zener:1,0.3,0.5 --potential "
                              "duffing:1,0.7 --time 3 --steps 300";
    double by[LEN(names)];
    char line[300];
    snprintf(line, sizeof line, "gradient --method fvi-lobatto8d %s", law);
    ck_assert_int_eq(fvi(line), 0);
    for (size_t i = 0; i < LEN(names); i++)
        by[i] = derivative(names[i]);
    snprintf(line, sizeof line, "gradient --method fvi-adaptive %s", law);
    ck_assert_int_eq(fvi(line), 0);
    for (size_t i = 0; i < LEN(names); i++)
        ck_assert_near(derivative(names[i]), by[i], 1e-8, "%s", names[i]);
    ck_assert_ptr_null(strstr(out, "damping_A"));
    ck_assert_int_eq(fvi("gradient --method fvi-adaptive --damping power:1,0.7 "
                         "--p0 0"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by p0"));
    ck_assert_int_eq(fvi("gradient --method fvi-adaptive --damping power:1,0.3 "
                         "--damping maxwell:1,2"),
                     0);
    ck_assert_ptr_nonnull(
        strstr(out, "# warning = no derivatives by the numbers of damping_2"));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fvi gradient: laws of damping");
    ADD_CASE(suite, "answers", rows_of_a_law_are_differences_of_runs,
             rows_of_a_law_on_steps_of_any_length, two_springpots_in_series_have_rows,
             two_springpots_in_series_have_no_row_by_half_a_number, the_larger_order_stands_first);
    return run_suite_of_program(suite);
}
