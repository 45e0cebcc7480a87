/* tests/expression/test_expression_enclosure.c -- Bounds of a force between two times.
 * Run alone: make test-expression_enclosure */
#include "parsed.h"

#include <gsl/gsl_rng.h>

static const char *const texts[] = {
    "3",
    "t",
    "-t*t+2",
    "cos(2*t)",
    "sin(t)^3*exp(-t/3)",
    "tan(t/7)",
    "tanh(4*(t-3))",
    "sinh(t)-cosh(t/2)",
    "atan(5*(t-2))*log(1+t)",
    "asin(sin(t)/2)+acos(cos(t)/3)",
    "sqrt(1+t)/(2+cos(t))",
    "1/(1+((t-2)/0.1)^2)",
    "exp(-((t-2.5)/0.2)^2)",
    "1/cosh((t-3)/0.1)^2",
    "(1+t)^1.7-(2+t)^(-3)+k^t",
    "abs(t-3)*cos(t)",
    "(t-2)^5+(t-2)^2*k",
    "-abs(-1-t)",
    "min(t-2,cos(3*t))*exp(t/5)",
    "max(1,t^2/4)-min(sin(t),-2)",
    "t*sign(t-2.5)",
    "sign(2+cos(t))*t+max(-t,-t)",
    "1+t*(1+t*(1+t*(1+t*(1+t*(1+t*(1+t*(1+t*(1+t*(1+t*(1+t*(1+t*(1+t/9))))))))))))",
};
static const double k = 1.25;
static const char *const letters[] = { "k" };
static const fvi_symbols of_time = { "t", 1, letters, 1 };

/* Derivative n over n! of F at t, by the complex integral on a small circle: here by high
 * differences, which are good to a few digits. */
static double difference(const fvi_expression *e, int n, double t, double step)
{
    double sum = 0, binomial = 1;
    for (int i = 0; i <= n; i++) {
        const double at = t + (i - n / 2.0) * step;
        sum += (i % 2 == n % 2 ? 1 : -1) * binomial
               * fvi_expression_value(e, &at);
        binomial *= (double)(n - i) / (i + 1);
    }
    for (int i = 1; i <= n; i++)
        sum /= i * step;
    return sum;
}

/* Bounds hold all values at random times in random intervals, wide and narrow, and the
 * first four derivatives, as differences have them. */
START_TEST(bounds_of_a_force_hold_what_it_does)
{
    enum { ORDER = FVI_BOUND_ORDER };
    gsl_rng *r = gsl_rng_alloc(gsl_rng_mt19937);
    for (size_t i = 0; i < LEN(texts); i++) {
        fvi_expression *e = parsed(texts[i], &of_time, &k);
        const fvi_force F = fvi_force_expression(e);
        for (int n = 0; n < 300; n++) {
            const double width = 4 * gsl_pow_int(0.7, n % 40),
                         from = (5 - width) * gsl_rng_uniform(r),
                         to = from + width, step = 0.01 * smaller(width, 0.2);
            double most[ORDER + 1], low = GSL_POSINF, high = GSL_NEGINF;
            ck_assert_int_eq(F.bound(from, to, ORDER, 1, F.params, most), 0);
            for (int m = 0; m < 60; m++) {
                const double t = from + width * gsl_rng_uniform(r),
                             value = fvi_expression_value(e, &t);
                low = smaller(low, value);
                high = larger(high, value);
                const double inner =
                    smaller(larger(t, from + 2 * step), to - 2 * step);
                for (int j = 1; j <= 4 && width > 0.1; j++) {
                    const double noise = 1e-14 * (1 + fabs(value))
                                         / gsl_pow_int(step / 2, j);
                    ck_assert_msg(fabs(difference(e, j, inner, step))
                                      <= most[j] * (1 + 1e-9) + noise,
                                  "%s, [%g, %g], t = %g, %d: %g, %g", texts[i],
                                  from, to, inner, j,
                                  difference(e, j, inner, step), most[j]);
                }
            }
            ck_assert_msg((high - low) / 2 <= most[0] + 1e-15 * fabs(high), "%s, [%g, %g]: %g, %g",
                          texts[i], from, to, (high - low) / 2, most[0]);
        }
        fvi_expression_free(e);
    }
    gsl_rng_free(r);
}
END_TEST

