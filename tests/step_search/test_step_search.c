/* tests/step_search/test_step_search.c -- H 18: is the error of a run as small as wanted?
 * Run alone: make test-step_search */
#include "step_search_runs.h"
#include "error_control/step_search.h"
#include "system/larger.h"

/* The true error of a search over its estimate and over what was asked for. */
static void ratios(const fvi_method *method, const fvi_linear_oscillator *q, double T,
                   double error, size_t rows, double *estimated, double *asked)
{
    fvi_step_found found;
    double worst;
    int status =
        search_linear(method, q, T, rows, error, 1 << 24, &found, &worst);
    ck_assert_msg(status == FVI_SUCCESS, "%s alpha=%g: %s, at %g", method->name,
                  q->alpha, fvi_error_name(status), found.estimate);
    *estimated = worst / found.estimate;
    *asked = worst / error;
}

/* How often, in 100 random problems, is the true error above 3 E? */
static void ck_assert_honest(const fvi_method *method, double loosest,
                             double tightest)
{
    int dishonest = 0;
    double worst = 0;
    for (int i = 0; i < 100; i++) {
        const fvi_linear_oscillator q = any_problem();
        double error = exp(dice(log(tightest), log(loosest)));
        size_t rows = 1 + (size_t)dice(0, ROWS - 1);
        double estimated, asked;
        ratios(method, &q, dice(2, 20), error, rows, &estimated, &asked);
        dishonest += asked > 3;
        worst = larger(worst, asked);
    }
    seen(worst, "error over the one asked for");
    ck_assert_msg(dishonest <= 1, "%s: %d of 100 above 3 E, the worst %g E",
                  method->name, dishonest, worst);
}

//> honest
/* A promise about chance, not a bound: at most one of 100 above 3 E. */
START_TEST(eq_18_2_the_error_asked_for_is_the_error_that_comes)
{
    ck_assert_honest(&fvi_fractional, 1e-1, 1e-4);
    ck_assert_honest(&fvi_cq2_shifted, 1e-2, 1e-7);
    ck_assert_honest(&fvi_cq_bdf2, 1e-2, 1e-7);
    ck_assert_honest(&fvi_lobatto_m2, 1e-2, 1e-7);
    ck_assert_honest(&fvi_lobatto_m3, 1e-3, 1e-10);
    ck_assert_honest(&fvi_lobatto_m4, 1e-3, 1e-11);
}
END_TEST
//< honest

/* Order 1 - 2 alpha, 0.16 and 0.1: taken for 1/4, the error would be twice the one
 * asked for. At alpha = 0.48 none of 2^16 steps is enough, and that is said. */
START_TEST(eq_18_2_a_kick_at_the_start_is_not_overlooked)
{
    const double alphas[] = { 0.4, 0.42, 0.45 }, one = 1, rho = 0.6, p0 = 0.3;
    for (size_t i = 0; i < LEN(alphas); i++) {
        const fvi_linear_oscillator q = { .m = 1,
                               .c = 1,
                               .rho = rho,
                               .alpha = alphas[i],
                               .x0 = 1,
                               .v0 = p0,
                               .forcing = FVI_FORCING_COSINE };
        double estimated, asked;
        ratios(&fvi_fractional, &q, 10, 0.1, ROWS, &estimated, &asked);
        ck_assert_msg(asked < 1, "alpha=%g: %g", alphas[i], asked);
    }
    const fvi_system system = { 1,     &one, &rho, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &one,
                          .p0 = &p0,
                          .h = 0.1,
                          .steps = 100,
                          .kappa = 0.5,
                          .alpha = 0.48,
                          .past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE };
    double x[101];
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 0.1, 1 << 16, x, NULL, &found),
        FVI_ETOL);
    ck_assert(found.estimate > 0.1 && found.estimate < 1);
}
END_TEST

/* Of order 2 the estimate is the error, but for terms of higher order.
 * Seen: 0.98 to 1; with CK_FORK=no, on other problems, 0.77 to 1.03. */
START_TEST(eq_18_2_the_estimate_is_near_the_error)
{
    const fvi_method *const methods[] = { &fvi_cq2_shifted, &fvi_cq_bdf2,
                                          &fvi_lobatto_m2 };
    for (size_t i = 0; i < LEN(methods); i++)
        for (int n = 0; n < 10; n++) {
            const fvi_linear_oscillator q = any_problem();
            double estimated, asked;
            ratios(methods[i], &q, 10, 1e-6, 40, &estimated, &asked);
            seen(estimated, "error over its estimate");
            ck_assert_msg(estimated > 0.5 && estimated < 1.5,
                          "%s, alpha=%g: %g", methods[i]->name, q.alpha,
                          estimated);
        }
}
END_TEST

/* A search of the step of x'' + rho x' + c x = 0 from rest at 1. */
static void search_from_rest(const fvi_method *method, double rho, double c,
                             double h, size_t steps, double kappa, double error,
                             double *x, fvi_step_found *found)
{
    const double one = 1, none = 0;
    const fvi_system system = { 1,     &one, &rho, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &none, h, steps);
    run.kappa = kappa;
    ck_assert_int_eq(
        fvi_step_search(method, &run, error, 1 << 24, x, NULL, found),
        FVI_SUCCESS);
}

/* h w = 100 / 3 and kappa = 1: the first runs overflow; that is no failure. */
START_TEST(steps_that_are_too_long_are_passed_over)
{
    double x[201];
    fvi_step_found found;
    search_from_rest(&fvi_fractional, 0.5, 1e4, 0.1, 200, 1, 1e-2, x, &found);
    ck_assert(found.parts > 32);
}
END_TEST

/* One row far away is compared at 128 times: a hit by chance is no proof. After a whole
 * period the error of x is that of a phase, squared. */
START_TEST(few_rows_are_not_all_that_is_compared)
{
    double x[2];
    fvi_step_found found;
    search_from_rest(&fvi_lobatto_m2, 0, 1, 2 * M_PI, 1, 0.5, 1e-3, x, &found);
    ck_assert(fabs(x[1] - 1) < 1e-9 && found.estimate > 1e-6);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("the search for a step");
    ADD_CASE(suite, "values",
             eq_18_2_the_error_asked_for_is_the_error_that_comes,
             eq_18_2_a_kick_at_the_start_is_not_overlooked);
    ADD_CASE(suite, "estimate", eq_18_2_the_estimate_is_near_the_error);
    ADD_CASE(suite, "identities", steps_that_are_too_long_are_passed_over,
             few_rows_are_not_all_that_is_compared);
    return run_suite(suite);
}
