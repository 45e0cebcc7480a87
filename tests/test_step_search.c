/* tests/test_step_search.c -- Chapter 18.  Run alone: make test-step_search */
#include "convolution_quadrature.h"
#include "discrete_mechanics.h"
#include "exact_solution.h"
#include "fvi.h"
#include "lobatto.h"
#include "step_search.h"
#include "ulp.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>

static unsigned long long seed = 20240607;

/* Uniform in [low, high]. */
static double dice(double low, double high)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * 0x1p-53 * (double)(seed >> 11);
}

enum { ROWS = 50 };

/* A random linear problem; the cosine is within reach of the rows. */
static fvi_linear any_problem(void)
{
    return (fvi_linear){ .m = dice(0.5, 2),
                         .c = dice(0.2, 5),
                         .rho = dice(0.05, 1),
                         .alpha = dice(0.05, 0.95),
                         .past = FVI_PAST_CAPUTO,
                         .x0 = dice(-1, 1),
                         .v0 = dice(-1, 1),
                         .forcing = FVI_FORCING_COSINE,
                         .A = dice(-1, 1),
                         .w = dice(0, 3) };
}

/* The true error of a search over its estimate and over what was asked for. */
static void ratios(const fvi_method *method, const fvi_linear *q, double T,
                   double error, size_t rows, double *estimated, double *asked)
{
    const double aw[2] = { q->A, q->w }, p0 = q->m * q->v0;
    const fvi_system system = { 1, &q->m, &q->rho,
                                fvi_potential_harmonic(&q->c),
                                fvi_force_cosine(aw) };
    const fvi_run run = { .system = &system,
                          .x0 = &q->x0,
                          .p0 = &p0,
                          .h = T / (double)rows,
                          .steps = rows,
                          .kappa = 0.5,
                          .alpha = q->alpha,
                          .past = q->past };
    double x[ROWS + 1], t[ROWS + 1], want[ROWS + 1], worst = 0;
    fvi_step_found found;
    int status = fvi_step_search(method, &run, error, 1 << 24, x, NULL, &found);
    ck_assert_msg(status == GSL_SUCCESS, "%s alpha=%g: %s, at %g", method->name,
                  q->alpha, gsl_strerror(status), found.estimate);
    for (size_t k = 0; k <= rows; k++)
        t[k] = (double)k * run.h;
    ck_assert_int_eq(fvi_exact(q, rows + 1, t, want, NULL), GSL_SUCCESS);
    for (size_t k = 0; k <= rows; k++)
        worst = fmax(worst, fabs(x[k] - want[k]));
    *estimated = worst / found.estimate;
    *asked = worst / error;
}

/* How often, in 100 random problems, is the true error above 3 E? */
static void ask_100(const fvi_method *method, double loosest, double tightest)
{
    int dishonest = 0;
    double worst = 0;
    for (int i = 0; i < 100; i++) {
        const fvi_linear q = any_problem();
        double error = exp(dice(log(tightest), log(loosest)));
        size_t rows = 1 + (size_t)dice(0, ROWS - 1);
        double estimated, asked;
        ratios(method, &q, dice(2, 20), error, rows, &estimated, &asked);
        dishonest += asked > 3;
        worst = fmax(worst, asked);
    }
    seen(worst, "error over the one asked for");
    ck_assert_msg(dishonest <= 1, "%s: %d of 100 above 3 E, the worst %g E",
                  method->name, dishonest, worst);
}

//> honest
/* A promise about chance, not a bound: at most one of 100 above 3 E. */
START_TEST(eq_18_2_the_error_asked_for_is_the_error_that_comes)
{
    ask_100(&fvi_fractional, 1e-1, 1e-4);
    ask_100(&fvi_shifted, 1e-2, 1e-7);
    ask_100(&fvi_bdf2, 1e-2, 1e-7);
    ask_100(&fvi_lobatto2, 1e-2, 1e-7);
    ask_100(&fvi_lobatto3, 1e-3, 1e-10);
    ask_100(&fvi_lobatto4, 1e-3, 1e-11);
}
END_TEST
//< honest

/* Order 1 - 2 alpha, 0.16 and 0.1: taken for 1/4, the error would be twice the one
 * asked for. At alpha = 0.48 none of 2^16 steps is enough, and that is said. */
START_TEST(eq_18_2_a_kick_at_the_start_is_not_overlooked)
{
    const double alphas[] = { 0.4, 0.42, 0.45 }, one = 1, rho = 0.6, p0 = 0.3;
    for (size_t i = 0; i < LEN(alphas); i++) {
        const fvi_linear q = { .m = 1,
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
    const fvi_system system = {
        1, &one, &rho, fvi_potential_harmonic(&one), { 0 }
    };
    const fvi_run run = { .system = &system,
                          .x0 = &one,
                          .p0 = &p0,
                          .h = 0.1,
                          .steps = 100,
                          .kappa = 0.5,
                          .alpha = 0.48,
                          .past = FVI_PAST_RIEMANN_LIOUVILLE };
    double x[101];
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 0.1, 1 << 16, x, NULL, &found),
        GSL_ETOL);
    ck_assert(found.estimate > 0.1 && found.estimate < 1);
}
END_TEST

