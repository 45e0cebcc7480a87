/* tests/program/test_fvi_damping.c -- The program build/fvi: laws of damping.
 * Run alone: make test-fvi_damping */
#define _GNU_SOURCE
#include "program.h"

#include <string.h>

/* x in the last row of `run` with these words. */
static double last_x(const char *words)
{
    char line[1000];
    snprintf(line, sizeof line, "run --time 4 --columns x %s", words);
    ck_assert_msg(fvi(line) == 0, "%s: %s", line, err);
    const char *row = out;
    for (const char *at = out; *at; at = strchr(at, '\n') + 1)
        row = at;
    return strtod(row, NULL);
}

/* The lines of (26.9) and of H 11, to 1e-12: two ways to sum 400 terms. */
START_TEST(a_power_is_alpha_and_rho)
{
    const double law = last_x("--damping power:0.3,0.35 --steps 400"),
                 alpha = last_x("--alpha 0.35 --rho 0.3 --steps 400");
    ck_assert_near(law, alpha, 1e-12, "x(4)");
    ck_assert_near(last_x("--damping power:0.1,0.35 --damping power:0.2,0.35 "
                          "--method FVI-BDF2 --steps 400"),
                   last_x("--damping power:0.3,0.35 --method fvi-bdf2 "
                          "--steps 400"),
                   1e-12, "laws add");
    ck_assert_double_eq(
        last_x("--damping 'viscous:0.1 + spring:0.3' --steps 400"),
        last_x("--damping power:0.1,0.5 --damping power:0.3,0 --steps 400"));
}
END_TEST

/* Each kind means its symbol: x(4) of (26.9), m = c = 1, held at 1, p0 = 0, from
 * verify/damping_laws/damping_laws.py. Order 2: some 0.3 h^2. Seen: 5e-8;
 * and the exact solution, as its header promises. Seen: 2e-16. */
START_TEST(each_kind_is_its_symbol)
{
    const struct {
        const char *words;
        double x;
    } laws[] = {
        { "--damping power:1,0.3125", 0x1.57afc9be8fa8bp-3 },
        { "--damping zener:1,0.3125,0.75", 0x1.d4ed457a18de0p-3 },
        { "--damping maxwell:1,0.75 --damping maxwell:0.5,3",
          0x1.3b232fdfd4090p-3 },
        { "--damping distributed:1,0,0.5", 0x1.0c3372023837cp-5 },
        { "--damping davidson:1,0.3125,0.75", 0x1.4a991e06f8274p-2 },
        { "--damping havriliak:1,0.3125,0.75,0.5", 0x1.a4e3b8b89a2abp-3 },
        { "--damping havriliak:1,0.3125,0.75,1", 0x1.d4ed457a18de0p-3 },
        { "--damping 'symbol:r*s^(2*a)/(1+T*s^(2*a))' --let r=1,T=0.75,a=0.3125",
          0x1.d4ed457a18de0p-3 },
        { "--let r=4/3 --damping 'symbol:1/(1/s^0.75+1/(r*s^0.25))'",
          0x1.02b3d5efc9c40p-4 },
        { "--damping maxwell2:1,0.375,1.3333333333333333,0.125", 0x1.02b3d5efc9c40p-4 },
        { "--damping maxwell2:1.3333333333333333,0.125,1,0.375", 0x1.02b3d5efc9c40p-4 },
    };
    size_t ran = 0;
    for (size_t i = 0; i < LEN(laws); i++) {
        char line[300];
        snprintf(line, sizeof line, "--p0 0 --method fvi-bdf2 --steps 8000 %s",
                 laws[i].words);
        ck_assert_near(last_x(line), laws[i].x, 1e-7, "%s", laws[i].words);
        snprintf(line, sizeof line,
                 "--p0 0 --method fvi-lobatto8d "
                 "--steps 16 %s",
                 laws[i].words);
        ck_assert_near(last_x(line), laws[i].x, 2e-13, "%s", laws[i].words);
        snprintf(line, sizeof line, "--p0 0 --method fvi-shifted --steps 8000 %s",
                 laws[i].words);
        ck_assert_near(last_x(line), laws[i].x, 1e-7, "%s", laws[i].words);
        snprintf(line, sizeof line,
                 "--p0 0 --step-error 1e-13 --steps 4 %s", laws[i].words);
        ck_assert_near(last_x(line), laws[i].x, 1e-13, "%s", laws[i].words);
        snprintf(line, sizeof line,
                 "exact --p0 0 --time 4 --steps 3 --columns x %s",
                 laws[i].words);
        ck_assert_int_eq(fvi(line), 0);
        ck_assert_near(cell(3, 0), laws[i].x, 2e-13, "%s", laws[i].words);
        ran++;
    }
    ck_assert_uint_eq(ran, LEN(laws));
}
END_TEST

