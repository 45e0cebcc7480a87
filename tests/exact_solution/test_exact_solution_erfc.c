/* tests/exact_solution/test_exact_solution_erfc.c -- H 11: the exact solution by complex error functions.
 * Run alone: make test-exact_solution_erfc
 *
 * For alpha = 1/4 and 3/4 the transform is rational in w = sqrt(s). So its inverse is a sum of complex error
 * functions, which libcerf computes here. */
#include "exact_problems.h"
#include "system/larger.h"

#include <cerf.h>
#include <complex.h>
#include <gsl/gsl_poly.h>

/* E(z) = exp(z^2) erfc(-z), without overflow where it is moderate. */
static double complex E(double complex z)
{
    return w_of_z(-I * z);
}

/* The answer y to a unit step: m w^4 + rho w^{4 alpha} + c = sum_j has the zeros
 * w_j, 1/Q = sum_j c_j / (w - w_j), c_j = 1/Q'(w_j), and 1/(s (sqrt s - a)) is the
 * transform of (E(a sqrt t) - 1)/a, so that y = sum_j c_j/w_j (E(w_j sqrt t) - 1).
 * largest: the size of the largest term. */
static double step_answer(double m, double c, double rho, int power, double t,
                          double *largest)
{
    double Q[5] = { c, 0, 0, 0, m }, root[8];
    Q[power] = rho; /* w^1 for alpha = 1/4, w^3 for alpha = 3/4 */
    gsl_poly_complex_workspace *work = gsl_poly_complex_workspace_alloc(5);
    ck_assert_int_eq(gsl_poly_complex_solve(Q, 5, work, root), FVI_SUCCESS);
    gsl_poly_complex_workspace_free(work);
    double complex y = 0;
    for (int j = 0; j < 4; j++) {
        double complex w = root[2 * j] + I * root[2 * j + 1], slope = 0;
        for (int i = 4; i >= 1; i--)
            slope = slope * w + i * Q[i];
        double complex term = (E(w * sqrt(t)) - 1) / (slope * w);
        y += term;
        *largest = larger(*largest, cabs(term));
    }
    return creal(y);
}

/* GSL's roots and libcerf are good to 1e-13 each (its manual), and an error e in w_j
 * moves E by 2 |w_j^2| t e: for the t and w_j below at most 200 e. So 4 terms with
 * 1e-13 + 200 * 16 u each, and what fvi_exact_at promises. Seen: 0.09 of it. */
START_TEST(eq_11_14_rational_orders_are_complex_error_functions)
{
    const double problem[][3] = {
        { 1, 1, 1 }, { 1, 1, 0.2 }, { 2, 0.5, 3 }, { 0.3, 4, 0.01 }
    };
    const double times[] = { 0.01, 0.3, 1, 2.5, 7, 20 };
    for (size_t i = 0; i < LEN(problem); i++)
        for (int power = 1; power <= 3; power += 2)
            for (size_t k = 0; k < LEN(times); k++) {
                const double *p = problem[i], t = times[k];
                const fvi_linear_oscillator linear = { .m = p[0],
                                            .c = p[1],
                                            .rho = p[2],
                                            .alpha = power / 4.0,
                                            .past = FVI_INITIAL_HISTORY_CAPUTO,
                                            .forcing = FVI_FORCING_STEP,
                                            .A = 1,
                                            .T = 1e6 };
                double largest = 0;
                double want = step_answer(p[0], p[1], p[2], power, t, &largest);
                double bound =
                    4 * largest * (1e-13 + 200 * 16 * U) + TOL * 2 / p[1];
                ck_assert_near(solve_x(linear, t), want, bound,
                               "m=%g c=%g rho=%g alpha=%g t=%g", p[0], p[1],
                               p[2], power / 4.0, t);
            }
}
END_TEST

/* Bagley-Torvik, 8 on [0, 1]: the difference of two answers. */
START_TEST(eq_11_14_bagley_torvik_by_error_functions)
{
    const fvi_linear_oscillator plate = { .m = 1,
                               .c = 1,
                               .rho = 1,
                               .alpha = 0.75,
                               .past = FVI_INITIAL_HISTORY_CAPUTO,
                               .forcing = FVI_FORCING_STEP,
                               .A = 8,
                               .T = 1 };
    for (double t = 1.25; t <= 20; t += 0.625) {
        double largest = 0;
        double want = 8
                      * (step_answer(1, 1, 1, 3, t, &largest)
                         - step_answer(1, 1, 1, 3, t - 1, &largest));
        ck_assert_near(solve_x(plate, t), want,
                       64 * largest * (1e-13 + 200 * 16 * U), "t=%g", t);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("11 exact solution, by error functions");
    ADD_CASE(suite, "values",
             eq_11_14_rational_orders_are_complex_error_functions,
             eq_11_14_bagley_torvik_by_error_functions);
    return run_suite(suite);
}
