/* tests/identification/test_identification_questions.c -- H 24: fits that are refused, and the region of the
 * search.
 * Run alone: make test-identification_questions */
#include "identification_runs.h"

static int code_of(const question *q)
{
    fvi_estimate f;
    return fvi_estimate_multistart(&q->fit, NULL, &f);
}

#define REFUSED(change, code)                                                  \
    do {                                                                       \
        question q;                                                            \
        ask(&q, ref_low, 3);                                                   \
        change;                                                                \
        handled = 0;                                                           \
        ck_assert_int_eq(code_of(&q), code);                                   \
        ck_assert_int_eq(handled, 1);                                          \
    } while (0)

START_TEST(fit_refuses_what_cannot_be_asked)
{
    const fvi_free_parameter twice[] = { FVI_FREE_PARAMETER_RHO, FVI_FREE_PARAMETER_ALPHA,
                                    FVI_FREE_PARAMETER_RHO };
    const double box[] = { 0.1, 0.2, 0.3 };
    const fvi_kernel_term dashpot = { .kind = FVI_KERNEL_MAXWELL, .rho = 1 };
    const fvi_kernel law = { 1, &dashpot };
    fvi_estimate f;
    question right;
    ask(&right, ref_low, 3);
    fvi_set_error_handler(handler);
    REFUSED(q.fit.method = NULL, FVI_EFAULT);
    REFUSED(q.fit.run = NULL, FVI_EFAULT);
    REFUSED(q.fit.t = NULL, FVI_EFAULT);
    REFUSED(q.fit.x = NULL, FVI_EFAULT);
    REFUSED(q.fit.which = NULL, FVI_EFAULT);
    REFUSED(q.fit.constants = NULL, FVI_EFAULT);
    REFUSED(q.fit.low = box, FVI_EFAULT);
    REFUSED(q.fit.parameters = 0, FVI_EINVAL);
    REFUSED(q.fit.parameters = FVI_ESTIMATION_MOST + 1, FVI_EINVAL);
    REFUSED(q.fit.n = 3, FVI_EINVAL);
    REFUSED(q.fit.starts = 1, FVI_EINVAL);
    REFUSED(q.fit.which = twice, FVI_EINVAL);
    REFUSED(q.t[7] = q.t[6], FVI_EINVAL);
    REFUSED(q.t[0] = -1, FVI_EDOM);
    REFUSED(q.x[9] = NAN, FVI_EDOM);
    REFUSED(q.fit.sigma = -1, FVI_EDOM);
    REFUSED(q.fit.h = -1, FVI_EDOM);
    REFUSED(q.fit.h = 1e-9, FVI_EDOM);
    REFUSED(q.fit.low = q.fit.high = box, FVI_EDOM);
    REFUSED(q.fit.method = &fvi_lagrange_dalembert, FVI_EUNSUP);
    REFUSED((q.run.law = &law, q.fit.method = &fvi_cq_bdf2), FVI_EUNSUP);
    handled = 0;
    ck_assert_int_eq(fvi_estimate_multistart(NULL, NULL, &f), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_multistart(&right.fit, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_estimate_box(&right.fit, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(handled, 3);
    fvi_set_error_handler(NULL);
}
END_TEST

/* The box of the references: the truth lies in it, and it depends on nothing but the
 * data and the mass. */
START_TEST(the_box_holds_the_truth)
{
    for (size_t i = 0; i < 2; i++) {
        question q;
        double low[5], high[5];
        ask(&q, i ? ref_high : ref_low, 5);
        ck_assert_int_eq(fvi_estimate_box(&q.fit, low, high), FVI_SUCCESS);
        for (size_t j = 0; j < 5; j++)
            ck_assert_msg(low[j] < ref_errors[2 * i].truth[j]
                              && ref_errors[2 * i].truth[j] < high[j],
                          "%zu: %g ... %g", j, low[j], high[j]);
        q.m = 100; /* another unit of mass: all forces grow alike */
        double low100[5], high100[5];
        ck_assert_int_eq(fvi_estimate_box(&q.fit, low100, high100), FVI_SUCCESS);
        for (size_t j = 0; j < 5; j++)
            ck_assert_double_eq_tol(
                high100[j], high[j] * (j == 0 || j == 3 ? 1 : 100), 1e-9);
    }
}
END_TEST

/* In another unit of time, 1000 times as many seconds, a number of a law has 1000^p times its value, and so has its
 * box: p = 1 for the time of MAXWELL and DAVIDSON, 2 alpha for that of ZENER and HAVRILIAK, and 2 alpha - 2 for rho. */
START_TEST(the_box_of_a_law_has_the_units_of_its_numbers)
{
    static const fvi_kernel_term terms[] = { { FVI_KERNEL_MAXWELL, 1, 0, 1, 0 },
                                             { FVI_KERNEL_DAVIDSON, 1, 0.2, 1, 0 },
                                             { FVI_KERNEL_ZENER, 1, 0.2, 1, 0 },
                                             { FVI_KERNEL_HAVRILIAK, 1, 0.2, 1, 0.6 } };
    static const double of_rho[] = { -1, -1.6, -1.6, -1.6 }, of_time[] = { 1, 1, 0.4, 0.4 };
    static const fvi_free_parameter which[] = { FVI_FREE_PARAMETER_LAW, FVI_FREE_PARAMETER_LAW + 2 };
    for (size_t i = 0; i < LEN(terms); i++) {
        const fvi_kernel law = { 1, &terms[i] };
        double low[2], high[2], low_slow[2], high_slow[2];
        question q;
        ask(&q, ref_low, 2);
        q.run.law = &law;
        q.fit.which = which;
        ck_assert_int_eq(fvi_estimate_box(&q.fit, low, high), FVI_SUCCESS);
        for (size_t k = 0; k < REF_POINTS; k++)
            q.t[k] *= 1000;
        ck_assert_int_eq(fvi_estimate_box(&q.fit, low_slow, high_slow), FVI_SUCCESS);
        for (size_t j = 0; j < 2; j++) {
            const double factor = pow(1000, j ? of_time[i] : of_rho[i]);
            ck_assert_near(low_slow[j] / low[j] / factor, 1, 1e-9, "kind %d, number %zu", (int)terms[i].kind, j);
            ck_assert_near(high_slow[j] / high[j] / factor, 1, 1e-9, "kind %d, number %zu", (int)terms[i].kind, j);
        }
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("what can be asked");
    ADD_CASE(suite, "questions", fit_refuses_what_cannot_be_asked,
             the_box_holds_the_truth, the_box_of_a_law_has_the_units_of_its_numbers);
    return run_suite(suite);
}
