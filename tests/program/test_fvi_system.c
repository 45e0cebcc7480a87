/* tests/program/test_fvi_system.c -- The program build/fvi: systems of matrices.
 * Run alone: make test-fvi_system */
#define _GNU_SOURCE
#include "program.h"
#include "folder.h"

#include <string.h>
#include <suitesparse/cholmod.h>

/* The same operations but for the order of sums: as in test_structures.c. A power among the
 * laws of damping is summed another way. */
START_TEST(a_folder_of_matrices_is_the_system_that_it_says)
{
    static char one[1 << 16], other[1 << 16];
    static const struct {
        const char *system, *plain;
    } words[] = { { "--method fvi --alpha 0.3", "--method fvi --alpha 0.3" },
                  { "--method fvi-shifted --alpha 0.7",
                    "--method fvi-shifted --alpha 0.7" },
                  { "--method fvi-bdf2 --damping power:1,0.3",
                    "--method fvi-bdf2 --alpha 0.3" },
                  { "--method fvi-stable --derivative rl --alpha 0.3",
                    "--method fvi-stable --derivative rl --alpha 0.3" } };
    write_chain();
    for (size_t i = 0; i < LEN(words); i++) {
        const char *same = "--x0 1,0,-1 --p0 0 --force cosine:1,2 --time 3 "
                           "--steps 60";
        char line[600];
        snprintf(line, sizeof line, "run --system chain %s %s", same,
                 words[i].system);
        table_of(line, one, sizeof one);
        snprintf(line, sizeof line,
                 "run --potential chain:3,2,0 --mass 1,2,0.5 --rho 0.3,0,0.1 "
                 "%s %s",
                 same, words[i].plain);
        table_of(line, other, sizeof other);
        ck_assert_uint_eq(compare(one, other, 1e-12), 61 * 8);
    }
}
END_TEST

/* C.mtx alone, by --alpha, is one damper of it, to the bit; and rows are the matrix that they make, to
 * the order of sums. A checkpoint keeps the history of each. */
START_TEST(dampers_of_a_folder_are_files_and_rows)
{
    static char one[1 << 16], other[1 << 16];
    static const char *const methods[] = { "fvi", "fvi-shifted", "fvi-bdf2",
                                           "fvi-stable" };
    write_chain();
    for (size_t i = 0; i < LEN(methods); i++) {
        char line[600];
        const char *same = "--x0 1,0,-1 --p0 0,0.5,0 --time 6 --steps 300";
        snprintf(line, sizeof line, "run --system chain %s --method %s --alpha 0.3", same,
                 methods[i]);
        table_of(line, one, sizeof one);
        snprintf(line, sizeof line,
                 "run --system chain %s --method %s --damper 'C.mtx : power:1,0.3'", same,
                 methods[i]);
        table_of(line, other, sizeof other);
        ck_assert_uint_eq(compare(one, other, 0), 301 * 8);
        ck_assert_int_eq(shell("mkdir -p bare && cp chain/M.mtx chain/K.mtx bare"), 0);
        snprintf(line, sizeof line,
                 "run --system bare %s --method %s --damper 'left=x1 : power:0.3,0.3' "
                 "--damper 'a*(x3 + 0*x2) : power:0.1,0.3 : held' --let a=1",
                 same, methods[i]);
        table_of(line, other, sizeof other);
        ck_assert_uint_eq(compare(one, other, 1e-12), 301 * 8);
        snprintf(line + strlen(line), sizeof line - strlen(line), " --checkpoint state");
        ck_assert_int_eq(shell("rm -f state"), 0);
        ck_assert_int_eq(fvi(line), 0);
    }
}
END_TEST

