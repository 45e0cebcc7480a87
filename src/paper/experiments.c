/* src/paper/experiments.c -- Compute the exact solutions and other references for the numerical section of the paper.
 * [H 10] */
#include <fvi/paper/experiments.h>

#include <fvi/coefficients.h>
#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- the linearly damped oscillator ---- */

/* x = decay (x0 A + v0 G),  v = decay (v0 B - (c/m) x0 G) */
typedef struct {
    double decay, A, B, G;
} modes;

//> discriminant
/* Return rho^2 - 4 m c, within two rounding errors of its exact value (Kahan). */
static double discriminant(double m, double rho, double c)
{
    double product = 4 * m * c;
    double lost = fma(-4 * m, c, product); /* product - 4 m c, exactly */
    return fma(rho, rho, -product) + lost;
}
//< discriminant

static modes modes_at(double m, double rho, double c, double t)
{
    const double disc = discriminant(m, rho, c);
    const double s = sqrt(fabs(disc)) / (2 * m);
    if (disc < 0) { /* (10.1), under-damped */
        const double rate = rho / (2 * m), G = sin(s * t) / s;
        return (modes){ exp(-rate * t), cos(s * t) + rate * G,
                        cos(s * t) - rate * G, G };
    }
    const double slow = c > 0 ? 2 * c / (rho + sqrt(disc)) : 0;
    const double G = disc > 0 ? -expm1(-2 * s * t) / (2 * s) : t;
    return (modes){ exp(-slow * t), 1 + slow * G, exp(-2 * s * t) - slow * G,
                    G };
}

static int in_range(double value, int zero_too)
{
    return (value >= 1e-140 && value <= 1e140) || (zero_too && value == 0);
}

int fvi_damped_oscillator(double m, double rho, double c, double x0, double p0,
                          double t, double *x, double *p)
{
    if (!x && !p)
        FVI_FAIL("no output is wanted", FVI_EFAULT);
    if (!in_range(m, 0) || !in_range(rho, 1) || !in_range(c, 1))
        FVI_FAIL("m, rho or c is out of range", FVI_EDOM);
    if (!gsl_finite(x0) || !gsl_finite(p0))
        FVI_FAIL("x0 and p0 must be finite", FVI_EDOM);
    if (!(gsl_finite(t) && t >= 0))
        FVI_FAIL("t must be finite and not negative", FVI_EDOM);
    const modes e = modes_at(m, rho, c, t);
    const double at = e.decay * (x0 * e.A + p0 / m * e.G);
    const double momentum = e.decay * (p0 * e.B - c * x0 * e.G);
    if (!gsl_finite(at) || !gsl_finite(momentum))
        FVI_FAIL("the solution is not a finite number", FVI_EOVRFLW);
    if (x)
        *x = at;
    if (p)
        *p = momentum;
    return FVI_SUCCESS;
}

int fvi_oscillator_errors(const fvi_method *method, double m, double rho,
                          double c, double x0, double p0, double h, size_t N,
                          double errors[3])
{
    if (!errors)
        FVI_FAIL("errors is a null pointer", FVI_EFAULT);
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c) };
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = h,
                          .steps = N,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    fvi_stepper *s;
    int status = fvi_stepper_start(method, &run, &s, NULL);
    if (status)
        return status;
    double worst[3] = { 0 };
    //> errors
    while (s->k < N && (status = fvi_stepper_step(s)) == FVI_SUCCESS) {
        double x, p, E, E_k; /* the row k = 0 has no error */
        status = fvi_damped_oscillator(m, rho, c, x0, p0, s->t, &x, &p);
        if (!status)
            status = fvi_energy(&system, &x, &p, &E);
        if (!status)
            status = fvi_energy(&system, s->x, s->p, &E_k);
        if (status)
            break;
        worst[0] = larger(worst[0], fabs(s->x[0] - x)); /* (10.2) */
        worst[1] = larger(worst[1], fabs(s->p[0] - p));
        worst[2] = larger(worst[2], fabs(E_k - E));
    }
    //< errors
    fvi_stepper_free(s);
    if (!status)
        memcpy(errors, worst, sizeof worst);
    return status;
}

/* ---- Podlubny's matrix method ---- */

