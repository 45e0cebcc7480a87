/* tests/integration_by_parts/test_integration_by_parts_values.c -- H 5: the values of both operators, and inputs
 * that are refused.
 * Run alone: make test-integration_by_parts_values */
#include "both.h"
#include "integration_by_parts_ref.h"

#include <gsl/gsl_math.h>
#include <stddef.h>

/* Under AddressSanitizer, too, malloc may say no. */
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1";
}

/* ---- values ---- */

/* (5.1), (5.2): t = k + 1 or N - k + 1 terms. Each term carries one error of its
 * weight (at most 1 ulp, 2 u) and one of the product; t - 1 additions; h^-alpha
 * comes from pow (below 1 ulp, 2 u) and is multiplied in: in all
 * (2 + 1 + t - 1 + 2 + 1) u = (t + 5) u times the sum of absolute values.
 * Seen: 0.32 of that. */
START_TEST(eq_5_1_values_match_the_definition)
{
    const size_t N = LEN(ref_z) - 1;
    double minus[LEN(ref_z)];
    for (size_t i = 0; i < LEN(ref_values); i++) {
        double alpha = ref_values[i].alpha, h = ref_values[i].h;
        size_t k = ref_values[i].k;
        if (k == 0)
            both(alpha, h, N, 1, ref_z, minus, NULL);
        ck_assert_near(minus[k], ref_values[i].minus,
                       ((double)k + 6) * U * ref_values[i].size_minus,
                       "minus, alpha=%g h=%g k=%zu", alpha, h, k);
    }
}
END_TEST

START_TEST(eq_5_2_values_match_the_definition)
{
    const size_t N = LEN(ref_z) - 1;
    double plus[LEN(ref_z)];
    for (size_t i = 0; i < LEN(ref_values); i++) {
        double alpha = ref_values[i].alpha, h = ref_values[i].h;
        size_t k = ref_values[i].k;
        if (k == 0)
            both(alpha, h, N, 1, ref_z, NULL, plus);
        ck_assert_near(plus[k], ref_values[i].plus,
                       ((double)(N - k) + 6) * U * ref_values[i].size_plus,
                       "plus, alpha=%g h=%g k=%zu", alpha, h, k);
    }
}
END_TEST

/* Integer orders are differences: of integers, so 0 ulp (h = 1/2). At its own end
 * each sum has one term, z / h^alpha (the paper's Remark 4.1), and for N = 0
 * nothing else. */
START_TEST(eq_5_1_integer_orders_are_differences)
{
    const size_t N = LEN(ref_z) - 1;
    double minus[LEN(ref_z)], plus[LEN(ref_z)];
    const double *z = ref_z;
    both(0.5, 0.25, 0, 1, z, minus, plus);
    ck_assert(minus[0] == 2 * z[0] && plus[0] == 2 * z[0]);
    both(0, 0.5, N, 1, z, minus, plus);
    for (size_t k = 0; k <= N; k++)
        ck_assert(minus[k] == z[k] && plus[k] == z[k]);
    both(1, 0.5, N, 1, z, minus, plus);
    ck_assert(minus[0] == 2 * z[0] && plus[N] == 2 * z[N]);
    for (size_t k = 1; k <= N; k++) {
        ck_assert_ulp(minus[k], 2 * (z[k] - z[k - 1]), 0, "k=%zu", k);
        ck_assert_ulp(plus[k - 1], -2 * (z[k] - z[k - 1]), 0, "k=%zu", k);
    }
    both(2, 0.5, N, 1, z, minus, plus);
    for (size_t k = 2; k <= N; k++) {
        double second = 4 * (z[k] - 2 * z[k - 1] + z[k - 2]);
        ck_assert_ulp(minus[k], second, 0, "k=%zu", k);
        ck_assert_ulp(plus[k - 2], second, 0, "k=%zu", k);
    }
}
END_TEST

/* The operators act on each component as if it were alone: the same operations
 * in the same order, so 0 ulp. */
