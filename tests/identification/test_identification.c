/* tests/identification/test_identification.c -- H 24: are the parameters found, and are the stated errors true?
 * Run alone: make test-identification */
#include "identification_runs.h"
#include "run/whole_run.h"

static const double *data_of(size_t i)
{
    return strcmp(ref_errors[i].name, "low") == 0 ? ref_low : ref_high;
}

/* |x(t_i) - x_i| of the run with the true parameters, as a vector's length. */
static double length_of_error(const question *q, const double *truth, double h)
{
    question r = *q;
    double sum = 0;
    const size_t parts = (size_t)round(0.1 / h);
    double *x = malloc((REF_POINTS * parts + 1) * sizeof *x);
    r.system.damping = &truth[1];
    r.constants[0] = truth[2];
    r.system.potential = fvi_potential_duffing(r.constants);
    r.run.system = &r.system;
    r.run.x0 = &truth[3];
    r.run.p0 = &truth[4];
    r.run.alpha = truth[0];
    r.run.h = 0.1 / (double)parts;
    r.run.steps = REF_POINTS * parts;
    ck_assert_int_eq(fvi_trajectory(q->fit.method, &r.run, x, NULL, NULL), 0);
    for (size_t i = 0; i < REF_POINTS; i++)
        sum += gsl_pow_2(x[(i + 1) * parts] - q->x[i]);
    free(x);
    return sqrt(sum);
}

//> exact
/* Data without noise: what is wrong then is the method, by e in the data. To first order
 * the estimates are wrong by J^+ e, and |(J^+ e)_j| <= sqrt(C_jj) |e|, C = (J^T J)^-1:
 * sd of sigma = 1 times the length of e. The search ends 1e-9 of u away at most; the
 * slopes of u are below 1. */
START_TEST(eq_24_2_exact_data_give_the_parameters_back)
{
    for (size_t i = 0; i < LEN(ref_errors); i++) {
        const size_t P = (size_t)ref_errors[i].P;
        const double *truth = ref_errors[i].truth;
        question q;
        fvi_estimate f;
        ask(&q, data_of(i), P);
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
        const double e = length_of_error(&q, truth, f.h);
        for (size_t j = 0; j < P; j++) {
            const double error = fabs(f.estimate[j] - truth[j]);
            seen(error, "error of a parameter");
            ck_assert_msg(error <= 1.1 * ref_errors[i].sd[j] * e + 1e-9,
                          "%s %zu: %g, e %g", ref_errors[i].name, j, error, e);
        }
    }
}
END_TEST
//< exact

/* Fit the motion that fvi-stable has with the true parameters, with the same steps. */
static void ask_fvi_stable(question *q, const double *truth)
{
    double x[REF_POINTS + 1];
    q->fit.method = &fvi_cq2_midpoint;
    q->fit.h = 0.1;
    q->run.alpha = truth[0];
    q->rho = truth[1];
    q->constants[0] = truth[2];
    q->x0 = truth[3];
    q->p0 = truth[4];
    q->run.h = q->fit.h;
    q->run.steps = REF_POINTS;
    ck_assert_int_eq(fvi_trajectory(q->fit.method, &q->run, x, NULL, NULL), 0);
    memcpy(q->x, x + 1, sizeof q->x);
}

/* The same of a body with alpha = 1/2, rho = 1, p0 = 0, of which the logit, the logarithm
 * and the start are 0: a difference quotient in proportion to them has no step left. The
 * memory is local there, and the error of fvi-lobatto4, h = 1/20, below 1e-11; what is left
 * is the 1e-9 of u at which a search ends, as above. All starts but a few agree, on a p0
 * of 0, too. The last of them is by fvi-stable, whose slopes are difference quotients; its data
 * are its own motion. */
