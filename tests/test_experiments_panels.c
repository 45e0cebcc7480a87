/* tests/test_experiments_panels.c -- Chapter 10, the numbers in the panels.
 * Run alone: make test-experiments_panels */
#include "experiments.h"
#include "discrete_mechanics.h"
#include "fvi.h"
#include <stddef.h>
#include "experiments_bagley_torvik_ref.h"
#include "experiments_ref.h"
#include "ulp.h"

#include <gsl/gsl_errno.h>
#include <stdlib.h>

/* The paper's oscillator. */
static const double ONE = 1, RHO = 0.2, X0 = 1, P0 = 0.5;

static const fvi_method *method_of(int name)
{
    return name == EXPLICIT   ? &fvi_euler_explicit
           : name == IMPLICIT ? &fvi_euler_implicit
                              : &fvi_fractional;
}

static fvi_system paper_system(void)
{
    return (fvi_system){ .d = 1,
                         .mass = &ONE,
                         .damping = &RHO,
                         .potential = fvi_potential_harmonic(&ONE) };
}

static fvi_run paper_run(const fvi_system *system, double alpha, double h,
                         size_t N)
{
    return (fvi_run){ .system = system,
                      .x0 = &X0,
                      .p0 = &P0,
                      .h = h,
                      .steps = N,
                      .kappa = 0.5,
                      .alpha = alpha,
                      .memory = FVI_MEMORY_DIRECT };
}

/* ---- the panel of several alpha ---- */

/* N = 30 steps; a memory of k + 1 terms adds at most (k + 8) u rho h^(1-2alpha)
 * sum |w_n x| <= 4 (k + 8) u to p, k times, and these stable schemes do not
 * amplify errors. Seen: 3 u. */
//> alphas
START_TEST(eq_9_3_several_alpha_at_h_one_half)
{
    const fvi_system system = paper_system();
    for (size_t i = 0; i < LEN(ref_alphas); i++) {
        double x[31], plain[31], exact, far = 0, alpha = ref_alphas[i].alpha;
        const fvi_run run = paper_run(&system, alpha, 0.5, 30);
        ck_assert_int_eq(fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL),
                         GSL_SUCCESS);
        ck_assert_int_eq(
            fvi_algorithm_3(&system, alpha, 0.5, 0.5, 30, X0, P0, plain),
            GSL_SUCCESS);
        for (size_t j = 0; j < LEN(ref_alphas_k); j++) {
            size_t k = ref_alphas_k[j];
            double bound = 4 * (double)(k * (k + 8)) * U;
            ck_assert_near(x[k], ref_alphas[i].x[j], bound, "alpha=%g k=%zu",
                           alpha, k);
            ck_assert_near(plain[k], ref_alphas[i].x[j], bound,
                           "as printed, alpha=%g k=%zu", alpha, k);
        }
        for (size_t k = 0; k <= 30; k++) {
            fvi_damped_oscillator(1, RHO, 1, X0, P0, (double)k * 0.5, &exact,
                                  NULL);
            far = fmax(far, fabs(x[k] - exact));
        }
        ck_assert_near(far, ref_alphas[i].far, 5000 * U, "alpha=%g", alpha);
    }
}
END_TEST
//< alphas

/* ---- the panels of Euler's methods ---- */

/* Both columns of the matrix of a step: entries of order 1, off by 3 u each, or
 * by 6 u if they are solved for. Seen: 1 u. The exact area shrinks by e^{-h rho / m}
 * a step; what a method leaves more of it or less is of order h^2. */
//> determinants
START_TEST(eq_10_2_and_10_3_explicit_euler_gains_implicit_loses)
{
    const fvi_system system = paper_system();
    for (size_t i = 0; i < LEN(ref_det); i++) {
        double M[2][2], x[2], p[2];
        for (int j = 0; j < 2; j++) {
            const double e[2] = { j == 0, j == 1 };
            fvi_run run = paper_run(&system, 0.5, ref_det[i].h, 1);
            run.x0 = &e[0];
            run.p0 = &e[1];
            ck_assert_int_eq(
                fvi_trajectory(method_of(ref_det[i].method), &run, x, p, NULL),
                GSL_SUCCESS);
            M[0][j] = x[1];
            M[1][j] = p[1];
        }
        double det = M[0][0] * M[1][1] - M[0][1] * M[1][0];
        ck_assert_near(det, ref_det[i].det, 24 * U, "row %zu", i);
        double h = ref_det[i].h, gain = (log(det) + h * RHO) / (h * h);
        if (ref_det[i].method == FVI) /* (10.3): -rho^2/2m^2 + O(h) */
            ck_assert_near(gain, 0, 0.04, "row %zu", i);
        else /* +- 0.98 + O(h) */
            ck_assert_double_gt(ref_det[i].method == EXPLICIT ? gain : -gain,
                                0.8);
    }
}
END_TEST
//< determinants

