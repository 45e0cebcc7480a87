/* tests/program/test_fvi_errors.c -- The program build/fvi: what it refuses, and what it
 * does when a run fails.
 * Run alone: make test-fvi_errors */
#define _GNU_SOURCE
#include "program.h"

/* ---- what is refused: exit 2, two lines, nothing on standard output ---- */

START_TEST(bad_use_is_refused)
{
    /* one command line after another, parted by semicolons */
    static char lines[] =
        ";walk;run walk;run -- x;--alpha 1;-x;run -x;run --bogus 1;"
        "run --alp 0.5;run --alpha;run --help=1;methods --alpha 0.5;"
        "run --count 3;coefficients --steps 3;coefficients --count 0;"
        "coefficients --alpha 2.1;run --alpha 1.5;run --alpha -0.1;"
        "run --alpha nan;run --alpha inf;run --alpha 0.5x;"
        "run --alpha 0,5;run --alpha '';run --alpha ' 0.5';"
        "run --alpha '0.5 ';run --alpha 0.5 --alpha 0.6;run --rho -1;"
        "run --rho nan;run --rho inf;run --mass 0;run --mass -1;"
        "run --kappa 1.01;run --kappa -0.01;run --kappa nan;run --h 0;"
        "run --h -0.1;run --h nan;run --h inf;run --h 1e999;"
        "run --steps 0;run --steps 2.5;run --steps -3;run --steps nan;"
        "run --steps 1e300;run --every 0;run --every 1.5;"
        "run --columns '';run --columns t,;run --columns t,t;"
        "run --columns t,q;run --columns tx;run --memory best;"
        "run --tolerance 0;run --tolerance 1;run --tolerance nan;"
        "run --method rk4;run --method '';run --method lda --alpha 0.4;"
        "run --method euler-explicit --alpha 1;run --derivative both;"
        "run --potential duffing;run --potential harmonic:;"
        "run --potential harmonic:1,2;run --potential harmonic:nan;run "
        "--potential harmonic:inf;"
        "run --potential duffing:1;run --potential duffing:1,,2;"
        "run --potential free:1;run --potential pendulum:1x;"
        "run --potential harmonics:1;run --potential chain:0,1,1;"
        "run --potential chain:2.5,1,1;run --potential chain:3,1;"
        "run --potential chain:-1,1,1;run --potential '';"
        "run --force step;run --force step:1;run --force step:1,-1;"
        "run --force cosine:1,2,3;run --force none:1;run --force '';"
        "run --x0 1,2;run --x0 '';run --x0 1,;run --x0 nan;"
        "run --p0 inf;run --potential chain:3,1,1 --x0 1,2;"
        "run --potential chain:3,1,1 --p0 1,2,3,4;run -o '';run -o;"
        "run -o a -o b;run --o a;exact --kappa 0.5;exact --potential "
        "pendulum:1;"
        "exact --potential harmonic:-1;exact --alpha 0.6 --derivative rl;"
        "run --time 0;run --time -1;run --time nan;run --time inf;"
        "run --time 1 --h 0.1;exact --time 1 --h 0.1;run --time 1e-320 --steps "
        "1e15;"
        "run --error 0;run --error -1;run --error nan;run --error inf;"
        "run --error 1e-3 --h 0.1;run --error 1e-3 --h 0.1 --time 1;"
        "exact --error 1e-3;run --error 1e-3 --method fvi --force "
        "step:1,1.05;"
        "run --error 1e-3 --method fvi --force step:1,1 --steps 7;"
        "run --error 1e-3 --kappa 1;run --error 1e-3 --memory direct;"
        "run --method fvi-lobatto3 --memory fft;run --method fvi-lobatto";
    for (char *line = lines, *end; line; line = end ? end + 1 : NULL) {
        if ((end = strchr(line, ';')))
            *end = '\0';
        int code = fvi(line);
        ck_assert_msg(code == 2, "fvi %s: exit code %d", line, code);
        ck_assert_msg(*out == '\0', "fvi %s printed %s", line, out);
        ck_assert_msg(count_lines(err) == 2 && strncmp(err, "fvi: ", 5) == 0
                          && strstr(strchr(err, '\n'), "--help"),
                      "fvi %s said: %s", line, err);
    }
    fvi("run --error 1e-3 --h 0.1");
    ck_assert(strncmp(err, "fvi: --h: not together with --error\n", 36) == 0);
    fvi("run --alpha 1.5");
    ck_assert(strncmp(err, "fvi: --alpha: '1.5' is outside [0, 1]\n", 38) == 0);
}
END_TEST

/* ---- what cannot be done: exit 1 ---- */

