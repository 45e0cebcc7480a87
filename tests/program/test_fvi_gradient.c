/* tests/program/test_fvi_gradient.c -- The command fvi gradient.
 *                                         Run alone: make test-fvi_gradient */
#define _GNU_SOURCE
#include "gradient_rows.h"
#include "system/larger.h"

static const char *const runs[] = {
    "--alpha 0.3 --potential duffing:1,0.5 --rho 0.4 --force cosine:0.3,1",
    "--alpha 0.7 --method fvi-shifted --potential pendulum:1 --rho 0.3",
    "--alpha 0.7 --method fvi-bdf2 --potential 'k*x^4/4+x^2/2' --let k=0.5 "
    "--force 'cos(k*t)' --derivative caputo",
    "--alpha 0.7 --method fvi-lobatto3 --potential 'k*x^4/4+x^2/2' --let k=0.5 "
    "--force 'cos(k*t)'",
    "--alpha 0.3 --potential duffing:1,0.5 --rho 0.4 --method fvi-lobatto3d",
    "--alpha 1 --potential duffing:1,0.5 --rho 0.4 --method fvi-lobatto4",
    "--damping maxwell:0.2,1 --damping zener:0.3,0.4,1 --method fvi-bdf2",
    "--alpha 0.3 --potential duffing:1,0.5 --rho 0.4 --method fvi-adaptive",
    "--alpha 0.3 --method fvi-adaptive --potential 'k*x^4/4+x^2/2' --let k=0.5 "
    "--force 'cos(t)'",
    "--alpha 0.3 --rho 0.4 --method fvi-adaptive --force impulse:0.7,3.04",
    "--alpha 0.7 --potential duffing:1,0.5 --rho 0.4 --method fvi-adaptive",
    "--alpha 0.3 --rho 0.4 --derivative rl --method fvi-adaptive",
    "--alpha 1 --rho 0.4 --method fvi-adaptive",
};

/* Each row against a central difference of two runs, 2e-5 wide: its own error is some
 * 1e-10/6 times a third derivative (t^3 = 8000 in cos(k t)), and 1e-14/1e-5 of rounding. */
START_TEST(rows_of_a_gradient_are_differences_of_runs)
{
    static const struct {
        size_t run;
        const char *name, *option;
        double at;
    } rows[] = {
        { 0, "x0", "--x0", 1 },
        { 0, "p0", "--p0", 0.5 },
        { 0, "mass", "--mass", 1 },
        { 0, "g", "--potential duffing:1,", 0.5 },
        { 1, "x0", "--x0", 1 },
        { 1, "p0", "--p0", 0.5 },
        { 1, "mass", "--mass", 1 },
        { 1, "g", "--potential pendulum:", 1 },
        { 2, "k", "--let k=", 0.5 },
        { 2, "mass", "--mass", 1 },
        { 3, "k", "--let k=", 0.5 },
        { 3, "rho", "--rho", 0.2 },
        { 3, "alpha", "--alpha", 0.7 },
        { 4, "alpha", "--alpha", 0.3 },
        { 4, "mass", "--mass", 1 },
        { 5, "mass", "--mass", 1 },
        { 5, "rho", "--rho", 0.4 },
        { 5, "p0", "--p0", 0.5 },
        { 6, "p0", "--p0", 0.5 },
        { 6, "mass", "--mass", 1 },
        { 7, "p0", "--p0", 0.5 },
        { 7, "rho", "--rho", 0.4 },
        { 7, "alpha", "--alpha", 0.3 },
        { 8, "k", "--let k=", 0.5 },
        { 9, "mass", "--mass", 1 },
        { 9, "alpha", "--alpha", 0.3 },
        { 10, "p0", "--p0", 0.5 },
        { 10, "mass", "--mass", 1 },
        { 10, "rho", "--rho", 0.4 },
        { 10, "alpha", "--alpha", 0.7 },
        { 11, "x0", "--x0", 1 },
        { 11, "alpha", "--alpha", 0.3 },
        { 12, "p0", "--p0", 0.5 },
        { 12, "rho", "--rho", 0.4 },
    };
    static const char *const of[] = { "x", "p", "energy" };
    double slope[LEN(rows)][LEN(of)];
    for (size_t j = 0; j < LEN(rows); j++) {
        char options[500], more[100], ends = ' ';
        /* what is varied must not be given twice */
        snprintf(options, sizeof options, "%s", runs[rows[j].run]);
        char *given =
            strstr(options, rows[j].name[0] == 'g'   ? "--potential"
                            : rows[j].name[0] == 'k' ? "--let k"
                                                     : rows[j].option);
        if (given) {
            char *end = strchr(strchr(given, ' ') + 1, ' ');
            memset(given, ' ', end ? (size_t)(end - given) : strlen(given));
        }
        double v[2][LEN(of)];
        if (rows[j].option[strlen(rows[j].option) - 1] == ','
            || strchr(rows[j].option, '=') || strchr(rows[j].option, ':'))
            ends = '\0';
        for (int side = 0; side < 2; side++) {
            snprintf(more, sizeof more, "%s%.*s%.17g", rows[j].option,
                     ends == ' ', " ", rows[j].at + (side ? 1e-5 : -1e-5));
            last_row(options, "x,p,energy", more, LEN(of), v[side]);
        }
        for (size_t c = 0; c < LEN(of); c++)
            slope[j][c] = (v[1][c] - v[0][c]) / 2e-5;
    }
    for (size_t i = 0; i < LEN(of) * LEN(runs); i++) {
        const size_t c = i % LEN(of), run = i / LEN(of);
        char line[1000];
        snprintf(line, sizeof line, "gradient %s --of %s", runs[run], of[c]);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t j = 0; j < LEN(rows); j++)
            if (rows[j].run == run)
                ck_assert_near(derivative(rows[j].name), slope[j][c],
                               1e-6 * larger(1, fabs(slope[j][c])),
                               "%s by %s, run %zu", of[c], rows[j].name, run);
    }
}
END_TEST