START_TEST(eq_5_1_vectors_are_their_components)
{
    enum { N = 20, D = 3 };
    double z[(N + 1) * D], minus[(N + 1) * D], plus[(N + 1) * D];
    double one[N + 1], minus_one[N + 1], plus_one[N + 1];
    for (size_t j = 0; j < LEN(z); j++)
        z[j] = next_number();
    both(0.3, 0.1, N, D, z, minus, plus);
    for (size_t i = 0; i < D; i++) {
        for (size_t k = 0; k <= N; k++)
            one[k] = z[k * D + i];
        both(0.3, 0.1, N, 1, one, minus_one, plus_one);
        for (size_t k = 0; k <= N; k++) {
            ck_assert_ulp(minus[k * D + i], minus_one[k], 0, "k=%zu", k);
            ck_assert_ulp(plus[k * D + i], plus_one[k], 0, "k=%zu", k);
        }
    }
}
END_TEST

/* (5.3) is a plain scalar product over a range, ends included; an empty range
 * gives nothing. */
START_TEST(eq_5_3_sums_run_from_first_to_last)
{
    const double a[] = { 1, 2, 3, 4, 5, 6, 7, 8 };
    const double b[] = { 1, 10, 100, 1000, 10000, 1e5, 1e6, 1e7 };
    ck_assert(fvi_sum_of_products(0, 3, 2, a, b) == 87654321);
    ck_assert(fvi_sum_of_products(1, 2, 2, a, b) == 654300);
    ck_assert(fvi_sum_of_products(5, 5, 1, a, b) == 600000);
    ck_assert(fvi_sum_of_products(2, 1, 2, a, b) == 0);
}
END_TEST

/* ---- errors ---- */

START_TEST(bad_arguments_are_refused_and_out_is_untouched)
{
    int (*const both_of[])(double, double, size_t, size_t, const double *,
                           double *) = { fvi_delta_minus, fvi_delta_plus };
    const double orders[] = { -0x1p-1074, 2 + 0x1p-51, GSL_NAN, GSL_POSINF };
    const double steps[] = { 0, -1, GSL_NAN, GSL_POSINF };
    const double z[] = { 1, 2 };
    double out[] = { 7, 8 };
    for (size_t i = 0; i < 2; i++) {
        int (*const f)(double, double, size_t, size_t, const double *,
                       double *) = both_of[i];
        ck_assert_int_eq(f(0.5, 1, 1, 1, NULL, out), FVI_EFAULT);
        ck_assert_int_eq(f(0.5, 1, 1, 1, z, NULL), FVI_EFAULT);
        ck_assert_int_eq(f(0.5, 1, 1, 0, z, out), FVI_EINVAL);
        ck_assert_int_eq(f(0.5, 1, SIZE_MAX, 1, z, out), FVI_EINVAL);
        ck_assert_int_eq(f(0.5, 1, SIZE_MAX / 16, 2, z, out), FVI_EINVAL);
        ck_assert_int_eq(f(0.5, 1, 1, SIZE_MAX / 8, z, out), FVI_EINVAL);
        for (size_t j = 0; j < 4; j++) {
            ck_assert_int_eq(f(orders[j], 1, 1, 1, z, out), FVI_EDOM);
            ck_assert_int_eq(f(0.5, steps[j], 1, 1, z, out), FVI_EDOM);
        }
        /* more than any machine has, yet addressable */
        ck_assert_int_eq(f(0.5, 1, SIZE_MAX / 32, 1, z, out), FVI_ENOMEM);
        ck_assert(out[0] == 7 && out[1] == 8);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("integration_by_parts: values");
    ADD_CASE(suite, "values", eq_5_1_values_match_the_definition,
             eq_5_2_values_match_the_definition,
             eq_5_1_integer_orders_are_differences,
             eq_5_1_vectors_are_their_components,
             eq_5_3_sums_run_from_first_to_last);
    ADD_CASE(suite, "errors", bad_arguments_are_refused_and_out_is_untouched);
    return run_suite(suite);
}
