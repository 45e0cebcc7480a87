/* tests/identification/test_identification_warnings.c -- H 24: the warnings of a fit that is not reliable.
 * Run alone: make test-identification_warnings */
#include "identification_runs.h"

START_TEST(two_that_are_alike_have_their_words)
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
}
END_TEST

START_TEST(each_flag_has_its_words)
{
    static const char *const names[] = { "alpha", "rho" };
    static const struct {
        unsigned flag;
        const char *words;
    } flags[] = {
        { FVI_FLAG_NO_MOTION, "no motion is seen" },
        { FVI_FLAG_NEIGHBOURS, "neighbouring residuals are alike (correlation 0.51)" },
        { FVI_FLAG_OFFSET, "have a mean" },
        { FVI_FLAG_DRIFT, "have a slope" },
        { FVI_FLAG_PATTERN, "have a smooth pattern" },
        { FVI_FLAG_VALLEYS, "another minimum is nearly as good (chi2 12, and 10 here)" },
        { FVI_FLAG_BETTER, "the fit became better" },
        { FVI_FLAG_STEP, "half the step moved the estimates by 3 sd" },
        { FVI_FLAG_BIASED, "too long by far: half of it moved the estimates by 3 sd" },
        { FVI_FLAG_OPEN, "the data exclude no value of rho" },
    };
    question q;
    ask(&q, NULL, 2);
    const fvi_estimate f = { .neighbours = 0.51, .chi2 = 10, .bias = 3, .quantile = 2 };
    fvi_examination e = { .upper = { 1, INFINITY }, .lower = { 0.1, 0 }, .chi2 = 12 };
    for (size_t i = 0; i < LEN(flags); i++) {
        char text[FVI_WARNING_ROOM] = "";
        e.flags = ~flags[i].flag;
        ck_assert(!fvi_estimate_flag_text(&q.fit, &f, &e, flags[i].flag, names,
                                          sizeof text, text));
        ck_assert_str_eq(text, "");
        e.flags = flags[i].flag;
        ck_assert(fvi_estimate_flag_text(&q.fit, &f, &e, flags[i].flag, names,
                                         sizeof text, text));
        ck_assert_msg(strstr(text, flags[i].words), "%s: %s", flags[i].words, text);
    }
}
END_TEST

START_TEST(what_nobody_sees_has_its_words)
{
    static const char *const names[] = { "alpha", "rho" };
    char text[FVI_WARNING_ROOM] = "";
    question q;
    ask(&q, NULL, 2);
    const fvi_estimate f = { .quantile = 2 };
    const fvi_examination e = { .unseen = { 0.5, 0.25 },
                                .swayed = { { 1, -6 }, { 1.9, 0 } } };
    ck_assert(fvi_estimate_warning_of_unseen(&q.fit, &f, &e, 0, names, sizeof text, text));
    ck_assert_str_eq(text, "an offset of 0.5 sigma would not be seen in the residuals and moves rho "
                           "by 6 sd: fit offset, too, or be sure that there is none");
    ck_assert(!fvi_estimate_warning_of_unseen(&q.fit, &f, &e, 1, names, sizeof text, text));
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
    ADD_CASE(suite, "values", two_that_are_alike_have_their_words,
             each_flag_has_its_words, what_nobody_sees_has_its_words, an_answer_that_no_motion_has_is_warned_of);
    return run_suite(suite);
}
