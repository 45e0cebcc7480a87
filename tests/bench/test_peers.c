/* tests/bench/test_peers.c -- H 18: the peers of the benchmark are right.
 * Run alone: make test-peers
 *
 * The comparison with the peers is only fair if they are right. So each peer must converge to the truth with the
 * order that its publication states, and the truth must agree with the exact solutions. */
#include "fft_blocks.h"
#include "run/whole_run.h"
#include "peers/peers.h"
#include "harness/ulp.h"

#include <fvi/fvi.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <stdlib.h>

static const peer *named(const char *name)
{
    for (size_t i = 0; peers[i]; i++)
        if (strcmp(peers[i]->name, name) == 0)
            return peers[i];
    ck_abort_msg("no peer of the name %s", name);
    return NULL;
}

/* The truth of a linear motion: the exact solution, time by time, which is also a peer. */
static void exact_rows(const problem *p, double *rows)
{
    const task t = { p, 0, 0 };
    ck_assert_int_eq(named("exact solution")->run(&t, rows), FVI_SUCCESS);
}

static double distance(const problem *p, const double *a, const double *b)
{
    double worst = 0;
    for (size_t i = 0; i < (ROWS + 1) * p->system.d; i++) {
        const double e = fabs(a[i] - b[i]);
        worst = larger(worst, e);
    }
    return worst;
}

/* Return the largest error over all rows. */
static double error_of(const char *name, int P, size_t N, double tolerance,
                       const double *truth)
{
    static double rows[(ROWS + 1) * 32];
    const problem *p = problem_number(P - 1);
    const task t = { p, N, tolerance };
    ck_assert(named(name)->takes(p));
    ck_assert_int_eq(named(name)->run(&t, rows), 0);
    return distance(p, rows, truth);
}

/* Check that the errors of N and 2 N steps fall by 2^order, within a fifth of an order or better. */
static void ck_assert_order(const char *name, int P, size_t N, double order,
                            const double *truth)
{
    const double coarse = error_of(name, P, N, 0, truth),
                 fine = error_of(name, P, 2 * N, 0, truth),
                 q = log2(coarse / fine);
    seen(q, "%s, P%d: order", name, P);
    ck_assert_msg(q > order - 0.2 && q < order + 1.2,
                  "%s, P%d: order %.2f, stated %.2f (%.2e, %.2e)", name, P, q,
                  order, coarse, fine);
}

/* ---- the truth ---- */

/* The reference is computed in long double, F and grad U in double, so some units of rounding remain. Seen:
 * 1.8e-15. The last problem has a velocity and an order above 1. */
START_TEST(eq_18_4_collocation_on_graded_panels_is_exact)
{
    static const int linear[] = { 2, 6 };
    for (size_t i = 0; i < LEN(linear); i++) {
        const problem *p = problem_number(linear[i] - 1);
        double rows[ROWS + 1], want[ROWS + 1];
        exact_rows(p, want);
        ck_assert_int_eq(reference(p, 14, p->panel, rows), FVI_SUCCESS);
        seen_worst(distance(p, rows, want), "from the exact solution");
        ck_assert_msg(distance(p, rows, want) < 1e-14, "P%d: off by %.2e",
                      linear[i], distance(p, rows, want));
    }
    const double moving = 0.5;
    fvi_linear_oscillator exactly = *problem_number(0)->linear;
    problem p = *problem_number(0);
    double rows[ROWS + 1], want[ROWS + 1];
    exactly.v0 = moving;
    p.linear = &exactly;
    p.p0 = &moving;
    exact_rows(&p, want);
    ck_assert_int_eq(reference(&p, 14, p.panel, rows), FVI_SUCCESS);
    ck_assert_double_lt(distance(&p, rows, want), 1e-14);
}
END_TEST

/* Other nodes and panels give the same solution. Two methods that share nothing with the reference agree with
 * it: a Radau IIA convolution quadrature, and, at t = T, fvi-lobatto4, whose order near the start is low. */
START_TEST(eq_18_4_other_panels_and_other_methods_agree)
{
    static const int nonlinear[] = { 5, 9 };
    static double a[ROWS + 1], b[ROWS + 1], x[3201];
    for (size_t i = 0; i < LEN(nonlinear); i++) {
        const int P = nonlinear[i];
        const problem *p = problem_number(P - 1);
        ck_assert_int_eq(reference(p, 12, p->panel, a), FVI_SUCCESS);
        ck_assert_int_eq(reference(p, 14, p->panel, b), FVI_SUCCESS);
        seen_worst(distance(p, a, b), "between two references");
        ck_assert_msg(distance(p, a, b) < 1e-14, "P%d: %.2e apart", P,
                      distance(p, a, b));
        const double radau = error_of("Radau IIA 7, graded", P, 320, 0, a);
        seen_worst(radau, "from Radau IIA 7");
        ck_assert_msg(radau < 1e-12, "P%d: Radau IIA 7 is off by %.2e", P,
                      radau);
        const fvi_run run = problem_run(p, 3200, FVI_HISTORY_AUTO, 0);
        ck_assert_int_eq(fvi_trajectory(&fvi_lobatto_m4, &run, x, NULL, NULL), 0);
        seen_worst(fabs(x[3200] - a[ROWS]), "from fvi-lobatto4 at T");
        ck_assert_msg(fabs(x[3200] - a[ROWS]) < 1e-12, "P%d: %.2e at T", P,
                      fabs(x[3200] - a[ROWS]));
    }
}
END_TEST

