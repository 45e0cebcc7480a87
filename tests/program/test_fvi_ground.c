/* tests/program/test_fvi_ground.c -- A moving ground, and forces from files of any shape.
 * Run alone: make test-fvi_ground */
#define _GNU_SOURCE
#include "program.h"

static const char frame[] = "--potential '50*x1^2+50*(x2-x1)^2' --rho 5,0 "
                            "--alpha 0.3 --x0 0 --p0 0 --h 0.02 --steps 200 ";

static char *rows_of(const char *method, const char *force, const char *columns)
{
    char line[600];
    snprintf(line, sizeof line, "run --method %s %s %s --columns '%s'", method,
             frame, force, columns);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    return strdup(first_row());
}

/* In relative coordinates it is the force -M r a_g: the same digits where the product of m and a_g is
 * exact. ag and F are columns, and the work of F is that of this force. */
START_TEST(a_ground_is_a_force_on_every_mass)
{
    static const char *const methods[] = { "fvi", "fvi-stable", "fvi-lobatto4",
                                           "fvi-adaptive" };
    for (size_t i = 0; i < LEN(methods); i++) {
        char *ground = rows_of(methods[i], "--ground 'sin(8*t)'",
                               "t,x,p,v,a,balance"),
             *force = rows_of(methods[i], "--force '-sin(8*t)'",
                              "t,x,p,v,a,balance");
        ck_assert_str_eq(ground, force);
        free(ground);
        free(force);
        ground = rows_of(methods[i], "--mass 2,4 --ground 'sin(8*t)' --along 0,1",
                         "t,x,ag+sin(t)-sin(t),F");
        for (size_t k = 0; k <= 200; k++) {
            const double want = sin(8 * cell(k, 0));
            ck_assert_near(cell(k, 3), want, 4 * U, "ag");
            ck_assert(cell(k, 4) == 0);
            ck_assert_ulp(cell(k, 5), -4 * want, 2, "F2");
        }
        free(ground);
    }
}
END_TEST

/* With matrices, M r by the matrix M: f.tsv has that product by hand, times a polygon. */
START_TEST(the_ground_of_a_folder_is_that_of_its_masses)
{
    ck_assert_int_eq(
        shell("mkdir -p a b && cd a && "
              "printf '%%%%MatrixMarket matrix coordinate real symmetric\\n"
              "2 2 3\\n1 1 2\\n2 1 0.5\\n2 2 1\\n' > M.mtx && "
              "printf '%%%%MatrixMarket matrix coordinate real symmetric\\n"
              "2 2 3\\n1 1 20\\n2 1 -10\\n2 2 10\\n' > K.mtx && "
              "printf '%%%%MatrixMarket matrix coordinate real symmetric\\n"
              "2 2 1\\n1 1 0.5\\n' > C.mtx && cp *.mtx ../b && cd .. && "
              "printf 'ag t\\n0 0\\n1 1\\n-1 2\\n0 10\\n' > g.tsv && "
              "printf 't f1 f2\\n0 0 0\\n1 -2.5 -1.5\\n2 2.5 1.5\\n10 0 0\\n' "
              "> b/f.tsv"),
        0);
    static const char *const methods[] = { "fvi", "fvi-bdf2", "fvi-stable" };
    for (size_t i = 0; i < LEN(methods); i++) {
        char line[300];
        snprintf(line, sizeof line, "run --system a --ground file:g.tsv --alpha "
                 "0.3 --method %s --h 0.05 --steps 200 --columns "
                 "t,x,v,a,balance,d1.force", methods[i]);
        ck_assert_msg(fvi(line) == 0, "%s", err);
        double x[8];
        for (size_t n = 0; n < 8; n++)
            x[n] = cell(200, n);
        snprintf(line, sizeof line, "run --system b --alpha 0.3 --method %s "
                 "--h 0.05 --steps 200 --columns t,x,v,a,balance,d1.force",
                 methods[i]);
        ck_assert_msg(fvi(line) == 0, "%s", err);
        for (size_t n = 0; n < 8; n++)
            ck_assert_near(cell(200, n), x[n], 1e-13, "%s %zu", methods[i], n);
        ck_assert(fabs(x[1]) > 0.01);
    }
}
END_TEST

