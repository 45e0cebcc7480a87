/* tests/program/test_fvi_reductions.c -- Reductions of an expression over a run: its maximum, mean, peak and so on.
 * Run alone: make test-fvi_reductions */
#define _GNU_SOURCE
#include "two_storeys.h"

/* The prototype of test_fvi_columns.c: over all steps, whatever is printed. */
START_TEST(reductions_are_over_all_steps)
{
    static const double want[] = { -0.037478151188046864, 0.03968137041438314,
                                   0.01829478634096023,   0.03968137041438314,
                                   1.72,                  0.0397059164745,
                                   1.72475795,            1.829478634096023,
                                   10,                    0 };
    const char *list =
        "--columns drift=x2-x1 --reduce 'min(drift),max(drift),"
        "rms(x2-x1),absmax(drift),at(absmax(drift)),peak(drift),"
        "at(peak(drift)),rms(a2+sin(8*t)),last(t),low=first(drift)'";
    ck_assert_int_eq(fvi_two("run", list), 0);
    ck_assert_ptr_nonnull(strstr(
        out, "\n# min(drift)\tmax(drift)\trms(x2-x1)\tabsmax(drift)\t"
             "at(absmax(drift))\tpeak(drift)\tat(peak(drift))\t"
             "rms(a2+sin(8*t))\tlast(t)\tlow\n"));
    ck_assert_uint_eq(count_rows(), 1);
    for (size_t n = 0; n < LEN(want); n++)
        ck_assert_near(cell(0, n), want[n], n == 5 || n == 6 ? 2e-9 : 1e-12,
                       "%zu", n);
    ck_assert_int_eq(fvi("sweep --vary alpha=0.1:0.4:4 --potential "
                         "'50*x1^2+50*(x2-x1)^2' --dimension 2 --rho 5,0 --x0 0 "
                         "--p0 0 --force '-sin(8*t)' --method fvi-lobatto4 "
                         "--h 0.02 --steps 500 --reduce "
                         "'max(x2-x1),at(max(x2-x1))'"),
                     0);
    static const double map[][3] = { { 0.1, 0.04530119180495427, 1.76 },
                                     { 0.2, 0.043392998825372904, 1.74 },
                                     { 0.3, 0.03968137041438314, 1.72 },
                                     { 0.4, 0.03411831815808491, 1.7 } };
    for (size_t k = 0; k < 4; k++)
        for (size_t n = 0; n < 3; n++)
            ck_assert_near(cell(k, n), map[k][n], 1e-13, "%zu %zu", k, n);
}
END_TEST

/* mean and rms by trapezia: of t over [0, 2] they are 1 and, by trapezia of 0.5, sqrt(4/3 + 1/24).
 * The parabola through t (2 - t) is that itself. */
START_TEST(means_and_peaks_are_what_they_say)
{
    ck_assert_int_eq(
        fvi("run --potential free --force none --rho 0 --h 0.5 --steps 4 "
            "--reduce 'mean(t),rms(t),peak((t-0.9)*(2-t)),at(peak((t-0.9)*(2-t))),"
            "min(t),at(min(t)),peak(-t),at(first(t)),absmax(t-5),"
            "at(last(x))'"),
        0);
    const double want[] = { 1, sqrt(4. / 3 + 1. / 24), 1.8, 0, 0, 0, 2, 0, 5, 2 };
    for (size_t n = 0; n < LEN(want); n++)
        ck_assert_near(cell(0, n), want[n], 8 * U, "%zu", n);
    ck_assert_int_eq(fvi("run --potential free --rho 0 --h 0.5 --steps 4 "
                         "--reduce 'peak(t*(1.9-t)),at(peak(t*(1.9-t)))'"),
                     0);
    ck_assert_near(cell(0, 0), 0.95 * 0.95, 8 * U, "peak");
    ck_assert_near(cell(0, 1), 0.95, 8 * U, "its time");
}
END_TEST

/* Steps of a method of its own length are longer than rows: reductions take the rows, too. Against all rows of the
 * exact motion; without them the minimum was -0.51. */
