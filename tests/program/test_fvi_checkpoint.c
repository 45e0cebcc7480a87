/* tests/program/test_fvi_checkpoint.c -- The program build/fvi: a run that is stopped and continued.
 * Run alone: make test-fvi_checkpoint */
#define _GNU_SOURCE
#include "program.h"

/* The rows of `want`, a whole table, are those of `first` up to some row, then those of
 * `rest`, both without heads. */
static void rows_make_a_whole(const char *whole, const char *first,
                              const char *rest)
{
    char line[400];
    snprintf(line, sizeof line,
             "grep -v '^#' %s > rows; last=$(grep -v '^#' %s | head -1); "
             "{ grep -v '^#' %s | grep -v -F -x -f %s; grep -v '^#' %s; } | "
             "cmp - rows",
             whole, rest, first, rest, rest);
    ck_assert_msg(shell(line) == 0, "%s", err);
}

/* A signal ends the run, at whatever step; then it goes on. What was printed before it is
 * there, and the rest has the same bits. */
START_TEST(a_run_that_was_stopped_goes_on_to_the_bit)
{
    static const char *const runs[] = {
        "run --alpha 0.3 --steps 7e4 --memory direct --every 175",
        "run --alpha 0.3 --steps 3e6 --method fvi-bdf2 --every 15000",
        ("run --alpha 0.7 --steps 4e5 --method fvi-lobatto3 --potential "
         "'x^4/4 - x^2/2' --force 'cos(t)/4' --every 5000"),
    };
    size_t stopped = 0;
    for (size_t n = 0; n < LEN(runs); n++) {
        char line[900];
        snprintf(line, sizeof line,
                 "\"$FVI\" %s > whole; rm -f c first rest; "
                 "\"$FVI\" %s --checkpoint c > first & pid=$!; "
                 WAIT_UNTIL(CATCHES_TERM_AND_ALARM) "sleep 0.05; kill $pid; wait $pid; echo $?",
                 runs[n], runs[n]);
        ck_assert_int_eq(shell(line), 0);
        ck_assert(exists("c") && !exists("c.new"));
        if (strcmp(out, "143\n") == 0)
            stopped++;
        else
            ck_assert_str_eq(out, "0\n"); /* done before it was stopped */
        snprintf(line, sizeof line,
                 "\"$FVI\" %s --checkpoint c --continue > rest", runs[n]);
        ck_assert_msg(shell(line) == 0, "%s", err);
        rows_make_a_whole("whole", "first", "rest");
    }
    ck_assert_uint_ge(stopped, 1);
}
END_TEST

/* What is finished can be made longer. Where the memory depends on N, a longer run has other
 * last digits from its first step on: that run is begun anew, which is said. */
