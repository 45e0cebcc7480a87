/* tests/program/test_fvi_warnings.c -- The program build/fvi: its warnings if an error or a step is too large.
 * Run alone: make test-fvi_warnings */
#define _GNU_SOURCE
#include "program.h"

/* The best that was reached is said; there are no rows that are not good enough. */
START_TEST(what_error_was_reached_is_said_if_not_the_one_asked_for)
{
    ck_assert_int_eq(
        fvi("run --error 1e-16 --method fvi-lobatto8d --alpha 0.3"), 1);
    ck_assert_str_eq(out, "");
    double best = 0, step = 0;
    ck_assert_int_eq(sscanf(err,
                            "fvi: --error: 1e-16 is out of reach; the smallest "
                            "estimate was %lg, with the step %lg\n",
                            &best, &step),
                     2);
    ck_assert(best > 1e-13 && best < 1e-12 && step > 1e-4);
    const char *advice = strchr(strchr(err, ';') + 1, ';');
    ck_assert_int_eq(
        sscanf(advice, "; by fvi-adaptive %lg, in %lg steps\n", &step, &best),
        2); /* which gets no nearer than rounding */
    ck_assert(step > 1e-16 && step < 1e-12);
    ck_assert_ptr_null(strstr(err, "try"));
    ck_assert_int_eq(fvi("run --error 1e-9 --time 2 --steps 4 --method fvi"),
                     1);
    ck_assert_ptr_nonnull(strstr(err, "; try --method fvi-adaptive\n"));
    ck_assert_int_eq(
        fvi("run --error 1e-9 --time 2 --steps 4 --method fvi-lobatto4"), 0);
    ck_assert_int_eq(
        fvi("run --error 1 --alpha 1 --rho 1e300 -o none --method fvi"), 1);
    ck_assert_str_eq(
        err, "fvi: --error: no step gives a result that can be trusted\n");
    ck_assert(!exists("none"));
    ck_assert_int_eq(
        fvi("run --error 1e-3 --rho 0 --potential '-sqrt(1.0000001 - x^2)' "
            "--x0 -0.4 --p0 -1 --force impulse:50,0.3"), /* not in step 1 */
        1);
    ck_assert_str_eq(
        err, "fvi: --error: no step gives a result that can be trusted\n");
    /* below all rounding, fvi-adaptive says what it can reach */
    static const char *const absurd[] = {
        "run --error 1e-30 --alpha 0.3 --steps 3",
        "run --error 1e-20 --alpha 0.99 --x0 0 --p0 0 --force cosine:1,1 "
        "--steps 3"
    };
    for (size_t i = 0; i < LEN(absurd); i++) {
        ck_assert_int_eq(fvi(absurd[i]), 1);
        ck_assert_msg(sscanf(err,
                             "fvi: --error: %*s is out of reach; the smallest "
                             "estimate was %lg, in %lg steps",
                             &best, &step)
                          == 2,
                      "%s", err);
        ck_assert(best < 1e-12 && step < 1e4);
    }
    ck_assert_int_eq(fvi("run --error 1 --steps 1e14"), 1);
    ck_assert_str_eq(err, "fvi: not enough memory\n");
    ck_assert_int_eq(
        fvi("run --error 0.1 --steps 20 --force step:1,1 --method fvi"), 0);
    ck_assert_int_eq(
        fvi("run --error 0.1 --steps 30 --force step:1,99 --method fvi"), 0);
}
END_TEST

