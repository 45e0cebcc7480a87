/* tests/program/test_fvi_cli.c -- The program build/fvi: the output of its commands.
 * Run alone: make test-fvi_cli */
#define _GNU_SOURCE
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "program.h"

START_TEST(run_prints_head_and_rows)
{
    ck_assert_int_eq(fvi("run --steps 2 --h 0.5"), 0);
    ck_assert_str_eq(err, "");
    const char *head =
        "# method = fvi\n# alpha = 0.5\n# rho = 0.2\n# mass = 1\n"
        "# potential = harmonic:1\n# force = none\n"
        "# derivative = held\n# kappa = 0.5\n# x0 = 1\n# p0 = 0.5\n"
        "# h = 0.5\n# steps = 2\n# columns = t,x,p,energy\n"
        "# every = 1\n# memory = auto\n# tolerance = 1e-13\n"
        "# t\tx\tp\tenergy\n0\t1\t0.5\t0.625\n0.5\t";
    ck_assert(strncmp(out, "# fvi ", 6) == 0);
    ck_assert_msg(strstr(out, head) == strchr(out, '\n') + 1, "%s", out);
    ck_assert_uint_eq(count_rows(), 3);
}
END_TEST

/* What is printed is the library's number to the last bit: %.17g is exact. */
START_TEST(rows_are_the_numbers_of_the_library)
{
    double m = 1.5, rho = 0.3, x0 = 0.7, p0 = -0.2, cg[2] = { 1, 0.5 },
           aw[2] = { 0.3, 2 };
    const fvi_system system = {
        1, &m, &rho, fvi_potential_duffing(cg), fvi_force_cosine(aw), NULL, NULL
    };
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = 0.05,
                          .steps = 40,
                          .kappa = 0.25,
                          .alpha = 0.3,
                          .past = FVI_INITIAL_HISTORY_CAPUTO,
                          .memory = FVI_HISTORY_DIRECT };
    double x[41], p[41], energy[41];
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, p, energy),
                     FVI_SUCCESS);
    ck_assert_int_eq(
        fvi("run --alpha 0.3 --rho 0.3 --mass 1.5 --potential duffing:1,0.5 "
            "--force cosine:0.3,2 --derivative caputo --kappa 0.25 "
            "--x0 0.7 --p0 -0.2 --h 0.05 --steps 40 --memory direct "
            "--columns y,energy,p,x,t"),
        0);
    ck_assert_uint_eq(count_rows(), 41);
    for (size_t k = 0; k <= 40; k++) {
        ck_assert_ulp(cell(k, 0), x[40 - k], 0, "y, k=%zu", k);
        ck_assert_ulp(cell(k, 1), energy[k], 0, "energy, k=%zu", k);
        ck_assert_ulp(cell(k, 2), p[k], 0, "p, k=%zu", k);
        ck_assert_ulp(cell(k, 3), x[k], 0, "x, k=%zu", k);
        ck_assert_ulp(cell(k, 4), (double)k * 0.05, 0, "t, k=%zu", k);
    }
}
END_TEST

/* Each method by its name; and all of them have the same past by default. */
START_TEST(every_method_is_at_hand_by_its_name)
{
    const double m = 1, rho = 0.2, c = 1, x0 = 1, p0 = 0.5;
    const fvi_system system = { 1,     &m,  &rho, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 100);
    for (size_t i = 0; fvi_methods[i]; i++) {
        double x[101];
        char line[100];
        run.alpha = fvi_methods[i]->alpha_most == 1 ? 0.3 : 0.5;
        ck_assert_int_eq(fvi_trajectory(fvi_methods[i], &run, x, NULL, NULL),
                         FVI_SUCCESS);
        snprintf(line, sizeof line, "run --alpha %g --steps 100 --method %s",
                 run.alpha, fvi_methods[i]->name);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_ptr_nonnull(strstr(out, "# derivative = held\n"));
        for (size_t k = 0; k <= 100; k++)
            ck_assert_ulp(cell(k, 1), x[k], 0, "%s, k=%zu",
                          fvi_methods[i]->name, k);
    }
}
END_TEST