/* The same digits, and no other row; a word that no row has is refused. */
START_TEST(by_chooses_rows)
{
    static const char *const names[] = { "x0_1", "x0_2", "mass_2", "damping_1_rho1", "damping_1_rho2",
                                         "k" };
    const char *same = "gradient --mass 1,2 --potential 'k*x1^2+x2^2+(x2-x1)^4' --let k=1,b=2 "
                       "--damping maxwell2:1,0.4,2,0.1 --damping zener:1,0.3,1 --force b*t";
    double all[LEN(names)];
    char line[500];
    ck_assert_int_eq(fvi(same), 0);
    for (size_t i = 0; i < LEN(names); i++)
        all[i] = derivative(names[i]);
    snprintf(line, sizeof line, "%s --by x0,mass_2,damping_1_rho1,damping_1_rho2,k", same);
    ck_assert_int_eq(fvi(line), 0);
    for (size_t i = 0; i < LEN(names); i++)
        ck_assert_near(derivative(names[i]), all[i], 0, "%s", names[i]);
    ck_assert_uint_eq(count_rows(), LEN(names));
    snprintf(line, sizeof line, "%s --by damping_1_rho1", same);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_near(derivative("damping_1_rho1"), all[3], 0, "alone");
    snprintf(line, sizeof line, "%s --by b", same);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_uint_eq(count_rows(), 1);
    ck_assert_int_eq(fvi("gradient --potential chain:600,1,0 --x0 0 --steps 3 --by rho_600,c"), 0); /* rows 1800 and 1802 */
    ck_assert_uint_eq(count_rows(), 2);
    ck_assert_int_eq(fvi("gradient --by alhpa"), 2);
    ck_assert_ptr_nonnull(strstr(err, "--by: 'alhpa' is none of x0, p0, mass, rho, alpha, c; did "
                                      "you mean alpha?"));
    ck_assert_int_eq(fvi("gradient --by ''"), 2);
    ck_assert_int_eq(fvi("gradient --by x0,"), 2);
}
END_TEST

/* Of two masses; and the table of forces, which for a kick adds up to what the kick does.
 * The force of all steps together, cos(t) on every mass, times its table: for a linear
 * system x_N is the sum of what x0, p0 and F do to it. Roundings of 200 sums. */