/* The bound of H 14: R = rho h / m = 2 at alpha = kappa = 1/2. */
START_TEST(an_unstable_step_is_warned_of)
{
    ck_assert_int_eq(fvi("run --rho 1.99 --h 1 --steps 3"), 0);
    ck_assert_str_eq(err, "");
    ck_assert_int_eq(fvi("run --rho 2.02 --h 1 --steps 3"), 0);
    ck_assert_str_eq(
        err, "fvi: warning: this step is unstable (load 1.01, above 1); "
             "stable below h = 0.9901\n");
    ck_assert_uint_eq(count_rows(), 4);
    ck_assert_int_eq(fvi("run --rho 2.02 --h 1 --steps 3 --method lda"), 0);
    ck_assert_ptr_nonnull(strstr(err, "unstable"));
    ck_assert_int_eq(fvi("run --alpha 1 --rho 1.5 --h 1e-3 --steps 3"), 0);
    ck_assert_ptr_nonnull(strstr(err, "no step is stable"));
    /* the derivatives of such a run are no better, and two warnings are two */
    ck_assert_int_eq(fvi("gradient --rho 2.02 --h 1 --steps 3"), 0);
    ck_assert_str_eq(
        err, "fvi: warning: this step is unstable (load 1.01, above 1); "
             "stable below h = 0.9901\n");
    ck_assert_ptr_nonnull(strstr(out, "\n# warning = this step is unstable"));
    ck_assert_int_eq(fvi("run --rho 9 --h 9 --alpha 0.7 --steps 2 "
                         "--derivative rl --format json"),
                     0);
    ck_assert(strstr(out, "\"warning\": \"rl") && count_lines(err) == 2
              && strstr(out, "\"warning of the step\": \"this step"));
    /* alpha = 1/2: R < 1 for BDF2 weights, no bound for the shifted ones */
    ck_assert_int_eq(fvi("run --method fvi-bdf2 --rho 1.01 --h 1 --steps 3"),
                     0);
    ck_assert_ptr_nonnull(strstr(err, "stable below h = 0.9901"));
    ck_assert_int_eq(fvi("run --method fvi-bdf2 --rho 0.99 --h 1 --steps 3"),
                     0);
    ck_assert_str_eq(err, "");
    ck_assert_int_eq(fvi("run --method fvi-shifted --rho 9 --h 1 --steps 3"),
                     0);
    ck_assert_str_eq(err, "");
    /* alpha > 1/2: the shifted damping takes from the load of the spring */
    ck_assert_int_eq(fvi("run --method fvi-shifted --alpha 0.75 --rho 1 "
                         "--kappa 0 --h 2.1 --steps 3"),
                     0);
    ck_assert_str_eq(err, "");
    ck_assert_int_eq(fvi("run --method fvi-shifted --alpha 0.75 --rho 0 "
                         "--kappa 0 --h 2.1 --steps 3"),
                     0);
    ck_assert_ptr_nonnull(strstr(err, "stable below h = 2\n"));
    /* a long chain: the largest eigenvalue is 4 cos^2(pi/2002) */
    ck_assert_int_eq(fvi("run --potential chain:1000,1,0 --rho 0 --kappa 0 "
                         "--h 1.001 --steps 3"),
                     0);
    ck_assert_str_eq(
        err, "fvi: warning: this step is unstable (load 1.002, above 1); "
             "stable below h = 1\n");
    ck_assert_int_eq(fvi("run --potential chain:1000,1,0 --rho 0 --kappa 0 "
                         "--h 0.999 --steps 3"),
                     0);
    ck_assert_str_eq(err, "");
}
END_TEST

/* (14.8): h < rho / c while the motion swings, and none where nothing damps it; a spring
 * that hardens is met on the way. */
START_TEST(an_unstable_step_of_explicit_euler_is_warned_of)
{
    ck_assert_int_eq(fvi("run --method euler-explicit --h 0.199"), 0);
    ck_assert_str_eq(err, "");
    ck_assert_int_eq(fvi("run --method euler-explicit --h 0.25"), 0);
    ck_assert_str_eq(
        err, "fvi: warning: this step is unstable (load 1.25, above 1); "
             "stable below h = 0.2\n");
    ck_assert_int_eq(fvi("run --method euler-explicit --rho 0"), 0);
    ck_assert_str_eq(err,
                     "fvi: warning: this step is unstable (load inf, above 1); "
                     "no step is stable\n");
    ck_assert_int_eq(fvi("run --method euler-explicit --potential duffing:1,1 "
                         "--x0 0.1 --p0 1 --steps 20"),
                     0);
    ck_assert_ptr_nonnull(strstr(err, "run is at t = 0.6 (load 1.102, above"));
    ck_assert_uint_eq(count_lines(err), 1);
}
END_TEST