START_TEST(overflow_is_reported_with_its_step)
{
    const char *unstable =
        "run --alpha 1 --rho 1e300 --steps 20 --h 0.1 --memory direct";
    ck_assert_int_eq(fvi(unstable), 1);
    unsigned step = 0;
    const char *said = strstr(err, "fvi: step ");
    ck_assert_msg(
        said
            && sscanf(said, "fvi: step %u: a value is no longer finite", &step)
                   == 1,
        "%s", err);
    ck_assert_uint_eq(count_rows(), step); /* rows 0 ... step - 1 */

    /* nothing that is printed is infinite: it is the step itself that fails */
    ck_assert_int_eq(fvi("run --alpha 1 --rho 1e30 --steps 20 --columns t"), 1);
    said = strstr(err, "fvi: step ");
    ck_assert(said && sscanf(said, "fvi: step %u: a value", &step) == 1);
    ck_assert_uint_gt(step, 1);
    ck_assert_uint_eq(count_rows(), step);

    char line[200];
    snprintf(line, sizeof line, "%s -o kept", unstable);
    ck_assert_int_eq(fvi("run --steps 2 -o kept"), 0);
    ck_assert(exists("kept"));
    ck_assert_int_eq(fvi(line), 1);
    ck_assert_str_eq(out, "");
    char path[PATH_MAX + 100], text[5000];
    snprintf(path, sizeof path, "%s/kept", folder);
    read_file(path, text, sizeof text);
    ck_assert_ptr_nonnull(
        strstr(text, "# steps = 2\n")); /* the old one stands */
}
END_TEST

/* Whatever would be printed: an energy, a time, an exact solution. The rows before
 * it stand, and no row is made up. */
START_TEST(no_row_has_a_number_that_is_not_finite)
{
    static const struct {
        const char *line;
        unsigned step;
    } runs[] = {
        { "run --x0 1e200 --steps 3", 0 },
        { "run --p0 1e200 --steps 3 --columns energy,y", 0 },
        { "run --potential free --rho 0 --x0 0 --p0 0 --h 1e308 --steps 3", 2 },
        { "exact --x0 1e200 --steps 2", 0 },
        { "exact --mass 1e-310 --p0 0 --steps 2", 0 },
        { "exact --x0 1e-9 --p0 0 --h 1e308 --steps 3", 2 },
        { "exact --potential free --rho 0 --x0 0 --p0 0 --columns x --h 1 "
          "--force step:1e303,1e9 --steps 1100",
          424 } /* 424^2 10^303 is too large, x its half */,
    };
    for (size_t i = 0; i < LEN(runs); i++) {
        ck_assert_int_eq(fvi(runs[i].line), 1);
        unsigned step = 9999;
        const char *said = strstr(err, "fvi: step ");
        ck_assert_msg(said && sscanf(said, "fvi: step %u: a ", &step) == 1,
                      "%s: %s", runs[i].line, err);
        ck_assert_msg(step == runs[i].step, "%s: %s", runs[i].line, err);
        ck_assert_uint_eq(count_rows(), strstr(runs[i].line, "y") ? 0 : step);
    }
    ck_assert_int_eq(fvi("run --x0 1e200 --steps 3 --columns t,x,p"), 0);
    ck_assert_int_eq(fvi("run --h 1e-310 --steps 3"), 1);
    ck_assert_str_eq(err, "fvi: --h: mass / h is not a finite number\n");
    ck_assert_int_eq(fvi("run --potential harmonic:-400 --h 0.1"), 1);
    ck_assert_str_eq(err,
                     "fvi: step 1: the equation of the step is singular\n");
}
END_TEST

/* x is 0, 10^308, and then too large; nothing else is printed that could be. */
START_TEST(a_step_that_fails_is_reported_with_its_number)
{
    ck_assert_int_eq(fvi("run --potential free --rho 0 --x0 0 --p0 1e308 --h 1 "
                         "--steps 5 --columns t"),
                     1);
    ck_assert_ptr_nonnull(strstr(err, "fvi: step 2: "));
    ck_assert_uint_eq(count_rows(), 2);
}
END_TEST

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
    ck_assert_ptr_nonnull(strstr(err, "; try --method fvi-adaptive\n"));
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
    ck_assert_int_eq(fvi("run --error 1 --steps 1e14"), 1);
    ck_assert_str_eq(err, "fvi: not enough memory\n");
    ck_assert_int_eq(
        fvi("run --error 0.1 --steps 20 --force step:1,1 --method fvi"), 0);
    ck_assert_int_eq(
        fvi("run --error 0.1 --steps 30 --force step:1,99 --method fvi"), 0);
}
END_TEST

/* The bound of chapter 14: R = rho h / m = 2 at alpha = kappa = 1/2. */
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

/* sqrt(c/m) = 10^80: where the body is after so many swings depends on digits of m
 * that a double does not have. Where the swing has died away all is well. */