/* ---- the peers ---- */

/* Product integration and the linear multistep methods are of order 2, at any order of the damping, also if a
 * step ends at a jump of F. */
START_TEST(eq_18_4_methods_of_order_two)
{
    static const char *const names[] = { "product trapezoid",
                                         "FLMM2 trapezoidal",
                                         "FLMM2 Newton-Gregory", "FLMM2 BDF2",
                                         "FLMM2 trapezoidal, modes" };
    double want[ROWS + 1];
    for (size_t i = 0; i < LEN(names); i++) {
        exact_rows(problem_number(0), want);
        ck_assert_order(names[i], 1, 320, 2, want); /* 640: with transforms */
        exact_rows(problem_number(1), want);
        ck_assert_order(names[i], 2, 320, 2, want);
        exact_rows(problem_number(7), want);
        ck_assert_order(names[i], 8, 640, 2, want);
    }
}
END_TEST

START_TEST(eq_18_4_methods_of_order_two_on_a_pendulum_and_a_chain)
{
    static const char *const names[] = { "product trapezoid", "FLMM2 BDF2",
                                         "fast L2-1_sigma" };
    static double want[(ROWS + 1) * 32];
    for (int P = 4; P <= 5; P++) {
        const problem *p = problem_number(P - 1);
        ck_assert_int_eq(reference(p, 8, p->panel, want), FVI_SUCCESS);
        for (size_t i = 0; i < LEN(names); i++)
            ck_assert_order(names[i], P, 320, 2, want);
    }
}
END_TEST

/* The formula is of order 2 if v' is smooth. After a jump of v' the order is 3/2 (seen; no theorem). */
START_TEST(the_fast_formula_after_a_jump)
{
    double want[ROWS + 1];
    exact_rows(problem_number(0), want);
    ck_assert_order("fast L2-1_sigma", 1, 640, 1.5, want);
}
END_TEST

/* Without memory s stages have the order 2 s - 1. 5 and 7 stages reach rounding. */
START_TEST(radau_methods_have_their_order)
{
    double want[ROWS + 1];
    exact_rows(problem_number(1), want);
    ck_assert_order("Radau IIA 2", 2, 160, 3, want);
    ck_assert_order("Radau IIA 3", 2, 160, 5, want);
    ck_assert_order("Radau IIA 5", 2, 20, 7,
                    want); /* rows within steps: order s + 2 */
    ck_assert_double_lt(error_of("Radau IIA 7", 2, 80, 0, want), 2e-14);
}
END_TEST

/* With memory s stages have at least the order s + 1 on steps of one length, if a step ends at the jump and the
 * start is smooth enough. Graded steps reach rounding for every alpha and every time of the jump. Seen: 4e-14. */
START_TEST(radau_convolution_quadrature_converges)
{
    double want[ROWS + 1];
    exact_rows(problem_number(0), want);
    ck_assert_order("Radau IIA 2", 1, 320, 3, want);
    ck_assert_order("Radau IIA 3", 1, 320, 4.5, want);
    const double plate = error_of("Radau IIA 7, graded", 1, 200, 0, want);
    exact_rows(problem_number(5), want);
    const double jump = error_of("Radau IIA 7, graded", 6, 200, 0, want),
                 five = error_of("Radau IIA 5, graded", 6, 500, 0, want);
    seen(jump, "P6: error");
    ck_assert_msg(plate < 1e-13 && jump < 1e-13 && five < 1e-12,
                  "%.2e, %.2e, %.2e", plate, jump, five);
    exact_rows(problem_number(7), want);
    ck_assert_double_lt(error_of("Radau IIA 7, graded", 8, 400, 0, want),
                        1e-10);
}
END_TEST

/* A tolerance t causes errors of the positions of at most about 10 t, and saves modes. */
START_TEST(radau_memories_keep_their_tolerance)
{
    double want[ROWS + 1];
    exact_rows(problem_number(0), want);
    for (double t = 1e-4; t > 1e-12; t /= 100) {
        const double error = error_of("Radau IIA 7", 1, 640, t, want);
        seen_worst(error / t, "error over tolerance");
        ck_assert_msg(error < 10 * t, "%.2e at a tolerance of %.0e", error, t);
    }
}
END_TEST

