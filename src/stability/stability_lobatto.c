/* src/stability/stability_lobatto.c -- The load of the methods with stages, form M. [H 17]
 *
 * A mode z^{-k} grows if the symbol S(z) of a step (17.18) is singular for a z inside the unit circle. The load
 * compares the ends z = -1 and z = 1 of the real interval, where S is a real matrix. */
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

/* The symbol S(z) of (17.18) at z = 1 or z = -1, where it is real. K is the matrix of the kinetic energy, and
 * S = K (W B + R A - 1); B and A here are n x n. */
typedef struct {
    size_t n;
    double B[FVI_STAGES][FVI_STAGES], A[FVI_STAGES][FVI_STAGES];
} turn;

/* The eigenvalues of an n x n matrix with rows of FVI_STAGES numbers; a is overwritten. */
static int eigenvalues(size_t n, double a[FVI_STAGES][FVI_STAGES],
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

/* The symbol of the damping at the eigenvalue lambda of Delta(z): lambda^(2 alpha), or C(lambda/h) of a law. The value
 * for lambda = 0 has no effect, because that eigenvalue belongs to the constant path, which make_turn leaves out. */
static double complex damping_symbol(const fvi_run *run, double complex lambda)
{
    double complex slope;
    if (lambda == 0)
        return 0;
    return run->law ? fvi_kernel_at(run->law, lambda / run->h, &slope)
                    : cpow(lambda, 2 * run->alpha);
}

//> power
/* Apply `damped` to the matrix Delta(z), z = 1 or -1, by Lagrange's formula on its eigenvalues, which are distinct:
 * sum_j f(lambda_j) prod_{i != j} (Delta - lambda_i)/(lambda_j - lambda_i). At z = 1 one eigenvalue is 0, and its
 * rounded value is replaced by 0. */
static int power(size_t s, double z, const fvi_run *run,
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
    int status = eigenvalues(s, copy, lambda);
    for (size_t j = 0; !status && j < s; j++) {
        if (cabs(lambda[j]) < 1e-6)
            lambda[j] = 0;
        for (size_t c = 0; c < s; c++) { /* column c of the j-th term */
            double complex v[FVI_STAGES] = { 0 }, next[FVI_STAGES];
            v[c] = damping_symbol(run, lambda[j]);
            for (size_t i = 0; i < s; i++) {
                for (size_t r = 0; i != j && r < s; r++) {
                    next[r] = -lambda[i] * v[r];
                    for (size_t l = 0; l < s; l++)
                        next[r] += D[r][l] * v[l];
                }
                for (size_t r = 0; i != j && r < s; r++)
                    v[r] = next[r] / (lambda[j] - lambda[i]);
            }
            for (size_t r = 0; r < s; r++)
                out[r][c] += creal(v[r]);
        }
    }
    return status;
}
//< power

/* out = E^T b X E, for the columns E. */
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

//> turn
/* The stages of a step are E times the unknowns. At z = -1 the unknowns are X_1, ..., X_{s-1}, and X_s = -X_1. At z =
 * 1, where X_s = X_1, the constant path is left out (its S is W), and the other paths have the mean zero: s - 2
 * unknowns. */
static int make_turn(size_t s, double z, const fvi_run *run, turn *t)
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    const double *b = rule->b;
    double E[FVI_STAGES][FVI_STAGES] = { { 0 } }, K[FVI_STAGES][FVI_STAGES],
           X[FVI_STAGES][FVI_STAGES] = { { 0 } };
    const size_t skip = z > 0;
    t->n = s - 1 - skip;
    for (size_t j = 0; j < t->n; j++) {
        E[j + skip][j] = 1;
        for (size_t i = 0; z > 0 && i < s; i++)
            E[i][j] -= b[j + 1];
    }
    if (z < 0)
        E[s - 1][0] = -1;
    for (size_t i = 0; i < s; i++) /* K = D^T B D */
        for (size_t j = 0; j < s; j++)
            for (size_t l = 0; l < s; l++)
                X[i][j] += rule->D[l][i] * b[l] * rule->D[l][j];
    project(s, t->n, E, X, K);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++)
            X[i][j] = i == j ? b[i] : 0;
    project(s, t->n, E, X, t->B);
    int status = power(s, z, run, X);
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++)
            X[i][j] *= b[i];
    project(s, t->n, E, X, t->A);
    gsl_matrix_view k =
        gsl_matrix_view_array_with_tda(K[0], t->n, t->n, FVI_STAGES);
    fvi_quiet(); /* K may be singular to rounding */
    if (!status)
        status = gsl_linalg_cholesky_decomp1(&k.matrix);
    fvi_loud();
    for (size_t j = 0; !status && j < t->n; j++) {
        gsl_vector_view B =
            gsl_vector_view_array_with_stride(&t->B[0][j], FVI_STAGES, t->n);
        gsl_vector_view A =
            gsl_vector_view_array_with_stride(&t->A[0][j], FVI_STAGES, t->n);
        gsl_linalg_cholesky_svx(&k.matrix, &B.vector);
        gsl_linalg_cholesky_svx(&k.matrix, &A.vector);
    }
    return status;
}
//< turn

