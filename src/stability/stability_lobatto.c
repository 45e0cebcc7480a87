/* src/stability/stability_lobatto.c -- Compute the load of the methods with stages, form M. [H 17]
 *
 * A mode z^{-k} grows if the symbol S(z) of a step (17.18) is singular for a z inside the unit circle. The load
 * compares the ends z = -1 and z = 1 of the real interval, where S is a real matrix. For one mass
 *
 *     S = E^T [-K + W B + R B f(Delta)] E,   W = h^2 c / m,   R = h^(2 - 2 alpha) rho / m, or h^2 rho / m with a law,
 *
 * where K = D^T B D is the matrix of the kinetic energy, B = diag(b) has the weights of the stages, f(Delta) =
 * Delta^(2 alpha), or C(Delta/h) with a law, and the columns of E make all stages out of the unknowns. */
#include <fvi/stability.h>
#include "kernel/kernel_terms.h"
#include "stages/lobatto_weights.h"
#include "system/fail.h"
#include "system/system_check.h"
#include "system/larger.h"

#include <complex.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The symbol at z = 1 or z = -1, for all W and R: S = (E^T K E) (W B + R A - 1). */
typedef struct {
    size_t n;                         /* number of unknowns; B and A are n x n */
    double B[FVI_STAGES][FVI_STAGES]; /* (E^T K E)^-1 E^T B E */
    double A[FVI_STAGES][FVI_STAGES]; /* (E^T K E)^-1 E^T B f(Delta) E */
} end_symbol;

/* Compute the eigenvalues of an n x n matrix with rows of FVI_STAGES numbers. a is overwritten. */
static int compute_eigenvalues(size_t n, double a[FVI_STAGES][FVI_STAGES],
                               double complex *lambda)
{
    gsl_matrix_view A = gsl_matrix_view_array_with_tda(a[0], n, n, FVI_STAGES);
    fvi_quiet();
    gsl_vector_complex *values = gsl_vector_complex_alloc(n);
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(n);
    int status = FVI_ENOMEM;
    if (values && work)
        status = gsl_eigen_nonsymm(&A.matrix, values, work);
    for (size_t j = 0; !status && j < n; j++)
        lambda[j] = values->data[2 * j] + I * values->data[2 * j + 1];
    gsl_vector_complex_free(values);
    gsl_eigen_nonsymm_free(work);
    fvi_loud();
    if (status)
        FVI_FAIL("no eigenvalues of the symbol", status);
    return FVI_SUCCESS;
}

/* Return f at the eigenvalue lambda of Delta(z): lambda^(2 alpha), or C(lambda/h) with a law. The value for lambda = 0
 * has no effect, because that eigenvalue belongs to the constant path, which make_end_symbol leaves out. */
static double complex damping_symbol(const fvi_run *run, double complex lambda)
{
    double complex slope;
    if (lambda == 0)
        return 0;
    return run->law ? fvi_kernel_at(run->law, lambda / run->h, &slope)
                    : cpow(lambda, 2 * run->alpha);
}

//> power
/* Compute out = f(Delta(z)), z = 1 or -1, by Lagrange's formula on the eigenvalues of Delta, which are distinct:
 * f(Delta) = sum_j f(lambda_j) prod_{i != j} (Delta - lambda_i)/(lambda_j - lambda_i). At z = 1 one eigenvalue is 0,
 * and its rounded value is replaced by 0. */
static int apply_damping_symbol(size_t s, double z, const fvi_run *run,
                                double out[FVI_STAGES][FVI_STAGES])
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    double D[FVI_STAGES][FVI_STAGES], copy[FVI_STAGES][FVI_STAGES];
    double complex lambda[FVI_STAGES];
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++) {
            D[i][j] = rule->D[i][j];
            if (i == 0 && (j == 0 || j + 1 == s))
                D[i][j] += (j == 0 ? 1 : -z) / rule->b[0]; /* (17.5) */
            copy[i][j] = D[i][j];
            out[i][j] = 0;
        }
    int status = compute_eigenvalues(s, copy, lambda);
    for (size_t j = 0; !status && j < s; j++) {
        if (cabs(lambda[j]) < 1e-6)
            lambda[j] = 0;
        for (size_t c = 0; c < s; c++) { /* column c of the j-th term */
            double complex v[FVI_STAGES] = { 0 }, next[FVI_STAGES];
            v[c] = damping_symbol(run, lambda[j]);
            for (size_t i = 0; i < s; i++) {
                if (i == j)
                    continue;
                for (size_t r = 0; r < s; r++) { /* next = (Delta - lambda_i) v */
                    next[r] = -lambda[i] * v[r];
                    for (size_t l = 0; l < s; l++)
                        next[r] += D[r][l] * v[l];
                }
                for (size_t r = 0; r < s; r++)
                    v[r] = next[r] / (lambda[j] - lambda[i]);
            }
            for (size_t r = 0; r < s; r++)
                out[r][c] += creal(v[r]);
        }
    }
    return status;
}
//< power