START_TEST(eq_24_2_exact_data_of_half_a_derivative_give_it_back)
{
    const fvi_linear_oscillator exact = {
        .m = 1, .c = 1, .rho = 1, .alpha = 0.5, .x0 = 1
    };
    const double truth[] = { 0.5, 1, 1, 1, 0 };
    for (size_t n = 2; n <= LEN(FIVE) + 1; n++) {
        const size_t P = n <= LEN(FIVE) ? n : LEN(FIVE);
        question q;
        fvi_estimate f;
        ask(&q, NULL, P);
        ck_assert_int_eq(fvi_exact_at(&exact, REF_POINTS, q.t, q.x, NULL,
                                      NULL), 0);
        if (n > P)
            ask_fvi_stable(&q, truth);
        q.constants[0] = P < 3 ? 1 : 2.5;
        q.p0 = P < 5 ? 0 : 0.25;
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
        ck_assert_uint_ge(f.agree, 3);
        for (size_t j = 0; j < P; j++) {
            const double error = fabs(f.estimate[j] - truth[j]);
            seen_worst(error, "error of a parameter");
            ck_assert_msg(error <= 1e-9, "%zu %zu: %g", P, j, error);
        }
    }
}
END_TEST

/* Of a run with a law rho is what multiplies it. Data and fit are of one method and one
 * step: what is left is where the search ends, 1e-9 of u, and rho is 1.5 times its slope.
 * Seen: 2e-16. */
START_TEST(eq_26_1_a_fit_with_a_law_finds_what_multiplies_it)
{
    const fvi_kernel_term zener = {
        .kind = FVI_KERNEL_ZENER, .rho = 0.4, .alpha = 0.3, .time = 0.5
    };
    const fvi_kernel law = { 1, &zener };
    const fvi_free_parameter which[] = { FVI_FREE_PARAMETER_RHO, FVI_FREE_PARAMETER_CONSTANT };
    double x[REF_POINTS + 1];
    question q;
    fvi_estimate f;
    ask(&q, NULL, 2);
    q.rho = 1.5;
    q.constants[0] = 1.25;
    q.run.law = &law;
    q.run.h = 0.1;
    q.run.steps = REF_POINTS;
    ck_assert_int_eq(fvi_trajectory(&fvi_cq_bdf2, &q.run, x, NULL, NULL), 0);
    memcpy(q.x, x + 1, sizeof q.x);
    q.rho = 0.5;
    q.constants[0] = 2;
    q.fit.method = &fvi_cq_bdf2;
    q.fit.which = which;
    q.fit.h = 0.1;
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
    seen_worst(fabs(f.estimate[0] - 1.5), "error of rho or c");
    seen_worst(fabs(f.estimate[1] - 1.25), "error of rho or c");
    ck_assert_near(f.estimate[0], 1.5, 2e-9, "rho");
    ck_assert_near(f.estimate[1], 1.25, 2e-9, "c");
}
END_TEST

//> method
/* The same bound, with a step that is not halved: how wrong are the parameters that a
 * method of each order gives? First order in e: 1.2 for the second. */
START_TEST(eq_24_4_the_error_of_a_method_is_one_of_the_parameters)
{
    const struct {
        const fvi_method *method;
        double h;
    } runs[] = { { &fvi_fractional, 0.1 },
                 { &fvi_fractional, 0.01 },
                 { &fvi_cq2_shifted, 0.1 },
                 { &fvi_lobatto_m3, 0.1 },
                 { &fvi_lobatto_m4, 0.1 } };
    for (size_t i = 0; i < LEN(runs); i++) {
        question q;
        fvi_estimate f;
        ask(&q, ref_low, 3);
        q.fit.method = runs[i].method;
        q.fit.h = runs[i].h;
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
        const double e = length_of_error(&q, ref_errors[0].truth, f.h);
        for (size_t j = 0; j < 3; j++) {
            const double error = f.estimate[j] - ref_errors[0].truth[j];
            seen(error, "error of %s, %s, h = %g",
                 j == 0   ? "alpha"
                 : j == 1 ? "rho"
                          : "c",
                 runs[i].method->name, runs[i].h);
            ck_assert_msg(fabs(error) <= 1.2 * ref_errors[0].sd[j] * e + 1e-9,
                          "%zu %zu: %g, e %g", i, j, error, e);
        }
    }
}
END_TEST
//< method