//> load
/* S has a zero in (-1, 0), or in (0, 1) at the end z = 1, if an odd number of the real eigenvalues exceeds 1. The load
 * is then the largest of the real eigenvalues, and otherwise the largest of those that do not exceed 1. */
static int number_of_run(const turn *t, double W, double R, double *load)
{
    double G[FVI_STAGES][FVI_STAGES], below = 0, above = 0;
    double complex mu[FVI_STAGES];
    for (size_t i = 0; i < t->n; i++)
        for (size_t j = 0; j < t->n; j++)
            G[i][j] = W * t->B[i][j] + R * t->A[i][j];
    int status = t->n > 0 ? eigenvalues(t->n, G, mu) : FVI_SUCCESS, odd = 0;
    for (size_t j = 0; !status && j < t->n; j++) {
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

/* Raise *load to the larger load of the two ends. FVI_EOVRFLW if W or R is NaN or infinite. */
static int number_of_mode(const turn ends[2], double W, double R, double *load)
{
    if (!gsl_finite(W) || !gsl_finite(R))
        FVI_FAIL("the load is not finite", FVI_EOVRFLW);
    for (size_t i = 0; i < 2; i++) {
        double part = 0;
        int status = number_of_run(ends + i, W, R, &part);
        if (status)
            return status;
        *load = larger(*load, part);
    }
    return FVI_SUCCESS;
}

//> modes
/* The load of a system is the largest load of its modes. The modes are the eigenvectors v of W + share R, with W =
 * M^{-1/2} h^2 K M^{-1/2} and R = M^{-1} h^(2 - 2 alpha) rho, or M^{-1} h^2 rho with a law; R is diagonal, d numbers.
 * In the load of a mode, v^T W v stands for h^2 c / m, and v^T R v for R. For s = 2 the share is such that the sum is 4
 * times the matrix of (17.16). Where W and R commute, the modes are the same for every share. */
static int number_of_modes(const turn ends[2], double share, size_t d,
                           const double *W, const double *R, double *load)
{
    double *V = malloc((2 * d + 5) * d * sizeof *V);
    if (!V)
        FVI_FAIL("no memory for the modes of the system", FVI_ENOMEM);
    double *G = V + d * d, *room = G + d * d;
    gsl_matrix_view matrix = gsl_matrix_view_array(G, d, d),
                    modes = gsl_matrix_view_array(V, d, d);
    gsl_vector_view values = gsl_vector_view_array(room, d);
    gsl_eigen_symmv_workspace work = { .size = d, /* fail.h says why not GSL's */
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
        status = number_of_mode(ends, spring, damper, load);
    }
    free(V);
    return status;
}
//< modes

int fvi_stability_lobatto(size_t stages, const fvi_run *run, double *load)
{
    turn ends[2]; /* for z = -1 and for z = 1 */
    int status = check(stages, run, load);
    if (!status)
        status = make_turn(stages, -1, run, ends);
    if (!status)
        status = make_turn(stages, 1, run, ends + 1);
    if (status)
        return status;
    const fvi_system *system = run->system;
    const fvi_potential *u = &system->potential;
    const size_t d = system->d,
                 room = u->hessian ? fvi_potential_hessian_size(system) : 0;
    double *R = malloc((d + room) * sizeof *R), worst = 0;
    if (!R)
        FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
    double *W = R + d;
    for (size_t i = 0; i < d; i++) {
        R[i] = pow(run->h, run->law ? 2 : 2 - 2 * run->alpha)
               * system->damping[i] / system->mass[i];
        if (!status && !u->hessian)
            status = number_of_mode(ends, 0, R[i], &worst);
    }
    if (u->hessian)
        status = fvi_potential_hessian(system, run->x0, W);
    if (u->hessian && !status) {
        for (size_t i = 0; i < d * d; i++)
            W[i] *= gsl_pow_2(run->h)
                    / sqrt(system->mass[i / d] * system->mass[i % d]);
        const double share = stages == 2 ? ends->A[0][0] / ends->B[0][0] : 1;
        status = number_of_modes(ends, share, d, W, R, &worst);
    }
    free(R);
    if (!status)
        *load = worst;
    return status;
}
