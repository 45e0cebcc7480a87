/* tests/variable_steps/test_variable_steps_limits.c -- H 22: the limits of steps of any length.
 * Run alone: make test-variable_steps_limits */
#include <fvi/exact_solution.h>
#include "error_control/variable_step_search.h"
#include <fvi/fvi.h>
#include "harness/energy.h"
#include "harness/ulp.h"
#include "run/whole_run.h"

enum { ROWS = 400 };
static const double one = 1, zero = 0;

static int late_jump(double t, size_t d, void *params, double *F)
{
    (void)d, (void)params;
    *F = t <= 0.7310585 ? 8 : 0;
    return 0;
}

static int short_pulse(double t, size_t d, void *params, double *F)
{
    (void)d, (void)params;
    *F = fabs(t - 9.3) < 0.01 ? 100 : 0;
    return 0;
}

/* Its exact motion in all rows, from x0, if the force A ends at T. */
static int plate_exact(double x0, double A, double T, double *exact)
{
    const fvi_linear_oscillator problem = { .m = 1,
                                 .c = 1,
                                 .rho = 1,
                                 .alpha = 0.75,
                                 .past = FVI_INITIAL_HISTORY_CAPUTO,
                                 .forcing = FVI_FORCING_STEP,
                                 .A = A,
                                 .T = T,
                                 .x0 = x0 };
    double t[ROWS + 1], v[ROWS + 1];
    for (size_t k = 0; k <= ROWS; k++)
        t[k] = 20. / ROWS * (double)k;
    return fvi_exact_at(&problem, ROWS + 1, t, exact, v, NULL);
}

static double worst_of(const double *x, const double *exact)
{
    double worst = 0;
    for (size_t k = 0; k <= ROWS; k++)
        worst = larger(worst, fabs(x[k] - exact[k]));
    return worst;
}

/* Bagley and Torvik's plate, under a force that declares no jumps. */
static fvi_step_statistics plate(int (*value)(double, size_t, void *, double *),
                                 double x0, double tolerance, double *x)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &one,
                                .potential = fvi_potential_harmonic(&one),
                                .force = { .value = value } };
    fvi_run run = fvi_run_default(&system, &x0, &zero, 20. / ROWS, ROWS);
    run.alpha = 0.75;
    run.past = FVI_INITIAL_HISTORY_CAPUTO;
    run.step_error = tolerance;
    fvi_stepper *s;
    fvi_step_statistics counts;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
    for (size_t k = 0; k <= ROWS; k++)
        ck_assert_int_eq(fvi_stepper_advance_to(s, (double)k * run.h, x + k, NULL), 0);
    ck_assert_int_eq(fvi_stepper_statistics(s, &counts), 0);
    fvi_stepper_free(s);
    return counts;
}

/* A jump that nobody declared is found by steps that are rejected; it may cost ten times
 * the tolerance, and does cost steps. Measured. Seen: 2.8 times. */
START_TEST(a_jump_that_is_not_declared_costs_steps)
{
    double exact[ROWS + 1], x[ROWS + 1];
    ck_assert_int_eq(plate_exact(0, 8, 0.7310585, exact), FVI_SUCCESS);
    for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 100) {
        const fvi_step_statistics n = plate(late_jump, 0, tolerance, x);
        const double off = worst_of(x, exact) / tolerance;
        seen_worst(off, "of the tolerance");
        ck_assert_double_lt(off, 10);
        seen((double)n.steps, "steps, %.0e", tolerance);
        seen((double)n.rejected, "rejected, %.0e", tolerance);
        ck_assert_uint_ge(n.rejected, 5);
    }
}
END_TEST

static double jumps_at, jumps_from;

enum { SIZES = 3, PLACES = 60 };

/* What the plate does of each, for two tests: once, before they are processes. */
static double jumped[SIZES][PLACES][ROWS + 1];

static void choose_jump(size_t n, size_t i)
{
    jumps_from = 8 / gsl_pow_int(100, (int)n);
    jumps_at = 0.13 + 0.3171 * (double)i;
}

static int expect_jumps(void)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < SIZES * PLACES && !status; i++) {
        choose_jump(i / PLACES, i % PLACES);
        status = plate_exact(1, jumps_from, jumps_at,
                             jumped[i / PLACES][i % PLACES]);
    }
    return status;
}

static int some_jump(double t, size_t d, void *params, double *F)
{
    (void)d, (void)params;
    *F = t <= jumps_at ? jumps_from : 0;
    return 0;
}

/* A step that feels a small jump by less than its tolerance, as the estimate has it, is
 * taken as it is; but that estimate is made for what is smooth. Of jumps from 8, 8e-2 and
 * 8e-4 in 60 places, at five tolerances, large ones are off by ten of them at most, small
 * ones by more, and by 100 at most. Measured. Seen: 4.7, 20.8 and 17.5. */
