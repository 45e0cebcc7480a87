/* tests/expression/test_expression_text.c -- Texts of expressions: texts that are understood, and the place of an
 * error in a wrong text.
 * Run alone: make test-expression_text */
#include "parsed.h"

#include <stdlib.h>

/* Each misprint with its place; places count from 0. */
START_TEST(a_misprint_is_found_at_its_place)
{
    static const struct {
        const char *text;
        size_t at;
        const char *reason;
    } slips[] = { { "x^4/4 - x^^2", 10,
                    "a number, a name or ( is wanted here" },
                  { "x^4/4 - y", 8, "no such name" },
                  { "(x+1", 4, "a ) is missing" },
                  { "x x", 2, "an operator is wanted here" },
                  { "2x", 1, "an operator is wanted here" },
                  { "0x10", 1, "an operator is wanted here" },
                  { "", 0, "it ends too early" },
                  { "x +", 3, "it ends too early" },
                  { "x)", 1, "an operator is wanted here" },
                  { "1e999*x", 0, "a number is too large" },
                  { "1e+*x", 3, "the exponent is missing" },
                  { ".x", 0, "a digit is missing" },
                  { "sin x", 4, "a ( is missing behind the function" },
                  { "sin(x", 5, "a ) is missing" },
                  { "x1 + x2", 5, "no such name" },
                  { "x01", 0, "no such name" },
                  { "nan", 0, "no such name" },
                  { "sine(x)", 0, "no such name" },
                  { "0,5", 1, "an operator is wanted here" },
                  { "x*log(-1)", 9, "a constant before this is not finite" },
                  { "x + 1/0", 7, "a constant before this is not finite" },
                  { "\xc3\xa9", 0, "a number, a name or ( is wanted here" } };
    fvi_expression *e = NULL;
    for (size_t n = 0; n < LEN(slips); n++) {
        fvi_misprint wrong = { 99, "" };
        ck_assert_int_eq(
            fvi_expression_parse(slips[n].text, &one, NULL, &e, &wrong),
            FVI_EINVAL);
        ck_assert_msg(wrong.at == slips[n].at
                          && strcmp(wrong.reason, slips[n].reason) == 0,
                      "%s: %zu: %s", slips[n].text, wrong.at, wrong.reason);
    }
    ck_assert_ptr_null(e);
    ck_assert_int_eq(fvi_expression_parse(NULL, &one, NULL, &e, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_expression_parse("x", NULL, NULL, &e, NULL),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_expression_parse("x", &one, NULL, NULL, NULL),
                     FVI_EFAULT);
}
END_TEST

/* `front` n times, the middle, `back` n times. */
static char *nested(size_t n, const char *front, const char *middle,
                    const char *back)
{
    const size_t f = strlen(front), b = strlen(back), m = strlen(middle);
    char *text = calloc(n * (f + b) + m + 1, 1);
    for (size_t i = 0; i < n; i++) {
        memcpy(text + i * f, front, f);
        memcpy(text + n * f + m + i * b, back, b);
    }
    memcpy(text + n * f, middle, m);
    return text;
}

static int status_of(char *text, size_t d)
{
    const fvi_symbols names = { "x", d, NULL, 0 };
    fvi_expression *e = NULL;
    int status = fvi_expression_parse(text, &names, NULL, &e, NULL);
    fvi_expression_free(e);
    free(text);
    return status;
}

/* However deep or long a text is, it is understood or refused. */
START_TEST(no_text_is_too_deep_or_too_long_to_be_refused)
{
    ck_assert_int_eq(status_of(nested(98, "(", "x", ")"), 1), FVI_SUCCESS);
    ck_assert_int_eq(status_of(nested(100, "(", "x", ")"), 1), FVI_EINVAL);
    ck_assert_int_eq(status_of(nested(100000, "(", "x", ")"), 1), FVI_EINVAL);
    ck_assert_int_eq(status_of(nested(100000, "-", "x", ""), 1), FVI_EINVAL);
    ck_assert_int_eq(status_of(nested(100000, "2^", "x", ""), 1), FVI_EINVAL);
    ck_assert_int_eq(status_of(nested(100000, "sin(", "x", ")"), 1),
                     FVI_EINVAL);
    ck_assert_int_eq(status_of(nested(1000, "", "x", "+x"), 1), FVI_SUCCESS);
    ck_assert_int_eq(status_of(nested(300000, "", "x", "+x"), 1), FVI_EINVAL);
    ck_assert_int_eq(status_of(nested(100000, "", "x1", "+x2^2"), 2),
                     FVI_SUCCESS); /* terms that are short */
    ck_assert_int_eq(status_of(nested(100000, "", "x1", "-x2^2"), 2),
                     FVI_SUCCESS);
    ck_assert_int_eq(status_of(nested(500, "9", "x", ""), 1), FVI_EINVAL);
}
END_TEST

/* Diagonal, banded, full, and quadratic or not. */
START_TEST(the_structure_is_seen)
{
    static const struct {
        const char *text;
        size_t d, diagonals;
        int quadratic;
    } cases[] = {
        { "x^2/2", 1, 1, 1 },
        { "3", 1, 1, 1 },
        { "x*x - x/2 + 1", 1, 1, 1 },
        { "x^3", 1, 1, 0 },
        { "x*x*x", 1, 1, 0 },
        { "1/x", 1, 1, 0 },
        { "sin(x)", 1, 1, 0 },
        { "sin(2)*x^2", 1, 1, 1 },
        { "x^2^1", 1, 1, 1 },
        { "x1^4 + x2^4 + x4^2", 4, 1, 0 },
        { "(x1^2 + x2^2 + x3^2 + x4^2)/2", 4, 1, 1 },
        { "-3*(x1^2 - (x2^2 + sin(x3)))*2", 4, 1, 0 },
        { "x1*x2 + x2*x3 + x3*x4", 4, 2, 1 },
        { "cos(x1 - x2) + cos(x4 - x3)", 4, 2, 0 },
        { "x1*x3 + x4", 4, 3, 1 },
        { "sqrt(x1^2 + x2^2 + x3^2 + x4^2)", 4, 4, 0 },
        { "x4*x1", 4, 4, 1 },
    };
    for (size_t n = 0; n < LEN(cases); n++) {
        const fvi_symbols names = { "x", cases[n].d, NULL, 0 };
        fvi_expression *e = parsed(cases[n].text, &names, NULL);
        const fvi_potential P = fvi_potential_expression(e);
        ck_assert_msg(P.diagonals == cases[n].diagonals
                          && P.quadratic(P.params) == cases[n].quadratic,
                      "%s: %zu diagonals", cases[n].text, P.diagonals);
        fvi_expression_free(e);
    }
}
END_TEST

START_TEST(names_are_free_or_taken)
{
    ck_assert(fvi_symbol_is_free("k", "x") && fvi_symbol_is_free("_k2", "x"));
    ck_assert(fvi_symbol_is_free("xi", "x") && fvi_symbol_is_free("t", "x"));
    ck_assert(!fvi_symbol_is_free("x", "x") && !fvi_symbol_is_free("x12", "x"));
    ck_assert(!fvi_symbol_is_free("sin", "x") && !fvi_symbol_is_free("pi", "x"));
    ck_assert(!fvi_symbol_is_free("", "x") && !fvi_symbol_is_free("2k", "x"));
    ck_assert(!fvi_symbol_is_free("k-1", "x") && !fvi_symbol_is_free("t", "t"));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("texts of expressions");
    ADD_CASE(suite, "values", the_structure_is_seen);
    ADD_CASE(suite, "errors", a_misprint_is_found_at_its_place,
             no_text_is_too_deep_or_too_long_to_be_refused,
             names_are_free_or_taken);
    return run_suite(suite);
}
