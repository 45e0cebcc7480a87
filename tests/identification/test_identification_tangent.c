/* tests/identification/test_identification_tangent.c -- H 24: the derivatives that are computed together with a
 * run.
 * Run alone: make test-identification_tangent */
#include "identification_runs.h"
#include "run/whole_run.h"
#include "estimation/identification_model.h"

static const fvi_free_parameter SEVEN[] = {
    FVI_FREE_PARAMETER_ALPHA,       FVI_FREE_PARAMETER_RHO, FVI_FREE_PARAMETER_MASS,
    FVI_FREE_PARAMETER_X0,          FVI_FREE_PARAMETER_P0,  FVI_FREE_PARAMETER_CONSTANT,
    FVI_FREE_PARAMETER_CONSTANT + 1
};

/* Duffing's oscillator of the references; the run points into ref_rest. */
static fvi_run duffing(fvi_system *system, size_t i, size_t steps)
{
    *system = (fvi_system){ .d = 1,
                            .mass = &ref_rest[1],
                            .damping = &ref_rest[0],
                            .potential = fvi_potential_duffing(&ref_rest[4]) };
    fvi_run run =
        fvi_run_default(system, &ref_rest[2], &ref_rest[3], 0.0625, steps);
    run.alpha = ref_slopes[i].alpha;
    run.kappa = ref_slopes[i].kappa;
    run.past = ref_slopes[i].past;
    return run;
}

//> slopes
/* Rounding: 100 steps of a few roundings each, which grow as the slopes do: 1e-12. The
 * compressed memory keeps 1e-13 of each weight. Seen: 8e-16. */
START_TEST(eq_24_6_tangents_are_the_derivatives_of_the_run)
{
    for (size_t i = 0; i < LEN(ref_slopes); i++)
        for (int kind = 0; kind < 2; kind++) {
            double x[REF_STEPS + 1], slope[(REF_STEPS + 1) * 7];
            fvi_system system;
            fvi_run run = duffing(&system, i, REF_STEPS);
            run.memory = kind ? FVI_HISTORY_MODES : FVI_HISTORY_DIRECT;
            ck_assert_int_eq(fvi_tangent(&run, 7, SEVEN, x, slope),
                             FVI_SUCCESS);
            ck_assert_double_eq_tol(x[REF_STEPS], ref_slopes[i].x, 1e-12);
            for (size_t j = 0; j < 7; j++) {
                const double got = slope[REF_STEPS * 7 + j],
                             want = ref_slopes[i].slope[j];
                seen(fabs(got - want), "error of a slope");
                ck_assert_msg(fabs(got - want) <= 1e-12,
                              "case %zu, kind %d, slope %zu: %.17g, not %.17g",
                              i, kind, j, got, want);
            }
        }
}
END_TEST
//< slopes

/* The row x is that of the run, and each slope is the same whoever rides along. */
START_TEST(tangents_do_not_feel_each_other)
{
    double x[REF_STEPS + 1], alone[REF_STEPS + 1], all[(REF_STEPS + 1) * 7],
        one[REF_STEPS + 1];
    fvi_system system;
    const fvi_run run = duffing(&system, 0, REF_STEPS);
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, alone, NULL, NULL),
                     0);
    ck_assert_int_eq(fvi_tangent(&run, 7, SEVEN, x, all), FVI_SUCCESS);
    ck_assert_mem_eq(x, alone, sizeof x);
    for (size_t j = 0; j < 7; j++) {
        ck_assert_int_eq(fvi_tangent(&run, 1, &SEVEN[j], x, one), FVI_SUCCESS);
        for (size_t k = 0; k <= REF_STEPS; k++)
            ck_assert_near(one[k], all[k * 7 + j], 1e-13, "%zu at %zu", j, k);
    }
}
END_TEST

/* A damping that is zero has a slope, and no memory of its own. */
START_TEST(eq_24_6_by_a_damping_of_zero)
{
    static double x[101], up[101], slope[101];
    const double zero = 0, small = 1e-6;
    fvi_system system;
    fvi_run run = duffing(&system, 0, 100);
    system.damping = &zero;
    ck_assert_int_eq(fvi_tangent(&run, 1, &SEVEN[1], x, slope), FVI_SUCCESS);
    system.damping = &small;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, up, NULL, NULL), 0);
    for (size_t k = 0; k <= 100; k++) /* x'' by rho is about 10: 1e-5 */
        ck_assert_near((up[k] - x[k]) / small, slope[k], 5e-5, "row %zu", k);
}
END_TEST

/* The slopes of a motion that is read off between the steps, against central differences
 * of that motion, 2e-4 of a parameter wide: (1e-4)^2/6 of a third derivative, some 10 here.
 * Seen: 4.3e-8. */
