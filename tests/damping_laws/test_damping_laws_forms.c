/* tests/damping_laws/test_damping_laws_forms.c -- H 26: laws on stages: form M and its load, and the derivatives of
 * both forms.
 * Run alone: make test-damping_laws_forms */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include "harness/ulp.h"
#include "law_runs.h"
#include "kernel/kernel_terms.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_rng.h>
#include <stdlib.h>

enum { N = 1000 };

static const double one = 1;

static const fvi_method *const form_m[] = { &fvi_lobatto_m2, &fvi_lobatto_m3,
                                            &fvi_lobatto_m4 };

/* The errors of x and p at t = 4 of a spring that is kicked off. */
static void errors(const fvi_method *method, const fvi_kernel *law, size_t steps,
                   double off[2])
{
    static double x[2 * N], p[2 * N];
    const double p0 = 0.7, t = 4;
    const fvi_linear_oscillator exact = {
        .m = 1, .c = 1, .rho = 1, .x0 = 1, .v0 = p0, .law = law
    };
    const fvi_system system = { 1,     &one, &one, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &p0, t / (double)steps, steps);
    run.law = law;
    ck_assert_int_eq(fvi_exact_at(&exact, 1, &t, &off[0], &off[1], NULL), 0);
    ck_assert_int_eq(fvi_trajectory(method, &run, x, p, NULL), 0);
    off[0] -= x[steps];
    off[1] -= p[steps];
}

/* (17.13) with the highest order of a law for 2 alpha, which is 0 of a fraction: twelve
 * laws, while the errors are above rounding. */
START_TEST(eq_26_12_orders_of_form_m)
{
    for (size_t l = 0; l < LAWS; l++)
        for (int m = 0; m < 3; m++) {
            const fvi_kernel *law = law_of(l);
            const double s = m + 2, top = fvi_kernel_growth(law);
            double off[2][2];
            for (int i = 0; i < 2; i++)
                errors(form_m[m], law, (size_t)(m == 2 ? 80 : 320) << i,
                       off[i]);
            for (int i = 0; i < 2; i++) {
                const double want = smaller(2 * s - 2, s + 2 - i - top),
                             order = log2(fabs(off[0][i] / off[1][i]));
                if (fabs(off[1][i]) < 2e-13)
                    continue;
                seen(want - order, i ? "p short" : "x short");
                /* above: two powers of h meet; seen 0.73 */
                ck_assert_msg(order > want - 0.4 && order < want + 0.8,
                              "law %zu %s %c: %g, %g", l, form_m[m]->name,
                              "xp"[i], off[0][i], off[1][i]);
            }
        }
}
END_TEST

/* A Duffing oscillator, kicked off, by the changes of x(4) when steps are halved: the same
 * orders. */
START_TEST(eq_26_12_orders_of_form_m_on_a_nonlinear_problem)
{
    static double x[8 * N];
    const double p0 = 0.7, spring[] = { 1, 1 };
    for (size_t l = 0; l < LAWS; l++)
        for (int m = 0; m < 2; m++) {
            const fvi_system system = { 1,     &one,
                                        &one,  fvi_potential_duffing(spring),
                                        { 0 }, NULL, NULL };
            double end[3];
            for (int i = 0; i < 3; i++) {
                const size_t steps = (size_t)160 << i;
                fvi_run run = fvi_run_default(&system, &one, &p0,
                                              4 / (double)steps, steps);
                run.law = law_of(l);
                ck_assert_int_eq(fvi_trajectory(form_m[m], &run, x, NULL, NULL),
                                 0);
                end[i] = x[steps];
            }
            const double want =
                smaller(2 * m + 2, m + 4 - fvi_kernel_growth(law_of(l)));
            const double order =
                log2(fabs((end[1] - end[0]) / (end[2] - end[1])));
            seen(want - order, "short");
            ck_assert_msg(order > want - 0.4 && order < want + 0.5,
                          "law %zu %s: %g", l, form_m[m]->name, order);
        }
}
END_TEST

/* A law of two random terms; with no fraction of an order above 1 if it is proper. */
static fvi_kernel random_law(gsl_rng *random, int proper, fvi_kernel_term term[2])
{
    for (int i = 0; i < 2; i++) {
        const fvi_kernel_kind kind = (fvi_kernel_kind)gsl_rng_uniform_int(random, 4);
        double a = 0.01 + 0.97 * gsl_rng_uniform(random);
        if (proper && kind == FVI_KERNEL_ZENER)
            a /= 2;
        term[i] = (fvi_kernel_term){ kind, pow(10, 2 * gsl_rng_uniform(random)), a,
                                  pow(10, 2 * gsl_rng_uniform(random) - 1),
                                  a + (1 - a) / 2 };
    }
    return (fvi_kernel){ 2, term };
}

