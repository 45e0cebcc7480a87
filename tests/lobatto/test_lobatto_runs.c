/* tests/lobatto/test_lobatto_runs.c -- H 17: runs in one dimension that must agree.
 * Run alone: make test-lobatto_runs */
#include "harness/energy.h"

#include "lobatto_pairs.h"
#include "system/larger.h"

#include <stdlib.h>

static void ck_assert_same(const setup *a, const char *what)
{
    ck_assert_near(farthest(0, a->steps + 1, x, want_x), 0, rounding(a),
                   "%s: x, s=%zu alpha=%g", what, a->s, a->alpha);
    ck_assert_near(farthest(0, a->steps + 1, p, want_p), 0, rounding(a),
                   "%s: p, s=%zu alpha=%g", what, a->s, a->alpha);
}

/* Two stages by hand, with p_0 = m v_0 + h/2 (U' + rho Y^1): v_0 = 0.4073, p_1 = -0.5201
 * for alpha = 1/4. Some 32 roundings. Seen: 0.47 of that. */
START_TEST(eq_17_8_one_step_of_two_stages_by_hand)
{
    for (double alpha = 0.05; alpha < 0.5; alpha += 0.1) {
        const double turn = (2 * alpha - 1) * atan(1), size = exp2(alpha - 0.5),
                     Y1 = size * (cos(turn) + sin(turn)),
                     Y2 = size * (cos(turn) - sin(turn)),
                     v = 0.5 / (1 + Y1 / 2);
        const setup a = { .s = 2,
                          .alpha = alpha,
                          .rho = 1,
                          .x0 = 1,
                          .p0 = 1,
                          .h = 1,
                          .steps = 1,
                          .cg = { 1, 0 } };
        solve(&a, x, p);
        ck_assert_near(x[1], 1 + v, 32 * U, "x, alpha = %g", alpha);
        ck_assert_near(p[1], 1 - (2 + v + (Y1 + Y2) * v) / 2, 32 * U,
                       "p, alpha = %g", alpha);
        if (fabs(alpha - 0.25) < 0.01) {
            seen(v, "v_0");
            seen(p[1], "p_1");
        }
    }
}
END_TEST

/* ---- identities ---- */

//> memories
/* The compressed memory against all W_n: Duffing, driven, from x_0 and p_0 not
 * zero. Seen: 7e-14, for 1 - alpha = 1e-9. */
START_TEST(eq_17_12_compressed_runs_equal_direct_ones)
{
    const double aw[] = { 1, 0.7 };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(alphas); i++) {
            setup a = { .s = s,
                        .alpha = alphas[i],
                        .rho = 0.5,
                        .x0 = 1,
                        .p0 = -0.5,
                        .h = 0.05,
                        .steps = N,
                        .cg = { 1, 0.5 },
                        .force = fvi_force_cosine(aw) };
            a.memory = FVI_HISTORY_DIRECT;
            solve(&a, want_x, want_p);
            a.memory = FVI_HISTORY_MODES;
            solve(&a, x, p);
            const double of_x = farthest(0, N + 1, x, want_x),
                         of_p = farthest(0, N + 1, p, want_p);
            seen(larger(of_x, of_p), "difference");
            ck_assert_near(of_x, 0, 1e-12, "x: s=%zu alpha=%g", s, a.alpha);
            ck_assert_near(of_p, 0, 1e-12, "p: s=%zu alpha=%g", s, a.alpha);
        }
}
END_TEST

/* (17.21), as alpha goes to 1: what a tolerance leaves of x and p, relative to the
 * largest. Seen: 0.03 of it; of a memory that keeps the tolerance itself, 65. */
START_TEST(eq_17_21_the_tolerance_is_kept_as_alpha_goes_to_1)
{
    enum { LONG = 2000 };
    static double X[LONG + 1], P[LONG + 1], y[LONG + 1], q[LONG + 1];
    const double near_one[] = { 0.75, 0.9, 0.97 }, springs[] = { 1, 1e4 },
                 tolerances[] = { 1e-4, 1e-6 };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < 6; i++)
            for (double rho = 1e3; rho < 2e5; rho *= 100) {
                setup a = { .s = s,
                            .alpha = near_one[i / 2],
                            .rho = rho,
                            .x0 = 1,
                            .p0 = 0.5,
                            .h = 1e-3,
                            .steps = LONG,
                            .cg = { springs[i % 2], 0 },
                            .memory = FVI_HISTORY_DIRECT };
                solve(&a, X, P);
                a.memory = FVI_HISTORY_MODES;
                for (size_t t = 0; t < LEN(tolerances); t++) {
                    a.tolerance = tolerances[t];
                    solve(&a, y, q);
                    const double off =
                        larger(farthest(0, LONG + 1, y, X)
                                   / farthest(0, LONG + 1, X, NULL),
                               farthest(0, LONG + 1, q, P)
                                   / farthest(0, LONG + 1, P, NULL));
                    seen(off / a.tolerance, "of the tolerance");
                    ck_assert_near(off, 0, a.tolerance, "s=%zu alpha=%g rho=%g",
                                   s, a.alpha, rho);
                }
            }
}
END_TEST
//< memories

//> ends
/* alpha = 0: a spring rho from x_0. alpha = 1: a mass m + rho, which needs the
 * force and the momentum in proportion. Seen: 0.14 of the bound. */
