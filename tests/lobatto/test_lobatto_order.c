/* tests/lobatto/test_lobatto_order.c -- H 17: the measured orders.
 * Run alone: make test-lobatto_order */
#include <fvi/exact_solution.h>
#include "run/whole_run.h"
#include "driven_duffing.h"
#include "system/larger.h"

enum { MOST = 2560 };
static double x[MOST + 1], p[MOST + 1], want_x[MOST + 1], want_p[MOST + 1];
static double times[MOST + 1];

/* ---- fits ---- */

//> fit
/* The mean slope over the last three errors above the floor of rounding: the
 * coarse ones before them are not yet on the line. */
static double slope(const errors *e, double floor)
{
    size_t last = 0;
    while (last < e->count && e->errors[last] > floor)
        last++;
    ck_assert_uint_ge(last, 3);
    return log2(e->errors[last - 3] / e->errors[last - 1]) / 2;
}
//< fit

/* (17.13): the orders of x and p; 2s - 2 for alpha = 1/2. */
static double order_x(size_t s, double alpha)
{
    double full = 2 * (double)s - 2;
    return alpha == 0.5 ? full : smaller(full, (double)s + 2 - 2 * alpha);
}

static double order_p(size_t s, double alpha)
{
    double full = 2 * (double)s - 2;
    return alpha == 0.5 ? full : smaller(full, (double)s + 1 - 2 * alpha);
}

/* ---- a driven Duffing oscillator along x = t^8 ---- */

/* The largest errors on [0, 1] with N = 20, 40, ..., 1280 steps; fixed: of the
 * momenta that could be corrected. */
static void run_driven(size_t s, const driving *a, errors *ex, errors *ep,
                       errors *fixed)
{
    const double zero = 0;
    const fvi_system system = driven_duffing(a);
    ex->count = ep->count = fixed->count = 0;
    for (size_t N = 20; N <= 1280; N *= 2) {
        const fvi_run run = { .system = &system,
                              .x0 = &zero,
                              .p0 = &zero,
                              .h = 1 / (double)N,
                              .steps = N,
                              .alpha = a->alpha,
                              .memory = FVI_HISTORY_MODES };
        ck_assert_int_eq(fvi_trajectory(methods[s], &run, x, p, NULL), 0);
        compare_driven(N, run.h, x, p, want_x, want_p, ex, ep);
        ck_assert_int_eq(fvi_lobatto_correct_momenta(methods[s], &run, x, p), 0);
        fixed->errors[fixed->count++] = farthest(0, N - 1, p, want_p);
    }
}

/* The damping is strong where two terms of the error compete, h^(2s-2) from the
 * Lagrangian and rho h^(s+2-2alpha) from the memory. */
static const driving drivings[] = {
    { 0.1, 400 }, { 0.25, 100 }, { 0.5, 1 }, { 0.75, 1 }, { 0.9, 1 }
};

//> order
/* (17.13), nonlinear. Not a bound: a fit. Above 1/2 it is met from both sides: the
 * order is not 2, 4, 6. Seen: at most 0.12 below; above, 0.32 for s = 3, alpha =
 * 1/4, where h^4 and h^4.5 mix, and 0.02 for alpha > 1/2. */
START_TEST(eq_17_13_orders_on_a_driven_duffing_oscillator)
{
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(drivings); i++) {
            errors ex, ep, fixed;
            run_driven(s, drivings + i, &ex, &ep, &fixed);
            const double alpha = drivings[i].alpha,
                         above = alpha < 0.5 ? 0.5 : 0.15,
                         of_x = slope(&ex, alpha > 0.5 ? 2e-13 : 3e-14),
                         of_p = slope(&ep, 3e-13);
            seen(larger(order_x(s, alpha) - of_x, order_p(s, alpha) - of_p),
                 "below (17.13)");
            if (alpha > 0.5)
                seen(larger(of_x - order_x(s, alpha), of_p - order_p(s, alpha)),
                     "above it, alpha > 1/2");
            ck_assert_msg(of_x >= order_x(s, alpha) - 0.15
                              && of_x <= order_x(s, alpha) + above,
                          "x: s = %zu, alpha = %g: %g", s, alpha, of_x);
            ck_assert_msg(of_p >= order_p(s, alpha) - 0.15
                              && of_p <= order_p(s, alpha) + above,
                          "p: s = %zu, alpha = %g: %g", s, alpha, of_p);
        }
}
END_TEST
//< order

