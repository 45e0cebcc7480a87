/* src/stability/stability.c -- Find out whether a step is stable. [H 14]
 *
 * The first part computes the load (14.3), a quarter of the largest eigenvalue of a symmetric matrix. The second part
 * counts the growing modes of the scalar recurrence, and finds the growth of the unstable mode, from its symbol
 * (14.2). */
#include <fvi/stability.h>

#include "stability_share.h"
#include "system/fail.h"
#include "system/larger.h"
#include "system/system_check.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_roots.h>
#include <math.h>
#include <stdlib.h>

/* ---- the load of a step ---- */

static int check(const fvi_run *run, const void *output)
{
    if (!run || !output)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = fvi_system_require_any(run->system);
    if (status)
        return status;
    if (run->system->mechanism && !run->system->matrices)
        FVI_FAIL("the load of a mechanism is not known", FVI_EUNSUP);
    if (!run->x0)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(run->kappa >= 0 && run->kappa <= 1))
        FVI_FAIL("kappa must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(run->h) && run->h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    return FVI_SUCCESS;
}

/* The largest eigenvalue of the symmetric matrix A, which is overwritten. */
static int largest_eigenvalue(size_t d, double *A, double *largest)
{
    gsl_matrix_view matrix = gsl_matrix_view_array(A, d, d);
    double *room = malloc(3 * d * sizeof *room);
    if (!room)
        FVI_FAIL("no memory for the eigenvalues of the load", FVI_ENOMEM);
    gsl_vector_view values = gsl_vector_view_array(room, d);
    gsl_eigen_symm_workspace work = { .size = d, /* fail.h says why not GSL's */
                                      .d = room + d,
                                      .sd = room + 2 * d };
    fvi_quiet();
    const int status = gsl_eigen_symm(&matrix.matrix, &values.vector, &work);
    fvi_loud();
    if (!status)
        *largest = gsl_vector_max(&values.vector);
    free(room);
    if (status)
        FVI_FAIL("no eigenvalues of the load", status);
    return FVI_SUCCESS;
}

/* Return nonzero if the symmetric tridiagonal matrix, with the diagonal a and b beside it, has an eigenvalue above x.
 * The Gaussian elimination of the matrix minus x has as many positive pivots as there are such eigenvalues. */
static int is_above(size_t d, const double *a, const double *b, double x)
{
    double pivot = 1;
    for (size_t i = 0; i < d; i++) {
        pivot = a[i] - x - (i > 0 ? b[i - 1] / pivot * b[i - 1] : 0);
        if (pivot > 0)
            return 1;
        if (pivot == 0)
            pivot = -GSL_DBL_MIN;
    }
    return 0;
}

/* The largest eigenvalue of that matrix by bisection, between the largest entry of a and the largest sum of the
 * absolute values of a row. Cost: about sixty times O(d). */
static double largest_of_tridiagonal(size_t d, const double *a, const double *b)
{
    double low = a[0], high = a[0];
    for (size_t i = 0; i < d; i++) {
        low = larger(low, a[i]);
        high = larger(high, a[i] + (i > 0 ? fabs(b[i - 1]) : 0)
                                + (i + 1 < d ? fabs(b[i]) : 0));
    }
    for (double x; (x = low + (high - low) / 2) > low && x < high;) {
        if (is_above(d, a, b, x))
            low = x;
        else
            high = x;
    }
    return high;
}

/* A Hessian of one or two diagonals is not expanded to a full matrix. */
static int is_tridiagonal(const fvi_system *system)
{
    return system->potential.diagonals == 1 || system->potential.diagonals == 2;
}

static size_t count_numbers(const fvi_system *system)
{
    return is_tridiagonal(system) ? 2 * system->d : fvi_potential_hessian_size(system);
}

