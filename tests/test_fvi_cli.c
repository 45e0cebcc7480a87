/* tests/test_fvi_cli.c -- The program build/fvi, run as a user would.
 * Run alone: make test-fvi_cli */
#define _GNU_SOURCE
#include "fvi.h"
#include "ulp.h"

#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

static char out[1 << 20], err[4096], folder[] = "/tmp/fvi-test-XXXXXX";

static void read_file(const char *name, char *text, size_t size)
{
    FILE *f = fopen(name, "r");
    size_t n = f ? fread(text, 1, size - 1, f) : 0;
    text[n] = '\0';
    if (f)
        fclose(f);
}

/* Run a shell command in the test's own folder; fill out and err. $FVI is the
 * program. */
static int shell(const char *command)
{
    char line[2000], name[100];
    snprintf(line, sizeof line, "cd %s && ( %s ) >out 2>err", folder, command);
    int status = system(line);
    snprintf(name, sizeof name, "%s/out", folder);
    read_file(name, out, sizeof out);
    snprintf(name, sizeof name, "%s/err", folder);
    read_file(name, err, sizeof err);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

static int fvi(const char *arguments)
{
    char line[1800];
    snprintf(line, sizeof line, "\"$FVI\" %s", arguments);
    return shell(line);
}

static int exists(const char *name)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return access(path, F_OK) == 0;
}

static size_t count_lines(const char *text)
{
    size_t n = 0;
    for (; *text; text++)
        n += *text == '\n';
    return n;
}

/* The first row of the table in out. */
static const char *first_row(void)
{
    const char *row = out;
    while (*row == '#')
        row = strchr(row, '\n') + 1;
    return row;
}

static size_t count_rows(void)
{
    return count_lines(first_row());
}

/* Column c of row k of the table in out. */
static double cell(size_t k, size_t c)
{
    const char *at = first_row();
    while (k-- > 0)
        at = strchr(at, '\n') + 1;
    while (c-- > 0)
        at = strchr(at, '\t') + 1;
    return strtod(at, NULL);
}

/* ---- what comes out ---- */

START_TEST(run_prints_head_and_rows)
{
    ck_assert_int_eq(fvi("run --steps 2 --h 0.5"), 0);
    ck_assert_str_eq(err, "");
    const char *head =
        "# method = fvi\n# alpha = 0.5\n# rho = 0.2\n# mass = 1\n"
        "# potential = harmonic:1\n# force = none\n"
        "# derivative = rl\n# kappa = 0.5\n# x0 = 1\n# p0 = 0.5\n"
        "# h = 0.5\n# steps = 2\n# columns = t,x,p,energy\n"
        "# every = 1\n# memory = auto\n# tolerance = 1e-13\n"
        "# t\tx\tp\tenergy\n0\t1\t0.5\t0.625\n0.5\t";
    ck_assert(strncmp(out, "# fvi ", 6) == 0);
    ck_assert_msg(strstr(out, head) == strchr(out, '\n') + 1, "%s", out);
    ck_assert_uint_eq(count_rows(), 3);
}
END_TEST

/* What is printed is the library's number to the last bit: %.17g is exact. */
START_TEST(rows_are_the_numbers_of_the_library)
{
    double m = 1.5, rho = 0.3, x0 = 0.7, p0 = -0.2, cg[2] = { 1, 0.5 },
           aw[2] = { 0.3, 2 };
    const fvi_system system = { 1, &m, &rho, fvi_potential_duffing(cg),
                                fvi_force_cosine(aw) };
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = 0.05,
                          .steps = 40,
                          .kappa = 0.25,
                          .alpha = 0.3,
                          .caputo = 1,
                          .memory = FVI_MEMORY_DIRECT };
    double x[41], p[41], energy[41];
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, p, energy),
                     GSL_SUCCESS);
    ck_assert_int_eq(
        fvi("run --alpha 0.3 --rho 0.3 --mass 1.5 --potential duffing:1,0.5 "
            "--force cosine:0.3,2 --derivative caputo --kappa 0.25 "
            "--x0 0.7 --p0 -0.2 --h 0.05 --steps 40 --memory direct "
            "--columns y,energy,p,x,t"),
        0);
    ck_assert_uint_eq(count_rows(), 41);
    for (size_t k = 0; k <= 40; k++) {
        ck_assert_ulp(cell(k, 0), x[40 - k], 0, "y, k=%zu", k);
        ck_assert_ulp(cell(k, 1), energy[k], 0, "energy, k=%zu", k);
        ck_assert_ulp(cell(k, 2), p[k], 0, "p, k=%zu", k);
        ck_assert_ulp(cell(k, 3), x[k], 0, "x, k=%zu", k);
        ck_assert_ulp(cell(k, 4), (double)k * 0.05, 0, "t, k=%zu", k);
    }
}
END_TEST

