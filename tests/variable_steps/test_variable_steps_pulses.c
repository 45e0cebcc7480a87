/* tests/variable_steps/test_variable_steps_pulses.c -- H 22: the method finds pulses of the force that are shorter
 * than the distance of two stages.
 * Run alone: make test-variable_steps_pulses */
#include "harness/ulp.h"
#include "pulse_problems.h"

/* 100 random pulses, 10^-6 to 10^-1 wide, are met, and the rows are right to the wanted
 * error. Steps that do not look at bounds miss two of three, by up to 10^9 times that. */
START_TEST(eq_22_25_no_pulse_of_an_expression_is_missed)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    ck_assert_ptr_nonnull(r);
    for (unsigned long i = 0; i < 100; i++) {
        pulse_problem q;
        char text[600];
        gsl_rng_set(r, 1000 + i);
        draw_pulse(r, &q);
        const double used = used_by_pulse(&q, NULL);
        describe_pulse(&q, text, sizeof text);
        ck_assert_msg(q.status == FVI_SUCCESS && used <= 1, "%lu, %g: %s", i,
                      used, text);
        seen_worst(used, "of the wanted error");
    }
    gsl_rng_free(r);
}
END_TEST

static const double one = 1, zero = 0, rho = 0.2;
static const fvi_symbols names = { "t", 1, NULL, 0 };

/* Steps of a run to 20 of a damped body at rest, with such a force, whose bounds are known
 * or not; x at the end. */
static fvi_step_statistics steps_with(const char *text, int bounded, double *x)
{
    fvi_expression *e;
    ck_assert_int_eq(fvi_expression_parse(text, &names, NULL, &e, NULL), 0);
    fvi_system system = { .d = 1,
                          .mass = &one,
                          .damping = &rho,
                          .potential = fvi_potential_harmonic(&one),
                          .force = fvi_force_expression(e) };
    if (!bounded)
        system.force.bound = NULL;
    fvi_run run = fvi_run_default(&system, &zero, &zero, 20, 1);
    run.alpha = 0.3;
    run.step_error = 1e-9;
    fvi_stepper *s;
    fvi_step_statistics counts;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
    ck_assert_int_eq(fvi_stepper_advance_to(s, 20, x, NULL), 0);
    ck_assert_int_eq(fvi_stepper_statistics(s, &counts), 0);
    fvi_stepper_free(s);
    fvi_expression_free(e);
    return counts;
}

/* Where nothing hides, bounds change no step. */
START_TEST(eq_22_25_a_smooth_force_takes_the_same_steps)
{
    static const char *const smooth[] = {
        "1",         "cos(2*t)",           "t*exp(-t)",
        "exp(sin(t))", "sin(t)^2*exp(-t/9)", "sqrt(1+t)*cos(t)",
        "t^2/40-1",  "cos(t^2/4)",         "exp(-(t-5)^2/2)",
    };
    for (size_t i = 0; i < LEN(smooth); i++) {
        double x, y;
        const fvi_step_statistics with = steps_with(smooth[i], 1, &x),
                                  without = steps_with(smooth[i], 0, &y);
        ck_assert_msg(with.steps == without.steps && x == y, "%s: %zu, %zu",
                      smooth[i], with.steps, without.steps);
    }
}
END_TEST

/* A bound that is infinite about a time, though the force is not, makes steps short there,
 * and ends no run; nor does a jump that is not declared. */
START_TEST(eq_22_25_what_has_no_bound_is_passed)
{
    static const char *const hard[] = { "sin(t-5)/(t-5)", "abs(t-7)/(t-7)",
                                        "sqrt(abs(t-3.3))", "abs(sin(t))" };
    for (size_t i = 0; i < LEN(hard); i++) {
        double x;
        const fvi_step_statistics n = steps_with(hard[i], 1, &x);
        seen((double)n.steps, "steps, %s", hard[i]);
        ck_assert_msg(n.steps < 1000 && isfinite(x), "%s: %zu", hard[i],
                      n.steps);
    }
}
END_TEST

/* Of an interval that is known to be clear, copies and runs that are gone on with know as
 * much: the digits are the same. */
START_TEST(eq_22_25_a_copy_goes_on_with_the_same_digits)
{
    fvi_expression *e;
    ck_assert_int_eq(fvi_expression_parse("exp(-((t-9.1)/1e-3)^2)", &names,
                                          NULL, &e, NULL),
                     0);
    fvi_system system = { .d = 1,
                          .mass = &one,
                          .damping = &rho,
                          .potential = fvi_potential_harmonic(&one),
                          .force = fvi_force_expression(e) };
    const fvi_run run = fvi_run_default(&system, &one, &zero, 20, 1);
    fvi_stepper *s, *copy;
    ck_assert_int_eq(fvi_stepper_start(&fvi_variable_step, &run, &s, NULL), 0);
    ck_assert_int_eq(fvi_stepper_advance_to(s, 5, NULL, NULL), 0);
    ck_assert_int_eq(fvi_stepper_copy(s, &copy), 0);
    while (s->t < 20) {
        ck_assert_int_eq(fvi_stepper_step(s), 0);
        ck_assert_int_eq(fvi_stepper_step(copy), 0);
        ck_assert(s->t == copy->t && s->x[0] == copy->x[0]);
    }
    fvi_stepper_free(s);
    fvi_stepper_free(copy);
    fvi_expression_free(e);
}
END_TEST

/* At the start the force is 10^-43. So the modes must serve what it becomes: modes that serve the start are off by
 * 3e-9 of the motion. The truth is 16,000 steps of four stages, which round by some 1e-12. Seen: 3.4e-12 apart. */
START_TEST(a_pulse_after_rest_has_modes_for_its_size)
{
    static const double alphas[] = { 0.4, 0.6, 0.75, 0.9 };
    fvi_expression *e;
    ck_assert_int_eq(fvi_expression_parse("300/cosh((t-2)/0.04)^2", &names, NULL, &e, NULL), 0);
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one),
                                .force = fvi_force_expression(e) };
    static double want[16001];
    for (int i = 0; i < 4; i++) {
        double x[2];
        fvi_run run = fvi_run_default(&system, &zero, &zero, 20.0 / 16000, 16000);
        run.alpha = alphas[i];
        ck_assert_int_eq(fvi_trajectory(&fvi_lobatto_m4, &run, want, NULL, NULL), 0);
        run.h = 20, run.steps = 1, run.step_error = 1e-13;
        ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, x, NULL, NULL), 0);
        ck_assert_near(x[1], want[16000], 1e-11 * 20, "alpha = %g", alphas[i]);
    }
    fvi_expression_free(e);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("H 22: pulses of the force");
    ADD_CASE(suite, "pulses", eq_22_25_no_pulse_of_an_expression_is_missed, a_pulse_after_rest_has_modes_for_its_size,
             eq_22_25_a_smooth_force_takes_the_same_steps,
             eq_22_25_what_has_no_bound_is_passed,
             eq_22_25_a_copy_goes_on_with_the_same_digits);
    return run_suite(suite);
}
