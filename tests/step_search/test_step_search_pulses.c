/* tests/step_search/test_step_search_pulses.c -- H 18: the search finds pulses of the force that are shorter than a
 * step.
 * Run alone: make test-step_search_pulses */
#include "error_control/search_bound.h"
#include "run/whole_run.h"
#include "error_control/variable_step_search.h"
#include "error_control/step_search.h"
#include "harness/ulp.h"
#include "stages/lobatto_weights.h"
#include "variable_steps/pulse_problems.h"

/* 60 random pulses: the rows are right to the wanted error, or it is said that the steps
 * would be too many. */
START_TEST(eq_18_8_no_pulse_of_an_expression_is_missed)
{
    static const fvi_method *const methods[] = { &fvi_cq2_midpoint,
                                                 &fvi_lobatto_m3,
                                                 &fvi_fractional,
                                                 &fvi_lobatto_m4 };
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    ck_assert_ptr_nonnull(r);
    size_t found = 0;
    for (unsigned long i = 0; i < 60; i++) {
        pulse_problem q;
        char text[600];
        gsl_rng_set(r, 5000 + i);
        draw_pulse(r, &q);
        q.error = larger(q.error, i % 3 == 1 ? 1e-6 : 1e-3);
        if (q.width < 3e-3)
            continue; /* a second each, and a refusal */
        const double used = used_by_pulse(&q, methods[i % LEN(methods)]);
        describe_pulse(&q, text, sizeof text);
        found += q.status == FVI_SUCCESS;
        ck_assert_msg(q.status == FVI_ETOL || used <= 1, "%lu, %g: %s", i, used,
                      text);
    }
    ck_assert_uint_ge(found, 10);
    gsl_rng_free(r);
}
END_TEST

static const double one = 1, zero = 0, rho = 0.2;

/* One that the steps which seem right without bounds pass over: x would be 0.93 off. The
 * right steps may be too many, which is said then. */
START_TEST(eq_18_8_a_pulse_between_the_nodes_cuts_the_steps)
{
    const fvi_symbols of_t = { "t", 1, NULL, 0 };
    fvi_expression *F = NULL;
    ck_assert_int_eq(
        fvi_expression_parse("1343.857003553202*exp(-((t - 8.442331511654347)/"
                             "0.0004464760747710362)^2)",
                             &of_t, NULL, &F, NULL),
        0);
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one),
                                .force = fvi_force_expression(F) };
    fvi_run run = fvi_run_default(&system, &one, &zero, 1, 20);
    double x[21], y[21];
    fvi_step_found found;
    fvi_variable_step_found of_adaptive;
    run.alpha = 0.3;
    ck_assert_int_eq(
        fvi_variable_step_search(&run, 0, NULL, 1e-7, 1 << 20, x, NULL, &of_adaptive),
        0);
    const int status = fvi_step_search(&fvi_lobatto_m3, &run, 1e-3, 1 << 20, y,
                                       NULL, &found);
    ck_assert(status == FVI_SUCCESS || status == FVI_ETOL);
    for (size_t k = 0; k <= 20 && !status; k++)
        ck_assert_near(y[k], x[k], 1e-3, "row %zu", k);
    fvi_expression_free(F);
}
END_TEST

/* The smallest product of distances from t, in gap i, to k neighbours around it. */
static double smallest_product(size_t n, const double *c, size_t k, size_t i,
                               double t)
{
    double smallest = GSL_POSINF;
    for (size_t from = i + 2 > k ? i + 2 - k : 0; from <= i && from + k <= n; from++) {
        double product = 1;
        for (size_t j = 0; j < k; j++)
            product *= fabs(t - c[from + j]);
        smallest = smaller(smallest, product);
    }
    return smallest;
}

/* At 50 times in each gap: the bound is never below, and somewhere it is nearly reached. */
static void ck_assert_factors(size_t stages)
{
    enum { TIMES = 50 };
    static const double ends[] = { 0, 1 };
    static fvi_node_factors factor;
    const double *c = stages ? fvi_lobatto(stages)->c : ends;
    const size_t per = stages ? stages - 1 : 1;
    double node[16 * 7 + 1];
    fvi_search_node_factors(stages, factor);
    for (size_t n = 0; n <= FVI_BOUND_DOUBLINGS; n++) {
        const size_t count = (per << n) + 1;
        for (size_t i = 0; i < count; i++)
            node[i] = (double)(i / per) + c[i % per];
        for (size_t k = 2; k <= FVI_BOUND_ORDER && k <= count; k++) {
            double largest = 0;
            for (size_t i = 0; i + 1 < count; i++)
                for (size_t j = 0; j < TIMES; j++) {
                    const double t = node[i] + ((double)j + 0.5) / TIMES * (node[i + 1] - node[i]);
                    largest = larger(largest, smallest_product(count, node, k, i, t));
                }
            ck_assert_msg(largest <= factor[n][k] && factor[n][k] <= 1.4 * largest,
                          "%zu stages, 2^%zu steps, %zu nodes: %g, %g", stages, n,
                          k, factor[n][k], largest);
        }
    }
}