START_TEST(forces_come_from_a_table_of_unknowns)
{
    static char one[1 << 16], other[1 << 16];
    write_chain();
    table_of("run --system chain --x0 1 --p0 0.5 --method fvi-stable --force "
          "'step:1,9' --steps "
          "20",
          other, sizeof other);
    write_file("chain/f.tsv", "# the same to all\nt\tf1\tf3\tf2\n0\t1\t1\t1\n"
                              "3\t1\t1\t1\n");
    table_of("run --system chain --x0 1 --p0 0.5 --method fvi-stable --steps 20",
          one, sizeof one);
    ck_assert_uint_eq(compare(one, other, 0), 21 * 8);
    write_file("chain/f.tsv", "0 1 1 1\n1.5 1 1 1\n3 1 1 1\n");
    table_of("run --system chain --x0 1 --p0 0.5 --method fvi-stable --steps 20",
          one, sizeof one);
    ck_assert_uint_eq(compare(one, other, 0), 21 * 8);
    /* 2 t on the second alone: linear in between, so two rows are enough */
    write_file("chain/f.tsv", "t f2\n0 0\n2 4\n");
    table_of("run --system chain --steps 20 --x0 0 --p0 0 --columns p --unknowns "
          "2 --h 0.01",
          one, sizeof one);
    double p = 0; /* (9.4) from rest: the first rows are those of h F alone */
    const char *at = one;
    for (int k = 0; k <= 3; k++) {
        p += k > 0 ? 0.01 * 2 * 0.01 * k : 0;
        ck_assert_near(strtod(at, (char **)&at), p, 2e-6, "p_%d", k);
    }
    ck_assert_refused("run --system chain --force step:1,2 --steps 9",
                      "fvi: --force: 'step:1,2': there is chain/f.tsv, too");
    ck_assert_refused("run --system chain",
                      "fvi: --system: chain/f.tsv: from t = 0 "
                      "to 2, the run from 0 to 20");
    ck_assert_int_eq(shell("rm chain/f.tsv"), 0);
}
END_TEST

