/* tests/program/test_fvi_adaptive.c -- The program build/fvi: `run --error`, with steps that the method chooses.
 * Run alone: make test-fvi_adaptive */
#define _GNU_SOURCE
#include "program.h"
#include "system/larger.h"

/* The largest difference of column 1 from that of `exact`, in the rows. */
static double off_by(const char *options)
{
    static double want[1000];
    char line[400];
    snprintf(line, sizeof line, "exact %s", options);
    ck_assert_int_eq(fvi(line), 0);
    const size_t rows = count_rows();
    for (size_t k = 0; k < rows; k++)
        want[k] = cell(k, 1);
    snprintf(line, sizeof line, "run --error 1e-9 %s", options);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_uint_eq(count_rows(), rows);
    double worst = 0;
    for (size_t k = 0; k < rows; k++)
        worst = larger(worst, fabs(cell(k, 1) - want[k]));
    return worst;
}

/* The wanted error, by the method that is taken where none is named, with a force that
 * jumps between two rows and with every past; the head and standard error say what was
 * done. Seen: 2e-4 of 1e-9. */
START_TEST(a_wanted_error_needs_no_other_word)
{
    static const char *const problems[] = {
        "--steps 7 --time 20 --alpha 0.75 --rho 1 --x0 0 --force step:8,0.731",
        "--steps 300 --time 20 --alpha 0.3 --derivative rl --force cosine:1,9",
        "--steps 3 --time 1000 --alpha 0.75 --derivative caputo --rho 1e4",
    };
    for (size_t i = 0; i < LEN(problems); i++) {
        ck_assert_near(off_by(problems[i]), 0, 1e-9, "%s", problems[i]);
        double estimate = 7, said = 8;
        unsigned steps = 0, of = 1;
        ck_assert_ptr_nonnull(strstr(out, "\n# method = fvi-adaptive\n"));
        const char *head = strstr(out, "\n# form = D, 8 stages\n");
        ck_assert(head
                  && sscanf(head,
                            "\n# form = D, 8 stages\n# steps taken = %u\n"
                            "# error estimate = %lg\n",
                            &steps, &estimate)
                         == 2);
        ck_assert_int_eq(
            sscanf(err,
                   "fvi: the error of x is at most about %lg, in %u "
                   "steps\n",
                   &said, &of),
            2);
        ck_assert(said == estimate && estimate <= 1e-9 && steps == of
                  && steps > 20 && count_lines(err) == 1);
    }
}
END_TEST

/* The decay rates of the memory are up to 2e4 / (1e-14 T), and 1e6 / (1e-14 T) for a law. At T = 1e-300 they are no
 * numbers, and the refusal says so; at T = 1e-287 they are. Half derivatives have no memory, but their derivative by
 * alpha has one. */
START_TEST(a_time_that_is_too_short_for_a_memory_is_refused_in_words)
{
    static const char *const dampings[] = { "--alpha 0.3", "--alpha 0.9", "--damping zener:1,0.3,2",
                                            "--damping distributed:1,0.2,0.4", "--damper 'x : power:1,0.3'",
                                            "--damper 'x : zener:1,0.3,2'" };
    static const char *const commands[] = { "run --error 1e-9", "run --step-error 1e-9", "gradient" };
    char line[200];
    for (size_t i = 0; i < LEN(dampings); i++) {
        for (size_t j = 0; j < LEN(commands); j++) {
            snprintf(line, sizeof line, "%s --method fvi-adaptive %s --time 1e-300", commands[j], dampings[i]);
            ck_assert_int_ne(fvi(line), 0);
            ck_assert_msg(strstr(err, "fvi: --time: 1e-300 is too short: the fastest decay rate of its memory would be "
                                      "above 1.8e308\n") == err,
                          "%s: %s", line, err);
        }
    }
    ck_assert_int_eq(fvi("run --error 1e-9 --method fvi-adaptive --alpha 0.3 --time 1e-287"), 0);
    ck_assert_int_eq(fvi("run --error 1e-9 --method fvi-adaptive --damping zener:1,0.3,2 --time 1e-287"), 0);
    ck_assert_int_eq(fvi("run --error 1e-9 --time 1e-300"), 0);
    ck_assert_int_eq(fvi("gradient --method fvi-adaptive --time 1e-300"), 1);
    ck_assert_str_eq(err, "fvi: the run is too short: the fastest decay rate of its memory would be above 1.8e308\n");
}
END_TEST

/* For orders up to 1 the weights are like 1e8 / T, and so are the decay rates. Their products are no numbers at T =
 * 1e-200, where the run had ended with a value that is not finite. */
