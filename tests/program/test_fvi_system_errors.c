/* tests/program/test_fvi_system_errors.c -- The program build/fvi: folders that are no system, and options that a
 * system refuses.
 * Run alone: make test-fvi_system_errors */
#define _GNU_SOURCE
#include "program.h"
#include "folder.h"

#include <string.h>

START_TEST(bad_folders_are_refused_with_file_and_line)
{
    static const struct {
        const char *file, *text, *complaint;
    } bad[] = {
        { "M.mtx", "", "M.mtx: cannot be read, or is empty" },
        { "M.mtx", HEAD "3 3 3\n1 1 1\n2 2 nan\n3 3 1\n",
          "M.mtx:4:5: not a row, a column and a finite decimal number" },
        { "M.mtx", HEAD "3 3 3\n1 1 1\n2 2 -1\n3 3 1\n",
          "M.mtx:4: not positive definite" },
        { "M.mtx", HEAD "3 3 4\n1 1 1\n2 2 1\n2 1 2\n3 3 1\n",
          "M.mtx:5: not positive definite" },
        { "M.mtx", HEAD "3 3 2\n1 1 1\n3 3 1\n",
          "M.mtx: not positive definite" },
        { "M.mtx", HEAD "3 3 6\n1 1 1\n2 2 1\n3 3 1\n2 1 .9\n3 2 .9\n3 1 -.9\n",
          "M.mtx: not positive definite" },
        { "M.mtx", HEAD "3 3 3\n1 1 1\n3 3 1\n",
          "M.mtx:2: fewer entries follow than it says" },
        { "K.mtx", HEAD "% a size\n2 2 2\n1 1 1\n2 2 1\n",
          "K.mtx:3: not of the size of M.mtx" },
        { "C.mtx", HEAD "2 2 2\n1 1 1\n2 2 1\n",
          "C.mtx:2: not of the size of M.mtx" },
        { "K.mtx", HEAD "3 3 4\n1 1 1\n2 2 1\n2 1 2\n1 2 2\n",
          "K.mtx:6: an entry that stands twice; of a symmetric matrix only one "
          "triangle is given" },
        { "K.mtx",
          "%%MatrixMarket matrix coordinate real general\n3 3 2\n1 2 "
          "1\n2 1 2\n",
          "K.mtx:4: the matrix is not symmetric: entry (j, i) is another one" },
        { "K.mtx",
          "%%MatrixMarket matrix coordinate pattern symmetric\n3 3 "
          "1\n1 1\n",
          "K.mtx:1: a pattern without numbers" },
        { "C.mtx", HEAD "3 3 1\n2 1 0.5\n",
          "C.mtx:3: not positive semidefinite: it would feed the motion" },
        { "f.tsv", "t f4\n0 1\n",
          "f.tsv:1:3: a name that is none of the "
          "unknowns'" },
        { "f.tsv", "t f1e0\n0 1\n",
          "f.tsv:1:3: a name that is none of the unknowns'" },
        { "f.tsv", "t f1 f1\n0 1 1\n",
          "f.tsv:1:6: an unknown that is named "
          "twice" },
        { "f.tsv", "0 1 2 3\n1 1 2\n", "f.tsv:2:6: a number is missing" },
        { "f.tsv", "0 1 2 3\n1 1 2 3 4\n",
          "f.tsv:2:9: more numbers than "
          "columns" },
        { "f.tsv", "0 1 2 3\n0 1 2 3\n", "f.tsv:2:1: t does not increase" },
        { "f.tsv", "0 1 2 inf\n", "f.tsv:1:7: not a finite decimal number" },
        { "f.tsv", "# t\n", "f.tsv: has no rows" },
        { "f.tsv", "t\n0\n30\n", "f.tsv:1:1: names are t, then f1, f2, ..." },
        { "f.tsv", "t f1\n0 1\nt f2\n30 1\n", "f.tsv:3:1: not a finite decimal number" },
        { "f.tsv", "0 1 2 3\ntrash 1\n30 1 2 3\n",
          "f.tsv:2:1: not a finite decimal number" },
        { "C.mtx", HEAD "3 3 3\n1 1 1\n2 2 0\n3 3 -1\n",
          "C.mtx:5: not positive semidefinite: it would feed the motion" },
        { "C.mtx", HEAD "3 3 2\n1 1 1\n2 2 -1e-15\n",
          "C.mtx:4: not positive semidefinite: it would feed the motion" },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        char name[40], complaint[200];
        write_chain();
        snprintf(name, sizeof name, "chain/%s", bad[i].file);
        write_file(name, bad[i].text);
        snprintf(complaint, sizeof complaint, "--system: chain/%s",
                 bad[i].complaint);
        ck_assert_msg(fvi("run --system chain -o nothing") == 2, "%s",
                      bad[i].complaint);
        ck_assert_msg(strncmp(err + 5, complaint, strlen(complaint)) == 0,
                      "%s: %s", complaint, err);
        ck_assert(!exists("nothing"));
        ck_assert_int_eq(shell("rm -r chain"), 0);
    }
    ck_assert_refused("run --system nowhere",
                      "fvi: --system: nowhere/M.mtx: cannot be read");
    write_chain();
    write_file("chain/K.mtx", HEAD "3 3 1\n2 2 -1e6\n");
    ck_assert_int_eq(fvi("run --system chain --method fvi-stable -o nothing"),
                     1);
    ck_assert_str_eq(err,
                     "fvi: --system: the matrix of a step is not positive "
                     "definite: K is negative somewhere, and h too long for "
                     "it\n");
    ck_assert(!exists("nothing"));
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

START_TEST(what_a_system_replaces_or_no_method_takes_is_refused)
{
    write_chain();
    ck_assert_refused("run --system chain --mass 1",
                      "fvi: --system: not together with --mass");
    ck_assert_refused("run --system chain --rho 1",
                      "fvi: --system: not together with --rho");
    ck_assert_refused("run --system chain --potential free",
                      "fvi: --system: not together with --potential");
    ck_assert_refused("run --system chain --dimension 3",
                      "fvi: --system: not together with --dimension");
    ck_assert_refused("run --system chain --method fvi-lobatto4",
                      "fvi: --method: 'fvi-lobatto4' takes no matrices; fvi, "
                      "fvi-shifted, fvi-bdf2, fvi-stable, fvi-lobatto2d to 8d and fvi-adaptive do");
    ck_assert_refused("fit --system chain d.tsv",
                      "fvi: --fit: 'rho' is none of alpha, x0, p0, offset, drift");
    ck_assert_int_eq(fvi("sweep --system chain --vary alpha=0.1:0.9:3 --method "
                         "fvi-stable --columns x"),
                     0);
    write_file("chain/C.mtx", HEAD "3 3 0\n");
    ck_assert_int_eq(fvi("run --system chain --steps 3"), 0);
    ck_assert_int_eq(shell("rm chain/C.mtx"), 0);
    ck_assert_int_eq(fvi("run --system chain --steps 3"), 0);
    ck_assert_int_eq(shell("ln -s nowhere chain/C.mtx"), 0);
    ck_assert_refused("run --system chain --steps 3",
                      "fvi: --system: chain/C.mtx: cannot be read");
    ck_assert_int_eq(shell("mv chain/C.mtx chain/f.tsv"), 0);
    ck_assert_refused("run --system chain --steps 3",
                      "fvi: --system: cannot read 'chain/f.tsv': No such file or directory");
    ck_assert_int_eq(shell("rm chain/f.tsv"), 0);
    write_file("chain/f.tsv", "0 1 2 3\n1 1 2 3\n"); /* the program does not choose between `none` and the file */
    ck_assert_refused("run --system chain --time 1 --steps 3 --force none",
                      "fvi: --force: 'none': there is chain/f.tsv, too");
    ck_assert_int_eq(fvi("run --system chain --time 1 --steps 3"), 0);
    ck_assert_int_eq(shell("rm chain/f.tsv"), 0);
}
END_TEST

START_TEST(dampers_of_a_folder_that_are_none_are_refused)
{
    write_chain();
    ck_assert_int_eq(shell("rm -f chain/f.tsv"), 0);
    write_file("chain/C2.mtx", HEAD "3 3 1\n2 2 1\n");
    ck_assert_refused("run --system chain --damper 'C2.mtx : power:1,0.3'",
                      "fvi: --system: chain/C.mtx would not be read: M.mtx, K.mtx, f.tsv and "
                      "the files that a damper names are");
    ck_assert_refused("run --system chain",
                      "fvi: --system: chain/C2.mtx would not be read: M.mtx, K.mtx, C.mtx and "
                      "f.tsv are");
    ck_assert_int_eq(fvi("run --system chain --damper 'C2.mtx : power:1,0.3' --damper "
                         "'C.mtx : zener:1,0.3,2' --steps 3"),
                     0);
    ck_assert_int_eq(shell("rm chain/C.mtx"), 0);
    ck_assert_refused("run --system chain --damper 'C2.mtx : power:1,0.3' --alpha 0.3",
                      "fvi: --damper: not together with --alpha");
    ck_assert_refused("run --system chain --damper 'C2.mtx : power:1,0.3' --damper "
                      "'Q.mtx : viscous:1'",
                      "fvi: --system: chain/Q.mtx: cannot be read");
    ck_assert_refused("run --system chain --damper '../chain/C2.mtx : viscous:1'",
                      "fvi: --damper: '../chain/C2.mtx' is not the name of a file of the "
                      "folder");
    ck_assert_int_eq(shell("mv chain/C2.mtx chain/C.mtx"), 0);
    ck_assert_refused("run --system chain --damper 'C.mtx : viscous:1' --damper "
                      "'x2-x1^2 : viscous:1'",
                      "fvi: --damper: 'x2-x1^2' is not linear: without --system it may be");
    ck_assert_refused("run --system chain --damper 'C.mtx : viscous:1' --damper "
                      "'x2-t : viscous:1'",
                      "fvi: --damper: 'x2-t' has t in it: a structure stands still");
    ck_assert_refused("run --system chain --damper 'C.mtx : power:1,2'",
                      "fvi: --damper: 'power:1,2': power:R,A with R >= 0 and 0 <= A <= 1");
    ck_assert_refused("run --system chain --damper 'C.mtx : davidson:1,0.49,1' --memory "
                      "exponentials --steps 300",
                      "fvi: --memory: 'exponentials': of --damper 'C.mtx : "
                      "davidson:1,0.49,1' there are none with this step; 'auto' sums it all");
    ck_assert_refused("run --system chain --damper 'C.mtx : symbol:0.4*s^0.6/(1+2*s)' --method fvi-lobatto3d",
                      "fvi: --damper: damper 1: the tail of its law is no sum of decaying modes; fvi and fvi-stable "
                      "take it");
    write_file("chain/C.mtx", HEAD "3 3 1\n2 2 -1\n");
    ck_assert_refused("run --system chain --damper 'C.mtx : viscous:1'",
                      "fvi: --system: chain/C.mtx:3: not positive semidefinite: it would feed "
                      "the motion");
    write_file("chain/C.mtx", HEAD "2 2 1\n2 2 1\n");
    ck_assert_refused("run --system chain --damper 'C.mtx : viscous:1'",
                      "fvi: --system: chain/C.mtx:2: not of the size of M.mtx");
    write_chain();
}
END_TEST

/* What fvi-adaptive does not take of matrices is named alone, with the option that asks for it. */
START_TEST(a_damping_that_fvi_adaptive_does_not_take_is_named_with_its_option)
{
#define ADAPTIVE "run --system chain --method fvi-adaptive --steps 3 --x0 1 "
    static const char *const of_mass = "a damping of order 2 is a mass: fvi-lobatto2d to 8d take it "
                                       "with matrices, fvi-adaptive does not\n",
                            *const of_pole = "damper 1: a pole of this law is too near to its cut, or "
                                             "off it, for modes of variable steps; fvi-stable takes it\n";
    const struct {
        const char *words, *option, *reason;
    } wrong[] = {
        { "--alpha 1", "alpha", of_mass },
        { "--alpha 1 --error 1e-3", "alpha", of_mass },
        { "--damping power:1,1", "damping", of_mass },
        { "--damping zener:1,0.6,2", "damping", of_pole },
        { "--damper 'x1 : power:1,1'", "damper", of_mass },
        { "--damper 'x1 : zener:1,0.6,2'", "damper", of_pole },
        { "--damper 'x1 : zener:1,0.6,2' --error 1e-3", "damper", of_pole },
    };
    char line[300], said[300];
    write_chain();
    for (size_t i = 0; i < LEN(wrong); i++) {
        if (strstr(wrong[i].words, "--damper"))
            shell("rm -f chain/C.mtx");
        snprintf(line, sizeof line, ADAPTIVE "%s", wrong[i].words);
        snprintf(said, sizeof said, "fvi: --%s: %s", wrong[i].option, wrong[i].reason);
        ck_assert_refused_with(line, said);
    }
    ck_assert_int_eq(fvi("sweep --system chain --method fvi-adaptive --steps 3 --x0 1 --vary h=0.1,0.2 "
                         "--damper 'x1 : zener:1,0.6,2' -o none"),
                     1);
    snprintf(said, sizeof said, "fvi: with h = 0.1: --damper: %s", of_pole);
    ck_assert_str_eq(err, said);
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: no systems of matrices");
    ADD_CASE(suite, "errors", bad_folders_are_refused_with_file_and_line,
             what_a_system_replaces_or_no_method_takes_is_refused,
             dampers_of_a_folder_that_are_none_are_refused,
             a_damping_that_fvi_adaptive_does_not_take_is_named_with_its_option);
    return run_suite_of_program(suite);
}