/* (17.14): the momenta gain the order of x where alpha < 1/2, else 2 - 2 alpha at
 * most; measured, not proved. Seen: at most 0.16 below; above, 1.07 with four stages,
 * whose momenta may gain more. */
START_TEST(eq_17_14_corrected_momenta_gain_order)
{
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(drivings); i++) {
            errors ex, ep, fixed;
            const double alpha = drivings[i].alpha;
            run_driven(s, drivings + i, &ex, &ep, &fixed);
            const double gain = smaller(order_x(s, alpha) - order_p(s, alpha),
                                        alpha > 0.5 ? 2 - 2 * alpha : 1);
            const double of_p = slope(&fixed, 3e-13);
            seen(order_p(s, alpha) + gain - of_p, "below");
            ck_assert_double_ge(of_p, order_p(s, alpha) + gain - 0.17);
            ck_assert_double_le(of_p, order_p(s, alpha) + gain + 1.1);
            ck_assert(alpha == 0.5 || (s == 2 && alpha < 0.5)
                      || fixed.errors[4] < ep.errors[4]);
        }
}
END_TEST

/* ---- against the exact solution ---- */

static void exact(const fvi_linear_oscillator *problem, size_t N, double h)
{
    for (size_t k = 0; k <= N; k++)
        times[k] = (double)k * h;
    ck_assert_int_eq(fvi_exact_at(problem, N + 1, times, want_x, want_p,
                                  NULL), 0);
}

//> linear
/* x'' + x + 3/10 D^{2 alpha} x = 0 from x_0 = 1, v_0 = 1/2, Caputo, on [1, 4]: the
 * first steps feel the start. Seen: at most 0.05 below. */
START_TEST(eq_17_13_orders_from_a_start_away_from_zero)
{
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(drivings); i++) {
            errors ex = { 0 }, ep = { 0 };
            const double alpha = drivings[i].alpha;
            for (size_t N = 8; N <= MOST; N *= 2) {
                const setup a = { .s = s,
                                  .alpha = alpha,
                                  .rho = 0.3,
                                  .x0 = 1,
                                  .p0 = 0.5,
                                  .h = 4 / (double)N,
                                  .steps = N,
                                  .cg = { 1, 0 } };
                const fvi_linear_oscillator problem = { .m = 1,
                                             .c = 1,
                                             .rho = 0.3,
                                             .alpha = alpha,
                                             .past = FVI_INITIAL_HISTORY_CAPUTO,
                                             .x0 = 1,
                                             .v0 = 0.5 };
                solve(&a, x, p);
                exact(&problem, N, a.h);
                ex.errors[ex.count++] = farthest(N / 4, N + 1, x, want_x);
                ep.errors[ep.count++] = farthest(N / 4, N + 1, p, want_p);
            }
            const double of_x = slope(&ex, 1e-13), of_p = slope(&ep, 1e-13);
            seen(larger(order_x(s, alpha) - of_x, order_p(s, alpha) - of_p),
                 "below (17.13)");
            ck_assert_near(of_x, order_x(s, alpha), 0.15, "x, s = %zu", s);
            ck_assert_near(of_p, order_p(s, alpha), 0.15, "p, s = %zu", s);
        }
}
END_TEST
//< linear

//> uniform
/* (17.22): the orders over all t are those of the first nodes, where the damping of
 * v_0 t is not smooth: the same problem, v_0 = 2, the first 16 nodes, h = 1/256 to
 * 1/2048. Not a bound: a fit. x of s = 2 has not yet arrived. */
