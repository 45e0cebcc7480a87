/* src/newton/newton_stages.c -- The equations of the stages, their Jacobian, and the memory of a solver.  [H 2] */
#include "linearised.h"

#include "system/fail.h"
#include "system/quadratic.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* ---- residual and Jacobian ---- */

/* Return x + theta d of stage l. */
static const double *stage_point(fvi_newton *n, const double *x, const double *d,
                                 size_t l)
{
    const size_t dim = n->system->d;
    if (n->theta == 0)
        return x;
    for (size_t j = 0; j < dim; j++)
        n->point[j] = x[j] + n->theta * d[l * dim + j];
    return n->point;
}

int fvi_newton_gradients(fvi_newton *n, const double *x, const double *d,
                         double *g)
{
    fvi_linearised *linearised = fvi_linearised_of(n->system);
    for (size_t l = 0; l < n->q && !n->callback_status; l++) {
        if (linearised)
            linearised->stage = n->first + l;
        n->callback_status =
            fvi_potential_gradient(n->system, stage_point(n, x, d, l), g + l * n->system->d);
    }
    return n->callback_status;
}

//> residual
void fvi_newton_residual(fvi_newton *n, const double *r, const double *d,
                         const double *g)
{
    const size_t dim = n->system->d, q = n->q;
    const double *s = n->s;
    double *e = n->e, *terms = n->terms;
    for (size_t j = 0; j < dim; j++)
        for (size_t l = 0; l < q; l++, e++, terms++) {
            const double rl = r[l * dim + j], Ad = n->A[j] * d[l * dim + j];
            *e = rl - Ad;
            *terms = fabs(rl) + fabs(Ad);
            for (size_t i = 0; i < q; i++) {
                const double sg = *s++ * g[i * dim + j];
                *e -= sg; /* (2.10) */
                *terms += fabs(sg);
            }
        }
}
//< residual

/* Return d^2U / dx_j dx_c from the stored Hessian H. */
static double curvature(const fvi_newton *n, size_t j, size_t c)
{
    const size_t m = n->system->potential.diagonals;
    if (m == 0)
        return n->H[j * n->system->d + c];
    return j <= c ? n->H[j * m + c - j] : n->H[c * m + j - c];
}

/* Fill the columns of stage i in J, without A, and add their part to moves. z is x + theta d of the stage. */
static void add_stage(fvi_newton *n, size_t i, const double *z, const double *d)
{
    const size_t dim = n->system->d, q = n->q;
    for (size_t j = 0; j < dim; j++) {
        const size_t left = j > n->half_bandwidth ? j - n->half_bandwidth : 0,
                     right = j + n->half_bandwidth < dim ? j + n->half_bandwidth : dim - 1;
        for (size_t c = left; c <= right; c++) {
            const double H = curvature(n, j, c),
                         moves = fabs(H) * (fabs(z[c]) + fabs(d[c]));
            for (size_t l = 0, row = j * q; l < q; l++, row++) {
                const double s = n->s[row * q + i];
                fvi_band_row(&n->J, row)[c * q + i] = s * n->theta * H;
                n->moves[row] += fabs(s) * moves;
            }
        }
    }
}

/* Fill J, with A, and moves for one stage if the Hessian is diagonal. This case has its own function, because a step of
 * one coordinate takes little more time than this. */
static void fill_diagonal(fvi_newton *n, const double *z, const double *d,
                          double mu)
{
    const size_t m = n->system->potential.diagonals;
    for (size_t j = 0; j < n->system->d; j++) {
        const double H = n->H[j * m], s = n->s[j];
        fvi_band_row(&n->J, j)[j] = s * n->theta * H + (1 + mu) * n->A[j];
        n->moves[j] = fabs(s) * (fabs(H) * (fabs(z[j]) + fabs(d[j])));
    }
}