START_TEST(the_forces_and_the_start_add_up_to_a_linear_motion)
{
    const char *line = "gradient --potential chain:2,1,0 --alpha 0.4 --x0 1,2 "
                       "--p0 0.5,-1 --force cosine:0.3,1 --rho 0.4,0.1 --of "
                       "x:2 --forces f.tsv";
    ck_assert_int_eq(fvi(line), 0);
    double sum = derivative("x0_1") + 2 * derivative("x0_2")
                 + 0.5 * derivative("p0_1") - derivative("p0_2");
    const double value = strtod(strstr(out, "# value = ") + 10, NULL);
    ck_assert_int_eq(shell("cat f.tsv"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# t\tF1\tF2\n"));
    ck_assert_uint_eq(count_rows(), 201);
    for (size_t k = 0; k <= 200; k++)
        sum += 0.3 * cos(cell(k, 0)) * (cell(k, 1) + cell(k, 2));
    ck_assert_near(sum, value, 400 * U * 10, "x_N");
    ck_assert_int_eq(fvi("run --potential chain:2,1,0 --alpha 0.4 --x0 1,2 "
                         "--p0 0.5,-1 --force cosine:0.3,1 --rho 0.4,0.1 "
                         "--columns x --every 1000"),
                     0);
    ck_assert(cell(1, 1) == value);
}
END_TEST

/* What is at rest stays at rest, whatever rho: no derivative, and no sign. */
START_TEST(nothing_has_no_sign)
{
    ck_assert_int_eq(fvi("gradient --alpha 0.3 --x0 0 --p0 0"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\nrho\t0\n"));
}
END_TEST

START_TEST(bad_words_of_a_gradient_are_refused)
{
    static const struct {
        const char *words, *complaint;
    } bad[] = {
        { "--method lda", "--method: 'lda' has no gradient; fvi, " },
        { "--method fvi-adaptive --potential b*x --force 'a*cos(t)' --let "
          "b=1,a=1",
          "--let: 'a' has no gradient with fvi-adaptive" },
        { "--of y", "--of: 'y' is none of x, p, energy" },
        { "--of x:2", "--of: '2' is outside [1, 1]" },
        { "--of energy:1", "--of: 'energy:1': there is one energy" },
        { "--potential chain:2,1,0 --of x", "x:1 to x:2" },
        { "--columns x", "--columns: not an option of this command" },
        { "--plot a.svg", "--plot: not an option of this command" },
        { "--checkpoint c", "--checkpoint: not an option of this command" },
        { "--of", "--of: a value is missing" },
        { "--of x --of p", "--of: given twice, as 'x' and as 'p'" },
        { "--alpha 2", "--alpha: '2' is outside [0, 1]" },
        { "--forces ''", "--forces: '' is not a file's name" },
        { "--forces a -o a", "--forces: 'a' is the table's file, too" },
        { "word", "'word': not expected here" },
        { "--off x", "--off: no such option; did you mean --of?" },
        { "--foce none", "--foce: no such option; did you mean --force?" },
        { "--vary alpha", "--vary: no such option\n" },
        { "--count 3", "--count: not an option of this command" },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        char line[200];
        snprintf(line, sizeof line, "gradient %s", bad[i].words);
        ck_assert_int_eq(fvi(line), 2);
        ck_assert_str_eq(out, "");
        ck_assert_msg(strstr(err, bad[i].complaint) != NULL, "%s: %s",
                      bad[i].words, err);
    }
    ck_assert_int_eq(fvi("gradient --help"), 0);
    ck_assert_ptr_nonnull(strstr(out, "usage: fvi gradient"));
    ck_assert_int_eq(fvi("help gradient"), 0);
    ck_assert_ptr_nonnull(strstr(out, "--forces FILE"));
}
END_TEST

/* What cannot be done: a run that flies away is told with its step, a folder that is not
 * there with its name. A start without neighbours has no row by x0. */
START_TEST(a_gradient_that_cannot_be_had_says_why)
{
    ck_assert_int_eq(fvi("gradient --potential duffing:1,-9 --p0 9"), 1);
    ck_assert_ptr_nonnull(strstr(err, "step "));
    ck_assert_str_eq(out, "");
    static const char *const too_large[] = {
        "gradient --x0 1e200 --of energy",
        "gradient --x0 1e155 --of energy --potential harmonic:1e-3 --mass 1e3",
        "gradient --potential 'exp(x)' --x0 700 --steps 200 --h 1e-160 --of energy"
    };
    for (size_t i = 0; i < LEN(too_large); i++) {
        ck_assert_int_eq(fvi(too_large[i]), 1);
        ck_assert_str_eq(err, "fvi: step 200: a value is no longer finite\n");
        ck_assert_str_eq(out, "");
    }
    ck_assert_int_eq(fvi("gradient --forces no/where"), 1);
    ck_assert_int_eq(
        fvi("gradient --method fvi-shifted --derivative rl --alpha 0.7 --x0 0"),
        0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by x0"));
    ck_assert_ptr_null(strstr(out, "nan"));
    ck_assert_int_eq(
        fvi("gradient --method fvi-adaptive --derivative rl --alpha 0"), 0);
    ck_assert_ptr_nonnull(
        strstr(out, "# warning = no derivative by alpha: there x has"));
}
END_TEST

/* The value that is printed is of the run that the adjoint does: it does one, and one more in
 * pieces. The potential counts how often it is asked for its gradient. */
START_TEST(a_gradient_does_not_run_once_more_for_its_value)
{
    write_file("count.c",
               "#include <fvi/system.h>\n#include <stdio.h>\n"
               "static long asked;\n"
               "static int value(size_t d, const double *x, void *p, double *U)"
               "{ (void)d, (void)p; *U = x[0] * x[0]; return 0; }\n"
               "static int gradient(size_t d, const double *x, void *p, double "
               "*g) { (void)d, (void)p; asked++; g[0] = 2 * x[0]; return 0; }\n"
               "static int hessian(size_t d, const double *x, void *p, double "
               "*H) { (void)d, (void)p; (void)x; H[0] = 2; return 0; }\n"
               "__attribute__((destructor)) static void say(void) { FILE *f = "
               "fopen(\"asked\", \"w\"); fprintf(f, \"%ld\", asked); "
               "fclose(f); }\n"
               "const fvi_potential fvi_user_potential = { .value = value, "
               ".gradient = gradient, .hessian = hessian };\n");
    static const char *const of[] = { "x", "p", "energy" };
    for (size_t i = 0; i < LEN(of); i++) {
        char line[200];
        ck_assert_int_eq(
            fvi("run --potential count.c --alpha 0.3 --steps 1000 --columns "
                "x,p,energy --every 1000"),
            0);
        const double want = cell(1, i);
        ck_assert_int_eq(shell("cat asked"), 0);
        const double of_run = atof(out);
        snprintf(line, sizeof line,
                 "gradient --potential count.c --alpha 0.3 --steps 1000 --of "
                 "%s",
                 of[i]);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert(strtod(strstr(out, "# value = ") + 10, NULL) == want);
        ck_assert_int_eq(shell("cat asked"), 0);
        ck_assert_msg(of_run > 999 && atof(out) < 2.5 * of_run, "%s of %g", out,
                      of_run);
    }
}
END_TEST

static double last_of_run(const char *options, const char *column, const char *changed)
{
    char line[300];
    snprintf(line, sizeof line, "run %s %s --columns %s --every 20", options, changed, column);
    ck_assert_int_eq(fvi(line), 0);
    return cell(1, 0);
}

/* The force and the impulse of a damper, as the columns of a run have them. A linear motion is linear in its start, so a
 * difference of two runs is the derivative but for roundings, which 1/h and the differences multiply by 1e3. */
START_TEST(a_gradient_of_a_damper_is_a_difference_of_runs)
{
    static const struct {
        const char *options, *of, *row, *start[2];
    } cases[] = {
        { "--alpha 0.3 --method fvi-lobatto4", "d1.force", "x0", { "--x0 1", "--x0 2" } },
        { "--alpha 0.7 --method fvi-stable", "d1.impulse", "p0", { "--p0 1", "--p0 2" } },
        { "--alpha 0.3 --potential chain:2,1,0 --method fvi", "d1.force2", "x0_1", { "--x0 0.5,0.3", "--x0 1.5,0.3" } },
        { "--potential chain:2,1,0 --damper 'x1 : power:0.2,0.3' --damper 'e=x2-x1 : zener:0.5,0.4,1' --method fvi-stable",
          "e.force", "p0_2", { "--p0 0.5,1", "--p0 0.5,2" } }
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        char line[300], options[200];
        snprintf(options, sizeof options, "%s --steps 20 --time 2", cases[i].options);
        const double value = last_of_run(options, cases[i].of, cases[i].start[0]),
                     want = last_of_run(options, cases[i].of, cases[i].start[1]) - value;
        snprintf(line, sizeof line, "gradient %s %s --of %s", options, cases[i].start[0], cases[i].of);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert(strtod(strstr(out, "# value = ") + 10, NULL) == value);
        ck_assert_near(derivative(cases[i].row), want, 1e-12 * larger(1, fabs(want)), "case %zu", i);
    }
#define LONG_NAME "a_name_of_more_than_eighty_letters_that_nobody_would_write_but_a_program_that_makes_names"
    static const char *const bad[][2] = {
        { "--of d1.force --potential x1^2+x2^2 --constraint x1-x2 --rho 0 --x0 1,1 --method fvi-stable",
          "--of: 'd1.force': this system has no damper" },
        { "--damper '" LONG_NAME "=x1 : power:0.2,0.3' --of " LONG_NAME ".force2 --potential chain:2,1,0 --method fvi",
          "--of: '2' is " },
        { "--of d2.force --method fvi", "--of: 'd2.force': there is no damper 'd2'; the first is d1" },
        { "--of d1.force --method fvi-adaptive", "--of: 'd1.force': fvi-adaptive has no derivatives of the forces of dampers" },
        { "--of d1.force --potential chain:2,1,0 --method fvi", "--of: 'd1.force' of which coordinate? d1.force1 to d1.force2" },
        { "--of d1.force3 --potential chain:2,1,0 --method fvi", "--of: " },
        { "--of d1.force --alpha 0.7 --method fvi-stable --steps 20", "--of: 'd1.force': the forces of the first 20 rows come from" },
        { "--of d1.force:2 --potential chain:2,1,0 --method fvi",
          "--of: 'd1.force:2' has a colon too many: it is d1.force2" },
        { "--of a_long_word --method fvi", "--of: 'a_long_word' is none of x, p, energy" },
        { "--of d1.work --method fvi", "--of: 'd1.work' is none of x, p, energy" }
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        char line[300];
        snprintf(line, sizeof line, "gradient %s", bad[i][0]);
        ck_assert_int_eq(fvi(line), 2);
        ck_assert_msg(strstr(err, bad[i][1]) != NULL, "%s: %s", line, err);
    }
    ck_assert_int_eq(fvi("gradient --of d1.force --alpha 1 --method fvi"), 1);
    ck_assert_ptr_nonnull(strstr(err, "at alpha = 1 the damping is a mass"));
    /* the rate x of x (1 + t) changes with x0, that of x + t does not */
    ck_assert_int_eq(fvi("gradient --of d1.force --method fvi-stable --damper 'x*(1+t) : power:0.4,0.3'"), 1);
    ck_assert_ptr_nonnull(strstr(err, "no derivative by x0 of the force of a damper if the rate of its elongation"));
    ck_assert_int_eq(fvi("gradient --of d1.force --method fvi-stable --damper 'x*(1+t) : power:0.4,0.3' --by p0"), 0);
    ck_assert_int_eq(fvi("gradient --of d1.force --method fvi-stable --damper 'x+t : power:0.4,0.3'"), 0);
}
END_TEST

/* With the past rl the force jumps at every start but 0, so the first rows of a neighbour come from shorter steps. */
START_TEST(a_force_of_a_first_row_has_no_derivative_by_a_start_at_0_of_the_past_rl)
{
#define AT_0 "gradient --x0 0 --p0 0.5 --h 0.1 --method fvi-stable "
    static const char *const first[] = {
        AT_0 "--of d1.force --steps 2 --alpha 0.3 --derivative rl",
        AT_0 "--of d1.force --steps 2 --damper 'x : power:0.2,0.3 : rl'",
    };
    for (size_t i = 0; i < LEN(first); i++) {
        ck_assert_int_eq(fvi(first[i]), 0);
        ck_assert_ptr_nonnull(strstr(out, "# warning = no derivative by x0: from another start this force comes from "
                                          "steps shorter than those of the run\n"));
        ck_assert(!strstr(out, "\nx0\t"));
        ck_assert_ptr_nonnull(strstr(out, "\np0\t"));
    }
    ck_assert_int_eq(fvi(AT_0 "--of d1.impulse --steps 2 --alpha 0.3 --derivative rl"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\nx0\t"));
    ck_assert_int_eq(fvi(AT_0 "--of d1.force --steps 2 --alpha 0.3 --derivative held"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\nx0\t"));
    static const char later[] = "--p0 0.5 --h 0.1 --steps 20 --method fvi --alpha 0.3 --derivative rl";
    const double want = last_of_run(later, "d1.force", "--x0 1") - last_of_run(later, "d1.force", "--x0 0");
    char line[200];
    snprintf(line, sizeof line, "gradient --x0 0 --of d1.force %s", later);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_near(derivative("x0"), want, 1e-12, "row 20");
#undef AT_0
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fvi gradient");
    ADD_CASE(suite, "answers", rows_of_a_gradient_are_differences_of_runs,
             by_chooses_rows,
             the_forces_and_the_start_add_up_to_a_linear_motion,
             nothing_has_no_sign, a_gradient_of_a_damper_is_a_difference_of_runs,
             a_force_of_a_first_row_has_no_derivative_by_a_start_at_0_of_the_past_rl,
             bad_words_of_a_gradient_are_refused, a_gradient_that_cannot_be_had_says_why);
    ADD_CASE(suite, "work", a_gradient_does_not_run_once_more_for_its_value);
    return run_suite_of_program(suite);
}