START_TEST(eq_17_22_orders_of_the_first_nodes)
{
    const double some[] = { 0.15, 0.3, 0.6, 0.7 };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(some); i++) {
            errors ex = { 0 }, ep = { 0 };
            const double alpha = some[i], gain = alpha > 0.5 ? 1 : 0;
            for (double h = 1. / 256; h > 1. / 4000; h /= 2) {
                const setup a = { .s = s,
                                  .alpha = alpha,
                                  .rho = 0.5,
                                  .x0 = 1,
                                  .p0 = 2,
                                  .h = h,
                                  .steps = 16,
                                  .cg = { 1, 0 } };
                const fvi_linear_oscillator problem = { .m = 1,
                                             .c = 1,
                                             .rho = 0.5,
                                             .alpha = alpha,
                                             .past = FVI_INITIAL_HISTORY_CAPUTO,
                                             .x0 = 1,
                                             .v0 = 2 };
                solve(&a, x, p);
                exact(&problem, 16, h);
                ex.errors[ex.count++] = farthest(0, 17, x, want_x);
                ep.errors[ep.count++] = farthest(0, 17, p, want_p);
            }
            const double of_x = slope(&ex, 0), of_p = slope(&ep, 0);
            seen(of_p - (2 - 2 * alpha + gain), "order of p, less expected");
            ck_assert_near(of_p, 2 - 2 * alpha + gain, 0.12,
                           "p, s = %zu, alpha = %g", s, alpha);
            if (s == 2)
                continue;
            seen(of_x - (3 - 2 * alpha + gain), "order of x, less expected");
            ck_assert_near(of_x, 3 - 2 * alpha + gain, 0.12,
                           "x, s = %zu, alpha = %g", s, alpha);
        }
}
END_TEST
//< uniform

/* x'' + x + D^{3/2} x = 8 on [0, 1], then 0, from rest: errors for t >= 2. */
static void bagley_torvik(size_t s, size_t N, double *ex, double *ep)
{
    static const double aT[] = { 8, 1 };
    const setup a = { .s = s,
                      .alpha = 0.75,
                      .rho = 1,
                      .h = 20 / (double)N,
                      .steps = N,
                      .cg = { 1, 0 },
                      .force = fvi_force_step(aT) };
    const fvi_linear_oscillator problem = { .m = 1,
                                 .c = 1,
                                 .rho = 1,
                                 .alpha = 0.75,
                                 .forcing = FVI_FORCING_STEP,
                                 .A = 8,
                                 .T = 1 };
    solve(&a, x, p);
    exact(&problem, N, a.h);
    *ex = farthest(N / 10, N + 1, x, want_x);
    *ep = farthest(N / 10, N + 1, p, want_p);
}

//> bagley-torvik
/* Orders 2, 3.5, 4.5 in x and 1.5, 2.5, 3.5 in p, although F jumps at t = 1, a
 * node. Where 1 is inside a step, nothing is left of that. Seen: 1.97, 3.49,
 * 4.53; 1.49, 2.53, 3.55; errors of x at the finest 2.8e-5, 2.5e-10, 1.0e-11. */
START_TEST(eq_17_13_bagley_torvik_with_the_jump_at_a_node)
{
    const size_t finest[] = { 0, 0, 2560, 2560, 640 };
    const double least[] = { 0, 0, 3e-5, 3e-10, 1.1e-11 };
    for (size_t s = 2; s <= 4; s++) {
        errors ex = { 0 }, ep = { 0 };
        for (size_t N = finest[s] / 4; N <= finest[s]; N *= 2)
            bagley_torvik(s, N, ex.errors + ex.count++, ep.errors + ep.count++);
        const double of_x = slope(&ex, 1e-12), of_p = slope(&ep, 1e-12);
        for (size_t i = 0; i < ex.count; i++)
            seen(ex.errors[i], "x, s=%zu, %zu steps", s, finest[s] / 4 << i);
        seen(of_x, "order of x, s=%zu", s);
        seen(of_p, "order of p, s=%zu", s);
        ck_assert_double_le(ex.errors[2], least[s]);
        ck_assert_near(of_x, order_x(s, 0.75), 0.15, "x");
        ck_assert_near(of_p, order_p(s, 0.75), 0.15, "p");
        double off, ignored;
        bagley_torvik(s, 887, &off, &ignored);
        seen(off, "x, the jump inside a step, s=%zu", s);
        if (s > 2)
            ck_assert_double_gt(off, 1e-4);
    }
}
END_TEST
//< bagley-torvik

int main(void)
{
    Suite *suite = suite_create("lobatto_order");
    ADD_CASE(suite, "order", eq_17_13_orders_on_a_driven_duffing_oscillator,
             eq_17_14_corrected_momenta_gain_order,
             eq_17_13_orders_from_a_start_away_from_zero,
             eq_17_22_orders_of_the_first_nodes,
             eq_17_13_bagley_torvik_with_the_jump_at_a_node);
    return run_suite(suite);
}