static double load_at(size_t s, const fvi_kernel *law, double c, double h)
{
    const fvi_system system = { 1,     &one, &one, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &one, &one, h, 1);
    double load = 0;
    run.law = law;
    run.alpha = 1; /* is not read */
    ck_assert_int_eq(fvi_stability_lobatto(s, &run, &load), 0);
    return load;
}

/* To the 1e-12 of stability.h. Seen: 2e-15. */
START_TEST(eq_26_13_the_load_of_two_stages)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_taus2);
    for (int i = 0; i < 200; i++) {
        fvi_kernel_term term[2];
        const fvi_kernel law = random_law(random, 0, term);
        const double c = 4 * gsl_rng_uniform(random),
                     h = pow(10, 2 * gsl_rng_uniform(random) - 2);
        double complex slope;
        const double complex C =
            fvi_kernel_at(&law, 2 / h * (0.5 + I * sqrt(0.75)), &slope);
        const double want =
            larger(0, h * h * (c + creal(C) - cimag(C) / sqrt(3)) / 4);
        ck_assert_near(load_at(2, &law, c, h), want, 1e-12 * larger(1, want),
                       "%d", i);
    }
    gsl_rng_free(random);
}
END_TEST

/* A term of order 0 is a spring, and one more c: the load of three and four stages at both
 * ends of the circle, to 1e-12. */
START_TEST(eq_26_13_springs_are_springs)
{
    const fvi_kernel_term spring[] = { { FVI_KERNEL_POWER, 3, 0.25, 0, 0 },
                                    { FVI_KERNEL_POWER, 2, 0, 0, 0 },
                                    { FVI_KERNEL_ZENER, 8, 0, 3, 0 } };
    for (size_t s = 2; s <= 6; s++)
        for (double h = 0.25; h < 8; h *= 1.3) {
            const double with = load_at(s, &(fvi_kernel){ 3, spring }, 1, h),
                         without = load_at(s, &(fvi_kernel){ 1, spring }, 5, h);
            ck_assert_near(with, without, 1e-12 * larger(1, without), "%zu %g",
                           s, h);
        }
}
END_TEST

/* The largest |x| of the second half of a run over that of the first. */
static double growth_of(size_t s, const fvi_kernel *law, double c, double h)
{
    static double x[N + 1];
    const double x0 = 0.3;
    const fvi_system system = { 1,     &one, &one, fvi_potential_harmonic(&c),
                                { 0 }, NULL, NULL };
    fvi_run run = fvi_run_default(&system, &x0, &one, h, N);
    double half[2] = { 0, 0 };
    run.law = law;
    const int status = fvi_trajectory(form_m[s - 2], &run, x, NULL, NULL);
    ck_assert(status == 0 || status == FVI_EOVRFLW);
    if (status)
        return INFINITY;
    for (size_t k = 1; k <= N; k++)
        half[k > N / 2] = larger(half[k > N / 2], fabs(x[k]));
    return half[1] / half[0];
}

/* Random laws and steps, as eq_17_18_runs_grow_where_the_load_says_so: left out is where
 * the verdict changes within 5 % of h. Half of the laws have no fraction of an order above 1. */
START_TEST(eq_26_13_runs_grow_where_the_load_says_so)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_taus2);
    size_t counts[2] = { 0 };
    for (size_t i = 0; i < 500; i++) {
        fvi_kernel_term term[2];
        const size_t s = 2 + i % 3;
        const fvi_kernel law = random_law(random, i % 2, term);
        const double c = 12 * gsl_pow_2(gsl_rng_uniform_pos(random)),
                     h = pow(10, 1.3 * gsl_rng_uniform(random) - 1);
        int verdict[3];
        for (int j = 0; j < 3; j++)
            verdict[j] = load_at(s, &law, c, (0.95 + 0.05 * j) * h) > 1;
        if (verdict[0] != verdict[1] || verdict[1] != verdict[2])
            continue;
        const double growth = growth_of(s, &law, c, h);
        counts[verdict[0]]++;
        seen(smaller(growth, 1e300), verdict[0] ? "above" : "below");
        ck_assert_msg(verdict[0] ? growth > 5 : growth < 1.1,
                      "%zu: s=%zu c=%g h=%g: %g", i, s, c, h, growth);
    }
    seen((double)counts[1], "unstable runs");
    ck_assert_uint_ge(counts[0], 100);
    ck_assert_uint_ge(counts[1], 80);
    gsl_rng_free(random);
}
END_TEST

