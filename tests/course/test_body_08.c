/* tests/course/test_body_08.c -- The Course, stage 08: friction. */
#ifndef STAGE
#define STAGE "course/body_08.c"
#endif
#include "stage.h"
#include "since_06.h"

/* 1, 0, -1/2: half a derivative, and half a derivative of that. */
START_TEST(eq_8a_twice_half_is_a_difference)
{
    static double once[4];
    double path[] = { 1, 0, -0.5 };
    h = 1;
    weights(0.5, 4);
    for (int k = 0; k < 3; k++) {
        once[k] = derivative(0.5, k, path);
        ck_assert_ulp(once[k], ref_once[k], 0, "once, k = %d", k);
    }
    for (int k = 1; k < 3; k++)
        ck_assert_ulp(derivative(0.5, k, once), path[k] - path[k - 1], 0, "twice, k = %d", k);
}
END_TEST

START_TEST(eq_8b_friction_with_and_without_a_memory)
{
    alpha = 0.5, h = kappa = 1;
    run(4);
    for (int k = 0; k <= 4; k++)
        ck_assert_ulp(x[k], ref_friction[k], 0, "k = %d", k);
    kappa = 0.5, h = 0.1;
    ck_assert_near(apart(140), 0, rounding_of_run(140, 0.5), "apart");
}
END_TEST

/* Order 1 for the mass m, order 2 for m - rho h/2: between two steps the error falls by a
 * factor that tends to 2, or to 4; at these steps the next term is within 7 per cent. */
START_TEST(eq_8d_which_mass_it_is)
{
    alpha = 0.5, kappa = 0.5, h = 0.025;
    double coarse = error(14, m), finer, coarse_light = error(14, m - rho * h / 2), finer_light;
    h = 0.0125;
    finer = error(14, m), finer_light = error(14, m - rho * h / 2);
    ck_assert_near(coarse / finer, 2, 0.14, "mass m");
    ck_assert_near(coarse_light / finer_light, 4, 0.28, "mass m - rho h/2");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 08");
    ADD_CASE(suite, "friction", eq_6d_the_steps_by_hand, eq_6d_seven_alphas, eq_8a_twice_half_is_a_difference, eq_8b_friction_with_and_without_a_memory, eq_8d_which_mass_it_is);
    return run_suite(suite);
}
