/* tests/program/test_fvi_problem.c -- The program build/fvi: a problem of the user.
 * Run alone: make test-fvi_problem */
#define _GNU_SOURCE
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "program.h"

/* Both command lines print the same rows, to the bit, whatever their heads say. */
static void ck_assert_same_rows(const char *one, const char *other)
{
    ck_assert_msg(fvi(one) == 0, "%s: %s", one, err);
    char *want = strdup(first_row());
    ck_assert_msg(fvi(other) == 0, "%s: %s", other, err);
    ck_assert_msg(strcmp(first_row(), want) == 0, "%s: other rows", other);
    free(want);
}

/* The same x in both, but for roundings of forces, which u bounds, and what 41 steps make
 * of them; numbers are below 100. Seen: 1e-14. */
static void ck_assert_near_rows(const char *one, const char *other)
{
    double x[41];
    ck_assert_msg(fvi(one) == 0, "%s: %s", one, err);
    for (size_t k = 0; k <= 40; k++)
        x[k] = cell(k, 1);
    ck_assert_msg(fvi(other) == 0, "%s: %s", other, err);
    for (size_t k = 0; k <= 40; k++)
        ck_assert_near(cell(k, 1), x[k], 41 * 100 * U, "%s", other);
}

/* A run with an expression is what the library makes of it. */
START_TEST(an_expression_is_a_potential)
{
    const double m = 1.5, rho = 0.3, x0 = 1, p0 = 0.5, k[] = { 3, 6 };
    const char *const names[] = { "k", "c" };
    const fvi_symbols of_x = { "x", 1, names, 2 }, of_t = { "t", 1, names, 2 };
    fvi_expression *V = NULL, *F = NULL;
    ck_assert(!fvi_expression_parse("k*x^4/c - cos(x)", &of_x, k, &V, NULL)
              && !fvi_expression_parse("sin(k*t)/4", &of_t, k, &F, NULL));
    const fvi_system s = {
        1, &m, &rho, fvi_potential_expression(V), fvi_force_expression(F), NULL, NULL
    };
    fvi_run run = fvi_run_default(&s, &x0, &p0, 0.1, 50);
    run.alpha = 0.3;
    double x[51];
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL), 0);
    ck_assert_int_eq(fvi("run --alpha 0.3 --rho 0.3 --mass 1.5 --potential "
                         "'k*x^4/c - cos(x)' --let k=3 --let 'c=2*k' --force "
                         "'sin(k*t)/4' --steps 50 --columns t,x"),
                     0);
    for (size_t i = 0; i <= 50; i++)
        ck_assert_ulp(cell(i, 1), x[i], 0, "k=%zu", i);
    ck_assert_ptr_nonnull(
        strstr(out, "# potential = k*x^4/c - cos(x)\n# let = k=3,c=2*k\n"
                    "# force = sin(k*t)/4\n"));
    fvi_expression_free(V);
    fvi_expression_free(F);
    ck_assert_int_eq(fvi("run --potential 'x^2\n+x' --steps 1"), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# potential = x^2 +x\n"));
    ck_assert_same_rows("run --potential 'k*x^2' --let k=2,k=2 --let k=2",
                        "run --potential '2*x^2'");
}
END_TEST

/* Two masses: x1 and x2, and columns that say so. */
START_TEST(expressions_have_as_many_coordinates_as_masses)
{
    ck_assert_same_rows(
        "run --dimension 2 --potential '(x1^2 + x2^2)/2' --x0 1,2 "
        "--p0 0 --steps 30 --columns x",
        "run --dimension 2 --potential harmonic --x0 1,2 --p0 0 "
        "--steps 30 --columns x");
    ck_assert_ptr_nonnull(strstr(out, "# dimension = 2\n"));
    ck_assert_ptr_nonnull(strstr(out, "# x1\tx2\n1\t2\n"));
    ck_assert_int_eq(fvi("run --dimension 1 --potential free --columns x"), 0);
    ck_assert_ptr_nonnull(strstr(out, "# x\n"));
    ck_assert_int_eq(fvi("run --dimension 3 --potential chain:3,1,1"), 0);
    ck_assert_int_eq(fvi("run --dimension 2 --potential chain:3,1,1"), 2);
    ck_assert_int_eq(
        strncmp(err, "fvi: --dimension: '2' is not that of 'chain:3,1,1'\n",
                51),
        0);
}
END_TEST