START_TEST(a_run_that_is_over_can_be_made_longer)
{
    static const char *const runs[] = {
        "run --alpha 0.3 --memory direct",
        "run --method lda",
        "run --alpha 1 --rho 0.3 --method fvi-shifted",
        "run --damping distributed:1,0.1,0.4 --memory direct",
        "run --alpha 0.3",
        "run --damping davidson:1,0.3,2 --memory direct",
        "run --damping 'symbol:s^0.5/(1+s)' --method fvi-stable",
        "run --damper 'x : davidson:1,0.3,2 + viscous:1' --method fvi-stable --memory direct",
        "run --alpha 0.7 --method fvi-lobatto3",
        "run --alpha 0.3 --method fvi-bdf2 --memory exponentials"
    };
    for (size_t n = 0; n < LEN(runs); n++) {
        char line[600];
        snprintf(line, sizeof line,
                 "\"$FVI\" %s --steps 900 > whole; "
                 "\"$FVI\" %s --steps 300 --checkpoint c > first; "
                 "\"$FVI\" %s --steps 900 --checkpoint c --continue > rest",
                 runs[n], runs[n], runs[n]);
        ck_assert_msg(shell(line) == 0, "%s", err);
        if (n < 4)
            ck_assert_str_eq(err, "");
        else
            ck_assert_str_eq(err, "fvi: --continue: the memory depends on --steps, and on the version: the first 300 "
                                  "steps are done again\n");
        if (n < 4)
            rows_make_a_whole("whole", "first", "rest");
        ck_assert_int_eq(shell("grep -v '^#' rest > r; grep -v '^#' whole | "
                               "tail -n 600 | cmp - r"),
                         0);
        ck_assert_int_eq(shell("grep -vc '^#' rest"), 0);
        ck_assert_str_eq(out, "600\n");
        snprintf(line, sizeof line, "%s --steps 900 --checkpoint c --continue",
                 runs[n]);
        ck_assert_int_eq(fvi(line), 0); /* it is over: a head, no row */
        ck_assert_uint_eq(count_rows(), 0);
    }
    ck_assert_int_eq(
        shell("\"$FVI\" run --steps 20 --checkpoint c > /dev/null; \"$FVI\" "
              "run --steps 22 --checkpoint c --continue --format json "
              "--columns t | tail -4"),
        0);
    ck_assert_str_eq(out, "\"rows\": [\n [2.1],\n [2.2]\n]}\n");
    /* which unknowns are columns is no matter of the state */
    ck_assert_int_eq(fvi("run --potential chain:3,1,0 --steps 4 --checkpoint "
                         "c --columns x"),
                     0);
    ck_assert_int_eq(fvi("run --potential chain:3,1,0 --steps 5 --checkpoint "
                         "c --columns x --unknowns 2 --continue"),
                     0);
    const double one = cell(0, 0);
    ck_assert_int_eq(fvi("run --potential chain:3,1,0 --steps 5 --columns x"),
                     0);
    ck_assert_double_eq(cell(5, 1), one);
}
END_TEST

/* exit 2, two lines, and what is wrong */
static void refused(const char *line, const char *said)
{
    ck_assert_msg(fvi(line) == 2, "%s: %s", line, err);
    ck_assert_str_eq(out, "");
    ck_assert_msg(strncmp(err, said, strlen(said)) == 0, "%s", err);
    ck_assert_uint_eq(count_lines(err), 2);
}

