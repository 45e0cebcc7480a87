/* tests/course/test_body_09.c -- The Course, stage 09: the experiments. */
#ifndef STAGE
#define STAGE "course/body_09.c"
#endif
#include "stage.h"
#include "since_06.h"

START_TEST(eq_9a_the_papers_oscillator)
{
    rho = 0.2, p0 = 0.5, h = 0.5, alpha = 0.5, kappa = 0.5;
    run(3);
    for (int k = 0; k <= 3; k++)
        ck_assert_near(x[k], ref_paper[k], 16 * (k + 1) * ROUNDING, "k = %d", k);
    rho = 0.5, p0 = 0, alpha = 0.25;
}
END_TEST

/* A straight line has its slope, whatever the points: some 8 roundings a point. */
START_TEST(eq_9b_the_slope_of_a_line)
{
    double X[] = { -3, 1, 2, 7, 7.5 }, Y[5];
    for (int i = 0; i < 5; i++)
        Y[i] = 1 + 0.75 * X[i];
    ck_assert_near(slope(5, X, Y), 0.75, 40 * ROUNDING, "line");
}
END_TEST

/* The 0.940 of the paper is a slope of five errors on their way to 1. */
START_TEST(eq_9b_where_0_940_comes_from)
{
    double X[5], Y[5];
    rho = 0.2, p0 = 0.5, alpha = 0.5, kappa = 0.5, h = 0.1;
    for (int i = 0; i < 5; i++, h /= 2)
        X[i] = log(h), Y[i] = log(error(15, m));
    ck_assert_near(slope(5, X, Y), 0.940, 0.0005, "five steps");
    ck_assert_near(slope(2, X + 3, Y + 3), 0.984, 0.0005, "the last two");
    rho = 0.5, p0 = 0, alpha = 0.25;
}
END_TEST

/* From zero the error is the kick, and its order is 1 - 2 alpha; a held body has order 1. */
START_TEST(eq_9b_fractional_orders)
{
    static double want[2401];
    static const struct { double alpha; fvi_initial_history before; double order; } row[] = {
        { 0.25, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.486 },
        { 0.4, FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE, 0.193 },
        { 0.25, FVI_INITIAL_HISTORY_HELD, 0.928 },
    };
    rho = 0.2, p0 = 0.5, kappa = 0.5;
    for (size_t i = 0; i < LEN(row); i++) {
        double X[5], Y[5];
        alpha = row[i].alpha, past = row[i].before == FVI_INITIAL_HISTORY_HELD ? HELD : RL, h = 0.1;
        for (int j = 0; j < 5; j++, h /= 2) {
            int N = 150 << j;
            const fvi_linear_oscillator body = { .m = 1, .c = 1, .rho = rho, .alpha = alpha, .past = row[i].before, .x0 = 1, .v0 = 0.5 };
            double largest = 0;
            ck_assert_int_eq(fvi_exact_grid(&body, h, (size_t)N, 0, want, NULL, NULL), FVI_SUCCESS);
            run(N);
            for (int k = 0; k <= N; k++)
                largest = worse(largest, fabs(x[k] - want[k]));
            X[j] = log(h), Y[j] = log(largest);
        }
        ck_assert_near(slope(5, X, Y), row[i].order, 0.0005, "row %zu", i);
    }
    past = HELD, rho = 0.5, p0 = 0, alpha = 0.25;
}
END_TEST

/* Friction: a body that comes from zero loses rho x_0 in its jump. No step of a run, which is
 * that of a held body, comes nearer to its motion than 0.17. */
START_TEST(eq_9b_order_0_at_one_half_from_zero)
{
    rho = 0.2, p0 = 0.5, alpha = 0.5, kappa = 0.5, past = RL, h = 0.1;
    for (int j = 0; j < 5; j++, h /= 2) {
        int N = 150 << j;
        double largest = 0, start = p0;
        run(N);
        p0 = start - rho * x0; /* after the jump */
        for (int k = 0; k <= N; k++)
            largest = worse(largest, fabs(x[k] - exact(m, k * h)));
        p0 = start;
        ck_assert_near(largest, 0.17, 0.005, "N = %d", N);
    }
    past = HELD, rho = 0.5, p0 = 0, alpha = 0.25;
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stage 09");
    ADD_CASE(suite, "the experiments", eq_6d_the_steps_by_hand, eq_6d_seven_alphas, eq_9a_the_papers_oscillator, eq_9b_the_slope_of_a_line, eq_9b_where_0_940_comes_from, eq_9b_fractional_orders, eq_9b_order_0_at_one_half_from_zero);
    return run_suite(suite);
}
