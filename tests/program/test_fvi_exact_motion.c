/* tests/program/test_fvi_exact_motion.c -- `fvi exact` of several masses. */
#define _GNU_SOURCE
#include "folder.h"

static char one[1 << 16], other[1 << 16];

/* A folder, the same springs as an expression, and a run with eight stages, whose error with these
 * steps is below 1e-12: three ways to one motion. */
START_TEST(eq_11_20_three_ways_to_one_motion)
{
    const char *same = "--x0 1,0,-1 --p0 0,0.5,0 --time 4 --force cosine:0.5,2 --damper "
                       "'x1 : power:0.5,0.3' --damper 'x3-x2 : zener:1,0.4,0.5'",
               *springs = "--mass 1,2,0.5 --potential 'x1^2+(x2-x1)^2+(x3-x2)^2+x3^2'";
    char line[700];
    write_chain();
    ck_assert_int_eq(shell("mkdir -p bare && cp chain/M.mtx chain/K.mtx bare"), 0);
    snprintf(line, sizeof line, "exact --system bare %s --steps 8", same);
    table_of(line, one, sizeof one);
    snprintf(line, sizeof line, "exact %s %s --steps 8", springs, same);
    table_of(line, other, sizeof other);
    ck_assert_uint_eq(compare(one, other, 1e-13), 9 * 8);
    snprintf(line, sizeof line,
             "run %s %s --method fvi-lobatto8d --steps 160 --every 20", springs, same);
    table_of(line, other, sizeof other);
    ck_assert_uint_eq(compare(one, other, 1e-11), 9 * 8);
    snprintf(line, sizeof line,
             "exact --system bare %s --steps 8 --unknowns 3,1 --columns t,x,v", same);
    ck_assert_int_eq(fvi(line), 0);
    ck_assert_ptr_nonnull(strstr(out, "\n# t\tx3\tx1\tv3\tv1\n"));
}
END_TEST

/* A law on all masses, and alpha on some. */
START_TEST(eq_11_20_dampings_of_all_masses)
{
    static const char *const words[] = { "--alpha 0.3 --rho 0.3,0,0.1",
                                         "--damping zener:1,0.3,2" };
    for (size_t i = 0; i < LEN(words); i++) {
        char line[400];
        const char *same = "--potential chain:3,2,0 --x0 1,0,-1 --p0 0.5 --time 3";
        snprintf(line, sizeof line, "exact %s %s --steps 6", same, words[i]);
        table_of(line, one, sizeof one);
        snprintf(line, sizeof line,
                 "run %s %s --method fvi-lobatto8d --steps 120 --every 20", same, words[i]);
        table_of(line, other, sizeof other);
        ck_assert_uint_eq(compare(one, other, 1e-10), 7 * 8);
    }
}
END_TEST

/* Accelerations, forces and impulses: of one mass and of two with dampers, as a run with eight stages has them. */
START_TEST(eq_11_21_accelerations_and_forces_as_a_run_has_them)
{
    static const char *const words[] = {
        "--alpha 0.3 --force cosine:0.5,2 --columns t,x,v,a,d1.force,d1.impulse",
        "--damping zener:1,0.3,2 --force step:1,0.25 --columns t,a,d1.force",
        ("--potential 'x1^2+(x2-x1)^2' --x0 1,0 --p0 0,0.5 --damper 'a=x2-x1 : power:1,0.5 + zener:2,0.3,1' "
         "--damper 'b=x1 : maxwell:1,2' --columns t,a,a.force,b.impulse")
    };
    static const size_t numbers[] = { 6, 3, 5 };
    for (size_t i = 0; i < LEN(words); i++) {
        char line[600];
        snprintf(line, sizeof line, "exact %s --time 4 --steps 8", words[i]);
        table_of(line, one, sizeof one);
        snprintf(line, sizeof line, "run %s --method fvi-lobatto8d --time 4 --steps 320 --every 40", words[i]);
        table_of(line, other, sizeof other);
        ck_assert_uint_eq(compare(one, other, 1e-7), 9 * numbers[i]);
    }
    ck_assert_refused("exact --columns t,work", "fvi: --columns: 't,work': the work of dampers and the balance are "
                                                "known to run alone");
    ck_assert_refused("exact --derivative rl --x0 0 --columns t,a",
                      "fvi: --derivative: 'rl' has no exact accelerations and forces here, only x and v; held has");
    ck_assert_refused("exact --derivative caputo --alpha 0.7 --columns t,a",
                      "fvi: --derivative: 'caputo' has no exact accelerations and forces here, only x and v; held has");
    ck_assert_refused("exact --derivative rl --potential 'x^2' --x0 0",
                      "fvi: --derivative: 'rl' has no exact solution of such a mass here; held has");
}
END_TEST

START_TEST(what_has_no_exact_motion_is_refused)
{
    write_chain();
    ck_assert_refused("exact --system chain --derivative rl",
                      "fvi: --derivative: 'rl' has no exact solution of several masses here; "
                      "held has");
    ck_assert_refused("exact --system chain --force t",
                      "fvi: --force: 't' has no exact solution here; none, step:A,T and "
                      "cosine:A,W have");
    ck_assert_refused("exact --potential duffing:1,1",
                      "fvi: --potential: 'duffing:1,1' has no exact solution here; harmonic:C "
                      "with C >= 0 and free have");
    ck_assert_int_eq(fvi("exact --potential chain:3,2,1"), 1);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --potential: the potential is not quadratic"));
    ck_assert_int_eq(fvi("exact --potential 'x1^2+x2^2' --damper 'x1*x2 : viscous:1'"), 1);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --damper: damper 1: its elongation is not linear"));
    ck_assert_int_eq(fvi("exact --potential 'x1^2+x2^2' --damper 'x1 : viscous:1 : rl'"), 1);
    ck_assert_ptr_nonnull(strstr(err, "damper 1: the exact motion is that of dampers that were "
                                      "held"));
    ck_assert_int_eq(fvi("exact --potential 'x1*x2' --rho 0 --steps 2"), 1);
    ck_assert_ptr_nonnull(strstr(err, "negative somewhere"));
    write_file("chain/f.tsv", "0 0 0 0\n100 1 1 1\n");
    ck_assert_refused("exact --system chain",
                      "fvi: --system: f.tsv of chain has no exact solution here; without it, "
                      "or --force step:A,T and cosine:A,W have");
    ck_assert_int_eq(shell("rm chain/f.tsv"), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: exact motions");
    ADD_CASE(suite, "exact", eq_11_20_three_ways_to_one_motion,
             eq_11_20_dampings_of_all_masses, eq_11_21_accelerations_and_forces_as_a_run_has_them, what_has_no_exact_motion_is_refused);
    return run_suite_of_program(suite);
}