START_TEST(a_hyphen_is_standard_output)
{
    ck_assert_int_eq(fvi("run --steps 3"), 0);
    char *want = strdup(out);
    ck_assert_int_eq(fvi("run --steps 3 -o -"), 0);
    ck_assert_str_eq(out, want);
    ck_assert(!exists("-"));
    free(want);
}
END_TEST

/* --order is twice --alpha, in every command that takes that. */
START_TEST(an_order_is_twice_alpha)
{
    static const char *const commands[] = {
        "run --method fvi-lobatto3 --steps 20 --%s",
        "exact --steps 5 --%s",
        "coefficients --count 5 --%s",
        "sweep --vary rho=0.1:0.3:2 --steps 5 --%s",
        "gradient --steps 5 --%s",
    };
    char line[120];
    for (size_t i = 0; i < LEN(commands); i++) {
        snprintf(line, sizeof line, commands[i], "alpha 0.375");
        ck_assert_int_eq(fvi(line), 0);
        char *want = strdup(first_row());
        snprintf(line, sizeof line, commands[i], "order 0.75");
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_str_eq(first_row(), want);
        ck_assert_ptr_nonnull(strstr(out, "# order = 0.75\n"));
        ck_assert_ptr_null(strstr(out, "# alpha"));
        free(want);
    }
    ck_assert_int_eq(fvi("sweep --vary alpha=0.25:0.5:2 --columns x --steps 9"),
                     0);
    const double x[] = { cell(0, 1), cell(1, 1) };
    ck_assert_int_eq(fvi("sweep --vary order=0.5:1:2 --columns x --steps 9"), 0);
    ck_assert(cell(0, 1) == x[0] && cell(1, 1) == x[1]);
    ck_assert_refused("run --alpha 0.3 --order 0.6",
                      "fvi: --order: not together with --alpha, which is half "
                      "of it");
    ck_assert_refused("run --order 2.5", "fvi: --order: '2.5' is outside [0, 2]");
    ck_assert_refused("run --method lda --order 0.5",
                      "fvi: --order: '0.5' is not 1, all that lda knows");
}
END_TEST

