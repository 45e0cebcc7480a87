/* tests/program/test_fvi_problem_errors.c -- The program build/fvi: the messages for wrong problems of the user.
 * Run alone: make test-fvi_problem_errors */
#define _GNU_SOURCE
#include "program.h"

/* The caret stands below what is wrong. */
START_TEST(a_misprint_is_shown)
{
    ck_assert_refused_at(
        "run --potential 'x^4/4 - x^^2'",
        "fvi: --potential: 'x^4/4 - x^^2': a number, a name or ( is wanted "
        "here\n                             ^");
    ck_assert_refused_at("sweep --vary k=1:2:2 --potential 'k*^x'",
                         "fvi: --potential: 'k*^x': a number, a name or ( is "
                         "wanted here\n                     ^");
    ck_assert_refused_at("fit --potential '^x' data",
                         "fvi: --potential: '^x': a number, a name or ( is "
                         "wanted here\n                   ^");
    ck_assert_refused_at("run --potential 'k*x^2'",
                         "fvi: --potential: 'k*x^2': no such name\n"
                         "                   ^");
    ck_assert_refused_at("run --force 'step:1,2 + sin(z)'",
                         "fvi: --force: 'sin(z)': no such name\n"
                         "                   ^");
    ck_assert_refused("run --force 'step:1,2 + sin(x)'",
                      "fvi: --force: 'sin(x)': a force knows t alone; "
                      "--force-on knows x and v");
    ck_assert_refused_at("run --let k=2+ --potential 'k*x'",
                         "fvi: --let: '2+': it ends too early\n"
                         "               ^");
    ck_assert_refused_at(
        "run --potential '1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+"
        "1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+x**y+1+1+1+1+1+1+1+1+1+1+1+1+1+1'",
        "fvi: --potential: '...+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+1+x**y+1+"
        "1+1+1+1+1+1+1+1+...': no such name\n"
        "                                                              ^");
    ck_assert_refused(
        "run --potential harmonc",
        "fvi: --potential: 'harmonc' is none of harmonic:C, duffing:C,G, "
        "pendulum:G, free, chain:D,C,G, nor an expression; did you mean "
        "harmonic?");
    ck_assert_refused(
        "run --memory fft",
        "fvi: --memory: 'fft' is none of auto, direct, exponentials");
    ck_assert_refused("run --potential duffing",
                      "fvi: --potential: 'duffing' is not duffing:C,G");
    ck_assert_refused(
        "run --force cosin:1,2",
        "fvi: --force: 'cosin:1,2' is none of none, step:A,T, cosine:A,W, "
        "impulse:J,T, file:F.tsv; did you mean cosine?");
    static const char *const forms[] = { "step:A,T", "cosine:A,W",
                                         "impulse:J,T" };
    for (size_t i = 0; i < LEN(forms); i++) {
        char line[60], said[80];
        const int word = (int)strcspn(forms[i], ":");
        snprintf(line, sizeof line, "run --force %.*s:1", word, forms[i]);
        snprintf(said, sizeof said, "fvi: --force: '%.*s:1' is not %s\n", word,
                 forms[i], forms[i]);
        ck_assert_refused_with(line, said);
    }
    ck_assert_refused("run --force file", "fvi: --force: 'file' is not "
                                          "file:F.tsv");
    ck_assert_refused("run --force impulse:1,21",
                      "fvi: --force: 'impulse:1,21' is not within the run, "
                      "0 <= T <= 20");
    ck_assert_refused("run --alpha 1 --method fvi-lobatto3 --force impulse:1,2",
                      "fvi: --force: 'impulse:1,2': fvi-lobatto3 takes no "
                      "impulse at alpha = 1; fvi-adaptive does");
    ck_assert_int_eq(fvi("run --alpha 1 --method fvi-lobatto3 --rho 0 --force "
                         "impulse:1,2"),
                     0);
    ck_assert_int_eq(fvi("run --alpha 1 --method fvi-adaptive --force "
                         "impulse:1,2"),
                     0);
    ck_assert_refused("run --force 1+impulse:1",
                      "fvi: --force: '1+impulse:1' is none of none, step:A,T, "
                      "cosine:A,W, impulse:J,T, file:F.tsv; did you mean "
                      "impulse?");
    ck_assert_refused("exact --force impulse:1,2",
                      "fvi: --force: 'impulse:1,2' has no exact solution here; "
                      "none, step:A,T and cosine:A,W have");
    ck_assert_refused("run --force impulse:1,2.05 --time 20 --error 1e-6 "
                      "--method fvi-lobatto3",
                      "fvi: --error: the force 'impulse:1,2.05' jumps between "
                      "two rows; take other --steps, or --method "
                      "fvi-adaptive");
    ck_assert_refused(
        "run --columns t,q",
        "fvi: --columns: 'q' is none of t, x, p, v, a, F, energy, work, "
        "balance, y, d1.force, nor an expression");
}
END_TEST