//> covariance
/* The Jacobian is a difference quotient with the step 1e-7 |u|, or more where u is almost 0:
 * its relative error is half of that times x'' / x' by u, some tens at most, and 1e-13 /
 * 1e-7 for the memory's tolerance. Seen: 1.6e-6. */
START_TEST(eq_24_3_standard_deviations_and_correlations)
{
    for (size_t i = 0; i < LEN(ref_errors); i++) {
        const size_t P = (size_t)ref_errors[i].P;
        question q;
        fvi_estimate f;
        ask(&q, data_of(i), P);
        q.fit.sigma = 1e-3;
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_ETOL);
        for (size_t j = 0, k = 0; j < P; j++) {
            const double wrong = f.sd[j] / (1e-3 * ref_errors[i].sd[j]) - 1;
            seen(fabs(wrong), "relative error of sd");
            ck_assert_msg(fabs(wrong) < 1e-5, "%zu, sd %zu: %g", i, j, wrong);
            for (size_t l = 0; l < j; l++, k++) {
                const double by = f.correlation[j][l] - ref_errors[i].corr[k];
                seen(fabs(by), "error of a correlation");
                ck_assert_msg(fabs(by) < 1e-5, "%zu, %zu %zu: %g", i, j, l, by);
            }
        }
    }
}
END_TEST
//< covariance

/* a + b t is a straight line through readings with a known sigma, so that the covariance of a and b
 * is sigma^2 times the inverse of [n, sum t; sum t, sum t^2], whatever the motion is. Sums of 200
 * terms round by at most 200 * 2^-53 = 2e-14 each, and the determinant loses a factor of 4. Seen: 2.2e-16. */
START_TEST(eq_24_3_an_offset_and_a_drift_are_a_straight_line)
{
    static const fvi_free_parameter line[] = { FVI_FREE_PARAMETER_OFFSET,
                                               FVI_FREE_PARAMETER_DRIFT };
    const double n = REF_POINTS, sigma = 0.02;
    double t = 0, tt = 0;
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    question q;
    fvi_estimate f;
    ask(&q, ref_low, 2);
    q.run.alpha = 0.3;
    q.rho = 0.4;
    q.constants[0] = 1;
    q.fit.which = line;
    add_noise(&q, sigma, r);
    for (size_t i = 0; i < REF_POINTS; i++) {
        t += q.t[i];
        tt += q.t[i] * q.t[i];
    }
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
    const double det = n * tt - t * t;
    const double want[] = { sigma * sqrt(tt / det), sigma * sqrt(n / det) };
    for (size_t j = 0; j < 2; j++) {
        seen(fabs(f.sd[j] / want[j] - 1), "relative error of sd of a line");
        ck_assert_double_eq_tol(f.sd[j] / want[j], 1, 1e-12);
    }
    gsl_rng_free(r);
}
END_TEST

//> recovers
/* All of three Gaussian estimates are within 3 sd with a probability of at least
 * 1 - 3 * 0.0027 = 0.9919, whatever their correlations. Of 20 data sets more than 2 miss
 * then with a probability below binom(20,3) 0.0081^3 = 6.1e-4. */
START_TEST(eq_24_2_noisy_data_of_another_program_within_three_sd)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    int missed = 0;
    for (size_t set = 0; set < 20; set++) {
        question q;
        fvi_estimate f;
        ask(&q, set % 2 ? ref_high : ref_low, 3);
        add_noise(&q, 0.02, r);
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
        missed += off(&f, ref_errors[set % 2 ? 2 : 0].truth, 3) > 3;
        seen(f.chi2, "chi2 of 197");
    }
    ck_assert_msg(missed <= 2, "%d of 20 are wrong", missed);
    gsl_rng_free(r);
}
END_TEST
//< recovers

/* sigma = 0: it is estimated, to within 197^(-1/2) sqrt(1/2) = 5 % (one sd); the intervals
 * are Student's. */
