/* tests/course/test_body_06.c -- The Course, stage 06: the integrator. */
#ifndef STAGE
#define STAGE "course/body_06.c"
#endif
#include "stage.h"
#include "since_06.h"
#include "library_run.h"

/* Two programs without a common line: each may be off by the rounding of a run. */
START_TEST(eq_6d_the_library_makes_the_same_run)
{
    h = 0.1;
    for (int i = 0; i <= 4; i++) {
        kappa = i / 4.0;
        run(140);
        const double *rows = library_run(&fvi_fractional, alpha, kappa, 140);
        for (int k = 0; k <= 140; k++)
            ck_assert_near(x[k], rows[k], 2 * rounding_of_run(140, 0.16), "kappa = %g, k = %d", kappa, k);
    }
}
END_TEST

/* F is push until the time until; at the node itself it is still there. */
START_TEST(the_force_ends)
{
    push = 8, until = 1;
    ck_assert(F(0) == 8 && F(1) == 8 && F(1 + 1e-15) == 0);
    push = until = 0;
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 06");
    ADD_CASE(suite, "the integrator", eq_6d_the_steps_by_hand, eq_6d_seven_alphas, eq_6d_the_library_makes_the_same_run, the_force_ends);
    return run_suite(suite);
}