START_TEST(eq_18_8_the_factors_of_nodes)
{
    static fvi_node_factors factor;
    fvi_search_node_factors(4, factor); /* t (1 - t) (t^2 - t + 1/5) at 1/2 */
    ck_assert_double_ge(factor[0][4], 0.0125);
    ck_assert_double_le(factor[0][4], 0.016);
    fvi_search_node_factors(2, factor); /* t (1 - t) (2 - t) (3 - t) */
    ck_assert_double_ge(factor[2][4], 1);
    ck_assert_double_le(factor[2][4], 1.25);
    ck_assert_factors(0);
    for (size_t stages = 3; stages <= 8; stages++)
        ck_assert_factors(stages);
}
END_TEST

/* A force that every step sees: the bounds ask for no more of them than the motion. */
START_TEST(eq_18_8_a_smooth_force_takes_no_more_steps)
{
    static const fvi_method *const methods[] = { &fvi_lobatto_m3, &fvi_lobatto_m4,
                                                 &fvi_lobatto_m6 };
    const fvi_symbols of_t = { "t", 1, NULL, 0 };
    fvi_expression *F = NULL;
    ck_assert_int_eq(fvi_expression_parse("tanh(3*(t-5))", &of_t, NULL, &F, NULL), 0);
    fvi_system system = { .d = 1,
                          .mass = &one,
                          .damping = &rho,
                          .potential = fvi_potential_harmonic(&one) };
    fvi_run run = fvi_run_default(&system, &one, &zero, 0.1, 200);
    double x[201];
    run.alpha = 0.3;
    for (size_t m = 0; m < LEN(methods); m++) {
        fvi_step_found bounded, trusting;
        system.force = fvi_force_expression(F);
        ck_assert_int_eq(fvi_step_search(methods[m], &run, 1e-8, 1 << 20, x,
                                         NULL, &bounded),
                         0);
        system.force.bound = NULL;
        ck_assert_int_eq(fvi_step_search(methods[m], &run, 1e-8, 1 << 20, x,
                                         NULL, &trusting),
                         0);
        ck_assert_uint_eq(bounded.parts, trusting.parts);
    }
    fvi_expression_free(F);
}
END_TEST

/* x at the end is about the sine of what is left, 2 sqrt(pi) 10^-3 in all. */
static int pulse(double t, size_t d, void *params, double *F)
{
    (void)d, (void)params;
    *F = exp(-gsl_pow_2((t - 9.37) / 2e-3));
    return 0;
}

/* What a callback does not say, the caller can: no step is longer than the pulse. */
START_TEST(a_longest_step_sees_what_no_bound_says)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one),
                                .force = { .value = pulse } };
    fvi_run run = fvi_run_default(&system, &zero, &zero, 4, 5);
    double x[6], y[6], z[6];
    fvi_step_found found;
    fvi_variable_step_found of_adaptive;
    run.alpha = 0.3;
    ck_assert_int_eq(
        fvi_variable_step_search(&run, 0, NULL, 1e-9, 1 << 20, x, NULL, &of_adaptive),
        0);
    ck_assert(x[5] == 0); /* it was missed */
    run.longest = 4e-3;
    ck_assert_int_eq(
        fvi_variable_step_search(&run, 0, NULL, 1e-9, 1 << 20, x, NULL, &of_adaptive),
        0);
    ck_assert_double_le(of_adaptive.counts.longest, 4e-3 * (1 + 1e-12));
    ck_assert_int_eq(fvi_step_search(&fvi_cq2_midpoint, &run, 1e-3, 1 << 20, y,
                                     NULL, &found),
                     0);
    ck_assert_double_le(run.h / (double)found.parts, 4e-3);
    run.step_error = 1e-9;
    ck_assert_int_eq(fvi_trajectory(&fvi_variable_step, &run, z, NULL, NULL),
                     0);
    ck_assert_double_gt(fabs(x[5]), 1e-4);
    ck_assert_near(y[5], x[5], 1e-3, "halved");
    ck_assert_near(z[5], x[5], 1e-7, "one run");
    const fvi_system unforced = { .d = 1,
                                  .mass = &one,
                                  .damping = &rho,
                                  .potential = fvi_potential_harmonic(&one) };
    run.system = &unforced;
    run.x0 = &one; /* this motion needs steps of 0.1, and is not at rest */
    ck_assert_int_eq(fvi_step_search(&fvi_cq2_midpoint, &run, 1e-2, 1 << 20, y,
                                     NULL, &found),
                     0);
    ck_assert_double_le(run.h / (double)found.parts, 4e-3);
    fvi_stepper *s;
    run.longest = -1;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_midpoint, &run, &s,
                                       NULL), FVI_EDOM);
    run.longest = GSL_NAN;
    ck_assert_int_eq(fvi_stepper_start(&fvi_cq2_midpoint, &run, &s,
                                       NULL), FVI_EDOM);
}
END_TEST

int main(void)
{
    gsl_set_error_handler_off();
    Suite *suite = suite_create("H 18: pulses of the force");
    ADD_CASE(suite, "pulses", eq_18_8_no_pulse_of_an_expression_is_missed,
             eq_18_8_a_pulse_between_the_nodes_cuts_the_steps,
             eq_18_8_the_factors_of_nodes,
             eq_18_8_a_smooth_force_takes_no_more_steps,
             a_longest_step_sees_what_no_bound_says);
    return run_suite(suite);
}
