/* tests/exact_solution/test_exact_solution_vectors.c -- H 11: complex functions of many arguments at once.
 * Run alone: make test-exact_solution_vectors */
#include "reference/exact_vectors.h"
#include "exact_rows.h"
#include "system/larger.h"

/* Against the C library, whose own error is below 2 u. exp and exp - 1 in u of their size; a
 * logarithm in u of 1 + |ln|, an angle in u. */
START_TEST(vectors_are_the_functions)
{
    enum { MANY = 999 }; /* no multiple of what a vector holds */
    uint64_t seed = 3;
    double re[MANY], im[MANY], x[MANY], y[MANY];
    void (*const of[])(size_t, double *, double *) = { fvi_vector_exp,
                                                       fvi_vector_expm1,
                                                       fvi_vector_log };
    for (size_t f = 0; f < LEN(of); f++)
        for (double size = 1e-12; size < 1e4; size *= 3) {
            for (int i = 0; i < MANY; i++) {
                re[i] = x[i] = (2 * chance(&seed) - 1) * smaller(size, 700);
                im[i] = y[i] = (2 * chance(&seed) - 1) * size;
                if (f == 2)
                    im[i] = y[i] = fabs(y[i]);
            }
            of[f](MANY, re, im);
            for (int i = 0; i < MANY; i++) {
                const double half = sin(y[i] / 2), e = exp(x[i]);
                double want_re = log(hypot(x[i], y[i])),
                       want_im = atan2(y[i], x[i]), bound = 10 * U;
                if (f < 2) {
                    want_re = f == 0
                                  ? e * cos(y[i])
                                  : expm1(x[i]) * cos(y[i]) - 2 * half * half;
                    want_im = e * sin(y[i]);
                    bound *= hypot(want_re, want_im);
                }
                ck_assert_near(re[i], want_re,
                               bound * (f == 2 ? 1 + fabs(want_re) : 1),
                               "%zu: re, %a %a", f, x[i], y[i]);
                ck_assert_near(im[i], want_im, bound, "%zu: im, %a %a", f, x[i],
                               y[i]);
            }
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("11 exact solution, vectors");
    ADD_CASE(suite, "vectors", vectors_are_the_functions);
    return run_suite(suite);
}