static int check_matrix_method(double m, double rho, double c, double alpha,
                               double h, size_t N, const double *x)
{
    if (!x)
        FVI_FAIL("x is a null pointer", FVI_EFAULT);
    if (N < 2 || N >= SIZE_MAX / sizeof(double) / 2 - 1)
        FVI_FAIL("N must be at least 2 and addressable", FVI_EINVAL);
    if (!(gsl_finite(m) && m > 0))
        FVI_FAIL("m must be finite and positive", FVI_EDOM);
    if (!(gsl_finite(rho) && rho >= 0 && gsl_finite(c) && c >= 0))
        FVI_FAIL("rho and c must be finite and not negative", FVI_EDOM);
    if (!(alpha >= 0 && alpha <= 1))
        FVI_FAIL("alpha must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(h) && h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    return FVI_SUCCESS;
}

/* Compute the first column a_0, ..., a_N of the matrix in (10.9), which determines the whole matrix. */
static int column(double m, double rho, double c, double alpha, double h,
                  size_t N, double *a)
{
    int status = fvi_gl_weights(2 * alpha, N + 1, a);
    if (status)
        return status;
    const double inertia[] = { m / (h * h), -2 * m / (h * h), m / (h * h) };
    for (size_t n = 0; n <= N; n++)
        a[n] *= rho * pow(h, -2 * alpha);
    for (size_t n = 0; n < 3; n++)
        a[n] += inertia[n];
    a[0] += c;
    return FVI_SUCCESS;
}

static int force_at(fvi_force force, double t, double *F)
{
    *F = 0;
    return force.value ? force.value(t, 1, force.params, F) : FVI_SUCCESS;
}

/* Copy the n values y to x, if all of them are finite. Return FVI_SUCCESS or FVI_EOVRFLW. */
static int copy_if_finite(size_t n, const double *y, double *x)
{
    if (!fvi_all_finite(n, y))
        FVI_FAIL("a value is not finite", FVI_EOVRFLW);
    memcpy(x, y, n * sizeof *x);
    return FVI_SUCCESS;
}

int fvi_matrix_method(double m, double rho, double c, double alpha,
                      fvi_force force, double h, size_t N, double *x)
{
    int status = check_matrix_method(m, rho, c, alpha, h, N, x);
    if (status)
        return status;
    double *a = calloc(2 * (N + 1), sizeof *a);
    if (!a)
        FVI_FAIL("no memory for a row of the matrix", FVI_ENOMEM);
    double *y = a + N + 1;
    status = column(m, rho, c, alpha, h, N, a);
    //> substitution
    for (size_t k = 2; k <= N && !status; k++) {
        double rest;
        status = force_at(force, (double)k * h, &rest);
        for (size_t j = 2; j < k && !status; j++)
            rest -= a[k - j] * y[j];
        y[k] = rest / a[0];
    }
    //< substitution
    if (!status)
        status = copy_if_finite(N + 1, y, x);
    free(a);
    return status;
}

int fvi_matrix_method_simple(double m, double rho, double c, double alpha,
                             fvi_force force, double h, size_t N, double *x)
{
    int status = check_matrix_method(m, rho, c, alpha, h, N, x);
    if (status)
        return status;
    if (N + 1 > SIZE_MAX / sizeof(double) / (N + 1))
        FVI_FAIL("the matrix must be addressable", FVI_EINVAL);
    const size_t rows = N - 1; /* k = 2, ..., N */
    double *a = calloc(2 * (N + 1) + rows * rows, sizeof *a);
    if (!a)
        FVI_FAIL("no memory for the matrix", FVI_ENOMEM);
    double *y = a + N + 1;
    status = column(m, rho, c, alpha, h, N, a);
    //> matrix
    gsl_matrix_view A = gsl_matrix_view_array(y + N + 1, rows, rows);
    gsl_vector_view X = gsl_vector_view_array(y + 2, rows);
    for (size_t i = 0; i < rows && !status; i++) {
        for (size_t j = 0; j <= i; j++)
            gsl_matrix_set(&A.matrix, i, j, a[i - j]);
        status = force_at(force, (double)(i + 2) * h, y + i + 2);
    }
    if (!status)
        status = gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit,
                                &A.matrix, &X.vector);
    //< matrix
    if (!status)
        status = copy_if_finite(N + 1, y, x);
    free(a);
    return status;
}

/* ---- the order that is seen ---- */

int fvi_observed_order(size_t n, const double *h, const double *error,
                       double *order, double *K)
{
    if (!h || !error || (!order && !K))
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (n < 2 || n > SIZE_MAX / sizeof(double) / 2)
        FVI_FAIL("n must be at least 2 and addressable", FVI_EINVAL);
    int differ = 0;
    for (size_t i = 0; i < n; i++) {
        if (!(gsl_finite(h[i]) && h[i] > 0))
            FVI_FAIL("h must be finite and positive", FVI_EDOM);
        if (!(gsl_finite(error[i]) && error[i] > 0))
            FVI_FAIL("errors must be finite and positive", FVI_EDOM);
        differ += h[i] != h[0];
    }
    if (!differ)
        FVI_FAIL("a line needs two different h", FVI_EDOM);
    double *a = malloc(2 * n * sizeof *a);
    if (!a)
        FVI_FAIL("no memory for the logarithms", FVI_ENOMEM);
    double *b = a + n, c0, c1, cov00, cov01, cov11, rest;
    for (size_t i = 0; i < n; i++) {
        a[i] = log(h[i]);
        b[i] = log(error[i]);
    }
    gsl_fit_linear(a, 1, b, 1, n, &c0, &c1, &cov00, &cov01, &cov11, &rest);
    free(a);
    if (order)
        *order = c1;
    if (K)
        *K = exp(c0);
    return FVI_SUCCESS;
}
