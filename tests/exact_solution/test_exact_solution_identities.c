/* tests/exact_solution/test_exact_solution_identities.c -- H 11: identities.
 * Run alone: make test-exact_solution_identities */
#include "exact_problems.h"

#include <gsl/gsl_integration.h>

/* The slope in alpha is taken from a step of 10^-3 to either side; closer by
 * the difference must shrink in proportion, down to rounding. */
START_TEST(eq_11_13_alpha_passes_0_one_half_and_1_without_a_jump)
{
    const double from[] = { 0, 0.5, 0.5, 1 }, side[] = { 1, -1, 1, -1 };
    const double steps[] = { 1e-6, 1e-9, 1e-12, 0x1p-52 };
    for (size_t i = 0; i < 4 * LEN(steps); i++) {
        double a = from[i % 4], e = side[i % 4] * steps[i / 4];
        for (double t = 0.5; t < 100; t *= 3) {
            double x = solve_x(oscillator(a, 0, 0, 1), t);
            double far =
                solve_x(oscillator(a + 1e-3 * side[i % 4], 0, 0, 1), t);
            double near = solve_x(oscillator(a + e, 0, 0, 1), t);
            double want = (far - x) * fabs(e) / 1e-3;
            ck_assert_near(near - x, want, 0.2 * fabs(want) + 2 * TOL,
                           "alpha=%g%+g t=%g", a, e, t);
        }
    }
}
END_TEST

/* Caputo's derivative of order 1 + 0 is x' - v0: there is a jump, of the answer
 * to the constant force rho v0. TOL for each of the three, |x| < 1.5. */
START_TEST(eq_11_2_caputo_jumps_just_above_one_half)
{
    const fvi_linear_oscillator push = { .m = 1,
                              .c = 1,
                              .rho = RHO,
                              .alpha = 0.5,
                              .forcing = FVI_FORCING_STEP,
                              .A = RHO,
                              .T = 99 };
    for (double t = 0.5; t < 99; t *= 2)
        ck_assert_near(solve_x(oscillator(0.5 + 0x1p-50, 1, 1, 1), t),
                       solve_x(oscillator(0.5, 1, 1, 1), t) + solve_x(push, t),
                       5 * TOL, "t=%g", t);
}
END_TEST

/* A held body's motion is a push from the origin, which Riemann-Liouville has too, and
 * a release at rest, which Caputo has too. TOL for each of the three, |x| < 2. */
