/* tests/course/test_body_03.c -- The Course, stage 03: a step from an action. */
#ifndef STAGE
#define STAGE "course/body_03.c"
#endif
#include "stage.h"

/* Fractions with h = 1. Each step has some 16 roundings, and the step turns x and p. */
START_TEST(eq_3d_and_3e_the_triples_3_4_5)
{
    rho = 0, h = 1, kappa = 0.5;
    run(6);
    for (int k = 0; k <= 6; k++) {
        ck_assert_near(x[k], ref_undamped_half_x[k], 16 * (k + 1) * ROUNDING, "x_%d", k);
        ck_assert_near(p[k], ref_undamped_half_p[k], 16 * (k + 1) * ROUNDING, "p_%d", k);
    }
    kappa = 1; /* whole numbers: exact, and back after six steps */
    run(6);
    for (int k = 0; k <= 6; k++) {
        ck_assert_ulp(x[k], ref_undamped_one_x[k], 0, "x_%d", k);
        ck_assert_ulp(p[k], ref_undamped_one_p[k], 0, "p_%d", k);
    }
}
END_TEST

/* Newton's iteration solves (3d) also where U is not quadratic, for every kappa. */
START_TEST(eq_3d_the_step_is_solved)
{
    g = 1, rho = 0.5, h = 0.1;
    for (int i = 0; i <= 10; i++) {
        kappa = i / 10.0;
        for (int j = -8; j <= 8; j++) {
            double q = j / 4.0, r = 1 - j / 8.0, d = solve(m / h, q, r);
            double left = m / h * d + kappa * h * dU(q + (1 - kappa) * d);
            ck_assert_near(left, r, 32 * (fabs(m / h * d) + fabs(r) + 4) * ROUNDING,
                           "kappa = %g, q = %g", kappa, q);
        }
    }
}
END_TEST

/* The energy of kappa = 1/2 stays; Euler's is multiplied by 1 + h^2 in each step. */
START_TEST(eq_3e_the_energy_stays_and_eulers_does_not)
{
    g = 0, rho = 0, h = 0.1, kappa = 0.5;
    run(2000);
    for (int k = 0; k <= 2000; k++)
        ck_assert_near(energy(x[k], p[k]), 0.5, 16 * (k + 1) * ROUNDING, "k = %d", k);
    ck_assert_near(euler(2000), 0.5 * pow(1.01, 2000), 4e4 * pow(1.01, 2000) * ROUNDING, "Euler");
}
END_TEST

START_TEST(eq_1c_the_run_of_chapter_1_by_kappa_1)
{
    rho = 0.5, h = 0.1, kappa = 1;
    run(140);
    for (int k = 0; k <= 140; k++)
        ck_assert_near(x[k], ref_first[k].x, rounding_of_run(140, 0.16), "x_%d", k);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 03");
    ADD_CASE(suite, "a step from an action", eq_3d_and_3e_the_triples_3_4_5, eq_3d_the_step_is_solved, eq_3e_the_energy_stays_and_eulers_does_not, eq_1c_the_run_of_chapter_1_by_kappa_1);
    return run_suite(suite);
}
