/* tests/expression/test_expression.c -- Values of expressions, and their derivatives.
 * Run alone: make test-expression */
#include "parsed.h"
#include "run/whole_run.h"

#include "expression_ref.h"
#include "system/larger.h"

#include <stdlib.h>
#include <time.h>

/* d^2U/dx_i dx_j, i <= j, in the storage of the potential; 0 outside of it. */
static double entry(const fvi_potential *P, const double *H, int i, int j)
{
    const size_t k = (size_t)(j - i);
    return k < P->diagonals ? H[(size_t)i * P->diagonals + k] : 0;
}

/* The bound comes with the reference: the errors of all operations, carried on to first
 * order. Terms are summed in another order than the bound has it, and its second order is
 * left out: twice of it is allowed. Seen: 0.23 of that. */
static void ck_assert_derivatives(const char *text, size_t d, const double *x,
                                  int i, int j, const double want[3],
                                  const double units[3])
{
    const fvi_symbols names = { "x", d, NULL, 0 };
    fvi_expression *e = parsed(text, &names, NULL);
    const fvi_potential P = fvi_potential_expression(e);
    double got[3], grad[3], H[9];
    P.value(d, x, P.params, &got[0]);
    P.gradient(d, x, P.params, grad);
    P.hessian(d, x, P.params, H);
    got[1] = grad[i];
    got[2] = entry(&P, H, i, j);
    for (int n = 0; n < 3; n++)
        ck_assert_near(got[n], want[n], 2 * U * units[n] + 0x1p-1000,
                       "%s, derivative %d by %d, %d", text, n, i + 1, j + 1);
    fvi_expression_free(e);
}

START_TEST(derivatives_are_those_of_the_formula)
{
    ck_assert_uint_ge(LEN(ref_one), 100);
    for (size_t n = 0; n < LEN(ref_one); n++)
        ck_assert_derivatives(ref_one[n].text, 1, ref_one[n].x, 0, 0,
                              ref_one[n].want, ref_one[n].units);
}
END_TEST

START_TEST(derivatives_by_two_coordinates_are_those_of_the_formula)
{
    ck_assert_uint_ge(LEN(ref_three), 200);
    for (size_t n = 0; n < LEN(ref_three); n++)
        ck_assert_derivatives(ref_three[n].text, 3, ref_three[n].x,
                              ref_three[n].i, ref_three[n].j, ref_three[n].want,
                              ref_three[n].units);
}
END_TEST

/* Whole powers at 0, where x^n by logarithms would not be defined. */
START_TEST(powers_are_right_where_logarithms_are_not)
{
    static const struct {
        const char *text;
        double x, want[3];
    } cases[] = { { "x^2", 0, { 0, 0, 2 } },
                  { "x^1", 0, { 0, 1, 0 } },
                  { "x^0", 0, { 1, 0, 0 } },
                  { "x^3", -2, { -8, 12, -12 } },
                  { "x**4", 0, { 0, 0, 0 } },
                  { "x^-2", -2, { 0.25, 0.25, 0.375 } },
                  { "(-x)^20", 1, { 1, 20, 380 } },
                  { "x^2.5", 4, { 32, 20, 7.5 } },
                  { "2^x", 0, { 1, 0.6931471805599453, 0.4804530139182014 } },
                  { "x^k", -2, { -8, 12, -12 } },
                  { "abs(x)", -3, { 3, -1, 0 } },
                  { "abs(x)", 0, { 0, 0, 0 } },
                  { "sign(x)", -3, { -1, 0, 0 } },
                  { "sign(x)", 0, { 0, 0, 0 } },
                  { "x*sign(x)", 2, { 2, 1, 0 } },
                  { "min(x^2, x^3)", 2, { 4, 4, 2 } },
                  { "min(x^2, x^3)", -2, { -8, 12, -12 } },
                  { "max(x^2, x^3)", 2, { 8, 12, 12 } },
                  { "max(x^2, x^3)", -2, { 4, -4, 2 } },
                  { "max(x^2, x^3)", 1, { 1, 2.5, 4 } }, /* alike: the mean */
                  { "min(x, -x)", 0, { 0, 0, 0 } },
                  { "max(min(x, 2), -k)", 7, { 2, 0, 0 } },
                  { "min(max(3, 5), 4)*x", 1, { 4, 4, 0 } },
                  { "-x^2", 3, { -9, -6, -2 } },
                  { "2^3^2*x", 1, { 512, 512, 0 } },
                  { "2^-1*x", 1, { 0.5, 0.5, 0 } },
                  { "8/4/2*x", 1, { 1, 1, 0 } },
                  { "1-2-3+x", 1, { -3, 1, 0 } } };
    const double three = 3;
    const char *const k[] = { "k" };
    const fvi_symbols names = { "x", 1, k, 1 };
    for (size_t n = 0; n < LEN(cases); n++) {
        fvi_expression *e = parsed(cases[n].text, &names, &three);
        const fvi_potential P = fvi_potential_expression(e);
        double got[3];
        P.value(1, &cases[n].x, P.params, &got[0]);
        P.gradient(1, &cases[n].x, P.params, &got[1]);
        P.hessian(1, &cases[n].x, P.params, &got[2]);
        for (int i = 0; i < 3; i++)
            ck_assert_ulp(got[i], cases[n].want[i], 1, "%s, %d", cases[n].text,
                          i);
        fvi_expression_free(e);
    }
}
END_TEST

