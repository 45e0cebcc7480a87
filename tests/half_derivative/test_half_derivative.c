/* tests/half_derivative/test_half_derivative.c -- H 7: half a derivative, twice.
 * Run alone: make test-half_derivative */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/algorithm_3.h>
#include <fvi/paper/half_derivative.h>
#include <fvi/paper/integration_by_parts.h>
#include "harness/ulp.h"

#include "half_derivative_ref.h"

#include <gsl/gsl_math.h>
#include <stddef.h>

/* Under AddressSanitizer, too, malloc may say no. */
const char *__asan_default_options(void)
{
    return "allocator_may_return_null=1";
}

/* ---- values ---- */

/* (7.2): two weights (at most 1 ulp, 2 u, each), one product, k additions:
 * (k + 5) u times the sum of absolute values. Seen: 0.20 of that. */
START_TEST(eq_7_2_products_match_the_definition)
{
    double c[61];
    for (size_t i = 0; i < LEN(ref_products); i++) {
        size_t k = ref_products[i].k;
        double alpha = ref_products[i].alpha, beta = ref_products[i].beta;
        ck_assert_int_eq(fvi_gl_weights_product(alpha, beta, LEN(c), c), 0);
        ck_assert_near(c[k], ref_products[i].want,
                       ((double)k + 5) * U * ref_products[i].size,
                       "orders %g, %g k=%zu", alpha, beta, k);
    }
}
END_TEST

/* (7.1): (k + 6) u for each of the two sums (H 5, with at most k + 1 terms)
 * times h^(-2 alpha) sum sum |alpha_n alpha_p z|. Seen: 0.18 of that. */
START_TEST(eq_7_1_two_derivatives_match_the_double_sum)
{
    const size_t N = LEN(ref_z) - 1;
    double out[LEN(ref_z)];
    for (size_t i = 0; i < LEN(ref_twice); i++) {
        size_t k = ref_twice[i].k;
        double alpha = ref_twice[i].alpha, h = ref_twice[i].h;
        ck_assert_int_eq(fvi_delta_twice(alpha, h, N, 1, ref_z, out), 0);
        ck_assert_near(out[k], ref_twice[i].want,
                       2 * ((double)k + 6) * U * ref_twice[i].size,
                       "alpha=%g h=%g k=%zu", alpha, h, k);
    }
}
END_TEST

/* ---- identities: the lemma, exactly ---- */

/* (7.5), (7.6): alpha_n = -2 C_{n-1} / 4^n with Catalan's numbers C, and by
 * Segner's recurrence every partial sum of c_k is an integer of at most C_{k-1}
 * over 2^(2k-1). C_30 < 2^53 < C_31: all is exact up to k = 31, and 32 is the
 * first that is not. From there, the partial sums never exceed |alpha_k|, so k
 * additions cost at most k u |alpha_k|; the products in the middle, 2 |alpha_k| in
 * all, 5 u each (two weights of 1 ulp and one rounding), those at both ends, again
 * 2 |alpha_k|, 2 u each: (k + 14) u |alpha_k|. Seen: 0.045 of that. */
//> exact
START_TEST(eq_7_6_the_weights_vanish_exactly_and_then_but_for_rounding)
{
    enum { COUNT = 5001 };
    double c[COUNT], w[COUNT];
    fvi_gl_weights(0.5, COUNT, w);
    fvi_gl_weights_product(0.5, 0.5, COUNT, c);
    ck_assert(c[0] == 1 && c[1] == -1);
    for (size_t k = 2; k <= 31; k++)
        ck_assert_msg(c[k] == 0, "c_%zu = %g", k, c[k]);
    ck_assert(c[32] != 0);
    for (size_t k = 32; k < COUNT; k++)
        ck_assert_near(c[k], 0, ((double)k + 14) * U * fabs(w[k]), "k=%zu", k);
}
END_TEST
//< exact

/* (7.5) in integers: 4^k c_k from 4^n alpha_n = -2 C_{n-1}, below 2^63. */
START_TEST(eq_7_5_the_lemma_is_segners_recurrence)
{
    enum { MOST = 31 };
    int64_t A[MOST + 1] = { 1, -2 }; /* 4^n alpha_n */
    double w[MOST + 1];
    for (int64_t n = 1; n < MOST; n++) /* C_n = C_{n-1} 2 (2n - 1) / (n + 1) */
        A[n + 1] = A[n] * 2 * (2 * n - 1) / (n + 1);
    ck_assert_int_eq(fvi_gl_weights(0.5, MOST + 1, w), FVI_SUCCESS);
    for (int k = 0; k <= MOST; k++) {
        int64_t sum = 0;
        for (int n = 0; n <= k; n++)
            sum += A[n] * A[k - n];
        ck_assert_int_eq(sum, k == 0 ? 1 : k == 1 ? -4 : 0);
        ck_assert_ulp(w[k], ldexp((double)A[k], -2 * k), 0, "k=%d", k);
    }
}
END_TEST

