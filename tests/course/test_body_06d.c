/* tests/course/test_body_06d.c -- The Course, stage 06d: the integrator in d coordinates. */
#ifndef STAGE
#define STAGE "course/body_06d.c"
#endif
#include "stage.h"
#include "run/whole_run.h"

/* Two bodies with a quartic spring, against the library: |slope of U| <= 30 there, so a
 * step rounds some 200 times, and the springs' curvature of at most 12 lets an error grow. */
START_TEST(eq_6d_two_bodies)
{
    static double rows[141 * DIM];
    fvi_expression *spring;
    ck_assert_int_eq(fvi_expression_parse("(x1^2 + x2^2 + (x1 - x2)^4)/2",
                                          &(fvi_symbols){ .variable = "x", .d = DIM }, NULL, &spring, NULL),
                     FVI_SUCCESS);
    const fvi_system system = { .d = DIM, .mass = m, .damping = rho, .potential = fvi_potential_expression(spring) };
    fvi_run settings = fvi_run_default(&system, x0, p0, h, 140);
    settings.alpha = alpha;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &settings, rows, NULL, NULL), FVI_SUCCESS);
    run(140);
    for (int k = 0; k <= 140; k++)
        for (int i = 0; i < DIM; i++)
            ck_assert_near(x[k][i], rows[k * DIM + i], 100 * rounding_of_run(140, 0.16), "x_%d, %d", k, i);
    fvi_expression_free(spring);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 06d");
    ADD_CASE(suite, "the integrator in d coordinates", eq_6d_two_bodies);
    return run_suite(suite);
}
