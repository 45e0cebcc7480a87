/* tests/program/test_fvi_folder.c -- The program build/fvi: what stands in the folder of a
 * system, and how the system begins.   Run alone: make test-fvi_folder */
#define _GNU_SOURCE
#include "program.h"
#include "folder.h"

/* A building stands still until its forces move it, whatever a body alone does, and the head
 * says which forces act. */
START_TEST(a_system_is_at_rest_and_its_head_says_what_acts)
{
    write_chain();
    ck_assert_int_eq(fvi("run --system chain --steps 5 --method fvi-stable"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "# x0 = 0\n# p0 = 0\n"));
    ck_assert_ptr_nonnull(strstr(out, "# force = none\n"));
    for (size_t i = 0; i < 6 * 8; i++)
        ck_assert(i % 8 == 0 || cell(i / 8, i % 8) == 0);
    write_file("chain/f.tsv", "t f2\n0 1\n30 2\n");
    ck_assert_int_eq(fvi("run --system chain --steps 5 --x0 0 --p0 0"), 0);
    char *given = strdup(out);
    ck_assert_int_eq(fvi("run --system chain --steps 5"), 0);
    ck_assert_str_eq(out, given);
    free(given);
    ck_assert_ptr_nonnull(strstr(out, "# force = f.tsv of chain\n"));
    ck_assert(cell(5, 2) > 0);
    ck_assert_int_eq(fvi("run --system chain --steps 5 --format json"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\"force\": \"f.tsv of chain\""));
    ck_assert_int_eq(fvi("gradient --system chain --steps 5"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# force = f.tsv of chain\n"));
    ck_assert_int_eq(fvi("sweep --system chain --vary alpha=0:1:3 --steps 5"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "# force = f.tsv of chain\n"));
    ck_assert_int_eq(fvi("run --system chain --steps 5 --checkpoint s"), 0);
    ck_assert_int_eq(
        fvi("run --system chain --steps 9 --checkpoint s --continue"), 0);
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

/* A file that nobody would read is named, not passed by; pictures, tables and notes may
 * stand in the folder. */
START_TEST(a_file_of_a_folder_that_is_not_read_is_refused)
{
    static const char *const strangers[] = {
        "f.csv",  "F.tsv", "f.txt",         "k.mtx",    "M.MTX",
        "C2.mtx", "c.dat", "Stiffness.tsv", "force.csv"
    };
    write_chain();
    for (size_t i = 0; i < LEN(strangers); i++) {
        char place[60], said[200];
        snprintf(place, sizeof place, "chain/%s", strangers[i]);
        write_file(place, "0 0\n30 0\n");
        snprintf(said, sizeof said,
                 "fvi: --system: %s would not be read: M.mtx, K.mtx, C.mtx and "
                 "f.tsv are\n",
                 place);
        ck_assert_refused_with("run --system chain --steps 5", said);
        snprintf(said, sizeof said, "rm %s", place);
        ck_assert_int_eq(shell(said), 0);
    }
    ck_assert_int_eq(shell("cd chain; touch notes.txt f.c K.svg table.tsv "
                           "M.mtx.bak .f.csv mass"),
                     0);
    ck_assert_int_eq(fvi("run --system chain --steps 5"), 0);
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

/* A pulse of f.tsv between two rows of the answer is as little missed by --error as that of
 * a table of --force. */
START_TEST(a_pulse_of_a_folder_is_seen_between_the_rows)
{
    const char *const pulse = "0 0\n7.311 0\n7.3115 1000\n7.312 0\n30 0\n";
    char same[200];
    ck_assert_int_eq(shell("mkdir -p one"), 0);
    write_file("one/M.mtx", HEAD "1 1 1\n1 1 1\n");
    write_file("one/K.mtx", HEAD "1 1 1\n1 1 1\n");
    write_file("one/C.mtx", HEAD "1 1 1\n1 1 0.2\n");
    write_file("pulse", pulse);
    snprintf(same, sizeof same, "t f1\n%s", pulse);
    write_file("one/f.tsv", same);
    ck_assert_int_eq(fvi("run --method fvi --alpha 0.3 --x0 1 --p0 0 --time 20 "
                         "--steps 20 --error 1e-3 --force file:pulse"),
                     0);
    const double x = cell(20, 1);
    ck_assert_int_eq(
        fvi("run --method fvi --alpha 0.3 --x0 1 --time 20 --steps "
            "20 --error 1e-3 --system one"),
        0);
    ck_assert_near(cell(20, 1), x, 1e-12, "0.13 off without a bound");
    ck_assert_int_eq(shell("rm -r one pulse"), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: the folder of a system");
    ADD_CASE(suite, "folders", a_system_is_at_rest_and_its_head_says_what_acts,
             a_file_of_a_folder_that_is_not_read_is_refused,
             a_pulse_of_a_folder_is_seen_between_the_rows);
    return run_suite_of_program(suite);
}
