/* tests/discrete_mechanics/test_discrete_mechanics_newton_lost.c -- H 2: equations for which Newton's method alone
 * fails.
 * Run alone: make test-discrete_mechanics_newton_lost */
#include <fvi/convolution_quadrature_methods.h>
#include "run/whole_run.h"
#include "newton_solver.h"

/* Two wells, at x = 1 and -1; a mass comes to rest in one. There an update is the
 * rounding of x, not of d: some u |x|. The force x^3 - x is off by 3 u at the place
 * of rest, where its slope is 2; the damping forgets no faster than a power of t. */
START_TEST(eq_2_10_is_solved_where_a_motion_dies_away_from_zero)
{
    enum { N = 5000 };
    static double x[N + 1];
    static const fvi_method *const methods[] = { &fvi_fractional,
                                                 &fvi_lagrange_dalembert,
                                                 &fvi_euler_implicit,
                                                 &fvi_cq2_shifted, &fvi_cq_bdf2 };
    const double well[] = { -1, 1 }, rho = 0.5, x0 = 0.5, p0 = 0;
    const fvi_system system = { 1,     one, &rho, fvi_potential_duffing(well),
                                { 0 }, NULL, NULL };
    for (size_t i = 0; i < LEN(methods); i++) {
        const fvi_run run = { .system = &system,
                              .x0 = &x0,
                              .p0 = &p0,
                              .h = 0.1,
                              .steps = N,
                              .kappa = 0.5,
                              .alpha = 0.5 };
        ck_assert_int_eq(fvi_trajectory(methods[i], &run, x, NULL, NULL),
                         FVI_SUCCESS);
        ck_assert_near(fabs(x[N]), 1, 16 * U, "%s", methods[i]->name);
    }
}
END_TEST

/* Newton's method alone finds none of these. U'' = -1 at the guess 0 of the first,
 * and 1 - 1 = 0: what is left is d^3 = r. In z = d/2 the second is z^3 - 2 z + 2 = 0,
 * for which it goes 0, 1, 0, 1, ... for ever; the root is the number below. The slopes
 * are 3 d^2 >= 3 and 3 z^2 - 2 = 7.4 there: a residual that is rounding, of four terms
 * at most, moves d by less than 4 u of the terms. */
START_TEST(eq_2_10_is_solved_where_newton_loses_its_way)
{
    const double well[] = { -1, 1 }, x[] = { 0, 0 }, r[] = { -1, 2 };
    double d[2], g[2];
    for (size_t dim = 1; dim <= 2; dim++) {
        const fvi_system flat = { dim,   one, none, fvi_potential_duffing(well),
                                  { 0 }, NULL, NULL };
        fvi_newton *newton = solver(&flat, one, 1, 1);
        d[0] = d[1] = 0;
        ck_assert_int_eq(fvi_newton_solve(newton, x, r, d, g), FVI_SUCCESS);
        fvi_newton_free(newton);
        for (size_t i = 0; i < dim; i++)
            ck_assert_near(d[i], cbrt(r[i]), 4 * U * (1 + fabs(r[i])),
                           "flat, %zu", i);
    }
    const double deep[] = { -8, 2 }, push = -2, z = -1.7692923542386314;
    const fvi_system round = { 1,     one, none, fvi_potential_duffing(deep),
                               { 0 }, NULL, NULL };
    fvi_newton *newton = solver(&round, one, 0.5, 0.5);
    d[0] = 0;
    ck_assert_int_eq(fvi_newton_solve(newton, x, &push, d, g), FVI_SUCCESS);
    fvi_newton_free(newton);
    ck_assert_near(d[0], 2 * z, 4 * U * (2 + 4 * fabs(z)), "round");
}
END_TEST

START_TEST(equations_that_cannot_be_solved_are_reported)
{
    /* U = z^3 / 3: d + d^2 = -1 has no real solution. */
    const double cubic[] = { 0, 1 }, x[] = { 0, 0 }, r[] = { -1, 2 };
    double d[] = { 0, 0 }, g[2];
    const fvi_system hopeless = { 1,     one, none, potential(CUBIC, cubic),
                                  { 0 }, NULL, NULL };
    fvi_newton *newton = solver(&hopeless, one, 1, 1);
    ck_assert_int_eq(fvi_newton_solve(newton, x, r, d, g), FVI_EMAXITER);
    fvi_newton_free(newton);

    newton = solver(&hopeless, one, 1, 1);
    d[0] = -0.5; /* where 1 + 2 d = 0 */
    ck_assert_int_eq(fvi_newton_solve(newton, x, r, d, g), FVI_ESING);
    fvi_newton_free(newton);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("02 where Newton is lost");
    ADD_CASE(suite, "identities",
             eq_2_10_is_solved_where_a_motion_dies_away_from_zero,
             eq_2_10_is_solved_where_newton_loses_its_way);
    ADD_CASE(suite, "errors", equations_that_cannot_be_solved_are_reported);
    return run_suite(suite);
}