/* Of order 2 the estimate is the error, but for terms of higher order.
 * Seen: 0.98 to 1; with CK_FORK=no, on other problems, 0.77 to 1.03. */
START_TEST(eq_18_2_the_estimate_is_near_the_error)
{
    const fvi_method *const methods[] = { &fvi_shifted, &fvi_bdf2,
                                          &fvi_lobatto2 };
    for (size_t i = 0; i < LEN(methods); i++)
        for (int n = 0; n < 10; n++) {
            const fvi_linear q = any_problem();
            double estimated, asked;
            ratios(methods[i], &q, 10, 1e-6, 40, &estimated, &asked);
            seen(estimated, "error over its estimate");
            ck_assert_msg(estimated > 0.5 && estimated < 1.5,
                          "%s, alpha=%g: %g", methods[i]->name, q.alpha,
                          estimated);
        }
}
END_TEST

/* Two Duffing oscillators, one damped, with a force: a run in R^2. */
static const double mass[] = { 1, 2 }, damping[] = { 0.5, 0 }, cg[] = { 1, 1 },
                    start[] = { 1, -0.5 }, momentum[] = { 0, 1 },
                    drive[] = { 0.5, 1 };

static fvi_system pair(void)
{
    return (fvi_system){ 2, mass, damping, fvi_potential_chain(cg),
                         fvi_force_cosine(drive) };
}

static fvi_run pair_run(const fvi_system *system)
{
    return (fvi_run){ .system = system,
                      .x0 = start,
                      .p0 = momentum,
                      .h = 0.25,
                      .steps = 40,
                      .kappa = 0.5,
                      .alpha = 0.3,
                      .past = FVI_PAST_CAPUTO };
}

/* What is given out is that very run: parts divides each step exactly. */
START_TEST(the_rows_are_those_of_the_run_that_was_found)
{
    enum { MOST = 40 << 12 };
    static double x[82], p[82], all[2 * (MOST + 1)], all_p[2 * (MOST + 1)];
    const fvi_system system = pair();
    fvi_run run = pair_run(&system);
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_shifted, &run, 1e-5, MOST, x, p, &found),
        GSL_SUCCESS);
    ck_assert(found.parts >= 4 && found.parts <= 1 << 12);
    ck_assert(found.estimate <= 1e-5 && found.order <= 2);
    run.h /= (double)found.parts;
    run.steps *= found.parts;
    ck_assert_int_eq(fvi_trajectory(&fvi_shifted, &run, all, all_p, NULL),
                     GSL_SUCCESS);
    for (size_t k = 0; k <= 40; k++)
        for (size_t i = 0; i < 2; i++) {
            ck_assert_ulp(x[2 * k + i], all[2 * k * found.parts + i], 0,
                          "x, k=%zu", k);
            ck_assert_ulp(p[2 * k + i], all_p[2 * k * found.parts + i], 0,
                          "p, k=%zu", k);
        }
}
END_TEST

/* Nothing is solved here, but order 6 at 1e-11 knows better than order 2. Each
 * keeps to what was asked, so they differ by no more than both together. */
START_TEST(two_methods_agree_to_what_was_asked_of_them)
{
    double x[82], y[82];
    const fvi_system system = pair();
    const fvi_run run = pair_run(&system);
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_shifted, &run, 1e-6, 1 << 24, x, NULL, &found),
        GSL_SUCCESS);
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto4, &run, 1e-11, 1 << 24, y, NULL, &found),
        GSL_SUCCESS);
    ck_assert(found.order == 4); /* 5.4 is seen, and not believed */
    for (size_t i = 0; i < 82; i++)
        ck_assert_near(x[i], y[i], 1e-6 + 1e-11, "row %zu", i / 2);
}
END_TEST

/* h w = 100 / 3 and kappa = 1: the first runs overflow; that is no failure. */
START_TEST(steps_that_are_too_long_are_passed_over)
{
    const double one = 1, rho = 0.5, c = 1e4, x0 = 1, p0 = 0;
    const fvi_system system = {
        1, &one, &rho, fvi_potential_harmonic(&c), { 0 }
    };
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = 0.1,
                          .steps = 200,
                          .kappa = 1,
                          .alpha = 0.5 };
    double x[201];
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 1e-2, 1 << 24, x, NULL, &found),
        GSL_SUCCESS);
    ck_assert(found.parts > 32);
}
END_TEST

/* One row far away is compared at 128 times: a hit by chance is no proof. */
START_TEST(few_rows_are_not_all_that_is_compared)
{
    const double one = 1, rho = 0, c = 1, x0 = 1, p0 = 0;
    const fvi_system system = {
        1, &one, &rho, fvi_potential_harmonic(&c), { 0 }
    };
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = 2 * M_PI,
                          .steps = 1,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    double x[2];
    fvi_step_found found;
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto2, &run, 1e-3, 1 << 20, x, NULL, &found),
        GSL_SUCCESS);
    /* after a whole period the error of x is that of a phase, squared */
    ck_assert(fabs(x[1] - 1) < 1e-6 && found.estimate > 1e-5);
}
END_TEST

