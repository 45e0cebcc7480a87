/* tests/exact_solution/test_exact_solution_rows_far.c -- H 11: rows at long times, rows that cannot be computed,
 * and problems that are refused.
 * Run alone: make test-exact_solution_rows_far */
#include "exact_rows.h"
#include "system/larger.h"

/* Numbers beyond the range of a window: the same operations as in fvi_exact_at. And times of
 * which the first or the last is no double's neighbour: a phase of 10^9 radians. */
START_TEST(rows_far_out)
{
    const double steps[] = { 1e-150, 1e-60, 1e60, 1e120 };
    for (size_t i = 0; i < LEN(steps); i++) {
        fvi_linear_oscillator p = oscillator(0.3, 1, 1, 0);
        const double t[] = { 0, steps[i], 2 * steps[i], 3 * steps[i] };
        double x[4], v[4], want_x[4], want_v[4];
        ck_assert_int_eq(fvi_exact_at(&p, 4, t, want_x, want_v,
                                      NULL), FVI_SUCCESS);
        ck_assert_int_eq(fvi_exact_grid(&p, steps[i], 3, 0, x, v,
                                        NULL), FVI_SUCCESS);
        for (size_t k = 0; k < 4; k++) {
            ck_assert_near(x[k], want_x[k], 2 * TOL, "h=%g %zu", steps[i], k);
            ck_assert_near(v[k], want_v[k],
                           2 * TOL * (1 + 1 / larger(t[k], 1e-300)), "h=%g %zu",
                           steps[i], k);
        }
    }
    fvi_linear_oscillator p = oscillator(0.3, 1, 0, 0);
    p.forcing = FVI_FORCING_COSINE;
    p.A = p.w = 1;
    ck_assert_rows(&p, 0.7e4, 100000, 0, "a cosine for long");
}
END_TEST

/* What rounds t_k to a double turns the phase by up to w t_k u, a full turn at last; and a
 * force may swing on where a body's own phase would be lost. */
START_TEST(rows_of_many_swings)
{
    fvi_linear_oscillator p = oscillator(0.3, 1, 1, 0), q = oscillator(0.9, 1, 0, 0);
    p.rho = p.c = 1;
    q.c = 0;
    p.forcing = q.forcing = FVI_FORCING_COSINE;
    p.A = q.A = 1;
    p.w = q.w = 1.7;
    for (double end = 1e8; end < 1e100; end *= end < 1e20 ? 10 : 1e30) {
        const double h = 1.0000123 * end / 300;
        ck_assert_rows(&p, h, 300, 0, "a damped body");
        ck_assert_rows(&q, h, 300, 0, "a free body");
        p.rho = 0;
        if (end < 4e17)
            ck_assert_rows(&p, h, 300, 0, "a body that swings");
        p.rho =
            1e-30; /* s is i, and less than a double's last place to the left */
        if (end < 4e17)
            ck_assert_rows(&p, h, 300, 0, "a body that hardly slows down");
        p.rho = 1;
    }
}
END_TEST

/* Two outputs, or one of them; and zero for nothing. */
START_TEST(rows_of_one_output)
{
    fvi_linear_oscillator p = oscillator(0.3, 1, 1, 0.5);
    double x[90], v[90], alone[90];
    for (int force = 0; force < 3; force++) {
        p.forcing = (fvi_forcing)force;
        p.A = p.w = 2;
        p.T = 3;
        ck_assert_int_eq(fvi_exact_grid(&p, 0.2, 89, 1e-6, x, v, NULL), 0);
        ck_assert_int_eq(fvi_exact_grid(&p, 0.2, 89, 1e-6, alone, NULL,
                                        NULL), 0);
        ck_assert_mem_eq(alone, x, sizeof x);
        ck_assert_int_eq(fvi_exact_grid(&p, 0.2, 89, 1e-6, NULL, alone,
                                        NULL), 0);
        ck_assert_mem_eq(alone, v, sizeof v);
    }
    p = (fvi_linear_oscillator){ .m = 1, .c = 1, .rho = 1, .alpha = 0.3 };
    ck_assert_int_eq(fvi_exact_grid(&p, 0.2, 89, 0, x, v, NULL), 0);
    for (int k = 0; k < 90; k++)
        ck_assert(x[k] == 0 && v[k] == 0);
}
END_TEST

