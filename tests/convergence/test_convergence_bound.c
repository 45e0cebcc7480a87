/* tests/convergence/test_convergence_bound.c -- H 20: the errors of runs, and their bounds.
 * Run alone: make test-convergence_bound */
#include "motions.h"
#include "system/larger.h"

enum { MOST = 12288 };
static double x[MOST + 1], p[MOST + 1], fine_x[MOST + 1], fine_p[MOST + 1];

/* ---- the theorem, run ---- */

/* (20.7) taken as an equation: no error of a mean velocity is larger. */
static void feed(const fvi_smoothness *q, const fvi_error_bound *bound, double h,
                 size_t N, double *E)
{
    static double weights[MOST + 1];
    const double gamma = 2 - 2 * q->alpha, scale = q->damping * pow(h, gamma);
    integral_weights(gamma, N, weights);
    for (size_t k = 0; k < N; k++) {
        E[k + 1] = bound->C * h;
        for (size_t j = 1; j <= k; j++)
            E[k + 1] += (scale * weights[k - j]
                         + q->lipschitz * h * h * (double)(k + 1 - j))
                        * E[j];
    }
}

//> bound
/* Errors of all nodes below (20.8), and below what (20.7) feeds: of 400 motions those
 * whose h the theorem allows. Seen: of (20.8) up to 0.10 for x, 0.23 for p; 0.23 of
 * what is fed. */
START_TEST(eq_20_8_errors_are_below_the_bound)
{
    size_t allowed = 0;
    double of_x = 0, of_p = 0, of_fed = 0;
    for (size_t seed = 0; seed < 400; seed++) {
        const motion q = some_motion(seed);
        const size_t N = COARSE, ratio = FINE / N;
        const double h = q.T / (double)N;
        solve(&fvi_lobatto_m4, &q, FINE, fine_x, fine_p);
        const fvi_smoothness known = know(&q, FINE, fine_x, fine_p);
        fvi_error_bound bound;
        ck_assert_int_eq(fvi_error_bound_compute(&known, &bound), 0);
        if (!(h < bound.h))
            continue;
        allowed++;
        solve(&fvi_fractional, &q, N, x, p);
        double E[COARSE + 1], fed = 0;
        feed(&known, &bound, h, N, E);
        for (size_t k = 1; k <= N; k++) {
            const double t = (double)k * h, C = bound.C, l = bound.lambda,
                         off = fabs(x[k] - fine_x[k * ratio]),
                         off_p = fabs(p[k] - fine_p[k * ratio]) / q.mass,
                         allowed_x = 2 * C * h * expm1(l * t) / l,
                         allowed_p = 2 * C * h * exp(l * t);
            ck_assert_double_le(off, allowed_x);
            ck_assert_double_le(off_p, allowed_p);
            fed += h * E[k];
            ck_assert_double_le(off, fed);
            ck_assert_double_le(fed, allowed_x);
            of_x = larger(of_x, off / allowed_x);
            of_p = larger(of_p, off_p / allowed_p);
            of_fed = larger(of_fed, off / fed);
        }
    }
    seen((double)allowed, "motions");
    seen(of_x, "x of the bound");
    seen(of_p, "p of the bound");
    seen(of_fed, "x of what is fed");
    ck_assert_uint_ge(allowed, 200);
    /* A tenth of it would be wrong. */
    ck_assert_double_ge(smaller(of_x, of_p), 0.1);
}
END_TEST
//< bound

/* Errors below (20.14) and (20.15), of bodies that were held and start with a velocity,
 * alpha above 1/2: 400 motions, those whose h the theorem allows. */
START_TEST(eq_20_14_a_held_body_that_starts_fast)
{
    size_t allowed = 0;
    double of_x = 0, of_p = 0;
    for (size_t seed = 0; seed < 400; seed++) {
        motion q = some_motion(seed);
        q.alpha = 0.5 + 0.48 * q.alpha;
        q.past = FVI_INITIAL_HISTORY_HELD;
        const size_t N = COARSE, ratio = FINE / N;
        const double h = q.T / (double)N, gamma = 2 - 2 * q.alpha;
        solve(&fvi_lobatto_m4, &q, FINE, fine_x, fine_p);
        fvi_smoothness known = know(&q, FINE, fine_x, fine_p);
        known.acceleration = 0;
        fvi_error_bound bound;
        ck_assert_int_eq(fvi_position_bound_compute(&known, &bound), 0);
        if (!(h < bound.h))
            continue;
        allowed++;
        solve(&fvi_fractional, &q, N, x, p);
        for (size_t k = 1; k <= N; k++) {
            const double t = (double)k * h,
                         off = fabs(x[k] - fine_x[k * ratio]),
                         off_p = fabs(p[k] - fine_p[k * ratio]) / q.mass,
                         allowed_x = 2 * bound.C * h * exp(bound.lambda * t),
                         feeds = known.lipschitz * t + known.damping * pow(h, gamma - 1),
                         missed = h * (known.variation + known.lipschitz * known.speed * q.T / 2)
                                  + 2 * known.damping * (1 - gamma) * pow(h, gamma)
                                        / tgamma(gamma + 1)
                                        * (known.start + known.velocity_variation);
            ck_assert_double_le(off, allowed_x);
            ck_assert_double_le(off_p, feeds * allowed_x + missed);
            of_x = larger(of_x, off / allowed_x);
            of_p = larger(of_p, off_p / (feeds * allowed_x + missed));
        }
    }
    seen((double)allowed, "motions");
    seen(of_x, "x of the bound");
    seen(of_p, "p of the bound");
    ck_assert_uint_ge(allowed, 200);
}
END_TEST