START_TEST(every_keeps_each_kth_row_and_the_last)
{
    ck_assert_int_eq(fvi("run --steps 10 --h 1 --every 4 --columns t,x,y"), 0);
    ck_assert_uint_eq(count_rows(), 4);
    const double t[4] = { 0, 4, 8, 10 };
    double x10 = cell(3, 1), x0 = cell(0, 1);
    for (size_t i = 0; i < 4; i++)
        ck_assert_ulp(cell(i, 0), t[i], 0, "row %zu", i);
    ck_assert_ulp(cell(0, 2), x10, 0, "y_0 = x_N");
    ck_assert_ulp(cell(3, 2), x0, 0, "y_N = x_0");
    double y4 = cell(1, 2); /* y_4 = x_6 */
    ck_assert_int_eq(fvi("run --steps 10 --h 1 --every 6 --columns x"), 0);
    ck_assert_ulp(y4, cell(1, 0), 0, "y_4 = x_6");
    ck_assert_int_eq(fvi("run --steps 3 --every 100 --columns t"), 0);
    ck_assert_uint_eq(count_rows(), 2);
}
END_TEST

START_TEST(a_chain_has_numbered_columns)
{
    ck_assert_int_eq(fvi("run --potential chain:3,1,0.1 --x0 1,2,3 --p0 0 "
                         "--steps 1 --columns x,t,p"),
                     0);
    ck_assert_ptr_nonnull(
        strstr(out, "# x1\tx2\tx3\tt\tp1\tp2\tp3\n1\t2\t3\t0\t0\t0\t0\n"));
}
END_TEST

/* One step at rest but for a kick: each parameter of the chain has its place. */
START_TEST(a_chain_moves_as_the_library_says)
{
    const double ones[] = { 1, 1, 1 }, none[] = { 0, 0, 0 },
                 x0[] = { 1, 2, -1 };
    const double p0[] = { 0.5, 0.5, 0.5 }, cg[] = { 1.25, 0.5 };
    const fvi_system chain = { 3, ones, none, fvi_potential_chain(cg), { 0 } };
    const fvi_run run = { .system = &chain,
                          .x0 = x0,
                          .p0 = p0,
                          .h = 0.1,
                          .steps = 5,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    double x[18];
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                     GSL_SUCCESS);
    ck_assert_int_eq(
        fvi("run --potential chain:3,1.25,0.5 --rho 0 --x0 1,2,-1 --steps 5 "
            "--columns x"),
        0);
    for (size_t k = 0; k <= 5; k++)
        for (size_t i = 0; i < 3; i++)
            ck_assert_ulp(cell(k, i), x[3 * k + i], 0, "k=%zu i=%zu", k, i);
}
END_TEST

START_TEST(coefficients_and_methods_and_help)
{
    ck_assert_int_eq(fvi("coefficients --alpha 0.5 --count 4"), 0);
    ck_assert_ptr_nonnull(strstr(out,
                                 "# alpha = 0.5\n# count = 4\n# n\talpha_n\n"
                                 "0\t1\n1\t-0.5\n2\t-0.125\n3\t-0.0625\n"));
    ck_assert_int_eq(fvi("coefficients --alpha 2 --count 5"), 0);
    ck_assert_ptr_nonnull(strstr(out, "0\t1\n1\t-2\n2\t1\n3\t0\n4\t0\n"));
    ck_assert_int_eq(fvi("methods"), 0);
    ck_assert_ptr_nonnull(strstr(out, "fvi\t1\tfull\nlda\t1\tnone\n"));
    ck_assert_ptr_nonnull(
        strstr(out, "\neuler-explicit\t1\tnone\neuler-implicit\t1\tnone\n"));
    ck_assert_int_eq(fvi("--help"), 0);
    ck_assert(strncmp(out, "usage: fvi run", 14) == 0);
    ck_assert_int_eq(fvi("run --help"), 0);
    ck_assert_ptr_nonnull(strstr(out, "--kappa"));
    ck_assert_int_eq(fvi("--version"), 0);
    ck_assert(strncmp(out, "fvi ", 4) == 0 && count_lines(out) == 1);
    ck_assert_str_eq(err, "");
}
END_TEST

START_TEST(a_repeated_option_is_fine_if_it_says_the_same)
{
    ck_assert_int_eq(fvi("run --steps 1 --alpha 0.3 --alpha 0.3 --alpha=0.3"),
                     0);
    ck_assert_int_eq(fvi("run --steps 1e0"), 0);
    ck_assert_uint_eq(count_rows(), 2);
}
END_TEST