START_TEST(a_time_that_is_too_short_for_the_weights_is_refused_in_words)
{
    ck_assert_int_eq(fvi("run --method fvi-adaptive --damping distributed:1,0,0.5 --time 1e-140 --steps 2"), 0);
    ck_assert_int_eq(fvi("run --method fvi-adaptive --damping distributed:1,0,0.5 --time 1e-200 --steps 2"), 2);
    ck_assert_ptr_eq(strstr(err, "fvi: --time: 1e-200 is too short: the weights of its memory, times their decay "
                                 "rates, would be above 1.8e308\n"), err);
}
END_TEST

/* Two masses on a chain: x and p of each row, whichever of them are columns. */
START_TEST(each_mass_has_its_momentum)
{
    const char *rest = "--potential chain:2,1,0 --x0 1,0.5 --p0 0.3,-0.4 "
                       "--alpha 0.3 --steps 4 --time 5 --error 1e-8 --columns";
    double found[5][4];
    char line[200];
    snprintf(line, sizeof line, "run %s p,x", rest);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert(cell(0, 0) == 0.3 && cell(0, 1) == -0.4);
    ck_assert(cell(0, 2) == 1 && cell(0, 3) == 0.5);
    for (size_t k = 0; k < 5; k++)
        for (size_t i = 0; i < 4; i++)
            found[k][i] = cell(k, i);
    snprintf(line, sizeof line,
             "run --method fvi-lobatto4 --potential chain:2,1,0 --x0 1,0.5 "
             "--p0 0.3,-0.4 --alpha 0.3 --h 0.0125 --steps 400 --every 100 "
             "--columns p,x");
    ck_assert_int_eq(fvi(line), 0);
    for (size_t k = 0; k < 5; k++)
        for (size_t i = 0; i < 4; i++)
            ck_assert_near(found[k][i], cell(k, i), 1e-6, "column %zu, row %zu",
                           i, k);
}
END_TEST

