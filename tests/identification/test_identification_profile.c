/* tests/identification/test_identification_profile.c -- H 24: profiles.
 *                                        Run alone: make test-identification_profile */
#include "identification_runs.h"
#include "run/whole_run.h"
#include "system/larger.h"

/* 24 times up to 12, alpha and rho of a linear spring, noise of `sigma`. */
static void ask_few(question *q, double sigma, gsl_rng *r)
{
    ask(q, ref_low, 2);
    for (size_t i = 0; i < 24; i++) {
        q->t[i] = q->t[5 * i + 4];
        q->x[i] = q->x[5 * i + 4];
    }
    q->fit.n = 24;
    q->constants[0] = 1;
    add_noise(q, sigma, r);
}

/* chi^2 of the question at alpha and rho, by a run of its own. */
static double chi2_at(const question *q, double h, double alpha, double rho)
{
    static double x[4097];
    const size_t steps = (size_t)(q->t[q->fit.n - 1] / h + 0.5);
    ck_assert_uint_le(steps, LEN(x) - 1);
    fvi_system system = q->system;
    system.damping = &rho;
    fvi_run run = fvi_run_default(&system, &q->x0, &q->p0, h, steps);
    run.alpha = alpha;
    ck_assert_int_eq(fvi_trajectory(&fvi_lobatto_m4, &run, x, NULL, NULL),
                     FVI_SUCCESS);
    double sum = 0;
    for (size_t i = 0; i < q->fit.n; i++) {
        const size_t k = (size_t)(q->t[i] / h + 0.5);
        ck_assert_near((double)k * h, q->t[i], 1e-9, "a time of the data");
        sum += (x[k] - q->x[i]) * (x[k] - q->x[i]);
    }
    return sum / (q->fit.sigma * q->fit.sigma);
}

/* The least chi^2 over ln rho, by the golden section: one valley is asked for. */
static double least_over_rho(const question *q, double h, double alpha)
{
    const double share = (3 - sqrt(5)) / 2;
    double a = log(1e-3), b = log(20), u = a + share * (b - a),
           v = b - share * (b - a);
    double at_u = chi2_at(q, h, alpha, exp(u)),
           at_v = chi2_at(q, h, alpha, exp(v));
    while (b - a > 1e-6)
        if (at_u < at_v) {
            b = v;
            v = u;
            at_v = at_u;
            u = a + share * (b - a);
            at_u = chi2_at(q, h, alpha, exp(u));
        } else {
            a = u;
            u = v;
            at_u = at_v;
            v = b - share * (b - a);
            at_v = chi2_at(q, h, alpha, exp(v));
        }
    return smaller(at_u, at_v);
}

/* 24 points with much noise. A scan of alpha, dense and over all of (0, 1), the best rho
 * of each from another search on other runs: chi^2 is beyond the least by 1.96^2 outside
 * of the interval and not inside, and at its ends to 2e-4 of that, of which the profile
 * has promised 2e-4 of a root's square. */
START_TEST(eq_24_11_a_profile_is_what_a_dense_scan_finds)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    double skew = 0;
    for (size_t set = 0; set < 3; set++) {
        question q;
        fvi_estimate f;
        double low, high;
        ask_few(&q, 0.2, r);
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
        ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, 0, &low, &high),
                         FVI_SUCCESS);
        ck_assert_double_lt(low, f.estimate[0]);
        ck_assert_double_gt(high, f.estimate[0]);
        const double reach = f.quantile * f.quantile, ends[] = { low, high };
        for (size_t i = 0; i < 2; i++) {
            const double more = least_over_rho(&q, f.h, ends[i]) - f.chi2;
            seen(fabs(more / reach - 1), "off at an end");
            ck_assert_near(more, reach, 3e-4 * reach, "at an end");
        }
        for (double alpha = 0.01; alpha < 0.995; alpha += 0.02) {
            const double more = least_over_rho(&q, f.h, alpha) - f.chi2;
            ck_assert_msg((more < reach) == (alpha > low && alpha < high),
                          "chi2 grows by %g at alpha = %g, [%g, %g]", more,
                          alpha, low, high);
        }
        skew = larger(skew, fabs((low + high) / 2 - f.estimate[0])
                                / (high - low) * 2);
    }
    seen(skew, "middle off the estimate, in half the length");
    ck_assert_double_gt(skew, 0.02); /* no parabola */
    gsl_rng_free(r);
}
END_TEST

