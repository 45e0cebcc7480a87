/* tests/program/test_fvi_errors.c -- The program build/fvi: command lines that it refuses, and runs that fail.
 * Run alone: make test-fvi_errors */
#define _GNU_SOURCE
#include "program.h"

/* ---- what is refused: exit 2, two lines, nothing on standard output ---- */

START_TEST(bad_use_is_refused)
{
    /* one command line after another, parted by semicolons */
    static char lines[] =
        ";walk;run walk;run -- x;gradient -- x;poles -- --count=1;run --system '';--alpha 1;-x;run -x;run --bogus 1;"
        "run --alp 0.5;run --alpha;run --help=1;methods --alpha 0.5;"
        "run --count 3;coefficients --steps 3;coefficients --count 0;"
        "coefficients --alpha 2.1;coefficients --count 9007199254740993;"
        "run --alpha 1.5;run --alpha -0.1;"
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
        "run --x0 0x10;run --alpha 0x1p-1;run --steps 0x10;run --h 0X1p-4;"
        "run --force step:0x1,2;run --potential harmonic:0x1;"
        "sweep --vary x0=0x1:2:2;sweep --vary x0=1:2:2 --jobs 0x1;"
        "run --p0 inf;run --potential chain:3,1,1 --x0 1,2;"
        "run --potential chain:3,1,1 --p0 1,2,3,4;run -o '';run -o;"
        "run -o a -o b;run --o a;exact --kappa 0.5;exact --potential "
        "pendulum:1;"
        "exact --potential harmonic:-1;exact --alpha 0.6 --derivative rl;"
        "run --time 0;run --time -1;run --time nan;run --time inf;"
        "run --time 1 --h 0.3;exact --time 1 --h 0.3;run --time 1 --h 0.1 "
        "--steps 11;run --time 1 --h 2;run --alpha 0.3 --order 0.6;"
        "run --order 2.5;run --order -1;exact --order 3;coefficients --order 5;"
        "run --order 0.6 --damping power:1,0.3;run --method lda --order 0.6;run --time 1e-320 --steps "
        "1e15;"
        "run --error 0;run --error -1;run --error nan;run --error inf;"
        "run --error 1e-3 --h 0.1;run --error 1e-3 --h 0.1 --time 1;"
        "exact --error 1e-3;run --error 1e-3 --method fvi --force "
        "step:1,1.05;"
        "run --error 1e-3 --method fvi --force step:1,1 --steps 7;"
        "run --error 1e-3 --kappa 1;run --error 1e-3 --memory direct;"
        "run --memory fft;run --method fvi-lobatto3 --memory fft;"
        "run --method fvi-lobatto";
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
    fvi("run -- --h 1"); /* -- ends the options */
    ck_assert_ptr_eq(strstr(err, "fvi: '--h': not expected here\n"), err);
    ck_assert_int_eq(fvi("run --steps 1 --"), 0);
}
END_TEST

/* The second line is that of the command, as far as there is one; and it is true. */
START_TEST(the_help_of_the_command_is_pointed_to)
{
    static const struct {
        const char *words, *help;
    } lines[] = { { "", "--help" },
                  { "walk", "--help" },
                  { "help walk", "--help" },
                  { "--version x", "--help" },
                  { "run x", "run --help" },
                  { "Run --alpha", "run --help" },
        { "run --checkpoint none --continue", "run --help" },
                  { "exact --alpha 2", "exact --help" },
                  { "coefficients --count 0", "coefficients --help" },
                  { "methods x", "methods --help" },
                  { "sweep", "sweep --help" },
                  { "sweep --vary alpha=0:2:3", "sweep --help" },
                  { "fit", "fit --help" },
                  { "gradient --of y", "gradient --help" } };
    for (size_t i = 0; i < LEN(lines); i++) {
        char want[60];
        ck_assert_int_eq(fvi(lines[i].words), 2);
        snprintf(want, sizeof want, "\nTry 'fvi %s'.\n", lines[i].help);
        const char *second = strchr(err, '\n');
        ck_assert_str_eq(second, want);
        ck_assert_int_eq(fvi(lines[i].help), 0);
        ck_assert_int_eq(strncmp(out, "usage: fvi ", 11), 0);
    }
}
END_TEST

/* A name that is none is told so, also where it has no value, or is the beginning of one. */
START_TEST(an_unknown_name_needs_no_value_to_be_refused)
{
    static const struct {
        const char *words, *said;
    } lines[] = {
        { "run --alph", "--alph: no such option; did you mean --alpha?" },
        { "run --steps 1 --x", "--x: no such option" },
        { "methods --alpha", "--alpha: not an option of this command" },
        { "methods -o", "-o: not an option of this command" },
        { "run --steps 1 --h", "--h: a value is missing" },
        { "run -o", "-o: a value is missing" },
        { "sweep --vary rho=0:1:2 -o", "-o: a value is missing" },
        { "sweep --vary rho=0:1:2 --mass", "--mass: a value is missing" },
        { "sweep --vary rho=0:1:2 --plot", "--plot: not an option of this "
                                           "command" }
    };
    for (size_t i = 0; i < LEN(lines); i++) {
        char want[100];
        ck_assert_int_eq(fvi(lines[i].words), 2);
        snprintf(want, sizeof want, "fvi: %s\n", lines[i].said);
        ck_assert_msg(strncmp(err, want, strlen(want)) == 0, "%s: %s",
                      lines[i].words, err);
    }
}
END_TEST

