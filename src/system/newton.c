/* src/system/newton.c -- The one equation that a step has to solve.     [Chapter 2] */
#include "newton.h"

#include "band.h"
#include "system/fail.h"

#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

enum { NEWTON_STEPS = 50, CAREFUL_STEPS = 1000 };

/* Stage l of coordinate j stands at [l * dim + j] in d, r and g, where the callbacks
 * want a stage in one piece; in what is eliminated, the rows of J, at [j * q + l],
 * so that the band is narrow. */
struct fvi_newton {
    const fvi_system *system;
    size_t q;     /* stages, 1 in (2.10) */
    size_t reach; /* d^2U / dx_j dx_c = 0 if |j - c| > reach */
    double theta;
    int implicit, linear;
    double *A;                  /* of each coordinate */
    double *s;                  /* of each q * q numbers; one in (2.10) */
    double *point, *H;          /* x + theta d of a stage, and Hess U there */
    double *e, *terms, *moves;  /* see residual and jacobian */
    double *step;               /* of Newton's method, */
    double *from, *before;      /* and d and e before it */
    double size, last, largest; /* of step_i, of the last, of d_i; absolute */
    fvi_band J;                 /* (2.11), or its LU factors */
};

/* ---- the equation ---- */

static void gradient(const fvi_newton *n, const double *x, double *g)
{
    const fvi_potential *u = &n->system->potential;
    if (u->gradient)
        u->gradient(n->system->d, x, u->params, g);
    else
        memset(g, 0, n->system->d * sizeof *g);
}

/* x + theta d of stage l */
static const double *point(fvi_newton *n, const double *x, const double *d,
                           size_t l)
{
    const size_t dim = n->system->d;
    for (size_t j = 0; j < dim; j++)
        n->point[j] = x[j] + n->theta * d[l * dim + j];
    return n->point;
}

static void gradients(fvi_newton *n, const double *x, const double *d,
                      double *g)
{
    for (size_t l = 0; l < n->q; l++)
        gradient(n, point(n, x, d, l), g + l * n->system->d);
}