/* (17.16): for two stages no step is stable once rho is large and alpha small. */
START_TEST(an_unstable_step_with_stages_is_warned_of)
{
    ck_assert_int_eq(fvi("run --method fvi-lobatto2 --alpha 0.1 --rho 500 "
                         "--steps 30"),
                     0);
    double load = 0;
    ck_assert_int_eq(sscanf(err,
                            "fvi: warning: this step is unstable (load %lg, "
                            "above 1)\n",
                            &load),
                     1);
    ck_assert(load > 1 && count_lines(err) == 1);
    ck_assert(fabs(cell(30, 1)) > 1e9); /* and it is */
    for (int s = 2; s <= 4; s++) { /* h w < 2, 2 sqrt(2), 3.1127: (17.15) */
        const double bound[] = { 2, 2.8284, 3.1127 };
        for (int above = 0; above < 2; above++) {
            char line[200];
            snprintf(line, sizeof line,
                     "run --method fvi-lobatto%d --rho 0 --steps 3 --h %.4f", s,
                     bound[s - 2] + (above ? 0.001 : -0.001));
            ck_assert_int_eq(fvi(line), 0);
            ck_assert_uint_eq(count_lines(err), (size_t)above);
        }
    }
    ck_assert_int_eq(fvi("run --method fvi-lobatto4 --alpha 0.3"), 0);
    ck_assert_str_eq(err, "");
}
END_TEST

/* Duffing, h = 1/2: 1 + 3 x^2 passes 16, where two stages are no longer stable, on the way;
 * three are, and where nothing depends on the spring nothing is said. At the start it
 * is in the head, on the way only on standard error, and once. */
START_TEST(a_run_that_gets_stiffer_is_warned_of)
{
    const struct {
        const char *method;
        int warned;
    } runs[] = { { "fvi-lobatto2", 1 },
                 { "fvi --kappa 0", 1 },
                 { "fvi-shifted --kappa 1", 1 },
                 { "fvi-lobatto3", 0 },
                 { "fvi-lobatto2d", 0 },
                 { "fvi-stable", 0 },
                 { "fvi", 0 },
                 { "fvi-adaptive", 0 } };
    for (size_t i = 0; i < LEN(runs); i++) {
        char line[200];
        double at = 0, load = 0;
        snprintf(line, sizeof line,
                 "run --potential duffing:1,1 --x0 0.1 --p0 5 --h 0.5 "
                 "--steps 15 --rho 0.1 --method %s",
                 runs[i].method);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_int_eq(sscanf(err,
                                "fvi: warning: this step is unstable where the "
                                "run is at t = %lg (load %lg, above 1)\n",
                                &at, &load),
                         runs[i].warned ? 2 : -1);
        ck_assert_uint_eq(count_lines(err), (size_t)runs[i].warned);
        ck_assert(!runs[i].warned || (at == 0.5 && load > 1));
        ck_assert(!strstr(out, "# warning"));
    }
    ck_assert_int_eq(fvi("run --rho 2.02 --h 1 --steps 3"), 0);
    ck_assert_ptr_nonnull(
        strstr(out, "\n# warning = this step is unstable (load 1.01, above 1); "
                    "stable below h = 0.9901\n"));
    /* known from the start: no more is said on the way */
    ck_assert_int_eq(fvi("run --potential duffing:1,1 --x0 3 --p0 0 --h 0.5 "
                         "--steps 3 --method fvi-lobatto2"),
                     0);
    ck_assert_uint_eq(count_lines(err), 1);
    ck_assert_ptr_null(strstr(err, "where the run is"));
}
END_TEST

/* A sweep says of how many rows the inertia vanishes, and of which first, by its steps and to a wanted error. */
START_TEST(an_inertia_that_vanishes_is_warned_of_in_a_sweep)
{
    static const char said[] = "fvi: warning: rows of a Lagrangian whose inertia, its second derivatives by the "
                               "velocities, is nearly singular on the way, where a method may lose its order: ",
                      *const ways[] = { "--h 0.05 --method fvi-lobatto4", "--h 0.05",
                                          "--steps 20 --error 1e-2" };
    char line[300];
    for (size_t i = 0; i < LEN(ways); i++) { /* thrown up with p = v^3/3 from g: v is 0 at t = p/g */
        snprintf(line, sizeof line, "sweep --lagrangian 'v^4/12-g*x' --x0 0 --p0 0.3 --vary g=0.1,0.2,1 "
                 "--time 1 %s", ways[i]);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_msg(strncmp(err, said, strlen(said)) == 0, "%s: %s", line, err);
        ck_assert_str_eq(err + strlen(said), "1 of 3, the first with g = 1\n");
    }
    ck_assert_int_eq(fvi("sweep --lagrangian 'v^2/2-g*x' --x0 0 --p0 0.3 --vary g=0.1,1 --time 1"), 0);
    ck_assert_str_eq(err, "");
}
END_TEST

