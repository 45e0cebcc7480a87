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
    derivative("damping_1_rho2");
    ck_assert_ptr_nonnull(strstr(out, "\ndamping_2\t"));
    ck_assert_int_eq(fvi("gradient --damping symbol:s^0.5"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivatives by the numbers of damping\n"));
    ck_assert_int_eq(fvi("gradient --damping davidson:1,0.4,2 --method fvi-lobatto3d"), 0);
    derivative("damping_A");
    derivative("damping_T");
    ck_assert_int_eq(fvi("gradient --damping zener:1,0.3,2 --method fvi-shifted"),
                     2);
    ck_assert_ptr_nonnull(strstr(err, "has no gradient with --damping"));
    ck_assert_int_eq(fvi("gradient --damping power:0.2,0.7"), 0);
    derivative("damping");
    derivative("damping_A");
    ck_assert_ptr_null(strstr(out, "warning"));
}
END_TEST

/* Two springpots in series whose symbol has poles off the cut, and another law that grows faster than s: after a start with
 * a velocity the impulses of the derivatives contain these poles. Central differences of order 4. */
START_TEST(a_pair_with_poles_beside_a_law_of_high_order)
{
    static const char *const names[] = { "damping_1_rho1", "damping_1_alpha1", "damping_1_rho2", "damping_1_alpha2" },
                            *const methods[] = { "--method fvi-stable", "--method fvi-bdf2" };
    static const double at[] = { 0.5, 0.9, 1, 0.1 }, weight[] = { 1. / 12, -2. / 3, 2. / 3, -1. / 12 };
    for (size_t m = 0; m < LEN(methods); m++)
        for (size_t i = 0; i < LEN(at); i++) {
            char options[300], line[400];
            double slope = 0;
            for (int k = 0; k < 4; k++) {
                double n[LEN(at)];
                for (size_t j = 0; j < LEN(at); j++)
                    n[j] = at[j] + (j == i ? 1e-3 * (k - 2 + (k > 1)) : 0);
                snprintf(options, sizeof options, "--damping 'maxwell2:%.17g,%.17g,%.17g,%.17g + power:0.2,0.8'", n[0], n[1],
                         n[2], n[3]);
                slope += weight[k] * last(options, "x", methods[m]) / 1e-3;
            }
            snprintf(line, sizeof line, "gradient %s --damping 'maxwell2:0.5,0.9,1,0.1 + power:0.2,0.8'", methods[m]);
            ck_assert_int_eq(fvi(line), 0);
            ck_assert_near(derivative(names[i]), slope, 1e-8, "%s by %s", names[i], methods[m]);
        }
}
END_TEST

/* havriliak:R,A,T,B by its four numbers, against central differences of runs whose law is a symbol. B = 1 is the end of
 * its range. Steps of any length have the derivative by R. */
START_TEST(havriliak_has_rows_by_all_its_numbers)
{
    static const char *const names[] = { "damping", "damping_A", "damping_T", "damping_B" },
                            *const methods[] = { "--method fvi", "--method fvi-bdf2", "--method fvi-stable",
                                                 "--method fvi-lobatto4d", "--method fvi-adaptive" };
    for (size_t m = 0; m < LEN(methods); m++)
        for (int one = 0; one < 2; one++) {
            const double at[] = { 0.4, 0.3, 2, one ? 1 : 0.6 };
            double got[LEN(at)], v[LEN(at)][2];
            char line[300];
            snprintf(line, sizeof line, "gradient %s --damping havriliak:0.4,0.3,2,%g", methods[m], at[3]);
            ck_assert_int_eq(fvi(line), 0);
            const size_t numbers = m == LEN(methods) - 1 ? 1 : LEN(at);
            for (size_t i = 0; i < numbers; i++)
                got[i] = derivative(names[i]);
            if (numbers == 1)
                ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by damping_B"));
            for (size_t i = 0; i < numbers; i++) {
                for (int side = 0; side < 2; side++) {
                    double n[LEN(at)];
                    for (size_t j = 0; j < LEN(at); j++)
                        n[j] = at[j] + (j == i ? (side ? 1e-5 : -1e-5) : 0);
                    snprintf(line, sizeof line,
                             "--damping 'symbol:r*s^(2*a)/(1+T*s^(2*a))^b' --let r=%.17g,a=%.17g,T=%.17g,b=%.17g", n[0],
                             n[1], n[2], n[3]);
                    v[i][side] = last(line, "x", methods[m]);
                }
                ck_assert_near(got[i], (v[i][1] - v[i][0]) / 2e-5, 1e-6, "%s by %s, B = %g", names[i], methods[m], at[3]);
            }
        }
    double v[2]; /* an exponent that is equal to alpha is no order beside it */
    for (int side = 0; side < 2; side++) {
        char line[200];
        snprintf(line, sizeof line, "gradient --time 2 --damper 'd=x : havriliak:0.4,0.3,2,%.17g' --of d.force",
                 0.3 + (side ? 1e-4 : -1e-4));
        ck_assert_int_eq(fvi(line), 0);
        v[side] = strtod(strstr(out, "# value = ") + 10, NULL);
    }
    ck_assert_int_eq(fvi("gradient --time 2 --damper 'd=x : havriliak:0.4,0.3,2,0.3' --of d.force"), 0);
    ck_assert_near(derivative("d.beta"), (v[1] - v[0]) / 2e-4, 1e-7, "the force of a damper");
}
END_TEST

/* maxwell2:R1,A,R2,B by its four numbers, against central differences; and where the time of the kernel,
 * R1 / R2, is not wanted. */
START_TEST(two_springpots_in_series_have_rows)
{
    static const char *const names[] = { "damping_rho1", "damping_alpha1", "damping_rho2", "damping_alpha2" };
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
    ck_assert_ptr_nonnull(strstr(out, "no derivative by damping_rho1: steps of any length"));
    ck_assert_ptr_null(strstr(out, "\ndamping_rho1\t"));
}
END_TEST

/* The kernel keeps the part of the larger order first; the names are those that were typed. */
START_TEST(the_parts_of_a_pair_keep_their_names)
{
    static const char *const laws[] = { "--damping 'maxwell2:%s'", "--damping 'power:1,0.3 + maxwell2:%s'",
                                        "--damper 'd=x : maxwell2:%s'", "--force-on '1=-0.1*v' --damping 'maxwell2:%s'",
                                        "--damper 'e=x : maxwell2:1,0.3,0.5,0.1' --damper 'd=x : power:1,0.3 + maxwell2:%s'" },
                            *const names[][4] = {
                                { "damping_rho1", "damping_alpha1", "damping_rho2", "damping_alpha2" },
                                { "damping_2_rho1", "damping_2_alpha1", "damping_2_rho2", "damping_2_alpha2" },
                                { "d.rho1", "d.alpha1", "d.rho2", "d.alpha2" },
                                { "d1.rho1", "d1.alpha1", "d1.rho2", "d1.alpha2" },
                                { "d.maxwell22.rho1", "d.maxwell22.alpha1", "d.maxwell22.rho2",
                                  "d.maxwell22.alpha2" } },
                            *const methods[] = { "fvi-stable", "fvi-lobatto4" };
    char law[200], line[400];
    for (size_t i = 0; i < LEN(laws) * LEN(methods); i++) {
        const size_t which = i / LEN(methods);
        double by[4];
        snprintf(law, sizeof law, laws[which], "0.7,0.4,0.4,0.2");
        snprintf(line, sizeof line, "gradient --potential x^4/4 --method %s %s", methods[i % 2], law);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t j = 0; j < 4; j++)
            by[j] = derivative(names[which][j]);
        snprintf(law, sizeof law, laws[which], "0.4,0.2,0.7,0.4");
        for (size_t j = 0; j < 4; j++) {
            snprintf(line, sizeof line, "gradient --potential x^4/4 --method %s %s --by %s", methods[i % 2],
                     law, names[which][j]);
            ck_assert_int_eq(fvi(line), 0);
            ck_assert_near(derivative(names[which][j]), by[(j + 2) % 4], 0, "%s", names[which][j]);
        }
        if (which == 4) /* and not those of a damper beside it */
            ck_assert_int_eq(fvi(strcat(line, " --by e.rho1")), 2);
    }
    ck_assert_int_eq(fvi("gradient --damping maxwell2:0.4,0.2,0.7,0.2"), 0);
    derivative("damping_rho2");
}
END_TEST