/* An option that follows where a value should stand was once the value, and no option: --snapshot --steps=3 made 200
 * steps and a file of that name. Behind =, or under ./, it is still a value. */
START_TEST(an_option_is_no_value_of_the_option_before)
{
    static const struct {
        const char *words, *said;
    } lines[] = {
        { "run --snapshot --steps=3", "--snapshot: a value is missing before '--steps=3'" },
        { "run --force --x0 1", "--force: a value is missing before '--x0'" },
        { "run --steps 3 --checkpoint -o out", "--checkpoint: a value is missing before '-o'" },
        { "poles -o --x0=0", "-o: a value is missing before '--x0=0'" },
        { "exact --let --mass 1", "--let: a value is missing before '--mass'" },
        { "coefficients --alpha --count 3", "--alpha: a value is missing before '--count'" },
        { "fit --curve --fit=alpha data", "--curve: a value is missing before '--fit=alpha'" },
        { "fit -o --fit alpha data", "-o: a value is missing before '--fit'" },
        { "fit data -o", "-o: a value is missing" },
        { "gradient --forces --steps 3", "--forces: a value is missing before '--steps'" },
        { "sweep --vary --steps 3", "--vary: a value is missing before '--steps'" },
        { "sweep --vary x0=1,2 --jobs -o out", "--jobs: a value is missing before '-o'" },
        { "sweep --vary x0=1,2 --columns --steps 3", "--columns: a value is missing before '--steps'" },
        { "sweep --vary --jobs 2", "--vary: a value is missing before '--jobs'" },
        { "sweep --vary x0=1,2 -o --lanes=1", "-o: a value is missing" },
        { "run --steps 3 --checkpoint --help", "--checkpoint: a value is missing before '--help'" },
        { "fit --curve --moduli data", "--curve: a value is missing before '--moduli'" },
        { "run --snapshot --step=3", "--snapshot: a value is missing before '--step=3'" }
    };
    for (size_t i = 0; i < LEN(lines); i++) {
        char want[100];
        ck_assert_int_eq(fvi(lines[i].words), 2);
        snprintf(want, sizeof want, "fvi: %s\n", lines[i].said);
        ck_assert_msg(strncmp(err, want, strlen(want)) == 0, "%s: %s", lines[i].words, err);
        ck_assert_str_eq(out, "");
    }
    ck_assert_int_eq(fvi("run --steps=3 --potential=--h --let h=1"), 0);
    ck_assert_int_eq(fvi("run --steps=3 --snapshot=--steps=3 -o--h && rm ./--steps=3 ./--h"), 0);
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
             "fake/$h.h; done; printf '#include \"memory/history_kinds.h\"\n"
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

/* A force that is infinite at t = 0 would start the methods that evaluate it just after 0 with a huge number. A force
 * with a limit there is none of these. */
START_TEST(a_force_that_is_infinite_at_first_is_refused)
{
    static const char *const bad[] = { "run --force '1/sqrt(t)' --method fvi-lobatto4", "run --force t^-0.5+1 --error 1e-3",
                                       "gradient --force 1/t --method fvi-stable" };
    for (size_t i = 0; i < LEN(bad); i++) {
        ck_assert_msg(fvi(bad[i]) == 2, "%s: %s", bad[i], err);
        ck_assert_msg(strncmp(err, "fvi: --force: '", 15) == 0 && strstr(err, "' is infinite at t = 0: fvi-"), "%s", err);
        ck_assert_str_eq(out, "");
    }
    ck_assert_int_eq(fvi("run --ground 'log(t)' --method fvi-bdf2"), 2);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --ground: 'log(t)' is infinite at t = 0: fvi-bdf2 "));
    ck_assert_int_eq(fvi("run --force 1/t --steps 2"), 0);
    ck_assert_int_eq(fvi("run --force 'sin(t)/t' --method fvi-lobatto4 --steps 2"), 0);
}
END_TEST

int main(void)
{
    char *sources = realpath("src", NULL);
    setenv("SOURCES", sources ? sources : "src", 1);
    free(sources);

    Suite *suite = suite_create("the program fvi: what it refuses");
    ADD_CASE(suite, "errors", a_force_that_is_infinite_at_first_is_refused, bad_use_is_refused,
             the_help_of_the_command_is_pointed_to,
             an_unknown_name_needs_no_value_to_be_refused,
             an_option_is_no_value_of_the_option_before,
             overflow_is_reported_with_its_step,
             no_row_has_a_number_that_is_not_finite,
             a_step_that_fails_is_reported_with_its_number,
             a_lost_phase_is_an_error,
             too_large_a_run_is_refused_before_it_starts,
             other_roundings_are_not_compiled,
             only_a_loader_that_can_is_asked_to_choose);
    return run_suite_of_program(suite);
}