/* A step commits a few u |x|, |p| <= sqrt(2 E); N of them add up to 10 N u of
 * that, the exact solution's error is below 300 u; energies double it. With E the
 * largest of the run. Seen: 0.001 of it. */
//> euler
START_TEST(the_runs_of_the_euler_panels)
{
    enum { MOST = 150 };
    const fvi_system system = paper_system();
    for (size_t i = 0; i < LEN(ref_euler); i++) {
        double x[MOST + 1], energy[MOST + 1], errors[3], mean = 0;
        const size_t N = ref_euler[i].N;
        const double h = ref_euler[i].h, E = 1 + ref_euler[i].E_error;
        const double bound = (10 * (double)N + 300) * U * 4 * E;
        const fvi_method *method = method_of(ref_euler[i].method);
        const fvi_run run = paper_run(&system, 0.5, h, N);
        ck_assert_int_eq(fvi_trajectory(method, &run, x, NULL, energy),
                         GSL_SUCCESS);
        ck_assert_int_eq(
            fvi_oscillator_errors(method, 1, RHO, 1, X0, P0, h, N, errors),
            GSL_SUCCESS);
        for (size_t k = 0; k <= N; k++) {
            double exact[2];
            fvi_damped_oscillator(1, RHO, 1, X0, P0, (double)k * h, exact,
                                  exact + 1);
            mean += energy[k] - fvi_energy(&system, exact, exact + 1);
        }
        mean /= (double)N + 1;
        ck_assert_near(x[N], ref_euler[i].x, bound, "x, row %zu", i);
        ck_assert_near(energy[N], ref_euler[i].E, bound, "E, row %zu", i);
        ck_assert_near(errors[0], ref_euler[i].x_error, bound, "row %zu", i);
        ck_assert_near(errors[2], ref_euler[i].E_error, bound, "row %zu", i);
        ck_assert_near(mean, ref_euler[i].E_mean, bound, "row %zu", i);
    }
}
END_TEST
//< euler

/* ---- the difference FVI - LdA ---- */

/* Two programs for one recurrence: a few u a step, not amplified but damped by
 * e^{-rho t / 2} with a memory of 2 / rho h = 50 steps; 15 u a step are allowed, as
 * the printed form has the noise of its weights besides. Compared absolutely: at
 * t = 2000 the solution is 1e-88, and what the printed form sums is noise.
 * Seen: 10 u, 15 u. */
//> difference
START_TEST(corollary_fvi_is_lagrange_dalembert_to_rounding)
{
    enum { N = 10000 };
    static double lda[N + 1], ours[N + 1], printed[N + 1];
    const fvi_system system = paper_system();
    const fvi_run run = paper_run(&system, 0.5, 0.2, N);
    fvi_trajectory(&fvi_lagrange_dalembert, &run, lda, NULL, NULL);
    fvi_trajectory(&fvi_fractional, &run, ours, NULL, NULL);
    fvi_algorithm_3(&system, 0.5, 0.5, 0.2, N, X0, P0, printed);
    for (size_t k = 0; k <= N; k++) {
        ck_assert_near(ours[k], lda[k], 750 * U, "ours, k=%zu", k);
        ck_assert_near(printed[k], lda[k], 750 * U, "printed, k=%zu", k);
    }
}
END_TEST
//< difference

/* ---- global errors ---- */

/* The bound of the runs above, at most 2.2e-11. The smallest error is 1.8e-4, the
 * logarithms are off by 1.2e-7 at most, and so are the slopes (each logarithm
 * counts at most 0.6 there, all together less than once). Seen: 0.001 of it;
 * 1e-12 in the slopes. */
//> errors-table
START_TEST(eq_10_4_global_errors_of_the_fvi)
{
    double h[8], x[8], p[8], E[8], slope;
    for (size_t i = 0; i < LEN(ref_errors); i++) {
        double e[3], bound = (10 * (double)ref_errors[i].N + 300) * U * 4;
        h[i] = ref_errors[i].h;
        ck_assert_int_eq(fvi_oscillator_errors(&fvi_fractional, 1, RHO, 1, X0,
                                               P0, h[i], ref_errors[i].N, e),
                         GSL_SUCCESS);
        ck_assert_near(x[i] = e[0], ref_errors[i].x, bound, "x, h=%g", h[i]);
        ck_assert_near(p[i] = e[1], ref_errors[i].p, bound, "p, h=%g", h[i]);
        ck_assert_near(E[i] = e[2], ref_errors[i].E, bound, "E, h=%g", h[i]);
    }
    const double *const errors[] = { x, p, E };
    for (size_t i = 0; i < 3; i++) { /* from h = 0.1 on */
        fvi_observed_order(5, h + 2, errors[i] + 2, &slope, NULL);
        ck_assert_near(slope, ref_slopes[i].five, 1.2e-7, "five, %zu", i);
        fvi_observed_order(6, h + 2, errors[i] + 2, &slope, NULL);
        ck_assert_near(slope, ref_slopes[i].six, 1.2e-7, "six, %zu", i);
    }
}
END_TEST
//< errors-table

