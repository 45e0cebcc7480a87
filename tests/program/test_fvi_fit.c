/* tests/program/test_fvi_fit.c -- The command `fvi fit`: from a file to an estimate.
 * Run alone: make test-fvi_fit */
#define _GNU_SOURCE
#include "fit_rows.h"
#include "fit_tables.h"

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
    ck_assert_ptr_nonnull(strstr(err, "\nfvi: the answer is not believed, and nothing is written into o.tsv and o2.tsv\n"));
    ck_assert_int_eq(fvi("fit --p0 0.25 --curve o2.tsv noise.tsv"), 1);
    ck_assert_ptr_nonnull(strstr(err, "\nfvi: the answer is not believed, and nothing is written into o2.tsv\n"));
    ck_assert_ptr_nonnull(strstr(out, "\nalpha\t"));
    ck_assert_int_eq(fvi("fit --p0 0.25 -o - noise.tsv"), 1); /* - is standard output */
    ck_assert_ptr_nonnull(strstr(out, "\nalpha\t"));
    ck_assert_ptr_null(strstr(err, "believed"));
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
    ck_assert_ptr_nonnull(strstr(err, "'alpha': with a law of damping the numbers are those of the law, "
                                      "d1.rho"));
    ck_assert_int_eq(fvi("fit --damping zener:0.3,0.4,1 --fit d1.end z.tsv"), 2);
    ck_assert_int_eq(fvi("run --method fvi-lobatto4 --damping havriliak:0.4,0.3,2,0.6 --time 20 --steps 100 --columns t,x "
                         "-o z.tsv"),
                     0);
    ck_assert_int_eq(fvi("fit --method fvi-lobatto4 --damping havriliak:0.3,0.3,2,0.4 --fit d1.rho,d1.beta --starts 4 z.tsv"),
                     0);
    row_of("d1.beta", row);
    ck_assert_double_eq_tol(row[0], 0.6, 1e-6);
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

int main(void)
{
    Suite *suite = suite_create("build/fvi fit");
    ADD_CASE(suite, "answers", fit_finds_what_another_program_put_in,
             fit_says_what_it_was_silent_of, fit_knows_the_numbers_of_a_law,
             fit_knows_the_names_of_let, fit_writes_the_curve, fit_reads_tables_of_many_kinds,
             fit_says_what_is_not_to_be_believed);
    return run_suite_of_program(suite);
}