/* ---- derivatives ---- */

/* x_40 of a Duffing oscillator by x0, p0, m, rho, and by the factor of each term: the
 * differences are off by some 1e-8 of derivatives of the order of 1. Seen: 9e-9. */
START_TEST(eq_23_15_derivatives_of_steep_laws)
{
    const fvi_method *const methods[] = { &fvi_lobatto_m2, &fvi_lobatto_m4,
                                          &fvi_lobatto_d2, &fvi_lobatto_d4 };
    for (size_t l = 0; l < LAWS; l++)
        for (size_t m = 0; m < LEN(methods); m++)
            ck_assert_law_slopes(methods[m], law_of(l), 40, 1e-7);
}
END_TEST

/* The tail of a Zener element of a tiny order has 390,000 terms and more: it is what they make, added one by
 * one from the definition, in long double, and then the rest of a geometric sequence. Seen: 1e-15, 7e-16. */
START_TEST(a_tiny_order_has_the_tail_of_its_terms)
{
    const double times[] = { 1e-3, 1, 200 }, alphas[] = { 1e-4, 3e-5 };
    const double step = 0.5, first = -3, ln_h = log(0.1);
    for (size_t i = 0; i < LEN(times) * LEN(alphas); i++) {
        const double T = times[i % LEN(times)], alpha = alphas[i / LEN(times)];
        const fvi_kernel_simple zener = { 1, alpha, T, alpha };
        long double sum[2] = { 0, 0 }, now = 0;
        double S[2] = { 0.25, 0 };
        const size_t terms = (size_t)(30 / (alpha * step));
        const long double fall = expl(-2 * (long double)alpha * step), e_fall = expl(-(long double)step);
        long double complex z = 0;
        long double e = 0;
        for (size_t k = 1; k <= terms; k++, z *= fall, e *= e_fall) {
            if (k % 64 == 1) { /* 64 products in between are right to 1e-17 */
                const long double at = first - (long double)k * step;
                z = cexpl(2 * alpha * (at - ln_h + I * acosl(-1.0L)));
                e = expl(at);
            }
            now = cimagl(z / (1 + T * z));
            sum[0] += now;
            sum[1] += now * e;
        }
        sum[0] += now / expm1l(2 * (long double)alpha * step);
        fvi_kernel_tail(&zener, 1, ln_h, first, step, 0, &S[0], &S[1]);
        ck_assert_near(S[0] - 0.25, (double)sum[0], 1e-14 * (double)sum[0], "%zu", i);
        ck_assert_near(S[1], (double)sum[1], 1e-14 * (double)sum[1], "%zu", i);
    }
}
END_TEST

/* It costs no more than another: a body on a spring and, in the limit, on half a spring of 0.3 beyond. */
START_TEST(a_tiny_order_ends_and_is_half_a_spring)
{
    const fvi_kernel law = { 1, &(fvi_kernel_term){ FVI_KERNEL_ZENER, .rho = 0.3, .alpha = 1e-12,
                                                    .time = 1 } };
    const double p0 = 0.5, spring = 1, w = sqrt(1.15), middle = 0.15 / 1.15;
    static double x[101], p[101];
    const fvi_system system = { .d = 1, .mass = &one, .damping = &one,
                                .potential = fvi_potential_harmonic(&spring) };
    const fvi_run run = { .system = &system, .x0 = &one, .p0 = &p0, .h = 0.1, .steps = 100,
                          .law = &law };
    ck_assert_int_eq(fvi_trajectory(&fvi_lobatto_m4, &run, x, p, NULL), 0);
    /* ln omega times the order is below 1e-10, the method's error below 1e-9 */
    ck_assert_near(x[100], middle + (1 - middle) * cos(w * 10) + p0 / w * sin(w * 10), 1e-9,
                   "half a spring");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("damping_laws, forms");
    ADD_CASE(suite, "form M", eq_26_12_orders_of_form_m,
             eq_26_12_orders_of_form_m_on_a_nonlinear_problem,
             eq_26_13_the_load_of_two_stages, eq_26_13_springs_are_springs,
             eq_26_13_runs_grow_where_the_load_says_so);
    ADD_CASE(suite, "tiny orders", a_tiny_order_has_the_tail_of_its_terms,
             a_tiny_order_ends_and_is_half_a_spring);
    ADD_CASE(suite, "derivatives", eq_23_15_derivatives_of_steep_laws);
    return run_suite(suite);
}
