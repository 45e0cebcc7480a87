/* tests/restricted_principle/test_restricted_principle_past.c -- H 3: an action with a given past.
 * Run alone: make test-restricted_principle_past */
#include <fvi/error.h>
#include <fvi/paper/restricted_principle.h>
#include "harness/ulp.h"

#include <math.h>

enum { ORDER = 32, TERMS = ORDER * ORDER, ALL = 2 + 2 * TERMS };

static const double T = 2, mass = 2, damping = 0.5, nothing = 0, spring = 3;

/* Powers that begin with a constant and s: what is left without these two is
 * the curve less its reference. */
typedef struct {
    double exponent[ALL], coefficient[ALL];
} series;

static fvi_powers curve(const series *f)
{
    return (fvi_powers){ ALL, f->exponent, f->coefficient };
}

static fvi_powers without_reference(const series *f)
{
    return (fvi_powers){ ALL - 2, f->exponent + 2, f->coefficient + 2 };
}

/* m x'' + c x + rho D D (x - zeta) = 0, x(0) = x0, x'(0) = v0. With r, the series
 * (3.9), and I, the integral from 0: x = x0 + (v0 r - (c/m) x0 I r) if the body was
 * held, x = x0 + v0 s - (c/m) (x0 I r + v0 I I r) if it came along a line. */
static void solve(double alpha, int line, double x0, double v0, series *x)
{
    const double C = spring / mass;
    double e[TERMS], r[TERMS];
    ck_assert_int_eq(fvi_damped_powers(alpha, C, damping / mass, ORDER, e, r),
                     FVI_SUCCESS);
    x->exponent[0] = 0, x->coefficient[0] = x0;
    x->exponent[1] = 1, x->coefficient[1] = line ? v0 : 0;
    for (size_t j = 0; j < TERMS; j++) {
        const double once = r[j] / (e[j] + 1);
        const size_t at = 2 + 2 * j;
        x->exponent[at] = e[j] + 1;
        x->coefficient[at] = -C * x0 * once;
        x->exponent[at + 1] = line ? e[j] + 2 : e[j];
        x->coefficient[at + 1] = line ? -C * v0 * once / (e[j] + 2) : v0 * r[j];
    }
}

/* t^2 (T - t) from both ends. */
static const double whole[] = { 0, 1, 2, 3 }, from_left[] = { 0, 0, 2, -1 },
                    from_right[] = { 0, 4, -4, 1 };
static const fvi_powers xi = { 4, whole, from_left },
                        eta = { 4, whole, from_right };

static double variation(const double *rho, fvi_potential u, double alpha,
                        const fvi_powers *x, const fvi_powers *y,
                        const fvi_powers *left, const fvi_powers *right)
{
    const fvi_system system = {
        .d = 1, .mass = &mass, .damping = rho, .potential = u
    };
    double dS = 0;
    ck_assert_int_eq(
        fvi_action_variation(&system, alpha, T, x, y, left, right, &dS),
        FVI_SUCCESS);
    return dS;
}

/* The variation of (3.20): of the curves x, y without damping, and what the damping
 * adds to an action without potential at f, g. */
static double with_references(double alpha, const fvi_powers *x,
                              const fvi_powers *y, const fvi_powers *f,
                              const fvi_powers *g)
{
    const fvi_potential none = { 0 }, u = fvi_potential_harmonic(&spring);
    return variation(&nothing, u, alpha, x, y, &xi, &eta)
           + variation(&damping, none, alpha, f, g, &xi, &eta)
           - variation(&nothing, none, alpha, f, g, &xi, &eta);
}

/* The integral of the sizes of all terms that with_references adds up. */
static double sizes(double alpha, const series *x, const series *y)
{
    static series X, Y;
    for (size_t j = 0; j < ALL; j++) {
        X.exponent[j] = x->exponent[j];
        Y.exponent[j] = y->exponent[j];
        X.coefficient[j] = fabs(x->coefficient[j]);
        Y.coefficient[j] = fabs(y->coefficient[j]);
    }
    const double left[] = { 0, 0, 2, 1 }, right[] = { 0, 4, 4, 1 };
    const fvi_powers p = { 4, whole, left }, q = { 4, whole, right };
    const fvi_powers a = curve(&X), b = curve(&Y), f = without_reference(&X),
                     g = without_reference(&Y);
    const fvi_potential none = { 0 }, u = fvi_potential_harmonic(&spring);
    double kinetic = variation(&nothing, none, alpha, &a, &b, &p, &q);
    return 3 * kinetic
           + fabs(variation(&nothing, u, alpha, &a, &b, &p, &q) - kinetic)
           + fabs(variation(&damping, none, alpha, &f, &g, &p, &q)
                  - variation(&nothing, none, alpha, &f, &g, &p, &q));
}

/* (3.21). x was held at 3/4 or came along a line, y likewise from the other end,
 * from another start; both move at the start. Along a restricted variation delta S
 * is zero: to the bound of the header, (n + 300) u, twice for the two parts, and
 * 100 u for the series, n = 2050. With the damping on x and y themselves it is not,
 * unless alpha = 1/2 and the body was held. Seen: 1.9e-6 of it. */
//> stationary
static void ck_assert_stationary(double alpha, int line, int counts)
{
    static series x, y;
    solve(alpha, line, 0.75, 0.5, &x);
    solve(alpha, line, -0.5, 1, &y);
    const fvi_powers a = curve(&x), b = curve(&y), f = without_reference(&x),
                     g = without_reference(&y);
    double dS = with_references(alpha, &a, &b, &f, &g);
    ck_assert_near(dS, 0, 2 * (ALL + 400) * U * sizes(alpha, &x, &y),
                   "alpha=%g line=%d", alpha, line);
    double printed = variation(&damping, fvi_potential_harmonic(&spring), alpha,
                               &a, &b, &xi, &eta);
    ck_assert_msg((fabs(printed) > 0.01) == counts, "alpha=%g line=%d: %g",
                  alpha, line, printed);
    seen(fabs(dS), "restricted");
}

START_TEST(eq_3_21_a_damping_with_a_past_is_stationary)
{
    ck_assert_stationary(0.1, 0, 1);
    ck_assert_stationary(0.25, 0, 1);
    ck_assert_stationary(0.5, 0, 0);
    ck_assert_stationary(0.6, 0, 1);
    ck_assert_stationary(0.75, 0, 1);
    ck_assert_stationary(0.6, 1, 1);
    ck_assert_stationary(0.75, 1, 1);
}
END_TEST
//< stationary

int main(void)
{
    Suite *suite = suite_create("restricted_principle_past");
    ADD_CASE(suite, "identities", eq_3_21_a_damping_with_a_past_is_stationary);
    return run_suite(suite);
}