/* Compute out = E^T X E, n x n. X is s x s, and E has n columns of s numbers. */
static void project(size_t s, size_t n, double E[FVI_STAGES][FVI_STAGES],
                    double X[FVI_STAGES][FVI_STAGES],
                    double out[FVI_STAGES][FVI_STAGES])
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            out[i][j] = 0;
            for (size_t r = 0; r < s; r++)
                for (size_t c = 0; c < s; c++)
                    out[i][j] += E[r][i] * X[r][c] * E[c][j];
        }
}

/* Compute E, whose columns make all stages out of the unknowns, and return the number of unknowns. At z = -1 the
 * unknowns are the stages X_1, ..., X_{s-1}, and X_s = -X_1. At z = 1, where X_s = X_1, the constant path is left out,
 * because its S is W. The other paths have the mean zero, so there are s - 2 unknowns: X_2, ..., X_{s-1}, before the
 * mean is subtracted from all stages. */
static size_t make_paths(size_t s, double z, const double *b, double E[FVI_STAGES][FVI_STAGES])
{
    const size_t left_out = z > 0 ? 1 : 0, n = s - 1 - left_out;
    for (size_t j = 0; j < n; j++)
        E[j + left_out][j] = 1;
    if (z < 0)
        E[s - 1][0] = -1;
    for (size_t j = 0; z > 0 && j < n; j++) /* subtract the mean of column j, which is b[j + 1] */
        for (size_t i = 0; i < s; i++)
            E[i][j] -= b[j + 1];
    return n;
}

/* Replace X by K^-1 X, n x n. K has the Cholesky factors. */
static void solve_columns(size_t n, const gsl_matrix *K, double X[FVI_STAGES][FVI_STAGES])
{
    for (size_t j = 0; j < n; j++) {
        gsl_vector_view column = gsl_vector_view_array_with_stride(&X[0][j], FVI_STAGES, n);
        gsl_linalg_cholesky_svx(K, &column.vector);
    }
}

//> turn
/* Compute the symbol at z = -1 or z = 1. Return FVI_SUCCESS or the code of GSL. */
static int make_end_symbol(size_t s, double z, const fvi_run *run, end_symbol *symbol)
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    const double *b = rule->b;
    double E[FVI_STAGES][FVI_STAGES] = { { 0 } }, K[FVI_STAGES][FVI_STAGES],
           X[FVI_STAGES][FVI_STAGES] = { { 0 } }; /* D^T B D, then B, then B f(Delta) */
    const size_t n = symbol->n = make_paths(s, z, b, E);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++)
            for (size_t l = 0; l < s; l++)
                X[i][j] += rule->D[l][i] * b[l] * rule->D[l][j];
    project(s, n, E, X, K);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++)
            X[i][j] = i == j ? b[i] : 0;
    project(s, n, E, X, symbol->B);
    int status = apply_damping_symbol(s, z, run, X);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++)
            X[i][j] *= b[i];
    project(s, n, E, X, symbol->A);
    gsl_matrix_view k = gsl_matrix_view_array_with_tda(K[0], n, n, FVI_STAGES);
    fvi_quiet(); /* K may be singular to rounding */
    if (!status)
        status = gsl_linalg_cholesky_decomp1(&k.matrix);
    fvi_loud();
    if (!status) {
        solve_columns(n, &k.matrix, symbol->B);
        solve_columns(n, &k.matrix, symbol->A);
    }
    return status;
}
//< turn

//> load
/* Compute the load at one end from the real eigenvalues of W B + R A. If an odd number of them exceeds 1, S is
 * singular for a z between this end and 0, so a mode grows. Then the load is the largest real eigenvalue. Otherwise the
 * load is the largest one that does not exceed 1, or 0. */
static int compute_load_at_end(const end_symbol *symbol, double W, double R, double *load)
{
    double G[FVI_STAGES][FVI_STAGES], below = 0, above = 0;
    double complex mu[FVI_STAGES];
    for (size_t i = 0; i < symbol->n; i++)
        for (size_t j = 0; j < symbol->n; j++)
            G[i][j] = W * symbol->B[i][j] + R * symbol->A[i][j];
    int status = symbol->n > 0 ? compute_eigenvalues(symbol->n, G, mu) : FVI_SUCCESS, odd = 0;
    for (size_t j = 0; !status && j < symbol->n; j++) {
        const double real = creal(mu[j]);
        if (cimag(mu[j]) != 0)
            continue;
        if (real > 1) {
            odd = !odd;
            above = larger(above, real);
        } else
            below = larger(below, real);
    }
    *load = odd ? above : below;
    return status;
}
//< load

