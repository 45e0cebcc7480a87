/* tests/program/test_fvi_problem_file.c -- The words of the command line in a file.
 * Run alone: make test-fvi_problem_file */
#define _GNU_SOURCE
#include "program.h"

static const char frame[] = "# a frame of two storeys on a springpot\n"
                            "potential = k*x1^2/2 + k*(x2-x1)^2/2\n"
                            "let k=100\n"
                            "\n"
                            "  damper  base=x1 : power:5,0.3\r\n"
                            "ground = sin(8*t)\n"
                            "x0 = 0\n"
                            "p0=0\n"
                            "method fvi-lobatto4\n"
                            "h 0.02\n"
                            "time 10\n"
                            "columns t,drift=x2-x1,floor=a2+ag,base.force,work";

/* What a file says is what the same words say, in every command; others may be added. */
START_TEST(a_file_says_what_its_words_say)
{
    write_file("frame", frame);
    ck_assert_int_eq(fvi("run --potential 'k*x1^2/2 + k*(x2-x1)^2/2' --let k=100 "
                         "--damper 'base=x1 : power:5,0.3' --ground 'sin(8*t)' "
                         "--x0 0 --p0 0 --method fvi-lobatto4 --h 0.02 --time 10 "
                         "--columns t,drift=x2-x1,floor=a2+ag,base.force,work"),
                     0);
    char *want = strdup(out);
    ck_assert_msg(fvi("run --problem frame") == 0, "%s", err);
    ck_assert(strcmp(out, want) == 0);
    ck_assert_int_eq(fvi("run --problem=frame -o table"), 0);
    ck_assert_int_eq(shell("cat table"), 0);
    ck_assert(strcmp(out, want) == 0);
    free(want);
    ck_assert_int_eq(fvi("run --problem frame --every 250"), 0);
    ck_assert_uint_eq(count_rows(), 3);
    ck_assert_near(cell(2, 1), -0.02503333860038799, 1e-11, "drift");
    write_file("words", "alpha 0.3\nsteps 4\nx0 1\n");
    static const char *const commands[] = { "run", "exact", "gradient",
                                            "sweep --vary rho=1,2" };
    for (size_t i = 0; i < LEN(commands); i++) {
        char line[120];
        snprintf(line, sizeof line, "%s --alpha 0.3 --steps 4 --x0 1",
                 commands[i]);
        ck_assert_int_eq(fvi(line), 0);
        want = strdup(out);
        snprintf(line, sizeof line, "%s --problem words", commands[i]);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_str_eq(out, want);
        free(want);
    }
    write_file("count", "count 3\n-o here\n");
    ck_assert_int_eq(fvi("coefficients --problem count"), 2);
    write_file("count", "count 3\no here\n");
    ck_assert_int_eq(fvi("coefficients --problem count"), 0);
    ck_assert(exists("here"));
    write_file("rows", "vary rho=1,2\nrows\nevery 2\nsteps 4\n");
    ck_assert_int_eq(fvi("sweep --problem rows"), 0);
    ck_assert_uint_eq(count_rows(), 6);
}
END_TEST

START_TEST(a_bad_file_is_refused)
{
    static const struct {
        const char *text, *said;
    } cases[] = {
        { "--alpha 0.3\n", "--problem: bad, line 1: '--alpha 0.3' does not begin "
                           "with the name of an option, without --" },
        { "alpha 0.3\n= 3\n", "--problem: bad, line 2: '= 3' does not begin" },
        { "alpha:0.3\n", "--problem: bad, line 1: 'alpha:0.3' does not" },
        { "problem bad\n", "--problem: bad, line 1: a file in a file" },
        { "alhpa 0.3\n", "--alhpa=0.3: no such option; did you mean --alpha?" },
        { "rho =\n", "--rho: '' is not a finite decimal number" },
        { "alpha 0.4\n", "--alpha: given twice, as '0.4' and as '0.3'" },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        char said[200];
        write_file("bad", cases[i].text);
        ck_assert_msg(fvi("run --problem bad --alpha 0.3") == 2, "%s",
                      cases[i].text);
        snprintf(said, sizeof said, "fvi: %s", cases[i].said);
        ck_assert_str_eq(out, "");
        ck_assert_msg(strncmp(err, said, strlen(said)) == 0, "%s", err);
    }
    ck_assert_refused("run --problem none",
                      "fvi: --problem: cannot read 'none': No such file or "
                      "directory\nTry 'fvi run --help'.");
    ck_assert_refused("exact --problem", "fvi: --problem: a value is missing");
    ck_assert_int_eq(shell("printf 'steps 2\\0 3\\n' > bad"), 0);
    ck_assert_refused("run --problem bad", "fvi: --problem: bad, line 1: a NUL byte");
    write_file("bad", "steps 3\n");
    ck_assert_refused("run --problem bad -o bad",
                      "fvi: -o: 'bad' is the file of --problem, too");
    ck_assert_refused("run --problem /dev/zero", "fvi: --problem: /dev/zero, line 1: a NUL byte");
}
END_TEST

/* As an editor on Windows writes it: a mark of its encoding, and \r\n. */
START_TEST(a_file_from_windows_is_read)
{
    ck_assert_int_eq(fvi("run --alpha 0.3 --rho 0.4 --steps 3 --columns x --format csv"), 0);
    char *same = strdup(out);
    ck_assert_ptr_nonnull(same);
    write_file("windows", "\xef\xbb\xbf" "alpha 0.3\r\nrho 0.4\r\n");
    ck_assert_int_eq(fvi("run --problem windows --steps 3 --columns x --format csv"), 0);
    ck_assert_str_eq(out, same);
    free(same);
}
END_TEST

/* A checkpoint holds the words, and not the file: --steps may be another number there. */
START_TEST(a_run_goes_on_from_a_file_with_more_steps)
{
    write_file("long", "alpha 0.3\nsteps 20\nmemory direct\ncheckpoint state\n");
    ck_assert_int_eq(fvi("run --problem long"), 0);
    write_file("long", "alpha 0.3\nsteps 30\nmemory direct\ncheckpoint state\n"
                       "continue\n");
    ck_assert_msg(fvi("run --problem long") == 0, "%s", err);
    ck_assert_uint_eq(count_rows(), 10);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: --problem");
    ADD_CASE(suite, "problem", a_file_says_what_its_words_say,
             a_bad_file_is_refused, a_file_from_windows_is_read, a_run_goes_on_from_a_file_with_more_steps);
    return run_suite_of_program(suite);
}