/* Columns by their names, in any order; a factor before the file; sums. */
START_TEST(files_are_picked_by_name_and_scaled)
{
    write_file("a.csv", "acc;time;temp\n0;0;20\n0,5;1;21\n0;2;22\n0;30;21\n");
    write_file("b.tsv", "t F\n0 0\n1 -1\n2 0\n30 0\n");
    write_file("c.tsv", "# F measured\n0 0\n1 -1\n2 0\n30 0\n"); /* a comment of two words is no line of names */
    const char *rest = "--x0 0 --p0 0 --steps 60 --h 0.1 --columns t,x,F";
    char line[300];
    snprintf(line, sizeof line, "run --force file:b.tsv %s", rest);
    ck_assert_int_eq(fvi(line), 0);
    double want[61];
    for (size_t k = 0; k <= 60; k++)
        want[k] = cell(k, 1);
    static const char *const same[] = {
        "-2*file:a.csv:time,acc", "file:b.tsv:t,F", "-1*file:b.tsv + "
        "-4*file:a.csv:TIME,acc", "1/2*file:b.tsv + file:b.tsv:t,F + "
        "1*file:a.csv:time,acc", "none + -2*file:a.csv:time,acc", "file:c.tsv"
    };
    for (size_t i = 0; i < LEN(same); i++) {
        snprintf(line, sizeof line, "run --force '%s' %s", same[i], rest);
        ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
        for (size_t k = 0; k <= 60; k++) /* interpolated in another order */
            ck_assert_near(cell(k, 1), want[k], 64 * U, "%s, %zu", same[i], k);
        ck_assert_near(cell(5, 2), -0.5, 2 * U, "%s", same[i]);
    }
    ck_assert_refused("run --force file:a.csv:zeit,acc --steps 5",
                      "fvi: --force: a.csv: no columns zeit and acc above its "
                      "numbers");
    ck_assert_refused_at("run --force 'k*file:b.tsv' --let k=2 --steps 5",
                         "fvi: --force: 'k': no such name\n"
                         "               ^");
    ck_assert_refused("run --force '1e300*1e300*file:b.tsv' --steps 5",
                      "fvi: --force: '1e300*1e300': a constant before this is "
                      "not finite");
    ck_assert_refused("run --force '2*file:none.tsv' --steps 5",
                      "fvi: --force: cannot read 'none.tsv': No such file or "
                      "directory");
    ck_assert_int_eq(fvi("run --force '2*file:b.tsv' --steps 5 -o b.tsv"), 2);
}
END_TEST

START_TEST(a_bad_ground_is_refused)
{
    ck_assert_refused("run --along 1",
                      "fvi: --along: without --ground nothing moves along it");
    ck_assert_refused("run --ground impulse:1,2",
                      "fvi: --ground: 'impulse:1,2': an impulse is no "
                      "acceleration");
    ck_assert_refused_with("run --ground sine",
                      "fvi: --ground: 'sine'");
    ck_assert_refused_with("run --ground 1 --along 1,2",
                      "fvi: --along: ");
    ck_assert_refused_with("run --lagrangian v^2/2 --x0 1 --v0 0 --ground 1",
                      "fvi: --ground: not together with --lagrangian");
    ck_assert_refused("exact --ground 1", "fvi: --ground: not an option of this "
                                          "command");
}
END_TEST

/* A ground that jumps is met: fvi-adaptive ends a step there, --error refuses a jump between rows. */
START_TEST(jumps_of_the_ground_are_known)
{
    ck_assert_int_eq(fvi("run --method fvi-adaptive --ground step:1,1.05 --x0 0 "
                         "--p0 0 --time 4 --steps 4 --columns t,x,balance"),
                     0);
    const double x = cell(4, 1);
    ck_assert_int_eq(fvi("run --method fvi-adaptive --force step:-1,1.05 --x0 0 "
                         "--p0 0 --time 4 --steps 4 --columns t,x"),
                     0);
    ck_assert(cell(4, 1) == x);
    ck_assert_int_eq(fvi("run --error 1e-8 --method fvi-lobatto3 --ground "
                         "step:1,1.05 --time 20 --steps 20"),
                     2);
    ck_assert(strncmp(err, "fvi: --error: the ground 'step:1,1.05' jumps", 44) == 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: ground and files");
    ADD_CASE(suite, "ground", a_ground_is_a_force_on_every_mass,
             the_ground_of_a_folder_is_that_of_its_masses,
             jumps_of_the_ground_are_known, a_bad_ground_is_refused);
    ADD_CASE(suite, "files", files_are_picked_by_name_and_scaled);
    return run_suite_of_program(suite);
}