START_TEST(another_problem_version_or_file_is_refused)
{
    ck_assert_int_eq(fvi("run --alpha 0.3 --steps 1000 --checkpoint c"), 0);
    refused("run --alpha 0.4 --steps 1000 --checkpoint c --continue",
            "fvi: --continue: c: a run with alpha = 0.3, not alpha = 0.4\n");
    refused("run --alpha 0.3 --steps 1000 --checkpoint c --continue --rho 1",
            "fvi: --continue: c: a run with rho = 0.2, not rho = 1\n");
    refused("run --alpha 0.3 --steps 1000 --checkpoint c --continue --let k=1 "
            "--force k",
            "fvi: --continue: c: a run without let = k=1\n");
    refused("run --damping power:1,0.3 --steps 1000 --checkpoint c --continue",
            "fvi: --continue: c: a run with alpha = 0.3, which is not given");
    refused("run --alpha 0.3 --steps 900 --checkpoint c --continue",
            "fvi: --continue: c: it is further than --steps\n");
    refused("run --alpha 0.3 --checkpoint nowhere --continue",
            "fvi: --continue: nowhere: No such file or directory\n");
    refused("run --checkpoint . --continue", "fvi: --checkpoint: '.' is not an ordinary file");
    const char *run = "run --alpha 0.3 --steps 1000 --checkpoint d --continue";
    ck_assert_int_eq(shell("sed '1s/[0-9]/9/' c > d"), 0);
    refused(run, "fvi: --continue: d: a checkpoint of another version\n");
    ck_assert_int_eq(shell("sed '1s/[0-9]*$/2/; s/^memory = .*/memory = fft/' "
                           "c > d; grep -aq 'checkpoint 2' d"),
                     0);
    refused(run, "fvi: --continue: d: a run with memory = fft, which this "
                 "version does not have; it has direct and exponentials\n");
    ck_assert_int_eq(shell("echo hello > d"), 0);
    refused(run, "fvi: --continue: d: not a checkpoint\n");
    ck_assert_int_eq(shell(": > d"), 0);
    refused(run, "fvi: --continue: d: not a checkpoint\n");
    ck_assert_int_eq(shell("head -c 2000 c > d"), 0);
    refused(run, "fvi: --continue: d: damaged\n");
    ck_assert_int_eq(shell("cp c d; echo >> d"), 0);
    refused(run, "fvi: --continue: d: damaged\n");
    /* one bit of the last momentum, say: only the checksum knows */
    ck_assert_int_eq(
        shell("size=$(wc -c < c); head -c $((size - 40)) c > d; "
              "printf '\\001' >> d; tail -c 39 c >> d; cmp -s c d; "
              "test $? = 1 && test $(wc -c < d) = $size"),
        0);
    refused(run, "fvi: --continue: d: damaged\n");
    refused("run --continue", "fvi: --continue: from which --checkpoint FILE?");
    refused("run --checkpoint ''",
            "fvi: --checkpoint: '' is not a file's name");
    refused("run --checkpoint c -o c",
            "fvi: --checkpoint: 'c' is the table's file, too");
    refused("run --checkpoint c --error 1",
            "fvi: --checkpoint: not together with --error");
    refused("run --checkpoint c --continue --columns y",
            "fvi: --continue: column y needs every row");
    refused("run --checkpoint e --columns t,x,y -o u",
            "fvi: --checkpoint: column y needs every row");
    ck_assert(!exists("e") && !exists("u"));
    refused("run --continue=3", "fvi: --continue=3: no such option");
    refused("exact --checkpoint c", "fvi: --checkpoint: not an option of this "
                                    "command");
    refused("sweep --vary x0=1:2:2 --checkpoint c",
            "fvi: --checkpoint: not an option of this command");
    ck_assert_int_eq(fvi("run --checkpoint missing/c"), 1);
    ck_assert_int_eq(shell("mkfifo pipe; \"$FVI\" run --checkpoint pipe; "
                           "test $? = 2 && test -p pipe"),
                     0); /* what is no file stays what it is */
}
END_TEST

/* With -o the run that is stopped leaves its checkpoint, and no table. Gone on with, it leaves
 * the table that it would have left, in each format, and the same picture: the checkpoint
 * keeps the rows that no file has. */
START_TEST(a_table_is_complete_or_absent_with_a_checkpoint_too)
{
    static const char *const runs[] = {
        "run --alpha 0.3 --steps 1e5 --memory direct --every 70",
        "run --alpha 0.3 --steps 1e5 --memory direct --every 7 --format json",
    };
    for (size_t n = 0; n < LEN(runs); n++) {
        char line[900];
        snprintf(line, sizeof line,
                 "rm -f c t; \"$FVI\" %s -o t --checkpoint c & pid=$!; "
                 WAIT_UNTIL(CATCHES_TERM_AND_ALARM) "sleep 0.1; kill $pid; wait $pid; test $? = 143",
                 runs[n]);
        ck_assert_int_eq(shell(line), 0);
        ck_assert(exists("c") && !exists("t"));
        ck_assert_int_eq(shell("ls -A | grep '[.]fvi-\\|c.new'"), 1);
    }
    static const char *const short_runs[] = {
        "run --alpha 0.3 --memory direct --every 7 --columns t,x",
        "run --method lda --every 1 --format csv",
        "run --method lda --every 7 --format json",
        "run --potential chain:3,1,1 --method lda --unknowns 1,3",
        "run --method fvi-adaptive --force cosine:1,1 --every 7",
    };
    for (size_t n = 0; n < LEN(short_runs); n++) {
        const char *run = short_runs[n];
        char line[900];
        snprintf(line, sizeof line,
                 "\"$FVI\" %s --steps 900 -o whole; "
                 "\"$FVI\" %s --steps 300 -o t --checkpoint c; "
                 "\"$FVI\" %s --steps 500 -o t --checkpoint c --continue; "
                 "\"$FVI\" %s --steps 900 -o t --checkpoint c --continue; "
                 "cmp t whole; rm t; "
                 "\"$FVI\" %s --steps 900 -o t --checkpoint c --continue; "
                 "cmp t whole",
                 run, run, run, run, run);
        ck_assert_msg(shell(line) == 0, "%s: %s%s", run, out, err);
        snprintf(line, sizeof line,
                 "\"$FVI\" %s --steps 900 --checkpoint c --continue | cmp - "
                 "whole",
                 run); /* no file has its rows: standard output has all */
        ck_assert_msg(shell(line) == 0, "%s: %s%s", run, out, err);
    }
}
END_TEST

