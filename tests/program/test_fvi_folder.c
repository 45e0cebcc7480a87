/* tests/program/test_fvi_folder.c -- The program build/fvi: the files in the folder of a system, and the start of
 * the system.
 * Run alone: make test-fvi_folder */
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

/* ---- the past rl of a damper ---- */

#define RL_OF_FOLDER "run --system chain --steps 40 --p0 1,0,1 --columns x "
#define RL_OF_DAMPERS                                                          \
    "run --mass 1,2,0.5 --potential '2*(x1^2-x1*x2+x2^2-x2*x3+x3^2)' --steps 40 --p0 1,0,1 "    \
    "--columns x "

/* A damper that a start does not stretch has one past, rl or held, whatever its law. */
START_TEST(eq_19_1_an_unstretched_damper_of_a_folder_takes_the_past_rl)
{
    static const char *const methods[] = { "fvi",        "fvi-shifted",   "fvi-bdf2",
                                           "fvi-stable", "fvi-lobatto4d", "fvi-adaptive" },
                            *const laws[] = { "zener:1,0.3,2", "power:1,0.7",
                                              "power:1,0.7 + viscous:1", "power:1,0.3" },
                            *const dampers[] = { "x2-x1", "C2.mtx" };
    char line[400], held[20000], rl[20000];
    write_chain();
    ck_assert_int_eq(shell("rm chain/C.mtx"), 0);
    for (size_t i = 0; i < LEN(methods) * LEN(laws) * LEN(dampers); i++) {
        const char *method = methods[i % LEN(methods)], *law = laws[i / LEN(methods) % LEN(laws)],
                   *damper = dampers[i / LEN(methods) / LEN(laws)];
        if (*damper == 'C')
            write_file("chain/C2.mtx", HEAD "3 3 3\n1 1 1\n2 1 -1\n2 2 1\n");
        snprintf(line, sizeof line, RL_OF_FOLDER "--method %s --x0 1,1,0 --damper '%s : %s : held'",
                 method, damper, law);
        table_of(line, held, sizeof held);
        strcpy(strrchr(line, ':'), ": rl'");
        table_of(line, rl, sizeof rl);
        /* fvi-adaptive makes other steps where a power of x0 jumps */
        ck_assert_uint_eq(compare(held, rl, strstr(line, "adaptive") ? 1e-8 : 1e-12), 3 * 41);
    }
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

/* What it stretches moves by fvi as the same damper between points, and the others say why not. */
START_TEST(eq_19_1_a_stretched_damper_of_a_folder_takes_the_past_rl_of_the_paper)
{
    static const char *const laws[] = { "zener:1,0.3,2", "power:1,0.7", "power:1,0.3" };
    char line[400], rows[20000], other[20000];
    write_chain();
    ck_assert_int_eq(shell("rm chain/C.mtx"), 0);
    for (size_t i = 0; i < LEN(laws); i++) {
        snprintf(line, sizeof line, RL_OF_DAMPERS "--x0 1,0.5,0 --damper 'x2-x1 : %s : rl'", laws[i]);
        table_of(line, other, sizeof other);
        snprintf(line, sizeof line, RL_OF_FOLDER "--x0 1,0.5,0 --damper 'x2-x1 : %s : rl'", laws[i]);
        table_of(line, rows, sizeof rows);
        ck_assert_uint_eq(compare(rows, other, 1e-12), 3 * 41);
    }
    ck_assert_refused("run --system chain --x0 1,0.5,0 --method fvi-stable --damper "
                      "'x2-x1 : zener:1,0.3,2 : rl'",
                      "fvi: --damper: damper 1: the past rl wants one power of order 1 at most, or a "
                      "start that does not stretch the damper; fvi takes it");
    ck_assert_refused("gradient --system chain --x0 0 --method fvi-stable --damper "
                      "'x2-x1 : zener:1,0.3,2 : rl'",
                      "fvi: --damper: 'x2-x1 : zener:1,0.3,2 : rl' has no gradient: of the starts that "
                      "stretch it none is known; held has one");
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

/* By fvi a start without a motion is run with a warning, of a matrix and between points; a law that grows slower has
 * one. To a wanted error there is nothing to come near to. */
START_TEST(eq_19_2_a_stretched_damper_that_has_no_motion_is_warned_of)
{
    static const char *const runs[] = { RL_OF_FOLDER, RL_OF_DAMPERS };
    static const char warning[] = "fvi: warning: rl with an elongation != 0 and alpha > 1/2 has no solution; these rows "
                                  "depend on h and come near to no motion\n";
    char line[400];
    write_chain();
    ck_assert_int_eq(shell("rm chain/C.mtx"), 0);
    for (size_t i = 0; i < LEN(runs); i++) {
        static const char *const quiet[] = { "--x0 1,0.5,0 --damper 'x2-x1 : zener:1,0.3,2 : rl'",
                                             "--x0 1,1,0 --damper 'x2-x1 : power:1,0.7 : rl'",
                                             "--x0 1,0.5,0 --damper 'x2-x1 : power:1,0.7'" };
        snprintf(line, sizeof line, "%s --x0 1,0.5,0 --damper 'x2-x1 : power:1,0.7 : rl'", runs[i]);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_str_eq(err, warning);
        ck_assert_ptr_nonnull(strstr(out, "# warning = rl with an elongation"));
        for (size_t j = 0; j < LEN(quiet); j++) {
            snprintf(line, sizeof line, "%s %s", runs[i], quiet[j]);
            ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
            ck_assert_str_eq(err, "");
        }
        snprintf(line, sizeof line, "%s --x0 1,0.5,0 --damper 'x2-x1 : power:1,0.7 : rl' --method fvi --time 4 "
                 "--error 1e-2", runs[i]);
        ck_assert_refused_with(line, "fvi: --error: a damper whose order is above 1 has no solution with the past rl");
    }
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

/* Of a spring that was at 0 the force is there at t = 0, of a matrix and between points; a power of an
 * order below 1 has no finite one, and the row has the mean of the first step. */
START_TEST(eq_19_3_the_force_at_the_start_of_what_was_stretched)
{
    static const char *const methods[] = { "fvi", "fvi-stable", "fvi-lobatto4d" };
    char line[400];
    write_chain();
    ck_assert_int_eq(shell("rm chain/C.mtx"), 0);
    for (size_t i = 0; i < 2 * LEN(methods); i++) {
        const char *method = methods[i / 2];
        const char *of = i % 2 ? "--mass 1,2,0.5 --dimension 3" : "--system chain";
        snprintf(line, sizeof line, "run %s --steps 5 --h 1e-3 --method %s --x0 1,0.5,0 --p0 0 --columns "
                 "d1.force,d1.impulse --damper 'x2-x1 : spring:3 : rl'", of, method);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_near(cell(0, 0), -1.5, 1e-12, "%s", method);
        snprintf(line, sizeof line, "run %s --steps 5 --h 1e-3 --method %s --x0 1,0.5,0 --p0 0 --columns "
                 "d1.force,d1.impulse --damper 'x2-x1 : power:3,0.25 : rl'", of, method);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        ck_assert_near(cell(0, 0), cell(1, 1) / 1e-3, 1e-9, "%s", method);
        /* rho z0 t^(-1/2) / Gamma(1/2), but for what moves in 4 h, and of fvi for its order. Seen: 3e-2, 3e-3 and 2e-3 of it. */
        static const double bounds[] = { 0.1, 0.01, 0.005 };
        ck_assert_near(cell(4, 0), -1.5 / sqrt(M_PI * 4e-3), bounds[i / 2] * 13, "%s", method);
    }
    ck_assert_int_eq(shell("rm -r chain"), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: the folder of a system");
    ADD_CASE(suite, "folders", a_system_is_at_rest_and_its_head_says_what_acts,
             a_file_of_a_folder_that_is_not_read_is_refused,
             a_pulse_of_a_folder_is_seen_between_the_rows,
             eq_19_1_an_unstretched_damper_of_a_folder_takes_the_past_rl,
             eq_19_1_a_stretched_damper_of_a_folder_takes_the_past_rl_of_the_paper,
             eq_19_2_a_stretched_damper_that_has_no_motion_is_warned_of,
             eq_19_3_the_force_at_the_start_of_what_was_stretched);
    return run_suite_of_program(suite);
}