/* Little noise: chi^2 is a parabola, and the interval that of (24.3) to the third
 * derivatives, which weigh as much as sigma. Five parameters, correlations of 0.98, with
 * sigma as given and estimated, when the quantile is Student's. */
START_TEST(eq_24_11_without_bends_a_profile_is_the_standard_deviation)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t set = 0; set < 4; set++) {
        question q;
        fvi_estimate f;
        const size_t P = set % 2 ? 5 : 3;
        ask(&q, ref_high, P);
        q.constants[0] = 1.2;
        add_noise(&q, 1e-5, r);
        q.fit.sigma = set / 2 ? 0 : 1e-5;
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
        for (size_t j = 0; j < P; j++) {
            double low, high;
            const double reach = f.quantile * f.sd[j];
            ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, j, &low, &high),
                             FVI_SUCCESS);
            seen(fabs((high - f.estimate[j]) / reach - 1), "off the sd");
            ck_assert_near(f.estimate[j] - low, reach, 2e-3 * reach, "low");
            ck_assert_near(high - f.estimate[j], reach, 2e-3 * reach, "high");
            ck_assert_double_eq(q.constants[0], 1.2); /* as it was */
        }
    }
    gsl_rng_free(r);
}
END_TEST

/* Hardly any damping, much noise: no alpha is excluded, and rho may be zero. One
 * parameter alone has no others. */
START_TEST(eq_24_11_what_has_no_end_has_that_of_the_parameter)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    question q;
    fvi_estimate f;
    double low = 0.5, high = 0.5;
    ask(&q, NULL, 2);
    q.constants[0] = 1;
    for (size_t i = 0; i < REF_POINTS; i++)
        q.x[i] = cos(q.t[i]) + 0.25 * sin(q.t[i]);
    q.fit.n = 40;
    add_noise(&q, 0.1, r);
    f = (fvi_estimate){ .estimate = { 0.5, 0.01 }, .sd = { 0.2, 0.01 } };
    f.h = 0.1;
    f.quantile = 1.96;
    f.sigma = q.fit.sigma;
    f.chi2 = chi2_at(&q, 0.1, 0.5, 0.01);
    ck_assert_int_ne(fvi_estimate_profile(&q.fit, &f, 0, &low, &high), FVI_EDOM);
    ck_assert_double_eq(low, 0);
    ck_assert_double_eq(high, 1);
    static const fvi_free_parameter rho = FVI_FREE_PARAMETER_RHO;
    ask_few(&q, 0.02, r);
    q.fit.which = &rho;
    q.fit.parameters = 1;
    q.run.alpha = 0.3;
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
    ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, 0, &low, &high), FVI_SUCCESS);
    const double reach = f.quantile * f.quantile;
    ck_assert_near(chi2_at(&q, f.h, 0.3, low) - f.chi2, reach, 3e-4 * reach,
                   "low");
    ck_assert_near(chi2_at(&q, f.h, 0.3, high) - f.chi2, reach, 3e-4 * reach,
                   "high");
    gsl_rng_free(r);
}
END_TEST

/* chi^2 of (1 + rho) x'' + c x = 0 from x0 and p0, w^2 = c / (1 + rho). */
static double chi2_of_swing(const question *q, double sigma, double w,
                            double rho)
{
    double sum = 0;
    for (size_t i = 0; i < q->fit.n; i++) {
        const double x = q->x0 * cos(w * q->t[i])
                         + q->p0 / ((1 + rho) * w) * sin(w * q->t[i]);
        sum += (x - q->x[i]) * (x - q->x[i]);
    }
    return sum / (sigma * sigma);
}