START_TEST(wrong_parameters_and_lists_are_refused)
{
    ck_assert_refused("run --let k", "fvi: --let: 'k' is not NAME=VALUE");
    ck_assert_refused("run --let x=1",
                      "fvi: --let: 'x' is not a name for a parameter");
    ck_assert_refused("run --let sin=1",
                      "fvi: --let: 'sin' is not a name for a parameter");
    ck_assert_refused("run --let k=1 --let k=2",
                      "fvi: --let: 'k' is given twice");
    ck_assert_refused("run --let k=1e200,c=k*k",
                      "fvi: --let: 'k*k' is not finite");
    ck_assert_refused("run --let k=1", "fvi: --let: 'k' is in no expression");
    ck_assert_refused_at(
        "run --let k=1,kk=2 --potential 'kk*x^2 + 1.k' --force "
        "file:k.tsv",
        "fvi: --potential: 'kk*x^2 + 1.k': an operator is wanted "
        "here\n                              ^");
    ck_assert_refused("run --let k=1,kk=2 --potential 'kk*x^2'",
                      "fvi: --let: 'k' is in no expression");
    ck_assert_refused("run --let k=1,kk=2 --potential 'k*x^2'",
                      "fvi: --let: 'kk' is in no expression");
    ck_assert_refused("sweep --vary k=1:2:2",
                      "fvi: --vary: 'k' is no option that can be varied, and "
                      "in no expression");
    ck_assert_refused("sweep --vary k=1:2:2 -o k.tsv",
                      "fvi: --let: 'k' is in no expression");
    ck_assert_refused("exact --let k=1", "fvi: --let: 'k' is in no expression");
    ck_assert_refused("run --mass 1,2",
                      "fvi: --mass: '1,2' has 2 numbers, not 1");
    ck_assert_refused("run --dimension 2 --mass 1,-2",
                      "fvi: --mass: '-2' is outside [0, inf)");
    ck_assert_refused("run --rho -0.1",
                      "fvi: --rho: '-0.1' is outside [0, inf)");
    ck_assert_refused("run --rho @nowhere",
                      "fvi: --rho: cannot read 'nowhere': No such "
                      "file or directory");
    ck_assert_refused("run --rho @.",
                      "fvi: --rho: cannot read '.': Is a directory");
    write_file("odd", "1\n2,x\n");
    ck_assert_refused("run --dimension 2 --rho @odd",
                      "fvi: --rho: odd:2:3: not a finite decimal number");
    write_file("empty", "# nothing\n");
    ck_assert_refused("run --rho @empty",
                      "fvi: --rho: '@empty' has 0 numbers, not 1");
    ck_assert_refused("run --force file:empty",
                      "fvi: --force: empty: has no rows");
    write_file("back", "t F\n0 1\n2 1\n# a rest\n2 1\n");
    ck_assert_refused("run --force file:back",
                      "fvi: --force: back:5:1: t does not increase");
    write_file("short", "0 1\n19.9 1\n");
    ck_assert_refused("run --force file:short",
                      "fvi: --force: short ends at t = 19.9, the run at 20");
    write_file("late", "0.1 1\n21 1\n");
    ck_assert_refused("run --force file:late",
                      "fvi: --force: late begins at t = 0.1, the run at 0");
    write_file("gap", "0 1\n1\n30 1\n");
    ck_assert_refused("run --force file:gap",
                      "fvi: --force: gap:2:2: a number is missing");
    write_file("nan", "0 1\n1 nan\n");
    ck_assert_refused("run --force file:nan",
                      "fvi: --force: nan:2:3: not a finite decimal number");
    const char *const wrong[] = { "nan 1", "1e999 1", "0.0s 1", "0x 1" };
    for (size_t i = 0; i < LEN(wrong); i++) {
        char text[40];
        snprintf(text, sizeof text, "%s\n0 1\n30 1\n", wrong[i]);
        write_file("first", text);
        ck_assert_refused("run --force file:first",
                          "fvi: --force: first:1:1: not a finite decimal number");
    }
    write_file("first", ",1,2\n0 1\n30 1\n");
    ck_assert_refused("run --force file:first",
                      "fvi: --force: first:1:1: an empty field");
    write_file("comma", "t,F,G\n0,1,9\n10,,9\n30,2,9\n");
    ck_assert_refused("run --force file:comma",
                      "fvi: --force: comma:3:4: an empty field");
    write_file("comma", "1,,2,\n");
    ck_assert_refused("run --dimension 2 --rho @comma",
                      "fvi: --rho: comma:1:3: an empty field");
    ck_assert_refused("exact --force t",
                      "fvi: --force: 't' has no exact solution here; "
                      "none, step:A,T and cosine:A,W have");
    ck_assert_refused(
        "exact --potential duffing:1,0.5",
        "fvi: --potential: 'duffing:1,0.5' has no exact solution here; harmonic:C "
        "with C >= 0 and free have");
    ck_assert_refused(
        "run --error 0.1 --method fvi --force 'step:1,1 + step:1,1.05'",
        "fvi: --error: the force 'step:1,1 + step:1,1.05' jumps between two "
        "rows; take other --steps, or --method fvi-adaptive");
    ck_assert_refused(
        "run --error 0.1 --force step:1,1.05 --damping zener:1,0.6,2",
        "fvi: --error: the force 'step:1,1.05' jumps between two rows; take "
        "other --steps");
}
END_TEST

/* A potential that is not defined where the body goes. */
START_TEST(a_run_ends_where_its_potential_does)
{
    ck_assert_int_eq(fvi("run --potential 'x*log(x)*30' --rho 0 --x0 0.01 "
                         "--p0 -3 --columns x"),
                     1);
    ck_assert_ptr_nonnull(strstr(err, "fvi: step "));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the program fvi: errors of one's own problem");
    ADD_CASE(suite, "errors", a_misprint_is_shown,
             wrong_parameters_and_lists_are_refused,
             a_run_ends_where_its_potential_does);
    return run_suite_of_program(suite);
}