START_TEST(a_chain_has_numbered_columns)
{
    ck_assert_int_eq(fvi("run --potential chain:3,1,0.1 --x0 1,2,3 --p0 0 "
                         "--steps 1 --columns x,t,p"),
                     0);
    ck_assert_ptr_nonnull(
        strstr(out, "# x1\tx2\tx3\tt\tp1\tp2\tp3\n1\t2\t3\t0\t0\t0\t0\n"));
    ck_assert_int_eq(fvi("run --potential chain:1,1,0 --columns y,t,x"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# y1\tt\tx1\n"));
}
END_TEST

/* One step at rest but for a kick: each parameter of the chain has its place. */
START_TEST(a_chain_moves_as_the_library_says)
{
    const double ones[] = { 1, 1, 1 }, none[] = { 0, 0, 0 },
                 x0[] = { 1, 2, -1 };
    const double p0[] = { 0.5, 0.5, 0.5 }, cg[] = { 1.25, 0.5 };
    const fvi_system chain = { 3,     ones, none, fvi_potential_chain(cg),
                               { 0 }, NULL, NULL };
    const fvi_run run = { .system = &chain,
                          .x0 = x0,
                          .p0 = p0,
                          .h = 0.1,
                          .steps = 5,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    double x[18];
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     FVI_SUCCESS);
    ck_assert_int_eq(
        fvi("run --potential chain:3,1.25,0.5 --rho 0 --x0 1,2,-1 --steps 5 "
            "--columns x"),
        0);
    for (size_t k = 0; k <= 5; k++)
        for (size_t i = 0; i < 3; i++)
            ck_assert_ulp(cell(k, i), x[3 * k + i], 0, "k=%zu i=%zu", k, i);
}
END_TEST

/* The same table, from the library's exact solution: 400 rows one by one, 1500 at once,
 * and with a law in three batches. */
START_TEST(exact_prints_the_exact_solution)
{
    const fvi_linear_oscillator problem = { .m = 2,
                                 .c = 3,
                                 .rho = 0.5,
                                 .alpha = 0.75,
                                 .past = FVI_INITIAL_HISTORY_CAPUTO,
                                 .x0 = 1,
                                 .v0 = -0.25,
                                 .forcing = FVI_FORCING_COSINE,
                                 .A = 0.5,
                                 .w = 2 };
    for (size_t N = 399; N <= 1499; N += 1100) {
        double t[1500], x[1500], v[1500];
        char line[200];
        for (size_t k = 0; k <= N; k++)
            t[k] = (double)k * 0.01;
        ck_assert_int_eq(N == 399 ? fvi_exact_at(&problem, N + 1, t, x, v, NULL)
                                  : fvi_exact_grid(&problem, 0.01, N, 0, x, v,
                                                   NULL),
                         FVI_SUCCESS);
        snprintf(line, sizeof line,
                 "exact --mass 2 --potential harmonic:3 --rho 0.5 --alpha 0.75 "
                 "--derivative caputo --p0 -0.5 --force cosine:0.5,2 --h 0.01 "
                 "--steps %zu --columns t,x,p,y",
                 N);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_uint_eq(count_rows(), N + 1);
        for (size_t k = 0; k <= N; k += 100) {
            ck_assert_ulp(cell(k, 0), t[k], 0, "t, k=%zu", k);
            ck_assert_ulp(cell(k, 1), x[k], 0, "x, k=%zu", k);
            ck_assert_ulp(cell(k, 2), 2 * v[k], 0, "p, k=%zu", k);
            ck_assert_ulp(cell(k, 3), x[N - k], 0, "y, k=%zu", k);
        }
    }
    const fvi_kernel_term term = { .kind = FVI_KERNEL_POWER,
                                .rho = 0.5,
                                .alpha = 0.75 };
    const fvi_kernel law = { .count = 1, .term = &term };
    const fvi_linear_oscillator held = { .m = 1, .c = 1, .rho = 1, .x0 = 1, .law = &law };
    ck_assert_int_eq(fvi("exact --damping power:0.5,0.75 --p0 0 --h 0.01 "
                         "--steps 1499 --columns x"),
                     0);
    for (size_t k = 0; k < 1500; k += 100) {
        double t = (double)k * 0.01, x;
        ck_assert_int_eq(fvi_exact_at(&held, 1, &t, &x, NULL,
                                      NULL), FVI_SUCCESS);
        ck_assert_ulp(cell(k, 0), x, 0, "a law, k=%zu", k);
    }
    ck_assert_int_eq(
        fvi("exact --potential free --rho 0 --h 2 --steps 1 --columns x"), 0);
    ck_assert_near(cell(1, 0), 2, 1e-13 * 2,
                   "1 + 2 * 0.5, to what fvi_exact_at says");
}
END_TEST

START_TEST(coefficients_and_methods_and_help)
{
    ck_assert_int_eq(fvi("coefficients --alpha 0.5 --count 4"), 0);
    ck_assert_ptr_nonnull(strstr(out,
                                 "# alpha = 0.5\n# count = 4\n# n\tw_n\n"
                                 "0\t1\n1\t-0.5\n2\t-0.125\n3\t-0.0625\n"));
    ck_assert_int_eq(fvi("coefficients --alpha 2 --count 5"), 0);
    ck_assert_ptr_nonnull(strstr(out, "0\t1\n1\t-2\n2\t1\n3\t0\n4\t0\n"));
    ck_assert_int_eq(fvi("methods"), 0);
    ck_assert_ptr_nonnull(strstr(out, "fvi\t1\tfull\nlda\t1\tnone\n"));
    ck_assert_ptr_nonnull(
        strstr(out, "\neuler-explicit\t1\tnone\neuler-implicit\t1\tnone\n"
                    "fvi-shifted\t2\tfull\nfvi-bdf2\t2\tfull\n"
                    "fvi-lobatto2\t2\tfull\nfvi-lobatto3\t3 to 4\tfull\n"
                    "fvi-lobatto4\t4 to 6\tfull\nfvi-adaptive\tabout 10\tfull\n"
                    "fvi-lobatto5\t5 to 8\tfull\n"));
    ck_assert_ptr_nonnull(
        strstr(out, "\nfvi-lobatto8\t8 to 14\tfull\nfvi-lobatto2d\t2\tfull\n"
                    "fvi-lobatto3d\t3 to 4\tfull\nfvi-lobatto4d\t4 to 6\tfull\n"
                    "fvi-lobatto5d\t5 to 8\tfull\n"));
    ck_assert_uint_eq(count_lines(out), 22);
    ck_assert_int_eq(fvi("--help"), 0);
    ck_assert(strncmp(out, "usage: fvi run", 14) == 0);
    ck_assert_int_eq(fvi("run --help"), 0);
    ck_assert_ptr_nonnull(strstr(out, "--kappa"));
    ck_assert_int_eq(fvi("--version"), 0);
    ck_assert(strncmp(out, "fvi ", 4) == 0 && count_lines(out) == 1);
    ck_assert_str_eq(err, "");
}
END_TEST

START_TEST(a_repeated_option_is_fine_if_it_says_the_same)
{
    ck_assert_int_eq(fvi("run --steps 1 --alpha 0.3 --alpha 0.3 --alpha=0.3"),
                     0);
    ck_assert_int_eq(fvi("run --steps 1e0"), 0);
    ck_assert_uint_eq(count_rows(), 2);
}
END_TEST

/* A locale with a comma, which the test makes itself where it may: that it is in
 * force is seen by the shell's own printf. Nothing else would tell a program that
 * asks for the user's locale from one that does not. */
START_TEST(the_decimal_point_is_a_point_everywhere)
{
    shell("localedef -i de_DE -f ISO-8859-1 ./comma");
    ck_assert_int_eq(
        shell("for l in comma $(locale -a); do export LC_ALL=$l; "
              "test -d comma && export LOCPATH=$PWD; "
              "test \"$(locale decimal_point)\" = , || continue; echo '# '$l; "
              "\"$FVI\" run --steps 1 --h 0.5 --columns t,x; break; done"),
        0);
    if (*out == '\0') { /* no such locale to be had */
        ck_assert_int_eq(shell("nm -D \"$FVI\" | grep setlocale"), 1);
        return;
    }
    ck_assert_ptr_nonnull(strstr(out, "\n0.5\t"));
    ck_assert(cell(0, 1) == 1 && cell(1, 0) == 0.5);
}
END_TEST

/* At alpha = 1/2 a free body has p = p0 e^{-rho t}. Numbers below 2^{-1022} are this motion,
 * too, with fewer digits: they are printed, not made 0. t is one product. */
START_TEST(a_motion_is_printed_down_to_the_smallest_number)
{
    static const struct {
        const char *time;
        double p, error; /* relative; a unit of the last digit is 5e-324 */
    } late[] = { { "100 --steps 2000", 3.562288203370643e-218, 1e-11 },
                 { "142 --steps 2840", 2.238143112837565e-309, 1e-11 },
                 { "145 --steps 2900", 6.846531718e-316, 1e-7 },
                 { "148 --steps 2960", 2.094e-322, 0.03 } };
    char line[200];
    for (size_t i = 0; i < LEN(late); i++) {
        snprintf(line, sizeof line,
                 "run --potential free --rho 5 --method fvi-lobatto8 --columns "
                 "p --every 3000 --time %s",
                 late[i].time);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert(fabs(cell(1, 0) / late[i].p - 1) < late[i].error);
    }
    ck_assert_int_eq(fvi("run --h 0.1 --steps 3 --columns t"), 0);
    ck_assert(cell(3, 0) == 3 * 0.1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: what comes out");
    ADD_CASE(suite, "values", a_motion_is_printed_down_to_the_smallest_number,
             run_prints_head_and_rows, rows_are_the_numbers_of_the_library,
             every_method_is_at_hand_by_its_name,
             a_hyphen_is_standard_output, an_order_is_twice_alpha,
             a_chain_has_numbered_columns, a_chain_moves_as_the_library_says,
             exact_prints_the_exact_solution, coefficients_and_methods_and_help,
             a_repeated_option_is_fine_if_it_says_the_same,
             the_decimal_point_is_a_point_everywhere);
    return run_suite_of_program(suite);
}