START_TEST(reductions_of_long_steps_see_the_rows)
{
    double least = INFINITY, most = -INFINITY;
    ck_assert_int_eq(fvi("exact --alpha 0.3 --columns x"), 0);
    for (size_t k = 0; k < count_rows(); k++) {
        least = smaller(least, cell(k, 0));
        most = larger(most, cell(k, 0));
    }
    ck_assert_int_eq(fvi("run --alpha 0.3 --step-error 1e-8 --reduce 'min(x),max(x),peak(x)'"), 0);
    /* a step's own end may lie a little beyond the rows: h^2 a / 8 at most */
    ck_assert(cell(0, 0) <= least + 1e-7 && cell(0, 0) > least - 0.01 / 8);
    ck_assert(cell(0, 1) >= most - 1e-7 && cell(0, 1) < most + 1.2 * 0.01 / 8);
    ck_assert_near(cell(0, 2), 1.11445376, 1e-4, "the peak, by fvi-lobatto6 in steps of 0.01");
    ck_assert_int_eq(fvi("run --reduce 'max(1/(x-1))'"), 1);
    ck_assert_str_eq(err, "fvi: step 0: a value is no longer finite\n");
    ck_assert_int_eq(fvi("run --alpha 0.3 --reduce 'max(log(x))'"), 1); /* x < 0 at row 21 */
    ck_assert_str_eq(err, "fvi: step 21: a value is no longer finite\n");
    ck_assert_int_eq(fvi("run --alpha 0.3 --step-error 1e-8 --longest 0.1 --reduce "
                         "'peak(x),mean(x)'"), 0); /* many a step ends near a row */
    ck_assert_near(cell(0, 0), 1.11445376, 1e-4, "the peak");
}
END_TEST

/* With --error x(t) = cos t has them at its rows exactly. */
START_TEST(reductions_with_an_error_are_those_of_the_cosine)
{
    static const char *const methods[] = { "fvi-adaptive", "fvi-lobatto4", "fvi-bdf2" };
    for (size_t i = 0; i < LEN(methods); i++) {
        char line[300];
        snprintf(line, sizeof line,
                 "run --rho 0 --x0 1 --p0 0 --time 3 --steps 30 --error 1e-6 --method %s --reduce "
                 "'min(x),at(min(x)),last(x),max(v),max(a)'",
                 methods[i]);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_ptr_null(strstr(err, "warning"));
        ck_assert_uint_eq(count_rows(), 1);
        const double want[] = { cos(3), 3, cos(3), 0, -cos(3) };
        for (size_t n = 0; n < LEN(want); n++) /* the slope of a is not below that of x */
            ck_assert_near(cell(0, n), want[n], n < 3 ? 1e-6 : n == 3 ? 1e-6 : 1e-4, "%s %zu",
                           methods[i], n);
    }
}
END_TEST

/* A run that stops and goes on has the reductions of one that did not, to the bit, also where it is already at
 * its end, and on standard output. */
START_TEST(reductions_go_on_from_a_checkpoint)
{
    const char *same = "--alpha 0.3 --h 0.1 --reduce "
                       "'max(x),peak(x),at(peak(x)),rms(p),mean(x),min(a),last(work)'";
    char line[300], want[4096];
    snprintf(line, sizeof line, "run --steps 200 %s", same);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_int_lt(snprintf(want, sizeof want, "%s", out), (int)sizeof want);
    for (int to_file = 0; to_file < 2; to_file++) {
        static const char *const steps[] = { "57", "200", "200" };
        ck_assert_int_eq(shell("rm -f half"), 0);
        for (size_t i = 0; i < LEN(steps); i++) {
            snprintf(line, sizeof line, "run --steps %s %s --checkpoint half %s %s", steps[i], same,
                     i > 0 ? "--continue" : "", to_file ? "-o half.tsv" : "");
            ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        }
        if (to_file)
            ck_assert_int_eq(shell("cat half.tsv"), 0);
        ck_assert_str_eq(out, want);
    }
    ck_assert_int_eq(fvi("run --steps 300 --alpha 0.3 --h 0.1 --reduce 'max(x)' --checkpoint half "
                         "--continue"),
                     2);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --continue: half: a run with reduce = max(x),peak(x)"));
}
END_TEST

/* A damper between points is on one body what its own damping is, also through an impulse between two rows. */
START_TEST(the_work_of_an_impulse_on_a_mechanism_is_that_on_masses)
{
    static const char *const methods[] = { "fvi", "fvi-lobatto4", "fvi-lobatto4d", "fvi-adaptive" };
    char line[300];
    for (size_t i = 0; i < LEN(methods); i++) {
        double want[3];
        for (int damper = 0; damper < 2; damper++) {
            snprintf(line, sizeof line, "run --method %s %s --x0 1 --p0 0 --time 5 --steps 50 --every 25 "
                     "--force impulse:1,2.33 --columns x,work,balance", methods[i],
                     damper ? "--damper 'x : power:1,0.3'" : "--alpha 0.3 --rho 1");
            ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
            for (size_t c = 0; c < 3; c++)
                if (damper)
                    ck_assert_near(cell(2, c), want[c], 1e-6, "%s column %zu", methods[i], c);
                else
                    want[c] = cell(2, c);
        }
    }
}
END_TEST