int fvi_newton_jacobian(fvi_newton *n, const double *x, const double *d,
                        double mu)
{
    const fvi_potential *u = &n->system->potential;
    const size_t dim = n->system->d, q = n->q;
    if (q == 1 && n->half_bandwidth == 0 && !n->user_solve) {
        const double *z = stage_point(n, x, d, 0);
        n->callback_status = u->hessian(dim, z, u->params, n->H);
        if (!n->callback_status)
            fill_diagonal(n, z, d, mu);
        return n->callback_status;
    }
    memset(n->moves, 0, q * dim * sizeof *n->moves);
    if (n->user_solve) {
        stage_point(n, x, d, 0);
        for (size_t j = 0; j < dim; j++)
            n->H[j] = (1 + mu) * n->A[j];
        return FVI_SUCCESS;
    }
    fvi_band_clear(&n->J);
    for (size_t i = 0; i < q; i++) {
        const double *z = stage_point(n, x, d, i);
        n->callback_status = u->hessian(dim, z, u->params, n->H);
        if (n->callback_status)
            return n->callback_status;
        add_stage(n, i, z, d + i * dim);
    }
    for (size_t j = 0, row = 0; j < dim; j++)
        for (size_t l = 0; l < q; l++, row++)
            fvi_band_row(&n->J, row)[row] += (1 + mu) * n->A[j];
    return FVI_SUCCESS;
}

/* ---- allocation ---- */

/* Return the number of doubles in the block that begins with A. An explicit equation needs only A, point and one s. */
static size_t count_numbers(const fvi_newton *n)
{
    const size_t dim = n->system->d, m = n->system->potential.diagonals;
    return 2 * dim
           + (n->implicit ? dim
                                * ((n->q + 6) * n->q
                                   + (n->user_solve ? 1
                                      : m    ? m
                                             : dim))
                          : 1);
}

static int allocate(fvi_newton *n)
{
    const fvi_potential *u = &n->system->potential;
    const size_t dim = n->system->d, rows = n->q * dim, m = u->diagonals;
    n->half_bandwidth = (m && m < dim ? m : dim) - 1;
    n->A = calloc(count_numbers(n), sizeof *n->A);
    if (!n->A)
        return FVI_ENOMEM;
    n->point = n->A + dim;
    n->s = n->point + dim;
    if (!n->implicit)
        return FVI_SUCCESS;
    n->e = n->s + n->q * rows;
    n->terms = n->e + rows;
    n->moves = n->terms + rows;
    n->step = n->moves + rows;
    n->from = n->step + rows;
    n->before = n->from + rows;
    n->H = n->before + rows;
    return n->user_solve ? FVI_SUCCESS
                  : fvi_band_alloc(rows, n->q * (n->half_bandwidth + 1) - 1, &n->J);
}

/* Allocate a solver. The caller then fills in A and s. */
static int make_solver(const fvi_system *system, size_t q, double theta, int implicit,
                       fvi_newton **newton)
{
    fvi_newton *n = calloc(1, sizeof *n);
    if (!n)
        FVI_FAIL("no memory for the solver", FVI_ENOMEM);
    const fvi_potential *u = &system->potential;
    n->system = system;
    n->q = q;
    n->theta = theta;
    n->implicit = implicit && u->gradient;
    n->user_solve = n->implicit && q == 1 && u->solve;
    n->linear = !n->implicit || fvi_potential_is_quadratic(u);
    if (allocate(n)) {
        fvi_newton_free(n);
        FVI_FAIL("no memory for the solver", FVI_ENOMEM);
    }
    *newton = n;
    return FVI_SUCCESS;
}

/* Factorise the matrix of a quadratic U. Its Hessian is constant, so it is evaluated at d = 0 and x = 0. */
static int finish(fvi_newton *n, fvi_newton **newton)
{
    int status = FVI_SUCCESS;
    if (n->implicit && n->linear) {
        status = fvi_newton_jacobian(n, n->e, n->e, 0);
        if (!status && !n->user_solve)
            status = fvi_band_factorise(&n->J);
    }
    if (status)
        fvi_newton_free(n);
    else
        *newton = n;
    return status;
}

int fvi_newton_alloc(const fvi_system *system, const double *A, double s,
                     double theta, fvi_newton **newton)
{
    int status = fvi_system_require(system);
    if (status)
        return status;
    if (!A || !newton)
        FVI_FAIL("null pointer", FVI_EFAULT);
    for (size_t i = 0; i < system->d; i++)
        if (!(gsl_finite(A[i]) && A[i] > 0))
            FVI_FAIL("A must be finite and positive", FVI_EDOM);
    if (!gsl_finite(s) || !gsl_finite(theta))
        FVI_FAIL("s and theta must be finite", FVI_EDOM);
    fvi_newton *n;
    status = make_solver(system, 1, theta, s * theta != 0, &n);
    if (status)
        return status;
    memcpy(n->A, A, system->d * sizeof *A);
    for (size_t j = 0; j < (n->implicit ? system->d : 1); j++)
        n->s[j] = s;
    return finish(n, newton);
}

