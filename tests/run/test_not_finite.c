/* tests/run/test_not_finite.c -- A result that is not finite is an error.
 * Run alone: make test-not_finite */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/methods.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

enum { STEPS = 50, MOST = 200 };
static const double one = 1, half = 0.5, rho = 0.2, huge = 1e200;
static double x[MOST], p[MOST], E[MOST];

/* U = log x + 8 x: its slope is a number on both sides of 0, and U is not. */
static int wall_value(size_t d, const double *at, void *params, double *value)
{
    (void)d, (void)params;
    *value = log(*at) + 8 * *at;
    return 0;
}

static int wall_gradient(size_t d, const double *at, void *params, double *g)
{
    (void)d, (void)params;
    *g = 1 / *at + 8;
    return 0;
}

static int wall_hessian(size_t d, const double *at, void *params, double *H)
{
    (void)d, (void)params;
    *H = -1 / (*at * *at);
    return 0;
}

START_TEST(an_energy_that_is_no_number_is_an_error_with_its_row)
{
    const fvi_system wall = { .d = 1,
                              .mass = &one,
                              .damping = &rho,
                              .potential = { .value = wall_value,
                                             .gradient = wall_gradient,
                                             .hessian = wall_hessian } };
    const fvi_run run = fvi_run_default(&wall, &one, &half, 0.1, STEPS);
    for (size_t k = 0; k <= STEPS; k++)
        E[k] = -1;
    ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, p, E),
                     FVI_EOVRFLW);
    size_t row = 0;
    while (E[row] != -1)
        ck_assert(isfinite(E[row++]));
    ck_assert_uint_ge(row, 3);
    ck_assert(x[row - 1] > 0 && x[row] < 0);
}
END_TEST

START_TEST(an_energy_that_is_too_large_is_an_error)
{
    const fvi_system spring = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    double energy = 7;
    ck_assert_int_eq(fvi_energy(&spring, &huge, &one, &energy), FVI_EOVRFLW);
    ck_assert_int_eq(fvi_energy(&spring, &one, &huge, &energy), FVI_EOVRFLW);
    ck_assert_double_eq(energy, 7);
    ck_assert_int_eq(fvi_energy(&spring, &one, &one, &energy), FVI_SUCCESS);
    ck_assert_double_eq(energy, 1);
}
END_TEST

START_TEST(an_impulse_that_is_too_large_is_an_error_of_the_start)
{
    static const double most = 1e308;
    const fvi_impulse hit[] = { { 0, &most }, { 0, &most } };
    const fvi_system body = { .d = 1,
                              .mass = &one,
                              .damping = &rho,
                              .force = { .impulses = hit,
                                         .impulse_count = 2 } };
    const fvi_run run = fvi_run_default(&body, &one, &one, 0.1, STEPS);
    for (size_t m = 0; fvi_methods[m]; m++)
        ck_assert_msg(fvi_trajectory(fvi_methods[m], &run, x, p, NULL)
                          == FVI_EOVRFLW,
                      "%s", fvi_methods[m]->name);
}
END_TEST

static int slopes(size_t k, size_t d, const double *at, const double *momentum,
                  void *params, double *Jx, double *Jp)
{
    (void)k, (void)d, (void)at, (void)params;
    if (momentum)
        *Jx = huge, *Jp = 0;
    return 0;
}

/* x_N is 1e200, and J has a slope of 1e200 there: J is no number, nor are its derivatives by
 * what is no start. */