START_TEST(a_lost_phase_is_an_error)
{
    const char *said = "fvi: step 1: a phase of so many swings is not known\n";
    ck_assert_int_eq(fvi("exact --mass 1e-160 --rho 0"), 1);
    ck_assert_str_eq(err, said);
    ck_assert_int_eq(fvi("exact --mass 1e-160 --alpha 1 --rho 1e-100"), 1);
    ck_assert_str_eq(err, said);
    ck_assert_int_eq(fvi("exact --mass 1e-160 --alpha 1 --rho 1e-100 --p0 0 "
                         "--h 1e-50 --steps 1 --columns x"),
                     0);
    ck_assert_near(cell(1, 0), cos(1), 1e-13, "10^50 swings a second");
    ck_assert_int_eq(fvi("exact --mass 1e-160"), 0);
    ck_assert_int_eq(fvi("exact --mass 1e-160 --alpha 0.3 --p0 0"), 0);
    ck_assert_uint_eq(count_rows(), 201);
}
END_TEST

START_TEST(too_large_a_run_is_refused_before_it_starts)
{
    ck_assert_int_eq(fvi("run --steps 1e15 --alpha 0.3 --memory direct"), 1);
    ck_assert_str_eq(out, "");
    ck_assert_str_eq(err, "fvi: not enough memory\n");
    ck_assert_int_eq(fvi("run --steps 2e9 --alpha 0.3 --every 1e9"), 1);
    ck_assert_str_eq(err, "fvi: --steps: the compressed memory reaches back "
                          "10^9 steps at most\n");
    ck_assert_int_eq(fvi("run --tolerance 1e-16"), 2);
    ck_assert(
        strncmp(err, "fvi: --tolerance: '1e-16' is outside [1e-14, 1)", 47)
        == 0);
    ck_assert_int_eq(fvi("run --steps 1e14 --columns y --rho 0"), 1);
    ck_assert_int_eq(fvi("coefficients --count 1e15"), 1);
}
END_TEST

/* ---- what is not even compiled ---- */

static int compiles(const char *options)
{
    char line[1000];
    snprintf(line, sizeof line,
             "echo '#include \"memory/double_double.h\"' | "
             "${CC:-cc} -std=c11 %s -I\"$SOURCES\" -x c -fsyntax-only -",
             options);
    return shell(line) == 0;
}

/* The weights need their roundings as they are written. */
START_TEST(other_roundings_are_not_compiled)
{
    ck_assert(compiles("-O2"));
    ck_assert(!compiles("-ffast-math"));
    ck_assert_ptr_nonnull(strstr(err, "not with -ffast-math"));
    ck_assert(!compiles("-ffinite-math-only"));
    ck_assert(!compiles("-include float.h -U__FLT_EVAL_METHOD__ "
                        "-D__FLT_EVAL_METHOD__=2")); /* as the x87 says */
    ck_assert_ptr_nonnull(strstr(err, "computed as doubles"));
}
END_TEST

/* What FVI_VECTORS stands for, with these headers in the place of the library's. */
static int asks_the_loader(const char *header, const char *options)
{
    char line[1000];
    snprintf(line, sizeof line,
             "mkdir -p fake; for h in stddef stdint; do echo '%s' > "
             "fake/$h.h; done; printf '#include \"memory/memory_kinds.h\"\n"
             "FVI_VECTORS\n' | ${CC:-cc} -nostdinc -Ifake -D__x86_64__ %s "
             "-I\"$SOURCES\" -x c -E - | tail -n 1",
             header, options);
    ck_assert_int_eq(shell(line), 0);
    return strstr(out, "target_clones") != NULL;
}

/* musl's loader cannot choose, and under ThreadSanitizer none must. */
START_TEST(only_a_loader_that_can_is_asked_to_choose)
{
    const char *clang = "-U__has_feature '-D__has_feature(x)=1'";
    ck_assert(asks_the_loader("#define __GLIBC__ 2", ""));
    ck_assert(!asks_the_loader("", ""));
    ck_assert(!asks_the_loader("#define __GLIBC__ 2", "-fsanitize=thread"));
    ck_assert(!asks_the_loader("#define __GLIBC__ 2", clang));
}
END_TEST

int main(void)
{
    char *sources = realpath("src", NULL);
    setenv("SOURCES", sources ? sources : "src", 1);
    free(sources);

    Suite *suite = suite_create("the program fvi: what it refuses");
    ADD_CASE(suite, "errors", bad_use_is_refused,
             overflow_is_reported_with_its_step,
             no_row_has_a_number_that_is_not_finite,
             a_step_that_fails_is_reported_with_its_number,
             what_error_was_reached_is_said_if_not_the_one_asked_for,
             a_lost_phase_is_an_error, an_unstable_step_is_warned_of,
             an_unstable_step_with_stages_is_warned_of,
             a_run_that_gets_stiffer_is_warned_of,
             too_large_a_run_is_refused_before_it_starts,
             other_roundings_are_not_compiled,
             only_a_loader_that_can_is_asked_to_choose);
    return run_suite_of_program(suite);
}