/* The matrix of (14.3) for a K of one or two diagonals: its diagonal to A, and the numbers beside it to A + d. */
static int assemble_sum_of_diagonals(const fvi_system *system, double spring,
                                     double damper, const double *K, double *A)
{
    const size_t d = system->d, m = system->potential.diagonals;
    const double *mass = system->mass;
    for (size_t i = 0; i < d; i++) {
        A[i] = (spring * K[i * m] + damper * system->damping[i]) / mass[i];
        A[d + i] = m == 2 && i + 1 < d
                       ? spring * K[i * m + 1] / sqrt(mass[i] * mass[i + 1])
                       : 0;
    }
    if (!fvi_all_finite(2 * d, A))
        FVI_FAIL("the load is not finite", FVI_EOVRFLW);
    return FVI_SUCCESS;
}

/* The full matrix of (14.3), to A. */
static int assemble_sum(const fvi_system *system, double spring, double damper,
                        const double *K, double *A)
{
    const size_t d = system->d;
    //> load
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++) {
            double damping = i == j ? damper * system->damping[i] : 0;
            double mass = sqrt(system->mass[i] * system->mass[j]);
            A[i * d + j] =
                (spring * K[i * d + j] + damping) / mass; /* (14.3) */
            if (!gsl_finite(A[i * d + j]))
                FVI_FAIL("the load is not finite", FVI_EOVRFLW);
        }
    //< load
    return FVI_SUCCESS;
}

/* The factors of K and of rho in (14.3). */
static double spring_of(const fvi_run *run)
{
    return gsl_pow_2((1 - 2 * run->kappa) * run->h);
}

static double damper_of(double share, const fvi_run *run)
{
    return share * pow(4, run->alpha) * pow(run->h, 2 - 2 * run->alpha);
}

/* The load (14.3) with share * rho for rho. K is the Hessian at x0, or NULL for no potential. A is room for the matrix;
 * it is not read if K is NULL. */
static int number_at(double share, const fvi_run *run, const double *K, double *A,
                     double *load)
{
    const fvi_system *system = run->system;
    const double spring = spring_of(run), damper = damper_of(share, run);
    double largest = 0;
    if (!K || spring == 0) { /* only the damping counts, and it is diagonal */
        for (size_t i = 0; i < system->d; i++)
            largest =
                larger(largest, damper * system->damping[i] / system->mass[i]);
    } else if (is_tridiagonal(system)) {
        int status = assemble_sum_of_diagonals(system, spring, damper, K, A);
        if (status)
            return status;
        largest = largest_of_tridiagonal(system->d, A, A + system->d);
    } else {
        int status = assemble_sum(system, spring, damper, K, A);
        if (!status)
            status = largest_eigenvalue(system->d, A, &largest);
        if (status)
            return status;
    }
    if (!gsl_finite(largest))
        FVI_FAIL("the load is not finite", FVI_EOVRFLW);
    *load = largest / 4;
    return FVI_SUCCESS;
}

/* Allocate *K with room for the Hessian and for A, and write the Hessian at x0 to it. The caller frees *K, also after
 * an error. *K is NULL where the load needs no Hessian. */
static int hessian_at_start(const fvi_run *run, double **K)
{
    const fvi_potential *u = &run->system->potential;
    const size_t d = run->system->d;
    *K = NULL;
    if (!u->hessian || run->kappa == 0.5)
        return FVI_SUCCESS;
    *K = malloc(2 * count_numbers(run->system) * sizeof **K);
    if (!*K)
        FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
    return is_tridiagonal(run->system) ? u->hessian(d, run->x0, u->params, *K)
                                       : fvi_potential_hessian(run->system, run->x0, *K);
}

int fvi_stability_share(double share, const fvi_run *run, double *load)
{
    int status = check(run, load);
    if (status)
        return status;
    if (run->system->matrices) {
        const double damper = damper_of(share, run);
        return fvi_stability_of_matrices(spring_of(run), &damper, run, load);
    }
    double *K;
    status = hessian_at_start(run, &K);
    if (!status)
        status =
            number_at(share, run, K, K ? K + count_numbers(run->system) : NULL, load);
    free(K);
    return status;
}

int fvi_stability_of_dampers(const double *damper, const fvi_run *run, double *load)
{
    const int status = check(run, load);
    if (status)
        return status;
    return fvi_stability_of_matrices(spring_of(run), damper, run, load);
}