START_TEST(a_derivative_that_is_too_large_is_an_error)
{
    static const fvi_history_kind direct = FVI_HISTORY_DIRECT;
    const fvi_objective J = { .slopes = slopes, .params = NULL };
    const fvi_system spring = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    fvi_run run = fvi_run_default(&spring, &huge, &half, 0.1, 8);
    run.alpha = 0.25;
    run.memory = direct;
    for (size_t m = 0; fvi_methods[m]; m++) {
        if (fvi_methods[m]->scheme == FVI_SCHEME_CLASSICAL)
            continue;
        double by[2] = { 0 }, c[1];
        const fvi_sensitivities outputs[] = { { .mass = by },
                                          { .damping = by },
                                          { .alpha = by },
                                          { .parameters = c,
                                            .sensitivity = fvi_parameter_gradient_of(
                                                &spring.potential) } };
        for (size_t i = 0; i < LEN(outputs); i++) {
            run.memory = fvi_method_takes_history(fvi_methods[m], direct)
                             ? direct
                             : FVI_HISTORY_AUTO;
            ck_assert_msg(
                fvi_adjoint(fvi_methods[m], &run, NULL, NULL, &J, &outputs[i])
                    == FVI_EOVRFLW,
                "%s, output %zu", fvi_methods[m]->name, i);
        }
    }
}
END_TEST

/* The same control in two units; in the second one its square is no double. */
START_TEST(a_control_that_costs_too_much_is_an_error)
{
    double u[9] = { 0 }, start[2] = { 1, 0.5 }, end[2] = { 0.25, -0.5 };
    const fvi_system spring = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    const fvi_run run = fvi_run_default(&spring, start, start + 1, 0.1, 8);
    fvi_control_result found;
    ck_assert_int_eq(
        fvi_control_solve(&fvi_fractional, &run, end, end + 1, u, &found),
        FVI_SUCCESS);
    for (size_t k = 0; k < 9; k++)
        u[k] = ldexp(u[k], 600);
    for (size_t i = 0; i < 2; i++)
        start[i] = ldexp(start[i], 600), end[i] = ldexp(end[i], 600);
    ck_assert_int_eq(
        fvi_control_solve(&fvi_fractional, &run, end, end + 1, u, &found),
        FVI_EOVRFLW);
}
END_TEST

START_TEST(momenta_moduli_and_slopes_that_are_too_large_are_errors)
{
    static const double tiny = 1e-10, start = 1e300;
    static const fvi_free_parameter mass[] = { FVI_FREE_PARAMETER_MASS };
    const fvi_kernel_term term[] = { { FVI_KERNEL_POWER, 1e308, 0.5, 0, 0 } };
    const fvi_kernel law = { 1, term };
    double storage = 7, loss = 7;
    ck_assert_int_eq(fvi_kernel_moduli(&law, 1e10, &storage, &loss), FVI_EOVRFLW);
    ck_assert(storage == 7 && loss == 7);
    const fvi_system light = { .d = 1,
                               .mass = &tiny,
                               .damping = &tiny,
                               .potential = fvi_potential_harmonic(&tiny) };
    const fvi_run run = fvi_run_default(&light, &start, &half, 0.1, 8);
    ck_assert_int_eq(fvi_tangent(&run, 1, mass, x, p), FVI_EOVRFLW);
    const fvi_system body = { .d = 1, .mass = &one, .damping = &one };
    fvi_run steps = fvi_run_default(&body, &one, &half, 1e-10, 8);
    steps.alpha = 0.9;
    for (size_t k = 0; k <= 8; k++)
        x[k] = k % 2 ? 1e308 : -1e308, p[k] = 0;
    ck_assert_int_eq(fvi_lobatto_correct_momenta(&fvi_lobatto_m2, &steps, x, p),
                     FVI_EOVRFLW);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("numbers that are not finite");
    ADD_CASE(suite, "runs",
             an_energy_that_is_no_number_is_an_error_with_its_row,
             an_energy_that_is_too_large_is_an_error,
             an_impulse_that_is_too_large_is_an_error_of_the_start);
    ADD_CASE(suite, "answers", a_derivative_that_is_too_large_is_an_error,
             a_control_that_costs_too_much_is_an_error,
             momenta_moduli_and_slopes_that_are_too_large_are_errors);
    return run_suite(suite);
}
