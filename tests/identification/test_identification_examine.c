/* tests/identification/test_identification_examine.c -- H 24: is an answer reliable? The examination of a fit.
 * Run alone: make test-identification_examine */
#include "identification_runs.h"
#include "system/larger.h"

#include <gsl/gsl_cdf.h>

/* Every `skip`-th point of a motion, with noise, and the spring known if P is 2. */
static void ask_noisy(question *q, const double *x, size_t skip, size_t P, double sigma,
                      gsl_rng *r)
{
    ask(q, x, P);
    q->fit.n = REF_POINTS / skip;
    for (size_t i = 0; i < q->fit.n; i++) {
        q->t[i] = q->t[skip * i + skip - 1];
        q->x[i] = q->x[skip * i + skip - 1];
    }
    q->constants[0] = P == 2 ? 1 : 1.5;
    q->fit.starts = 6;
    add_noise(q, sigma, r);
}

static int believe(question *q, fvi_estimate *f, fvi_examination *e)
{
    const int status = fvi_estimate_multistart(&q->fit, NULL, f);
    if (status)
        return status;
    ck_assert_int_eq(fvi_estimate_examine(&q->fit, f, e), FVI_SUCCESS);
    return 0;
}

/* With a model that is right the probabilities are uniform: the mean of 24 is 1/2 with a standard
 * deviation of 1/sqrt(12 * 24) = 0.059, and four of these are allowed. 40 points, so that the
 * three parameters take a good part of the residuals: a correlation whose mean were taken for 0
 * would be off by P/n = 0.08, half of its standard deviation, and its mean probability by 0.2. */
START_TEST(eq_24_13_probabilities_of_noise_are_uniform)
{
    enum { SETS = 24 };
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    double mean[4] = { 0 };
    for (size_t set = 0; set < SETS; set++) {
        question q;
        fvi_estimate f;
        fvi_examination e;
        ask_noisy(&q, set % 2 ? ref_high : ref_low, 5, 3, 0.02, r);
        q.fit.sigma = set % 4 < 2 ? 0.02 : 0;
        ck_assert_int_eq(believe(&q, &f, &e), 0);
        for (size_t i = 0; i < LEN(mean); i++)
            mean[i] += e.probability[i] / SETS;
        ck_assert_double_lt(e.probability[4], 1e-6); /* it moves */
    }
    for (size_t i = 0; i < LEN(mean); i++) {
        seen(fabs(mean[i] - 0.5), "mean probability off 1/2");
        ck_assert_near(mean[i], 0.5, 4 / sqrt(12. * SETS), "mean");
    }
    gsl_rng_free(r);
}
END_TEST

/* The first silent failure: 25 places, much noise, a bent valley. Of the intervals of answers
 * without a flag 95 % hold the truth; of 30 fewer than 80 % do so with a probability below 2e-3.
 * No interval leaves the possible. */
START_TEST(eq_24_11_silent_intervals_in_a_bent_valley_hold_the_truth)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    const double *truth = ref_errors[2].truth;
    int intervals = 0, held = 0;
    gsl_rng_set(r, 7);
    for (size_t set = 0; set < 10; set++) {
        question q;
        fvi_estimate f;
        fvi_examination e;
        ask_noisy(&q, ref_high, 8, 3, 0.3, r);
        if (believe(&q, &f, &e))
            continue;
        for (size_t j = 0; j < 3; j++) {
            ck_assert_double_ge(e.lower[j], j < 2 ? 0 : -INFINITY);
            ck_assert_double_le(e.upper[j], j < 1 ? 1 : INFINITY);
            ck_assert(e.lower[j] <= f.estimate[j] && f.estimate[j] <= e.upper[j]);
            intervals += e.flags == 0;
            held += e.flags == 0 && truth[j] >= e.lower[j] && truth[j] <= e.upper[j];
        }
    }
    seen(1 - (double)held / intervals, "share of silent intervals that miss");
    ck_assert_int_gt(intervals, 12);
    ck_assert_double_ge(held, 0.8 * intervals);
    gsl_rng_free(r);
}
END_TEST

/* The second: a sensor with an offset of half a sigma. With alpha and rho alone it is seen; with
 * c, too, nobody can see it, and the examination says how far it moves alpha: by (24.4) as far as
 * a fit of the same data with an offset of so many sigma. */