/* ---- the scalar symbol ---- */

typedef struct {
    double alpha, kappa, W, R;
} symbol;

static int check_symbol(symbol s, const void *output)
{
    if (!output)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(s.alpha >= 0 && s.alpha <= 1 && s.kappa >= 0 && s.kappa <= 1))
        FVI_FAIL("alpha and kappa must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(s.W) && s.W > 0 && gsl_finite(s.R) && s.R > 0))
        FVI_FAIL("W and R must be finite and positive", FVI_EDOM);
    return FVI_SUCCESS;
}

//> symbol
/* arg P(e^{-i f}) for 0 < f <= pi, computed in polar form without complex numbers. (14.2) */
static double argument(symbol s, double f)
{
    double q = s.kappa * (1 - s.kappa), side = 2 * sin(f / 2);
    double modulus = s.R * pow(side, 2 * s.alpha); /* of R (1 - z)^{2 alpha} */
    double angle = s.alpha * (M_PI - f);
    return atan2(modulus * sin(angle),
                 -(1 + q * s.W) * side * side + s.W + modulus * cos(angle));
}
//< symbol

int fvi_unstable_roots(double alpha, double kappa, double W, double R,
                       int *modes)
{
    const symbol s = { alpha, kappa, W, R };
    int status = check_symbol(s, modes);
    if (status)
        return status;
    //> winding
    /* Follow arg P along the half circle from z = 1, where P > 0, to z = -1. The other half of the circle adds as much,
     * because P(conj z) = conj P(z). P has one pole in the disc, at 0. So the number of zeros is one more than the
     * winding number. */
    enum { POINTS = 4096 };
    double turned = 0, last = 0;
    for (int j = 1; j <= POINTS; j++) {
        double now = argument(s, M_PI * gsl_pow_2((double)j / POINTS));
        turned += remainder(now - last, 2 * M_PI); /* the change of the angle, between -pi and pi */
        last = now;
    }
    *modes = 1 - (int)lround(turned / M_PI); /* the path is clockwise, as z = e^{-i f} */
    //< winding
    return FVI_SUCCESS;
}

/* Q(z) on the real axis, -1 <= z < 0. */
static double q_real(double z, void *params)
{
    const symbol *s = params;
    double q = s->kappa * (1 - s->kappa);
    return (1 + q * s->W) * gsl_pow_2(1 - z)
           + z * (s->W + s->R * pow(1 - z, 2 * s->alpha));
}

static int brent(gsl_root_fsolver *solver, gsl_function Q, double end,
                 double *growth)
{
    int status = gsl_root_fsolver_set(solver, &Q, end, 0);
    for (int i = 0; !status && i < 200; i++) {
        status = gsl_root_fsolver_iterate(solver);
        double low = gsl_root_fsolver_x_lower(solver);
        double high = gsl_root_fsolver_x_upper(solver);
        if (!status
            && gsl_root_test_interval(low, high, 0, 4 * GSL_DBL_EPSILON)
                   == FVI_SUCCESS)
            break;
    }
    if (!status)
        *growth = -1 / gsl_root_fsolver_root(solver);
    return status;
}

int fvi_amplification_of_kernel(gsl_function Q, double end, double *growth)
{
    if (GSL_FN_EVAL(&Q, end) >= 0) { /* no change of sign, so no mode grows: (14.3) */
        *growth = 1;
        return FVI_SUCCESS;
    }
    fvi_quiet();
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    int status = solver ? brent(solver, Q, end, growth) : FVI_ENOMEM;
    gsl_root_fsolver_free(solver);
    fvi_loud();
    if (status)
        FVI_FAIL("no root of the symbol", status);
    return FVI_SUCCESS;
}

int fvi_amplification(double alpha, double kappa, double W, double R, double *growth)
{
    symbol s = { alpha, kappa, W, R };
    int status = check_symbol(s, growth);
    if (status)
        return status;
    return fvi_amplification_of_kernel((gsl_function){ q_real, &s }, -1, growth);
}