/* Said on standard error alone: rows, head and exit code are those that scripts have. A default is no wish, and who
 * asks for the direct sum of a method without a memory has it. */
START_TEST(a_memory_that_is_not_read_is_warned_of)
{
    static const char *const silent[] = {
        "run --method lda --memory direct", "run --method lda --memory auto", "run --memory direct",
        "run --method fvi-adaptive --memory exponentials", "run --alpha 0.3 --tolerance 1e-6",
        "run --damping zener:1,0.3,2 --tolerance 1e-6", "gradient --alpha 0.3 --tolerance 1e-6",
        "sweep --alpha 0.3 --vary tolerance=1e-3,1e-6",
        "run --damper 'x : zener:1,0.48,2' --damper 'x : zener:1,0.3,2' --tolerance 1e-6"
    };
    static const struct {
        const char *words, *said;
    } runs[] = {
        { "run --method lda --memory exponentials",
          "memory exponentials has no effect: lda keeps no memory of the past" },
        { "run --method euler-implicit --tolerance 1e-6",
          "tolerance 1e-06 has no effect: euler-implicit keeps no memory of the past" },
        { "run --memory direct --tolerance 1e-13",
          "tolerance 1e-13 has no effect: fvi sums the whole past directly here, with rounding errors alone" },
        { "run --step-error 1e-6 --tolerance 1e-6",
          "tolerance 1e-06 has no effect: fvi-adaptive keeps its memory to the error of its steps" },
        { "run --damper 'x : zener:1,0.48,2' --damper 'x : zener:2,0.48,2' --tolerance 1e-6",
          "tolerance 1e-06 has no effect: fvi sums the whole past directly here, because no law of the run has "
          "decaying modes" },
        { "sweep --vary tolerance=1e-3,1e-6 --memory direct",
          "tolerance 0.001 has no effect: fvi sums the whole past directly here, with rounding errors alone" },
        { "gradient --memory direct --tolerance 1e-6",
          "tolerance 1e-06 has no effect: fvi sums the whole past directly here, with rounding errors alone" },
        { "fit --design --fit rho --sigma 0.1 --method lda --memory exponentials",
          "memory exponentials has no effect: lda keeps no memory of the past" },
    };
    char line[300];
    for (size_t i = 0; i < LEN(silent); i++) {
        ck_assert_msg(fvi(silent[i]) == 0 && *err == '\0', "%s: %s", silent[i], err);
    }
    for (size_t i = 0; i < LEN(runs); i++) {
        ck_assert_msg(fvi(runs[i].words) == 0, "%s: %s", runs[i].words, err);
        snprintf(line, sizeof line, "fvi: warning: %s\n", runs[i].said);
        ck_assert_str_eq(err, line);
        ck_assert_ptr_null(strstr(out, "warning"));
    }
    ck_assert_int_eq(fvi("run --error 1e-3 --tolerance 1e-6 --steps 2"), 0);
    ck_assert_ptr_nonnull(strstr(err, " steps\nfvi: warning: tolerance 1e-06 has no effect: fvi-adaptive keeps"));
    ck_assert_int_eq(fvi("run --error 1e-3 --method fvi-bdf2 --tolerance 1e-6 --steps 2"), 0);
    ck_assert_uint_eq(count_lines(err), 1);
    ck_assert_int_eq(fvi("run --tolerance 2 --memory direct"), 2);
    ck_assert_uint_eq(count_lines(err), 2);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: what it warns of");
    ADD_CASE(suite, "warnings",
             what_error_was_reached_is_said_if_not_the_one_asked_for,
             an_unstable_step_is_warned_of,
             an_unstable_step_with_stages_is_warned_of,
             an_unstable_step_of_explicit_euler_is_warned_of,
             a_run_that_gets_stiffer_is_warned_of,
             an_inertia_that_vanishes_is_warned_of_in_a_sweep,
             a_memory_that_is_not_read_is_warned_of);
    return run_suite_of_program(suite);
}
