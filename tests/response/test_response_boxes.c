/* tests/response/test_response_boxes.c -- How often a phase winds around a box. [H 30]
 * Run alone: make test-response_boxes */
#include "response_systems.h"

#include "frequency/winding.h"

/* The phase of s minus a zero, whose ln is in params. */
static double phase_of_one_zero(const void *params, double u, double v)
{
    const double *zero = params;
    return carg(cexp(u + I * v) - cexp(zero[0] + I * zero[1]));
}

/* The phase of two real zeros, -1.13316 and -1.13318. */
static double phase_of_two_zeros(const void *params, double u, double v)
{
    (void)params;
    const double complex s = cexp(u + I * v);
    return carg((s + 1.13316) * (s + 1.13318));
}

/* Their ln is 0.125, the middle of half a step. */
START_TEST(eq_30_8_two_zeros_beside_a_box_are_not_counted)
{
    const fvi_log_box box = { { -1, 1 }, { 1.5, 3.14 } };
    ck_assert_int_eq(fvi_winding(phase_of_two_zeros, NULL, 0.5, &box), 0);
}
END_TEST

START_TEST(eq_30_8_zeros_are_counted_in_finite_boxes)
{
    static const double zero[2] = { 0.25, 2 };
    const fvi_log_box around = { { -1, 1 }, { 1.5, 3 } }, beside = { { 0.5, 1 }, { 1.5, 3 } },
                      endless = { { -1, INFINITY }, { 1.5, 3 } },
                      none = { { NAN, NAN }, { 1.5, 3 } };
    ck_assert_int_eq(fvi_winding(phase_of_one_zero, zero, 0.1, &around), 1);
    ck_assert_int_eq(fvi_winding(phase_of_one_zero, zero, 0.1, &beside), 0);
    ck_assert_int_eq(fvi_winding(phase_of_one_zero, zero, 0.1, &endless), -1);
    ck_assert_int_eq(fvi_winding(phase_of_one_zero, zero, 0.1, &none), -1);
}
END_TEST

/* A phase that is nothing but rounding errors, and counts how often it is asked. */
typedef struct {
    uint64_t seed;
    int values;
} noise;

static double phase_of_noise(const void *params, double u, double v)
{
    noise *n = (noise *)params;
    (void)u, (void)v;
    n->values++;
    return 2 * M_PI * chance(&n->seed);
}

START_TEST(a_phase_of_rounding_errors_is_given_up_soon)
{
    noise n = { 1, 0 };
    const fvi_log_box box = { { -1, 1 }, { 1.5, 3 } };
    ck_assert_int_eq(fvi_winding(phase_of_noise, &n, 0.1, &box), -1);
    ck_assert_int_lt(n.values, 1000);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("response_boxes");
    ADD_CASE(suite, "boxes", eq_30_8_zeros_are_counted_in_finite_boxes,
             eq_30_8_two_zeros_beside_a_box_are_not_counted,
             a_phase_of_rounding_errors_is_given_up_soon);
    return run_suite(suite);
}