/* Outside of its domain a function is NaN, and so are its derivatives. */
START_TEST(what_is_not_defined_is_nan)
{
    static const struct {
        const char *text;
        double x;
    } cases[] = { { "sqrt(x)", -1 },    { "log(x)", -1 }, { "asin(x)", 1.5 },
                  { "acos(x)", -2 },    { "x^0.5", -1 },  { "x^x", -0.5 },
                  { "log(sin(x))", -1 },  { "sign(sqrt(x))", -1 },
                  { "min(log(x), 1)", -1 }, { "max(1, log(x))", -1 } };
    for (size_t n = 0; n < LEN(cases); n++) {
        fvi_expression *e = parsed(cases[n].text, &one, NULL);
        const fvi_potential P = fvi_potential_expression(e);
        double v, g, H;
        P.value(1, &cases[n].x, P.params, &v);
        P.gradient(1, &cases[n].x, P.params, &g);
        P.hessian(1, &cases[n].x, P.params, &H);
        ck_assert_msg(isnan(v) && isnan(g) && isnan(H), "%s: %g %g %g",
                      cases[n].text, v, g, H);
        fvi_expression_free(e);
    }
}
END_TEST

/* A factor or a sign before a sum goes to each term: the same numbers as when it is
 * written out. Each product is rounded once: 16 u times the sizes of the terms is
 * generous. Seen: 0. */
START_TEST(a_factor_before_a_sum_goes_to_each_term)
{
    static const char *const same[][2] = {
        { "k*(x1^2 + x2^2)", "k*x1^2 + k*x2^2" },
        { "(x1^2 - x2)*k", "x1^2*k - x2*k" },
        { "(x1 - x2)/k", "x1/k - x2/k" },
        { "-(x1 - x2*x1)", "-x1 + x2*x1" },
        { "x2 - (x1 - k*(x2 - x1^2))", "x2 - x1 + k*x2 - k*x1^2" },
        { "k*(-(x1 - x2))", "-k*x1 + k*x2" },
        { "(-x1)/k", "-(x1/k)" },
        { "k/(x1 + x2)", "k/(x2 + x1)" },
    };
    const char *const k[] = { "k" };
    const double value = 3, x[] = { 0.7, -1.3 };
    const fvi_symbols names = { "x", 2, k, 1 };
    for (size_t n = 0; n < LEN(same); n++) {
        double v[2], g[2][2];
        for (int i = 0; i < 2; i++) {
            fvi_expression *e = parsed(same[n][i], &names, &value);
            const fvi_potential P = fvi_potential_expression(e);
            P.value(2, x, P.params, &v[i]);
            P.gradient(2, x, P.params, g[i]);
            fvi_expression_free(e);
        }
        ck_assert_near(v[0], v[1], 16 * U * 10, "%s", same[n][0]);
        for (int i = 0; i < 2; i++)
            ck_assert_near(g[0][i], g[1][i], 16 * U * 10, "%s", same[n][0]);
    }
}
END_TEST

/* U = k x1^2 x2 + exp(c x2): by k and c, at numbers whose products are exact. */
START_TEST(parameters_have_derivatives_too)
{
    const char *const kc[] = { "k", "c" };
    const double values[] = { 3, 0 }, x[] = { 2, 5 };
    const fvi_symbols names = { "x", 2, kc, 2 };
    fvi_expression *e = parsed("k*x1^2*x2 + exp(c*x2)", &names, values);
    double by, grad[2];
    fvi_expression_parameter_gradient(e, 0, x, &by, grad);
    ck_assert(by == 20 && grad[0] == 20 && grad[1] == 4);
    fvi_expression_parameter_gradient(e, 1, x, &by, grad);
    ck_assert(by == 5 && grad[0] == 0 && grad[1] == 1);
    fvi_expression_parameter_gradient(e, 1, x, &by, NULL);
    ck_assert(by == 5);
    ck_assert(fvi_expression_value(e, x) == 61);
    fvi_expression_free(e);
    const double exponent = 2, two = 2; /* x^k by k: x^k log x */
    const fvi_symbols power = { "x", 1, kc, 1 };
    e = parsed("x^k", &power, &exponent);
    fvi_expression_parameter_gradient(e, 0, &two, &by, grad);
    ck_assert_ulp(by, 4 * 0.69314718055994531, 1, "x^k");
    ck_assert_ulp(grad[0], 2 * (1 + 2 * 0.69314718055994531), 2, "2 x + ...");
    fvi_expression_free(e);
}
END_TEST

