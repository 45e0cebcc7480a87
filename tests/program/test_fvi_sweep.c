/* tests/program/test_fvi_sweep.c -- The program build/fvi: a grid of runs.
 * Run alone: make test-fvi_sweep */
#define _GNU_SOURCE
#include "program.h"

/* Each row is the last one of a run with these values, the last axis the fastest. */
START_TEST(a_sweep_is_the_last_rows_of_its_runs)
{
    const double alpha[] = { 0, 0.25, 0.5, 0.75, 1 }, x0[] = { 1, 2 };
    double got[10][5];
    char line[200];
    ck_assert_int_eq(fvi("sweep --vary alpha=0:1:5 --vary x0=1:2:2 --steps 30 "
                         "--columns x,t,y"),
                     0);
    ck_assert_str_eq(err, "");
    ck_assert_uint_eq(count_rows(), 10);
    ck_assert_ptr_nonnull(strstr(out, "# columns = x,t,y\n# memory = auto\n"
                                      "# tolerance = 1e-13\n# vary = "
                                      "alpha=0:1:5,x0=1:2:2\n"
                                      "# alpha\tx0\tx\tt\ty\n0\t1\t"));
    ck_assert(!strstr(out, "# alpha =") && !strstr(out, "# x0 ="));
    for (size_t i = 0; i < 10; i++)
        for (size_t n = 0; n < 5; n++)
            got[i][n] = cell(i, n);
    for (size_t i = 0; i < 10; i++) {
        ck_assert(got[i][0] == alpha[i / 2] && got[i][1] == x0[i % 2]);
        snprintf(line, sizeof line,
                 "run --alpha %g --x0 %g --steps 30 --columns x,t,y",
                 alpha[i / 2], x0[i % 2]);
        ck_assert_int_eq(fvi(line), 0);
        for (size_t n = 0; n < 3; n++)
            ck_assert_ulp(cell(30, n), got[i][n + 2], 0, "%s", line);
    }
}
END_TEST

/* By a constant factor, over parameters of expressions, whole numbers, with --error. */
START_TEST(what_can_be_varied)
{
    ck_assert_int_eq(fvi("sweep --vary k=1:100:3:log --let c=2 --potential "
                         "'k*x^4/c' --steps 10"),
                     0);
    ck_assert(cell(0, 0) == 1 && fabs(cell(1, 0) - 10) < 1e-14
              && cell(2, 0) == 100);
    ck_assert_ptr_nonnull(strstr(out, "# let = c=2\n"));
    const double x = cell(2, 2);
    ck_assert_int_eq(fvi("run --potential '50*x^4' --steps 10"), 0);
    ck_assert_near(cell(10, 1), x, 1e-12, "50 is 100/2");
    ck_assert_int_eq(fvi("sweep --vary steps=10:30:3 --time 3 --columns t"), 0);
    ck_assert(cell(0, 1) == 3 && cell(2, 1) == 3 && !strstr(out, "# h ="));
    ck_assert_int_eq(fvi("sweep --vary error=1e-2:1e-7:2:log --alpha 0.3 "
                         "--method fvi-shifted --time 2 --steps 4 --columns x"),
                     0);
    ck_assert(cell(0, 1) != cell(1, 1));
    ck_assert_near(cell(0, 1), cell(1, 1), 1e-2 + 1e-7, "both are right");
    ck_assert_int_eq(
        fvi("sweep --vary rho=0.1:0.3:2 --dimension 2 --potential 'x1*x2' "
            "--steps 2 --columns x,energy --format csv"),
        0);
    ck_assert(strncmp(out, "rho,x1,x2,energy\n0.1,", 21) == 0);
    ck_assert_int_eq(fvi("sweep --vary x0=2:2:1 --steps 1 --columns t"), 0);
    ck_assert_uint_eq(count_rows(), 1);
}
END_TEST

/* The same bytes from one process and from seven; three parts make the whole. */
START_TEST(neither_jobs_nor_parts_change_a_row)
{
    const char *sweep =
        "sweep --vary alpha=0:1:11 --vary rho=0.1:2:7 --steps 300";
    char line[300];
    snprintf(line, sizeof line, "%s --jobs 1", sweep);
    ck_assert_int_eq(fvi(line), 0);
    char *want = strdup(out), *rows = strdup(first_row());
    snprintf(line, sizeof line, "%s --jobs=7", sweep);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_str_eq(out, want);
    snprintf(line, sizeof line,
             "for i in 1 2 3; do \"$FVI\" %s --part $i/3; done > parts; "
             "grep -v '^#' parts",
             sweep);
    ck_assert_int_eq(shell(line), 0);
    ck_assert_str_eq(out, rows);
    ck_assert_int_eq(shell("grep -c '# part = 2/3' parts"), 0);
    snprintf(line, sizeof line, "%s -o whole", sweep);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_int_eq(shell("cat whole"), 0);
    ck_assert_str_eq(out, want);
    free(want);
    free(rows);
}
END_TEST