START_TEST(the_head_repeats_the_law_and_no_alpha)
{
    ck_assert_int_eq(fvi("run --damping zener:1,0.3,2 --damping maxwell:2,5 "
                         "--steps 3"),
                     0);
    ck_assert_ptr_nonnull(
        strstr(out, "\n# damping = zener:1,0.3,2 + maxwell:2,5\n"));
    ck_assert_ptr_null(strstr(out, "alpha"));
    ck_assert_ptr_null(strstr(out, "rho"));
    ck_assert_str_eq(err, "");
}
END_TEST

START_TEST(error_takes_the_method_that_knows_laws)
{
    static const struct {
        const char *words, *method;
    } taken[] = { { "power:0.2,0.3 --error 1e-6", "adaptive" },
                  { "'symbol:0.3*s^0.5' --error 1e-3", "adaptive" },
                  { "power:0.1,0.7 --p0 0 --error 1e-3", "adaptive" },
                  { "power:0.1,0.7 --error 1e-3", "bdf2" },
                  { "zener:1,0.6,0.5 --error 1e-3", "bdf2" },
                  { "zener:1,0.6,0.5 --error 1e-7", "lobatto4" },
                  { "power:0.2,0.3 --error 1e-3 --kappa 1", "bdf2" },
                  { "power:0.2,0.3 --error 1e-3 --memory direct", "bdf2" } };
    for (size_t i = 0; i < LEN(taken); i++) {
        char words[200], head[64];
        snprintf(words, sizeof words, "run --steps 4 --damping %s", taken[i].words);
        snprintf(head, sizeof head, "\n# method = fvi-%s\n", taken[i].method);
        ck_assert_msg(fvi(words) == 0, "%s: %s", words, err);
        ck_assert_msg(strstr(out, head) != NULL, "%s: %s", words, out);
        ck_assert_ptr_nonnull(strstr(out, "\n# error estimate = "));
    }
}
END_TEST

START_TEST(an_unstable_step_is_told_of_a_law_too)
{
    ck_assert_int_eq(fvi("run --damping maxwell:20,0.01 --h 0.5 --steps 3"), 0);
    ck_assert_ptr_nonnull(strstr(err, "this step is unstable"));
}
END_TEST

