/* tests/course/test_body_02.c -- The Course, stage 02: half a derivative. */
#ifndef STAGE
#define STAGE "course/body_02.c"
#endif
/* Later programs have a kappa, too; that of Chapter 1 is 1. */
extern double kappa __attribute__((weak));
#include "stage.h"

/* One product and one quotient a weight, of dyadic fractions: no rounding. */
START_TEST(eq_2b_the_weights_of_order_one_half)
{
    weights(0.5, LEN(ref_half_weights));
    for (size_t n = 0; n < LEN(ref_half_weights); n++)
        ck_assert_ulp(w[n], ref_half_weights[n], 0, "w_%zu", n);
}
END_TEST

/* N products, N sums, weights of 2 n roundings each that add up to 2: 4 (N + 2) roundings
 * of the sum of terms of size at most 2, times h^(-1/2). */
START_TEST(eq_2c_half_a_derivative_of_t)
{
    for (size_t i = 0; i < LEN(ref_half_of_t); i++) {
        int N = ref_half_of_t[i].steps;
        h = 1.0 / N;
        weights(0.5, N + 1);
        for (int k = 0; k <= N; k++)
            z[k] = k * h;
        ck_assert_near(derivative(0.5, N, z), ref_half_of_t[i].want,
                       8 * (N + 2) * sqrt(N) * ROUNDING, "N = %d", N);
    }
}
END_TEST

/* (2e): order 1/4 twice is order 1/2 at each node, here of any path. */
START_TEST(eq_2e_orders_add)
{
    enum { N = 40 };
    static double path[N + 1], once[N + 1];
    h = 0.25;
    for (int k = 0; k <= N; k++)
        path[k] = sin(3.0 * k) + k;
    weights(0.25, N + 1);
    for (int k = 0; k <= N; k++)
        once[k] = derivative(0.25, k, path);
    for (int k = 0; k <= N; k++) {
        weights(0.25, N + 1);
        double twice = derivative(0.25, k, once);
        weights(0.5, N + 1);
        ck_assert_near(twice, derivative(0.5, k, path), 12 * (N + 6) * N * ROUNDING, "k = %d", k);
    }
}
END_TEST

START_TEST(eq_1c_the_run_of_chapter_1)
{
    h = 0.1;
    if (&kappa != NULL)
        kappa = 1;
    run(140);
    for (int k = 0; k <= 140; k++)
        ck_assert_near(x[k], ref_first[k].x, rounding_of_run(140, 0.16), "x_%d", k);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 02");
    ADD_CASE(suite, "half a derivative", eq_2b_the_weights_of_order_one_half, eq_2c_half_a_derivative_of_t, eq_2e_orders_add, eq_1c_the_run_of_chapter_1);
    return run_suite(suite);
}
