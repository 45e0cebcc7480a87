/* tests/program/test_fvi_fit_material.c -- The command `fvi fit --moduli`, and fits of creep and relaxation.
 * Run alone: make test-fvi_fit_material */
#define _GNU_SOURCE
#include "fit_rows.h"
#include "program.h"

#include <stdlib.h>

/* A law of a material: data are the moduli that `response` prints. */
static void write_moduli(void)
{
    ck_assert_int_eq(fvi("response --of moduli --damping 'spring:1 + zener:3,0.25,1.5' --omega "
                         "0.01:1000:41:log -o dma.tsv"),
                     0);
}

/* From a DMA file to a law with intervals, to the creep curve, and to a moving mass with that law:
 * three commands. */
START_TEST(a_rheologist_needs_three_commands)
{
    double row[4];
    write_moduli();
    ck_assert_int_eq(shell("\"$FVI\" fit --moduli --law spring+zener dma.tsv > law.tsv; cat law.tsv"),
                     0);
    static const char *const names[] = { "spring1.k", "zener2.rho", "zener2.alpha",
                                         "zener2.time" };
    static const double truth[] = { 1, 3, 0.25, 1.5 };
    for (size_t j = 0; j < LEN(names); j++) {
        row_of(names[j], row);
        ck_assert_double_eq_tol(row[0], truth[j], 1e-8);
        ck_assert(row[2] <= row[0] && row[0] <= row[3]);
    }
    ck_assert_int_eq(shell("LAW=\"$(sed -n 's/^# damping = //p' law.tsv)\"; \"$FVI\" exact --mass "
                           "1e-12 --potential free --damping \"$LAW\" --x0 0 --p0 0 --force "
                           "step:1,1e9 --h 0.5 --steps 40 --columns t,x > creep.tsv"),
                     0);
    ck_assert_int_eq(shell("LAW=\"$(sed -n 's/^# damping = //p' law.tsv)\"; \"$FVI\" run --mass 2 "
                           "--potential free --damping \"$LAW\" --method fvi-lobatto4 --columns "
                           "t,x --steps 20 | tail -1"),
                     0);
    ck_assert(atof(out) > 1.9);
    /* the creep curve has the law, too: its first row, at t = 0, is none */
    ck_assert_int_eq(shell("sed '/^0\t/d' creep.tsv > creep2.tsv; \"$FVI\" fit --creep --law "
                           "spring+zener creep2.tsv"),
                     0);
    for (size_t j = 0; j < LEN(names); j++) {
        row_of(names[j], row);
        ck_assert_double_eq_tol(row[0], truth[j], 1e-5 * truth[j]);
    }
}
END_TEST

/* Names of columns, hertz, several files, weights; a law that is another ends with 1 and writes no
 * file. */