START_TEST(eq_24_14_an_offset_is_seen_or_said_to_be_unseen)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    int flagged = 0;
    for (size_t set = 0; set < 10; set++) {
        question q;
        fvi_estimate f;
        fvi_examination e;
        ask_noisy(&q, ref_low, 1, 2, 0.02, r);
        for (size_t i = 0; i < q.fit.n; i++)
            q.x[i] += 0.01;
        flagged += believe(&q, &f, &e) || (e.flags & FVI_FLAG_OFFSET);
    }
    ck_assert_int_ge(flagged, 9);
    question q;
    fvi_estimate f, moved;
    fvi_examination e;
    ask_noisy(&q, ref_low, 1, 3, 0.02, r);
    ck_assert_int_eq(believe(&q, &f, &e), 0);
    ck_assert_double_gt(fabs(e.swayed[0][0]), f.quantile);
    for (size_t i = 0; i < q.fit.n; i++)
        q.x[i] += 1e-3 * e.unseen[0] * 0.02;
    q.fit.h = f.h;
    ck_assert_int_eq(believe(&q, &moved, &e), 0);
    for (size_t j = 0; j < 3; j++) {
        const double by = (moved.estimate[j] - f.estimate[j]) / f.sd[j] / 1e-3;
        seen(fabs(by / e.swayed[0][j] - 1), "sway of an offset");
        /* to the second order in the noise, 0.02 of x, times the bend of the valley */
        ck_assert_near(by, e.swayed[0][j], 0.1 * fabs(e.swayed[0][j]), "sway");
    }
    gsl_rng_free(r);
}
END_TEST

/* The third: noise without a motion is no answer, whatever is fitted to it. */
START_TEST(eq_24_15_noise_is_no_motion)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t set = 0; set < 12; set++) {
        question q;
        fvi_estimate f;
        fvi_examination e;
        ask_noisy(&q, NULL, set % 2 ? 4 : 1, set % 3 ? 3 : 5, 0.1, r);
        q.fit.sigma = 0;
        const int refused = believe(&q, &f, &e);
        ck_assert_msg(refused || (e.grave & FVI_FLAG_NO_MOTION), "set %zu", set);
    }
    gsl_rng_free(r);
}
END_TEST

/* An echo of 0.9 of the noise before: no interval is silent. */
START_TEST(eq_24_13_noise_with_an_echo_is_seen)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t set = 0; set < 6; set++) {
        question q;
        fvi_estimate f;
        fvi_examination e;
        double echo = 0;
        ask_noisy(&q, ref_low, 1, 2, 1e-9, r);
        for (size_t i = 0; i < q.fit.n; i++) {
            echo = 0.9 * echo + gsl_ran_gaussian(r, 0.01);
            q.x[i] += echo;
        }
        q.fit.sigma = 0;
        ck_assert_int_eq(believe(&q, &f, &e), 0);
        ck_assert(e.grave & FVI_FLAG_NEIGHBOURS);
    }
    gsl_rng_free(r);
}
END_TEST

/* A drift, fitted and not. */
START_TEST(a_drift_is_seen_and_can_be_fitted)
{
    static const fvi_free_parameter with[] = { FVI_FREE_PARAMETER_ALPHA, FVI_FREE_PARAMETER_RHO,
                                               FVI_FREE_PARAMETER_OFFSET,
                                               FVI_FREE_PARAMETER_DRIFT };
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    question q;
    fvi_estimate f;
    fvi_examination e;
    ask_noisy(&q, ref_low, 1, 2, 0.01, r);
    for (size_t i = 0; i < q.fit.n; i++)
        q.x[i] += 0.02 - 0.003 * q.t[i];
    q.fit.sigma = 0;
    ck_assert_int_eq(believe(&q, &f, &e), 0);
    ck_assert(e.flags & FVI_FLAG_DRIFT);
    q.fit.which = with;
    q.fit.parameters = 4;
    ck_assert_int_eq(believe(&q, &f, &e), 0);
    ck_assert_uint_eq(e.flags, 0);
    ck_assert(e.unseen[0] == 0 && e.unseen[1] == 0);
    const double truth[] = { 0.3, 0.4, 0.02, -0.003 };
    for (size_t j = 0; j < 4; j++)
        ck_assert_near(f.estimate[j], truth[j], 4 * f.sd[j], "with a drift");
    gsl_rng_free(r);
}
END_TEST

