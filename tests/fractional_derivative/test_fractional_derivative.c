/* tests/fractional_derivative/test_fractional_derivative.c -- H 1: the fractional derivatives.
 * Run alone: make test-fractional_derivative */
#include <fvi/paper/integration_by_parts.h>
#include "fractional_derivative_curves.h"

#include "fractional_derivative_ref.h"

#include <gsl/gsl_fit.h>
#include <gsl/gsl_integration.h>

/* ---- the curves ---- */

static double ddsine(double t, const void *p)
{
    return -gsl_pow_2(*(const double *)p) * sin(*(const double *)p * t);
}
static double decay(double t, const void *p)
{
    (void)p;
    return exp(-2 * t);
}
static double ddecay(double t, const void *p)
{
    return -2 * decay(t, p);
}
static double cubic(double t, const void *p)
{
    (void)p;
    return t * t * t - t + 1;
}
static double dcubic(double t, const void *p)
{
    (void)p;
    return 3 * t * t - 1;
}
static double ddcubic(double t, const void *p)
{
    (void)p;
    return 6 * t;
}
static double runge(double t, const void *p)
{
    (void)p;
    return 1 / (1 + t * t);
}
static double drunge(double t, const void *p)
{
    return -2 * t * gsl_pow_2(runge(t, p));
}

static const double THREE = 3;
static const fvi_curve curves[] = { { sine, dsine, &THREE },
                                    { decay, ddecay, NULL },
                                    { cubic, dcubic, NULL },
                                    { runge, drunge, NULL } };
static const fvi_curve slow_cosine = { dsine, ddsine, &ONE };
static const fvi_curve dcubic_curve = { dcubic, ddcubic, NULL };

/* The scale of (1.5): no f with |f'| <= largest has a larger derivative. */
static double scale_of(double alpha, double u, double largest)
{
    return pow(u, 1 - alpha) / tgamma(2 - alpha) * largest;
}

/* ---- values ---- */

/* (1.3) to (1.5). The quadrature is asked for 1e-13 M, M the scale; f' in the
 * test is good to 4 u max |f'|, its argument to u, times |f''| <= 3 max |f'| and
 * weighed like f' itself; mean, power, gamma: 20 u. Together 1e-13 + 30 u of M.
 * The term of the end: 20 u of its size, f to 4 u. Order 0: f itself, 8 u of 25,
 * the largest |f| there is. Seen: 0.06 of the bound. */
START_TEST(eq_1_3_1_4_both_derivatives_on_both_sides)
{
    for (size_t i = 0; i < LEN(ref_curves); i++) {
        double alpha = ref_curves[i].alpha, end = ref_curves[i].end;
        double t = ref_curves[i].t, u = fabs(t - end), caputo, riemann;
        fvi_side side = ref_curves[i].side < 0 ? FVI_RETARDED : FVI_ADVANCED;
        const fvi_curve *c = &curves[ref_curves[i].curve];
        ck_assert_int_eq(fvi_caputo(side, alpha, end, c, t, &caputo),
                         FVI_SUCCESS);
        ck_assert_int_eq(
            fvi_riemann_liouville(side, alpha, end, c, t, &riemann),
            FVI_SUCCESS);
        double bound =
            (1e-13 + 30 * U) * scale_of(alpha, u, ref_curves[i].largest);
        double boundary = ref_curves[i].riemann - ref_curves[i].caputo;
        ck_assert_near(caputo, ref_curves[i].caputo, bound, "caputo row %zu",
                       i);
        ck_assert_near(riemann, ref_curves[i].riemann,
                       bound + 30 * U * fabs(boundary), "riemann row %zu", i);
    }
}
END_TEST

/* (1.6). z = g + 1 - order, z + 1 and z + 2 are rounded once, g + 1 once; Gamma
 * amplifies that by at most x psi(x) <= 26 (x < 12, where it is used); two gammas
 * of 4 u each, power, three products: 60 u = 30 to 60 ulp. Seen: 10. */
START_TEST(eq_1_6_powers_in_closed_form)
{
    for (size_t i = 0; i < LEN(ref_powers); i++)
        ck_assert_ulp(
            power(ref_powers[i].order, ref_powers[i].g, ref_powers[i].u),
            ref_powers[i].want, 60, "row %zu: order=%g g=%g u=%g", i,
            ref_powers[i].order, ref_powers[i].g, ref_powers[i].u);
}
END_TEST