/* Between decimal ends stand decimal points, also whole numbers and 0; where a point is no
 * short decimal number, it is that of the formula. */
START_TEST(points_between_decimal_ends_are_decimal)
{
    static const struct {
        const char *vary, *rows;
    } grids[] = {
        { "steps=20:160:4:log", "20\n40\n80\n160\n" },
        { "alpha=0:0.6:7", "0\n0.1\n0.2\n0.3\n0.4\n0.5\n0.6\n" },
        { "x0=-0.3:0.6:4", "-0.3\n0\n0.3\n0.6\n" },
        { "p0=-1:1:6", "-1\n-0.6\n-0.2\n0.2\n0.6\n1\n" },
        { "h=1e-6:1:7:log", "1e-06\n1e-05\n0.0001\n0.001\n0.01\n0.1\n1\n" },
        { "x0=-1000:-1:4:log", "-1000\n-100\n-10\n-1\n" },
        { "x0=0:1:4", "0\n0.3333333333333333\n0.6666666666666666\n1\n" },
        { "x0=1:2:3:log", "1\n1.4142135623730951\n2\n" },
        { "p0=1e-200:1e-180:3:log", "1e-200\n1e-190\n1e-180\n" },
        { "p0=1e-300:1e300:5:log", "1e-300\n1e-150\n1\n1e+150\n1e+300\n" },
        { "p0=1e300:1e-300:3:log", "1e+300\n1\n1e-300\n" },
        { "p0=-1e308:1e308:3", "-1e+308\n0\n1e+308\n" },
    };
    char line[200];
    for (size_t i = 0; i < LEN(grids); i++) {
        snprintf(line, sizeof line,
                 "\"$FVI\" sweep --vary %s %s --columns t | grep -v '#' | cut "
                 "-f1",
                 grids[i].vary, i == 0 ? "--time 1" : "--steps 1");
        ck_assert_int_eq(shell(line), 0);
        ck_assert_str_eq(out, grids[i].rows);
    }
}
END_TEST

/* More parts than rows: a script that asks for each of them gets each row once. */
START_TEST(a_part_may_have_no_rows)
{
    ck_assert_int_eq(shell("for i in 1 2 3 4 5; do \"$FVI\" sweep --vary "
                           "x0=1:2:2 --part $i/5 --format csv || exit 1; done "
                           "| grep -v x0 | cut -d, -f1"),
                     0);
    ck_assert_str_eq(out, "1\n2\n");
    ck_assert_int_eq(
        fvi("sweep --vary x0=1:2:2 --part 1/5 --columns t --format json"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\"rows\": [\n]}"));
}
END_TEST

/* Values one by one, in the order in which they are given. */
START_TEST(a_list_of_values_is_varied_as_it_stands)
{
    ck_assert_int_eq(fvi("sweep --vary alpha=0.4,0.1,0.25 --vary rho=2 "
                         "--columns x --steps 30"),
                     0);
    static const double alpha[] = { 0.4, 0.1, 0.25 };
    double x[3];
    for (size_t k = 0; k < 3; k++) {
        ck_assert(cell(k, 0) == alpha[k] && cell(k, 1) == 2);
        x[k] = cell(k, 2);
    }
    ck_assert_ptr_nonnull(strstr(out, "# vary = alpha=0.4,0.1,0.25,rho=2\n"));
    for (size_t k = 0; k < 3; k++) {
        char line[80];
        snprintf(line, sizeof line, "run --alpha %g --rho 2 --columns x --steps "
                 "30", alpha[k]);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert(cell(30, 0) == x[k]);
    }
}
END_TEST