START_TEST(eq_24_3_sigma_is_estimated)
{
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    question q;
    fvi_estimate known, f;
    ask(&q, ref_low, 3);
    add_noise(&q, 0.02, r);
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &known), FVI_SUCCESS);
    q.fit.sigma = 0;
    ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_SUCCESS);
    ck_assert_double_eq_tol(f.sigma, 0.02, 4 * 0.05 * 0.02);
    ck_assert_double_eq_tol(f.sigma, 0.02 * sqrt(known.chi2 / 197), 1e-8);
    ck_assert_double_eq_tol(f.sd[0] / known.sd[0], f.sigma / 0.02, 1e-5);
    ck_assert_double_eq_tol(f.quantile, 1.972079, 1e-6); /* t(0.975, 197) */
    ck_assert_double_eq_tol(known.quantile, 1.959964, 1e-6);
    ck_assert_double_eq(f.probability, 1);
    gsl_rng_free(r);
}
END_TEST

/* Times in any spacing: a gap, and times that no step meets. The cubic's error falls with
 * the step like the method's, and the halving ends when no estimate moves by sd / 100;
 * what is left is less than that last move, for any order. sigma = 1e-4. */
START_TEST(eq_24_4_times_in_any_spacing)
{
    const double *truth = ref_errors[0].truth;
    const fvi_linear_oscillator exact = { .m = 1,
                               .c = truth[2],
                               .rho = truth[1],
                               .alpha = truth[0],
                               .x0 = truth[3],
                               .v0 = truth[4] };
    for (int kind = 0; kind < 3; kind++) {
        question q;
        fvi_estimate f;
        ask(&q, NULL, 5);
        for (size_t i = 0; i < REF_POINTS; i++)
            q.t[i] += kind == 0   ? 0.03 * sin(7 * (double)i)
                      : kind == 1 ? (i > 50) * 3.7
                                  : -0.1; /* from t = 0 on */
        ck_assert_int_eq(fvi_exact_at(&exact, REF_POINTS, q.t, q.x, NULL,
                                      NULL), 0);
        q.fit.sigma = 1e-4;
        ck_assert_int_eq(fvi_estimate_multistart(&q.fit, NULL, &f), FVI_ETOL);
        seen(off(&f, truth, 5), "off in sd");
        ck_assert_msg(off(&f, truth, 5) < 0.02, "%d: %g sd", kind,
                      off(&f, truth, 5));
    }
}
END_TEST

//> halving
/* A method of order 1 makes an error in the model that no noise tells of. With the step
 * of the data its estimates are many sd away; halved until they stand still, they are
 * not. */
START_TEST(eq_24_4_the_step_is_halved_until_nothing_moves)
{
    question q;
    fvi_estimate coarse, f;
    ask(&q, ref_low, 3);
    q.fit.method = &fvi_fractional;
    q.fit.sigma = 1e-2;
    q.fit.h = 0.1;
    fvi_estimate_multistart(&q.fit, NULL, &coarse);
    q.fit.h = 0;
    fvi_estimate_multistart(&q.fit, NULL, &f);
    seen(off(&coarse, ref_errors[0].truth, 3), "off in sd, h = 0.1");
    seen(off(&f, ref_errors[0].truth, 3), "off in sd, halved");
    ck_assert_double_eq(coarse.h, 0.1);
    ck_assert(off(&coarse, ref_errors[0].truth, 3) > 3);
    ck_assert(f.bias <= 0.01 && off(&f, ref_errors[0].truth, 3) < 0.02);
}
END_TEST
//< halving

int main(void)
{
    Suite *suite = suite_create("parameters from a measured motion");
    ADD_CASE(suite, "values", eq_24_2_exact_data_give_the_parameters_back,
             eq_24_2_exact_data_of_half_a_derivative_give_it_back,
             eq_26_1_a_fit_with_a_law_finds_what_multiplies_it,
             eq_24_4_the_error_of_a_method_is_one_of_the_parameters,
             eq_24_3_standard_deviations_and_correlations,
             eq_24_3_an_offset_and_a_drift_are_a_straight_line,
             eq_24_3_sigma_is_estimated);
    ADD_CASE(suite, "noise",
             eq_24_2_noisy_data_of_another_program_within_three_sd);
    ADD_CASE(suite, "steps", eq_24_4_times_in_any_spacing,
             eq_24_4_the_step_is_halved_until_nothing_moves);
    return run_suite(suite);
}