/* (10.6): against the oscillator of mass m - rho h / 2 the FVI is of order 2: the
 * quotient of successive errors is 4 + O(h), in x and in p = m_eff x'. With errors
 * C h^2 (1 + c h), |c| <= 1, it is within 4 h of 4. Seen: 0.06 of it. */
//> modified
START_TEST(eq_10_6_order_two_against_the_modified_mass)
{
    const fvi_system system = paper_system();
    double last[2] = { 0, 0 };
    for (double h = 0.5; h >= 0x1p-8; h /= 2) {
        double error[2] = { 0, 0 }, x, p;
        fvi_stepper *s;
        const fvi_run run = paper_run(&system, 0.5, h, (size_t)(15 / h));
        ck_assert_int_eq(fvi_start(&fvi_fractional, &run, &s), GSL_SUCCESS);
        while (s->k < run.steps && fvi_step(s) == GSL_SUCCESS) {
            fvi_damped_oscillator(1 - RHO * h / 2, RHO, 1, X0, P0, s->t, &x,
                                  &p);
            error[0] = fmax(error[0], fabs(s->x[0] - x));
            error[1] = fmax(error[1], fabs(s->p[0] - p));
        }
        fvi_stop(s);
        for (size_t i = 0; i < 2; i++) {
            if (h < 0.5)
                ck_assert_near(last[i] / error[i], 4, 4 * h, "h=%g, %zu", h, i);
            last[i] = error[i];
        }
    }
}
END_TEST
//< modified

/* (10.7): error / h = K + O(h), so 2 e(h/2)/(h/2) - e(h)/h = K + O(h^2), and the
 * quantities are smooth with derivatives of order 1. Allowed: h^2 = 6.1e-5.
 * Seen: 1.5e-6. */
//> constants
START_TEST(eq_10_7_the_constant_of_the_error)
{
    const double h = 0x1p-7;
    double e[3], half[3];
    fvi_oscillator_errors(&fvi_fractional, 1, RHO, 1, X0, P0, h, 1920, e);
    fvi_oscillator_errors(&fvi_fractional, 1, RHO, 1, X0, P0, h / 2, 3840,
                          half);
    for (size_t i = 0; i < 3; i++)
        ck_assert_near(4 * half[i] / h - e[i] / h, ref_constants[i], h * h,
                       "quantity %zu", i);
}
END_TEST
//< constants

/* The same yardstick for other methods; Algorithm 1 has order 2, where there is no
 * damping. An error K h (1 + c h) has a slope of 1 + c h; h = 2^-8 ... 2^-10, |c| <= 5.
 * Seen: off by 0.004. */
START_TEST(eq_10_4_orders_of_the_other_methods)
{
    const struct {
        const fvi_method *method;
        double rho, order;
    } rows[] = { { &fvi_euler_explicit, 0.2, 1 },
                 { &fvi_euler_implicit, 0.2, 1 },
                 { &fvi_lagrange_dalembert, 0.2, 1 },
                 { &fvi_variational, 0, 2 } };
    for (size_t i = 0; i < LEN(rows); i++) {
        double h[3] = { 0x1p-8, 0x1p-9, 0x1p-10 }, x[3], e[3], order;
        for (size_t j = 0; j < 3; j++) {
            size_t N = (size_t)(4 / h[j]);
            ck_assert_int_eq(fvi_oscillator_errors(rows[i].method, 1,
                                                   rows[i].rho, 1, X0, P0, h[j],
                                                   N, e),
                             GSL_SUCCESS);
            x[j] = e[0];
        }
        fvi_observed_order(3, h, x, &order, NULL);
        ck_assert_near(order, rows[i].order, 0.02, "row %zu", i);
    }
}
END_TEST

/* ---- Bagley-Torvik ---- */

static const double STEP[2] = { 8, 1 }, ZERO = 0;