START_TEST(unknowns_are_chosen_and_all_of_them_kept_in_a_snapshot)
{
    static char one[1 << 16], file[1 << 12];
    write_chain();
    table_of("run --system chain --x0 1 --p0 0.5 --steps 4 --columns t,p,x "
          "--unknowns 3,1 "
          "--snapshot end.tsv",
          one, sizeof one);
    ck_assert_ptr_nonnull(strstr(out, "# t\tp3\tp1\tx3\tx1\n"));
    ck_assert_ptr_nonnull(strstr(out, "# solver = band\n"));
    ck_assert_int_eq(
        fvi("run --system chain --x0 1 --p0 0.5 --steps 1 --kappa 1"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# solver = diagonal\n"));
    char path[PATH_MAX + 20];
    snprintf(path, sizeof path, "%s/end.tsv", folder);
    read_file(path, file, sizeof file);
    double last[5], at_end[3][3];
    const char *row = one, *line = file;
    for (int k = 0; k <= 4; k++)
        for (int i = 0; i < 5; i++)
            last[i] = strtod(row, (char **)&row);
    ck_assert_int_eq(strncmp(line, "# t = 0.4", 9), 0);
    line = strchr(strchr(line, '\n') + 1, '\n');
    for (int i = 0; i < 9; i++)
        at_end[i / 3][i % 3] = strtod(line, (char **)&line);
    ck_assert(at_end[0][0] == 1 && at_end[2][0] == 3);
    ck_assert(at_end[2][2] == last[1] && at_end[0][2] == last[2]);
    ck_assert(at_end[2][1] == last[3] && at_end[0][1] == last[4]);
    table_of("run --potential chain:3,1,0 --columns x --unknowns 2 --steps 1", one,
          sizeof one);
    ck_assert_ptr_nonnull(strstr(out, "# x2\n1\n"));
    ck_assert_refused("run --unknowns 2",
                      "fvi: --unknowns: '2' is not a list of "
                      "numbers from 1 to 1");
    ck_assert_refused(
        "run --system chain --unknowns 1,4",
        "fvi: --unknowns: '1,4' is not a list of numbers from 1 to 3");
    ck_assert_refused("run --system chain --unknowns 2,2",
                      "fvi: --unknowns: 2 stands twice in '2,2'");
    ck_assert_refused(
        "run --system chain --unknowns 1,",
        "fvi: --unknowns: '1,' is not a list of numbers from 1 to 3");
    ck_assert_int_eq(shell("mkdir -p bare && cp chain/M.mtx chain/K.mtx bare"), 0);
    ck_assert_refused("run --system bare --alpha 0.3", /* which would change nothing */
                      "fvi: --alpha: '0.3' damps nothing: there is no C.mtx in bare");
    ck_assert_refused("run --system bare --order 0.5",
                      "fvi: --order: '0.5' damps nothing: there is no C.mtx in bare");
    ck_assert_refused("poles --system bare --damping viscous:1",
                      "fvi: --damping: 'viscous:1' damps nothing: there is no C.mtx in bare");
    ck_assert_refused("run --snapshot a -o a",
                      "fvi: --snapshot: 'a' is the table's file, too");
    ck_assert_refused("run --snapshot a --checkpoint a",
                      "fvi: --checkpoint: 'a' is the file of --snapshot, too");
}
END_TEST

START_TEST(a_system_goes_on_from_a_checkpoint_with_the_same_digits)
{
    static char whole[1 << 16], parts[1 << 16], rest[1 << 16];
    write_chain();
    table_of("run --system chain --x0 1 --p0 0.5 --method fvi-stable --alpha 0.3 "
          "--memory direct "
          "--steps 60",
          whole, sizeof whole);
    table_of("run --system chain --x0 1 --p0 0.5 --method fvi-stable --alpha 0.3 "
          "--memory direct "
          "--steps 25 --checkpoint saved",
          parts, sizeof parts);
    table_of("run --system chain --x0 1 --p0 0.5 --method fvi-stable --alpha 0.3 "
          "--memory direct "
          "--steps 60 --checkpoint saved --continue",
          rest, sizeof rest);
    strcat(parts, rest);
    ck_assert_str_eq(whole, parts);
    write_file("chain/C.mtx", HEAD "3 3 2\n1 1 0.3\n3 3 0.2\n");
    ck_assert_refused_with(
        "run --system chain --x0 1 --p0 0.5 --method fvi-stable --alpha 0.3 "
        "--memory direct --steps 80 --checkpoint saved "
        "--continue",
        "fvi: --continue: saved: the file chain/C.mtx has changed\n");
}
END_TEST

/* (18.2): all rows are within the error of much finer ones, by the method that is named or by
 * fvi-stable. A body that is left at rest has no error to look at: (18.6) ends the search
 * where the steps resolve the fastest mode. */
START_TEST(eq_18_2_a_system_is_run_to_a_wanted_error)
{
    static char found[4096], fine[4096];
    write_chain();
    ck_assert_int_eq(shell("rm -f chain/f.tsv"), 0);
    table_of("run --system chain --x0 1 --p0 0.5 --alpha 0.3 --time 4 --steps "
          "16384 --every 4096 "
          "--method fvi-stable --columns x",
          fine, sizeof fine);
    table_of("run --system chain --x0 1 --p0 0.5 --alpha 0.3 --time 4 --steps 4 "
          "--error 1e-5 "
          "--columns x",
          found, sizeof found);
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-adaptive"));
    ck_assert_uint_eq(compare(found, fine, 1e-5), 5 * 3);
    table_of("run --system chain --x0 1 --p0 0.5 --damping zener:1,0.3,0.5 "
          "--damping power:1,0.8 "
          "--time 4 --steps 16384 --every 4096 --method fvi-bdf2 --columns x",
          fine, sizeof fine);
    table_of("run --system chain --x0 1 --p0 0.5 --damping zener:1,0.3,0.5 "
          "--damping power:1,0.8 "
          "--time 4 --steps 4 --error 1e-5 --columns x",
          found, sizeof found);
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-adaptive"));
    ck_assert_uint_eq(compare(found, fine, 1e-5), 5 * 3);
    ck_assert_int_eq(fvi("run --system chain --x0 0 --p0 0 --time 4 --steps 4 "
                         "--error 1e-5"),
                     0);
    ck_assert_int_eq(fvi("run --system chain --order 2 --x0 1 --time 4 --steps 4 "
                         "--error 1e-2"),
                     0); /* a damping of order 2 is a mass */
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-stable"));
    ck_assert_int_eq(fvi("run --system chain --damper 'C.mtx : power:1,0.3' --x0 1 --time 4 "
                         "--steps 4 --error 1e-2 --columns t,d1.force"),
                     0);
    ck_assert_ptr_nonnull(strstr(out, "# method = fvi-adaptive"));
}
END_TEST

/* (27.9): the largest eigenvalue of M^-1 K is 8.64: h < 0.68 at kappa = 0. */
START_TEST(an_unstable_step_is_told_of_a_system_too)
{
    write_chain();
    ck_assert_int_eq(shell("rm chain/C.mtx"), 0);
    ck_assert_int_eq(
        fvi("run --system chain --x0 1 --p0 0.5 --kappa 0 --h 0.6 --steps 3"),
        0);
    ck_assert_str_eq(err, "");
    ck_assert_int_eq(
        fvi("run --system chain --x0 1 --p0 0.5 --kappa 0 --h 0.7 --steps 3"),
        0);
    ck_assert_int_eq(
        strncmp(err, "fvi: warning: this step is unstable (load 1.", 44), 0);
    ck_assert_ptr_nonnull(strstr(out, "# warning = this step is unstable"));
    ck_assert_ptr_nonnull(strstr(err, "; stable below some h = 0.68\n"));
    ck_assert_int_eq(fvi("run --system chain --x0 1 --p0 0.5 --method "
                         "fvi-stable --h 70 --steps 3"),
                     0);
    ck_assert_str_eq(err, "");
}
END_TEST

/* (19.2): the damper is between the first and the last mass, and they start alike. Then
 * the body was held; C 0.3 times the difference of two starts is no number to be put to. */
START_TEST(a_start_that_stretches_no_damper_has_a_solution)
{
    static char held[1 << 16], put[1 << 16];
    char line[300];
    static const char *const methods[] = { "fvi", "fvi-shifted", "fvi-bdf2",
                                           "fvi-stable" };
    write_chain();
    write_file("chain/C.mtx", HEAD "3 3 3\n1 1 0.3\n3 3 0.3\n3 1 -0.3\n");
    for (size_t i = 0; i < LEN(methods); i++) {
        const char *start = "run --system chain --alpha 0.7 --x0 0.1,2,0.1 "
                            "--steps 50 --columns x,p --method";
        snprintf(line, sizeof line, "%s %s", start, methods[i]);
        table_of(line, held, sizeof held);
        snprintf(line, sizeof line, "%s %s --derivative rl", start, methods[i]);
        table_of(line, put, sizeof put);
        ck_assert_str_eq(err, "");
        ck_assert_ptr_null(strstr(out, "warning"));
        ck_assert_str_eq(held, put);
        snprintf(line, sizeof line,
                 "run --system chain --alpha 0.7 --x0 0.1,2,0.2 --derivative "
                 "rl --steps 9 --method %s",
                 methods[i]);
        if (i > 0)
            ck_assert_refused(line, "fvi: --derivative: 'rl' has no solution "
                                    "for C x0 != 0 and alpha > 1/2; take "
                                    "held or caputo");
    }
    ck_assert_int_eq(fvi("gradient --system chain --alpha 0.7 --x0 0.1,2,0.1 "
                         "--method fvi-stable --derivative rl"),
                     0);
    const double put_by_alpha = by("alpha"), put_by_rho = by("rho");
    ck_assert_int_eq(fvi("gradient --system chain --alpha 0.7 --x0 0.1,2,0.1 "
                         "--method fvi-stable"),
                     0);
    ck_assert_near(put_by_alpha, by("alpha"), 1e-13, "alpha");
    ck_assert_near(put_by_rho, by("rho"), 1e-13, "rho");
    ck_assert_int_eq(fvi("run --system chain --alpha 0.7 --x0 0.1,2,0.2 "
                         "--derivative rl --steps 9"),
                     0);
    ck_assert_ptr_nonnull(
        strstr(err, "rl with C x0 != 0 and alpha > 1/2 has "));
    ck_assert_ptr_nonnull(
        strstr(out, "# warning = rl with C x0 != 0 and alpha > 1/2 has no "));
}
END_TEST

/* CHOLMOD is opened when a matrix asks for it, here one whose first row is full: with a broken
 * library in its place a run without one goes well, and a run with one ends and names it. */
START_TEST(a_solver_is_opened_when_it_is_needed)
{
    char line[200];
    ck_assert_int_eq(
        shell("mkdir -p star broken; for A in M K C; do LC_ALL=C awk -v A=$A 'BEGIN { n = 300; "
              "print \"%%MatrixMarket matrix coordinate real symmetric\"; "
              "print n, n, A == \"K\" ? 2 * n - 1 : n; "
              "for (i = 1; i <= n; i++) print i, i, A == \"C\" ? 0.1 : 1; "
              "for (i = 2; A == \"K\" && i <= n; i++) print i, 1, -0.01 }' > star/$A.mtx; "
              "done"),
        0);
    const char *run = "run --system star --x0 1 --p0 0 --steps 3 --method fvi-stable";
    snprintf(line, sizeof line, "echo nothing > broken/libcholmod.so.%d",
             CHOLMOD_MAIN_VERSION);
    ck_assert_int_eq(shell(line), 0);
    ck_assert_int_eq(fvi(run), 0);
    setenv("LD_LIBRARY_PATH", "broken", 1);
    ck_assert_int_eq(fvi("run --steps 3"), 0);
    ck_assert_int_eq(fvi(run), 1);
    ck_assert_msg(strncmp(err, "fvi: ", 5) == 0 && strstr(err, "libcholmod.so."),
                  "%s", err);
    unsetenv("LD_LIBRARY_PATH");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: systems of matrices");
    ADD_CASE(suite, "system", a_folder_of_matrices_is_the_system_that_it_says,
             dampers_of_a_folder_are_files_and_rows,
             forces_come_from_a_table_of_unknowns,
             unknowns_are_chosen_and_all_of_them_kept_in_a_snapshot,
             a_system_goes_on_from_a_checkpoint_with_the_same_digits,
             eq_18_2_a_system_is_run_to_a_wanted_error,
             an_unstable_step_is_told_of_a_system_too,
             a_start_that_stretches_no_damper_has_a_solution,
             a_solver_is_opened_when_it_is_needed);
    return run_suite_of_program(suite);
}