/* (7.3) for integer vectors, h = 1/4 (h^(-1/2) = 2 is exact). The inner sums are
 * multiples of 2^(-2k), all partial sums of the outer ones multiples of 2^(-2k),
 * at most 2 * 2 * 16 * 2 * 2 = 2^8: exact as long as 2 k + 8 <= 53. 0 ulp. */
//> lemma
START_TEST(eq_7_3_half_a_derivative_twice_is_a_difference)
{
    enum { N = 22, D = 2 };
    double z[(N + 1) * D], twice[(N + 1) * D], difference[(N + 1) * D];
    double once[(N + 1) * D], ahead[(N + 1) * D]; /* the mirror */
    for (size_t j = 0; j < LEN(z); j++)
        z[j] = (double)((int)(7 * j * j + 3 * j) % 33 - 16);
    fvi_delta_twice(0.5, 0.25, N, D, z, twice);
    fvi_backward_difference(0.25, N, D, z, difference);
    fvi_delta_plus(0.5, 0.25, N, D, z, once);
    fvi_delta_plus(0.5, 0.25, N, D, once, ahead);
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < D; i++) {
            size_t j = k * D + i;
            double after = k < N ? z[j + D] : 0;  /* at k = N: z_N / h */
            double before = k > 0 ? z[j - D] : 0; /* at k = 0: z_0 / h */
            ck_assert_ulp(twice[j], 4 * (z[j] - before), 0, "k=%zu", k);
            ck_assert_ulp(difference[j], twice[j], 0, "k=%zu", k);
            ck_assert_ulp(ahead[j], 4 * (z[j] - after), 0, "mirror, k=%zu", k);
        }
}
END_TEST
//< lemma

/* (7.7), exactly: alpha = 1/4 four times. alpha_n is an integer over 2^(3n), so all
 * sums are multiples of 2^(-3k), at most 2^4 * 8 * 2: exact while 3 k + 8 <= 53.
 * To rounding: alpha = 1/3 three times. Three sums, (k + 6) u each, times the sum
 * of absolute values, at most 2^3 max |z|; the double 1/3 is off by u / 3 relative,
 * which changes the weights of the result by less than u. Seen: 0.016 of it. */
START_TEST(eq_7_7_the_qth_part_q_times_is_a_difference)
{
    enum { N = 200, EXACT = 14 };
    double start[N + 1], z[N + 1], next[N + 1], difference[N + 1];
    for (size_t k = 0; k <= N; k++)
        start[k] = (double)((int)(3 * k * k) % 17 - 8);
    fvi_backward_difference(1, N, 1, start, difference);
    for (size_t q = 3; q <= 4; q++) {
        memcpy(z, start, sizeof z);
        for (size_t times = 0; times < q; times++) {
            fvi_delta_minus(1 / (double)q, 1, N, 1, z, next);
            memcpy(z, next, sizeof z);
        }
        for (size_t k = 0; k <= (q == 4 ? EXACT : N); k++)
            ck_assert_near(z[k], difference[k],
                           q == 4 ? 0 : (3 * ((double)k + 6) + 1) * U * 8 * 8,
                           "q=%zu k=%zu", q, k);
    }
}
END_TEST

/* (7.8): the L1 weights are h^(-1/2) / Gamma(3/2) times 1, sqrt(2) - 2, ... Six
 * roundings of numbers up to 4 in a weight, 12 u, two weights below 1 in each of
 * four products, 4 more roundings: 4/pi (4 * 2 * 12 + 4) u < 128 u. Seen: 10 u. */
START_TEST(eq_7_8_the_l1_rule_does_not_have_the_property)
{
    double l1[4] = { 1 }, c[4] = { 0 };
    for (int n = 1; n < 4; n++)
        l1[n] = sqrt(n + 1) - 2 * sqrt(n) + sqrt(n - 1);
    for (int k = 0; k < 4; k++) {
        for (int n = 0; n <= k; n++)
            c[k] += l1[n] * l1[k - n] * 4 / M_PI;
        ck_assert_near(c[k], ref_l1[k].want, 128 * U, "k=%d", k);
        double lemma = k == 0 ? 1 : k == 1 ? -1 : 0;
        ck_assert_msg(fabs(c[k] - lemma) > 0.01, "k=%d: %g", k, c[k]);
    }
}
END_TEST

