/* tests/program/test_fvi_fit.c -- The command `fvi fit`: from a file to an estimate.
 * Run alone: make test-fvi_fit */
#define _GNU_SOURCE
#include "identification/identification_ref.h"
#include "program.h"
#include "fit_rows.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

enum { CELLS = 5 };

static FILE *file_in_folder(const char *name)
{
    char path[PATH_MAX + 100];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    return f;
}

/* The exact motion of another program with noise, to five digits. */
static void write_data(const char *name, double sigma, unsigned long seed)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    FILE *f = file_in_folder(name);
    gsl_rng_set(r, seed);
    fprintf(f, "# made elsewhere\n# t\tx\n");
    for (size_t i = 0; i < REF_POINTS; i++)
        fprintf(f, "%.1f\t%.5f\n", 0.1 * (double)(i + 1),
                ref_low[i] + gsl_ran_gaussian(r, sigma));
    fclose(f);
    gsl_rng_free(r);
}

/* 3 sd: of the three estimates of five data sets one misses with a probability below
 * 15 * 0.0027 = 4 %; the seeds are fixed. */
START_TEST(fit_finds_what_another_program_put_in)
{
    const char *const names[] = { "alpha", "rho", "c" };
    for (unsigned long seed = 1; seed <= 5; seed++) {
        write_data("d.tsv", 0.02, seed);
        ck_assert_int_eq(fvi("fit --potential harmonic:2 --p0 0.25 --fit "
                             "alpha,rho,c --sigma 0.02 d.tsv"),
                         0);
        /* an offset of half a sigma would not be seen: that is said, and nothing else */
        ck_assert_ptr_nonnull(strstr(err, "would not be seen"));
        ck_assert_ptr_null(strstr(out, "# flag"));
        for (size_t j = 0; j < LEN(names); j++) {
            double row[4];
            row_of(names[j], row);
            ck_assert(fabs(row[0] - ref_errors[0].truth[j]) < 3 * row[1]);
            ck_assert_double_eq_tol(row[1], 0.02 * ref_errors[0].sd[j],
                                    0.1 * row[1]);
            /* profiles: nearly those of the sd, and skew by the bend of the valley */
            ck_assert_double_eq_tol(row[3] - row[0], 1.959964 * row[1], 0.05 * row[1]);
            ck_assert_double_eq_tol(row[0] - row[2], 1.959964 * row[1], 0.05 * row[1]);
        }
        ck_assert_double_eq(value_of("points"), REF_POINTS);
        ck_assert(strstr(out, "# starts = 20, ") && strstr(out, " agree\n"));
        ck_assert(fabs(value_of("correlation alpha c") - 0.70) < 0.1);
    }
}
END_TEST

/* The three silent failures: noise, an offset, a bent valley that ends outside of (0, 1). Each is
 * a flag on standard error and in the table; a grave one ends with 1, and writes no file. */
START_TEST(fit_says_what_it_was_silent_of)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    FILE *noise = file_in_folder("noise.tsv"), *offset = file_in_folder("offset.tsv"),
         *few = file_in_folder("few.tsv");
    for (size_t i = 0; i < REF_POINTS; i++) {
        const double t = 0.1 * (double)(i + 1);
        fprintf(noise, "%g %g\n", t, gsl_ran_gaussian(r, 0.1));
        fprintf(offset, "%g %g\n", t, ref_low[i] + gsl_ran_gaussian(r, 0.02) + 0.01);
        if (i % 8 == 7)
            fprintf(few, "%g %g\n", t, ref_high[i] + gsl_ran_gaussian(r, 0.15));
    }
    fclose(noise);
    fclose(offset);
    fclose(few);
    gsl_rng_free(r);
    ck_assert_int_eq(fvi("fit --p0 0.25 noise.tsv"), 1);
    ck_assert_ptr_nonnull(strstr(err, "fvi: warning: no motion is seen"));
    ck_assert_ptr_nonnull(strstr(out, "\n# flag = no motion is seen"));
    ck_assert_int_eq(fvi("fit --p0 0.25 -o o.tsv --curve o2.tsv noise.tsv"), 1);
    ck_assert_ptr_nonnull(strstr(err, "fvi: warning: no motion is seen"));
    ck_assert(!exists("o.tsv") && !exists("o2.tsv"));
    fvi("fit --p0 0.25 offset.tsv");
    ck_assert_ptr_nonnull(strstr(err, "the residuals have a mean"));
    ck_assert_ptr_nonnull(strstr(out, "\n# flag = the residuals have a mean"));
    ck_assert_int_eq(fvi("fit --p0 0.25 --fit alpha,rho,offset offset.tsv"), 0);
    double row[4];
    row_of("offset", row);
    ck_assert(row[2] < 0.01 && 0.01 < row[3]);
    row_of("alpha", row);
    ck_assert(row[2] < 0.3 && 0.3 < row[3]);
    fvi("fit --p0 0.25 --fit alpha,rho,c few.tsv");
    row_of("alpha", row);
    ck_assert(row[2] >= 0 && row[3] <= 1);
    row_of("rho", row);
    ck_assert(row[2] >= 0);
}
END_TEST

