/* tests/exact_solution/test_exact_solution_rows.c -- Chapter 11: all rows at once.
 * Run alone: make test-exact_solution_rows */
#include "exact_problems.h"

#include <stdlib.h>

enum { PROBLEMS = 600, LOOKED_AT = 64 };

/* A uniform number in [0, 1), the same ones at every run. */
static double chance(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static double between(uint64_t *seed, double low, double high)
{
    return low * pow(high / low, chance(seed));
}

/* Any past, order and force; without spring or damping now and then; forces near
 * resonance; strong and weak damping. *h n is from 1/100 to 10^4 swings of the spring. */
static fvi_linear any(uint64_t *seed, size_t n, double *h)
{
    const double whole[] = { 0, 0.5, 1 }, kind = chance(seed);
    fvi_linear p = { .m = between(seed, 1e-3, 1e3),
                     .c = between(seed, 1e-3, 1e3),
                     .alpha =
                         kind < 0.3 ? whole[(int)(10 * kind)] : chance(seed),
                     .past = (fvi_past)(3 * chance(seed)),
                     .x0 = chance(seed) < 0.3 ? 0 : chance(seed) - 0.5,
                     .v0 = chance(seed) < 0.3 ? 0 : chance(seed) - 0.5,
                     .forcing = (fvi_forcing)(3 * chance(seed)),
                     .A = chance(seed) - 0.5 };
    const double w = sqrt(p.c / p.m), end = between(seed, 1e-2, 1e4) / w;
    double re = 0;
    p.v0 *= w;
    p.A *= p.c;
    p.w = w * between(seed, 1e-2, 1e2);
    p.T = end * between(seed, 1e-6, 2);
    *h = end / (double)n;
    p.rho = p.c * between(seed, 1e-6, 1e3) * pow(w, -2 * p.alpha);
    if (chance(seed) < 0.1)
        p.rho = 0;
    if (chance(seed) < 0.1)
        p.c = 0;
    if (p.past == FVI_PAST_RIEMANN_LIOUVILLE && p.alpha > 0.5)
        p.x0 = 0;
    if (chance(seed) < 0.3 && fvi_exact_pole(&p, &re, &p.w) == FVI_SUCCESS)
        p.w *= 1 + between(seed, 1e-9, 1e-1);
    return p;
}

/* Rows against fvi_exact, whose own error is TOL: at most LOOKED_AT of them, the early ones
 * all, and the last. */
static void compare(const fvi_linear *p, double h, size_t n, double tolerance,
                    const char *what)
{
    double *x = malloc((n + 1) * sizeof *x), *v = malloc((n + 1) * sizeof *v);
    double t[LOOKED_AT], want_x[LOOKED_AT], want_v[LOOKED_AT], X = 0, V = 0;
    size_t row[LOOKED_AT], count = 0;
    ck_assert(x && v);
    for (size_t k = 0; k <= n && count < LOOKED_AT; count++) {
        row[count] = k;
        t[count] = (double)k * h;
        k = k < 24 ? k + 1 : k < n ? GSL_MIN(k + k / 4, n) : n + 1;
    }
    ck_assert_int_eq(fvi_exact(p, count, t, want_x, want_v), FVI_SUCCESS);
    ck_assert_int_eq(fvi_exact_rows(p, h, n, tolerance, x, v), FVI_SUCCESS);
    for (size_t k = 0; k <= n; k++) {
        X = fmax(X, fabs(x[k]));
        V = fmax(V, fabs(v[k]));
    }
    for (double now = (double)n * h; now > 1e-8 * (double)n * h; now /= 1.3) {
        double x_now, v_now; /* between the rows, and before the first */
        solve(p, now, &x_now, &v_now);
        X = fmax(X, fabs(x_now));
        V = fmax(V, fabs(v_now));
    }
    for (size_t i = 0; i < count; i++) {
        const size_t k = row[i];
        ck_assert_near(x[k], want_x[i], (tolerance + 2 * TOL) * X,
                       "%s: x, row %zu of %zu", what, k, n);
        ck_assert_near(v[k], want_v[i],
                       (tolerance + 2 * TOL) * (V + (k ? X / t[i] : 0)),
                       "%s: x', row %zu of %zu", what, k, n);
    }
    free(x);
    free(v);
}

START_TEST(eq_11_15_rows_are_the_solution)
{
    uint64_t seed = 1;
    for (int i = 0; i < PROBLEMS; i++) {
        char what[300];
        double h;
        const size_t n = (size_t)between(&seed, 1, i % 20 ? 1e3 : 1e5);
        const double tolerance = i % 4 ? between(&seed, 1e-14, 0.3) : 0;
        const fvi_linear p = any(&seed, n, &h);
        snprintf(
            what, sizeof what,
            "%d: m=%a c=%a rho=%a alpha=%a past=%d x0=%a v0=%a force=%d A=%a "
            "T=%a w=%a h=%a tolerance=%g",
            i, p.m, p.c, p.rho, p.alpha, p.past, p.x0, p.v0, p.forcing, p.A,
            p.T, p.w, h, tolerance);
        compare(&p, h, n, tolerance, what);
    }
}
END_TEST

START_TEST(rows_say_what_is_wrong)
{
    const fvi_linear p = oscillator(0.3, 1, 1, 0);
    double x[3] = { 7, 7, 7 }, v[3] = { 7, 7, 7 };
    ck_assert_int_eq(fvi_exact_rows(NULL, 1, 2, 0, x, v), FVI_EFAULT);
    ck_assert_int_eq(fvi_exact_rows(&p, 1, 2, 0, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_exact_rows(&p, 1, 0, 0, x, v), FVI_EINVAL);
    const double bad[] = { 0, -1, GSL_POSINF, GSL_NAN, 1e308 };
    for (size_t i = 0; i < LEN(bad); i++)
        ck_assert_int_eq(fvi_exact_rows(&p, bad[i], 2, 0, x, v), FVI_EDOM);
    const double never[] = { -1e-3, 1, GSL_NAN };
    for (size_t i = 0; i < LEN(never); i++)
        ck_assert_int_eq(fvi_exact_rows(&p, 1, 2, never[i], x, v), FVI_EDOM);
    fvi_linear q = p;
    q.m = 0;
    ck_assert_int_eq(fvi_exact_rows(&q, 1, 2, 0, x, v), FVI_EDOM);
    q = p;
    q.forcing = (fvi_forcing)3;
    ck_assert_int_eq(fvi_exact_rows(&q, 1, 2, 0, x, v), FVI_EINVAL);
    for (size_t i = 0; i < 3; i++)
        ck_assert(x[i] == 7 && v[i] == 7);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("11 exact solution, rows");
    ADD_CASE(suite, "rows", eq_11_15_rows_are_the_solution,
             rows_say_what_is_wrong);
    return run_suite(suite);
}