/* A shared object with the functions of <fvi/system.h>, compiled as the manual says; the same
 * rows as the expression, to roundings. Without a compiler there is nothing to load. */
START_TEST(a_shared_object_is_a_potential)
{
    ck_assert_refused(
        "run --potential nowhere.so",
        "fvi: --potential: cannot load 'nowhere.so': ./nowhere.so: cannot "
        "open shared object file: No such file or directory");
    if (shell("command -v cc > /dev/null") != 0)
        return;
    write_file("my.c",
               "#include <fvi/system.h>\n"
               "static int value(size_t d, const double *x, void *p, double *U)"
               "{ (void)d, (void)p; *U = x[0] * x[0] * x[1]; return 0; }\n"
               "static int gradient(size_t d, const double *x, void *p, double "
               "*g) { (void)d, (void)p; g[0] = 2 * x[0] * x[1]; "
               "g[1] = x[0] * x[0]; return 0; }\n"
               "static int hessian(size_t d, const double *x, void *p, double "
               "*H) { (void)d, (void)p; H[0] = 2 * x[1]; H[1] = H[2] = 2 * "
               "x[0]; H[3] = 0; return 0; }\n"
               "const fvi_potential fvi_user_potential = { .value = value, "
               ".gradient = gradient, .hessian = hessian };\n");
    ck_assert_int_eq(shell("cc -shared -fPIC -I\"$SOURCES\" my.c -o my.so"), 0);
    ck_assert_near_rows(
        "run --potential 'x1^2*x2' --dimension 2 --h 0.02 --steps 40",
        "run --potential my.so --dimension 2 --h 0.02 --steps 40");
    ck_assert_near_rows(
        "run --potential 'x1^2*x2' --dimension 2 --h 0.02 --steps 40",
        "run --potential $PWD/my.so --dimension 2 --h 0.02 --steps 40");
    ck_assert_near_rows(
        "run --potential 'x1^2*x2' --dimension 2 --h 0.02 --steps 40",
        "run --potential my.c --dimension 2 --h 0.02 --steps 40");
    ck_assert_same_rows(
        "sweep --vary x0=1:2:3 --potential my.so --dimension 2 --steps 3 "
        "--h 0.02",
        "sweep --vary x0=1:2:3 --potential ./my.c --dimension 2 --steps 3 "
        "--h 0.02");
    ck_assert_refused("run --potential my.c --dimension 2 -o ./my.c",
                      "fvi: -o: './my.c' is the file of --potential, too");
    /* gcc says first in which function the error is */
    write_file("wrong.c", "int wrong(void) { return nothing; }\n");
    ck_assert_int_eq(fvi("run --potential wrong.c"), 2);
    ck_assert_int_eq(strncmp(err,
                             "fvi: --potential: cannot compile 'wrong.c': "
                             "./wrong.c:1",
                             55),
                     0);
    ck_assert_uint_eq(count_lines(err), 2);
    /* the compiler speaks the language of its user */
    ck_assert_int_eq(shell("LANGUAGE=en \"$FVI\" run --potential nowhere.c"),
                     2);
    ck_assert(strncmp(err, "fvi: --potential: cannot compile 'nowhere.c': ", 46)
                  == 0
              && strstr(err, "o such file") && count_lines(err) == 2);
    ck_assert_int_eq(shell("echo 'int fvi_other;' > o.c; "
                           "cc -shared -fPIC o.c -o other.so; "
                           "sed 's/[.]value = value,//' my.c > half.c; cc "
                           "-shared -fPIC -I\"$SOURCES\" half.c -o half.so"),
                     0);
    ck_assert_refused(
        "run --potential other.so",
        "fvi: --potential: 'other.so' defines no fvi_user_potential");
    ck_assert_refused("run --potential half.so --dimension 2",
                      "fvi: --potential: 'half.so': a function is missing in "
                      "fvi_user_potential");
}
END_TEST

