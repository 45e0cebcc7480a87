/* tests/program/test_fvi_files.c -- The program build/fvi: the files that it writes.
 * Run alone: make test-fvi_files */
#define _GNU_SOURCE
#include "program.h"

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
    ck_assert_int_eq(shell("ulimit -f 1; \"$FVI\" run --steps 5000 -o large"),
                     1);
    ck_assert(!exists("large"));
    ck_assert_int_eq(fvi("run -o /dev/full"), 1);
    ck_assert_int_eq(shell("\"$FVI\" run > /dev/full; test $? = 1"), 0);
    ck_assert_int_eq(shell("\"$FVI\" methods > /dev/full; test $? = 1"), 0);
    ck_assert_int_eq(shell("ls -A | grep '[.]fvi-'"), 1); /* no leftovers */
}
END_TEST

/* The file keeps its permissions; no link is replaced by a file; the words for
 * standard error never come into the table. */
START_TEST(what_was_there_is_respected)
{
    ck_assert_int_eq(shell("umask 022; touch open; chmod 666 open; "
                           "\"$FVI\" run --steps 3 -o open; ls -l open"),
                     0);
    ck_assert(strncmp(out, "-rw-rw-rw-", 10) == 0);
    ck_assert_int_eq(
        shell("umask 077; \"$FVI\" run --steps 3 -o new; ls -l new"), 0);
    ck_assert(strncmp(out, "-rw-------", 10) == 0);
    ck_assert_int_eq(shell("ln -s new link; \"$FVI\" run --steps 4 -o link; "
                           "test -L link && grep -c '^[0-9]' new"),
                     0);
    ck_assert_str_eq(out, "5\n");
    ck_assert_int_eq(shell("ln -s nowhere lost; \"$FVI\" run -o lost"), 1);
    ck_assert_str_eq(err,
                     "fvi: cannot write lost: No such file or directory\n");
    ck_assert(!exists("nowhere"));
    ck_assert_int_eq(shell("ln -s round round; \"$FVI\" run -o round"), 1);
    ck_assert_int_eq(shell("\"$FVI\" run --kappa 0 --h 3 --steps 3 -o warned "
                           "2>&-; cat warned"),
                     0);
    ck_assert(strncmp(out, "# fvi", 5) == 0);
    ck_assert_int_eq(shell("\"$FVI\" run --steps 3 >&-; test $? = 1"), 0);
}
END_TEST

/* A run that is stopped leaves neither its file nor a temporary one. */
START_TEST(an_interrupted_run_leaves_no_file)
{
    ck_assert_int_eq(
        shell("\"$FVI\" run --steps 1e5 --alpha 0.3 --memory direct "
              "-o gone & pid=$!; " WAIT_UNTIL(CATCHES_TERM) "sleep 0.1; "
              "kill $pid; wait $pid; test $? = 143"),
        0);
    ck_assert(!exists("gone"));
    ck_assert_int_eq(shell("trap '' HUP; \"$FVI\" run --steps 1e5 --alpha 0.3 "
                           "--memory direct -o kept & pid=$!; " WAIT_UNTIL(CATCHES_TERM)
                           "sleep 0.1; kill -HUP $pid; sleep 0.1; kill $pid; "
                           "wait $pid; test $? = 143"),
                     0);
    ck_assert_int_eq(shell("ls -A | grep '[.]fvi-'"), 1);
}
END_TEST

/* SIGKILL cannot be caught: the file has no name until it is complete, where the system has
 * such files; else .fvi-XXXXXX is left, as the header says, and nothing is tested. */
START_TEST(a_killed_run_leaves_no_file)
{
    ck_assert_int_eq(
        shell("\"$FVI\" run --steps 1e5 --alpha 0.3 --memory direct "
              "-o killed & pid=$!; " WAIT_UNTIL(CATCHES_TERM)
              "sleep 0.1; ls -lL /proc/$pid/fd > names; "
              "ls -A | grep -c '[.]fvi-' > count; "
              "kill -9 $pid; wait $pid; test $? = 137; cat count"),
        0);
    ck_assert(!exists("killed"));
    if (strcmp(out, "0\n") == 0) /* nothing to be seen while it ran */
        ck_assert_int_eq(shell("ls -A | grep '[.]fvi-'"), 1);
}
END_TEST

/* Standard error is a terminal: after a second a line that says how far, and how long
 * still; it is cleared. A pipe gets none. What makes the run last is a reader of its rows
 * who sleeps. */
