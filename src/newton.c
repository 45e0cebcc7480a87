/* src/newton.c -- The one equation that a step has to solve.     [Chapter 2] */
#include "newton.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ITERATIONS = 50 };

struct fvi_newton {
    const fvi_system *system;
    double s, theta;
    double *A, *point, *residual; /* d numbers each; J follows in the block */
    double *J;                    /* d * d numbers, or one if d == 1 */
    gsl_permutation *permutation; /* of the LU factors in J; NULL if d == 1 */
};

static int is_implicit(const fvi_system *system, double s, double theta)
{
    return s * theta != 0 && system->potential.gradient;
}

/* J = A + s theta Hess U(point), and its LU factors.                 (2.11) */
static int factorise(fvi_newton *n)
{
    const size_t d = n->system->d;
    n->system->potential.hessian(d, n->point, n->system->potential.params,
                                 n->J);
    for (size_t i = 0; i < d * d; i++)
        n->J[i] *= n->s * n->theta;
    for (size_t i = 0; i < d; i++)
        n->J[i * d + i] += n->A[i];
    if (d > 1) {
        int sign;
        gsl_matrix_view J = gsl_matrix_view_array(n->J, d, d);
        gsl_linalg_LU_decomp(&J.matrix, n->permutation, &sign);
    }
    for (size_t i = 0; i < d; i++)
        if (n->J[i * d + i] == 0)
            return GSL_ESING;
    return GSL_SUCCESS;
}

static void apply_inverse(fvi_newton *n, double *v)
{
    const size_t d = n->system->d;
    if (d == 1) {
        v[0] /= n->J[0];
        return;
    }
    gsl_matrix_view J = gsl_matrix_view_array(n->J, d, d);
    gsl_vector_view b = gsl_vector_view_array(v, d);
    gsl_linalg_LU_svx(&J.matrix, n->permutation, &b.vector);
}

static void gradient(const fvi_newton *n, const double *x, double *g)
{
    const fvi_potential *u = &n->system->potential;
    if (u->gradient)
        u->gradient(n->system->d, x, u->params, g);
    else
        memset(g, 0, n->system->d * sizeof *g);
}

static void gradient_at_midpoint(fvi_newton *n, const double *x,
                                 const double *d, double *g)
{
    for (size_t i = 0; i < n->system->d; i++)
        n->point[i] = x[i] + n->theta * d[i];
    gradient(n, n->point, g);
}

int fvi_newton_alloc(const fvi_system *system, const double *A, double s,
                     double theta, fvi_newton **newton)
{
    int status = fvi_system_check(system);
    if (status)
        return status;
    if (!A || !newton)
        GSL_ERROR("null pointer", GSL_EFAULT);
    const size_t d = system->d;
    for (size_t i = 0; i < d; i++)
        if (!(gsl_finite(A[i]) && A[i] > 0))
            GSL_ERROR("A must be finite and positive", GSL_EDOM);
    if (!gsl_finite(s) || !gsl_finite(theta))
        GSL_ERROR("s and theta must be finite", GSL_EDOM);

    const int implicit = is_implicit(system, s, theta);
    fvi_newton *n = calloc(1, sizeof *n);
    double *block = calloc(3 * d + (implicit ? d * d : 0), sizeof *block);
    gsl_permutation *permutation =
        implicit && d > 1 ? gsl_permutation_alloc(d) : NULL;
    if (!n || !block || (implicit && d > 1 && !permutation)) {
        free(n);
        free(block);
        gsl_permutation_free(permutation);
        GSL_ERROR("no memory for the solver", GSL_ENOMEM);
    }
    *n = (fvi_newton){ system,        s,          theta,
                       block,         block + d,  block + 2 * d,
                       block + 3 * d, permutation };
    memcpy(n->A, A, d * sizeof *A);
    if (implicit && system->potential.constant_hessian && factorise(n)) {
        fvi_newton_free(n);
        GSL_ERROR("A + s theta Hess U is singular", GSL_ESING);
    }
    *newton = n;
    return GSL_SUCCESS;
}

void fvi_newton_free(fvi_newton *n)
{
    if (!n)
        return;
    gsl_permutation_free(n->permutation);
    free(n->A);
    free(n);
}

/* s theta == 0, or U quadratic: grad U(x + theta d) = grad U(x) + theta Hess U d,
 * so that (A + s theta Hess U) d = r - s grad U(x) is exact, without iteration. */
static void solve_linear(fvi_newton *n, const double *x, const double *r,
                         double *d, double *g)
{
    const size_t dim = n->system->d;
    const int implicit = is_implicit(n->system, n->s, n->theta);
    if (n->s != 0)
        gradient(n, x, g);
    for (size_t i = 0; i < dim; i++)
        d[i] = n->s != 0 ? r[i] - n->s * g[i] : r[i];
    if (implicit)
        apply_inverse(n, d);
    else
        for (size_t i = 0; i < dim; i++)
            d[i] /= n->A[i];
    if (n->s == 0 || n->theta != 0)
        gradient_at_midpoint(n, x, d, g);
}

//> newton
static int solve_nonlinear(fvi_newton *n, const double *x, const double *r,
                           double *d, double *g)
{
    const size_t dim = n->system->d;
    double last = GSL_POSINF, place = 0;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        gradient_at_midpoint(n, x, d, g);
        if (factorise(n))
            GSL_ERROR("the Jacobian is singular", GSL_ESING);
        double rounding = 0, scale = 0, update = 0;
        for (size_t i = 0; i < dim; i++) {
            double Ad = n->A[i] * d[i], sg = n->s * g[i];
            n->residual[i] = r[i] - Ad - sg; /* (2.10) */
            rounding =
                fmax(rounding, (fabs(r[i]) + fabs(Ad) + fabs(sg)) / n->A[i]);
        }
        apply_inverse(n, n->residual);
        for (size_t i = 0; i < dim; i++) {
            d[i] += n->residual[i];
            update = fmax(update, fabs(n->residual[i]));
            scale = fmax(scale, fabs(d[i]));
            place = fmax(place, fabs(x[i]));
        }
        const int stuck = update >= last / 2;
        if (!gsl_finite(update) || update <= GSL_DBL_EPSILON * rounding
            || (stuck && update <= GSL_SQRT_DBL_EPSILON * scale)
            || (stuck && update <= 16 * GSL_DBL_EPSILON * place))
            return GSL_SUCCESS;
        last = update;
    }
    if (last <= 16 * GSL_DBL_EPSILON * place) /* creeping within an ulp of x */
        return GSL_SUCCESS;
    GSL_ERROR("Newton's method did not converge", GSL_EMAXITER);
}
//< newton

int fvi_newton_solve(fvi_newton *n, const double *x, const double *r, double *d,
                     double *g)
{
    if (!n || !x || !r || !d || !g)
        GSL_ERROR("null pointer", GSL_EFAULT);
    if (is_implicit(n->system, n->s, n->theta)
        && !n->system->potential.constant_hessian)
        return solve_nonlinear(n, x, r, d, g);
    solve_linear(n, x, r, d, g);
    return GSL_SUCCESS;
}