/* ---- errors ---- */

static size_t forces;

static void count(double t, size_t d, const void *params, double *F)
{
    fvi_force_cosine(params).value(t, d, params, F);
    forces++;
}

static int reported;

static void report(const char *reason, const char *file, int line, int code)
{
    (void)reason, (void)file, (void)line;
    reported = code;
}

START_TEST(an_error_out_of_reach_is_reported_with_the_best)
{
    double x[82] = { -77 };
    fvi_system system = pair();
    system.force.value = count;
    const fvi_run run = pair_run(&system);
    fvi_step_found found = { 0 };
    /* rounding: the run before the estimates grow is near 1e-13 */
    ck_assert_int_eq(
        fvi_step_search(&fvi_lobatto4, &run, 1e-16, 1 << 24, x, NULL, &found),
        GSL_ETOL);
    ck_assert(found.estimate > 1e-13 && found.estimate < 1e-11);
    ck_assert(found.parts < 1 << 10);
    /* three runs more; four values a step, all runs twice the last of them */
    ck_assert(forces > 0 && forces < 4 * 2 * 8 * 40 * found.parts);
    /* steps: 160, 320 and 640 are allowed, 1280 are not */
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 1e-9, 1279, x, NULL, &found),
        GSL_ETOL);
    ck_assert_uint_eq(found.parts, 16);
    ck_assert(found.estimate > 1e-4 && found.estimate < 1);
    gsl_set_error_handler(report);
    /* two runs are not enough for an order */
    ck_assert_int_eq(
        fvi_step_search(&fvi_fractional, &run, 1e9, 639, x, NULL, &found),
        GSL_ETOL);
    gsl_set_error_handler_off();
    ck_assert_int_eq(reported, GSL_ETOL);
    ck_assert(gsl_isinf(found.estimate));
    ck_assert(x[0] == -77);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    double x[82] = { -77 }, p[82] = { -77 };
    const fvi_system system = pair();
    const fvi_run good = pair_run(&system);
    fvi_step_found found = { .parts = 77 };
    const fvi_method *m = &fvi_shifted;
#define REFUSED(call, code) ck_assert_int_eq(call, code)
    REFUSED(fvi_step_search(NULL, &good, 1, 1000, x, p, &found), GSL_EFAULT);
    REFUSED(fvi_step_search(m, NULL, 1, 1000, x, p, &found), GSL_EFAULT);
    REFUSED(fvi_step_search(m, &good, 1, 1000, NULL, p, &found), GSL_EFAULT);
    REFUSED(fvi_step_search(m, &good, 1, 1000, x, p, NULL), GSL_EFAULT);
    const double errors[] = { 0, -1, GSL_NAN, GSL_POSINF };
    for (size_t i = 0; i < LEN(errors); i++)
        REFUSED(fvi_step_search(m, &good, errors[i], 1000, x, p, &found),
                GSL_EDOM);
    fvi_run bad = good;
    bad.steps = 0;
    REFUSED(fvi_step_search(m, &bad, 1, 1000, x, p, &found), GSL_EINVAL);
    bad.steps = SIZE_MAX / 16;
    REFUSED(fvi_step_search(m, &bad, 1, 1000, x, p, &found), GSL_EINVAL);
    bad.steps = (size_t)1 << 50; /* can be addressed, but not had */
    REFUSED(fvi_step_search(m, &bad, 1, SIZE_MAX, x, p, &found), GSL_ENOMEM);
    bad = good;
    bad.h = -1;
    REFUSED(fvi_step_search(m, &bad, 1, 1000, x, p, &found), GSL_EDOM);
    bad = good;
    bad.memory = FVI_MEMORY_FFT;
    REFUSED(fvi_step_search(&fvi_lobatto3, &bad, 1, 1000, x, p, &found),
            GSL_EUNSUP);
    ck_assert(x[0] == -77 && p[0] == -77 && found.parts == 77);
}
END_TEST

int main(void)
{
    gsl_set_error_handler_off(); /* the default handler aborts */
    Suite *suite = suite_create("the search for a step");
    ADD_CASE(suite, "values",
             eq_18_2_the_error_asked_for_is_the_error_that_comes,
             eq_18_2_a_kick_at_the_start_is_not_overlooked,
             eq_18_2_the_estimate_is_near_the_error,
             two_methods_agree_to_what_was_asked_of_them);
    ADD_CASE(suite, "identities", the_rows_are_those_of_the_run_that_was_found,
             steps_that_are_too_long_are_passed_over,
             few_rows_are_not_all_that_is_compared);
    ADD_CASE(suite, "errors", an_error_out_of_reach_is_reported_with_the_best,
             bad_arguments_are_refused);
    return run_suite(suite);
}
