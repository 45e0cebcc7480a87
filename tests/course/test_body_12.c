/* tests/course/test_body_12.c -- The Course, stage 12: order two. */
#ifndef STAGE
#define STAGE "course/body_12.c"
#endif
#include "stage.h"
#include "since_11.h"
#include "library_run.h"

/* h = 1, kappa = 1/2, alpha = 1/4: fractions; each step rounds some 32 times. */
START_TEST(eq_12b_the_steps_by_hand)
{
    second = 1, h = 1, kappa = 0.5;
    run(3);
    for (int k = 0; k <= 3; k++) {
        ck_assert_near(x[k], ref_second_x[k], 32 * (k + 1) * ROUNDING, "x_%d", k);
        ck_assert_near(p[k], ref_second_p[k], 32 * (k + 1) * ROUNDING, "p_%d", k);
    }
    second = 0;
}
END_TEST

/* Order 2 for five orders of the damping, bounded on both sides. */
START_TEST(eq_12a_order_two)
{
    second = 1, kappa = 0.5;
    for (alpha = 0; alpha <= 1; alpha += 0.25) {
        double one = at(2, 640), two = at(2, 1280), four = at(2, 2560);
        ck_assert_near(log2((one - two) / (two - four)), 2, 0.005, "alpha = %g", alpha);
    }
    second = 0, alpha = 0.25;
}
END_TEST

START_TEST(eq_12b_the_library_makes_the_same_run)
{
    second = 1, kappa = 0.5, h = 0.1;
    run(140);
    const double *rows = library_run(&fvi_cq2_shifted, alpha, kappa, 140);
    for (int k = 0; k <= 140; k++)
        ck_assert_near(x[k], rows[k], 2 * rounding_of_run(140, 0.16), "k = %d", k);
    second = 0;
}
END_TEST

/* The second body: held at 0, let go with the momentum 1, read backwards. The sum over it is
 * the derivative of the last place by rho; the quotient of differences is off by e^2. */
START_TEST(the_second_body_gives_a_derivative)
{
    enum { N = 200 };
    static double body[N + 1];
    const double e = 1e-4;
    kappa = 0.5, h = 0.1, x0 = 0, p0 = 1;
    run(N);
    for (int k = 0; k <= N; k++)
        body[k] = x[N - k];
    x0 = 1, p0 = 0;
    run(N);
    double sum = 0, moved[2];
    for (int k = 1; k < N; k++)
        sum -= h * body[k] * derivative(2 * alpha, k, z);
    for (int i = 0; i < 2; i++) {
        rho = 0.5 + (i == 0 ? e : -e);
        run(N);
        moved[i] = x[N];
    }
    ck_assert_near(sum, 0.325007, 5e-7, "as printed");
    ck_assert_near((moved[0] - moved[1]) / (2 * e), sum, 10 * e * e, "difference"); /* seen: 3 e^2 */
    rho = 0.5;
}
END_TEST

/* By (12b), too, a push h F at the node k moves the last place by h F times the second body.
 * The motion is linear in the push. Rounding is seen divided by the push, 1e-4. */
START_TEST(eq_12b_the_second_body_answers_for_pushes)
{
    enum { N = 200 };
    static double body[N + 1];
    second = 1, kappa = 0.5, h = 0.1, x0 = 0, p0 = 1;
    run(N);
    for (int k = 0; k <= N; k++)
        body[k] = x[N - k];
    x0 = 1, p0 = 0, push = 1e-3;
    for (int k = 1; k < N; k++) {
        until = (k + 0.5) * h;
        run(N);
        double last = x[N];
        until = (k - 0.5) * h;
        run(N);
        ck_assert_near((last - x[N]) / (h * push), body[k],
                       2 * rounding_of_run(N, 0.16) / (h * push), "k = %d", k);
    }
    second = 0, push = 0, until = 0;
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 12");
    ADD_CASE(suite, "order two", eq_6d_the_steps_by_hand, eq_6d_seven_alphas, eq_10b_the_orders, eq_8b_three_pasts_are_one_at_one_half, eq_11b_modes_are_weights, eq_11c_modes_make_the_same_run, eq_12b_the_steps_by_hand, eq_12a_order_two, eq_12b_the_library_makes_the_same_run, the_second_body_gives_a_derivative, eq_12b_the_second_body_answers_for_pushes);
    return run_suite(suite);
}