/* The numbers of a law, by their names; of one term and of a sum. The data are those of a run, so
 * that nothing is wrong with them but its step. */
START_TEST(fit_knows_the_numbers_of_a_law)
{
    double row[4];
    ck_assert_int_eq(fvi("run --damping zener:0.5,0.3,0.5 --force 'cos(t/2)+cos(3*t)' --x0 0 --method "
                         "fvi-lobatto4 --columns t,x -o z.tsv"),
                     0);
    ck_assert_int_eq(fvi("fit --damping zener:0.3,0.4,1 --force 'cos(t/2)+cos(3*t)' --x0 0 --starts 6 "
                         "z.tsv"),
                     0);
    static const char *const names[] = { "d1.rho", "d1.alpha", "d1.time" };
    static const double truth[] = { 0.5, 0.3, 0.5 };
    for (size_t j = 0; j < LEN(names); j++) {
        row_of(names[j], row);
        ck_assert_double_eq_tol(row[0], truth[j], 1e-6);
    }
    ck_assert_int_eq(fvi("fit --damping 'spring:0.5 + zener:0.5,0.3,0.5' --potential harmonic:0.7 "
                         "--force 'cos(t/2)+cos(3*t)' --x0 0 --fit d1.spring1.k,d1.zener2.alpha --starts 4 "
                         "z.tsv"),
                     0);
    row_of("d1.spring1.k", row);
    ck_assert_double_eq_tol(row[0], 0.3, 1e-6);
    row_of("d1.zener2.alpha", row);
    ck_assert_double_eq_tol(row[0], 0.3, 1e-6);
    ck_assert_int_eq(fvi("fit --damping zener:0.3,0.4,1 --fit alpha z.tsv"), 2);
    ck_assert_ptr_nonnull(strstr(err, "'alpha': with --damping the numbers are those of the law, "
                                      "d1.rho"));
    ck_assert_int_eq(fvi("fit --damping zener:0.3,0.4,1 --fit d1.end z.tsv"), 2);
}
END_TEST

/* The curve: residual = data - fit, and chi2 is what it says. The data are those of the
 * file; a step that is given is taken. */
START_TEST(fit_writes_the_curve)
{
    char text[1 << 16], path[PATH_MAX + 100];
    double t, data, fit, residual, sum = 0;
    size_t rows = 0;
    write_data("d.tsv", 0.02, 1);
    ck_assert_int_eq(fvi("fit --p0 0.25 --sigma 0.02 --starts 4 --h 0.1 "
                         "--curve c.tsv d.tsv"),
                     0);
    const double chi2 = value_of("chi2");
    ck_assert_double_eq_tol(value_of("step"), 0.1, 1e-12);
    snprintf(path, sizeof path, "%s/c.tsv", folder);
    read_file(path, text, sizeof text);
    ck_assert(strncmp(text, "# t\tdata\tfit\tresidual\n", 22) == 0);
    for (char *at = strchr(text, '\n') + 1; *at; at = strchr(at, '\n') + 1) {
        ck_assert_int_eq(
            sscanf(at, "%lf %lf %lf %lf", &t, &data, &fit, &residual), 4);
        ck_assert_double_eq_tol(residual, data - fit, 1e-15);
        ck_assert_double_eq_tol(t, 0.1 * (double)++rows, 1e-12);
        sum += residual * residual;
    }
    ck_assert_uint_eq(rows, REF_POINTS);
    ck_assert_double_eq_tol(sum / (0.02 * 0.02), chi2, 1e-9 * chi2);
}
END_TEST

