/* tests/course/test_body_11.c -- The Course, stage 11: a million steps. */
#ifndef STAGE
#define STAGE "course/body_11.c"
#endif
#include "stage.h"
#include "since_11.h"

int main(void)
{
    Suite *suite = suite_create("stage 11");
    ADD_CASE(suite, "a million steps", eq_6d_the_steps_by_hand, eq_6d_seven_alphas, eq_10b_the_orders, eq_8b_three_pasts_are_one_at_one_half, eq_11b_modes_are_weights, eq_11c_modes_make_the_same_run);
    return run_suite(suite);
}
