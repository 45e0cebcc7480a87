/* tests/program/test_fvi_fit_words.c -- The command `fvi fit`: wrong words, wrong tables, and fits that do not
 * converge.
 * Run alone: make test-fvi_fit_words */
#define _GNU_SOURCE
#include "fit_tables.h"

/* "arguments", what the line on standard error must say. */
static const char *const refused[][2] = {
    { "fit", "DATA" },
    { "fit d.tsv none.tsv", "cannot read 'none.tsv'" },
    { "fit 'd.tsv : y0=1'", "'y0=1': of its own a record has x0=, p0= and force=" },
    { "fit 'd.tsv : x0=1 : x0=2'", "'x0=2': of its own a record has" },
    { "fit 'd.tsv : x0=one'", "DATA: x0: 'one'" },
    { "fit 'd.tsv : x0=1,2'", "DATA: x0: '1,2'" },
    { "fit 'd.tsv : force=sin(u)'", "'sin(u)'" },
    { "fit --compare x2 d.tsv", "--compare" },
    { "fit --compare x,x d.tsv", "--compare: 'x' stands twice" },
    { "fit --compare '' d.tsv", "--compare" },
    { "fit --compare x,v d.tsv", "d.tsv:3:12: a number is missing" },
    { "fit --potential chain:2,1,0 --compare x3 d.tsv", "--compare" },
    { "fit --compare x --sigma 1,2 d.tsv", "--sigma" },
    { "fit --compare x --fit offset.v d.tsv", "'offset.v'" },
    { "fit --fit x0_2 d.tsv", "'x0_2'" },
    { "fit --huber 0 d.tsv", "--huber" },
    { "fit --huber -1 d.tsv", "--huber" },
    { "fit --design --huber 1 --sigma 1", "--huber: not together with --design" },
    { "fit --design --compare x --sigma 1", "--compare: not together with --design" },
    { "fit --force file:short_force.tsv d.tsv", "ends at t = 5, the run at" },
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
    { "fit --h 1e-300 d.tsv", "fvi: --h: to t = " },
    { "fit 'd.tsv : x0='", "fvi: DATA: x0: ''" },
    { "fit --alpha 2 d.tsv", "--alpha" },
    { "fit d.tsv --sigma", "a value is missing" },
    { "fit word.tsv", "word.tsv:3" },
    { "fit back.tsv", "back.tsv:3:1: t does not increase" },
    { "fit short.tsv", "short.tsv:2" },
    { "fit early.tsv", "before 0" },
    { "fit empty.tsv", "no rows" },
    { "fit few.tsv", "not enough" },
    { "fit -few.tsv", "-few.tsv: no such option" },
    { "fit -- -few.tsv", "DATA: -few.tsv: 2 rows are not enough" },
    { "fit -- -h", "DATA: cannot read '-h'" },
    { "fit -- --design", "DATA: cannot read '--design'" }
};

START_TEST(fit_refuses_words_and_tables)
{
    write_data("d.tsv", 0.02, 1);
    write_file("short_force.tsv", "0 1\n5 1\n");
    write_file("word.tsv", "t x\n1 2\n2 two\n3 4\n");
    write_file("back.tsv", "1 2\n2 3\n2 4\n5 6\n");
    write_file("short.tsv", "1 2\n2\n3 4\n");
    write_file("early.tsv", "-1 2\n2 3\n3 4\n4 5\n");
    write_file("empty.tsv", "# t x\n");
    write_file("few.tsv", "1 2\n2 3\n");
    write_file("-few.tsv", "1 2\n2 3\n");
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
          "steps as short as the gaps of the data take 2e+09 equal steps" }
    };
    char line[sizeof folder + 200];
    write_file("far.tsv", "0\t1\n0.5\t0.8\n1\t0.6\n2\t-0.3\n3\t-0.9\n"
                          "4\t-0.8\n1e9\t0.1\n");
    for (size_t i = 0; i < LEN(cases); i++) {
        snprintf(line, sizeof line, "%s %s/far.tsv", cases[i][0], folder);
        ck_assert_int_eq(fvi(line), 1);
        ck_assert_msg(strstr(err, cases[i][1]), "%s: %s", cases[i][0], err);
    }
    snprintf(line, sizeof line, "fit --method fvi-lobatto4 --h 0.1 %s/far.tsv", folder);
    ck_assert_int_eq(fvi(line), 2);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --h: to t = 1000000000 steps of that length take 1e+10 equal steps, and a fit makes "
                                      "131072; without --h fvi-adaptive chooses its own\n"));
    write_file("near.tsv", "0\t1\n1\t1\n2\t1\n3\t1\n"); /* few enough */
    snprintf(line, sizeof line, "fit --fit mass,rho,c %s/near.tsv", folder);
    ck_assert_int_eq(fvi(line), 1);
    ck_assert_ptr_null(strstr(err, "equal steps"));
}
END_TEST

/* With alpha near 0 a body swings on up to the last datum. */
START_TEST(a_fit_whose_motions_come_to_no_end_says_how_far_they_came)
{
    char line[sizeof folder + 200];
    write_file("far.tsv",
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
    Suite *suite = suite_create("build/fvi fit, words");
    ADD_CASE(suite, "words", fit_refuses_words_and_tables, fit_of_any_bytes_ends, fit_is_helped);
    ADD_CASE(suite, "no end", a_fit_that_takes_too_many_equal_steps_says_how_many,
             a_fit_whose_motions_come_to_no_end_says_how_far_they_came);
    return run_suite_of_program(suite);
}
