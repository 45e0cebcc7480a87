/* tests/discrete_principle/test_discrete_principle_errors.c -- H 6: inputs that are refused.
 * Run alone: make test-discrete_principle_errors */
#include <fvi/error.h>
#include <fvi/paper/discrete_principle.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

/* Under AddressSanitizer, too, malloc may say no. */
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1";
}

static const double mass[] = { 1, 2 }, damping[] = { 0.5, 0.75 }, c = 3;
static const double zeros[6];

static fvi_system two_masses(void)
{
    return (fvi_system){ .d = 2,
                         .mass = mass,
                         .damping = damping,
                         .potential = fvi_potential_harmonic(&c) };
}

/* Every refusal of both functions; the outputs keep their sentinel. */
static void ck_assert_refused(int code, const fvi_system *system, double alpha,
                              double kappa, double h, size_t N, size_t first,
                              size_t last, const double *x, const double *y)
{
    double S = 7, fx[6] = { 7, 7, 7, 7, 7, 7 }, fy[6] = { 7, 7, 7, 7, 7, 7 };
    ck_assert_int_eq(
        fvi_discrete_action(system, alpha, kappa, h, N, first, last, x, y, &S),
        code);
    ck_assert_int_eq(fvi_discrete_action_gradient(system, alpha, kappa, h, N,
                                                  first, last, x, y, fx, fy),
                     code);
    ck_assert(S == 7);
    for (size_t i = 0; i < 6; i++)
        ck_assert(fx[i] == 7 && fy[i] == 7);
}

START_TEST(a_bad_discrete_problem_is_refused)
{
    const fvi_system good = two_masses(), *s = &good;
    const double *x = zeros, *y = zeros;
    const double outside[] = { -0.01, 1.01, GSL_NAN, GSL_POSINF };
    const double not_steps[] = { 0, -1, GSL_NAN, GSL_POSINF };
    const size_t huge = SIZE_MAX / sizeof(double) / 8;
    fvi_system half = good, light = good;
    half.potential.hessian = NULL;
    light.mass = (const double[]){ 1, 0 };
    ck_assert_refused(FVI_EFAULT, NULL, 0.5, 0.5, 1, 2, 0, 2, x, y);
    ck_assert_refused(FVI_EFAULT, s, 0.5, 0.5, 1, 2, 0, 2, NULL, y);
    ck_assert_refused(FVI_EFAULT, s, 0.5, 0.5, 1, 2, 0, 2, x, NULL);
    ck_assert_refused(FVI_EINVAL, &half, 0.5, 0.5, 1, 2, 0, 2, x, y);
    ck_assert_refused(FVI_EDOM, &light, 0.5, 0.5, 1, 2, 0, 2, x, y);
    for (size_t i = 0; i < LEN(outside); i++) {
        ck_assert_refused(FVI_EDOM, s, outside[i], 0.5, 1, 2, 0, 2, x, y);
        ck_assert_refused(FVI_EDOM, s, 0.5, outside[i], 1, 2, 0, 2, x, y);
        ck_assert_refused(FVI_EDOM, s, 0.5, 0.5, not_steps[i], 2, 0, 2, x, y);
    }
    ck_assert_refused(FVI_EINVAL, s, 0.5, 0.5, 1, 0, 0, 0, x, y);
    ck_assert_refused(FVI_EINVAL, s, 0.5, 0.5, 1, huge, 0, 2, x, y);
    ck_assert_refused(FVI_EINVAL, s, 0.5, 0.5, 1, SIZE_MAX, 0, 2, x, y);
    ck_assert_refused(FVI_EINVAL, s, 0.5, 0.5, 1, 2, 2, 1, x, y);
    ck_assert_refused(FVI_EINVAL, s, 0.5, 0.5, 1, 2, 0, 3, x, y);
    /* more than any machine has, yet addressable */
    ck_assert_refused(FVI_ENOMEM, s, 0.5, 0.5, 1, huge - 2, 0, 2, x, y);
}
END_TEST

START_TEST(null_gradients_are_refused)
{
    const fvi_system good = two_masses();
    double out[6];
    ck_assert_int_eq(
        fvi_discrete_action(&good, 0.5, 0.5, 1, 2, 0, 2, zeros, zeros, NULL),
        FVI_EFAULT);
    ck_assert_int_eq(fvi_discrete_action_gradient(&good, 0.5, 0.5, 1, 2, 0, 2,
                                                  zeros, zeros, NULL, out),
                     FVI_EFAULT);
    ck_assert_int_eq(fvi_discrete_action_gradient(&good, 0.5, 0.5, 1, 2, 0, 2,
                                                  zeros, zeros, out, NULL),
                     FVI_EFAULT);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("discrete_principle_errors");
    ADD_CASE(suite, "errors", a_bad_discrete_problem_is_refused,
             null_gradients_are_refused);
    return run_suite(suite);
}