/* Any name of a file, nothing that stays behind, not even of a program that is told to end
 * while the compiler runs, and a compiler that does not run is named. SLOW is a compiler
 * that tells its parent to end, then says whether it can be told so itself. */
START_TEST(a_file_of_c_is_compiled_and_nothing_stays)
{
    if (shell("command -v cc > /dev/null") != 0)
        return;
    write_file("one.c",
               "#include <fvi/system.h>\n"
               "static int f(size_t d, const double *x, void *p, double *y)"
               "{ (void)d, (void)p; *y = *x * 0; return 0; }\n"
               "const fvi_potential fvi_user_potential = { .value = f, "
               ".gradient = f, .hessian = f };\n");
    ck_assert_int_eq(
        shell("mkdir ./-d empty; cp one.c \"a b'\\$x.c\"; cp one.c ./-d; "
              "export TMPDIR=$PWD/empty; for f in one.c \"a b'\\$x.c\" "
              "-d/one.c ./-d/one.c; do \"$FVI\" run --potential \"$f\" "
              "--steps 3 > /dev/null || exit 1; done; rmdir empty"),
        0);
    ck_assert_int_eq(
        shell(
            "printf '#!/bin/sh\n\"$@\"\n' > early; chmod +x early; "
            "CC=\" $PWD/early  ${CC:-cc} -Os\" \"$FVI\" run --potential one.c "
            "--steps 3 > /dev/null"),
        0);
    ck_assert_int_eq(
        shell("CC=none \"$FVI\" run --potential one.c 2> e; test $? = 2 && "
              "grep -q \"cannot compile 'one.c': the compiler none does not "
              "run\" e"),
        0);
    ck_assert_int_eq(
        shell("printf '#!/bin/sh\\nkill $PPID\\nkill $$\\ntouch deaf\\n' > "
              "slow; chmod +x slow; mkdir empty; TMPDIR=$PWD/empty "
              "CC=$PWD/slow \"$FVI\" run --potential one.c > o 2> e; "
              "test $? = 143 && test ! -s o && rmdir empty && ! test -e deaf"),
        0);
}
END_TEST

/* Each mass, each damping, from the line and from a file; against the library. */
START_TEST(masses_and_dampings_one_by_one)
{
    const double m[] = { 1, 2, 3 }, rho[] = { 0.3, 0, 0.1 },
                 x0[] = { 1, 0, -1 }, p0[] = { 0.5, 0.5, 0.5 }, cg[] = { 1, 1 };
    const fvi_system s = { 3, m, rho, fvi_potential_chain(cg), { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&s, x0, p0, 0.1, 20);
    run.alpha = 0.3;
    double x[63];
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL), 0);
    write_file("masses", "# of three bodies\n1, 2\n 3 # the last\n");
    static const char *const lines[] = {
        "run --potential chain:3,1,1 --alpha 0.3 --steps 20 --columns x "
        "--mass 1,2,3 --rho 0.3,0,0.1 --x0 1,0,-1",
        "run --potential chain:3,1,1 --alpha 0.3 --steps 20 --columns x "
        "--mass @masses --rho 0.3,0,0.1 --x0 1,0,-1"
    };
    for (size_t n = 0; n < LEN(lines); n++) {
        ck_assert_int_eq(fvi(lines[n]), 0);
        for (size_t k = 0; k <= 20; k++)
            for (size_t i = 0; i < 3; i++)
                ck_assert_ulp(cell(k, i), x[3 * k + i], 0, "k=%zu i=%zu", k, i);
    }
    ck_assert_int_eq(fvi("run --rho 0,0 --dimension 2 --memory direct "
                         "--steps 1e5 --every 1e5"),
                     0); /* no damping, no memory */
}
END_TEST

/* An impulse is another momentum; two add, in any order; it stands beside other forces, hits
 * every mass, and is met by the steps of --error. */
