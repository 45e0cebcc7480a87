/* tests/program/test_fvi_checkpoint.c -- The program build/fvi: stopped, and gone on with.
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
        "run --alpha 0.3 --steps 2e4 --memory direct --every 50",
        "run --alpha 0.3 --steps 1e6 --method fvi-bdf2 --every 5000",
        "run --alpha 0.7 --steps 4e5 --method fvi-lobatto3 --potential "
        "'x^4/4 - x^2/2' --force 'cos(t)/4' --every 5000",
    };
    for (size_t n = 0; n < LEN(runs); n++) {
        char line[900];
        snprintf(line, sizeof line,
                 "\"$FVI\" %s > whole; rm -f c first rest; "
                 "\"$FVI\" %s --checkpoint c > first & pid=$!; sleep 0.1; "
                 "kill $pid; wait $pid; echo $?",
                 runs[n], runs[n]);
        ck_assert_int_eq(shell(line), 0);
        ck_assert(exists("c") && !exists("c.new"));
        if (strcmp(out, "143\n") != 0)
            ck_assert_str_eq(out, "0\n"); /* done before it was stopped */
        snprintf(line, sizeof line,
                 "\"$FVI\" %s --checkpoint c --continue > rest", runs[n]);
        ck_assert_msg(shell(line) == 0, "%s", err);
        rows_make_a_whole("whole", "first", "rest");
    }
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
        "run --alpha 0.3",
        "run --alpha 0.7 --method fvi-lobatto3",
        "run --alpha 0.3 --method fvi-bdf2 --memory fft"
    };
    for (size_t n = 0; n < LEN(runs); n++) {
        char line[600];
        snprintf(line, sizeof line,
                 "\"$FVI\" %s --steps 900 > whole; "
                 "\"$FVI\" %s --steps 300 --checkpoint c > first; "
                 "\"$FVI\" %s --steps 900 --checkpoint c --continue > rest",
                 runs[n], runs[n], runs[n]);
        ck_assert_msg(shell(line) == 0, "%s", err);
        if (n < 3)
            ck_assert_str_eq(err, "");
        else
            ck_assert_str_eq(err, "fvi: --continue: the memory depends on "
                                  "--steps: the first 300 steps are done "
                                  "again\n");
        if (n < 3)
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
    refused("run --checkpoint . --continue", "fvi: --continue: .: ");
    const char *run = "run --alpha 0.3 --steps 1000 --checkpoint d --continue";
    ck_assert_int_eq(shell("sed '1s/[0-9]/9/' c > d"), 0);
    refused(run, "fvi: --continue: d: a checkpoint of another version\n");
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
    refused("run --continue=3", "fvi: --continue=3: no such option");
    refused("exact --checkpoint c", "fvi: --checkpoint: not an option of this "
                                    "command");
    refused("sweep --vary x0=1:2:2 --checkpoint c",
            "fvi: --checkpoint: not an option of this command");
    ck_assert_int_eq(fvi("run --checkpoint missing/c"), 1);
    ck_assert_int_eq(shell("mkfifo pipe; \"$FVI\" run --checkpoint pipe; "
                           "test $? = 1 && test -p pipe"),
                     0); /* what is no file stays what it is */
}
END_TEST

/* With -o the run that is stopped leaves its checkpoint, and no table. */
START_TEST(a_table_is_complete_or_absent_with_a_checkpoint_too)
{
    ck_assert_int_eq(shell("\"$FVI\" run --alpha 0.3 --steps 1e5 --memory "
                           "direct -o t --checkpoint c & pid=$!; sleep 0.2; "
                           "kill $pid; wait $pid; test $? = 143"),
                     0);
    ck_assert(exists("c") && !exists("t"));
    ck_assert_int_eq(shell("ls -A | grep '[.]fvi-\\|c.new'"), 1);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: stopped and gone on with");
    ADD_CASE(suite, "values", a_run_that_was_stopped_goes_on_to_the_bit,
             a_run_that_is_over_can_be_made_longer,
             a_table_is_complete_or_absent_with_a_checkpoint_too);
    ADD_CASE(suite, "errors", another_problem_version_or_file_is_refused);
    return run_suite_of_program(suite);
}
