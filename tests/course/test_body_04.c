/* tests/course/test_body_04.c -- The Course, stage 04: a second body. */
#ifndef STAGE
#define STAGE "course/body_04.c"
#endif
#include "stage.h"

static void the_pair(void)
{
    c = 0, alpha = 0.5, h = 1.0 / REF_GRID;
    for (int k = 0; k <= REF_GRID; k++)
        x[k] = k * h, y[k] = k * h - 1;
}

/* 16 nodes, dyadic places: only the two powers h^(-1/2) and the sums round. */
START_TEST(eq_4c_the_action_of_two_bodies)
{
    the_pair();
    ck_assert_near(action(REF_GRID, x, y), ref_action, 1000 * ROUNDING, "S");
}
END_TEST

/* A difference of actions of size 2 over 2e-4: 1000 roundings become 1e7 of them. */
START_TEST(eq_4d_both_bent_alike_and_one_alone)
{
    the_pair();
    ck_assert_near(slope(REF_GRID, 1, 1), 0, 1e7 * ROUNDING, "both");
    ck_assert_near(slope(REF_GRID, 1, 0), ref_alone, 1e7 * ROUNDING, "x alone");
    ck_assert_near(slope(REF_GRID, 0, 1), -ref_alone, 1e7 * ROUNDING, "y alone");
}
END_TEST

/* The derivative that looks ahead is that of the film, run backwards. */
START_TEST(eq_4a_ahead_is_the_film)
{
    enum { N = 30 };
    static double film[N + 1];
    h = 0.1;
    weights(0.3, N + 1);
    for (int k = 0; k <= N; k++)
        x[k] = cos(k), film[N - k] = x[k];
    for (int k = 0; k <= N; k++)
        ck_assert_ulp(ahead(0.3, k, N, x), derivative(0.3, N - k, film), 0, "k = %d", k);
}
END_TEST

/* The run and its film: the slope of the action is that of rounding, whatever U is. */
START_TEST(eq_4d_the_run_and_its_film)
{
    enum { N = 60 };
    c = 1, g = 1, alpha = 0.25, h = 0.1, kappa = 0.5;
    run(N);
    for (int k = 0; k <= N; k++)
        y[k] = x[N - k];
    double size = 1e-8 * 100 + 1e7 * ROUNDING; /* e^2 times the third derivative of S */
    ck_assert_near(slope(N, 1, 1), 0, size, "both");
    ck_assert(fabs(slope(N, 1, 0)) > 0.01);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 04");
    ADD_CASE(suite, "a second body", eq_4c_the_action_of_two_bodies, eq_4d_both_bent_alike_and_one_alone, eq_4a_ahead_is_the_film, eq_4d_the_run_and_its_film);
    return run_suite(suite);
}