START_TEST(values_of_a_file_are_varied)
{
    static const double rho[] = { 0.3, 2, 0.1 };
    ck_assert_int_eq(shell("printf '# rho\\n0.3 2\\n0.1\\n' > values; : > blank;"
                           "printf '1,x' > bad; echo 1 0 > zero"), 0);
    ck_assert_int_eq(fvi("sweep --vary rho=@values --columns x --steps 3"), 0);
    ck_assert_uint_eq(count_rows(), 3);
    for (size_t k = 0; k < 3; k++)
        ck_assert(cell(k, 0) == rho[k]);
    ck_assert_ptr_nonnull(strstr(out, "# vary = rho=@values\n"));
    ck_assert_int_eq(fvi("response --omega @values --format csv"), 0);
    ck_assert(strstr(out, "\n0.3,") && strstr(out, "\n2,") && strstr(out, "\n0.1,"));
    static char lines[sizeof out];
    strcpy(lines, out);
    ck_assert_int_eq(shell("cat values | $FVI response --omega @/dev/stdin --format csv"), 0);
    ck_assert_str_eq(out, lines); /* a pipe can be read only once */
    ck_assert_refused("response --omega @zero", "fvi: --omega: '0' is outside (0, inf)");
    ck_assert_refused("sweep --vary rho=@blank", "fvi: --vary: '@blank' has no numbers");
    ck_assert_refused("sweep --vary rho=@bad", "fvi: --vary: bad:1:3: not a finite decimal number");
    ck_assert_refused("sweep --vary rho=@void", "fvi: --vary: cannot read 'void': No such file or directory");
}
END_TEST

/* --rows: each run's table, behind its values; y mirrors its own run, whatever its length. */
START_TEST(all_rows_of_each_run_may_be_printed)
{
    ck_assert_int_eq(fvi("sweep --vary steps=10,5 --rows --every 4 --alpha 0.3 "
                         "--columns t,x,y,d1.work"),
                     0);
    double rows[7][4];
    ck_assert_uint_eq(count_rows(), 7);
    for (size_t k = 0; k < 7; k++)
        for (size_t n = 0; n < 4; n++)
            rows[k][n] = cell(k, 1 + n);
    ck_assert(cell(3, 0) == 10 && cell(4, 0) == 5);
    for (size_t i = 0, at = 0; i < 2; i++) {
        ck_assert_int_eq(fvi(i ? "run --steps 5 --every 4 --alpha 0.3 --columns "
                                 "t,x,y,d1.work"
                               : "run --steps 10 --every 4 --alpha 0.3 --columns "
                                 "t,x,y,d1.work"),
                         0);
        for (size_t k = 0; k < (i ? 3 : 4); k++, at++)
            for (size_t n = 0; n < 4; n++)
                ck_assert(cell(k, n) == rows[at][n]);
    }
    ck_assert_int_eq(fvi("sweep --vary alpha=0.3 --rows --error 1e-6 --time 2 "
                         "--steps 4 --columns t,x --jobs 1"),
                     0);
    ck_assert_uint_eq(count_rows(), 5);
    ck_assert_refused("sweep --vary alpha=0.3 --every 2",
                      "fvi: --every: without --rows a run has one row");
    ck_assert_int_eq(fvi("sweep --vary k=1,2 --lagrangian 'v^2/2-x^2' --constraint x-k --x0 1 "
                         "--v0 0 --steps 2 --columns x"),
                     1);
    ck_assert_str_eq(err, "fvi: with k = 2: --x0: it does not keep to the constraint 'x-k', "
                          "which is -1 there\n");
    ck_assert_refused("sweep --vary alpha=0.3 --rows --reduce 'max(x)'",
                      "fvi: --rows: not together with --reduce");
}
END_TEST

/* One command each: a section at every period of the force, a diagram over its size, and the response
 * spectrum of a ground. A rigid frame feels the ground's own peak, but for what its start, with the
 * slope 6, sets swinging, 6 T/2 pi; a soft one feels little. */
START_TEST(sections_diagrams_and_spectra_are_one_command)
{
    ck_assert_int_eq(fvi("run --potential 'x^4/4-x^2/2' --force '0.35*cos(2*pi*t/5)'"
                         " --alpha 0.3 --h 0.05 --steps 2000 --every 100 "
                         "--columns x,v"),
                     0);
    ck_assert_uint_eq(count_rows(), 21);
    const double x = cell(20, 0);
    ck_assert_int_eq(fvi("sweep --vary A=0.2,0.35 --rows --potential 'x^4/4-x^2/2' "
                         "--force 'A*cos(2*pi*t/5)' --alpha 0.3 --h 0.05 "
                         "--steps 2000 --every 100 --columns t,x"),
                     0);
    ck_assert_uint_eq(count_rows(), 42);
    ck_assert(cell(41, 0) == 0.35 && cell(41, 1) == 100 && cell(41, 2) == x);
    ck_assert_int_eq(fvi("sweep --vary T=0.02,1,400 --potential "
                         "'(2*pi/T)^2*x^2/2' --ground 'sin(6*t)*exp(-t)' --alpha "
                         "0.3 --rho 0.1 --x0 0 --p0 0 --method fvi-adaptive "
                         "--time 8 --steps 800 --reduce "
                         "'absmax(a+ag),absmax(x),absmax(ag)'"),
                     0);
    ck_assert_near(cell(0, 1), cell(0, 3), 1.1 * 6 * 0.02 / (2 * 3.14), "rigid");
    ck_assert(cell(1, 1) > 1.2 * cell(1, 3));
    ck_assert(cell(2, 1) < 0.2 * cell(2, 3));
}
END_TEST