START_TEST(progress_is_shown_on_a_terminal)
{
    const char *slow = "\"$FVI\" run --steps 20000 --columns x"
                       " | (read -r first; sleep 2; cat > far)";
    char line[300];
    if (shell("command -v script > /dev/null") != 0)
        return;
    snprintf(line, sizeof line, "script -qec '%s' typescript < /dev/null",
             slow);
    ck_assert_int_eq(shell(line), 0);
    unsigned k, steps;
    double percent, past, left;
    const char *said = strstr(out, "\rstep ");
    ck_assert_msg(said
                      && sscanf(said,
                                "\rstep %u of %u (%lf %%), %lf s, %lf s left",
                                &k, &steps, &percent, &past, &left)
                             == 5,
                  "%s", out);
    ck_assert(k < steps && steps == 20000 && past >= 1 && left < 600);
    ck_assert_ptr_nonnull(strstr(said, "\r\033[K"));
    ck_assert_int_eq(shell(slow), 0);
    ck_assert_str_eq(err, "");
}
END_TEST

/* Complete or not at all is what a file is; on standard output the rows before the
 * failure stand, also by its other name. */
START_TEST(the_rows_before_a_failure_are_kept_on_standard_output_alone)
{
    const char *fails = "run --alpha 1 --rho 1e30 --steps 20 --columns x";
    char line[200];
    ck_assert_int_eq(fvi(fails), 1);
    const size_t rows = count_rows();
    ck_assert(rows > 1 && rows < 20);
    snprintf(line, sizeof line, "%s -o /dev/stdout", fails);
    ck_assert_int_eq(fvi(line), 1);
    ck_assert_uint_eq(count_rows(), rows);
    snprintf(line, sizeof line, "%s -o none", fails);
    ck_assert_int_eq(fvi(line), 1);
    ck_assert(!exists("none"));
    ck_assert_int_eq(shell("ls -A | grep '[.]fvi-'"), 1); /* no leftovers */
}
END_TEST

/* What is open already is written to where it stands: nothing that others wrote is
 * lost, whatever the name of it. */
START_TEST(an_open_file_is_written_to_where_it_stands)
{
    static const char *const names[] = { "/dev/stdout", "/dev/fd/1",
                                         "/proc/self/fd/1", "../out-there",
                                         "../name" };
    ck_assert_int_eq(shell("ln -s /dev/stdout out-there; mkdir -p in; "
                           "ln -s out-there name"),
                     0);
    for (size_t i = 0; i < LEN(names); i++) {
        char line[400];
        snprintf(line, sizeof line,
                 "echo first > f; cd in; \"$FVI\" run --steps 2 -o %s >> "
                 "../f; cat ../f",
                 names[i]);
        ck_assert_int_eq(shell(line), 0);
        ck_assert_msg(strncmp(out, "first\n# fvi ", 12) == 0, "%s: %s",
                      names[i], out);
        ck_assert_uint_eq(count_lines(strstr(out, "# t\t")), 4);
        snprintf(line, sizeof line,
                 "cd in; { echo a; \"$FVI\" run --steps 2 -o %s; echo b; } "
                 "> ../f; cat ../f",
                 names[i]);
        ck_assert_int_eq(shell(line), 0);
        ck_assert(strncmp(out, "a\n# fvi ", 8) == 0);
        ck_assert_str_eq(strrchr(out, 'b'), "b\n");
    }
    ck_assert_int_eq(shell("echo first > f; "
                           "\"$FVI\" run --steps 2 -o /dev/stderr 2>> f; "
                           "cat f; test -L /dev/stdout"),
                     0);
    ck_assert(strncmp(out, "first\n# fvi ", 12) == 0);
    ck_assert_int_eq(shell("\"$FVI\" run -o /dev/stdout >&-; test $? = 1"), 0);
}
END_TEST

/* A file of two names is one file afterwards, too, and has the whole table, be it
 * longer or shorter than what was there; or the old contents. */
START_TEST(a_file_keeps_all_its_names)
{
    ck_assert_int_eq(shell("echo old > one; ln one two; "
                           "\"$FVI\" run --steps 9 -o one && "
                           "test one -ef two && grep -c '^[0-9]' two"),
                     0);
    ck_assert_str_eq(out, "10\n");
    ck_assert_int_eq(shell("\"$FVI\" run --steps 2 -o two; \"$FVI\" run "
                           "--steps 2 > three; test one -ef two && "
                           "cmp one three"),
                     0);
    ck_assert_int_eq(shell("\"$FVI\" run --x0 1e200 -o one; cmp one three"), 0);
    ck_assert_int_eq(shell("ulimit -f 1; \"$FVI\" run --steps 5000 -o one; "
                           "cmp one three"),
                     0);
    ck_assert_int_eq(shell("ls -A | grep '[.]fvi-'"), 1); /* no leftovers */
}
END_TEST

