/* tests/response/test_response_warnings.c -- The warnings of places and poles. [H 30]
 * Run alone: make test-response_warnings */
#include "harness/ulp.h"

#include <fvi/fvi.h>
#include <fvi/response.h>

#include <math.h>
#include <string.h>

static const double mass = 1, g = 1, nothing = 0;

static int is_warned_of(fvi_potential potential, double x)
{
    const fvi_system system = { .d = 1, .mass = &mass, .damping = &nothing, .potential = potential };
    const char *text = "left";
    const int warned = fvi_response_warning_of_place(&system, &x, &text);
    ck_assert_int_eq(warned, text != NULL);
    if (warned)
        ck_assert_ptr_nonnull(strstr(text, "no equilibrium"));
    return warned;
}

static int undefined(size_t d, const double *x, void *params, double *out)
{
    (void)d, (void)x, (void)params;
    *out = NAN;
    return 0;
}

static int failing(size_t d, const double *x, void *params, double *out)
{
    (void)d, (void)x, (void)params;
    *out = NAN;
    return FVI_EDOM;
}

/* sin x: 1e-8 (1 + |x|) may be there, and at pi its double has 1.2e-16. */
START_TEST(a_place_with_a_slope_is_warned_of)
{
    const fvi_potential pendulum = fvi_potential_pendulum(&g);
    ck_assert(!is_warned_of(pendulum, 0) && !is_warned_of(pendulum, M_PI) && !is_warned_of(pendulum, 0.9e-8));
    ck_assert(is_warned_of(pendulum, 1.1e-8) && is_warned_of(pendulum, 1));
    ck_assert(!is_warned_of(fvi_potential_harmonic(&g), 1) && !is_warned_of((fvi_potential){ 0 }, 1));
    fvi_potential bad = pendulum;
    bad.gradient = undefined;
    ck_assert(is_warned_of(bad, 0));
    bad.gradient = failing; /* which whoever makes it linear says */
    ck_assert(!is_warned_of(bad, 0));
}
END_TEST

START_TEST(poles_that_are_missing_are_warned_of)
{
    static const struct { size_t count, expected, d; const char *text; } cases[] = {
        { 3, 3, 3, "left" },
        { 2, 3, 3, "these are 2 of 3 poles" },
        { 3, SIZE_MAX, 3, "these are 3 of ? poles" },
        { 1, 1, 3, "what creeps or grows, e^{st} with a real s or with Re s > 0, is no row" }
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        char text[FVI_WARNING_ROOM] = "left";
        const fvi_poles poles = { cases[i].count, cases[i].expected, cases[i].d, NULL, NULL, NULL };
        ck_assert_int_eq(fvi_response_warning_of_poles(&poles, sizeof text, text), i > 0);
        ck_assert_str_eq(text, cases[i].text);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("30 response, warnings");
    ADD_CASE(suite, "warnings", a_place_with_a_slope_is_warned_of, poles_that_are_missing_are_warned_of);
    return run_suite(suite);
}
