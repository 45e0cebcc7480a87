/* src/stability/stability_explicit.c -- The load of Euler's explicit method. [H 14]
 *
 * The load is the largest h |s|^2 / (-2 Re s) over the exponents s of the motion (14.8). For masses without springs
 * between them each s is a root of a quadratic equation. Otherwise the exponents are the eigenvalues of a matrix of
 * size 2 d. */

#include "stability_share.h"
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* With more coupled masses than this, the search for all exponents would take too long. */
enum { MOST_COUPLED_MASSES = 64 };

//> mode
/* h |s|^2 / (-2 Re s) of both roots s of m s^2 + rho s + c = 0, the larger of the two. (14.8) */
static double number_of_mode(double h, double m, double rho, double c)
{
    const double square = rho * rho, four = 4 * m * c;
    const double gap = (square - four) /* the rounding errors of both products */
                       + (fma(rho, rho, -square) - fma(4 * m, c, -four));
    if (gap < 0) /* a pair of complex roots: |s|^2 = c / m, -2 Re s = rho / m */
        return h * c / rho;
    return h / m * (rho + sqrt(gap)) / 4;
}
//< mode

/* The load of masses without springs between them. K: the diagonal of the Hessian, or NULL for no springs. */
static double number_of_separate_masses(const fvi_run *run, const double *K)
{
    const fvi_system *system = run->system;
    double largest = 0;
    for (size_t i = 0; i < system->d; i++) {
        const double load =
            number_of_mode(run->h, system->mass[i], system->damping[i], K ? K[i] : 0);
        if (!(load <= largest)) /* so that a NaN is kept */
            largest = load;
    }
    return largest;
}

/* h |s|^2 / (-2 Re s) of one exponent s; `largest` is the largest |s| of all exponents. Two kinds of exponents count as
 * 0: a rounded zero, of some sqrt(u) times `largest`, which is a body at rest; and a real s > 0, because such a motion
 * grows whatever the step is. */
static double number_of_exponent(double h, gsl_complex s, double largest)
{
    const double size = gsl_complex_abs(s), re = GSL_REAL(s);
    if (size <= 1e-7 * largest || (GSL_IMAG(s) == 0 && re > 0))
        return 0;
    if (re > -1e-13 * largest)
        return GSL_POSINF; /* an undamped motion */
    return h * size * (size / (-2 * re));
}

/* The matrix A of (x, v)' = A (x, v), in units in which the masses are 1. */
static void first_order(const fvi_system *system, const double *K, double *A)
{
    const size_t d = system->d;
    const double *m = system->mass;
    for (size_t i = 0; i < d; i++) {
        double *velocity = A + i * 2 * d, *force = A + (d + i) * 2 * d;
        memset(velocity, 0, 2 * d * sizeof *A);
        velocity[d + i] = 1;
        for (size_t j = 0; j < d; j++) {
            force[j] = -K[i * d + j] / sqrt(m[i] * m[j]);
            force[d + j] = 0;
        }
        force[d + i] = -system->damping[i] / m[i];
    }
}

/* The load of masses with springs between them, from all exponents of the motion. K: the full Hessian, d^2 numbers. */
static int number_of_coupled_masses(const fvi_run *run, const double *K, double *load)
{
    const size_t n = 2 * run->system->d;
    int status = FVI_ENOMEM;
    double *A = malloc(n * n * sizeof *A);
    fvi_quiet();
    gsl_vector_complex *s = gsl_vector_complex_alloc(n);
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(n);
    if (A && s && work) {
        first_order(run->system, K, A);
        gsl_eigen_nonsymm_params(0, 1, work); /* balance the matrix; no Schur form */
        gsl_matrix_view matrix = gsl_matrix_view_array(A, n, n);
        status = fvi_all_finite(n * n, A)
                     ? gsl_eigen_nonsymm(&matrix.matrix, s, work)
                     : FVI_EOVRFLW;
    }
    double largest = 0;
    for (size_t i = 0; !status && i < n; i++)
        largest =
            larger(largest, gsl_complex_abs(gsl_vector_complex_get(s, i)));
    *load = 0;
    for (size_t i = 0; !status && i < n; i++)
        *load = larger(
            *load, number_of_exponent(run->h, gsl_vector_complex_get(s, i), largest));
    free(A);
    gsl_vector_complex_free(s);
    gsl_eigen_nonsymm_free(work);
    fvi_loud();
    if (status)
        FVI_FAIL("no exponents of the motion", status);
    return FVI_SUCCESS;
}

/* The load with the Hessian at x0. */
static int number_of_hessian(const fvi_run *run, double *load)
{
    const fvi_system *system = run->system;
    const fvi_potential *u = &system->potential;
    const int separate = u->diagonals == 1 || system->d == 1;
    if (!separate && system->d > MOST_COUPLED_MASSES)
        FVI_FAIL("the load of so many coupled masses is not known", FVI_EUNSUP);
    double *K = malloc(
        (u->diagonals == 1 ? system->d : fvi_potential_hessian_size(system)) * sizeof *K);
    if (!K)
        FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
    int status = u->diagonals == 1
                     ? u->hessian(system->d, run->x0, u->params, K)
                     : fvi_potential_hessian(system, run->x0, K);
    if (!status && separate)
        *load = number_of_separate_masses(run, K);
    else if (!status)
        status = number_of_coupled_masses(run, K, load);
    free(K);
    return status;
}

int fvi_stability_explicit(const fvi_run *run, double *load)
{
    double there = 0; /* this call checks the run; its result is not used */
    fvi_run half = *run;
    half.kappa = 0.5;
    int status = fvi_stability_share(0, &half, &there);
    if (!status && run->system->potential.hessian)
        status = number_of_hessian(run, &there);
    else if (!status)
        there = number_of_separate_masses(run, NULL);
    if (!status && isnan(there))
        FVI_FAIL("the load is not finite", FVI_EOVRFLW);
    if (!status)
        *load = there;
    return status;
}