/* A free body with a weak damper that was held and starts with the velocity 1: the largest part
 * of the bound that its errors reach. */

START_TEST(eq_20_14_how_sharp)
{
    const double alphas[] = { 0.5, 0.6, 0.75, 0.9 };
    double most = 0;
    for (size_t i = 0; i < LEN(alphas); i++) {
        const size_t N = 4096;
        const motion q = { .alpha = alphas[i], .mass = 1, .rho = 0.1, .p0 = 1, .T = 0.25,
                           .past = FVI_INITIAL_HISTORY_HELD };
        const fvi_linear_oscillator exact = { .m = 1, .rho = q.rho, .alpha = q.alpha,
                                              .past = q.past, .v0 = 1 };
        double t[2] = { 0, q.T }, want[2], slope[2];
        ck_assert_int_eq(fvi_exact_at(&exact, 2, t, want, slope, NULL), 0);
        /* Without a force the velocity falls all the way: its variation is v0 - v(T). */
        const fvi_smoothness known = { .alpha = q.alpha, .T = q.T, .damping = q.rho, .start = 1,
                                       .speed = 1, .velocity_variation = 1 - slope[1],
                                       .room = GSL_POSINF };
        fvi_error_bound bound;
        ck_assert_int_eq(fvi_position_bound_compute(&known, &bound), 0);
        solve(&fvi_fractional, &q, N, x, p);
        const double h = q.T / (double)N,
                     part = fabs(x[N] - want[1]) / (2 * bound.C * h * exp(bound.lambda * q.T));
        ck_assert_double_le(part, 1);
        most = larger(most, part);
    }
    seen(most, "of the bound");
    ck_assert_double_ge(most, 0.1);
}
END_TEST

/* A free body, F = -1/2 and 1/2 from just before t_1: the sum takes the jump a step too
 * early, and the bound is 2.5 times the error of p, 3.4 times that of x. */
START_TEST(eq_20_8_how_sharp)
{
    const size_t N = 64;
    const double h = 1.0 / 64, tau = h * (1 - 0x1p-10);
    const motion q = { .kappa = 0,
                       .mass = 1,
                       .T = 1,
                       .force = { .t = { -1, tau }, .a = { -0.5, 1 } } };
    const fvi_smoothness known = {
        .T = 1, .variation = 1, .acceleration = 0.5, .room = GSL_POSINF
    };
    fvi_error_bound bound;
    ck_assert_int_eq(fvi_error_bound_compute(&known, &bound), 0);
    ck_assert_double_eq(bound.lambda, 0);
    solve(&fvi_fractional, &q, N, x, p);
    for (size_t k = 2; k <= N; k++) {
        const double t = (double)k * h, late = t - tau,
                     of_x = fabs(x[k] - (late * late / 2 - t * t / 4))
                            / (2 * bound.C * h * t),
                     of_p = fabs(p[k] - (late - t / 2)) / (2 * bound.C * h);
        ck_assert(of_x <= 1 && of_p <= 1);
        if (k == N) {
            seen(of_x, "x of the bound");
            seen(of_p, "p of the bound");
            ck_assert(of_x > 0.25 && of_p > 0.38);
        }
    }
}
END_TEST

/* U quadratic: the bound holds for steps at which the run explodes, too. */
START_TEST(eq_20_8_holds_where_the_run_explodes)
{
    const motion q = { .alpha = 0.25,
                       .kappa = 0,
                       .mass = 1,
                       .rho = 12,
                       .p0 = 1,
                       .T = 32,
                       .past = FVI_INITIAL_HISTORY_CAPUTO,
                       .cg = { 1, 0 } };
    const size_t N = 32;
    const fvi_linear_oscillator exact = {
        .m = 1, .c = 1, .rho = q.rho, .alpha = q.alpha, .past = q.past, .v0 = 1
    };
    double t[33], want[33];
    for (size_t k = 0; k <= N; k++)
        t[k] = (double)k;
    ck_assert_int_eq(fvi_exact_at(&exact, N + 1, t, want, NULL, NULL), 0);
    solve(&fvi_lobatto_m4, &q, FINE, fine_x, fine_p);
    const fvi_smoothness known = know(&q, FINE, fine_x, fine_p);
    fvi_error_bound bound;
    ck_assert_int_eq(fvi_error_bound_compute(&known, &bound), 0);
    ck_assert(bound.h == GSL_POSINF);
    solve(&fvi_fractional, &q, N, x, p);
    ck_assert_double_gt(fabs(x[N]), 1e9);
    for (size_t k = 1; k <= N; k++)
        ck_assert_double_le(fabs(x[k] - want[k]),
                            2 * bound.C * expm1(bound.lambda * t[k])
                                / bound.lambda);
}
END_TEST