START_TEST(bad_sweeps_are_refused)
{
    static char lines[] =
        "sweep;sweep --vary;sweep --vary alpha;sweep --vary alpha=0:1;"
        "sweep --vary alpha=0:1:0;sweep --vary alpha=0:1:2.5;"
        "sweep --vary alpha=0:1:1;sweep --vary alpha=0:x:3;"
        "sweep --vary alpha=0:1:3:lin;sweep --vary alpha=0:1:3:log;"
        "sweep --vary alpha=0:1:3:log:;sweep --vary rho=-1:1:3:log;"
        "sweep --vary alpha=0:1.5:4;sweep --vary =0:1:3;"
        "sweep --vary method=0:1:3;sweep --vary memory=0:1:3 --memory direct;"
        "sweep --vary x=0:1:3;sweep --vary alpha=0:1:3 --vary alpha=0:1:3;"
        "sweep --vary alpha=0:1:3 --alpha 0.5;sweep --vary steps=1:2:3;"
        "sweep --vary a=1:2:2 --vary b=1:2:2 --vary c=1:2:2 --vary d=1:2:2;"
        "sweep --vary alpha=0:1:1e9 --vary rho=0:1:1e9;"
        "sweep --vary alpha=0:1:3 --part 0/2;sweep --vary alpha=0:1:3 --part "
        "3/2;sweep --vary alpha=0:1:3 --part 1;"
        "sweep --vary alpha=0:1:3 "
        "--jobs 0;sweep --vary alpha=0:1:3 --jobs;sweep --vary alpha=0:1:3 "
        "walk;sweep --vary h=0.1:0.2:2 --time 0.5;sweep --vary k=1:2:2 "
        "--let k=3 --potential 'k*x';sweep --vray alpha=0:1:3;"
        "sweep --vary alpha=0:1:2 --alhpa 3;sweep --vary alhpa=0:1:2;"
        "sweep --vary k=1:2:2 --potential 'kk*x^2' --let kk=1;"
        "sweep --vary alpha=0:1:3 --every 7;sweep --vary alpha=0.1,;sweep --vary "
        "alpha=0.1,x;sweep --vary alpha=;sweep --rows;sweep --vary alpha=0:1:3 --plot "
        "a.svg;sweep --vary alpha=0:1:3 --snapshot a;sweep --vary alpha=0:1:3 "
        "--checkpoint a;sweep --vary alpha=0:1:3 --part 1/2 --part 2/2;"
        "sweep --vary alpha=0:1:3 --jobs 1 --jobs 2";
    for (char *line = lines, *end; line; line = end ? end + 1 : NULL) {
        if ((end = strchr(line, ';')))
            *end = '\0';
        ck_assert_msg(fvi(line) == 2, "fvi %s", line);
        ck_assert_msg(*out == '\0', "fvi %s printed %s", line, out);
        ck_assert_msg(count_lines(err) == 2 && strncmp(err, "fvi: ", 5) == 0
                          && strstr(err, "--help"),
                      "fvi %s said: %s", line, err);
    }
    fvi("sweep --vray alpha=0:1:3");
    ck_assert_ptr_nonnull(strstr(err, "did you mean --vary?\n"));
    fvi("sweep --vary rho=-1:1:3:log");
    ck_assert_ptr_nonnull(strstr(err, ": log needs two ends of one sign\n"));
    fvi("sweep --vary ALPHA=0:1:2");
    ck_assert_ptr_nonnull(strstr(err, "did you mean alpha?\n"));
    fvi("sweep --vary k=1:2:2 --potential 'kk*x^2' --let kk=1");
    ck_assert_ptr_nonnull(strstr(err, "--vary: 'k' is no option"));
    fvi("sweep --vary alpha=0:1:2 --alhpa 3");
    ck_assert_ptr_nonnull(strstr(err, "did you mean --alpha?\n"));
}
END_TEST

/* The first run, in the order of the grid, that fails is named; rows before it stand, on
 * standard output alone. */