/* The bounds are near what they bound, where an expression has each name once. */
START_TEST(bounds_of_a_force_are_no_larger_than_they_must_be)
{
    static const struct {
        const char *text;
        double from, to;
        int order;
        double want;
    } cases[] = {
        { "3", 0, 20, 0, 0 },
        { "3", 0, 20, 1, 0 },
        { "t", 2, 5, 0, 1.5 },
        { "t", 2, 5, 1, 1 },
        { "t", 2, 5, 2, 0 },
        { "cos(2*t)", 0, 20, 0, 1 },
        { "cos(2*t)", 0, 20, 3, 8. / 6 },
        { "sin(t)", 1.2, 1.9, 0, (1 - 0.93203908596722629) / 2 },
        { "exp(t)", 0, 2, 2, 3.6945280494653252 },
        { "(t-1)^2", 0, 2, 0, 0.5 },
        { "1/t", 1, 2, 3, 1 },
        { "log(t)", 1, 2, 3, 1. / 3 },
        { "t^(-2)", 1, 4, 1, 2 },
        { "abs(t-1)", 0, 3, 1, 1 },
        { "abs(t-1)", 0, 3, 2, INFINITY },
        { "sign(t-1)", 0, 3, 0, 1 },
        { "sign(t-1)", 0, 3, 1, INFINITY },
        { "sign(t-1)", 2, 3, 0, 0 },
        { "sign(t-1)", 2, 3, 1, 0 },
        { "sign(-2)*t", 0, 3, 1, 1 },
        { "max(t,2*t-1)", 0, 3, 0, 2.5 },
        { "max(t,2*t-1)", 0, 3, 1, 2 },
        { "max(t,2*t-1)", 0, 3, 2, INFINITY },
        { "max(t,2*t-1)", 2, 3, 0, 1 },
        { "min(t,2*t-1)", 2, 3, 0, 0.5 },
        { "min(t,4)", 0, 3, 1, 1 },
        { "min(t,-4)", 0, 3, 1, 0 },
        { "min(t,2)", 0, 3, 0, 1 },
        { "min(t,2)", 0, 3, 1, 1 },
        { "1/(t-1)", 0, 3, 0, INFINITY },
        { "log(t-1)", 0, 3, 0, INFINITY },
        { "sqrt(t-1)", 0, 3, 0, INFINITY },
        { "tan(t)", 1, 2, 0, INFINITY },
        { "(t-9)^tanh(9*t)", 4, 8, 0, INFINITY },
    };
    for (size_t i = 0; i < LEN(cases); i++) {
        double most[FVI_BOUND_ORDER + 1];
        fvi_expression *e = parsed(cases[i].text, &of_time, &k);
        const fvi_force F = fvi_force_expression(e);
        ck_assert_int_eq(F.bound(cases[i].from, cases[i].to, FVI_BOUND_ORDER, 1,
                                 F.params, most),
                         0);
        const double got = most[cases[i].order], want = cases[i].want;
        ck_assert_msg(got == want
                          || (got >= want && got <= want + 1e-12 * (1 + want)),
                      "%s, %d: %.17g, %.17g", cases[i].text, cases[i].order,
                      got, want);
        fvi_expression_free(e);
    }
}
END_TEST

/* Far from a pulse, its bounds are as small as it is, though the numbers that it is made of
 * are out of range. */
START_TEST(bounds_far_from_a_pulse_are_small)
{
    static const char *const pulses[] = {
        "exp(-((t-5)/1e-6)^2)", "1/cosh((t-5)/1e-6)^2",
        "1/(exp((t-5)/1e-6)+exp(-(t-5)/1e-6))", "1-tanh((t-5)/1e-6)",
        "1/(1+((t-5)/1e-30)^2)"
    };
    for (size_t i = 0; i < LEN(pulses); i++) {
        double most[FVI_BOUND_ORDER + 1];
        fvi_expression *e = parsed(pulses[i], &of_time, &k);
        const fvi_force F = fvi_force_expression(e);
        ck_assert_int_eq(F.bound(6, 8, FVI_BOUND_ORDER, 1, F.params, most), 0);
        for (size_t j = 0; j <= FVI_BOUND_ORDER; j++)
            ck_assert_msg(most[j] < 1e-14, "%s, %zu: %g", pulses[i], j,
                          most[j]);
        ck_assert_int_eq(F.bound(4, 6, FVI_BOUND_ORDER, 1, F.params, most), 0);
        ck_assert(most[0] >= 0.25 && most[1] > 1e5);
        fvi_expression_free(e);
    }
}
END_TEST

/* The forces that are ready made have theirs. */
START_TEST(bounds_of_ready_forces)
{
    static const double aw[2] = { -3, 2 }, aT[2] = { -3, 2 };
    double most[8];
    fvi_force F = fvi_force_cosine(aw);
    ck_assert_int_eq(F.bound(1, 9, 3, 2, F.params, most), 0);
    const double want[] = { 3, 6, 6, 4 };
    for (size_t i = 0; i < 8; i++)
        ck_assert_near(most[i], want[i / 2], 1e-12, "%zu", i);
    F = fvi_force_step(aT);
    ck_assert_int_eq(F.bound(1, 9, 1, 2, F.params, most), 0);
    ck_assert(most[0] == 1.5 && most[1] == 1.5 && most[2] == INFINITY);
    ck_assert_int_eq(F.bound(2, 9, 1, 2, F.params, most), 0);
    ck_assert(most[0] == 0 && most[3] == 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("expressions: what they can be");
    ADD_CASE(suite, "bounds", bounds_of_a_force_hold_what_it_does,
             bounds_of_a_force_are_no_larger_than_they_must_be,
             bounds_far_from_a_pulse_are_small, bounds_of_ready_forces);
    return run_suite(suite);
}