START_TEST(fit_reads_moduli_of_many_kinds)
{
    const char *const shapes[] = {
        "cat dma.tsv",
        "echo 'omega,Gp,Gpp'; LC_ALL=C awk '!/^#/{print $1 \",\" $2 \",\" $3}' dma.tsv",
        "echo 'E\" loss w storage'; LC_ALL=C awk '!/^#/{print 7, $3, $1, $2}' dma.tsv",
        ("echo 'f storage loss'; LC_ALL=C awk '!/^#/{printf \"%.17g %s %s\\n\", $1 / 6.283185307179586, $2, "
         "$3}' dma.tsv"),
    };
    double row[4];
    write_moduli();
    for (size_t i = 0; i < LEN(shapes); i++) {
        char line[400];
        snprintf(line, sizeof line,
                 "( %s ) > e.tsv; \"$FVI\" fit --moduli --law spring+zener e.tsv", shapes[i]);
        ck_assert_msg(shell(line) == 0, "%s: %s", shapes[i], err);
        row_of("zener2.time", row);
        ck_assert_double_eq_tol(row[0], 1.5, 1e-8);
    }
    ck_assert_int_eq(shell("head -20 dma.tsv > a.tsv; (head -9 dma.tsv | grep '#'; tail -30 dma.tsv) "
                           "> b.tsv; \"$FVI\" fit --moduli --law spring+zener a.tsv b.tsv"),
                     0);
    ck_assert_double_ge(value_of("points"), 41);
    row_of("zener2.time", row);
    ck_assert_double_eq_tol(row[0], 1.5, 1e-8);
    ck_assert_int_eq(shell("(echo omega storage loss sd; LC_ALL=C awk '!/^#/{print $1, $2, $3, $2/50}' "
                           "dma.tsv) > w.tsv; \"$FVI\" fit --moduli --law spring+zener --weights sd "
                           "w.tsv"),
                     0);
    row_of("zener2.time", row);
    ck_assert_double_eq_tol(row[0], 1.5, 1e-8);
    ck_assert_int_eq(fvi("fit --moduli --law spring+power -o no.tsv --curve no2.tsv dma.tsv"), 1);
    ck_assert_ptr_nonnull(strstr(err, "it is another law"));
    ck_assert(!exists("no.tsv") && !exists("no2.tsv"));
    ck_assert_int_eq(fvi("fit --moduli --law spring+power dma.tsv"), 1);
    ck_assert_ptr_nonnull(strstr(out, "\n# flag = neighbouring residuals are alike"));
    ck_assert_int_eq(shell("awk '!/^#/{print $1, $2}' dma.tsv > plain.tsv; "
                           "printf '0 1\\n1 2\\n2 3\\n3 3\\n' > from_0.tsv; echo 1 1 > one.tsv"),
                     0);
    static const char *const wrong[][2] = {
        { "fit --moduli", "DATA: a file with the columns omega, storage and loss" },
        { "fit --creep", "DATA: a file with the columns t and x" },
        { "fit --moduli --law spring+zenr dma.tsv", "zener" },
        { "fit --moduli --law '' dma.tsv", "--law" },
        { "fit --moduli dma.tsv --creep", "fvi: --creep: not together with --moduli" },
        { "fit -- --moduli", "fvi: DATA: cannot read '--moduli'" },
        { "fit --moduli --weights sd dma.tsv", "no line names a column 'sd'" },
        { "fit --moduli --weights a,b,c dma.tsv", "--weights" },
        { "fit --moduli --sigma -1 dma.tsv", "--sigma" },
        { "fit --moduli --starts 1 dma.tsv", "--starts" },
        { "fit --moduli --alpha 0.3 dma.tsv", "--alpha" },
        { "fit --relaxation --law viscous+zener plain.tsv", "relaxes at once" },
        { "fit --creep from_0.tsv", "fvi: DATA: from_0.tsv: t must be finite and above 0" },
        { "fit --creep one.tsv", "fvi: DATA: one.tsv: 1 rows are not enough for 3 numbers" },
        { "fit --moduli -o dma.tsv dma.tsv", "-o: 'dma.tsv' is the file of the data, too" },
        { "fit --moduli --curve a.tsv dma.tsv a.tsv",
          "--curve: 'a.tsv' is the file of the data, too" },
    };
    for (size_t i = 0; i < LEN(wrong); i++) {
        ck_assert_msg(fvi(wrong[i][0]) == 2, "%s: %s", wrong[i][0], err);
        ck_assert_msg(strstr(err, wrong[i][1]), "%s: %s", wrong[i][0], err);
        ck_assert_str_eq(out, "");
    }
}
END_TEST

/* Without names the first column is omega. If only the first name is known, it says the unit: f is in hertz. A comment
 * of three words names nothing. */
START_TEST(the_name_of_the_first_column_says_its_unit)
{
    static const char *const heads[] = { "", "omega a b", "# made by me", "f storage loss", "f a b", "Hertz;a;b" };
    double rho[LEN(heads)], row[4];
    for (size_t i = 0; i < LEN(heads); i++) {
        char line[200];
        snprintf(line, sizeof line, "printf '%s\n1;2;3\n2;3;4\n4;4;5\n8;5;6\n' > unit.tsv", heads[i]);
        ck_assert_int_eq(shell(line), 0);
        ck_assert_msg(fvi("fit --moduli --law power unit.tsv") != 2, "%s: %s", heads[i], err);
        row_of("power1.rho", row);
        rho[i] = row[0];
    }
    ck_assert(rho[1] == rho[0] && rho[2] == rho[0] && rho[4] == rho[3] && rho[5] == rho[3]);
    row_of("power1.alpha", row);
    ck_assert_near(rho[3] * pow(2 * M_PI, 2 * row[0]) / rho[0], 1, 1e-6, "hertz"); /* R (2 pi f)^{2A} */
}
END_TEST