/* The rows before a value that is lost stand. */
START_TEST(rows_that_are_lost)
{
    fvi_linear_oscillator p = { .m = 1, .c = 1, .x0 = 1 };
    double x[4] = { 7, 7, 7, 7 }, t = 4e17, want;
    ck_assert_int_eq(fvi_exact_grid(&p, t, 3, 0, x, NULL, NULL), FVI_ELOSS);
    ck_assert_int_eq(fvi_exact_at(&p, 1, &t, &want, NULL, NULL), FVI_SUCCESS);
    ck_assert(x[0] == 1 && x[1] == want);
    ck_assert(isnan(x[3]));
    p.c = 0;
    p.v0 = 1e300;
    ck_assert_int_eq(fvi_exact_grid(&p, 1e7, 3, 0, x, NULL, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_exact_grid(&p, 1e8, 3, 0, x, NULL, NULL), FVI_EOVRFLW);
    ck_assert(isfinite(x[1]) && isnan(x[2]) && isnan(x[3]));
    p = (fvi_linear_oscillator){ .m = 1, .c = 1e300, .x0 = 1e200 }; /* x' is -1e340 */
    t = 1e-160;
    double v[4];
    ck_assert_int_eq(fvi_exact_at(&p, 1, &t, &want, NULL, NULL), FVI_EOVRFLW);
    ck_assert_int_eq(fvi_exact_grid(&p, t, 3, 0, x, NULL, NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_exact_grid(&p, t, 3, 0, x, v, NULL), FVI_EOVRFLW);
    ck_assert(v[0] == 0 && isnan(v[1]) && isnan(x[1]));
}
END_TEST

START_TEST(rows_say_what_is_wrong)
{
    const fvi_linear_oscillator p = oscillator(0.3, 1, 1, 0);
    double x[3] = { 7, 7, 7 }, v[3] = { 7, 7, 7 };
    ck_assert_int_eq(fvi_exact_grid(NULL, 1, 2, 0, x, v, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_exact_grid(&p, 1, 2, 0, NULL, NULL, NULL), FVI_EFAULT);
    ck_assert_int_eq(fvi_exact_grid(&p, 1, 0, 0, x, v, NULL), FVI_EINVAL);
    const double bad[] = { 0, -1, GSL_POSINF, GSL_NAN, 1e308 };
    for (size_t i = 0; i < LEN(bad); i++)
        ck_assert_int_eq(fvi_exact_grid(&p, bad[i], 2, 0, x, v,
                                        NULL), FVI_EDOM);
    const double never[] = { -1e-3, 1, GSL_NAN };
    for (size_t i = 0; i < LEN(never); i++)
        ck_assert_int_eq(fvi_exact_grid(&p, 1, 2, never[i], x, v,
                                        NULL), FVI_EDOM);
    fvi_linear_oscillator q = p;
    q.m = 0;
    ck_assert_int_eq(fvi_exact_grid(&q, 1, 2, 0, x, v, NULL), FVI_EDOM);
    q = p;
    q.forcing = (fvi_forcing)3;
    ck_assert_int_eq(fvi_exact_grid(&q, 1, 2, 0, x, v, NULL), FVI_EINVAL);
    for (size_t i = 0; i < 3; i++)
        ck_assert(x[i] == 7 && v[i] == 7);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("11 exact solution, rows far out");
    ADD_CASE(suite, "far", rows_far_out, rows_of_many_swings,
             rows_of_one_output, rows_that_are_lost, rows_say_what_is_wrong);
    return run_suite(suite);
}