static double *bagley_torvik(size_t per_unit, size_t N, int matrix_method)
{
    const double h = 1 / (double)per_unit;
    double *x = malloc((N + 1) * sizeof *x);
    ck_assert_ptr_nonnull(x);
    const fvi_system system = { .d = 1,
                                .mass = &ONE,
                                .damping = &ONE,
                                .potential = fvi_potential_harmonic(&ONE),
                                .force = fvi_force_step(STEP) };
    fvi_run run = paper_run(&system, 0.75, h, N);
    run.x0 = run.p0 = &ZERO;
    int status = matrix_method
                     ? fvi_matrix_method(1, 1, 1, 0.75, system.force, h, N, x)
                     : fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
    ck_assert_int_eq(status, GSL_SUCCESS);
    return x;
}

/* What rounding can do to x, |x| < 4.5, |x'| < 4.
 * FVI: a sum over k increments, |dx| <= 4 h, is off by k u sum |w_n| |dx| <= 8 k h u;
 * times h^(-1/2), in p; x answers a unit in p by less than 0.6: 3 N^2 h^(1/2) u.
 * Matrix method: a row has N roundings of numbers up to
 * 8 + |x| h^(-3/2) (|w_3| + ...) <= 8 + 0.6 h^(-3/2), and at its end some twenty, those
 * of its elements included, of up to 9 h^-2; x answers a unit in every row by less
 * than 3. Seen: 0.006 of it. */
static double increment_roundings(double N, double h)
{
    return 3 * N * N * sqrt(h) * U;
}

static double row_roundings(double N, double h)
{
    return 3 * (N * (8 + 0.6 * pow(h, -1.5)) + 180 / (h * h)) * U;
}

/* Errors where they are largest on the grid, and the largest at the tenths. */
//> bagley-torvik
static void compare(const double *x, size_t n, size_t k, double exact,
                    double error, double tenths, double bound)
{
    double worst = 0;
    for (size_t j = 0; j < LEN(ref_bagley_torvik); j++)
        worst = fmax(worst, fabs(x[j * n / 10] - ref_bagley_torvik[j]));
    ck_assert_near(fabs(x[k] - exact), error, bound, "h=1/%zu k=%zu", n, k);
    ck_assert_near(worst, tenths, bound, "h=1/%zu, tenths", n);
}

START_TEST(eq_10_8_bagley_torvik_errors)
{
    double last = 0, *benchmark = bagley_torvik(200, 4000, 1);
    for (size_t i = 0; i < LEN(ref_fvi_errors); i++) {
        size_t n = ref_fvi_errors[i].per_unit, N = 20 * n;
        double h = 1 / (double)n, against = 0, *x = bagley_torvik(n, N, 0);
        compare(x, n, ref_fvi_errors[i].k, ref_fvi_errors[i].x,
                ref_fvi_errors[i].error, ref_fvi_errors[i].tenths,
                increment_roundings((double)N, h));
        for (size_t j = 0; j <= 200; j++)
            against = fmax(against, fabs(x[j * n / 10] - benchmark[20 * j]));
        ck_assert_near(against, ref_fvi_errors[i].against,
                       increment_roundings((double)N, h)
                           + row_roundings(4000, 0.005),
                       "against, h=1/%zu", n);
        if (i > 2) /* h < 1/40: the benchmark's own error is in the way */
            ck_assert_double_gt(against, last);
        last = against;
        free(x);
    }
    for (size_t i = 0; i < LEN(ref_matrix_errors); i++) {
        size_t n = ref_matrix_errors[i].per_unit, N = 20 * n;
        double h = 1 / (double)n;
        double *x = n == 200 ? benchmark : bagley_torvik(n, N, 1);
        compare(x, n, ref_matrix_errors[i].k, ref_matrix_errors[i].x,
                ref_matrix_errors[i].error, ref_matrix_errors[i].tenths,
                row_roundings((double)N, h));
        if (n != 200)
            free(x);
    }
    free(benchmark);
}
END_TEST
//< bagley-torvik

int main(void)
{
    gsl_set_error_handler_off(); /* the default handler aborts */
    Suite *suite = suite_create("10 experiments, the panels");
    ADD_CASE(suite, "values", eq_9_3_several_alpha_at_h_one_half,
             eq_10_2_and_10_3_explicit_euler_gains_implicit_loses,
             the_runs_of_the_euler_panels, eq_10_4_global_errors_of_the_fvi,
             eq_10_8_bagley_torvik_errors);
    ADD_CASE(suite, "identities",
             corollary_fvi_is_lagrange_dalembert_to_rounding);
    ADD_CASE(suite, "order", eq_10_6_order_two_against_the_modified_mass,
             eq_10_7_the_constant_of_the_error,
             eq_10_4_orders_of_the_other_methods);
    return run_suite(suite);
}