/* ---- order 1 ---- */

/* Duffing's oscillator, its force jumping at T/3, which is between the nodes of every
 * run: over all nodes, h and h/4, where the jump is at the same part of a step.
 * Seen: 0.014 off. */
START_TEST(eq_20_8_order_one_with_a_jump_between_nodes)
{
    const double alphas[] = { 0, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9 };
    for (size_t i = 0; i < LEN(alphas); i++) {
        const motion q = { .alpha = alphas[i],
                           .kappa = 0.5,
                           .mass = 1,
                           .rho = 0.4,
                           .x0 = 0.7,
                           .p0 = 1.3,
                           .T = 3,
                           .past = FVI_INITIAL_HISTORY_CAPUTO,
                           .cg = { 1, 0.5 },
                           .force = { .t = { 1 }, .a = { 1.5 } } };
        solve(&fvi_lobatto_m4, &q, MOST, fine_x, fine_p);
        double off[2][2] = { { 0 } };
        for (size_t j = 0; j < 2; j++) {
            const size_t N = j ? 1024 : 256, ratio = MOST / N;
            solve(&fvi_fractional, &q, N, x, p);
            for (size_t k = 0; k <= N; k++) {
                off[0][j] = larger(off[0][j], fabs(x[k] - fine_x[k * ratio]));
                off[1][j] = larger(off[1][j], fabs(p[k] - fine_p[k * ratio]));
            }
        }
        for (int of = 0; of < 2; of++) {
            const double order = log2(off[of][0] / off[of][1]) / 2;
            seen(fabs(order - 1), "order off");
            ck_assert_msg(fabs(order - 1) < 0.03, "alpha = %g, %s: %.3f",
                          q.alpha, of ? "p" : "x", order);
        }
    }
}
END_TEST

/* ---- order two ---- */

/* The exact motion at the nodes of N steps, into fine_x. */
static void expect(const motion *q, size_t N)
{
    const fvi_linear_oscillator problem = { .m = q->mass,
                                 .c = q->cg[0],
                                 .rho = q->rho,
                                 .alpha = q->alpha,
                                 .past = q->past,
                                 .x0 = q->x0,
                                 .v0 = q->p0 / q->mass };
    double *t = fine_p;
    for (size_t k = 0; k <= N; k++)
        t[k] = (double)k * (q->T / (double)N);
    ck_assert_int_eq(fvi_exact_at(&problem, N + 1, t, fine_x, NULL, NULL), 0);
}

/* The largest error of x over all nodes of [0, T], each `ratio` of those of fine_x. */
static double worst_of_all(const fvi_method *method, const motion *q, size_t N,
                           size_t ratio)
{
    double off = 0;
    solve(method, q, N, x, p);
    for (size_t k = 0; k <= N; k++)
        off = larger(off, fabs(x[k] - fine_x[k * ratio]));
    return off;
}

/* x, the first nodes included, by the methods of theorem 20.3; the steps are shorter than
 * 0.0039, the bound of fvi_cq_bdf2 for the last order. What follows h^2 in the errors moves the
 * order by a multiple of a power of h, which no formula here gives. Seen: off by 0.0013. */
START_TEST(eq_20_10_order_two_over_all_nodes)
{
    const fvi_method *methods[] = { &fvi_cq2_shifted, &fvi_cq_bdf2, &fvi_cq2_midpoint };
    const double alphas[] = { 0, 0.1, 0.3, 0.45, 0.55, 0.7, 0.95 };
    for (size_t i = 0; i < LEN(alphas); i++) {
        const motion q = { .alpha = alphas[i],
                           .kappa = 0.5,
                           .mass = 1,
                           .rho = 0.5,
                           .x0 = 1,
                           .p0 = 0.5,
                           .T = 4,
                           .past = FVI_INITIAL_HISTORY_CAPUTO,
                           .cg = { 1, 0 } };
        expect(&q, 4096);
        for (size_t j = 0; j < LEN(methods); j++) {
            const double order = log2(worst_of_all(methods[j], &q, 2048, 2)
                                      / worst_of_all(methods[j], &q, 4096, 1));
            seen(fabs(order - 2), "order off");
            ck_assert_near(order, 2, 0.02, "%s, alpha = %g", methods[j]->name,
                           q.alpha);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("20 convergence, the theorem run");
    ADD_CASE(suite, "theorem", eq_20_8_errors_are_below_the_bound,
             eq_20_8_how_sharp, eq_20_8_holds_where_the_run_explodes,
             eq_20_14_a_held_body_that_starts_fast, eq_20_14_how_sharp);
    ADD_CASE(suite, "order", eq_20_8_order_one_with_a_jump_between_nodes,
             eq_20_10_order_two_over_all_nodes);
    return run_suite(suite);
}