/* One motion as tables of other people: the same estimate, to the last digit. */
START_TEST(fit_reads_tables_of_many_kinds)
{
    const char *const shapes[] = {
        "cat d.tsv",
        "grep -v '#' d.tsv",
        "grep -v '#' d.tsv | tr '\\t' ','",
        "sed 's/# t.*/t,x/;s/^#.*//' d.tsv | tr '\\t' ' '",
        "awk '/^#/{next} {print \"# note\"; print}' d.tsv",
        "echo 'x v t'; awk '!/^#/{print $2, 7, $1}' d.tsv",
        "awk '{print $0 \"\\r\"}' d.tsv",
        "echo '# t in s, x in m'; awk '!/^#/{print $1, $2, 7, 8}' d.tsv",
        "echo '# x q t'; echo '# t in s, x in m'; awk '!/^#/{print $2, 7, $1}' "
        "d.tsv",
        "printf '\\357\\273\\277'; grep -v '#' d.tsv",
        "printf '\\357\\273\\277t,v,x\\n'; awk '!/^#/{print $1 \",7,\" $2}' "
        "d.tsv",
        "echo ',x,t'; awk '!/^#/{print NR \",\" $2 \",\" $1}' d.tsv",
        "echo 'info t x'; awk '!/^#/{print 7, $1, $2}' d.tsv"
    };
    double first[4], row[4];
    write_data("d.tsv", 0.02, 1);
    for (size_t i = 0; i < LEN(shapes); i++) {
        char line[300];
        snprintf(line, sizeof line,
                 "( %s ) > e.tsv; \"$FVI\" fit --starts 2 --h 0.1 --alpha 0.3 "
                 "--rho 0.4 --p0 0.25 --fit alpha e.tsv",
                 shapes[i]);
        ck_assert_msg(shell(line) == 0, "%s: %s", shapes[i], err);
        row_of("alpha", i ? row : first);
        ck_assert_msg(i == 0 || row[0] == first[0], "%s", shapes[i]);
    }
}
END_TEST

/* A chi^2 that is out of range, and starts that do not agree, end with 1; the answer is
 * shown, but no file is written. */
START_TEST(fit_says_what_is_not_to_be_believed)
{
    write_data("d.tsv", 0.02, 1);
    ck_assert_int_eq(fvi("fit --p0 0.25 --starts 3 --sigma 0.002 d.tsv"), 1);
    ck_assert(strstr(err, "chi2") && strstr(out, "\nalpha\t"));
    ck_assert_int_eq(
        fvi("fit --p0 0.25 --starts 3 --sigma 0.002 -o o.tsv --curve "
            "o2.tsv d.tsv"),
        1);
    ck_assert_str_eq(out, "");
    ck_assert(!exists("o.tsv") && !exists("o2.tsv"));
    ck_assert_int_eq(
        fvi("fit --p0 0.25 --starts 4 --potential harmonic:1.1 d.tsv"), 1);
    ck_assert(strstr(out, "# flag = neighbouring residuals are alike"));
    ck_assert(strstr(err, "fvi: warning: neighbouring residuals are alike"));
    ck_assert_int_eq(fvi("fit --fit mass,rho,c,p0 --starts 2 d.tsv"), 1);
    ck_assert(strstr(err, "do not determine mass,rho,c,p0"));
    ck_assert_ptr_nonnull(strstr(err, "known but for a common factor"));
    ck_assert_str_eq(out, "");
    FILE *f = file_in_folder("rest.tsv");
    for (int i = 0; i < 9; i++)
        fprintf(f, "%d 1\n", i);
    fclose(f);
    ck_assert_int_eq(fvi("fit --potential free --p0 0 rest.tsv"), 1);
    ck_assert_str_eq(err,
                     "fvi: these data do not determine alpha,rho together\n");
    ck_assert_int_eq(fvi("fit --potential free --p0 0 --fit alpha rest.tsv"),
                     1);
    ck_assert_str_eq(err, "fvi: these data do not determine alpha\n");
}
END_TEST

/* Names of --let, in the potential and in the force. The data are those of a run, so that
 * nothing is wrong with them but the error of the method, below 1e-8 here. */
START_TEST(fit_knows_the_names_of_let)
{
    const char *const names[] = { "alpha", "rho", "k", "A" };
    const double truth[] = { 0.3, 0.4, 1.5, 0.4 };
    ck_assert_int_eq(
        shell("\"$FVI\" run --method fvi-lobatto4 --alpha 0.3 --rho 0.4 "
              "--potential 'k*x^2/2' --let k=1.5,A=0.4 --force 'A*cos(2*t)' "
              "--columns t,x > r.tsv; \"$FVI\" fit --potential 'k*x^2/2' --let "
              "k=1,A=1 --force 'A*cos(2*t)' --fit alpha,rho,k,A --starts 4 "
              "r.tsv"),
        0);
    for (size_t j = 0; j < LEN(names); j++) {
        double row[4];
        row_of(names[j], row);
        ck_assert_double_eq_tol(row[0], truth[j], 1e-7);
    }
}
END_TEST