/* Rows where --h and --steps say, whatever the steps; the mirror of them too. */
START_TEST(rows_are_where_they_are_wanted)
{
    ck_assert_int_eq(fvi("run --method fvi-adaptive --h 0.01 --steps 1000 "
                         "--every 250 --columns t,x,y --alpha 0.3"),
                     0);
    ck_assert_uint_eq(count_rows(), 5);
    ck_assert_ptr_nonnull(strstr(out, "\n# form = D, 8 stages\n# t\t"));
    ck_assert_str_eq(err, "");
    double x[5];
    for (size_t k = 0; k < 5; k++) {
        ck_assert(cell(k, 0) == 2.5 * (double)k);
        x[k] = cell(k, 1);
    }
    for (size_t k = 0; k < 5; k++)
        ck_assert(cell(k, 2) == x[4 - k]);
    ck_assert_int_eq(fvi("run --method fvi-adaptive --h 2.5 --steps 4 "
                         "--alpha 0.3"),
                     0);
    for (size_t k = 0; k < 5; k++)
        ck_assert_near(cell(k, 1), x[k], 1e-9, "k=%zu", k);
    ck_assert_int_eq(fvi("run --method fvi-adaptive --rho 0 --steps 3"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# form = M, 8 stages\n"));
}
END_TEST

/* A table of a force has a kink at each of its rows: the steps end there. */
START_TEST(kinks_of_a_table_are_met)
{
    ck_assert_int_eq(shell("printf '0 0\n1.3 2\n1.7 -1\n30 0.5\n' > F"), 0);
    ck_assert_int_eq(fvi("run --error 1e-11 --force file:F --steps 20 "
                         "--alpha 0.3"),
                     0);
    const double x = cell(20, 1);
    ck_assert_int_eq(fvi("run --error 1e-12 --force file:F --steps 160 "
                         "--alpha 0.3"),
                     0);
    ck_assert_near(cell(160, 1), x, 1e-11, "x(20)");
}
END_TEST

/* What is out of reach is said, with how near it came; and nothing is printed. */
START_TEST(an_error_below_rounding_is_refused)
{
    double best = 0;
    unsigned steps = 0;
    ck_assert_int_eq(fvi("run --error 1e-17 --alpha 0.3"), 1);
    ck_assert_str_eq(out, "");
    ck_assert_int_eq(sscanf(err,
                            "fvi: --error: 1e-17 is out of reach; the smallest "
                            "estimate was %lg, in %u steps\n",
                            &best, &steps),
                     2);
    ck_assert(best > 1e-14 && best < 1e-12 && steps > 100
              && !strstr(err, "try"));
}
END_TEST

/* The tolerance of a step, without a search: the rows are those that --error's runs would
 * have, the method is fvi-adaptive, and a smaller number is more exact. Seen, of the
 * number: 0.016, 0.012 and 0.0034. */
START_TEST(a_step_has_a_tolerance)
{
    static const double wanted[] = { 1e-3, 1e-6, 1e-9 };
    static const char problem[] =
        "--steps 40 --h 0.5 --alpha 0.3 --columns t,x";
    static double want[41];
    char line[400];
    snprintf(line, sizeof line, "exact %s", problem);
    ck_assert_int_eq(fvi(line), 0);
    for (size_t k = 0; k <= 40; k++)
        want[k] = cell(k, 1);
    double last = 1;
    for (size_t i = 0; i < LEN(wanted); i++) {
        double off = 0;
        snprintf(line, sizeof line, "run --step-error %g %s", wanted[i],
                 problem);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_str_eq(err, "");
        ck_assert_ptr_nonnull(strstr(out, "\n# method = fvi-adaptive\n"));
        ck_assert_ptr_nonnull(strstr(out, "\n# step-error = "));
        ck_assert_uint_eq(count_rows(), 41);
        for (size_t k = 0; k <= 40; k++)
            off = larger(off, fabs(cell(k, 1) - want[k]));
        ck_assert_near(off, 0, 0.1 * wanted[i], "%g", wanted[i]);
        ck_assert_double_lt(off, last / 10);
        last = off;
    }
}
END_TEST

/* Methods whose steps are given have no such tolerance, nor has a search. */
START_TEST(a_tolerance_of_a_step_is_for_one_method)
{
    static const struct {
        const char *words, *reason;
    } bad[] = {
        { "--step-error 1e-6 --error 1e-6",
          "--step-error: not together with --error" },
        { "--step-error 1e-6 --method fvi-lobatto4",
          "--step-error: '1e-6' is not for fvi-lobatto4" },
        { "--step-error 1e-6 --method fvi", "is not for fvi, whose steps" },
        { "--step-error 0", "--step-error: '0' is outside (0, inf)" },
        { "--step-error nan", "--step-error: " },
        { "--step-error 1e-6x", "--step-error: " },
        { "--step-error 1e-18", "--step-error: 1e-18 is hidden by rounding; it must be at least 1e-17 of the size" },
        { "--step-error 1e-6 --damping power:1,0.7",
          "--p0: fvi-adaptive takes no velocity that jumps with a law that grows faster than s; fvi-bdf2 and fvi-stable do, and "
          "fvi-adaptive with --damper 'x : LAW' in place of --damping" },
    };
    char line[200];
    for (size_t i = 0; i < LEN(bad); i++) {
        snprintf(line, sizeof line, "run %s", bad[i].words);
        ck_assert_int_eq(fvi(line), 2);
        ck_assert_str_eq(out, "");
        ck_assert_msg(strstr(err, bad[i].reason), "%s: %s", line, err);
    }
    ck_assert_int_eq(fvi("run --step-error 1e-6 --damping zener:1,0.3,2"), 0);
    ck_assert_int_eq(fvi("run --step-error 1e-6 --damper 'x : power:1,0.7 + viscous:1'"), 0);
    ck_assert_int_eq(fvi("gradient --step-error 1e-6 --steps 3"), 0);
    ck_assert_int_eq(fvi("sweep --vary step-error=1e-8:1e-4:2:log --steps 3"),
                     0);
}
END_TEST

/* Where the force says nothing of itself between two times, the user may know: no step is
 * longer than that, by any method that --error is for. */
START_TEST(no_step_is_longer_than_the_longest)
{
    static const char *const runs[] = {
        "run --error 1e-6 --longest 0.004 --steps 5",
        "run --error 1e-6 --longest 0.004 --steps 5 --time 20 --method fvi-lobatto4",
        "run --longest 0.004 --steps 5 --time 20",
    };
    for (size_t i = 0; i < LEN(runs); i++) {
        ck_assert_int_eq(fvi(runs[i]), 0);
        ck_assert_ptr_nonnull(strstr(out, "\n# longest = 0.004\n"));
        unsigned steps = 0;
        double step = 1;
        const char *head = strstr(out, "\n# steps taken = "),
                   *own = strstr(out, "\n# step = ");
        ck_assert((head && sscanf(head, "\n# steps taken = %u", &steps) == 1
                   && steps >= 5000)
                  || (own && sscanf(own, "\n# step = %lg", &step) == 1
                      && step <= 0.004)
                  || i == 2);
        ck_assert(i < 2 || strstr(out, "\n# method = fvi-adaptive\n"));
    }
    ck_assert_int_eq(fvi("run --longest 0.1 --method fvi"), 2);
    ck_assert_ptr_nonnull(
        strstr(err, "--longest: '0.1' is not for fvi, whose steps are given"));
    ck_assert_int_eq(fvi("run --longest 0"), 2);
    ck_assert_ptr_nonnull(strstr(err, "--longest: '0' is outside (0, inf)"));
    ck_assert_int_eq(fvi("sweep --vary longest=0.1:1:2 --steps 3"), 0);
    ck_assert_int_eq(fvi("fit --longest 1 data"), 2);
}
END_TEST

/* Both kinds of steps meet a short pulse, whether it is typed or in a table. For the table, equal steps may refuse the
 * error instead, after 6 s. */
START_TEST(no_pulse_is_passed_over)
{
    static const char *const methods[] = { "fvi-adaptive", "fvi-lobatto4" };
    ck_assert_int_eq(shell("printf 't F\n0 0\n9.36 0\n9.37 1\n9.38 0\n20 "
                           "0\n' > P"),
                     0);
    for (size_t i = 0; i < LEN(methods); i++) {
        char line[200];
        double typed, tabled;
        snprintf(line, sizeof line,
                 "run --error 1e-6 --steps 4 --time 20 --x0 0 --p0 0 --method "
                 "%s --force 'exp(-((t-9.37)/0.01)^2)'",
                 methods[i]);
        ck_assert_int_eq(fvi(line), 0);
        typed = cell(4, 1);
        snprintf(line, sizeof line,
                 "run --error 1e-6 --steps 4 --time 20 --x0 0 --p0 0 --method "
                 "%s --force file:P",
                 methods[i]);
        ck_assert_double_gt(fabs(typed), 1e-3);
        if (fvi(line) == 1 && i == 1)
            continue; /* kinks between its nodes take its order away */
        tabled = cell(4, 1);
        ck_assert_near(typed, 1.7724538509055159 * tabled, 1e-5, "%s",
                       methods[i]);
    }
}
END_TEST

/* A force, or a spring, that takes more steps than anybody has time for; and what is long but
 * comes to its end. */
START_TEST(a_run_that_comes_to_no_end_says_how_far_it_came)
{
    static const char *const endless[] = {
        "run --method fvi-adaptive --force '1/(t-1.7)^2' --h 1 --steps 3",
        "run --method fvi-adaptive --potential duffing:1,1e20 --h 1 --steps 3 "
        "--most-steps 1000",
    };
    for (size_t i = 0; i < LEN(endless); i++) {
        ck_assert_int_eq(fvi(endless[i]), 1);
        double t = -1;
        unsigned long steps = 0, row = 0;
        ck_assert_int_eq(sscanf(err, "fvi: step %lu: t = %lf after %lu steps",
                                &row, &t, &steps),
                         3);
        ck_assert_uint_eq(row, i == 0 ? 2 : 1);
        ck_assert_uint_eq(count_rows(), row);
        ck_assert(i == 0 ? t > 1.6 && t < 1.7 : t > 0 && t < 1e-6);
        ck_assert(i == 0 ? steps < 2000000 : steps == 1000);
        ck_assert_ptr_nonnull(strstr(err, "--most-steps"));
    }
    ck_assert_int_eq(fvi("run --method fvi-adaptive --potential harmonic:1e10 "
                         "--mass 0.01 --rho 0 --h 1 --steps 1"),
                     0);
}
END_TEST

START_TEST(most_steps_are_for_steps_that_are_chosen)
{
    ck_assert_int_eq(fvi("run --most-steps 10"), 2);
    ck_assert_ptr_nonnull(strstr(err,
                                 "--most-steps: '10' is not for fvi, whose "
                                 "steps are given"));
    ck_assert_int_eq(fvi("run --method fvi-adaptive --most-steps 0"), 2);
    ck_assert_int_eq(fvi("run --error 1e-6 --most-steps 20"), 1);
    ck_assert_ptr_nonnull(strstr(err, "up to 20 steps"));
    ck_assert_int_eq(
        fvi("run --error 1e-9 --method fvi-bdf2 --most-steps 5000"), 1);
    ck_assert_ptr_nonnull(strstr(err, "is out of reach"));
    ck_assert_int_eq(fvi("run --error 1e-6 --most-steps 20000"), 0);
    static char rows[sizeof out];
    strcpy(rows, strstr(out, "# t\t"));
    ck_assert_int_eq(fvi("run --error 1e-6"), 0);
    ck_assert_str_eq(strstr(out, "# t\t"), rows);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: steps of its own");
    ADD_CASE(suite, "error", a_wanted_error_needs_no_other_word,
             each_mass_has_its_momentum, rows_are_where_they_are_wanted,
             kinks_of_a_table_are_met, an_error_below_rounding_is_refused);
    ADD_CASE(suite, "step-error", a_step_has_a_tolerance,
             a_tolerance_of_a_step_is_for_one_method);
    ADD_CASE(suite, "pulses", no_step_is_longer_than_the_longest,
             no_pulse_is_passed_over);
    ADD_CASE(suite, "most-steps",
             a_run_that_comes_to_no_end_says_how_far_it_came,
             most_steps_are_for_steps_that_are_chosen);
    ADD_CASE(suite, "time", a_time_that_is_too_short_for_a_memory_is_refused_in_words,
             a_time_that_is_too_short_for_the_weights_is_refused_in_words);
    return run_suite_of_program(suite);
}