/* A table whose header names the columns of another test is not taken for numbers without names. */
START_TEST(a_table_of_another_test_is_refused)
{
    static const char *const rows = "printf '%s\\n1\\t2\\t3\\n2\\t2.5\\t3\\n3\\t3\\t3\\n"
                                    "4\\t3.5\\t3\\n' > other.tsv";
    static const char *const other[][3] = {
        { "# omega\\tstorage\\tloss", "--creep", "has a column omega, and no t and x: it is not of "
                                               "--creep" },
        { "w\\tGp\\tGpp", "--relaxation", "has a column omega, and no t and f" },
        { "t\\tx\\tsd", "--moduli", "has a column t, and no omega, storage and loss" },
        { "", "--creep", "has more than 2 columns, and no names: a line '# t x' would say which are those of --creep" },
        { "", "--relaxation", "has more than 2 columns, and no names: a line '# t f'" },
        { "temperature\\tstorage\\tloss", "--moduli",
          "other.tsv: the first column has the name 'temperature', which is none of omega|w|f|frequency|hertz|hz\n" },
        { "# rpm\\tGp\\tGpp", "--moduli", "the first column has the name 'rpm', which is none of omega|w|f|" },
        { "frequency [Hz];G 1;G 2", "--moduli", "the first column has the name 'frequency [Hz]', which is none of" },
        { "rad/s,a,b", "--moduli", "the first column has the name 'rad/s', which is none of" },
    };
    char line[300];
    for (size_t i = 0; i < LEN(other); i++) {
        snprintf(line, sizeof line, rows, other[i][0]);
        ck_assert_int_eq(shell(line), 0);
        snprintf(line, sizeof line, "fit %s --law spring+zener other.tsv", other[i][1]);
        ck_assert_int_eq(fvi(line), 2);
        ck_assert_msg(strstr(err, other[i][2]) != NULL, "%s: %s", line, err);
    }
    snprintf(line, sizeof line, rows, "f\\tstress\\tsd"); /* f is a force here */
    ck_assert_int_eq(shell(line), 0);
    fvi("fit --relaxation --law power other.tsv");
    ck_assert_ptr_null(strstr(err, "has a column"));
    snprintf(line, sizeof line, rows, "# t\\tx\\tsd"); /* named columns may have others beside them */
    ck_assert_int_eq(shell(line), 0);
    ck_assert_int_ne(fvi("fit --creep --law power other.tsv"), 2);
}
END_TEST

/* A law that repeats the data to the last digit leaves no noise, and each interval is the estimate. */
START_TEST(exact_data_have_intervals_without_length)
{
    ck_assert_int_eq(shell("printf 'omega storage loss\\n1 1 0\\n2 1 0\\n3 1 0\\n4 1 0\\n' > exact.tsv"), 0);
    ck_assert_msg(fvi("fit --moduli --law spring exact.tsv") == 0, "%s", err);
    ck_assert_ptr_nonnull(strstr(out, "\nspring1.k\t1\t0\t1\t1\n"));
    ck_assert_str_eq(err, "");
}
END_TEST

/* A plan has the standard deviations of a fit of such data: 1.96 sd are the halves of its
 * intervals, in the logit; (24.3) at the truth is tested elsewhere. */
START_TEST(fit_plans_a_test)
{
    double row[4];
    ck_assert_int_eq(fvi("fit --design --fit alpha,rho,c --alpha 0.3 --rho 0.4 --p0 0.25 --sigma "
                         "0.02 --time 20 --steps 200"),
                     0);
    row_of("alpha", row);
    ck_assert_double_eq(row[0], 0.3);
    ck_assert_double_eq_tol(row[1], 0.0024785, 1e-6);
    ck_assert_double_eq_tol(row[3] - row[2], 2 * 1.96 * row[1], 0.01 * row[1]);
    ck_assert_double_eq(value_of("points"), 200);
    ck_assert_ptr_nonnull(strstr(err, "an offset of 0.48 sigma would not be seen"));
    ck_assert_int_eq(fvi("fit --design --fit mass,rho,c,p0 --sigma 0.02"), 1);
    ck_assert_ptr_nonnull(strstr(err, "do not determine mass,rho,c,p0 together"));
    static const char *const wrong[][2] = {
        { "fit --design --fit alpha", "--sigma: is missing" },
        { "fit --design --sigma 0.1 --starts 4", "--starts: not together with --design" },
        { "fit --design --sigma 0.1 --curve c.tsv", "--curve: not together with --design" },
        { "fit --design --sigma 0.1 --steps 2", "--steps: 2 rows are not enough" },
        { "fit --design --sigma 0.1 data.tsv", "'data.tsv': not expected here" },
        { "fit --steps 3 data.tsv", "--steps" },
    };
    for (size_t i = 0; i < LEN(wrong); i++) {
        ck_assert_msg(fvi(wrong[i][0]) == 2, "%s: %s", wrong[i][0], err);
        ck_assert_msg(strstr(err, wrong[i][1]), "%s: %s", wrong[i][0], err);
        ck_assert_str_eq(out, "");
    }
}
END_TEST