/* "arguments", what the line on standard error must say. */
static const char *const refused[][2] = {
    { "fit", "DATA" },
    { "fit d.tsv d.tsv", "not expected here" },
    { "fit none.tsv", "cannot read 'none.tsv'" },
    { "fit --fit beta d.tsv", "'beta'" },
    { "fit --fit alpha,alpha d.tsv", "twice" },
    { "fit --fit '' d.tsv", "''" },
    { "fit --fit alpha, d.tsv", "''" },
    { "fit --fit g d.tsv", "'g'" },
    { "fit --potential pendulum:1 --fit c d.tsv", "'c'" },
    { "fit --potential free --fit c d.tsv", "'c'" },
    { "fit --potential 'k*x^2+q*x^4' --let k=1,q=k --fit rho,k d.tsv",
      "--fit: another --let was made of 'k'" },
    { "fit --potential chain:2,1,0 d.tsv", "--potential: 'chain:2,1,0'" },
    { "fit --dimension 2 d.tsv", "--dimension: '2'" },
    { "fit --method lda d.tsv", "lda" },
    { "fit --sigma 0 d.tsv", "--sigma" },
    { "fit --sigma -1 d.tsv", "--sigma" },
    { "fit --sigma nan d.tsv", "--sigma" },
    { "fit --starts 1 d.tsv", "--starts" },
    { "fit --starts 2.5 d.tsv", "--starts" },
    { "fit --curve '' d.tsv", "--curve" },
    { "fit --curve a -o a d.tsv", "--curve: 'a' is the table's file, too" },
    { "fit --curve d.tsv d.tsv",
      "--curve: 'd.tsv' is the file of the data, too" },
    { "fit -o d.tsv d.tsv", "-o: 'd.tsv' is the file of the data, too" },
    { "fit --sigma 1 --sigma 2 d.tsv", "twice" },
    { "fit --steps 5 d.tsv", "--steps" },
    { "fit --time=5 d.tsv", "--time" },
    { "fit --curv c.tsv d.tsv",
      "--curv: no such option; did you mean --curve?" },
    { "fit d.tsv --apha=1", "--apha=1: no such option; did you mean --alpha?" },
    { "fit d.tsv --h", "--h: a value is missing" },
    { "fit --plot a.svg d.tsv", "--plot: not an option of this command" },
    { "fit --checkpoint c d.tsv", "--checkpoint: not an option" },
    { "fit --sigm 1 d.tsv", "no such option" },
    { "fit --law power d.tsv", "--law: goes with --moduli, --creep or --relaxation alone" },
    { "fit d.tsv --weights=relative", "--weights: goes with --moduli, --creep or" },
    { "fit --h 0 d.tsv", "--h" },
    { "fit --alpha 2 d.tsv", "--alpha" },
    { "fit d.tsv --sigma", "a value is missing" },
    { "fit word.tsv", "word.tsv:3" },
    { "fit back.tsv", "back.tsv:3:1: t does not increase" },
    { "fit short.tsv", "short.tsv:2" },
    { "fit early.tsv", "before 0" },
    { "fit empty.tsv", "no rows" },
    { "fit few.tsv", "not enough" }
};

static void write_text(const char *name, const char *text)
{
    FILE *f = file_in_folder(name);
    fputs(text, f);
    fclose(f);
}

START_TEST(fit_refuses_words_and_tables)
{
    write_data("d.tsv", 0.02, 1);
    write_text("word.tsv", "t x\n1 2\n2 two\n3 4\n");
    write_text("back.tsv", "1 2\n2 3\n2 4\n5 6\n");
    write_text("short.tsv", "1 2\n2\n3 4\n");
    write_text("early.tsv", "-1 2\n2 3\n3 4\n4 5\n");
    write_text("empty.tsv", "# t x\n");
    write_text("few.tsv", "1 2\n2 3\n");
    for (size_t i = 0; i < LEN(refused); i++) {
        ck_assert_msg(fvi(refused[i][0]) == 2, "%s: %s", refused[i][0], err);
        ck_assert_msg(strstr(err, refused[i][1]), "%s: %s", refused[i][0], err);
        ck_assert_msg(strncmp(err, "fvi: ", 5) == 0
                          && strstr(err, "fit --help"),
                      "%s: %s", refused[i][0], err);
        ck_assert_str_eq(out, "");
    }
}
END_TEST

