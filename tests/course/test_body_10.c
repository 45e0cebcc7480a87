/* tests/course/test_body_10.c -- The Course, stage 10: how wrong, and how long a step. */
#ifndef STAGE
#define STAGE "course/body_10.c"
#endif
#include "stage.h"
#include "since_10.h"

START_TEST(eq_10c_the_longest_stable_step)
{
    kappa = 0.5, h = pow(2, 5 / 3.0);
    ck_assert_near(load(), 1, 16 * ROUNDING, "load");
    h *= 0.99;
    run(400);
    ck_assert(fabs(x[400]) < 0.1);
    h *= 1.02 / 0.99;
    run(400);
    ck_assert(fabs(x[400]) > 1e3 && x[400] * x[399] < 0);
}
END_TEST

/* Beyond the longest step the path grows by the factor r at which masses, spring and damping
 * balance; after 100 steps the rest of the motion is some 1e-9 of it. */
START_TEST(eq_10c_the_factor_of_growth)
{
    kappa = 0.5, h = 3.4;
    run(100);
    double r = -x[100] / x[99], masses = (1 + r) * (1 + r) / r, spring = h * h * c / 4 * (r - 1) * (r - 1) / r;
    ck_assert_near(r, 1.255, 0.0005, "r");
    ck_assert_near(masses + spring, rho * pow(h, 2 - 2 * alpha) * pow(1 + 1 / r, 2 * alpha), 1e-8, "balance");
}
END_TEST

/* (10d): above alpha = 1/2 velocities are summed; the pasts are as before. */
START_TEST(eq_10d_velocities_make_the_same_run)
{
    h = kappa = 1, alpha = 0.75, p0 = 0.5;
    for (size_t i = 0; i < LEN(ref_pasts); i++) {
        past = ref_pasts[i].past;
        run(3);
        for (int k = 0; k <= 3; k++)
            ck_assert_ulp(x[k], ref_pasts[i].x[k], 0, "past %d, k = %d", past, k);
    }
    past = HELD, p0 = 0, alpha = 0.25;
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 10");
    ADD_CASE(suite, "how wrong, and how long a step", eq_6d_the_steps_by_hand, eq_6d_seven_alphas, eq_10b_the_orders, eq_8b_three_pasts_are_one_at_one_half, eq_10c_the_longest_stable_step, eq_10c_the_factor_of_growth, eq_10d_velocities_make_the_same_run);
    return run_suite(suite);
}