int fvi_newton_stages_alloc(const fvi_system *system, size_t q, const double *s,
                            fvi_newton **newton)
{
    int status = fvi_system_require(system);
    if (status)
        return status;
    if (!s || !newton)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (q == 0 || q > 8)
        FVI_FAIL("from 1 to 8 stages", FVI_EINVAL);
    if (!fvi_all_finite(system->d * q * q, s))
        FVI_FAIL("s must be finite", FVI_EDOM);
    fvi_newton *n;
    status = make_solver(system, q, 1, 1, &n);
    if (status)
        return status;
    for (size_t j = 0; j < system->d; j++)
        n->A[j] = 1;
    memcpy(n->s, s, (n->implicit ? system->d * q * q : 1) * sizeof *s);
    return finish(n, newton);
}

/* ---- systems with matrices ---- */

int fvi_newton_matrices_alloc(const fvi_system *system, double m, const double *c,
                              double s, double theta, fvi_newton **newton)
{
    const fvi_matrices *matrices = system->matrices;
    const size_t d = system->d, count = matrices->damper_count > 0 ? matrices->damper_count : 1;
    int in_range = m > 0 && gsl_finite(m) && gsl_finite(s * theta);
    for (size_t j = 0; j < count; j++)
        in_range = in_range && (!c || (c[j] >= 0 && gsl_finite(c[j])));
    if (!in_range)
        FVI_FAIL("m, c, s and theta must be finite", FVI_EDOM);
    fvi_newton *n = calloc(1, sizeof *n);
    double *block = calloc(1 + d + count, sizeof *block);
    if (!n || !block) {
        free(n);
        free(block);
        FVI_FAIL("no memory for the solver", FVI_ENOMEM);
    }
    *n = (fvi_newton){ .system = system,
                       .q = 1,
                       .theta = theta,
                       .m = m,
                       .c = block + 1 + d,
                       .A = block,
                       .s = block,
                       .point = block + 1 };
    *n->s = s;
    if (c)
        memcpy(n->c, c, count * sizeof *c);
    const int status = matrices->factorise(d, m, n->c, s * theta, matrices->params, &n->factors);
    if (status)
        fvi_newton_free(n);
    else
        *newton = n;
    return status;
}

//> matrices
/* Solve (27.3). The term s K x is known, so the step is one solution with the constant factors. */
int fvi_newton_by_matrices(fvi_newton *n, const double *x, const double *r,
                           double *d, double *g)
{
    const fvi_matrices *matrices = n->system->matrices;
    const size_t dim = n->system->d;
    const double s = *n->s;
    int status = s != 0 ? fvi_potential_gradient(n->system, x, g) : FVI_SUCCESS;
    if (status)
        return status;
#pragma omp simd
    for (size_t i = 0; i < dim; i++)
        d[i] = s != 0 ? r[i] - s * g[i] : r[i];
    status = matrices->solve(dim, n->factors, d); /* (27.3) */
    if (status || n->theta == 0)
        return status;
    for (size_t i = 0; i < dim; i++)
        n->point[i] = x[i] + n->theta * d[i];
    return fvi_potential_gradient(n->system, n->point, g);
}
//< matrices

int fvi_newton_copy(const fvi_newton *from, fvi_newton **to)
{
    if (from->system->matrices)
        return fvi_newton_matrices_alloc(from->system, from->m, from->c,
                                         *from->s, from->theta, to);
    fvi_newton *n = malloc(sizeof *n);
    if (!n)
        FVI_FAIL("no memory for the solver", FVI_ENOMEM);
    *n = *from;
    n->J = (fvi_band){ 0 };
    memset(n->lane, 0, sizeof n->lane);
    if (allocate(n)) {
        fvi_newton_free(n);
        FVI_FAIL("no memory for the solver", FVI_ENOMEM);
    }
    memcpy(n->A, from->A, count_numbers(n) * sizeof *n->A);
    if (n->implicit && !n->user_solve)
        fvi_band_copy(&from->J, &n->J);
    *to = n;
    return FVI_SUCCESS;
}

void fvi_newton_free(fvi_newton *n)
{
    if (!n)
        return;
    if (n->factors)
        n->system->matrices->free_factors(n->factors);
    for (size_t l = 0; l < FVI_MOST_LANES; l++)
        fvi_newton_free(n->lane[l]);
    fvi_band_free(&n->J);
    free(n->A);
    free(n);
}