START_TEST(a_run_that_fails_is_named)
{
    const char *sweep = "sweep --vary rho=1:1e30:4:log --alpha 1 --steps 20";
    char line[200];
    ck_assert_int_eq(fvi(sweep), 1);
    ck_assert(count_lines(err) == 2 && strstr(err, "\nfvi: with rho = ")
              && strstr(err, ": step ")
              && strstr(err, ": a value is no longer finite\n"));
    const size_t rows = count_rows();
    ck_assert(rows >= 1 && rows < 4);
    char *want = strdup(err);
    snprintf(line, sizeof line, "%s --jobs 1 -o none", sweep);
    ck_assert_int_eq(fvi(line), 1);
    ck_assert_str_eq(err, want);
    ck_assert(!exists("none"));
    free(want);
    ck_assert_int_eq(fvi("sweep --vary x0=1:2:2 -o missing/table"), 1);
    ck_assert_int_eq(shell("\"$FVI\" sweep --vary x0=1:2:2 > /dev/full; "
                           "test $? = 1"),
                     0);
}
END_TEST

/* What has no solution is said of the whole. */
START_TEST(a_sweep_of_what_has_no_solution_warns)
{
    ck_assert_int_eq(fvi("sweep --vary alpha=0.4:0.6:2 --derivative rl"), 0);
    ck_assert(count_lines(err) == 1
              && strncmp(err, "fvi: warning: rl ", 17) == 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = rl "));
    ck_assert_int_eq(fvi("sweep --vary alpha=0.3:0.5:2 --derivative rl"), 0);
    ck_assert_str_eq(err, "");
}
END_TEST

/* R = rho h / m = 2 at alpha = kappa = 1/2 (14.3): rows beyond are counted, and the first of them
 * is named. What is adapted to an error is not among them. In JSON no name stands twice. */
START_TEST(unstable_rows_of_a_sweep_are_counted)
{
    ck_assert_int_eq(fvi("sweep --vary h=0.5:1.5:3 --vary rho=1:3:2 --steps 9"),
                     0);
    ck_assert_str_eq(err, "fvi: warning: rows with an unstable step: 2 of 6, "
                          "the first with h = 1, rho = 3\n");
    ck_assert_ptr_nonnull(
        strstr(out, "\n# warning = rows with an unstable step: 2 of 6\n"));
    ck_assert_int_eq(fvi("sweep --vary h=0.5:1.5:3 --rho 1.3 --steps 9"), 0);
    ck_assert_str_eq(err, "");
    ck_assert_ptr_null(strstr(out, "warning"));
    ck_assert_int_eq(fvi("sweep --vary rho=1:99:3 --error 1e-3 --steps 2"), 0);
    ck_assert_str_eq(err, "");
    ck_assert_int_eq(fvi("sweep --vary rho=9:9:1 --h 9 --alpha 0.7 --steps 2 "
                         "--derivative rl --format json"),
                     0);
    ck_assert(strstr(out, "\"warning\": \"rl") && count_lines(err) == 2
              && strstr(out, "\"warning of the step\": \"rows with"));
}
END_TEST

/* However the parent ends, its processes end, too: there is nobody to read their rows. */
START_TEST(no_process_outlives_the_sweep)
{
    ck_assert_int_eq(
        shell("\"$FVI\" sweep --vary x0=1:2:8 --jobs 2 --alpha 0.3 --memory "
              "direct --steps 1e6 & pid=$!; sleep 0.5; "
              "all=$(grep -l \"^PPid:.$pid$\" /proc/[0-9]*/status "
              "2>/dev/null | tr -dc '0-9\\n'); kill -9 $pid; sleep 0.5; "
              "for i in $all; do grep -q '^State:.[RSD]' /proc/$i/status && "
              "exit 1; done; "
              "test ! -d /proc/self || test \"$all\""),
        0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: a grid of runs");
    ADD_CASE(suite, "values", a_sweep_is_the_last_rows_of_its_runs,
             what_can_be_varied, points_between_decimal_ends_are_decimal,
             a_part_may_have_no_rows, neither_jobs_nor_parts_change_a_row);
    ADD_CASE(suite, "errors", no_process_outlives_the_sweep,
             a_list_of_values_is_varied_as_it_stands,
             values_of_a_file_are_varied,
             all_rows_of_each_run_may_be_printed,
             sections_diagrams_and_spectra_are_one_command,
             bad_sweeps_are_refused, a_run_that_fails_is_named,
             a_sweep_of_what_has_no_solution_warns,
             unstable_rows_of_a_sweep_are_counted);
    return run_suite_of_program(suite);
}