/* Modes replace the weights. With a tolerance t the rows agree to about t, at orders on both sides of 1. Seen:
 * 0.9 t. */
START_TEST(modes_of_the_trapezoidal_rule_are_its_weights)
{
    static const int of[] = { 1, 2, 3, 8 };
    static double want[ROWS + 1];
    for (size_t i = 0; i < LEN(of); i++) {
        const task t = { problem_number(of[i] - 1), 320, 0 };
        ck_assert_int_eq(named("FLMM2 trapezoidal")->run(&t, want), 0);
        for (double tolerance = 1e-3; tolerance > 1e-13; tolerance /= 100) {
            const double off = error_of("FLMM2 trapezoidal, modes", of[i], 320,
                                        tolerance, want);
            seen_worst(off / tolerance, "modes: error over tolerance");
            ck_assert_msg(off < 10 * tolerance, "P%d: %.2e at %.0e", of[i], off,
                          tolerance);
        }
    }
}
END_TEST

/* Rows at the ends of steps and within them. */
START_TEST(solvers_of_ordinary_differential_equations)
{
    double want[ROWS + 1];
    exact_rows(problem_number(1), want);
    ck_assert_order("RK4", 2, 160, 4, want);
    ck_assert_order("RK4", 2, 150, 4, want);
    ck_assert_order("RK8", 2, 80, 8, want);
    ck_assert_order("RK8", 2, 50, 8, want);
    ck_assert_order("rk8pd, uniform", 2, 80, 8, want);
    ck_assert_order("Taylor series, order 4", 2, 100, 4, want);
    ck_assert_order("Taylor series, order 6", 2, 60, 6, want);
    ck_assert_order("Taylor series, order 8", 2, 40, 8, want);
    ck_assert_order("Taylor series, order 12", 2, 20, 12, want);
    ck_assert_order("Taylor series, order 16", 2, 10, 16, want);
    ck_assert_double_lt(error_of("Taylor series, order 24", 2, 12, 0, want),
                        4e-15);
    ck_assert_double_lt(error_of("rk8pd", 2, 0, 1e-12, want), 1e-11);
    for (double t = 1e-2; t > 1e-14; t /= 100)
        ck_assert_double_lt(error_of("Taylor series", 2, 0, t, want), t);
}
END_TEST

/* Compare the series of x^3 and of sin x with Prince and Dormand's method, because no problem of the benchmark
 * without a memory has these forces; and two masses by RK8. */
START_TEST(taylor_series_of_other_forces)
{
    static const double one = 1, hard[] = { 0.5, 1 }, pair[] = { 1, 0 },
                        masses[] = { 1, 2 }, rho[] = { 0.2, 0.4 },
                        x0[] = { 1.5, 1.5 }, p0[] = { 0.5, 1 };
    static double a[2 * (ROWS + 1)], b[2 * (ROWS + 1)];
    const fvi_potential of[] = { fvi_potential_duffing(hard),
                                 fvi_potential_pendulum(&one),
                                 fvi_potential_duffing(pair) };
    static const char *const names[] = { "Taylor series, order 24", "Taylor series",
                                         "RK8" };
    for (size_t i = 0; i < LEN(of) * LEN(names); i++) {
        const size_t d = i / LEN(names) == 2 ? 2 : 1;
        problem p = *problem_number(1);
        p.system = (fvi_system){ .d = d, .mass = masses, .damping = rho,
                                 .potential = of[i / LEN(names)] };
        p.x0 = x0;
        p.p0 = p0;
        const task exactly = { &p, 0, 1e-14 }, t = { &p, 400, 1e-13 };
        const peer *who = named(names[i % LEN(names)]);
        ck_assert_int_eq(named("rk8pd")->run(&exactly, a), 0);
        ck_assert_int_eq(who->takes(&p), d == 1 || i % LEN(names) == 2);
        if (!who->takes(&p))
            continue;
        ck_assert_int_eq(who->run(&t, b), 0);
        seen_worst(distance(&p, a, b), "other forces");
        ck_assert_msg(distance(&p, a, b) < 1e-11, "%zu, %s: %.2e", i / LEN(names),
                      who->name, distance(&p, a, b));
    }
    ck_assert(!named("Taylor series")->takes(problem_number(2)));
}
END_TEST