START_TEST(eq_17_17_the_ends_are_a_spring_and_a_mass)
{
    for (size_t s = 2; s <= 4; s++) {
        setup a = { .s = s,
                    .rho = 0.5,
                    .x0 = 1,
                    .p0 = -0.5,
                    .h = 0.1,
                    .steps = N },
              b = {
                  .s = s, .p0 = -0.5, .h = 0.1, .steps = N, .cg = { 0.5, 0 }
              };
        solve(&a, x, p);
        solve(&b, want_x, want_p);
        for (size_t k = 0; k <= N; k++)
            want_x[k] += 1;
        ck_assert_same(&a, "spring");

        a.alpha = 1;
        a.mass = 2;
        a.cg[0] = a.cg[1] = 1;
        solve(&a, x, p);
        b = a;
        b.rho = 0;
        b.mass = 2.5;
        b.p0 = a.p0 * 1.25;
        solve(&b, want_x, want_p);
        for (size_t k = 0; k <= N; k++)
            want_p[k] /= 1.25;
        ck_assert_same(&a, "mass");
    }
}
END_TEST
//< ends

/* No damping: a step is its own reverse. There, turn round, and back; and some steps
 * so long that Newton's method has to work. Seen: 0.08 of the bound. */
START_TEST(eq_17_8_without_damping_time_runs_both_ways)
{
    for (size_t s = 2; s <= 4; s++)
        for (int hard = 0; hard <= 1; hard++) {
            setup a = { .s = s,
                        .x0 = hard ? 2 : 1,
                        .p0 = 0.5,
                        .h = hard ? 0.4 : 0.1,
                        .steps = hard ? 3 : N,
                        .cg = { 1, hard ? 3 : 1 } };
            solve(&a, want_x, want_p);
            const size_t n = a.steps;
            a.x0 = want_x[n];
            a.p0 = -want_p[n];
            solve(&a, x, p);
            for (size_t k = 0; k <= n; k++) {
                const double bound = (hard ? 40 : 1) * rounding(&a);
                ck_assert_near(x[k], want_x[n - k], bound, "x, k=%zu", k);
                ck_assert_near(p[k], -want_p[n - k], bound, "p, k=%zu", k);
            }
        }
}
END_TEST

//> energy
/* No damping: the energy stays in a band of width h^(2s-2) for 20000 steps; the
 * error of the second half is not above that of the first but by rounding.
 * Seen: 3.3e-3, 2.4e-6, 1.4e-9. */
START_TEST(eq_17_8_without_damping_the_energy_stays)
{
    const double band[] = { 0, 0, 5e-3, 4e-6, 2e-9 }, one = 1, none = 0,
                 cg[] = { 1, 1 }, start = 1;
    for (size_t s = 2; s <= 4; s++) {
        const fvi_system system = { 1,     &one,
                                    &none, fvi_potential_duffing(cg),
                                    { 0 }, NULL, NULL };
        const fvi_run run = { .system = &system,
                              .x0 = &start,
                              .p0 = &none,
                              .h = 0.1,
                              .steps = 20000,
                              .alpha = 0.3 };
        fvi_stepper *stepper;
        ck_assert_int_eq(fvi_stepper_start(methods[s], &run, &stepper,
                                           NULL), FVI_SUCCESS);
        double worst[2] = { 0 };
        while (stepper->k < run.steps) {
            double *w = worst + (stepper->k >= 10000);
            ck_assert_int_eq(fvi_stepper_step(stepper), FVI_SUCCESS);
            *w = larger(
                *w, fabs(energy_of(&system, stepper->x, stepper->p) - 0.75));
        }
        fvi_stepper_free(stepper);
        seen(larger(worst[0], worst[1]), "energy, s=%zu", s);
        ck_assert_double_lt(worst[0], band[s]);
        ck_assert_double_le(worst[1], 1.01 * worst[0] + 1e-12);
    }
}
END_TEST
//< energy

/* ---- jumps ---- */

static int jump(double t, size_t d, void *params, double *F)
{
    for (size_t i = 0; i < d; i++)
        F[i] = t <= *(const double *)params ? 8 : -3;
    return 0;
}

//> jump
/* F jumps at T = 3 h, or up to 4u T to either side of the double 3 h, as it may
 * when h is rounded: the same bits, whether T itself belongs to the left or not.
 * And T = 0: nothing of what F is at 0 alone is seen. */
START_TEST(eq_17_8_jumps_of_the_force_belong_to_neither_side)
{
    for (size_t s = 2; s <= 4; s++) {
        double T = 3 * 0.1;
        setup a = { .s = s,
                    .alpha = 0.75,
                    .rho = 1,
                    .h = 0.1,
                    .steps = 20,
                    .cg = { 1, 0 },
                    .force = { .value = jump, .params = &T } };
        solve(&a, want_x, want_p);
        for (int i = -2; i <= 2; i++) {
            T = 3 * 0.1;
            for (int j = 0; j < abs(i); j++)
                T = nextafter(T, i);
            solve(&a, x, p);
            ck_assert_mem_eq(x, want_x, 21 * sizeof *x);
        }
        T = 0;
        solve(&a, x, p);
        T = -1;
        solve(&a, want_x, want_p);
        ck_assert_mem_eq(x, want_x, 21 * sizeof *x);
    }
}
END_TEST
//< jump

int main(void)
{
    Suite *suite = suite_create("lobatto_runs");
    ADD_CASE(suite, "identities", eq_17_8_one_step_of_two_stages_by_hand,
             eq_17_12_compressed_runs_equal_direct_ones,
             eq_17_21_the_tolerance_is_kept_as_alpha_goes_to_1,
             eq_17_17_the_ends_are_a_spring_and_a_mass,
             eq_17_8_without_damping_time_runs_both_ways,
             eq_17_8_without_damping_the_energy_stays,
             eq_17_8_jumps_of_the_force_belong_to_neither_side);
    return run_suite(suite);
}