/* What the printed induction step uses holds for 1, -1/2, -1/8, 0 as well, and
 * there the claim is false; and the term alpha_{k-1} alpha_1 x_0 counted twice. */
START_TEST(eq_7_10_the_printed_induction_proves_too_much)
{
    const double other[] = { 1, -0.5, -0.125, 0 };
    const double twice[] = { -1.0 / 4, -1.0 / 16, -1.0 / 32, -5.0 / 256 };
    double w[6];
    ck_assert_int_eq(fvi_gl_weights(0.5, 6, w), FVI_SUCCESS);
    ck_assert(2 * other[2] + other[1] * other[1] == 0);
    ck_assert(2 * other[3] + 2 * other[1] * other[2] == 0.125);
    ck_assert(2 * w[3] + 2 * w[1] * w[2] == 0);
    for (size_t k = 2; k <= 5; k++)
        ck_assert(-w[k - 1] * w[1] == twice[k - 2]);
}
END_TEST

/* ---- identities: the corollary ---- */

static const double one = 1, fifth = 0.2, x_start = 1, p_start = 0.5;

static fvi_run oscillator(fvi_system *system, double h, size_t steps)
{
    *system = (fvi_system){ .d = 1,
                            .mass = &one,
                            .damping = &fifth,
                            .potential = fvi_potential_harmonic(&one) };
    return (fvi_run){ .system = system,
                      .x0 = &x_start,
                      .p0 = &p_start,
                      .h = h,
                      .steps = steps,
                      .kappa = 0.5,
                      .alpha = 0.5,
                      .memory = FVI_HISTORY_DIRECT };
}

/* The three programs of one trajectory. */
static void three(const fvi_run *r, double *fractional, double *forced,
                  double *printed)
{
    int status = fvi_trajectory(&fvi_fractional, r, fractional, NULL, NULL);
    ck_assert_int_eq(status, FVI_SUCCESS);
    status = fvi_trajectory(&fvi_lagrange_dalembert, r, forced, NULL, NULL);
    ck_assert_int_eq(status, FVI_SUCCESS);
    status = fvi_algorithm_3(r->system, r->alpha, r->kappa, r->h, r->steps,
                             *r->x0, *r->p0, printed);
    ck_assert_int_eq(status, FVI_SUCCESS);
}

/* A step makes fewer than 24 roundings of numbers below 1.2 = max |x|, |p|, the
 * dust of (7.6) included; Algorithm 3 takes its momenta from differences of
 * rounded positions, 2 u 1.2 / h more. Errors of size e in each step never grow
 * beyond REF_GROWTH e. */
static double run_bound(double h, double growth)
{
    return growth * (24 + 2 / h) * U * 1.2;
}

/* (7.9) against the rationals, for the harmonic potential with kappa = 1/2 and the
 * quartic one with kappa = 1. There the map has a Lipschitz constant of at most
 * 2.25 in the maximum norm where |x| <= 1 (U'' <= 2.5): seven steps multiply by
 * less than sum 2.25^j, j < 7, = 233. Seen: 0.0022 of the bound. */
START_TEST(eq_7_9_three_programs_give_the_same_rationals)
{
    enum { N = LEN(ref_harmonic) - 1, N4 = LEN(ref_duffing) - 1 };
    const double cg[2] = { 1, 0.5 };
    double x[3][N + 1];
    fvi_system system;
    fvi_run run = oscillator(&system, 0.5, N);
    double bound = run_bound(0.5, REF_GROWTH_2);
    //> rationals
    three(&run, x[0], x[1], x[2]);
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < 3; i++)
            ck_assert_near(x[i][k], ref_harmonic[k], bound, "k=%zu", k);
    //< rationals
    run.alpha = 0.49; /* near 1/2 is not 1/2 */
    int status = fvi_trajectory(&fvi_fractional, &run, x[0], NULL, NULL);
    ck_assert_int_eq(status, FVI_SUCCESS);
    seen(fabs(x[0][N] - ref_harmonic[N]), "apart at alpha = 0.49");
    ck_assert(fabs(x[0][N] - ref_harmonic[N]) > 1e-3);
    run.alpha = 0.5;
    run.steps = N4;
    run.kappa = 1;
    system.potential = fvi_potential_duffing(cg);
    three(&run, x[0], x[1], x[2]);
    for (size_t k = 0; k <= N4; k++)
        for (size_t i = 0; i < 3; i++)
            ck_assert_near(x[i][k], ref_duffing[k], run_bound(0.5, 233),
                           "quartic, program %zu k=%zu", i, k);
}
END_TEST