/* The limits are handled, not approached: 0 ulp. */
START_TEST(eq_1_11_orders_zero_and_one_are_exact)
{
    const double a = 0.25, b = 1.75, t = 1.125;
    for (size_t i = 0; i < LEN(curves); i++) {
        const fvi_curve *c = &curves[i];
        double f = c->f(t, c->params), df = c->df(t, c->params), d;
        fvi_caputo(FVI_RETARDED, 0, a, c, t, &d);
        ck_assert_ulp(d, f - c->f(a, c->params), 0, "Caputo, back, %zu", i);
        fvi_caputo(FVI_ADVANCED, 0, b, c, t, &d);
        ck_assert_ulp(d, f - c->f(b, c->params), 0, "Caputo, ahead, %zu", i);
        fvi_riemann_liouville(FVI_RETARDED, 0, a, c, t, &d);
        ck_assert_ulp(d, f, 0, "Riemann-Liouville, order 0, %zu", i);
        fvi_riemann_liouville(FVI_RETARDED, 1, a, c, t, &d);
        ck_assert_ulp(d, df, 0, "D_- of order 1, %zu", i);
        fvi_riemann_liouville(FVI_ADVANCED, 1, b, c, t, &d);
        ck_assert_ulp(d, -df, 0, "D_+ of order 1, %zu", i);
        fvi_riemann_liouville(FVI_RETARDED, 1, t, c, t, &d);
        ck_assert_ulp(d, df, 0, "D_- of order 1 at its own end, %zu", i);
    }
    for (double g = 0; g < 5; g++) { /* and of powers: small integers */
        ck_assert_ulp(power(0, g, 2), pow(2, g), 0, "g=%g", g);
        ck_assert_ulp(power(1, g, 2), g * pow(2, g - 1), 0, "g=%g", g);
        ck_assert_ulp(power(2, g, 2), g * (g - 1) * pow(2, g - 2), 0, "g=%g",
                      g);
    }
}
END_TEST

/* At its own end a Caputo derivative of order < 1 has no memory yet. */
START_TEST(eq_1_5_at_the_end_caputo_is_zero)
{
    double d = GSL_NAN;
    for (double alpha = 0; alpha < 1; alpha += 0.125) {
        fvi_caputo(FVI_RETARDED, alpha, 0.5, &curves[2], 0.5, &d);
        ck_assert(d == 0);
        d = GSL_NAN; /* sin(0) = 0: nothing comes from the end */
        fvi_riemann_liouville(FVI_ADVANCED, alpha, 0, &curves[0], 0, &d);
        ck_assert(d == 0);
    }
}
END_TEST

/* ---- identities ---- */

/* (1.4) for f = 1: Caputo is 0, Riemann-Liouville t^(-1/2) / sqrt(pi) > 0. With
 * the printed minus it would be negative. Power, gamma, sqrt: 20 u. Seen: 2 u. */
//> sign
START_TEST(eq_1_4_the_end_enters_with_a_plus)
{
    for (double t = 0.1; t < 10; t *= 1.5) {
        double c, r, want = 1 / sqrt(M_PI * t);
        fvi_caputo(FVI_RETARDED, 0.5, 0, &constant, t, &c);
        fvi_riemann_liouville(FVI_RETARDED, 0.5, 0, &constant, t, &r);
        ck_assert(c == 0);
        ck_assert_near(r, want, 20 * U * want, "t=%g", t);
        ck_assert_near(power(0.5, 0, t), want, 20 * U * want, "t=%g", t);
    }
}
END_TEST
//< sign

/* (1.7), (1.8): int_0^1 F D_- G = int_0^1 (D_+ F) G for the cubic and exp(-2t),
 * neither of which vanishes at an end. The substitutions t = s^2 and 1 - t = s^2
 * make the integrands smooth (alpha = 1/2 leaves t^(-1/2) of the end values and
 * odd powers of sqrt t); Gauss-Legendre on 20 nodes is then good to 1e-14 of
 * int |F D G| < 4, the derivatives to 1.1e-13 of it. Seen: 2e-15. */
