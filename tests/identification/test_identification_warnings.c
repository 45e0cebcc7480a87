/* tests/identification/test_identification_warnings.c -- H 24: what a fit that is not to
 * be believed says.
 * Run alone: make test-identification_warnings */
#include "identification_runs.h"

START_TEST(each_flag_of_an_answer_has_its_words)
{
    char text[FVI_WARNING_ROOM] = "";
    question q;
    ask(&q, NULL, 2);
    fvi_estimate f = { .correlation = { { 1, -0.95 }, { -0.95, 1 } } };
    ck_assert(
        fvi_estimate_warning_of_pair(&f, 0, 1, "alpha", "rho", sizeof text, text));
    ck_assert_str_eq(text, "these data can hardly tell alpha and rho apart "
                           "(correlation -0.950)");
    f.correlation[0][1] = 0.89;
    ck_assert(!fvi_estimate_warning_of_pair(&f, 0, 1, "", "", sizeof text, text));
    f.bias = 0.02;
    ck_assert(!fvi_estimate_warning_of_step(&q.fit, &f, sizeof text, text));
    f.bias = 0.03;
    ck_assert(fvi_estimate_warning_of_step(&q.fit, &f, sizeof text, text));
    ck_assert_ptr_nonnull(strstr(text, "0.03 sd"));
    f.bias = NAN;
    ck_assert(fvi_estimate_warning_of_step(&q.fit, &f, sizeof text, text));
    q.fit.h = 0.1; /* which was given: nothing was halved */
    ck_assert(!fvi_estimate_warning_of_step(&q.fit, &f, sizeof text, text));
    q.fit.n = 100;
    f.neighbours = -0.49;
    ck_assert(!fvi_estimate_warning_of_model(&q.fit, &f, sizeof text, text));
    f.neighbours = -0.51;
    ck_assert(fvi_estimate_warning_of_model(&q.fit, &f, sizeof text, text));
    ck_assert_ptr_nonnull(strstr(text, "(correlation -0.51)"));
}
END_TEST

/* The estimates count, not the values that the search began with. */
START_TEST(an_answer_that_no_motion_has_is_warned_of)
{
    question q;
    ask(&q, NULL, 4); /* alpha, rho, c, x0 */
    q.run.past = FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE;
    fvi_estimate f = { .estimate = { 0.7, 0.2, 1, 1 } };
    ck_assert_ptr_nonnull(fvi_estimate_warning_of_initial_history(&q.fit, &f));
    f.estimate[3] = 0;
    ck_assert_ptr_null(fvi_estimate_warning_of_initial_history(&q.fit, &f));
    f.estimate[3] = 1;
    f.estimate[0] = 0.4;
    ck_assert_ptr_null(fvi_estimate_warning_of_initial_history(&q.fit, &f));
    f.estimate[0] = 0.7;
    f.estimate[1] = 0;
    ck_assert_ptr_null(fvi_estimate_warning_of_initial_history(&q.fit, &f));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("24 identification, warnings");
    ADD_CASE(suite, "values", each_flag_of_an_answer_has_its_words,
             an_answer_that_no_motion_has_is_warned_of);
    return run_suite(suite);
}