START_TEST(a_small_jump_that_is_not_declared_is_overlooked)
{
    double x[ROWS + 1], worst[SIZES] = { 0 };
    for (size_t n = 0; n < SIZES; n++) {
        for (size_t i = 0; i < PLACES; i++) {
            choose_jump(n, i);
            for (double tolerance = 1e-4; tolerance > 1e-13; tolerance /= 100) {
                plate(some_jump, 1, tolerance, x);
                worst[n] =
                    larger(worst[n], worst_of(x, jumped[n][i]) / tolerance);
            }
        }
        seen(worst[n], "of the tolerance, from %g", jumps_from);
    }
    ck_assert_double_lt(worst[0], 10);
    ck_assert_double_gt(larger(worst[1], worst[2]), 10);
    ck_assert_double_lt(larger(worst[1], worst[2]), 100);
}
END_TEST

/* Two runs see it, in 60 places, for four wanted errors, if it is a jump from 8; small
 * ones may come between both. Measured. Seen: 0.52 of them; 0.48 and 0.36 from 8e-2 and
 * 8e-4. */
START_TEST(a_jump_that_is_not_declared_is_seen_by_two_runs)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &one,
                                .potential = fvi_potential_harmonic(&one),
                                .force = { .value = some_jump } };
    fvi_run run = fvi_run_default(&system, &one, &zero, 20. / ROWS, ROWS);
    run.alpha = 0.75;
    run.past = FVI_INITIAL_HISTORY_CAPUTO;
    size_t ran = 0;
    for (size_t n = 0; n < SIZES; n++) {
        double most = 0;
        for (size_t i = 0; i < PLACES; i++) {
            double x[ROWS + 1];
            choose_jump(n, i);
            for (double error = 1e-3; error > 1e-10; error /= 100) {
                fvi_variable_step_found found;
                ck_assert_int_eq(
                    fvi_variable_step_search(&run, 0, NULL, error, 100000, x, NULL, &found),
                    0);
                most = larger(most, worst_of(x, jumped[n][i]) / error);
                ran++;
            }
        }
        seen(most, "of the wanted error, from %g", jumps_from);
        ck_assert_double_lt(most, n == 0 ? 1.2 : 3);
    }
    ck_assert_uint_eq(ran, 720);
}
END_TEST

/* What falls between the stages of a step does not exist. */
START_TEST(a_pulse_between_the_stages_is_passed_over)
{
    double x[ROWS + 1];
    const fvi_step_statistics n = plate(short_pulse, 0, 1e-8, x);
    seen((double)n.steps, "steps");
    for (size_t k = 0; k <= ROWS; k++)
        ck_assert_double_eq(x[k], 0);
}
END_TEST

/* A spring of period 2 pi/10^4, hardly damped: each period is resolved. */
START_TEST(a_fast_spring_is_followed_through_every_period)
{
    const double c = 1e8, rho = 1e-6;
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    fvi_run run = fvi_run_default(&system, &one, &zero, 2. / ROWS, ROWS);
    run.alpha = 0.3;
    run.past = FVI_INITIAL_HISTORY_CAPUTO;
    run.step_error = 1e-10;
    const fvi_linear_oscillator problem = { .m = 1,
                                 .c = c,
                                 .rho = rho,
                                 .alpha = 0.3,
                                 .past = FVI_INITIAL_HISTORY_CAPUTO,
                                 .x0 = 1 };
    fvi_stepper *s;
    fvi_step_statistics counts;
    double x, p, t = 2, exact, v;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
    ck_assert_int_eq(fvi_stepper_advance_to(s, t, &x, &p), 0);
    ck_assert_int_eq(fvi_stepper_statistics(s, &counts), 0);
    fvi_stepper_free(s);
    ck_assert_int_eq(fvi_exact_at(&problem, 1, &t, &exact, &v, NULL), 0);
    /* rounding: omega t u for the phase, ten times */
    ck_assert_near(x, exact, 10 * 1e4 * t * U + 1e-10, "at %g", t);
    seen((double)counts.steps / (1e4 * t / (2 * M_PI)), "steps a period");
    ck_assert_uint_ge(counts.steps, 5 * 3183);
}
END_TEST

/* Without damping variable steps lose the balance of H 2: the energy of x'' + x^3 = 0
 * drifts as the time, also in form M. Twice the time, between 1.2 and 3 times as far.
 * (Not at every tolerance: some steps happen to balance.) */
