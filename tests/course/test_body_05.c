/* tests/course/test_body_05.c -- The Course, stage 05: the equation in the action. */
#ifndef STAGE
#define STAGE "course/body_05.c"
#endif
#include "stage.h"

/* Chapter 1's run has empty residuals, for every kappa and also where U is not quadratic:
 * each is a sum of N + 10 terms of size at most 2 / h. */
START_TEST(eq_5d_the_run_has_residuals_0)
{
    enum { N = 60 };
    g = 0.5, h = 0.1;
    for (int i = 0; i <= 4; i++) {
        kappa = i / 4.0;
        run(N);
        for (int k = 1; k < N; k++)
            ck_assert_near(residual(N, k, x), 0, (N + 20) * 2 / h * ROUNDING, "kappa = %g, k = %d", kappa, k);
    }
}
END_TEST

/* Any two paths: the measured change of the action is the sum of the two residuals, but for
 * e^2 / 6 times the third derivative of U and the rounding of actions of size 60, over e. */
START_TEST(eq_5e_the_change_is_the_sum_of_two_residuals)
{
    enum { N = 20 };
    static double film[N + 1];
    g = 1, h = 0.5, kappa = 0.5, alpha = 0.3;
    for (int k = 0; k <= N; k++)
        x[k] = cos(k), y[k] = k * (N - k) / 100.0;
    for (int k = 0; k <= N; k++)
        film[k] = y[N - k];
    for (int k = 1; k < N; k++) {
        double sum = residual(N, k, x) + residual(N, N - k, film);
        ck_assert_near(change(N, k), sum, 1e-7 + 60 * 100 * ROUNDING / 1e-4, "k = %d", k);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 05");
    ADD_CASE(suite, "the equation in the action", eq_5d_the_run_has_residuals_0, eq_5e_the_change_is_the_sum_of_two_residuals);
    return run_suite(suite);
}