//> residual
/* e = r - A d - s grad U(x + theta d), and the sum of the sizes of its terms. */
static void residual(fvi_newton *n, const double *r, const double *d,
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

/* d^2U / dx_j dx_c out of H */
static double curvature(const fvi_newton *n, size_t j, size_t c)
{
    const size_t m = n->system->potential.diagonals;
    if (m == 0)
        return n->H[j * n->system->d + c];
    return j <= c ? n->H[j * m + c - j] : n->H[c * m + j - c];
}

//> jacobian
/* J = (1 + mu) A + s theta Hess U(x + theta d), mu = 0 in (2.11). And how far s grad U
 * moves if each coordinate of x and d does by the whole of itself. */
static void jacobian(fvi_newton *n, const double *x, const double *d, double mu)
{
    const fvi_potential *u = &n->system->potential;
    const size_t dim = n->system->d, q = n->q;
    fvi_band_clear(&n->J);
    memset(n->moves, 0, q * dim * sizeof *n->moves);
    for (size_t i = 0; i < q; i++) {
        const double *z = point(n, x, d, i), *di = d + i * dim;
        u->hessian(dim, z, u->params, n->H);
        for (size_t j = 0; j < dim; j++) {
            const size_t left = j > n->reach ? j - n->reach : 0,
                         right = j + n->reach < dim ? j + n->reach : dim - 1;
            for (size_t c = left; c <= right; c++) {
                const double H = curvature(n, j, c),
                             moves = fabs(H) * (fabs(z[c]) + fabs(di[c]));
                for (size_t l = 0, row = j * q; l < q; l++, row++) {
                    const double s = n->s[row * q + i];
                    fvi_band_row(&n->J, row)[c * q + i] = s * n->theta * H;
                    n->moves[row] += fabs(s) * moves;
                }
            }
        }
    }
    for (size_t j = 0, row = 0; j < dim; j++)
        for (size_t l = 0; l < q; l++, row++)
            fvi_band_row(&n->J, row)[row] += (1 + mu) * n->A[j];
}
//< jacobian

/* ---- a solver ---- */

static int allocate(fvi_newton *n)
{
    const fvi_potential *u = &n->system->potential;
    const size_t dim = n->system->d, rows = n->q * dim, m = u->diagonals;
    n->reach = (m && m < dim ? m : dim) - 1;
    const size_t H = n->implicit ? dim * (m ? m : dim) : 0;
    n->A = calloc(2 * dim + (n->q + 6) * rows + H, sizeof *n->A);
    if (!n->A)
        return FVI_ENOMEM;
    n->point = n->A + dim;
    n->s = n->point + dim;
    n->e = n->s + n->q * rows;
    n->terms = n->e + rows;
    n->moves = n->terms + rows;
    n->step = n->moves + rows;
    n->from = n->step + rows;
    n->before = n->from + rows;
    n->H = n->before + rows;
    return n->implicit ? fvi_band_alloc(rows, n->q * (n->reach + 1) - 1, &n->J)
                       : FVI_SUCCESS;
}

/* Room for everything, A and s to be filled in. */
static int make(const fvi_system *system, size_t q, double theta, int implicit,
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
    n->linear = !n->implicit || (u->quadratic && u->quadratic(u->params));
    if (allocate(n)) {
        fvi_newton_free(n);
        FVI_FAIL("no memory for the solver", FVI_ENOMEM);
    }
    *newton = n;
    return FVI_SUCCESS;
}

/* The matrix of a quadratic U is factorised now, at d = 0 of x = 0. */
static int finish(fvi_newton *n, fvi_newton **newton)
{
    if (n->implicit && n->linear) {
        jacobian(n, n->e, n->e, 0);
        if (fvi_band_factorise(&n->J)) {
            fvi_newton_free(n);
            return FVI_ESING;
        }
    }
    *newton = n;
    return FVI_SUCCESS;
}

int fvi_newton_alloc(const fvi_system *system, const double *A, double s,
                     double theta, fvi_newton **newton)
{
    int status = fvi_system_check(system);
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
    status = make(system, 1, theta, s * theta != 0, &n);
    if (status)
        return status;
    for (size_t j = 0; j < system->d; j++) {
        n->A[j] = A[j];
        n->s[j] = s;
    }
    return finish(n, newton);
}

int fvi_newton_stages_alloc(const fvi_system *system, size_t q, const double *s,
                            fvi_newton **newton)
{
    int status = fvi_system_check(system);
    if (status)
        return status;
    if (!s || !newton)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (q == 0 || q > 8)
        FVI_FAIL("from 1 to 8 stages", FVI_EINVAL);
    if (!fvi_all_finite(system->d * q * q, s))
        FVI_FAIL("s must be finite", FVI_EDOM);
    fvi_newton *n;
    status = make(system, q, 1, 1, &n);
    if (status)
        return status;
    for (size_t j = 0; j < system->d; j++)
        n->A[j] = 1;
    memcpy(n->s, s, system->d * q * q * sizeof *s);
    return finish(n, newton);
}

void fvi_newton_free(fvi_newton *n)
{
    if (!n)
        return;
    fvi_band_free(&n->J);
    free(n->A);
    free(n);
}

/* ---- solutions ---- */

/* d becomes d + step. */
static void take(fvi_newton *n, double *d)
{
    const size_t dim = n->system->d;
    const double *step = n->step;
    n->last = n->size;
    n->size = n->largest = 0;
    for (size_t j = 0; j < dim; j++)
        for (double *at = d + j; at < d + n->q * dim; at += dim, step++) {
            *at += *step;
            if (!(fabs(*step) <= n->size)) /* NaN is large */
                n->size = fabs(*step);
            if (fabs(*at) > n->largest)
                n->largest = fabs(*at);
        }
}

/* s theta == 0, or U quadratic: grad U(x + theta d) = grad U(x) + theta Hess U d,
 * so that (A + s theta Hess U) d = r - s grad U(x) is exact, without iteration. */
static void solve_linear(fvi_newton *n, const double *x, const double *r,
                         double *d, double *g)
{
    const size_t rows = n->q * n->system->d;
    const int pulled = n->implicit || n->s[0] != 0;
    memset(d, 0, rows * sizeof *d);
    memset(g, 0, rows * sizeof *g);
    if (pulled)
        gradients(n, x, d, g);
    residual(n, r, d, g);
    memcpy(n->step, n->e, rows * sizeof *n->e);
    if (n->implicit)
        fvi_band_solve(&n->J, n->step);
    else
        for (size_t j = 0; j < rows; j++) /* one stage */
            n->step[j] /= n->A[j];
    take(n, d);
    if (!pulled || n->theta != 0)
        gradients(n, x, d, g);
}

//> stop
/* Is each e_i what rounding makes of the terms of its equation? Each of them, and
 * each coordinate of x + theta d, is off by some 2^-53 of itself, and two or three
 * roundings come together: d then solves an equation whose terms differ from the
 * given ones by no more, and no residual can tell that d is wrong. This knows no
 * unit and no scale, and each equation is judged by its own terms. */
static int is_noise(const fvi_newton *n)
{
    for (size_t i = 0; i < n->q * n->system->d; i++) {
        const double allowed =
            2 * GSL_DBL_EPSILON * (n->terms[i] + n->moves[i]) + GSL_DBL_MIN;
        if (!(fabs(n->e[i]) <= allowed && allowed < GSL_POSINF))
            return 0;
    }
    return 1;
}

/* Near a simple solution Newton's step is squared each time. One that is below half
 * of the digits of d and does not even halve tells of a gradient that is less exact
 * than is_noise takes it to be, or of a double root, which has half the digits. */
static int is_stuck(const fvi_newton *n)
{
    return n->size >= n->last / 2
           && n->size <= GSL_SQRT_DBL_EPSILON * n->largest;
}
//< stop

/* step = J^-1 e, and d + step; status of the factors. */
static int newton_step(fvi_newton *n, double *d)
{
    const size_t rows = n->q * n->system->d;
    if (fvi_band_factorise(&n->J))
        return FVI_ESING;
    memcpy(n->step, n->e, rows * sizeof *n->e);
    fvi_band_solve(&n->J, n->step);
    take(n, d);
    return FVI_SUCCESS;
}

//> newton
static int newton(fvi_newton *n, const double *x, const double *r, double *d,
                  double *g)
{
    n->size = GSL_POSINF;
    for (int i = 0; i < NEWTON_STEPS; i++) {
        gradients(n, x, d, g);
        residual(n, r, d, g);
        jacobian(n, x, d, 0);
        const int enough = is_noise(n);
        if (newton_step(n, d))
            return FVI_ESING;
        if (enough || is_stuck(n))
            return FVI_SUCCESS;
        if (!gsl_finite(n->size))
            break;
    }
    return FVI_EMAXITER;
}
//< newton

/* ---- where Newton's method loses its way ---- */

static void look(fvi_newton *n, const double *x, const double *r,
                 const double *d, double *g)
{
    gradients(n, x, d, g);
    residual(n, r, d, g);
}

/* Did the step go down, and not far up again behind the bottom? Along a step e is
 * the slope. Noise is forgiven. */
static int is_descent(const fvi_newton *n)
{
    double down = 0, after = 0, noise = 0;
    for (size_t i = 0; i < n->q * n->system->d; i++) {
        down += n->before[i] * n->step[i];
        after += n->e[i] * n->step[i];
        noise += (n->terms[i] + n->moves[i]) * fabs(n->step[i]);
    }
    noise *= 4 * GSL_DBL_EPSILON;
    return down >= -noise && after >= -down / 2 - noise;
}

/* Forces whose squares overflow: the motion has flown away. */
static int is_hopeless(const fvi_newton *n)
{
    double sum = 0;
    for (size_t i = 0; i < n->q * n->system->d; i++)
        sum += n->terms[i] * n->terms[i];
    return !gsl_finite(sum);
}

//> descend
/* Along A d' = e(d), from d = 0 on, by implicit Euler steps of length 1 / mu:
 * (J + mu A) step = e. They grow longer as long as they go down; mu = 0 is Newton's
 * method. */
static int descend(fvi_newton *n, const double *x, const double *r, double *d,
                   double *g)
{
    const size_t bytes = n->q * n->system->d * sizeof *d;
    double mu = 1;
    memset(d, 0, bytes);
    look(n, x, r, d, g);
    if (is_hopeless(n)) {
        d[0] = GSL_NAN;
        return FVI_SUCCESS;
    }
    for (int i = 0; i < CAREFUL_STEPS; i++) {
        jacobian(n, x, d, mu);
        if (is_noise(n))
            return FVI_SUCCESS;
        memcpy(n->from, d, bytes);
        memcpy(n->before, n->e, bytes);
        int good = !newton_step(n, d);
        if (good && mu == 0 && is_stuck(n))
            return FVI_SUCCESS;
        look(n, x, r, d, g);
        good = good && is_descent(n);
        mu = !good ? 4 * mu + 0x1p-10 : mu > 0x1p-10 ? mu / 4 : 0;
        if (!good) {
            memcpy(d, n->from, bytes);
            look(n, x, r, d, g);
        }
    }
    return FVI_EMAXITER;
}
//< descend

static int solve_nonlinear(fvi_newton *n, const double *x, const double *r,
                           double *d, double *g)
{
    const int status = newton(n, x, r, d, g);
    return status && descend(n, x, r, d, g) ? status : FVI_SUCCESS;
}

int fvi_newton_solve(fvi_newton *n, const double *x, const double *r, double *d,
                     double *g)
{
    if (!n || !x || !r || !d || !g)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!n->linear)
        return solve_nonlinear(n, x, r, d, g);
    solve_linear(n, x, r, d, g);
    return FVI_SUCCESS;
}