/* The same of what is stopped somewhere, the picture included. The whole run takes 0.7 s, and its time
 * grows as the square of the steps. So after 0.3 s it is stopped in the middle, after two thirds of its steps. */
START_TEST(a_table_that_was_stopped_is_that_of_the_whole_run)
{
    char plot[] = "--plot p.svg";
    if (shell("command -v gnuplot > /dev/null") != 0)
        *plot = '\0';
    char line[900];
    snprintf(line, sizeof line,
             "run='run --alpha 0.3 --steps 8e4 --memory direct --every 7 %s'; "
             "\"$FVI\" $run -o whole; test ! -e p.svg || mv p.svg whole.svg; "
             "\"$FVI\" $run -o t --checkpoint c & pid=$!; "
             WAIT_UNTIL(CATCHES_TERM_AND_ALARM) "sleep 0.3; kill $pid; wait $pid; rm -f t p.svg; "
             "\"$FVI\" $run -o t --checkpoint c --continue && cmp t whole && "
             "{ test ! -e whole.svg || cmp p.svg whole.svg; }",
             plot);
    ck_assert_msg(shell(line) == 0, "%s%s", out, err);
    /* other rows cannot follow those, and rows of a pipe are in no file */
    refused(
        "run --alpha 0.3 --steps 8e4 --memory direct --every 8 --checkpoint "
        "c --continue -o t",
        "fvi: --continue: c: its rows have other --columns, --unknowns, "
        "--every, --format or --plot\n");
    ck_assert_int_eq(fvi("run --method lda --checkpoint c"), 0);
    refused("run --method lda --steps 300 --checkpoint c --continue -o t",
            "fvi: --continue: c: its rows are on standard output, where the "
            "rest must go\n");
}
END_TEST

/* What the run reads is what it was: a file is known by what is in it. */
START_TEST(a_file_that_has_changed_is_refused_by_its_name)
{
    static const struct {
        const char *file, *first, *then, *run;
    } runs[] = {
        { "f.tsv", "0\t0\n100\t1\n", "0\t0\n100\t2\n", "--force file:f.tsv" },
        { "x.txt", "1 2 3\n", "1 2 4\n",
          "--potential chain:3,1,0 --x0 @x.txt" },
        { "u.c",
          "#include <fvi/trajectory.h>\n"
          "static int u(size_t d, const double *x, void *p, double *U)\n"
          "{ (void)d; (void)p; *U = x[0] * x[0] / 2; return 0; }\n"
          "static int g(size_t d, const double *x, void *p, double *g)\n"
          "{ (void)d; (void)p; g[0] = x[0]; return 0; }\n"
          "static int h(size_t d, const double *x, void *p, double *h)\n"
          "{ (void)d; (void)p; (void)x; h[0] = 1; return 0; }\n"
          "const fvi_potential fvi_user_potential = { .value = u, .gradient = "
          "g, .hessian = h };\n",
          "#include <fvi/trajectory.h>\n"
          "static int u(size_t d, const double *x, void *p, double *U)\n"
          "{ (void)d; (void)p; *U = x[0] * x[0]; return 0; }\n"
          "static int g(size_t d, const double *x, void *p, double *g)\n"
          "{ (void)d; (void)p; g[0] = 2 * x[0]; return 0; }\n"
          "static int h(size_t d, const double *x, void *p, double *h)\n"
          "{ (void)d; (void)p; (void)x; h[0] = 2; return 0; }\n"
          "const fvi_potential fvi_user_potential = { .value = u, .gradient = "
          "g, .hessian = h };\n",
          "--potential u.c" },
    };
    for (size_t n = 0; n < LEN(runs); n++) {
        char line[400], said[200];
        snprintf(line, sizeof line, "run %s --steps 10 --checkpoint c",
                 runs[n].run);
        write_file(runs[n].file, runs[n].first);
        ck_assert_msg(fvi(line) == 0, "%s", err);
        strcat(line, " --continue");
        ck_assert_msg(fvi(line) == 0, "%s", err);
        write_file(runs[n].file, runs[n].then);
        snprintf(said, sizeof said,
                 "fvi: --continue: c: the file %s%s has changed\n",
                 strcmp(runs[n].file, "u.c") == 0 ? "./" : "", runs[n].file);
        refused(line, said);
        write_file(runs[n].file, runs[n].first);
        ck_assert_msg(fvi(line) == 0, "%s", err);
    }
}
END_TEST