/* What no person would write: the program ends by itself, and says why. */
START_TEST(fit_of_any_bytes_ends)
{
    static const char pieces[][12] = {
        "1",  "-3", "0.5", "1e308", "x", "t",    "\t",  " ",  "\n",
        "\n", ",",  "#",   "1e-9",  "7", "\n9 ", "nan", "\r", "\""
    };
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    size_t taken = 0;
    for (int k = 0; k < 60; k++) {
        FILE *f = file_in_folder("any.tsv");
        if (k % 2) /* a table of numbers, some of them wild */
            for (size_t i = 0, n = 3 + gsl_rng_uniform_int(r, 9); i < n; i++)
                fprintf(f, "%g %g\n", (double)i + gsl_rng_uniform(r),
                        gsl_ran_cauchy(r, 1) * (k % 5 ? 1 : 1e300));
        else
            for (size_t i = 0, n = gsl_rng_uniform_int(r, 60); i < n; i++)
                fputs(pieces[gsl_rng_uniform_int(r, LEN(pieces))], f);
        fclose(f);
        const int code = fvi("fit --starts 2 --h 0.5 any.tsv");
        ck_assert_msg(code >= 0 && code <= 2, "file %d: %d", k, code);
        ck_assert(code == 0 || err[0]);
        ck_assert(code != 2 || !out[0]);
        taken += code != 2;
    }
    ck_assert(taken > 10);
    gsl_rng_free(r);
}
END_TEST

START_TEST(fit_is_helped)
{
    const char *const ways[] = { "help fit", "fit --help", "fit -h",
                                 "fit --sigma 1 -h" };
    for (size_t i = 0; i < LEN(ways); i++) {
        ck_assert_int_eq(fvi(ways[i]), 0);
        ck_assert(strncmp(out, "usage: fvi fit", 14) == 0);
    }
    ck_assert_int_eq(fvi("help"), 0);
    ck_assert(strstr(out, "fvi fit"));
}
END_TEST

/* Equal steps cannot be as many as so late a time takes, and no start leads anywhere. */
START_TEST(a_fit_that_takes_too_many_equal_steps_says_how_many)
{
    static const char *const cases[][2] = {
        { "fit --method fvi-lobatto4",
          "no start gives a motion that can be computed; to t = 1000000000 "
          "steps as short as the gaps of the data take 2e+09 equal steps, and a "
          "fit makes 131072" },
        { "fit --method fvi",
          "steps as short as the gaps of the data take 2e+09 equal steps" },
        { "fit --method fvi-lobatto4 --h 0.1",
          "steps of that length take 1e+10 equal steps" }
    };
    char line[sizeof folder + 200];
    write_text("far.tsv", "0\t1\n0.5\t0.8\n1\t0.6\n2\t-0.3\n3\t-0.9\n"
                          "4\t-0.8\n1e9\t0.1\n");
    for (size_t i = 0; i < LEN(cases); i++) {
        snprintf(line, sizeof line, "%s %s/far.tsv", cases[i][0], folder);
        ck_assert_int_eq(fvi(line), 1);
        ck_assert_msg(strstr(err, cases[i][1]), "%s: %s", cases[i][0], err);
    }
    write_text("near.tsv", "0\t1\n1\t1\n2\t1\n3\t1\n"); /* few enough */
    snprintf(line, sizeof line, "fit --fit mass,rho,c %s/near.tsv", folder);
    ck_assert_int_eq(fvi(line), 1);
    ck_assert_ptr_null(strstr(err, "equal steps"));
}
END_TEST

/* With alpha near 0 a body swings on up to the last datum. */
START_TEST(a_fit_whose_motions_come_to_no_end_says_how_far_they_came)
{
    char line[sizeof folder + 200];
    write_text("far.tsv",
               "0\t1\n1\t0.6\n2\t-0.3\n3\t-0.9\n4\t-0.8\n1e9\t0.1\n");
    snprintf(line, sizeof line,
             "fit --method fvi-adaptive --alpha 0 --rho 1e-9 --most-steps 3000 "
             "%s/far.tsv",
             folder);
    ck_assert_int_eq(fvi(line), 1);
    ck_assert_str_eq(out, "");
    ck_assert_ptr_nonnull(strstr(err, "more than 3000 steps, and the last came "
                                      "to t = "));
    ck_assert_ptr_nonnull(strstr(err, "where the data go to t = 1000000000"));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("build/fvi fit");
    ADD_CASE(suite, "answers", fit_finds_what_another_program_put_in,
             fit_says_what_it_was_silent_of, fit_knows_the_numbers_of_a_law, fit_writes_the_curve,
             fit_reads_tables_of_many_kinds,
             fit_says_what_is_not_to_be_believed);
    ADD_CASE(suite, "words", fit_refuses_words_and_tables,
             fit_of_any_bytes_ends, fit_knows_the_names_of_let, fit_is_helped,
             a_fit_that_takes_too_many_equal_steps_says_how_many,
             a_fit_whose_motions_come_to_no_end_says_how_far_they_came);
    return run_suite_of_program(suite);
}
