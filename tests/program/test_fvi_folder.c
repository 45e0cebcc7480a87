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

int main(void)
{
    Suite *suite = suite_create("the program fvi: the folder of a system");
    ADD_CASE(suite, "folders", a_system_is_at_rest_and_its_head_says_what_acts,
             a_file_of_a_folder_that_is_not_read_is_refused);
    return run_suite_of_program(suite);
}