/* Before the experiment: (24.3) of another program at the truth, with all five parameters. The sd
 * come from a run whose error is below 1e-8 of x; what is twice as noisy has twice the sd. */
START_TEST(eq_24_3_a_plan_foresees_the_standard_deviations)
{
    for (size_t motion = 0; motion < 2; motion++) {
        const double *truth = ref_errors[2 * motion].truth;
        question q;
        fvi_estimate plan, loud;
        fvi_examination e;
        ask(&q, NULL, 3);
        q.run.alpha = truth[0];
        q.rho = truth[1];
        q.constants[0] = truth[2];
        q.fit.sigma = 0.02;
        ck_assert_int_eq(fvi_estimate_design(&q.fit, &plan, &e), FVI_SUCCESS);
        for (size_t j = 0; j < 3; j++) {
            const double sd = 0.02 * ref_errors[2 * motion].sd[j];
            seen(fabs(plan.sd[j] / sd - 1), "sd of a plan");
            ck_assert_near(plan.sd[j], sd, 1e-5 * sd, "sd");
            ck_assert(plan.estimate[j] == truth[j]);
            ck_assert(e.lower[j] < truth[j] && truth[j] < e.upper[j]);
        }
        ck_assert_uint_eq(e.flags, 0);
        q.fit.sigma = 0.04;
        ck_assert_int_eq(fvi_estimate_design(&q.fit, &loud, &e), FVI_SUCCESS);
        for (size_t j = 0; j < 3; j++)
            ck_assert_near(loud.sd[j], 2 * plan.sd[j], 1e-9 * plan.sd[j], "twice the noise");
        q.fit.sigma = 0;
        ck_assert_int_eq(fvi_estimate_design(&q.fit, &plan, &e), FVI_EDOM);
        q.fit.sigma = 0.02;
        q.x0 = q.p0 = 0;
        ck_assert_int_eq(fvi_estimate_design(&q.fit, &plan, &e), FVI_ESING);
    }
}
END_TEST

/* The derivatives of a run with a law are differences, for which a plan writes to the caller's constants. */
START_TEST(a_plan_gives_the_constants_back)
{
    const fvi_kernel_term zener = { FVI_KERNEL_ZENER, 1, 0.3, 0.5, 0 };
    const fvi_kernel law = { 1, &zener };
    const fvi_free_parameter which[] = { FVI_FREE_PARAMETER_RHO, FVI_FREE_PARAMETER_CONSTANT };
    question q;
    fvi_estimate plan;
    fvi_examination e;
    ask(&q, NULL, 2);
    q.run.law = &law;
    q.fit.which = which;
    q.fit.sigma = 0.02;
    ck_assert_int_eq(fvi_estimate_design(&q.fit, &plan, &e), FVI_SUCCESS);
    ck_assert(plan.sd[1] > 0);
    ck_assert(q.constants[0] == 2.5);
}
END_TEST

START_TEST(an_examination_refuses_what_is_no_answer)
{
    question q;
    fvi_estimate f = { .sd = { 1, 1 }, .h = 0.1, .sigma = 1 };
    fvi_examination e;
    ask(&q, ref_low, 2);
    ck_assert_int_eq(fvi_estimate_examine(NULL, &f, &e), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_examine(&q.fit, NULL, &e), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_examine(&q.fit, &f, NULL), FVI_EFAULT);
    f.h = 0;
    ck_assert_int_eq(fvi_estimate_examine(&q.fit, &f, &e), FVI_EDOM);
    f.h = 0.1;
    f.sigma = 0;
    ck_assert_int_eq(fvi_estimate_examine(&q.fit, &f, &e), FVI_EDOM);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("24 identification, examination");
    ADD_CASE(suite, "flags", eq_24_13_probabilities_of_noise_are_uniform,
             eq_24_11_silent_intervals_in_a_bent_valley_hold_the_truth,
             eq_24_14_an_offset_is_seen_or_said_to_be_unseen, eq_24_15_noise_is_no_motion,
             eq_24_13_noise_with_an_echo_is_seen, a_drift_is_seen_and_can_be_fitted,
             eq_24_3_a_plan_foresees_the_standard_deviations, a_plan_gives_the_constants_back,
             an_examination_refuses_what_is_no_answer);
    return run_suite(suite);
}