/* No other file is written to, followed or waited for; and runs that share one leave one. */
START_TEST(a_checkpoint_touches_no_other_file)
{
    write_file("f.new", "0\t0\n100\t1\n");
    ck_assert_int_eq(fvi("run --steps 5 --force file:f.new --checkpoint f"), 0);
    ck_assert(exists("f.new"));
    ck_assert_int_eq(shell("mkfifo g.new; ln -s f.new h.new; "
                           "for c in g h; do \"$FVI\" run --steps 5 "
                           "--checkpoint $c || exit 1; done; "
                           "test -p g.new -a -L h.new && wc -l < f.new"),
                     0);
    ck_assert_str_eq(out + strlen(out) - 2, "2\n");
    ck_assert_int_eq(shell("for i in 1 2 3 4 5 6 7 8 9; do \"$FVI\" run "
                           "--steps 2000 --checkpoint s -o /dev/null & all=\""
                           "$all $!\"; done; for i in $all; do wait $i || "
                           "exit 1; done; \"$FVI\" run --steps 2000 "
                           "--checkpoint s --continue"),
                     0);
    ck_assert_int_eq(shell("umask 022; : > k; chmod 600 k; ln -s k l; \"$FVI\" "
                           "run --steps 5 --checkpoint l > /dev/null; test -L "
                           "l -a -s k && ls -l k"),
                     0);
    ck_assert(strncmp(out, "-rw-------", 10) == 0);
    ck_assert_int_eq(shell("ls -A | grep '[.]fvi-'"), 1);
}
END_TEST

/* A reader that does not read keeps no run: the signal ends it a second later. */
START_TEST(a_pipe_that_nobody_reads_keeps_no_run)
{
    ck_assert_int_eq(shell("mkfifo p; sleep 60 < p & reader=$!; \"$FVI\" run "
                           "--steps 1e6 --method lda --checkpoint c -o p & "
                           "pid=$!; sleep 0.5; kill $pid; sleep 3; "
                           "kill -9 $pid; wait $pid; code=$?; kill $reader; "
                           "test $code = 143"),
                     0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: stopped and gone on with");
    ADD_CASE(suite, "values", a_run_that_was_stopped_goes_on_to_the_bit,
             a_run_that_is_over_can_be_made_longer,
             a_table_is_complete_or_absent_with_a_checkpoint_too,
             a_table_that_was_stopped_is_that_of_the_whole_run,
             a_checkpoint_touches_no_other_file);
    ADD_CASE(suite, "errors", another_problem_version_or_file_is_refused,
             a_file_that_has_changed_is_refused_by_its_name,
             a_pipe_that_nobody_reads_keeps_no_run);
    return run_suite_of_program(suite);
}