START_TEST(the_decimal_point_is_a_point_everywhere)
{
    setenv("LC_ALL", "de_DE.UTF-8", 1);
    ck_assert_int_eq(fvi("run --steps 1 --h 0.5"), 0);
    ck_assert(cell(0, 2) == 0.5);
    unsetenv("LC_ALL");
}
END_TEST

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
        "run --columns t,q;run --columns T;run --memory best;"
        "run --tolerance 0;run --tolerance 1;run --tolerance nan;"
        "run --method rk4;run --method '';run --method lda --alpha 0.4;"
        "run --method euler-explicit --alpha 1;run --derivative both;"
        "run --potential harmonic;run --potential harmonic:;"
        "run --potential harmonic:1,2;run --potential harmonic:nan;"
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
        "run -o a -o b;run --o a";
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

    char line[200];
    snprintf(line, sizeof line, "%s -o kept", unstable);
    ck_assert_int_eq(fvi("run --steps 2 -o kept"), 0);
    ck_assert(exists("kept"));
    ck_assert_int_eq(fvi(line), 1);
    ck_assert_str_eq(out, "");
    char path[100], text[5000];
    snprintf(path, sizeof path, "%s/kept", folder);
    read_file(path, text, sizeof text);
    ck_assert_ptr_nonnull(
        strstr(text, "# steps = 2\n")); /* the old one stands */
}
END_TEST

/* In z = d/2 the equation of the first step is z^3 - 2 z + 2 = 0, for which
 * Newton's method from 0 goes 0, 1, 0, 1, ... for ever. */
START_TEST(no_convergence_is_reported_with_its_step)
{
    ck_assert_int_eq(fvi("run --potential duffing:-8,2 --x0 0 --p0 -2 --h 1"),
                     1);
    ck_assert_str_eq(err, "fvi: step 1: Newton's method did not converge\n");
    ck_assert_uint_eq(count_rows(), 1);
}
END_TEST

START_TEST(files_are_complete_or_absent)
{
    ck_assert_int_eq(fvi("run --steps 3"), 0);
    char *want = strdup(out);
    ck_assert_int_eq(fvi("run --steps 3 -o table"), 0);
    ck_assert_str_eq(out, "");
    ck_assert_int_eq(shell("cat table"), 0);
    ck_assert_str_eq(out, want);
    free(want);
    ck_assert_int_eq(fvi("run --steps 3 -o missing/table"), 1);
    ck_assert(!exists("missing/table"));
    ck_assert_int_eq(fvi("run --steps 3 -o ."), 1);
    ck_assert_int_eq(shell("ulimit -f 1; $FVI run --steps 5000 -o large"), 1);
    ck_assert(!exists("large"));
    ck_assert_int_eq(fvi("run -o /dev/full"), 1);
    ck_assert_int_eq(shell("$FVI run > /dev/full; test $? = 1"), 0);
    ck_assert_int_eq(shell("$FVI methods > /dev/full; test $? = 1"), 0);
    ck_assert_int_eq(shell("ls | grep '~'"), 1); /* no leftovers */
}
END_TEST

/* A run that is stopped leaves neither its file nor a temporary one. */
START_TEST(an_interrupted_run_leaves_no_file)
{
    ck_assert_int_eq(shell("$FVI run --steps 1e5 --alpha 0.3 --memory direct "
                           "-o gone & pid=$!; sleep 0.3; "
                           "kill $pid; wait $pid; test $? = 143"),
                     0);
    ck_assert(!exists("gone"));
    ck_assert_int_eq(shell("ls | grep '~'"), 1);
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
}
END_TEST

START_TEST(too_large_a_run_is_refused_before_it_starts)
{
    ck_assert_int_eq(fvi("run --steps 1e15 --alpha 0.3 --memory direct"), 1);
    ck_assert_str_eq(out, "");
    ck_assert_str_eq(err, "fvi: not enough memory\n");
    ck_assert_int_eq(fvi("run --steps 1e14 --columns y --rho 0"), 1);
    ck_assert_int_eq(fvi("coefficients --count 1e15"), 1);
}
END_TEST

/* The folder, and $FVI as an absolute path. */
static int prepare(void)
{
    const char *program = getenv("FVI");
    char *path = realpath(program ? program : "build/fvi", NULL);
    if (!path || !mkdtemp(folder))
        return -1;
    setenv("FVI", path, 1);
    free(path);
    return 0;
}

static int clean_up(void)
{
    char line[200];
    snprintf(line, sizeof line, "rm -rf '%s'", folder);
    return system(line);
}

int main(void)
{
    Suite *suite = suite_create("the program fvi");
    ADD_CASE(suite, "values", run_prints_head_and_rows,
             rows_are_the_numbers_of_the_library,
             every_keeps_each_kth_row_and_the_last,
             a_chain_has_numbered_columns, a_chain_moves_as_the_library_says,
             coefficients_and_methods_and_help,
             a_repeated_option_is_fine_if_it_says_the_same,
             the_decimal_point_is_a_point_everywhere);
    ADD_CASE(
        suite, "errors", bad_use_is_refused, overflow_is_reported_with_its_step,
        no_convergence_is_reported_with_its_step, files_are_complete_or_absent,
        an_interrupted_run_leaves_no_file, an_unstable_step_is_warned_of,
        too_large_a_run_is_refused_before_it_starts);
    if (prepare() != 0) {
        perror("build/fvi, or a folder for it");
        return 1;
    }
    int failed = run_suite(suite);
    return clean_up() != 0 || failed;
}