/* T = 2000, h = 1/5: the difference stays at rounding level for 10000 steps while
 * the solution dies. Compare absolutely: below the dust of (7.6) the literal sum
 * has no digits. Its floor: errors made before k = 3 N/4 have died out (0.98^2500);
 * in a later step the dust pushes by at most rho max |c_n| sum |x|, n >= N/2, as
 * |x| has died out in the other half. Seen: 0.0055 of the bounds. */
START_TEST(eq_7_9_to_rounding_over_long_runs)
{
    enum { N = 10000 };
    static double fractional[N + 1], forced[N + 1], printed[N + 1], c[N + 1];
    fvi_system system;
    fvi_run run = oscillator(&system, 0.2, N);
    three(&run, fractional, forced, printed);
    const double bound = run_bound(0.2, REF_GROWTH_5);
    double largest = 0, path = 0, apart = 0;
    fvi_gl_weights_product(0.5, 0.5, N + 1, c);
    for (size_t k = 0; k <= N; k++) {
        ck_assert_near(fractional[k], forced[k], bound, "fvi, k=%zu", k);
        ck_assert_near(printed[k], forced[k], bound, "printed, k=%zu", k);
        apart = larger(apart, fabs(printed[k] - forced[k]));
        path += fabs(forced[k]);
        largest = larger(largest, k < N / 2 ? 0 : fabs(c[k]));
    }
    /* the solution is gone, the literal double sum is not */
    ck_assert(fabs(forced[N]) < 1e-80 && fabs(fractional[N]) < 1e-80
              && printed[N] != 0);
    ck_assert_near(printed[N], 0, REF_GROWTH_5 * 0.2 * largest * path, "floor");
    seen(apart, "apart");
    seen(fabs(forced[N]), "solution");
    seen(fabs(printed[N]), "floor");
}
END_TEST

/* (7.9) without any propagation of errors, for a nonlinear chain in R^3 with a
 * force, unequal dampings (one of them zero) and kappa = 0.3: the trajectory of
 * the Lagrange-d'Alembert integrator put into the paper's fractional equation,
 * its double sums as printed. Rounding: x_{k-1}, x_k, x_{k+1} are off by u |x|
 * each, times m/h and h U''; Newton and the evaluation leave some 20 u of the
 * momenta, the double sum 2 (k + 6) u 4 max|x| / h. Seen: 0.074 of the bound. */
START_TEST(eq_7_9_forced_runs_solve_the_printed_equation)
{
    enum { N = 300, D = 3 };
    const double h = 0.1, kappa = 0.3, cg[2] = { 1, 0.5 }, aw[2] = { 0.3, 1.7 };
    const double mass[D] = { 1, 2, 0.5 }, damping[D] = { 0.2, 0, 0.7 };
    const double x0[D] = { 0.5, -0.3, 0.8 }, p0[D] = { 0, 1, -0.5 };
    const double most = 1.5; /* of |x|: then U'' <= 58 */
    double x[(N + 1) * D], DD[(N + 1) * D], D1[D], D2[D], F[D];
    fvi_system system;
    fvi_run run = oscillator(&system, h, N);
    system = (fvi_system){
        D, mass, damping, fvi_potential_chain(cg), fvi_force_cosine(aw), NULL, NULL
    };
    run.x0 = x0;
    run.p0 = p0;
    run.kappa = kappa;
    int status = fvi_trajectory(&fvi_lagrange_dalembert, &run, x, NULL, NULL);
    ck_assert_int_eq(status, FVI_SUCCESS);
    ck_assert_int_eq(fvi_delta_twice(0.5, h, N, D, x, DD), FVI_SUCCESS);
    for (size_t k = 1; k < N; k++) {
        const double *now = x + k * D;
        fvi_discrete_slopes(&system, kappa, h, now, now + D, D1, NULL);
        fvi_discrete_slopes(&system, kappa, h, now - D, now, NULL, D2);
        system.force.value((double)k * h, D, system.force.params, F);
        for (size_t i = 0; i < D; i++) {
            double left =
                D1[i] + D2[i] - h * damping[i] * DD[k * D + i] + h * F[i];
            double bound =
                (4 * mass[i] * most / h
                 + 20 * (fabs(D1[i]) + fabs(D2[i]) + h * fabs(F[i]))
                 + 3 * 58 * h * most + damping[i] * 8 * ((double)k + 6) * most)
                * U;
            ck_assert(fabs(now[i]) < most);
            ck_assert_near(left, 0, bound, "k=%zu i=%zu", k, i);
        }
    }
}
END_TEST