/* By whatever names: in a folder, through a link, as a second name, or as standard output. */
START_TEST(two_outputs_in_one_file_are_refused)
{
    ck_assert_int_eq(shell("mkdir twice; ln -s . same; echo kept > there; "
                           "ln there theirs"),
                     0);
    ck_assert_refused("run -o t --snapshot ./t",
                      "fvi: --snapshot: './t' is the table's file, too");
    ck_assert_refused(
        "run -o \"$PWD/t\" --checkpoint twice/../same/t",
        "fvi: --checkpoint: 'twice/../same/t' is the table's file, too");
    ck_assert_refused("run -o there --plot theirs.svg --snapshot theirs",
                      "fvi: --snapshot: 'theirs' is the table's file, too");
    ck_assert_refused(
        "run --snapshot t --checkpoint same/t",
        "fvi: --checkpoint: 'same/t' is the file of --snapshot, too");
    ck_assert_refused("gradient --forces ./t -o t",
                      "fvi: --forces: './t' is the table's file, too");
    ck_assert_refused("fit --curve ./t -o t there",
                      "fvi: --curve: './t' is the table's file, too");
    ck_assert_refused("fit -o theirs there",
                      "fvi: -o: 'theirs' is the file of the data, too");
    ck_assert_int_eq(fvi("run --steps 2 --snapshot out"), 2);
    ck_assert_int_eq(shell("cat there; test ! -e t"), 0);
    ck_assert_str_eq(out, "kept\n");
    ck_assert_int_eq(fvi("run --steps 2 -o u --snapshot v"), 0);
    ck_assert_int_eq(fvi("run --steps 2 -o t --snapshot twice/t"), 0);
    ck_assert_int_eq(fvi("run --steps 2 -o t --snapshot there"), 0);
    ck_assert_int_eq(
        fvi("run --steps 2 -o /dev/null --snapshot /dev/null/../null"), 1);
}
END_TEST

/* Data may be the only copy: of a force, of starts, of matrices, of a measured motion. */
START_TEST(no_output_takes_the_place_of_what_is_read)
{
    ck_assert_int_eq(
        shell("mkdir plate; ln -s plate here; echo 1 > start;"
              "printf '0 0\\n9 1\\n' > F; ln F F.svg;"
              "printf '%%%%MatrixMarket matrix coordinate real symmetric"
              "\\n1 1 1\\n1 1 2\\n' | tee plate/K.mtx > plate/M.mtx;"
              "cp -r plate kept; cp start F kept; cp start start.svg; seq 9 | sed 's/$/ 1/' > many"),
        0);
    ck_assert_refused("run --force 'sin(t) + file:F' --steps 9 -o ./F",
                      "fvi: -o: './F' is the file of --force, too");
    ck_assert_refused("run --force file:F --steps 9 --plot F.svg",
                      "fvi: --plot: 'F.svg' is the file of --force, too");
    ck_assert_refused("run --x0 @start --snapshot start",
                      "fvi: --snapshot: 'start' is the file of --x0, too");
    ck_assert_refused("run --p0 @start --checkpoint ./start",
                      "fvi: --checkpoint: './start' is the file of --p0, too");
    ck_assert_refused(
        "run --system plate --snapshot here/K.mtx",
        "fvi: --snapshot: 'here/K.mtx' is the file of --system, too");
    ck_assert_refused("exact --x0 @start -o start",
                      "fvi: -o: 'start' is the file of --x0, too");
    ck_assert_refused("gradient --x0 @start --forces start",
                      "fvi: --forces: 'start' is the file of --x0, too");
    ck_assert_refused("sweep --x0 @start --vary rho=0:1:2 -o start",
                      "fvi: -o: 'start' is the file of --x0, too");
    ck_assert_refused("fit F --curve ./F",
                      "fvi: --curve: './F' is the file of the data, too");
    ck_assert_refused("run --v0 @start --checkpoint start",
                      "fvi: --checkpoint: 'start' is the file of --v0, too");
    ck_assert_refused("gradient --v0 @start --forces start",
                      "fvi: --forces: 'start' is the file of --v0, too");
    ck_assert_refused("sweep --vary rho=@start -o start",
                      "fvi: -o: 'start' is the file of --vary, too");
    ck_assert_refused("response --omega @start -o start",
                      "fvi: -o: 'start' is the file of --omega, too");
    ck_assert_refused("response --omega @start.svg --plot start.svg",
                      "fvi: --plot: 'start.svg' is the file of --omega, too");
    ck_assert_refused("response --of ground --along @start --omega 1 -o start",
                      "fvi: -o: 'start' is the file of --along, too");
    ck_assert_refused("fit kept/F --fit rho --sigma @start -o start",
                      "fvi: -o: 'start' is the file of --sigma, too");
    ck_assert_refused("fit --design --fit rho --sigma @start -o start",
                      "fvi: -o: 'start' is the file of --sigma, too");
    ck_assert_refused("fit 'many : x0=@start' --fit rho --curve start",
                      "fvi: --curve: 'start' is the file of the data, too");
    ck_assert_refused("fit 'many : force=file:F' --fit rho -o F",
                      "fvi: -o: 'F' is the file of --force, too");
    ck_assert_int_eq(shell("cmp F kept/F && cmp start kept/start &&"
                           "cmp plate/K.mtx kept/K.mtx"),
                     0);
    ck_assert_int_eq(fvi("run --x0 @start --steps 2 -o F"), 0);
}
END_TEST