START_TEST(eq_1_7_1_8_integration_by_parts)
{
    const fvi_curve *F = &curves[2], *G = &curves[1];
    gsl_integration_glfixed_table *rule =
        gsl_integration_glfixed_table_alloc(20);
    double sums[3] = { 0 }, half_integral = 0; /* I_+^(1/2) F at 0 */
    for (size_t i = 0; i < 20; i++) {
        double s, weight, back, ahead, caputo;
        gsl_integration_glfixed_point(0, 1, i, &s, &weight, rule);
        double t = s * s;
        fvi_riemann_liouville(FVI_RETARDED, 0.5, 0, G, t, &back);
        fvi_caputo(FVI_RETARDED, 0.5, 0, G, t, &caputo);
        fvi_riemann_liouville(FVI_ADVANCED, 0.5, 1, F, 1 - t, &ahead);
        sums[0] += weight * 2 * s * F->f(t, NULL) * back;
        sums[1] += weight * 2 * s * ahead * G->f(1 - t, NULL);
        sums[2] += weight * 2 * s * F->f(t, NULL) * caputo;
        half_integral += weight * 2 * F->f(t, NULL) / sqrt(M_PI);
    }
    gsl_integration_glfixed_table_free(rule);
    ck_assert_near(sums[0], sums[1], 5e-13, "Riemann-Liouville: no end terms");
    ck_assert_near(sums[2], sums[1] - G->f(0, NULL) * half_integral, 5e-13,
                   "Caputo: G(0) I F(0) is left over");
}
END_TEST

/* (1.9) on powers; 60 u for each of the three derivatives. Seen: 3 ulp. */
START_TEST(eq_1_9_orders_add_on_powers)
{
    for (double g = 0; g < 4; g += 0.375)
        for (double a = 0; a <= 1; a += 0.125)
            for (double b = 0; b < 1; b += 0.125) { /* the inner order */
                double first = power(b, g, 1);      /* times u^(g - b) */
                ck_assert_ulp(first * power(a, g - b, 1.7),
                              power(a + b, g, 1.7), 180,
                              "g=%g alpha=%g beta=%g", g, a, b);
            }
}
END_TEST

/* (1.10): 1 + 2t + 3t^2, order 1/2 after order 1: t^(-3/2)/(2 sqrt(pi)) too much.
 * Three or two powers of 60 u each. And t^(-1/2), whose half derivative is an
 * exact zero, while its first derivative is not. */
//> semigroup
START_TEST(eq_1_10_orders_do_not_add_after_a_whole_derivative)
{
    for (double t = 0.25; t < 8; t *= 2) {
        double in_turn = 2 * power(0.5, 0, t) + 6 * power(0.5, 1, t);
        double at_once =
            power(1.5, 0, t) + 2 * power(1.5, 1, t) + 3 * power(1.5, 2, t);
        double left = pow(t, -1.5) / (2 * sqrt(M_PI));
        double size = left + 2 * fabs(in_turn);
        ck_assert_near(in_turn - at_once, left, 180 * U * size, "t=%g", t);
        ck_assert(left > 1000 * 180 * U * size); /* the difference is seen */
        ck_assert(power(0.5, -0.5, t) == 0 && power(1, -0.5, t) < 0);
    }
}
END_TEST
//< semigroup

/* The same on curves: D^(1/2) of f' against D^(3/2), for the cubic at a = 0,
 * f(0) = 1. 1.1e-13 of the scale 2 max|f''|, and 60 u a power. */
START_TEST(eq_1_10_on_a_curve)
{
    for (double t = 0.25; t <= 2; t += 0.25) {
        double d,
            at_once = power(1.5, 3, t) - power(1.5, 1, t) + power(1.5, 0, t);
        fvi_riemann_liouville(FVI_RETARDED, 0.5, 0, &dcubic_curve, t, &d);
        double bound = 1.1e-13 * scale_of(0.5, t, 6 * t)
                       + 100 * U * (1 + 6 * pow(t, 1.5) + pow(t, -1.5));
        ck_assert_near(d, at_once - power(1.5, 0, t), bound, "t=%g", t);
    }
}
END_TEST

/* (1.11): |D^alpha f - f'| = O(1 - alpha) for t > a, f(a) = 0. By (1.5) with
 * e = 1 - alpha: |f'(t) - mean| <= max|f''| u e/(1 + e), and u^e / Gamma(1 + e)
 * is 1 up to e (|ln u| + 0.58) times something below 2 here. Seen: 0.42 of it. */
START_TEST(eq_1_11_order_one_is_approached_like_one_minus_alpha)
{
    const double t = 1.3;
    for (double e = 0x1p-4; e > 0x1p-30; e /= 4) {
        double d, want = cos(t);
        fvi_caputo(FVI_RETARDED, 1 - e, 0, &slow_sine, t, &d);
        ck_assert_near(d, want, e * (t + 2 * (log(t) + 0.58)), "e=%g", e);
    }
}
END_TEST

/* (1.12): sin(t + alpha pi/2) - D^alpha sin(t), what was forgotten before t = 0,
 * lies between two powers. The quadrature: 1.1e-13 of its scale. */