/* The least over w near that of the fit, rho or c being fixed, by thirds. */
static double least_over_swings(const question *q, const fvi_estimate *f,
                                double rho, double c)
{
    double a = 0.97 * sqrt(f->estimate[1] / (1 + f->estimate[0])),
           b = a * 1.03 / 0.97, least = INFINITY;
    while (b - a > 1e-8) {
        const double w[] = { (2 * a + b) / 3, (a + 2 * b) / 3 };
        double at[2];
        for (size_t i = 0; i < 2; i++)
            at[i] = chi2_of_swing(q, f->sigma, w[i],
                                  c > 0 ? c / (w[i] * w[i]) - 1 : rho);
        least = smaller(at[0], at[1]);
        *(at[0] < at[1] ? &b : &a) = w[at[0] < at[1]];
    }
    return least;
}

/* At alpha = 1, where rho is a mass, data of a damped swing tell of rho and c little but
 * their ratio. The valley is narrow and long, with others beside it, and has no end: as rho
 * grows the velocity p0/(1 + rho) goes to 0, and chi^2 grows by 1.2 at most. Its lower ends
 * are those of the motion in closed form. */
START_TEST(eq_24_11_a_profile_stays_in_its_valley)
{
    question q;
    fvi_estimate f;
    double low[2], high[2];
    ask(&q, ref_low, 2);
    q.fit.which = FIVE + 1;
    q.run.alpha = 1;
    q.constants[0] = 1.2;
    q.fit.starts = 20;
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
    for (size_t j = 0; j < 2; j++)
        ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, j, low + j, high + j),
                         FVI_SUCCESS);
    const double reach = f.quantile * f.quantile;
    ck_assert_double_lt(least_over_swings(&q, &f, 1e6, 0) - f.chi2, reach / 2);
    ck_assert(isinf(high[0]) && isinf(high[1]));
    ck_assert_near(least_over_swings(&q, &f, low[0], 0) - f.chi2, reach,
                   3e-4 * reach, "the least rho");
    ck_assert_near(least_over_swings(&q, &f, 0, low[1]) - f.chi2, reach,
                   3e-4 * reach, "the least c");
}
END_TEST

START_TEST(a_profile_refuses_what_is_no_answer)
{
    question q;
    fvi_estimate f = { .sd = { 1 }, .h = 0.1, .sigma = 1 };
    double low, high;
    ask(&q, ref_low, 2);
    ck_assert_int_eq(fvi_estimate_profile(NULL, &f, 0, &low, &high), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_profile(&q.fit, NULL, 0, &low, &high), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, 0, NULL, &high), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, 0, &low, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, 2, &low, &high), FVI_EINVAL);
    ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, 1, &low, &high), FVI_EDOM);
    f.h = 0;
    ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, 0, &low, &high), FVI_EDOM);
    /* a place that is no minimum: a lower chi^2 is met at once, and said */
    f = (fvi_estimate){ .estimate = { 0.5, 0.5 },
                      .sd = { 0.01, 0.01 },
                      .h = 0.1,
                      .quantile = 1.96 };
    q.constants[0] = 1;
    q.fit.sigma = f.sigma = 0.02;
    f.chi2 = chi2_at(&q, 0.1, 0.5, 0.5);
    ck_assert_int_eq(fvi_estimate_profile(&q.fit, &f, 0, &low, &high), FVI_EMAXITER);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("profiles");
    ADD_CASE(suite, "profiles", eq_24_11_a_profile_is_what_a_dense_scan_finds,
             eq_24_11_without_bends_a_profile_is_the_standard_deviation,
             eq_24_11_what_has_no_end_has_that_of_the_parameter,
             eq_24_11_a_profile_stays_in_its_valley,
             a_profile_refuses_what_is_no_answer);
    return run_suite(suite);
}
