/* tests/program/test_fvi_system_gradient.c -- The program build/fvi: gradients of systems of matrices.
 * Run alone: make test-fvi_system_gradient */
#define _GNU_SOURCE
#include "program.h"
#include "folder.h"
#include "system/larger.h"

#include <string.h>

/* The gradient of a folder, against that of the same masses by words: a factor of M changes
 * each mass by as much as it is large. */
static void ck_assert_factors(const double *want)
{
    const double mass[] = { 1, 2, 0.5 }, rho[] = { 0.3, 0, 0.1 };
    double by_mass = 0, by_rho = 0;
    for (size_t i = 0; i < 3; i++) {
        by_mass += mass[i] * want[i];
        by_rho += rho[i] * want[3 + i];
    }
    ck_assert_near(by("mass"), by_mass, 1e-12, "M");
    ck_assert_near(by("rho"), by_rho, 1e-12, "C");
    ck_assert_near(by("alpha"), want[6], 1e-12, "alpha");
    ck_assert_near(by("c"), 2 * want[7], 1e-12, "K");
}

START_TEST(a_gradient_of_a_folder_is_that_of_its_masses)
{
    static const char *const names[] = { "x0_1",   "x0_2",  "x0_3",   "p0_1",
                                         "p0_2",   "p0_3",  "mass_1", "mass_2",
                                         "mass_3", "rho_1", "rho_2",  "rho_3",
                                         "alpha",  "c" };
    static const char *const what[] = {
        "--of x:2 --alpha 0.3",
        "--of p:3 --alpha 0.8 --derivative caputo",
        "--of x:1 --alpha 0.3 --derivative rl",
        "--of x:2 --alpha 0.8 --method fvi-stable",
        "--of x:1 --alpha 0.3 --method fvi-shifted",
        "--of x:3 --alpha 0.8 --method fvi-bdf2 --derivative caputo",
        "--of energy --alpha 0.3",
        "--of energy --alpha 0.8 --derivative caputo",
        "--of energy --alpha 0.8 --method fvi-stable",
        "--of p:1 --alpha 0.3 --method fvi-bdf2 --derivative rl",
        "--of x:3 --alpha 0.3 --method fvi-shifted --derivative rl",
        "--of x:2 --alpha 0.3 --method fvi-lobatto3d",
        "--of p:3 --alpha 0.8 --method fvi-lobatto4d --derivative caputo",
        "--of energy --alpha 0.3 --method fvi-lobatto2d --derivative rl",
        "--of x:1 --alpha 0.8 --method fvi-lobatto4d"
    };
    write_chain();
    for (size_t i = 0; i < LEN(what); i++) {
        char line[300];
        double want[LEN(names)];
        snprintf(line, sizeof line,
                 "gradient %s --x0 1,0,-1 --p0 0.5 --force cosine:1,2 --mass "
                 "1,2,0.5 --rho 0.3,0,0.1 --potential chain:3,2,0",
                 what[i]);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t j = 0; j < LEN(names); j++)
            want[j] = by(names[j]);
        snprintf(line, sizeof line,
                 "gradient %s --x0 1,0,-1 --p0 0.5 --force cosine:1,2 --system "
                 "chain --forces f.tsv",
                 what[i]);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t j = 0; j < 6; j++)
            ck_assert_near(by(names[j]), want[j], 1e-12, "%s", names[j]);
        ck_assert_factors(want + 6);
    }
    ck_assert_int_eq(fvi("gradient --system chain"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# of = x:1\n"));
    ck_assert_int_eq(fvi("gradient --system chain --method fvi-stable --alpha "
                         "0.7 --derivative rl --x0 0"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by x0_1"));
    by("x0_2"); /* of which C knows nothing */
}
END_TEST

/* A row of a law against a difference of two runs, as in test_fvi_gradient_laws.c. */
START_TEST(a_law_of_a_folder_has_its_rows)
{
    const char *law =
        "--system chain --x0 1 --p0 0.5 --method fvi-stable --damping "
        "zener:1,0.3,%.17g --damping distributed:0.5,0.1,0.4";
    char options[200], line[300];
    double v[2];
    write_chain();
    for (int side = 0; side < 2; side++) {
        snprintf(options, sizeof options, law, 0.5 + (side ? 1e-5 : -1e-5));
        snprintf(line, sizeof line, "run %s --columns x --unknowns 1", options);
        ck_assert_int_eq(fvi(line), 0);
        v[side] = cell(count_rows() - 1, 0);
    }
    snprintf(options, sizeof options, law, 0.5);
    snprintf(line, sizeof line, "gradient %s", options);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_near(by("damping_1_T"), (v[1] - v[0]) / 2e-5, 1e-6, "T");
    by("mass");
    by("damping_2_B");
    by("c");
    ck_assert_ptr_null(strstr(out, "\nrho"));
}
END_TEST

/* Each damper of a folder has a row, by a factor of its law, against a difference of two runs. */
START_TEST(dampers_of_a_folder_have_a_gradient)
{
    const char *same = "--system bare --x0 1,0,-1 --p0 0,0.5,0 --time 2 --steps 100 --method "
                       "fvi-stable --damper 'x3-x2 : zener:2,0.3,1'";
    char line[400];
    double v[2];
    write_chain();
    ck_assert_int_eq(shell("mkdir -p bare && cp chain/M.mtx chain/K.mtx bare"), 0);
    for (int side = 0; side < 2; side++) {
        snprintf(line, sizeof line,
                 "run %s --damper 'left=x1 : power:%.17g,0.7' --columns x --unknowns 2", same,
                 0.5 * (side ? 1 + 1e-5 : 1 - 1e-5));
        ck_assert_int_eq(fvi(line), 0);
        v[side] = cell(count_rows() - 1, 0);
    }
    snprintf(line, sizeof line, "gradient %s --damper 'left=x1 : power:0.5,0.7' --of x:2",
             same);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_near(by("left.factor"), (v[1] - v[0]) / 2e-5, 1e-9, "left");
    ck_assert_near(0.5 * by("left.rho"), by("left.factor"), 1e-14, "rho of left");
    by("d1.factor");
    for (int side = 0; side < 2; side++) {
        snprintf(line, sizeof line,
                 "run %s --damper 'left=x1 : power:0.5,%.17g' --columns x --unknowns 2", same,
                 0.7 + (side ? 1e-5 : -1e-5));
        ck_assert_int_eq(fvi(line), 0);
        v[side] = cell(count_rows() - 1, 0);
    }
    snprintf(line, sizeof line, "gradient %s --damper 'left=x1 : power:0.5,0.7' --of x:2 --by "
             "d1.time,left.alpha", same);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_near(by("left.alpha"), (v[1] - v[0]) / 2e-5, 1e-8, "the order of left");
    by("d1.time");
    ck_assert_ptr_null(strstr(out, "\nmass"));
    snprintf(line, sizeof line, "gradient %s --damper 'left=x1 : power:0.5,0.7' --of x:2",
             same);
    ck_assert_int_eq(fvi(line), 0);
    by("mass");
    ck_assert_ptr_null(strstr(out, "\nalpha"));
    ck_assert_int_eq(fvi("gradient --system bare --method fvi-shifted --damper 'x1 : "
                         "zener:1,0.3,1'"),
                     2);
    ck_assert_ptr_nonnull(strstr(err, "'fvi-shifted' has no gradient with the damper"));
}
END_TEST

/* Steps of any length of 1e-13 each and form D of order 14, rows a twentieth apart: 1e-10 of a derivative. Seen: 8e-12. */
START_TEST(steps_of_any_length_have_the_gradient_of_a_folder)
{
    static const char *const names[] = { "x0_1", "x0_3", "p0_2", "mass", "rho", "c", "alpha" };
    static const char *const method[] = { "fvi-lobatto8d --steps 400 --time 2",
                                          "fvi-adaptive --step-error 1e-13 --steps 40 --time 2" };
    double want[LEN(names)];
    char line[300];
    write_chain();
    for (size_t i = 0; i < 2; i++) {
        snprintf(line, sizeof line, "gradient --of energy --alpha 0.3 --x0 1,0,-1 --p0 0.5 --system chain --method %s",
                 method[i]);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t j = 0; i > 0 && j < LEN(names); j++) {
            seen_worst(fabs(by(names[j]) - want[j]), "off");
            ck_assert_near(by(names[j]), want[j], (j == 6 ? 1e-9 : 1e-10) * larger(1, fabs(want[j])), "%s", names[j]);
        }
        for (size_t j = 0; i == 0 && j < LEN(names); j++)
            want[j] = by(names[j]);
    }
    ck_assert_int_eq(fvi("gradient --alpha 0 --x0 1 --system chain --method fvi-adaptive --time 1"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by alpha: of a folder steps of any length"));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: gradients of systems of matrices");
    ADD_CASE(suite, "gradient", a_gradient_of_a_folder_is_that_of_its_masses,
             a_law_of_a_folder_has_its_rows,
             dampers_of_a_folder_have_a_gradient, steps_of_any_length_have_the_gradient_of_a_folder);
    return run_suite_of_program(suite);
}