START_TEST(eq_1_12_a_sine_forgets_its_beginning_like_a_power)
{
    for (double alpha = 0.125; alpha < 1; alpha += 0.125)
        for (double t = 4; t < 60; t += 3.5) {
            double d, first = alpha * pow(t, -1 - alpha) / tgamma(1 - alpha);
            fvi_caputo(FVI_RETARDED, alpha, 0, &slow_sine, t, &d);
            double forgotten = sin(t + alpha * M_PI / 2) - d;
            double error = 1.1e-13 * scale_of(alpha, t, 1) + 200 * U;
            ck_assert_msg(forgotten <= first + error, "t=%g", t);
            ck_assert_msg(forgotten
                              >= first * (1 - (1 + alpha) * (2 + alpha) / t / t)
                                     - error,
                          "t=%g alpha=%g", t, alpha);
        }
}
END_TEST

/* ---- order ---- */

/* (1.13): (Delta_-^alpha f - D^alpha f) / h at t = 1 tends to the predicted
 * constant, f(0) = 0 or not, and what is left is O(h). The slope fitted over
 * h = 1/64, ..., 1/1024 is 1 up to O(h). Seen: 0.54 of the bounds. */
static double predicted(double alpha, const fvi_curve *f, const fvi_curve *df)
{
    double of_velocity = GSL_NAN, at_end = f->f(0, f->params);
    fvi_riemann_liouville(FVI_RETARDED, alpha, 0, df, 1, &of_velocity);
    return -alpha / 2 * of_velocity + (1 - alpha) / 2 * at_end / tgamma(-alpha);
}

START_TEST(eq_1_13_grunwald_letnikov_has_order_one_at_fixed_t)
{
    enum { N = 1024, POINTS = 5 };
    static double f[N + 1], D[N + 1];
    const fvi_curve *pairs[][2] = { { &slow_sine, &slow_cosine },
                                    { &curves[2], &dcubic_curve } };
    for (int i = 0; i < 8; i++) {
        const fvi_curve *curve = pairs[i % 2][0];
        double alpha = 0.2 + 0.1 * i, exact, ln_h[POINTS], ln_e[POINTS], c[6];
        double limit = predicted(alpha, curve, pairs[i % 2][1]);
        fvi_riemann_liouville(FVI_RETARDED, alpha, 0, curve, 1, &exact);
        for (size_t n = 0, M = 64; n < POINTS; n++, M *= 2) {
            double h = 1 / (double)M;
            for (size_t k = 0; k <= M; k++)
                f[k] = curve->f((double)k * h, curve->params);
            fvi_delta_minus(alpha, h, M, 1, f, D);
            ck_assert_near((D[M] - exact) / h, limit, 3 * h, "alpha=%g M=%zu",
                           alpha, M);
            ln_h[n] = log(h);
            ln_e[n] = log(fabs(D[M] - exact));
        }
        gsl_fit_linear(ln_h, 1, ln_e, 1, POINTS, c, c + 1, c + 2, c + 3, c + 4,
                       c + 5);
        ck_assert_near(c[1], 1, 0.02, "slope, alpha=%g", alpha);
    }
}
END_TEST

/* Uniformly in k >= 1 the constant 1 diverges like h^-alpha: at k = 1 the sum is
 * (1 - alpha) h^-alpha, the derivative h^-alpha / Gamma(1 - alpha). */
START_TEST(eq_1_13_not_uniformly_up_to_the_end)
{
    const double f[] = { 1, 1 };
    for (double h = 0.1; h > 1e-9; h /= 10) {
        double D[2], want = (1 - 0.5 - 1 / sqrt(M_PI)) / sqrt(h);
        fvi_delta_minus(0.5, h, 1, 1, f, D);
        ck_assert_near(D[1] - power(0.5, 0, h), want, 40 * U / sqrt(h), "h=%g",
                       h);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("01 fractional_derivative");
    ADD_CASE(suite, "values", eq_1_3_1_4_both_derivatives_on_both_sides,
             eq_1_6_powers_in_closed_form,
             eq_1_11_orders_zero_and_one_are_exact,
             eq_1_5_at_the_end_caputo_is_zero);
    ADD_CASE(suite, "identities", eq_1_4_the_end_enters_with_a_plus,
             eq_1_7_1_8_integration_by_parts, eq_1_9_orders_add_on_powers,
             eq_1_10_orders_do_not_add_after_a_whole_derivative,
             eq_1_10_on_a_curve,
             eq_1_11_order_one_is_approached_like_one_minus_alpha,
             eq_1_12_a_sine_forgets_its_beginning_like_a_power);
    ADD_CASE(suite, "order", eq_1_13_grunwald_letnikov_has_order_one_at_fixed_t,
             eq_1_13_not_uniformly_up_to_the_end);
    return run_suite(suite);
}