START_TEST(without_damping_the_energy_drifts)
{
    const double cg[] = { 0, 1 };
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &zero,
                                .potential = fvi_potential_duffing(cg) };
    fvi_run run = fvi_run_default(&system, &one, &zero, 2000. / ROWS, ROWS);
    for (double tolerance = 1e-5; tolerance > 1e-8; tolerance /= 100) {
        double off[2] = { 0, 0 };
        fvi_stepper *s;
        fvi_step_statistics counts;
        run.step_error = tolerance;
        ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s,
                                           NULL), 0);
        while (s->k < ROWS) {
            ck_assert_int_eq(fvi_stepper_step(s), 0);
            double *o = &off[s->t > 1000];
            *o = larger(*o, fabs(energy_of(&system, s->x, s->p) - 0.25));
        }
        ck_assert_int_eq(fvi_stepper_statistics(s, &counts), 0);
        fvi_stepper_free(s);
        ck_assert_int_eq(counts.form, 'M');
        seen(off[1], "drift, %.0e", tolerance);
        seen((double)counts.steps, "steps, %.0e", tolerance);
        ck_assert_double_gt(off[1] / off[0], 1.2);
        ck_assert_double_lt(off[1] / off[0], 3);
    }
}
END_TEST

/* A body that begins next to 0 is driven to a size of 9: modes that would do for 1e-8 will not
 * do there. Against the exact motion, to the wanted error; both may round by 4e-13 of the size.
 * Seen: 0.05 of the bound. */
START_TEST(an_error_far_above_the_start_is_kept)
{
    const double m = 1, drag = 0.2, c = 0.01, x0 = 1e-8, p0 = 0,
                 aT[] = { 1, 10 }, error = 1e-11;
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &drag,
                                .potential = fvi_potential_harmonic(&c),
                                .force = fvi_force_step(aT) };
    fvi_run run = fvi_run_default(&system, &x0, &p0, 2.5, 4);
    const double t[] = { 0, 2.5, 5, 7.5, 10 };
    double found_x[5], want[5], v[5];
    fvi_variable_step_found found;
    run.alpha = 0.001;
    const fvi_linear_oscillator problem = { .m = m,
                                 .c = c,
                                 .rho = drag,
                                 .alpha = run.alpha,
                                 .x0 = x0,
                                 .forcing = FVI_FORCING_STEP,
                                 .A = aT[0],
                                 .T = aT[1] };
    ck_assert_int_eq(fvi_exact_at(&problem, 5, t, want, v, NULL), FVI_SUCCESS);
    ck_assert_int_eq(
        fvi_variable_step_search(&run, 0, NULL, error, 100000, found_x, NULL, &found),
        FVI_SUCCESS);
    for (size_t k = 0; k < 5; k++)
        ck_assert_near(found_x[k], want[k], error + 4e-13 * 9, "row %zu", k);
}
END_TEST

/* A chain of three whose masses, springs, dampings and momenta are `unit` times as large. */
static void chain_in_units_of(double unit, double *x, double *p)
{
    enum { D = 3, STEPS = 20 };
    const double mass[] = { unit, 2 * unit, unit },
                 rho[] = { 0.3 * unit, 0.1 * unit, 0.2 * unit }, cg[] = { unit, unit / 4 },
                 x0[] = { 1, 0, -0.5 }, p0[] = { 0.5 * unit, 0, unit };
    const fvi_system system = { .d = D,
                                .mass = mass,
                                .damping = rho,
                                .potential = fvi_potential_chain(cg) };
    fvi_run run = fvi_run_default(&system, x0, p0, 0.25, STEPS);
    run.alpha = 0.3;
    run.step_error = 1e-9;
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, p, NULL), FVI_SUCCESS);
}

/* Units that are a power of two move no digit, though squares of 2^600 are infinite. (The
 * inverse of such a matrix was 0, and the chain moved as if it were free.) */
START_TEST(eq_22_14_no_unit_is_too_large_or_too_small)
{
    enum { ALL = 3 * 21 };
    double x[ALL], p[ALL], x_of[ALL], p_of[ALL];
    chain_in_units_of(1, x, p);
    for (int power = -600; power <= 600; power += 300) {
        chain_in_units_of(ldexp(1, power), x_of, p_of);
        for (size_t i = 0; i < ALL; i++) {
            ck_assert_double_eq(x_of[i], x[i]);
            ck_assert_double_eq(p_of[i], ldexp(p[i], power));
        }
    }
}
END_TEST

int main(void)
{
    if (expect_jumps() != FVI_SUCCESS)
        return 1;
    Suite *suite = suite_create("variable_steps: limits");
    ADD_CASE(suite, "error", an_error_far_above_the_start_is_kept);
    ADD_CASE(suite, "limits", a_jump_that_is_not_declared_costs_steps,
             a_small_jump_that_is_not_declared_is_overlooked,
             a_jump_that_is_not_declared_is_seen_by_two_runs,
             a_pulse_between_the_stages_is_passed_over,
             a_fast_spring_is_followed_through_every_period,
             without_damping_the_energy_drifts);
    ADD_CASE(suite, "units", eq_22_14_no_unit_is_too_large_or_too_small);
    return run_suite(suite);
}