START_TEST(what_is_no_law_is_bad_use)
{
    const struct {
        const char *words, *said;
    } bad[] = {
        { "--damping zenr:1,2,3",
          "--damping: 'zenr:1,2,3' is none of viscous:R  spring:K  power:R,A  "
          "zener:R,A,T  maxwell:R,T  maxwell2:R1,A,R2,B  davidson:R,A,T  "
          "distributed:R,A,B  havriliak:R,A,T,B  symbol:EXPRESSION; did you mean zener?" }, /* a new law goes here */
        { "--damping 'symbol:s^'", "--damping: " },
        { "--damping 'symbol:s^k'", "--damping: " },
        { "--damping symbol:s^2.1", "'symbol:s^2.1' is no law" },
        { "--damping 'symbol:abs(s)'", "is no law" },
        { "--damping 'symbol:sqrt(-s)'", "is no law" },
        { "--damping 'symbol:sqrt(1 - s)'", "is no law" },
        { "--damping 'symbol:1/(s-1)'", "is no law: it must be finite at s = i w, real for s > 0, without a pole" },
        { "--damping 'symbol:s^0.3 + 0.1/(s-2e-6)'", "is no law" },
        { "--damping 'symbol:1/(s^2-2e5*s+1.2e10)'", "is no law" },
        { "--damping 'symbol:s*(s+3)/((s+1)^2+4)'", "without a pole off the negative axis" },
        { "--damping 'symbol:sqrt(s^2+1)-1'", "is no law" },
        { "--damping symbol:s --damping spring:1", "a symbol stands alone" },
        { "--damping spring:1 --damping symbol:s", "a symbol stands alone" },
        { "--damping 'symbol:s' --let k=1", "'k' is in no expression" },
        { "--damping maxwell2:1,0.3,-1,0.1", "R1, R2 >= 0 and A, B in [0, 1]" },
        { "--damping maxwell2:1,0.3,1,1.1", "R1, R2 >= 0 and A, B in [0, 1]" },
        { "--damping 'power:1,0.3 + '", "--damping: '' is none of" },
        { "--damping 'power:1,0.3 + spring:-1'",
          "--damping: 'spring:-1': spring:K with K >= 0" },
        { "--damping power:1", "--damping: 'power:1' is not power:R,A" },
        { "--damping Zener:1,x,1", "'Zener:1,x,1' is not zener:R,A,T" },
        { "--damping maxwell", "'maxwell' is not maxwell:R,T" },
        { "--damping ''", "is none of" },
        { "--damping power:1,2", "--damping: 'power:1,2': power:R,A" },
        { "--damping power:-1,0.5", "power:R,A" },
        { "--damping zener:1,0.5,-1", "zener:R,A,T" },
        { "--damping distributed:1,0.5,0.4", "distributed:R,A,B" },
        { "--damping power:1,0.3 --alpha 0.3", "not together with --alpha" },
        { "--damping power:1,0.3 --rho 1", "not together with --rho" },
        { "--damping power:1,0.3 --method lda", "is not known to" },
        { "--damping power:1,0.3 --derivative rl", "--derivative: 'rl'" },
        { "--damping power:1,0.7 --derivative caputo", "--derivative: 'cap" },
        { "--damping power:1,0.3 --memory fft",
          "fvi: --memory: 'fft' is none of auto, direct, exponentials\n" },
        { "--damping zener:1,0.48,2 --memory exponentials",
          "--memory: 'exponentials': of --damping 'zener:1,0.48,2' there are "
          "none with this step; 'auto' sums it all\n" },
        { "--damping zener:1,1,2 --memory exponentials --method fvi-lobatto4d",
          "there are none with this step" },
        { "--damping maxwell:1,0.2 --memory exponentials --method fvi-bdf2",
          "there are none with this step" },
    };
    for (size_t i = 0; i < LEN(bad); i++) {
        char line[300];
        snprintf(line, sizeof line, "run %s", bad[i].words);
        ck_assert_msg(fvi(line) == 2, "%s", line);
        ck_assert_msg(strstr(err, bad[i].said), "%s: %s", line, err);
        ck_assert_str_eq(out, "");
    }
    ck_assert_int_eq(fvi("run --damping 'symbol:(s/(1+s))^0.6' "
                         "--method fvi-lobatto4d"),
                     1);
    ck_assert_ptr_nonnull(strstr(err, "no sum of decaying modes"));
    ck_assert_int_eq(fvi("run --damping zener:1,0.6,1 --method fvi-adaptive"), 1);
    ck_assert_ptr_nonnull(strstr(err, "too near to its cut, or off it"));
    ck_assert_int_eq(fvi("sweep --damping zener:1,0.6,1 --method fvi-adaptive --vary x0=1,2 -o none"), 1);
    ck_assert_ptr_nonnull(strstr(err, "fvi: with x0 = 1: --damping: a pole of this law is too near"));
    ck_assert_int_eq(fvi("gradient --damping zener:1,0.6,1 --method fvi-adaptive"), 1);
    ck_assert_ptr_nonnull(strstr(err, "fvi: --damping: a pole of this law is too near"));
    static const char *const singular[][2] = { { "zener:1,0.6,1", "a pole" }, { "maxwell2:1,0.5,2,0.01", "a pole" },
                                               { "havriliak:1,0.5,1,0.5", "a branch point" },
                                               { "davidson:1,0.49,2", "a branch point" },
                                               { "davidson:1,1,2", "a pole" },
                                               { "davidson:1,0.49,2 + zener:1,0.3,1", "a pole or a branch point" },
                                               { "symbol:s^0.6/(1+s)", "a pole or a branch point" } };
    for (size_t i = 0; i < LEN(singular); i++) {
        char line[200], said[200];
        for (int is_damper = 0; is_damper < 2; is_damper++) {
            snprintf(line, sizeof line, is_damper ? "run --damper 'x : %s' --method fvi-adaptive"
                                                  : "run --damping '%s' --method fvi-adaptive", singular[i][0]);
            snprintf(said, sizeof said, "%s: %s%s of this law is too near to its cut", is_damper ? "--damper" : "--damping",
                     is_damper ? "damper 1: " : "", singular[i][1]);
            ck_assert_int_ne(fvi(line), 0);
            ck_assert_msg(strstr(err, said) != NULL, "%s: %s", line, err);
        }
    }
    ck_assert_int_eq(fvi("exact --damping power:1,0.3 --derivative rl"), 2);
    ck_assert_ptr_nonnull(strstr(err, "--derivative: 'rl'"));
    ck_assert_int_eq(fvi("exact --damping power:1,0.3 --alpha 0.3"), 2);
    ck_assert_int_eq(fvi("exact --damping zener:1,0.75,1 --damping "
                         "zener:1,0.8,1e-2 --damping zener:1,0.75,1e-4"),
                     1);
    ck_assert_str_eq(err, "fvi: --damping: a motion with more than three "
                          "oscillations has no exact solution here\n");
    ck_assert_str_eq(out, "");
    ck_assert_int_eq(fvi("exact --damping zener:0.1,0.3,0.5 --mass 1e-150"), 1);
    ck_assert_str_eq(err, "fvi: the poles of the motion were not found: they are too far out, or too near to each "
                          "other\n");
    ck_assert_int_eq(fvi("fit --damping power:1,0.3 data"), 2);
    ck_assert_int_eq(fvi("run --damping zener:1,0.48,2 --memory auto"), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: laws of damping");
    ADD_CASE(suite, "laws", a_power_is_alpha_and_rho, each_kind_is_its_symbol,
             the_head_repeats_the_law_and_no_alpha,
             error_takes_the_method_that_knows_laws,
             an_unstable_step_is_told_of_a_law_too, what_is_no_law_is_bad_use);
    return run_suite_of_program(suite);
}
