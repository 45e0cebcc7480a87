/* tests/harness/ulp.h -- Compare doubles in units in the last place.
 *
 * The distance of two doubles a and b is the number of steps from one double to the next one that lead from a to
 * b. +0 and -0 have the same place. */
#ifndef ULP_H
#define ULP_H

#include "seen.h"
#include "system/larger.h"

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* Check writes down each assertion that holds, so that it can say after which one a test crashed. This takes
 * two microseconds, which in long loops is more than the tested code. So this function tells Check of each line
 * only once. Check is always told of an assertion that fails. */
static inline void mark_line_once(const char *file, int line)
{
    static char told[1 << 10];
    char *here = &told[(size_t)line % sizeof told];
    if (!*here) {
        *here = 1;
        _mark_point(file, line);
    }
}
#define _mark_point mark_line_once

#define LEN(array) (sizeof(array) / sizeof((array)[0]))

/* Call a function of the library that must not fail. */
#define OK(call) ck_assert_int_eq(call, FVI_SUCCESS)

/* Unit roundoff: the largest relative error of one rounding to nearest. */
#define U 0x1p-53

/* Return the place of x in the order of doubles: x < y if and only if place(x) < place(y). */
static inline int64_t ulp_place(double x)
{
    int64_t i;
    memcpy(&i, &x, sizeof i);
    return i < 0 ? INT64_MIN - i : i;
}

static inline uint64_t ulp_distance(double a, double b)
{
    if (isnan(a) || isnan(b))
        return UINT64_MAX;
    int64_t i = ulp_place(a), j = ulp_place(b);
    return i < j ? (uint64_t)j - (uint64_t)i : (uint64_t)i - (uint64_t)j;
}

/* Check that got is within ulps steps of want. The other arguments are a printf format that says where. The
 * text is made, and Check is told, only if the assertion fails. */
#define ck_assert_ulp(got, want, ulps, ...)                                    \
    do {                                                                       \
        double got_ = (got), want_ = (want);                                   \
        uint64_t ulps_ = (ulps), distance_ = ulp_distance(got_, want_);        \
        seen_worst((double)distance_, "ulp");                                  \
        if (!(distance_ <= ulps_)) {                                           \
            char where_[512];                                                  \
            snprintf(where_, sizeof where_, __VA_ARGS__);                      \
            ck_abort_msg("%s: got %.17g (%a), want %.17g (%a): %llu ulp, "     \
                         "allowed %llu",                                       \
                         where_, got_, got_, want_, want_,                     \
                         (unsigned long long)distance_,                        \
                         (unsigned long long)ulps_);                           \
        }                                                                      \
    } while (0)

/* Check |got - want| <= bound, for values near zero or after a cancellation. */
#define ck_assert_near(got, want, bound, ...)                                  \
    do {                                                                       \
        double got_ = (got), want_ = (want), bound_ = (bound);                 \
        seen_worst(fabs(got_ - want_) / bound_, "of the bound");               \
        if (!(fabs(got_ - want_) <= bound_)) {                                 \
            char where_[512];                                                  \
            snprintf(where_, sizeof where_, __VA_ARGS__);                      \
            ck_abort_msg(                                                      \
                "%s: got %.17g, want %.17g: off by %.3g, allowed %.3g",        \
                where_, got_, want_, fabs(got_ - want_), bound_);              \
        }                                                                      \
    } while (0)

/* Run a suite and return the exit status for main. A run without any test is a failure. */
static inline int run_suite(Suite *suite)
{
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    int ran = srunner_ntests_run(runner),
        failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    if (ran == 0)
        fprintf(stderr, "no test was run\n");
    return ran == 0 || failed > 0;
}

/* Add a test case with these tests to the suite. */
#define ADD_CASE(suite, name, ...)                                             \
    do {                                                                       \
        const TTest *tests_[] = { __VA_ARGS__ };                               \
        TCase *case_ = tcase_create(name);                                     \
        tcase_set_timeout(case_, 60);                                          \
        for (size_t i_ = 0; i_ < LEN(tests_); i_++)                            \
            tcase_add_test(case_, tests_[i_]);                                 \
        suite_add_tcase(suite, case_);                                         \
    } while (0)

/* Add a test that runs for _i = 0, ..., count - 1 to the suite, as a test case of its own. */
#define ADD_LOOP(suite, test, count)                                           \
    do {                                                                       \
        TCase *case_ = tcase_create(#test);                                    \
        tcase_set_timeout(case_, 60);                                          \
        tcase_add_loop_test(case_, test, 0, (int)(count));                     \
        suite_add_tcase(suite, case_);                                         \
    } while (0)

#endif