/* To a wanted error all steps of the run that was found are reduced: the numbers are those of the run with this step, and
 * a sweep has them, too. */
START_TEST(all_steps_to_a_wanted_error_are_reduced)
{
    static const char *const runs[] = { "--alpha 0.2 --rho 0.5 --method fvi-lobatto3",
                                        "--alpha 0.2 --rho 0.5 --method fvi-stable",
                                        ("--lagrangian 'v^2/2-x^4/4' --x0 1 --v0 0.3 --damper 'x : power:0.3,0.3' "
                                         "--method fvi-lobatto4") },
                            *const reduced[] = { "max(x),last(x),mean(x),rms(x),at(max(x)),min(x*x)",
                                                 "absmax(a),peak(x),last(work),max(d1.force)" };
    char line[400];
    for (size_t i = 0; i < LEN(runs) * LEN(reduced); i++) {
        double found[6], h;
        const size_t count = i % 2 ? 4 : 6;
        snprintf(line, sizeof line, "run %s --time 5 --steps 10 --error 1e-4 --reduce '%s'", runs[i / 2], reduced[i % 2]);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_ptr_null(strstr(err, "warning"));
        ck_assert_int_eq(sscanf(strstr(out, "# step = "), "# step = %lg", &h), 1);
        for (size_t c = 0; c < count; c++)
            found[c] = cell(0, c);
        snprintf(line, sizeof line, "run %s --time 5 --steps %.0f --reduce '%s'", runs[i / 2], 5 / h, reduced[i % 2]);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        for (size_t c = 0; c < count; c++)
            ck_assert_near(found[c], cell(0, c), 1e-12 * (1 + fabs(found[c])), "%zu column %zu", i, c);
        snprintf(line, sizeof line, "sweep %s --time 5 --steps 10 --error 1e-4 --reduce '%s' --vary kappa=0.5,0.5", runs[i / 2],
                 reduced[i % 2]);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        for (size_t c = 0; c < count; c++)
            ck_assert_near(cell(1, c + 1), found[c], 0, "sweep %zu column %zu", i, c);
    }
}
END_TEST

/* Of fvi-adaptive its steps are reduced, and the rows that they pass over, in the order of their times. */
START_TEST(steps_of_any_length_are_reduced_with_the_rows_between)
{
    double few[3], many[3];
    ck_assert_int_eq(fvi("run --potential duffing:40,5 --alpha 0.2 --time 5 --steps 2 --error 1e-6 --reduce "
                         "'max(t),max(x),absmax(x-1)'"),
                     0);
    for (size_t c = 0; c < 3; c++)
        few[c] = cell(0, c);
    ck_assert_int_eq(fvi("run --potential duffing:40,5 --alpha 0.2 --time 5 --steps 5000 --error 1e-6 --reduce "
                         "'last(t),max(x),mean(x)'"),
                     0);
    for (size_t c = 0; c < 3; c++)
        many[c] = cell(0, c);
    ck_assert(few[0] == 5 && many[0] == 5);
    ck_assert_near(few[1], many[1], 0.05, "many steps between two rows");
    ck_assert(few[2] > 1.5);
    ck_assert_int_eq(fvi("run --potential duffing:40,5 --alpha 0.2 --time 5 --steps 5000 --step-error 1e-9 --reduce "
                         "'max(x),mean(x)'"),
                     0);
    ck_assert_near(many[1], cell(0, 0), 1e-6, "max");
    ck_assert_near(many[2], cell(0, 1), 1e-6, "mean");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: reductions");
    ADD_CASE(suite, "reductions", reductions_are_over_all_steps,
             reductions_go_on_from_a_checkpoint,
             reductions_with_an_error_are_those_of_the_cosine,
             reductions_of_long_steps_see_the_rows,
             means_and_peaks_are_what_they_say,
             the_work_of_an_impulse_on_a_mechanism_is_that_on_masses,
             all_steps_to_a_wanted_error_are_reduced, steps_of_any_length_are_reduced_with_the_rows_between);
    return run_suite_of_program(suite);
}