START_TEST(linear_problems_need_no_steps)
{
    static const int linear[] = { 1, 2, 6 };
    for (size_t i = 0; i < LEN(linear); i++) {
        double want[ROWS + 1];
        const problem *p = problem_number(linear[i] - 1);
        exact_rows(p, want);
        const double error =
            error_of("Chebyshev in sqrt(t)", linear[i], 42, 0, want);
        seen_worst(error, "collocation in the root of t");
        ck_assert_msg(error < 2e-12, "P%d: %.2e", linear[i], error);
    }
    double want[ROWS + 1], rough = 0;
    exact_rows(problem_number(0), want);
    rough = error_of("matrix method", 1, 640, 0, want);
    ck_assert_double_gt(rough / error_of("matrix method", 1, 1280, 0, want),
                        1.9);
    ck_assert(!named("matrix method")->takes(problem_number(1)));
    ck_assert(!named("Chebyshev in sqrt(t)")->takes(problem_number(7)));
    ck_assert(!named("exact solution")->takes(problem_number(2)));
}
END_TEST

/* ---- the history by FFT ---- */

/* Return the largest difference, over all k, of the sums of random terms by blocks and by a kind of memory of
 * the library. */
static double blocks_against(fvi_history_kind kind, double nu, size_t N)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    fft_blocks *b = fft_blocks_alloc(nu, N);
    fvi_history *m = NULL;
    ck_assert_ptr_nonnull(b);
    ck_assert_int_eq(fvi_history_alloc(nu, 1, N, kind, 0, &m), FVI_SUCCESS);
    double worst = 0;
    for (size_t k = 0; k <= N; k++) {
        const double x = 2 * gsl_rng_uniform(rng) - 1;
        double H;
        ck_assert_int_eq(fvi_history_push(m, &x, &x, &H), FVI_SUCCESS);
        worst = larger(worst, fabs(fft_blocks_push(b, x) - H));
    }
    fvi_history_free(m);
    fft_blocks_free(b);
    gsl_rng_free(rng);
    return worst;
}

/* (12.4). Each output of a transform of length n = 2L passes log2(n) additions and products with a cosine. Each
 * of them has an error of at most 8 u, which includes the cosine's own error of 2 pi u: 8 log2(n) u times the
 * sum of the inputs. With three transforms and a product y has an error of (24 log2(n) + 4) u ||w||_1 ||x||_2,
 * where ||w||_1 <= 2 and ||x||_2 <= sqrt(L) max|x|. The blocks that contribute to one k have different L = 64
 * 2^j <= N, and the sum of sqrt(L) is <= 3.42 sqrt(N). This bound is absolute, not relative to the small far
 * weights. The two direct parts have errors of 8 N u, as sum |w_n| <= 2 and the lanes add N/8 terms. Seen:
 * 2.2e-15 where 3e-11 is allowed, because rounding errors do not all have the same sign. A lag that is wrong by
 * one gives 1e-6 and more. */
START_TEST(eq_12_4_blocks_of_convolutions_are_the_direct_sum)
{
    const size_t lengths[] = { 1, 63, 64, 65, 127, 128, 129, 640, 1000, 4095 };
    const double orders[] = { 0.02, 0.5, 0.98 };
    for (size_t i = 0; i < LEN(lengths) * LEN(orders); i++) {
        const size_t N = lengths[i / LEN(orders)];
        const double nu = orders[i % LEN(orders)], n = (double)N;
        const double bound =
            (24 * log2(2 * n + 1) + 4) * 2 * 3.42 * sqrt(n) + n + 8;
        ck_assert_near(blocks_against(FVI_HISTORY_DIRECT, nu, N), 0, bound * U,
                       "nu=%g N=%zu", nu, N);
    }
}
END_TEST

/* Modes share nothing with the blocks. 300,000 steps: sum |w_n| <= 2, and each weight has an error of delta =
 * 1e-14. Seen: 2.2e-15, because rounding errors do not all have the same sign. */
START_TEST(eq_12_4_blocks_of_convolutions_are_the_modes)
{
    const double off = blocks_against(FVI_HISTORY_MODES, 0.5, 300000);
    ck_assert_near(off, 0, 1e-13, "N = 3 10^5");
}
END_TEST

int main(void)
{
    fvi_set_error_handler(NULL);
    Suite *suite = suite_create("peers");
    ADD_CASE(suite, "truth", eq_18_4_collocation_on_graded_panels_is_exact,
             eq_18_4_other_panels_and_other_methods_agree);
    ADD_CASE(suite, "order", eq_18_4_methods_of_order_two,
             eq_18_4_methods_of_order_two_on_a_pendulum_and_a_chain,
             the_fast_formula_after_a_jump, radau_methods_have_their_order,
             radau_convolution_quadrature_converges,
             radau_memories_keep_their_tolerance,
             modes_of_the_trapezoidal_rule_are_its_weights,
             solvers_of_ordinary_differential_equations,
             taylor_series_of_other_forces,
             linear_problems_need_no_steps);
    ADD_CASE(suite, "blocks", eq_12_4_blocks_of_convolutions_are_the_direct_sum,
             eq_12_4_blocks_of_convolutions_are_the_modes);
    return run_suite(suite);
}