/* "-" is standard output, for each table; two tables there would be one file. */
START_TEST(a_dash_is_standard_output)
{
    ck_assert_int_eq(fvi("run --steps 3"), 0);
    char *want = strdup(out);
    ck_assert_int_eq(fvi("run --steps 3 -o -"), 0);
    ck_assert_str_eq(out, want);
    free(want);
    ck_assert(!exists("-"));
    ck_assert_int_eq(fvi("run --steps 3 -o ignored --snapshot -"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# unknown\tx\tp\n"));
    ck_assert_refused("run --steps 3 --snapshot -",
                      "fvi: --snapshot: '-' is the table's file, too");
    ck_assert_refused("run --checkpoint -",
                      "fvi: --checkpoint: '-' is not a file's name");
    ck_assert_refused("run --checkpoint .", "fvi: --checkpoint: '.' is not an ordinary file");
    ck_assert_refused("run --checkpoint /dev/null", "fvi: --checkpoint: '/dev/null' is not an ordinary file");
    ck_assert_int_eq(shell("ln -s /dev/null null.svg"), 0);
    ck_assert_refused("run --plot null.svg", "fvi: --plot: 'null.svg' is not an ordinary file");
    ck_assert_int_eq(fvi("run --steps 3 -o ./-"), 0);
    ck_assert(exists("-"));
    ck_assert_int_eq(shell("\"$FVI\" run -o - > /dev/full; test $? = 1"), 0);
    ck_assert_ptr_nonnull(strstr(err, "cannot write standard output"));
}
END_TEST

/* A compiler that does not end, be it by itself or by the file that it reads, ends with the
 * program, which a signal ends at once, and whose folder goes. */
START_TEST(a_compiler_that_hangs_keeps_no_program)
{
    write_file("hangs", "#!/bin/sh\necho $$ > compiler\nexec sleep 60\n");
    write_file("u.c", "int a;\n");
    ck_assert_int_eq(
        shell("chmod +x hangs; mkfifo pipe.c; mkdir -p tmp; "
              "export TMPDIR=$PWD/tmp; "
              "for cc in ./hangs cc; do u=u.c; "
              "test $cc = cc && u=pipe.c; "
              "CC=$cc \"$FVI\" run --potential $u & pid=$!; "
              "sleep 0.7; kill $pid; sleep 1.5; "
              "kill -9 $pid; wait $pid; test $? = 143 || exit 1; "
              "test -z \"$(ls tmp)\" || exit 1; done; "
              "! grep -q '^State:.[RSD]' /proc/$(cat compiler)/status"),
        0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: where it writes");
    ADD_CASE(suite, "files", files_are_complete_or_absent,
             what_was_there_is_respected, an_interrupted_run_leaves_no_file,
             a_killed_run_leaves_no_file, progress_is_shown_on_a_terminal,
             the_rows_before_a_failure_are_kept_on_standard_output_alone,
             an_open_file_is_written_to_where_it_stands,
             a_file_keeps_all_its_names, a_dash_is_standard_output,
             a_compiler_that_hangs_keeps_no_program,
             two_outputs_in_one_file_are_refused,
             no_output_takes_the_place_of_what_is_read);
    return run_suite_of_program(suite);
}