/* A number that has no derivative is refused if it is asked for, and else its line says why. */
START_TEST(what_has_no_derivative_is_refused_by_its_name)
{
#define OF_MESH "steps of any length have only that by the factor of a law that stands alone\n"
    static const char *const wrong[][2] = {
        { "--damping symbol:a*s^0.5 --let a=1 --by a", "'a': no derivative by a, of which the law speaks\n" },
        { "--damping symbol:s^0.5 --by damping", "'damping': no derivatives by the numbers of damping\n" },
        { "--lagrangian v^2/2-x^2/2 --x0 1 --v0 0 --by mass", "'mass' is none of x0, p0" },
        { "--method fvi-stable --alpha 0.7 --derivative rl --x0 0 --by p0,x0",
          "'x0': no derivative by x0: other starts have no solution\n" },
        { "--method fvi-adaptive --damping zener:1,0.3,2 --by damping,damping_A",
          "'damping_A': no derivative by damping_A: " OF_MESH },
        { "--method fvi-lobatto3 --damper 'd=x : power:0.3,0.7 + zener:0.3,0.3,1' --by d.power1.alpha",
          "'d.power1.alpha': no derivative by d.power1.alpha: with stages a sum of laws" },
    };
    char line[300], said[300];
    for (size_t i = 0; i < LEN(wrong); i++) {
        snprintf(line, sizeof line, "gradient --steps 20 %s", wrong[i][0]);
        snprintf(said, sizeof said, "fvi: --by: %s", wrong[i][1]);
        ck_assert_refused_with(line, said);
    }
    ck_assert_int_eq(fvi("gradient --steps 20 --method fvi-lobatto4 --damper 'd=x : davidson:1,0.3,2' "
                         "--damper 'e=x : power:1,0.3'"),
                     0);
    ck_assert_near(derivative("d.rho"), derivative("d.factor"), 1e-12, "R = 1");
    ck_assert_near(derivative("e.rho"), derivative("e.factor"), 1e-12, "R = 1");
    ck_assert_ptr_null(strstr(out, "warning"));
    const double by_order[] = { derivative("d.alpha"), derivative("e.alpha") }, by_time = derivative("d.time");
    double v[3][2];
    for (size_t i = 0; i < 6; i++) { /* off by 1e-8 times a third derivative */
        const double e = i % 2 ? 1e-4 : -1e-4;
        snprintf(line, sizeof line,
                 "run --steps 20 --columns x --method fvi-lobatto4 --damper 'd=x : davidson:1,%.17g,%.17g' --damper 'e=x : power:1,%.17g'",
                 i / 2 == 0 ? 0.3 + e : 0.3, i / 2 == 2 ? 2 + e : 2, i / 2 == 1 ? 0.3 + e : 0.3);
        ck_assert_int_eq(fvi(line), 0);
        v[i / 2][i % 2] = cell(count_rows() - 1, 0);
    }
    ck_assert_near(by_order[0], (v[0][1] - v[0][0]) / 2e-4, 1e-6, "order of davidson");
    ck_assert_near(by_order[1], (v[1][1] - v[1][0]) / 2e-4, 1e-6, "order of the springpot beside it");
    ck_assert_near(by_time, (v[2][1] - v[2][0]) / 2e-4, 1e-6, "time of davidson");
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
    ck_assert_ptr_null(strstr(out, "\ndamping_A"));
    ck_assert_int_eq(fvi("gradient --method fvi-adaptive --damping power:1,0.7 "
                         "--p0 0"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by p0"));
    ck_assert_int_eq(fvi("gradient --method fvi-adaptive --damping power:1,0.3 "
                         "--damping maxwell:1,2"),
                     0);
    ck_assert_ptr_nonnull(
        strstr(out, "# warning = no derivative by damping_2: steps of any length"));
}
END_TEST

/* The row of this name of a run of two seconds. */
static double row(const char *options, const char *name)
{
    char line[300];
    snprintf(line, sizeof line, "gradient --time 2 %s%s", strstr(options, "--steps") ? "" : "--steps 20 ", options);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    return derivative(name);
}

/* With T = 0 Havriliak and Negami's law is a power; its derivative by T is B times that of a zener, and by B it is 0.
 * With B = 1 it is a zener, and with A = 1/2 as well a Maxwell element, whose derivative by B,
 * -s ln(1 + T s)/(1 + T s), has a pole on the cut. fvi-bdf2 has this derivative by its weights, and by h/2 and h/4 to
 * order 3. Seen: 1e-9.
 * Davidson's law with A = 1/2 is a Maxwell element, too. It has a derivative by A, which a Maxwell element has not. */
START_TEST(stages_differentiate_a_law_that_is_a_simpler_law)
{
    static const char *const methods[] = { "--method fvi-lobatto4", "--method fvi-lobatto3d" };
    static const char *const equal[][4] = {
        { "havriliak:1,0.2,0,0.5", "zener:1,0.2,0", "damping", "1" },
        { "havriliak:1,0.2,0,0.5", "zener:1,0.2,0", "damping_A", "1" },
        { "havriliak:1,0.2,0,0.5", "zener:1,0.2,0", "damping_T", "0.5" },
        { "havriliak:1,0.2,0,0.5", "zener:1,0.2,0", "damping_B", "0" },
        { "havriliak:1,0.5,2,1", "zener:1,0.5,2", "damping_A", "1" },
        { "havriliak:1,0.5,2,1", "maxwell:1,2", "damping_T", "1" },
        { "havriliak:1,0.5,2,1", "maxwell:1,2", "damping", "1" },
        { "davidson:1,0.5,2", "maxwell:1,2", "damping_T", "1" },
        { "davidson:1,0.5,2", "maxwell:1,2", "damping", "1" },
    };
    char options[200];
    for (size_t m = 0; m < LEN(methods); m++)
        for (size_t i = 0; i < LEN(equal); i++) {
            const double part = atof(equal[i][3]);
            snprintf(options, sizeof options, "%s --damping %s", methods[m], equal[i][1]);
            const double want = part == 0 ? 0 : part * row(options, equal[i][2]);
            snprintf(options, sizeof options, "%s --damping %s", methods[m], equal[i][0]);
            ck_assert_near(row(options, equal[i][2]), want, 1e-13, "%s, %s", options, equal[i][2]);
        }
    static const char *const by_weights[][2] = { { "havriliak:1,0.5,2,1", "damping_B" },
                                                 { "davidson:1,0.5,2", "damping_A" } };
    for (size_t i = 0; i < LEN(by_weights); i++) {
        double of[3];
        for (size_t m = 0; m < 3; m++) {
            static const char *const how[] = { "fvi-bdf2 --steps 400", "fvi-bdf2 --steps 800", "fvi-lobatto6" };
            snprintf(options, sizeof options, "--damping %s --method %s", by_weights[i][0], how[m]);
            of[m] = row(options, by_weights[i][1]);
        }
        ck_assert_near(of[2], (4 * of[1] - of[0]) / 3, 1e-8, "%s", by_weights[i][1]);
    }
    ck_assert_int_eq(fvi("gradient --damping havriliak:1,0.49,2,1 --method fvi-lobatto4"), 1);
    ck_assert_str_eq(err, "fvi: the derivative of this law by one of its numbers is no sum of decaying modes, which "
                          "stages need; fvi, fvi-bdf2 and fvi-stable have it\n");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fvi gradient: laws of damping");
    ADD_CASE(suite, "answers", rows_of_a_law_are_differences_of_runs,
             rows_of_a_law_on_steps_of_any_length, two_springpots_in_series_have_rows,
             havriliak_has_rows_by_all_its_numbers, stages_differentiate_a_law_that_is_a_simpler_law,
             a_pair_with_poles_beside_a_law_of_high_order,
             two_springpots_in_series_have_no_row_by_half_a_number, the_parts_of_a_pair_keep_their_names,
             what_has_no_derivative_is_refused_by_its_name);
    return run_suite_of_program(suite);
}