/* ---- errors ---- */

START_TEST(bad_arguments_are_refused_and_outputs_are_untouched)
{
    const double orders[] = { -0x1p-1074, 2 + 0x1p-51, GSL_NAN, GSL_POSINF };
    const double steps[] = { 0, -1, GSL_NAN, GSL_POSINF }, z[2] = { 1, 2 };
    double out[2] = { 7, 8 };
    int (*product)(double, double, size_t, double *) = fvi_gl_weights_product;
    int (*twice)(double, double, size_t, size_t, const double *, double *);
    int (*difference)(double, size_t, size_t, const double *, double *);
    twice = fvi_delta_twice;
    difference = fvi_backward_difference;
    ck_assert_int_eq(product(0.5, 0.5, 2, NULL), FVI_EFAULT);
    ck_assert_int_eq(product(0.5, 0.5, 0, out), FVI_EINVAL);
    ck_assert_int_eq(product(0.5, 0.5, SIZE_MAX / 16 + 1, out), FVI_EINVAL);
    ck_assert_int_eq(product(0.5, 0.5, SIZE_MAX / 64, out), FVI_ENOMEM);
    ck_assert_int_eq(twice(0.5, 1, 1, 1, NULL, out), FVI_EFAULT);
    ck_assert_int_eq(twice(0.5, 1, 1, 1, z, NULL), FVI_EFAULT);
    ck_assert_int_eq(twice(0.5, 1, 1, 0, z, out), FVI_EINVAL);
    ck_assert_int_eq(twice(0.5, 1, SIZE_MAX, 1, z, out), FVI_EINVAL);
    ck_assert_int_eq(twice(0.5, 1, SIZE_MAX / 16, 2, z, out), FVI_EINVAL);
    ck_assert_int_eq(twice(0.5, 1, SIZE_MAX / 32, 1, z, out), FVI_ENOMEM);
    ck_assert_int_eq(difference(1, 1, 1, NULL, out), FVI_EFAULT);
    ck_assert_int_eq(difference(1, 1, 1, z, NULL), FVI_EFAULT);
    ck_assert_int_eq(difference(1, 1, 0, z, out), FVI_EINVAL);
    ck_assert_int_eq(difference(1, SIZE_MAX, 1, z, out), FVI_EINVAL);
    for (size_t j = 0; j < 4; j++) {
        ck_assert_int_eq(product(orders[j], 0.5, 2, out), FVI_EDOM);
        ck_assert_int_eq(product(0.5, orders[j], 2, out), FVI_EDOM);
        ck_assert_int_eq(twice(orders[j], 1, 1, 1, z, out), FVI_EDOM);
        ck_assert_int_eq(twice(0.5, steps[j], 1, 1, z, out), FVI_EDOM);
        ck_assert_int_eq(difference(steps[j], 1, 1, z, out), FVI_EDOM);
    }
    ck_assert(out[0] == 7 && out[1] == 8);
    ck_assert_int_eq(product(2, 2, 2, out), FVI_SUCCESS); /* the last taken */
    ck_assert(out[0] == 1 && out[1] == -4);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("07 half derivative");
    ADD_CASE(suite, "values", eq_7_2_products_match_the_definition,
             eq_7_1_two_derivatives_match_the_double_sum);
    ADD_CASE(suite, "lemma", eq_7_3_half_a_derivative_twice_is_a_difference);
    ADD_CASE(suite, "identities",
             eq_7_6_the_weights_vanish_exactly_and_then_but_for_rounding,
             eq_7_5_the_lemma_is_segners_recurrence,
             eq_7_7_the_qth_part_q_times_is_a_difference,
             eq_7_8_the_l1_rule_does_not_have_the_property,
             eq_7_10_the_printed_induction_proves_too_much,
             eq_7_9_three_programs_give_the_same_rationals,
             eq_7_9_to_rounding_over_long_runs,
             eq_7_9_forced_runs_solve_the_printed_equation);
    ADD_CASE(suite, "errors",
             bad_arguments_are_refused_and_outputs_are_untouched);
    return run_suite(suite);
}
