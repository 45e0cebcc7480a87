/* tests/test_lobatto_stability.c -- Chapter 17: how long a step may be.
 * Run alone: make test-lobatto_stability */
#include "lobatto_runs.h"

enum { N = 1200 };
static double x[N + 1], p[N + 1];

//> stability
/* (17.15), x'' + x = 0: 2, 2 sqrt(2), sqrt(42 - 6 sqrt(29)), a thousandth below
 * and above: bounded, or growing exponentially. Seen: 22 at most; 3e6 at least. */
START_TEST(eq_17_15_stable_below_the_first_gap)
{
    const double bound[] = { 0, 0, 2, M_SQRT2 * 2, sqrt(42 - 6 * sqrt(29)) };
    for (size_t s = 2; s <= 4; s++)
        for (int above = 0; above <= 1; above++) {
            const setup a = { .s = s,
                              .x0 = 1,
                              .p0 = 1,
                              .h = bound[s] * (above ? 1.001 : 0.999),
                              .steps = N,
                              .cg = { 1, 0 } };
            solve(&a, x, p);
            const double reach = farthest(0, N + 1, x, NULL);
            seen(reach, above ? "above" : "below");
            if (above)
                ck_assert_double_gt(reach, 1e6);
            else
                ck_assert_double_lt(reach, 100);
        }
}
END_TEST
//< stability

//> damped
/* (17.16), s = 2, W = 1: three hundredths below and above. Seen: 1
 * at most, 1.5e4 at least. */
START_TEST(eq_17_16_weak_orders_bound_the_step)
{
    const double orders[] = { 0, 0.05, 0.25, 0.4 };
    for (size_t i = 0; i < LEN(orders); i++)
        for (int above = 0; above <= 1; above++) {
            const double bound = 3 * sqrt(3) / pow(2, 2 * orders[i] + 1)
                                 / sin((1 - 2 * orders[i]) * M_PI / 3);
            const setup a = { .s = 2,
                              .alpha = orders[i],
                              .rho = bound * (above ? 1.03 : 0.97),
                              .x0 = 1,
                              .h = 1,
                              .steps = N,
                              .cg = { 1, 0 } };
            solve(&a, x, p);
            const double reach = farthest(0, N + 1, x, NULL);
            seen(reach, above ? "above" : "below");
            if (above)
                ck_assert_double_gt(reach, 1e3);
            else
                ck_assert_double_lt(reach, 2);
        }
}
END_TEST
//< damped

/* alpha >= 1/2: any damping, here up to R = 1e4, and W just below the bound of
 * rho = 0. A push for one second, then nothing. Seen: 0.33. */
START_TEST(eq_17_11_strong_damping_is_stable)
{
    const double aT[] = { 1, 1 },
                 orders[] = { 0.5, 0.51, 0.6, 0.75, 0.9, 0.99 },
                 W[] = { 0, 0, 3.9, 7.9, 9.6 };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(orders); i++)
            for (double rho = 1; rho < 2e4; rho *= 10) {
                const setup a = { .s = s,
                                  .alpha = orders[i],
                                  .rho = rho,
                                  .h = 1,
                                  .steps = N,
                                  .cg = { W[s], 0 },
                                  .force = fvi_force_step(aT) };
                solve(&a, x, p);
                const double reach = farthest(0, N + 1, x, NULL);
                seen(reach, "reach");
                ck_assert_double_le(reach, 1);
            }
}
END_TEST

/* s = 3 and 4, W = 0, 0 < alpha < 1/2: no closed bound is known. Up to R = 7.5 and
 * 9.5 nothing grows; but at alpha = 0.02 three stages do so a little below the bound
 * of alpha = 0, which is 8. A push for one second, which is a node. */
START_TEST(eq_17_16_more_stages_allow_more)
{
    const double aT[] = { 1, 1 }, orders[] = { 0.01, 0.02, 0.05, 0.25, 0.4 },
                 most[] = { 0, 0, 0, 7.5, 9.5 };
    setup a = { .h = 1, .steps = N, .force = fvi_force_step(aT) };
    for (a.s = 3; a.s <= 4; a.s++)
        for (size_t i = 0; i < LEN(orders); i++)
            for (int part = 1; part <= 20; part++) {
                a.alpha = orders[i];
                a.rho = most[a.s] * part / 20;
                solve(&a, x, p);
                const double reach = farthest(0, N + 1, x, NULL);
                seen(reach, "below");
                ck_assert_double_le(reach, 10);
            }
    a.s = 3;
    a.alpha = 0.02;
    a.rho = 7.95;
    solve(&a, x, p);
    seen(farthest(0, N + 1, x, NULL), "above");
    ck_assert_double_gt(farthest(0, N + 1, x, NULL), 1e6);
}
END_TEST

int main(void)
{
    gsl_set_error_handler_off();
    Suite *suite = suite_create("lobatto_stability");
    ADD_CASE(suite, "identities", eq_17_15_stable_below_the_first_gap,
             eq_17_16_weak_orders_bound_the_step,
             eq_17_11_strong_damping_is_stable,
             eq_17_16_more_stages_allow_more);
    return run_suite(suite);
}
