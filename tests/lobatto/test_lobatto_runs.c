/* tests/lobatto/test_lobatto_runs.c -- Chapter 17: the integrators, by what must be equal
 * to what. Run alone: make test-lobatto_runs */
#include "lobatto_runs.h"
#include "harness/energy.h"

#include <stdlib.h>

enum { N = 400 };
static double x[3 * N + 3], p[3 * N + 3], want_x[3 * N + 3], want_p[3 * N + 3];

/* Two runs that are equal but for rounding: some roundings of a number of the size
 * of x, p in each of n steps, all of one sign at the worst, none amplified (which
 * holds for these systems and times). An estimate, not a proof. Seen: 0.14 of it. */
static double rounding(const setup *a)
{
    const double size = 1 + farthest(0, a->steps + 1, want_x, NULL)
                        + farthest(0, a->steps + 1, want_p, NULL);
    return 2 * (double)a->steps * U * size;
}

static void ck_assert_same(const setup *a, const char *what)
{
    ck_assert_near(farthest(0, a->steps + 1, x, want_x), 0, rounding(a),
                   "%s: x, s=%zu alpha=%g", what, a->s, a->alpha);
    ck_assert_near(farthest(0, a->steps + 1, p, want_p), 0, rounding(a),
                   "%s: p, s=%zu alpha=%g", what, a->s, a->alpha);
}

static const double alphas[] = { 0,   1e-9, 0.1, 0.25, 0.49,
                                 0.6, 0.75, 0.9, 0.99, 1 - 1e-9 };

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
            a.memory = FVI_MEMORY_DIRECT;
            solve(&a, want_x, want_p);
            a.memory = FVI_MEMORY_EXPONENTIALS;
            solve(&a, x, p);
            const double of_x = farthest(0, N + 1, x, want_x),
                         of_p = farthest(0, N + 1, p, want_p);
            seen(fmax(of_x, of_p), "difference");
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
                            .memory = FVI_MEMORY_DIRECT };
                solve(&a, X, P);
                a.memory = FVI_MEMORY_EXPONENTIALS;
                for (size_t t = 0; t < LEN(tolerances); t++) {
                    a.tolerance = tolerances[t];
                    solve(&a, y, q);
                    const double off =
                        fmax(farthest(0, LONG + 1, y, X)
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
                                    { 0 }, NULL };
        const fvi_run run = { .system = &system,
                              .x0 = &start,
                              .p0 = &none,
                              .h = 0.1,
                              .steps = 20000,
                              .alpha = 0.3 };
        fvi_stepper *stepper;
        ck_assert_int_eq(fvi_start(methods[s], &run, &stepper), FVI_SUCCESS);
        double worst[2] = { 0 };
        while (stepper->k < run.steps) {
            double *w = worst + (stepper->k >= 10000);
            ck_assert_int_eq(fvi_step(stepper), FVI_SUCCESS);
            *w = fmax(*w,
                      fabs(energy_of(&system, stepper->x, stepper->p) - 0.75));
        }
        fvi_stop(stepper);
        seen(fmax(worst[0], worst[1]), "energy, s=%zu", s);
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

/* ---- several coordinates ---- */

/* A run in three dimensions into x and p. */
static void solve3(const fvi_system *system, size_t s, double alpha,
                   fvi_memory_kind memory, const double *x0, const double *p0)
{
    const fvi_run run = { .system = system,
                          .x0 = x0,
                          .p0 = p0,
                          .h = 0.1,
                          .steps = N,
                          .alpha = alpha,
                          .past = FVI_PAST_CAPUTO,
                          .memory = memory };
    ck_assert_int_eq(fvi_trajectory(methods[s], &run, x, p, NULL), 0);
}

//> chain
/* Three equal masses and four equal springs, with equal damping, are three
 * oscillators c (2 - 2 cos(j pi/4)) in disguise, sin(i j pi/4) their shapes. The
 * bound: three runs. Seen: 0.009 of it. */
START_TEST(eq_17_8_a_chain_is_its_modes)
{
    const double cg[] = { 1, 0 }, one[] = { 1, 1, 1 },
                 rho[] = { 0.3, 0.3, 0.3 };
    const fvi_system system = { 3,     one, rho, fvi_potential_chain(cg),
                                { 0 }, NULL };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(alphas); i++) {
            double start[3], push[3];
            for (size_t c = 0; c < 3; c++) {
                start[c] = push[c] = 0;
                for (size_t j = 1; j <= 3; j++) {
                    start[c] += sin((double)((c + 1) * j) * M_PI_4);
                    push[c] -= 0.5 * sin((double)((c + 1) * j) * M_PI_4);
                }
            }
            solve3(&system, s, alphas[i], FVI_MEMORY_AUTO, start, push);
            for (size_t j = 1; j <= 3; j++) {
                const setup a = { .s = s,
                                  .alpha = alphas[i],
                                  .rho = 0.3,
                                  .x0 = 1,
                                  .p0 = -0.5,
                                  .h = 0.1,
                                  .steps = N,
                                  .cg = { 2 - 2 * cos((double)j * M_PI_4) } };
                solve(&a, want_x, want_p);
                for (size_t k = 0; k <= N; k++) {
                    double amplitude = 0;
                    for (size_t c = 0; c < 3; c++)
                        amplitude += x[3 * k + c] / 2
                                     * sin((double)((c + 1) * j) * M_PI_4);
                    ck_assert_near(amplitude, want_x[k], 3 * rounding(&a),
                                   "s=%zu alpha=%g mode %zu k=%zu", s,
                                   alphas[i], j, k);
                }
            }
        }
}
END_TEST
//< chain