static int check(size_t stages, const fvi_run *run, const void *load)
{
    if (!run || !load)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!fvi_lobatto(stages))
        FVI_FAIL("the stages must be 2 to 8", FVI_EINVAL);
    int status = fvi_system_require(run->system);
    if (status)
        return status;
    if (!run->x0)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(run->alpha >= 0 && run->alpha <= 1))
        FVI_FAIL("alpha must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(run->h) && run->h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    return run->law ? fvi_kernel_check(run->law) : FVI_SUCCESS;
}

/* Raise *load to the load of a mode with these W and R, if that is larger at one of both ends. Return FVI_SUCCESS;
 * FVI_EOVRFLW if W or R is NaN or infinite; or the code of the eigenvalues. */
static int raise_load_by_mode(const end_symbol ends[2], double W, double R, double *load)
{
    if (!gsl_finite(W) || !gsl_finite(R))
        FVI_FAIL("the load is not finite", FVI_EOVRFLW);
    for (size_t i = 0; i < 2; i++) {
        double load_at_end = 0;
        int status = compute_load_at_end(ends + i, W, R, &load_at_end);
        if (status)
            return status;
        *load = larger(*load, load_at_end);
    }
    return FVI_SUCCESS;
}

//> modes
/* Raise *load to the largest load of the modes of a system. The modes are the eigenvectors v of W + share R, where W is
 * the matrix M^{-1/2} h^2 H M^{-1/2} with the Hessian H of the potential, and R is diagonal, d numbers: the R of each
 * coordinate. In the load of a mode, v^T W v and v^T R v take the places of W and R. For s = 2 the caller chooses the
 * share so that the sum is 4 times the matrix of (17.16). Where W and R commute, the modes are the same for every
 * share. */
static int raise_load_by_all_modes(const end_symbol ends[2], double share, size_t d,
                                   const double *W, const double *R, double *load)
{
    double *V = malloc((2 * d + 5) * d * sizeof *V);
    if (!V)
        FVI_FAIL("no memory for the modes of the system", FVI_ENOMEM);
    double *G = V + d * d, *room = G + d * d;
    gsl_matrix_view matrix = gsl_matrix_view_array(G, d, d),
                    modes = gsl_matrix_view_array(V, d, d);
    gsl_vector_view values = gsl_vector_view_array(room, d);
    gsl_eigen_symmv_workspace work = { .size = d, /* GSL's own allocation may leak (fail.h) */
                                       .d = room + d,
                                       .sd = room + 2 * d,
                                       .gc = room + 3 * d,
                                       .gs = room + 4 * d };
    memcpy(G, W, d * d * sizeof *W);
    for (size_t i = 0; i < d; i++)
        G[i * d + i] += share * R[i];
    /* GSL's function has no error but wrong sizes, and the sizes agree. */
    int status = gsl_eigen_symmv(&matrix.matrix, &values.vector, &modes.matrix, &work);
    for (size_t j = 0; !status && j < d; j++) {
        double spring = 0, damper = 0;
        for (size_t i = 0; i < d; i++) {
            const double v = V[i * d + j];
            for (size_t l = 0; l < d; l++)
                spring += v * W[i * d + l] * V[l * d + j];
            damper += v * R[i] * v;
        }
        status = raise_load_by_mode(ends, spring, damper, load);
    }
    free(V);
    return status;
}
//< modes

int fvi_stability_lobatto(size_t stages, const fvi_run *run, double *load)
{
    end_symbol ends[2]; /* for z = -1 and for z = 1 */
    int status = check(stages, run, load);
    if (!status)
        status = make_end_symbol(stages, -1, run, ends);
    if (!status)
        status = make_end_symbol(stages, 1, run, ends + 1);
    if (status)
        return status;
    const fvi_system *system = run->system;
    const fvi_potential *u = &system->potential;
    const size_t d = system->d,
                 entries = u->hessian ? fvi_potential_hessian_size(system) : 0;
    double *R = malloc((d + entries) * sizeof *R), largest_load = 0;
    if (!R)
        FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
    double *W = R + d; /* h^2 times the Hessian, divided by the roots of the masses of row and column */
    for (size_t i = 0; i < d; i++) {
        R[i] = pow(run->h, run->law ? 2 : 2 - 2 * run->alpha)
               * system->damping[i] / system->mass[i];
        if (!status && !u->hessian)
            status = raise_load_by_mode(ends, 0, R[i], &largest_load);
    }
    if (u->hessian)
        status = fvi_potential_hessian(system, run->x0, W);
    if (u->hessian && !status) {
        for (size_t i = 0; i < d * d; i++)
            W[i] *= gsl_pow_2(run->h)
                    / sqrt(system->mass[i / d] * system->mass[i % d]);
        const double share = stages == 2 ? ends->A[0][0] / ends->B[0][0] : 1;
        status = raise_load_by_all_modes(ends, share, d, W, R, &largest_load);
    }
    free(R);
    if (!status)
        *load = largest_load;
    return status;
}