/* The trajectory of a fractional Duffing oscillator, and of a chain, are those of the
 * potentials that are built in, but for what the roundings make of it: 10^-12, for 400
 * steps of a motion that is not chaotic. Seen: 4e-16. */
START_TEST(a_run_is_that_of_the_potential_that_is_built_in)
{
    const double m[] = { 1, 1 }, rho[] = { 0.3, 0.3 }, x0[] = { 1, 0.25 },
                 p0[] = { 0.5, 0 }, cg[] = { 1.25, 0.5 }, aw[] = { 0.25, 2 };
    const char *const kc[] = { "c", "g" };
    static const char *const text[] = {
        "c*x^2/2 + g*x^4/4",
        "c/2*(x1^2 + (x2 - x1)^2 + x2^2) + g/4*(x1^4 + (x2 - x1)^4 + x2^4)"
    };
    static double x[2][401 * 2];
    for (size_t d = 1; d <= 2; d++) {
        const fvi_symbols names = { "x", d, kc, 2 }, time = { "t", 1, NULL, 0 };
        fvi_expression *e = parsed(text[d - 1], &names, cg),
                       *F = parsed("cos(2*t)/4", &time, NULL);
        const fvi_system s[] = { { d, m, rho, fvi_potential_expression(e),
                                   fvi_force_expression(F), NULL, NULL },
                                 { d, m, rho,
                                   d == 1 ? fvi_potential_duffing(cg)
                                          : fvi_potential_chain(cg),
                                   fvi_force_cosine(aw), NULL, NULL } };
        for (int i = 0; i < 2; i++) {
            fvi_run run = fvi_run_default(&s[i], x0, p0, 0.05, 400);
            run.alpha = 0.3;
            ck_assert_int_eq(
                fvi_trajectory(&fvi_fractional, &run, x[i], NULL, NULL),
                FVI_SUCCESS);
        }
        for (size_t k = 0; k <= 400 * d; k++)
            ck_assert_near(x[0][k], x[1][k], 1e-12, "d=%zu k=%zu", d, k);
        fvi_expression_free(e);
        fvi_expression_free(F);
    }
}
END_TEST

static double seconds_of(const fvi_potential *P, double *last)
{
    const double m = 1, rho = 0.2, x0 = 1, p0 = 0.5;
    const fvi_system s = { 1, &m, &rho, *P, { 0 }, NULL, NULL };
    const fvi_run run = fvi_run_default(&s, &x0, &p0, 0.1, 20000);
    static double x[20001];
    double best = INFINITY;
    for (int round = 0; round < 7; round++) {
        const clock_t from = clock();
        fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
        best = smaller(best, (double)(clock() - from) / CLOCKS_PER_SEC);
    }
    *last = x[1000];
    return best;
}

/* What typing costs, the fastest of seven runs over that of the same built in, is seen and not
 * asserted: on a machine that others use it was 1.6 to 2.9 times as much, and up to 4.3 in
 * slow spells. What must be so is that the motion is the same. */
START_TEST(a_typed_potential_moves_as_one_that_is_built_in)
{
    const double cg[] = { 1, 0.5 };
    const struct {
        const char *text;
        fvi_potential built_in;
    } pairs[] = { { "x^2/2", fvi_potential_harmonic(cg) },
                  { "x^2/2 + x^4/8", fvi_potential_duffing(cg) },
                  { "1 - cos(x)", fvi_potential_pendulum(cg) } };
    for (size_t n = 0; n < LEN(pairs); n++) {
        fvi_expression *e = parsed(pairs[n].text, &one, NULL);
        const fvi_potential P = fvi_potential_expression(e);
        double x[2];
        seen(seconds_of(&P, &x[0]) / seconds_of(&pairs[n].built_in, &x[1]),
             "typed by built in");
        ck_assert_near(x[0], x[1], 1e-10, "%s", pairs[n].text);
        fvi_expression_free(e);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("expressions");
    ADD_CASE(suite, "values", derivatives_are_those_of_the_formula,
             derivatives_by_two_coordinates_are_those_of_the_formula,
             powers_are_right_where_logarithms_are_not,
             what_is_not_defined_is_nan, parameters_have_derivatives_too,
             a_factor_before_a_sum_goes_to_each_term,
             a_run_is_that_of_the_potential_that_is_built_in,
             a_typed_potential_moves_as_one_that_is_built_in);
    return run_suite(suite);
}