START_TEST(eq_11_2_held_is_a_push_and_a_release)
{
    const double alphas[] = { 0, 0.2, 0.5, 0.7, 0.95, 1 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (double t = 1e-3; t < 99; t *= 2) {
            fvi_linear_oscillator held = oscillator(alphas[i], 1, 1, 0.5);
            held.past = FVI_INITIAL_HISTORY_HELD;
            ck_assert_near(solve_x(held, t),
                           solve_x(oscillator(alphas[i], 0, 0, 0.5), t)
                               + solve_x(oscillator(alphas[i], 1, 1, 0), t),
                           6 * TOL, "alpha=%g t=%g", alphas[i], t);
        }
}
END_TEST

/* Four and two terms of order 1; the transforms are the same functions. */
START_TEST(eq_11_3_a_step_response_is_one_minus_caputo)
{
    const double alphas[] = { 0, 0.2, 0.5, 0.6, 0.95, 1 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (double t = 1e-3; t < 1e4; t *= 2.7) {
            fvi_linear_oscillator p = { .m = 1,
                             .c = 1,
                             .rho = RHO,
                             .alpha = alphas[i],
                             .forcing = FVI_FORCING_STEP,
                             .A = 1,
                             .T = 5 };
            double caputo = 1 - solve_x(oscillator(alphas[i], 1, 1, 0), t);
            if (t > 5)
                caputo -= 1 - solve_x(oscillator(alphas[i], 1, 1, 0), t - 5);
            /* + t u: t - 5 is rounded, and x' is of order 1 */
            ck_assert_near(solve_x(p, t), caputo, 8 * TOL + t * U,
                           "alpha=%g t=%g", alphas[i], t);
        }
}
END_TEST

/* The kernel (11.8) of the cut at r = e^u, with e^(-rt) dr/du. */
static double kernel(double u, void *params)
{
    const fvi_linear_oscillator *p = params;
    double r = exp(u), t = p->T, b = 2 * p->alpha, y = p->rho * pow(r, b);
    double Q1 = p->m * r * r + p->c, re = Q1 + y * cos(M_PI * b);
    double im = y * sin(M_PI * b), k1 = p->past == FVI_INITIAL_HISTORY_CAPUTO && b > 1;
    double top =
        p->m * (p->v0 - r * p->x0)
        + ((p->past == FVI_INITIAL_HISTORY_CAPUTO) * p->x0 / r - k1 * p->v0 / r / r) * Q1;
    return exp(-r * t) * r * im / M_PI * top / (re * re + im * im);
}

/* What is left of x without the oscillation is the integral, taken here by GSL
 * on the cut itself, to within GSL's own estimate of its error. What lies beyond
 * the ends is below e^(-0.2 * 160) and e^-60. */
//> cut
START_TEST(eq_11_8_the_rest_is_the_integral_along_the_cut)
{
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(2000);
    const double alphas[] = { 0.15, 0.25, 0.45, 0.6, 0.75, 0.9 };
    for (size_t i = 0; i < LEN(alphas) * 2; i++)
        for (double t = 0.5; t < 50; t *= 3) {
            int caputo = i % 2;
            double a = alphas[i / 2], wave, cut, error;
            fvi_linear_oscillator p = oscillator(a, caputo, caputo || a < 0.5, 1);
            double x = solve_x(p, t);
            fvi_exact_oscillation(&p, 1, &t, &wave, NULL, NULL);
            p.T = t;
            gsl_function f = { kernel, &p };
            gsl_integration_qag(&f, -160, log(60 / t), 1e-13, 0, 2000,
                                GSL_INTEG_GAUSS61, work, &cut, &error);
            ck_assert(error < 1e-12);
            ck_assert_near(x - wave, cut, error + 4 * TOL,
                           "alpha=%g caputo=%d t=%g", a, caputo, t);
        }
    gsl_integration_workspace_free(work);
}
END_TEST
//< cut

/* The wave of a pulse, before and after its end: that of two steps. Here |x| < 2
 * and |t - T| is exact. */
START_TEST(eq_11_7_the_wave_of_a_pulse_is_that_of_two_steps)
{
    for (double t = 0.25; t < 50; t *= 2)
        for (double T = 0; T < 10; T = 2 * T + 0.25) {
            double wave, on, off = 0, since = t - T;
            fvi_linear_oscillator p = oscillator(0.3, 0, 0, 0);
            p.forcing = FVI_FORCING_STEP;
            p.A = 1;
            p.T = T;
            fvi_exact_oscillation(&p, 1, &t, &wave, NULL, NULL);
            p.T = 1e3;
            fvi_exact_oscillation(&p, 1, &t, &on, NULL, NULL);
            if (since > 0)
                fvi_exact_oscillation(&p, 1, &since, &off, NULL, NULL);
            ck_assert_near(wave, on - off, TOL, "t=%g T=%g", t, T);
        }
}
END_TEST

/* A pulse of area 1 and length T = 2^-30 is the start v0 = 1, half of T later, but
 * for T^2. A late one, without damping and c = 9, is (cos 3(t - T) - cos 3t) / 9;
 * neither t - T nor three times that is a double, and what is missing turns the
 * phase by 2^-39. */
START_TEST(eq_11_7_short_pulses_and_late_ones)
{
    const double T = 0x1p-30, late = 1234.1;
    for (double t = 0.25; t < 2e4; t *= 2) {
        double x, v;
        fvi_linear_oscillator p = oscillator(0.3, 0, 0, 1);
        solve(&p, t, &x, &v);
        p.v0 = 0;
        p.forcing = FVI_FORCING_STEP;
        p.A = 1 / T;
        p.T = T;
        ck_assert_near(solve_x(p, t), x - v * T / 2, 2 * TOL, "t=%g", t);
        if (t < 2 * late)
            continue;
        double since = t - late, rest = (t - since) - late;
        double turn = 3 * since, lost = fma(3, since, -turn) + 3 * rest;
        double want = (cos(turn) - lost * sin(turn) - cos(3 * t)) / 9;
        p = (fvi_linear_oscillator){
            .m = 1, .c = 9, .forcing = FVI_FORCING_STEP, .A = 1, .T = late
        };
        ck_assert_near(solve_x(p, t), want, TOL, "t=%g", t);
    }
}
END_TEST

/* x' for the start (0, 1) has the transform m s / Q, that of x for (1, 0). */
START_TEST(eq_11_2_the_velocity_is_the_solution_of_another_start)
{
    for (double a = 0; a < 0.5; a += 0.07)
        for (double t = 1e-6; t < 1e4; t *= 5) {
            double x, v;
            fvi_linear_oscillator p = oscillator(a, 0, 0, 1);
            solve(&p, t, &x, &v);
            ck_assert_near(v, solve_x(oscillator(a, 0, 1, 0), t), 2 * TOL,
                           "alpha=%g t=%g", a, t);
        }
}
END_TEST

/* m, c, rho times 10^+-150 leave x alone; times 2^200 in time with the matching
 * powers of it in the coefficients too. Rounding of the new coefficients: u. */
START_TEST(eq_11_1_units_do_not_matter)
{
    const double units[] = { 1, 1e150, 1e-150 }, L = 0x1p200;
    for (double t = 0.1; t < 30; t *= 3) {
        double want = solve_x(oscillator(0.25, 1, 1, 0), t);
        for (size_t i = 0; i < LEN(units); i++) {
            fvi_linear_oscillator p = { .m = units[i],
                             .c = units[i],
                             .rho = RHO * units[i],
                             .alpha = 0.25,
                             .past = FVI_INITIAL_HISTORY_CAPUTO,
                             .x0 = 1 };
            ck_assert_near(solve_x(p, t), want, 2 * TOL + 4 * t * U, "%g",
                           units[i]);
            p.c /= L * L;
            p.rho /= L * sqrt(L);
            ck_assert_near(solve_x(p, t * L), want, 2 * TOL + 4 * t * U, "%g",
                           units[i]);
        }
    }
}
END_TEST

/* Where nothing decays the rate is 0, not the rounding of one: at |s| = 10^40 that
 * would be a growth of 10^6 a second. After 8e17 swings the phase is not known. */
START_TEST(what_is_not_damped_does_not_decay)
{
    const double alphas[] = { 0, 0.3, 1 };
    for (size_t i = 0; i < LEN(alphas); i++)
        for (int exponent = -300; exponent <= 280; exponent += 20) {
            fvi_linear_oscillator p = {
                .m = pow(10, exponent), .c = 1, .alpha = alphas[i], .x0 = 1
            };
            p.rho = alphas[i] == 1 ? 1e20 * p.m : 0;
            double re = 1, im = 0, x = 7, t;
            ck_assert_int_eq(fvi_exact_pole(&p, &re, &im, NULL), FVI_SUCCESS);
            ck_assert(re == 0 && im > 0);
            t = 1e17 / im;
            ck_assert_int_eq(fvi_exact_at(&p, 1, &t, &x, NULL,
                                          NULL), FVI_SUCCESS);
            ck_assert(fabs(x) <= 1 + 1e-13);
            x = 7;
            t = 1e18 / im;
            ck_assert_int_eq(fvi_exact_at(&p, 1, &t, &x, NULL,
                                          NULL), FVI_ELOSS);
            ck_assert_int_eq(fvi_exact_oscillation(&p, 1, &t, &x, NULL, NULL),
                             FVI_ELOSS);
            ck_assert(x == 7);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("11 exact solution, identities");
    ADD_CASE(suite, "identities", eq_11_1_units_do_not_matter,
             eq_11_2_caputo_jumps_just_above_one_half,
             eq_11_2_the_velocity_is_the_solution_of_another_start,
             eq_11_2_held_is_a_push_and_a_release,
             eq_11_3_a_step_response_is_one_minus_caputo,
             eq_11_7_the_wave_of_a_pulse_is_that_of_two_steps,
             eq_11_7_short_pulses_and_late_ones,
             eq_11_8_the_rest_is_the_integral_along_the_cut,
             eq_11_13_alpha_passes_0_one_half_and_1_without_a_jump,
             what_is_not_damped_does_not_decay);
    return run_suite(suite);
}