/* Three masses that do not feel each other, the middle one undamped, Duffing: each
 * as it is alone. Newton's method stops for all at once: rounding. Seen: 0.003 of
 * the bound. */
START_TEST(eq_17_8_only_damped_coordinates_remember)
{
    const double cg[] = { 1, 1 }, mass[] = { 1, 2, 0.5 }, rho[] = { 0.3, 0, 1 },
                 start[] = { 1, -0.5, 0.3 }, push[] = { 0.2, 0, -0.4 },
                 aw[] = { 1, 2 };
    const fvi_system system = {
        3, mass, rho, fvi_potential_duffing(cg), fvi_force_cosine(aw), NULL
    };
    for (size_t s = 2; s <= 4; s++)
        for (size_t i = 0; i < LEN(alphas); i++) {
            solve3(&system, s, alphas[i], FVI_MEMORY_DIRECT, start, push);
            for (size_t c = 0; c < 3; c++) {
                const setup a = { .s = s,
                                  .alpha = alphas[i],
                                  .rho = rho[c],
                                  .mass = mass[c],
                                  .x0 = start[c],
                                  .p0 = push[c],
                                  .h = 0.1,
                                  .steps = N,
                                  .cg = { 1, 1 },
                                  .memory = FVI_MEMORY_DIRECT,
                                  .force = fvi_force_cosine(aw) };
                solve(&a, want_x, want_p);
                for (size_t k = 0; k <= N; k++)
                    ck_assert_near(x[3 * k + c], want_x[k], rounding(&a),
                                   "s=%zu alpha=%g mass %zu k=%zu", s,
                                   alphas[i], c, k);
            }
        }
}
END_TEST

/* The quadratic path of the code and Newton's: one promises a constant Hessian.
 * Seen: 5e-16. */
START_TEST(eq_17_8_newton_finds_what_one_factorisation_finds)
{
    const double cg[] = { 1, 0 }, one[] = { 1, 2, 1 }, rho[] = { 0.3, 0, 0.6 },
                 start[] = { 1, -0.5, 0.3 }, push[] = { 0.2, 0, -0.4 };
    fvi_system system = { 3, one, rho, fvi_potential_chain(cg), { 0 }, NULL };
    for (size_t s = 2; s <= 4; s++) {
        system.potential = fvi_potential_chain(cg);
        solve3(&system, s, 0.3, FVI_MEMORY_AUTO, start, push);
        memcpy(want_x, x, sizeof x);
        system.potential.quadratic = NULL;
        solve3(&system, s, 0.3, FVI_MEMORY_AUTO, start, push);
        ck_assert_near(farthest(0, 3 * N + 3, x, want_x), 0, 10 * N * U,
                       "s=%zu", s);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("lobatto_runs");
    ADD_CASE(suite, "identities", eq_17_8_one_step_of_two_stages_by_hand,
             eq_17_12_compressed_runs_equal_direct_ones,
             eq_17_21_the_tolerance_is_kept_as_alpha_goes_to_1,
             eq_17_17_the_ends_are_a_spring_and_a_mass,
             eq_17_8_without_damping_time_runs_both_ways,
             eq_17_8_without_damping_the_energy_stays,
             eq_17_8_jumps_of_the_force_belong_to_neither_side,
             eq_17_8_a_chain_is_its_modes,
             eq_17_8_only_damped_coordinates_remember,
             eq_17_8_newton_finds_what_one_factorisation_finds);
    return run_suite(suite);
}