START_TEST(eq_24_6_a_motion_between_the_steps_has_its_slopes)
{
    enum { n = 30, P = 7 };
    question q;
    double slope[n * P], motion[n], up[n];
    fvi_estimation_model m;
    ask(&q, NULL, P);
    q.constants[0] = 1;
    q.constants[1] = 0.5;
    q.fit.method = &fvi_fractional;
    q.fit.which = SEVEN;
    q.fit.n = n;
    q.run.alpha = 0.3;
    for (size_t i = 0; i < n; i++)
        q.t[i] = 0.173 * (double)i;
    fvi_estimation_model_init(&m, &q.fit, motion);
    fvi_estimation_model_set_step(&m, 0.0625);
    ck_assert(fvi_estimation_model_has_tangents(&m));
    ck_assert_int_eq(fvi_estimation_model_tangents(&m, slope), FVI_SUCCESS);
    for (size_t j = 0; j < P; j++) {
        const double there = fvi_estimation_model_get(&m, j);
        fvi_estimation_model_set(&m, j, there + 1e-4);
        ck_assert_int_eq(fvi_estimation_model_run(&m), FVI_SUCCESS);
        memcpy(up, motion, sizeof up);
        fvi_estimation_model_set(&m, j, there - 1e-4);
        ck_assert_int_eq(fvi_estimation_model_run(&m), FVI_SUCCESS);
        fvi_estimation_model_set(&m, j, there);
        for (size_t i = 0; i < n; i++) {
            const double want = (up[i] - motion[i]) / 2e-4;
            seen(fabs(slope[i * P + j] - want), "difference");
            ck_assert_near(slope[i * P + j], want, 2e-7, "%zu at %zu", j, i);
        }
    }
    fvi_estimation_model_clear(&m);
}
END_TEST

/* A fit by slopes that ride along, and the same by differences, which a method that does
 * not say what its equations are is left with: 1e-4 sd, as differences are 1e-7 wide. */
START_TEST(eq_24_3_slopes_and_differences_find_the_same)
{
    question q;
    fvi_estimate ridden, taken;
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    fvi_method other = fvi_fractional;
    other.scheme = FVI_SCHEME_CLASSICAL;
    ask(&q, ref_low, 5);
    add_noise(&q, 0.02, r);
    q.fit.h = 0.1;
    q.fit.method = &fvi_fractional;
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &ridden), FVI_SUCCESS);
    q.fit.method = &other;
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &taken), FVI_SUCCESS);
    for (size_t j = 0; j < 5; j++) {
        ck_assert_near(ridden.estimate[j], taken.estimate[j],
                       1e-4 * taken.sd[j], "estimate %zu", j);
        ck_assert_near(ridden.sd[j], taken.sd[j], 1e-4 * taken.sd[j], "sd %zu",
                       j);
    }
    gsl_rng_free(r);
}
END_TEST

START_TEST(tangents_refuse_what_they_do_not_know)
{
    static const double ones[] = { 1, 1 };
    double x[11], slope[11];
    const fvi_free_parameter beyond = FVI_FREE_PARAMETER_CONSTANT + 2;
    fvi_system system;
    fvi_run run = duffing(&system, 0, 10);
    fvi_set_error_handler(handler);
    ck_assert_int_eq(fvi_tangent(NULL, 1, SEVEN, x, slope), FVI_EFAULT);
    ck_assert_int_eq(fvi_tangent(&run, 1, NULL, x, slope), FVI_EFAULT);
    ck_assert_int_eq(fvi_tangent(&run, 1, SEVEN, NULL, slope), FVI_EFAULT);
    ck_assert_int_eq(fvi_tangent(&run, 1, SEVEN, x, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_tangent(&run, 0, SEVEN, x, slope), FVI_EINVAL);
    ck_assert_int_eq(fvi_tangent(&run, 1, &beyond, x, slope), FVI_EINVAL);
    const fvi_kernel_term term = { FVI_KERNEL_MAXWELL, 1, 0, 1, 0 };
    run.law = &(fvi_kernel){ 1, &term };
    ck_assert_int_eq(fvi_tangent(&run, 1, SEVEN, x, slope), FVI_EUNSUP);
    run.law = NULL;
    run.h = -1;
    ck_assert_int_eq(fvi_tangent(&run, 1, SEVEN, x, slope), FVI_EDOM);
    run.h = 1;
    system.d = 2;
    system.mass = system.damping = ones;
    ck_assert_int_eq(fvi_tangent(&run, 1, SEVEN, x, slope), FVI_EINVAL);
    fvi_mechanism mechanism = { .damper_count = 0 };
    system.mechanism = &mechanism;
    ck_assert_int_eq(fvi_tangent(&run, 1, SEVEN, x, slope), FVI_EUNSUP);
    ck_assert_int_eq(handled, 9); /* a start that is refused says so in its own error */
    fvi_set_error_handler(NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("derivatives beside a run");
    ADD_CASE(suite, "values", eq_24_6_tangents_are_the_derivatives_of_the_run,
             tangents_do_not_feel_each_other, eq_24_6_by_a_damping_of_zero,
             eq_24_6_a_motion_between_the_steps_has_its_slopes,
             eq_24_3_slopes_and_differences_find_the_same);
    ADD_CASE(suite, "errors", tangents_refuse_what_they_do_not_know);
    return run_suite(suite);
}
