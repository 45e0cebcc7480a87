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

/* The mirror of a run makes the action stationary if the spring is linear or kappa is 0, 1/2
 * or 1. Else the film is the mirror of a run with 1 - kappa. The quotient of differences is
 * off by e^2 times the third derivative of the action, here below 6 (seen: 7e-9). */
START_TEST(eq_5e_which_film_belongs_to_which_kappa)
{
    enum { N = 20 };
    h = 0.5, alpha = 0.25;
    for (int i = 0; i <= 4; i++)
        for (g = 0; g <= 1; g++)
            for (int other = 0; other <= 1; other++) {
                double here = i / 4.0;
                kappa = other ? 1 - here : here;
                run(N);
                for (int k = 0; k <= N; k++)
                    y[k] = x[N - k];
                kappa = here;
                run(N);
                int stationary = g == 0 || i % 2 == 0 || other, moved = 0;
                for (int k = 1; k < N; k++) {
                    double size = fabs(change(N, k));
                    moved += size > 0.01;
                    if (stationary)
                        ck_assert_near(size, 0, 6e-8 + 60 * 100 * ROUNDING / 1e-4, "kappa = %g, g = %g, k = %d", kappa, g, k);
                }
                ck_assert_msg(stationary || moved > 0, "kappa = %g: no change above 0.01", kappa);
            }
    g = 0;
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 05");
    ADD_CASE(suite, "the equation in the action", eq_5d_the_run_has_residuals_0, eq_5e_the_change_is_the_sum_of_two_residuals, eq_5e_which_film_belongs_to_which_kappa);
    return run_suite(suite);
}