START_TEST(impulses_are_forces)
{
    ck_assert_near_rows("run --force none --p0 0.75 --steps 40",
                        "run --force impulse:0.25,0 --steps 40");
    ck_assert_same_rows(
        "run --force 'impulse:0.5,3 + impulse:-1,1.26'",
        "run --force 'impulse:-1,1.26 + impulse:0.25,3 + Impulse:0.25,3'");
    ck_assert_same_rows("run --force 'step:1,90 + impulse:0,3'",
                        "run --force step:1,90");
    ck_assert_same_rows(
        "run --potential chain:2,1,0 --force impulse:1,0 --x0 0 "
        "--p0 0 --columns x",
        "run --potential chain:2,1,0 --x0 0 --p0 1 --columns x");
    ck_assert_int_eq(fvi("run --error 1e-10 --time 20 --steps 20 --x0 0 --p0 0 "
                         "--alpha 0.3 --force impulse:2,0.5"),
                     0);
    double x[21];
    for (size_t k = 0; k <= 20; k++)
        x[k] = cell(k, 1);
    ck_assert_int_eq(fvi("exact --time 19.5 --steps 39 --x0 0 --p0 2 "
                         "--alpha 0.3"),
                     0);
    for (size_t k = 1; k <= 20; k++)
        ck_assert_near(x[k], cell(2 * k - 1, 1), 1.2e-10, "row %zu", k);
}
END_TEST

/* Forces add; a file is linear between its rows, and needs no names. */
START_TEST(forces_add_up)
{
    ck_assert_same_rows("run --force cosine:0.3,2",
                        "run --force '0.3*cos(2*t)'");
    ck_assert_same_rows("run --force step:1,3",
                        "run --force 'step:0.25,3 + step:0.75,3'");
    ck_assert_near_rows(
        "run --steps 40 --force '2 + t'",
        "run --steps 40 --force 'step:1,90 + 1 + t + step:0,9'");
    write_file("F.tsv", "# made by hand\n# F\tt\n0.5\t-1\n0.5\t0\n2.5\t20\n");
    ck_assert_near_rows("run --force '0.5 + t/10' --h 0.5 --steps 40",
                        "run --force file:F.tsv --h 0.5 --steps 40");
    write_file("F.csv", "\"F\",\"t\"\n0,0\n1,10\n0,20\n");
    ck_assert_near_rows("run --force '1 - abs(t - 10)/10' --h 0.5 --steps 40",
                        "run --force FILE:F.csv --h 0.5 --steps 40");
    ck_assert_near_rows(
        "run --force '1 - abs(t - 10)/10 + 2*t' --h 0.5 --steps 40",
        "run --force '2*t + file:F.csv' --h 0.5 --steps 40");
    write_file("bare", "\n0 1 7\n\n30 1 7\n");
    ck_assert_same_rows("run --force 1", "run --force file:bare");
    /* a table that the program wrote is one that it reads */
    ck_assert_int_eq(fvi("run --columns energy,x,t -o table"), 0);
    write_file("renamed", "");
    ck_assert_int_eq(shell("sed 's/^# energy\\tx\\tt/# q\\tF\\tt/' table > "
                           "renamed; \"$FVI\" run --force file:renamed"),
                     0);
}
END_TEST

/* Words may be written in capitals; what they mean is the same. */
START_TEST(case_does_not_matter_for_words)
{
    ck_assert_same_rows(
        "run --method lda --potential duffing:1,1 --force step:1,2 "
        "--columns t,energy --memory direct",
        "RUN --method LDA --potential Duffing:1,1 --force STEP:1,2 "
        "--columns T,Energy --memory Direct");
    ck_assert_same_rows("run --potential harmonic:1",
                        "run --potential Harmonic");
    ck_assert_same_rows("run --derivative rl --x0 0",
                        "run --derivative RL --x0 0");
}
END_TEST

int main(void)
{
    char *sources = realpath("src", NULL);
    setenv("SOURCES", sources ? sources : "src", 1);
    free(sources);
    Suite *suite = suite_create("the program fvi: one's own problem");
    ADD_CASE(suite, "values", an_expression_is_a_potential,
             expressions_have_as_many_coordinates_as_masses,
             a_shared_object_is_a_potential,
             a_file_of_c_is_compiled_and_nothing_stays,
             masses_and_dampings_one_by_one, impulses_are_forces, forces_add_up,
             case_does_not_matter_for_words);
    return run_suite_of_program(suite);
}
