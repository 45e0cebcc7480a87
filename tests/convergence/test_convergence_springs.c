/* tests/convergence/test_convergence_springs.c -- H 20: the error of form D on a spring by its formula, on any
 * mesh.
 * Run alone: make test-convergence_springs */
#include "springs.h"
#include "variable_step/variable_step.h"

/* ---- (20.16) ---- */

static double gap_of_rate(double sigma, const void *of)
{
    return creal(gap(of, -sigma));
}

/* What the run is off by after n steps. */
static double spring_error(const spring *q, const stability_function *R, size_t n,
                                  const double *h, double t, int order)
{
    const double complex pole = pole_of(q);
    const mesh_gap g = { q, R, n, h, t, order };
    return 2 * creal(residue(q, pole) * gap(&g, pole)) + over_rates(q, pole, gap_of_rate, &g);
}

//> formula
/* Runs of equal steps are off by what (20.16) says, to 2e-13 of the largest x and, of the
 * velocities, of the largest v with 1/h of x: 1000 u for the roundings of 40 steps. */
START_TEST(eq_20_16_equal_steps)
{
    double off = 0;
    for (size_t seed = 0; seed < 140; seed++) {
        const spring q = some_spring(seed);
        const size_t s = 2 + seed % 7, N = 40;
        const stability_function R = stability_of(s);
        solve(&q, s, between(2, 40), N, 0, 0);
        const double of_x = largest_of(want_x, N), of_v = largest_of(want_v, N) + of_x / lengths[0];
        for (size_t n = 1; n <= N; n += 13) {
            const double t = (double)n * lengths[0];
            ck_assert_near(x[n] - want_x[n], spring_error(&q, &R, n, lengths, t, 0), 2e-13 * of_x,
                           "s=%zu seed %zu x_%zu", s, seed, n);
            ck_assert_near(p[n] / q.m - want_v[n], spring_error(&q, &R, n, lengths, t, 1),
                           2e-13 * of_v, "s=%zu seed %zu v_%zu", s, seed, n);
            off = larger(off, fabs(x[n] - want_x[n]) / of_x);
        }
    }
    seen(off, "error");
    ck_assert_double_ge(off, 1e-2); /* the errors themselves are large */
}
END_TEST

/* The steps that fvi-adaptive chose, and its errors at their ends, which are those of
 * (20.16) but for the modes: 2e-13 of the largest x. */
START_TEST(eq_20_16_the_steps_of_fvi_adaptive)
{
    double off = 0;
    for (size_t seed = 0; seed < 60; seed++) {
        const spring q = some_spring(seed);
        const double p0 = q.m * q.v0, T = 20;
        const push of = { q.A, 0, 0 };
        const fvi_system system = { .d = 1, .mass = &q.m, .damping = &q.rho,
                                    .potential = fvi_potential_harmonic(&q.c),
                                    .force = { .value = force, .params = (void *)&of } };
        fvi_run run = fvi_run_default(&system, &q.x0, &p0, T, 1);
        run.alpha = q.alpha;
        run.past = FVI_INITIAL_HISTORY_CAPUTO;
        run.tolerance = FVI_FINE_MODES;
        run.step_error = seed % 3 ? 1e-4 : 1e-2;
        fvi_stepper *stepper;
        OK(fvi_stepper_start(&fvi_variable_step, &run, &stepper, NULL));
        const fvi_linear_oscillator problem = oscillator(&q);
        fvi_step_statistics counts;
        OK(fvi_stepper_statistics(stepper, &counts));
        const stability_function R = stability_of((size_t)counts.stages);
        double before = 0, most = fabs(q.x0) + fabs(q.v0), got = 0, want = 0;
        for (size_t n = 1; stepper->t < T; n++) {
            OK(fvi_stepper_step(stepper));
            lengths[n - 1] = stepper->t - before;
            before = stepper->t;
            double at_x, at_v;
            OK(fvi_exact_at(&problem, 1, &before, &at_x, &at_v, NULL));
            got = stepper->x[0] - at_x;
            want = spring_error(&q, &R, n, lengths, before, 0);
            most = larger(most, fabs(at_x));
            ck_assert_near(got, want, 2e-13 * most, "seed %zu step %zu", seed, n);
            off = larger(off, fabs(got) / most);
        }
        fvi_stepper_free(stepper);
    }
    seen(off, "error");
    ck_assert_double_ge(off, 1e-6);
}
END_TEST
//< formula

int main(void)
{
    Suite *suite = suite_create("20 convergence, form D on springs");
    ADD_CASE(suite, "formula", eq_20_16_equal_steps, eq_20_16_the_steps_of_fvi_adaptive);
    return run_suite(suite);
}