/* Creep of a light mass, 2 x + 3 D^{1/2} x = 1, at times that are even in their logarithms: equal
 * steps would be 150,000, and the fit takes its own. Without noise what is wrong is the inertia, of
 * 1e-4 of the force, and the truth is met to that. */
START_TEST(fit_chooses_steps_of_its_own_where_gaps_are_short)
{
    double row[4];
    ck_assert_int_eq(shell("(echo t x; i=0; while [ $i -lt 40 ]; do \"$FVI\" exact --mass 1e-12 "
                           "--potential free --damping 'spring:2 + power:3,0.25' --x0 0 --p0 0 "
                           "--force step:1,1e9 --steps 1 --time $(LC_ALL=C awk \"BEGIN{print 1e-3 * exp($i * "
                           "0.264)}\") --columns t,x | tail -1; i=$((i + 1)); done) > log.tsv; true"),
                     0);
    fvi("fit --mass 1e-4 --force step:1,1e9 --x0 0 --p0 0 --fit alpha,rho,c --starts 4 log.tsv");
    ck_assert_msg(strstr(out, "\n# method = fvi-adaptive\n"), "%s%s", out, err);
    row_of("alpha", row);
    ck_assert_double_eq_tol(row[0], 0.25, 1e-3);
    row_of("c", row);
    ck_assert_double_eq_tol(row[0], 2, 1e-2);
}
END_TEST

/* The numbers of the page: its table, fitted three times, and its first 25 rows. */
START_TEST(the_table_of_the_page_is_fitted_as_it_says)
{
    static const char TABLE[] = "\"$SOURCES\"/../figures/identification/measured.tsv";
    char line[300];
    double row[4];
    snprintf(line, sizeof line, "\"$FVI\" fit --p0 0.25 --fit alpha,rho %s", TABLE);
    ck_assert_int_eq(shell(line), 1);
    row_of("alpha", row);
    ck_assert_double_eq_tol(row[0], 0.2963, 5e-5);
    ck_assert_ptr_nonnull(strstr(err, "the residuals have a mean"));
    snprintf(line, sizeof line, "\"$FVI\" fit --p0 0.25 --fit alpha,rho,c %s", TABLE);
    ck_assert_int_eq(shell(line), 0);
    row_of("alpha", row);
    ck_assert_double_eq_tol(row[0], 0.2859, 5e-5);
    ck_assert_double_eq_tol(row[2], 0.2817, 5e-5);
    ck_assert_double_eq_tol(row[3], 0.2902, 5e-5);
    ck_assert_ptr_nonnull(strstr(err, "an offset of 0.51 sigma would not be seen in the residuals "
                                      "and moves alpha by 6.1 sd"));
    snprintf(line, sizeof line, "\"$FVI\" fit --p0 0.25 --fit alpha,rho,c,offset %s", TABLE);
    ck_assert_int_eq(shell(line), 0);
    row_of("alpha", row);
    ck_assert_double_eq_tol(row[0], 0.2937, 5e-5);
    ck_assert(row[2] < 0.3 && 0.3 < row[3]);
    snprintf(line, sizeof line,
             "head -27 %s > short.tsv; \"$FVI\" fit --p0 0.25 --fit alpha,rho,c short.tsv", TABLE);
    ck_assert_int_eq(shell(line), 0);
    row_of("alpha", row);
    ck_assert_double_eq(row[2], 0);
    ck_assert_double_eq_tol(row[3], 0.42, 5e-3);
}
END_TEST

int main(void)
{
    char *sources = realpath("src", NULL);
    setenv("SOURCES", sources ? sources : "src", 1);
    free(sources);
    Suite *suite = suite_create("fvi fit --moduli");
    ADD_CASE(suite, "materials", a_rheologist_needs_three_commands,
             fit_reads_moduli_of_many_kinds, the_name_of_the_first_column_says_its_unit,
             a_table_of_another_test_is_refused,
             exact_data_have_intervals_without_length,
             fit_plans_a_test,
             fit_chooses_steps_of_its_own_where_gaps_are_short,
             the_table_of_the_page_is_fitted_as_it_says);
    return run_suite_of_program(suite);
}
