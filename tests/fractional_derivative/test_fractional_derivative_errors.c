/* tests/fractional_derivative/test_fractional_derivative_errors.c -- H 1: inputs that are refused.
 * Run alone: make test-fractional_derivative_errors */
#include "fractional_derivative_curves.h"

static double wrong(double t, const void *p)
{
    return t > 0.5 ? GSL_NAN : sine(t, p);
}

START_TEST(bad_arguments_are_refused_and_d_is_untouched)
{
    int (*const both[])(fvi_side, double, double, const fvi_curve *, double,
                        double *) = { fvi_caputo, fvi_riemann_liouville };
    const double outside[] = { -0x1p-1074, 1 + 0x1p-52, GSL_NAN, GSL_POSINF };
    const fvi_curve no_f = { NULL, dsine, &ONE }, no_df = { sine, NULL, &ONE };
    const fvi_curve bad_f = { wrong, dsine, &ONE },
                    bad_df = { sine, wrong, &ONE };
    const fvi_side back = FVI_RETARDED;
    double d = 7;
    for (size_t i = 0; i < 2; i++) {
        ck_assert_int_eq(both[i](back, 0.5, 0, NULL, 1, &d), FVI_EFAULT);
        ck_assert_int_eq(both[i](back, 0.5, 0, &no_f, 1, &d), FVI_EFAULT);
        ck_assert_int_eq(both[i](back, 0.5, 0, &no_df, 1, &d), FVI_EFAULT);
        ck_assert_int_eq(both[i](back, 0.5, 0, &slow_sine, 1, NULL),
                         FVI_EFAULT);
        ck_assert_int_eq(both[i]((fvi_side)0, 0.5, 0, &slow_sine, 1, &d),
                         FVI_EINVAL);
        for (size_t j = 0; j < LEN(outside); j++)
            ck_assert_int_eq(both[i](back, outside[j], 0, &slow_sine, 1, &d),
                             FVI_EDOM);
        ck_assert_int_eq(both[i](back, 0.5, GSL_NAN, &slow_sine, 1, &d),
                         FVI_EDOM);
        ck_assert_int_eq(both[i](back, 0.5, 0, &slow_sine, GSL_POSINF, &d),
                         FVI_EDOM);
        ck_assert_int_eq(both[i](back, 0.5, 0, &slow_sine, -1, &d), FVI_EDOM);
        ck_assert_int_eq(both[i](FVI_ADVANCED, 0.5, 0, &slow_sine, 1, &d),
                         FVI_EDOM);
        ck_assert_int_eq(both[i](back, 0.5, 0, &bad_df, 1, &d), FVI_EBADFUNC);
        ck_assert_int_eq(both[i](back, 0, 0, &bad_f, 1, &d), FVI_EBADFUNC);
    }
    ck_assert_int_eq(fvi_riemann_liouville(back, 0.5, 0, &constant, 0, &d),
                     FVI_ESING);
    ck_assert_int_eq(fvi_riemann_liouville(back, 0.5, 1, &bad_f, 1, &d),
                     FVI_EBADFUNC);
    ck_assert(d == 7);
}
END_TEST

/* Not a number between two of the times at which f' is looked at beforehand. */
static double holed(double t, const void *params)
{
    (void)params;
    return t > 0.51 && t < 0.52 ? GSL_NAN : 1;
}

START_TEST(a_hole_in_the_velocity_is_found)
{
    const fvi_curve curve = { sine, holed, &(const double){ 1 } };
    double d = 7;
    ck_assert_int_eq(fvi_caputo(FVI_RETARDED, 0.5, 0, &curve, 1, &d),
                     FVI_EBADFUNC);
    ck_assert(d == 7);
}
END_TEST

/* The velocity of the square root of t, infinite at 0: an integral, but not to a tolerance
 * that is relative to the largest velocity. */
static double root_rate(double t, const void *params)
{
    (void)params;
    return 0.5 / sqrt(t);
}

START_TEST(an_infinite_velocity_is_refused)
{
    const fvi_curve curve = { sine, root_rate, &(const double){ 1 } };
    double d = 7;
    ck_assert_int_eq(fvi_caputo(FVI_RETARDED, 0.5, 0, &curve, 1, &d),
                     FVI_EBADFUNC);
    ck_assert(d == 7);
}
END_TEST

/* A thousand intervals are not enough for a hundred million oscillations. */
START_TEST(a_quadrature_that_fails_says_so)
{
    const double fast = 1e9;
    const fvi_curve wild = { sine, dsine, &fast };
    double d = 7;
    int status = fvi_caputo(FVI_RETARDED, 0.5, 0, &wild, 1, &d);
    ck_assert_msg(status == FVI_EMAXITER || status == FVI_EROUND
                      || status == FVI_ESING,
                  "status %d", status);
    ck_assert(d == 7);
}
END_TEST

START_TEST(bad_powers_are_refused_and_d_is_untouched)
{
    double d = 7;
    ck_assert_int_eq(fvi_power_derivative(0.5, 1, 1, NULL), FVI_EFAULT);
    const double bad[][3] = { { 2.5, 1, 1 },         { -2.5, 1, 1 },
                              { GSL_NAN, 1, 1 },     { 0.5, -1, 1 },
                              { 0.5, GSL_NAN, 1 },   { 0.5, GSL_POSINF, 1 },
                              { 0.5, 1, -1 },        { 0.5, 1, GSL_NAN },
                              { 0.5, 1, GSL_POSINF } };
    for (size_t i = 0; i < LEN(bad); i++)
        ck_assert_int_eq(
            fvi_power_derivative(bad[i][0], bad[i][1], bad[i][2], &d),
            FVI_EDOM);
    ck_assert_int_eq(fvi_power_derivative(0.5, 0, 0, &d), FVI_ESING);
    ck_assert_int_eq(fvi_power_derivative(0.5, 400, 1e10, &d), FVI_EOVRFLW);
    ck_assert(d == 7);
    ck_assert(power(0.5, -0.5, 0) == 0 && power(0.5, 1, 0) == 0);
    ck_assert(power(0.1, 0.7, 0) == 0 && power(0.3, 1.1, 0) == 0); /* rounded */
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("01 fractional_derivative: errors");
    ADD_CASE(suite, "errors", bad_arguments_are_refused_and_d_is_untouched,
             a_hole_in_the_velocity_is_found, an_infinite_velocity_is_refused,
             a_quadrature_that_fails_says_so,
             bad_powers_are_refused_and_d_is_untouched);
    return run_suite(suite);
}
