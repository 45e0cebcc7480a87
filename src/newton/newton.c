/* src/newton/newton.c -- Solve the equation of a time step.     [H 2] */
#include "linearised.h"
#include "newton_lanes.h"
#include "newton_move.h"

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <string.h>

enum { NEWTON_STEPS = 50, CAREFUL_STEPS = 1000 };

typedef int solver(fvi_newton *n, const double *x, const double *r, double *d,
                   double *g);

/* ---- explicit and linear equations ---- */

/* Add the Newton step to d. Store the largest |step_i| and the largest |d_i|. */
static void apply_update(fvi_newton *n, double *d)
{
    const size_t dim = n->system->d;
    const double *step = n->step;
    n->last = n->size;
    n->size = n->largest = 0;
    for (size_t j = 0; j < dim; j++)
        for (double *at = d + j; at < d + n->q * dim; at += dim, step++) {
            *at += *step;
            n->size = larger(n->size, fabs(*step));
            n->largest = larger(n->largest, fabs(*at));
        }
}

/* Compute the gradient g and the residual e at d. Return the code of the gradient. */
static int evaluate_residual(fvi_newton *n, const double *x, const double *r,
                const double *d, double *g)
{
    if (!fvi_newton_gradients(n, x, d, g))
        fvi_newton_residual(n, r, d, g);
    return n->callback_status;
}

/* Compute v = J^-1 v. Return 0, FVI_ESING if J is singular, or the code of the potential's own solver at `point`.
 * n->callback_status holds this code, too, unless it is FVI_ESING. */
static int eliminate(fvi_newton *n, int factorised, const double *point,
                     double *v)
{
    const fvi_potential *u = &n->system->potential;
    if (n->user_solve) {
        const int status = u->solve(n->system->d, point, n->H,
                                    n->s[0] * n->theta, u->params, v);
        if (status != FVI_ESING)
            n->callback_status = status;
        return status;
    }
    if (!factorised && fvi_band_factorise(&n->J))
        return FVI_ESING;
    fvi_band_solve(&n->J, v);
    return FVI_SUCCESS;
}

/* Solve the equation of one stage for a quadratic U. There grad U(x + theta d) = grad U(x) + theta Hess U d. So (A + s
 * theta Hess U) d = r - s grad U(x) is exact, and no iteration is needed. */
static int solve_linear(fvi_newton *n, const double *x, const double *r,
                        double *d, double *g)
{
    const fvi_potential *u = &n->system->potential;
    n->callback_status = u->gradient(n->system->d, x, u->params, g);
    if (n->callback_status)
        return n->callback_status;
    for (size_t j = 0; j < n->system->d; j++)
        d[j] = r[j] - n->s[j] * g[j];
    const int status = eliminate(n, 1, x, d);
    return status ? status : fvi_newton_gradients(n, x, d, g);
}

/* Solve the same equation if the Hessian is diagonal: divide once for each coordinate, and update the
 * gradient by the Hessian. */
static int solve_diagonal(fvi_newton *n, const double *x, const double *r,
                          double *d, double *g)
{
    const fvi_potential *u = &n->system->potential;
    n->callback_status = u->gradient(n->system->d, x, u->params, g);
    if (n->callback_status)
        return n->callback_status;
    for (size_t j = 0; j < n->system->d; j++) {
        d[j] = (r[j] - n->s[j] * g[j]) / fvi_band_row(&n->J, j)[j];
        g[j] += n->theta * n->H[j * u->diagonals] * d[j];
    }
    return FVI_SUCCESS;
}

/* Solve the equations of several stages for a quadratic U. Their rows are ordered by coordinate, d and r by stage. */
static int solve_linear_stages(fvi_newton *n, const double *x, const double *r,
                               double *d, double *g)
{
    const size_t rows = n->q * n->system->d;
    memset(d, 0, rows * sizeof *d);
    if (fvi_newton_gradients(n, x, d, g))
        return n->callback_status;
    fvi_newton_residual(n, r, d, g);
    memcpy(n->step, n->e, rows * sizeof *n->e);
    const int status = eliminate(n, 1, n->point, n->step);
    if (status)
        return status;
    apply_update(n, d);
    return fvi_newton_gradients(n, x, d, g);
}

/* Solve an explicit equation: s theta = 0, or there is no potential. Each d_j is found by itself. One gradient is
 * needed: at x if s != 0, else at x + theta d. The loop passes once over the arrays, because a step of a million
 * coordinates takes as long as its memory traffic. */
static int solve_explicit(fvi_newton *n, const double *restrict x,
                          const double *restrict r, double *restrict d,
                          double *restrict g)
{
    const size_t dim = n->system->d;
    const double s = *n->s;
    for (size_t l = 0; l < n->q && s != 0 && !n->callback_status; l++)
        n->callback_status = fvi_potential_gradient(n->system, x, g + l * dim);
    if (n->callback_status)
        return n->callback_status;
    for (size_t l = 0; l < n->q; l++, d += dim, r += dim) {
        const double *gradient = g + l * dim;
#pragma omp simd
        for (size_t j = 0; j < dim; j++)
            d[j] = (s != 0 ? r[j] - s * gradient[j] : r[j]) / n->A[j];
    }
    return s != 0 ? FVI_SUCCESS : fvi_newton_gradients(n, x, d - n->q * dim, g);
}

//> stop
/* Return 1 if each residual e_i is within the rounding errors of the terms of its equation. Each term, and each
 * coordinate of x + theta d, has a relative error of about 2^-53, and two or three such errors add up. If the test
 * holds, d solves exactly an equation whose terms differ from the given terms by rounding errors only. So no residual
 * can show that d is wrong. The test needs no unit and no scale, because it compares each equation with its own
 * terms. */
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

/* Return 1 if Newton's method no longer gains digits. Near a simple root each step is about the square of the
 * step before. So something is wrong with a step that is below half of the digits of d and is not even half of
 * the step before: the gradient is less exact than is_noise assumes, or the root is double. A double root has
 * only half of the digits. */
static int is_stuck(const fvi_newton *n)
{
    return n->size >= n->last / 2
           && n->size <= GSL_SQRT_DBL_EPSILON * n->largest;
}
//< stop

/* Compute step = J^-1 e and d += step. Return the code of the elimination. */
static int newton_step(fvi_newton *n, double *d)
{
    memcpy(n->step, n->e, n->q * n->system->d * sizeof *n->e);
    const int status = eliminate(n, 0, n->point, n->step);
    if (!status)
        apply_update(n, d);
    return status;
}

//> newton
static int newton(fvi_newton *n, const double *x, const double *r, double *d,
                  double *g)
{
    n->size = GSL_POSINF;
    for (int i = 0; i < NEWTON_STEPS; i++) {
        if (evaluate_residual(n, x, r, d, g) || fvi_newton_jacobian(n, x, d, 0))
            return n->callback_status;
        const int enough = is_noise(n), status = newton_step(n, d);
        if (status)
            return status;
        if (enough || is_stuck(n))
            return FVI_SUCCESS;
        if (!gsl_finite(n->size))
            break;
    }
    return FVI_EMAXITER;
}
//< newton

/* ---- Newton's method for one coordinate ---- */

/* Return 1 if there is one coordinate with one stage. */
static int is_single_equation(const fvi_newton *n)
{
    return n->q == 1 && n->system->d == 1 && !n->user_solve;
}

/* Write U'(z) to g and U''(z) to n->H. Return the code of the potential. */
static inline int evaluate_slopes(fvi_newton *n, double z, double *g)
{
    const fvi_potential *u = &n->system->potential;
    if (u->lanes && u->lanes->alone) {
        u->lanes->alone(u->params, z, g, n->H);
        return FVI_SUCCESS;
    }
    const int status = u->gradient(1, &z, u->params, g);
    return status ? status : u->hessian(1, &z, u->params, n->H);
}

/* Give the digits of newton() in half of its time, without the loops and calls that one coordinate does not need. */
static int newton_of_one_equation(fvi_newton *n, const double *x, const double *r,
                                  double *d, double *g)
{
    const double A = *n->A, s = *n->s, theta = n->theta;
    n->size = GSL_POSINF;
    for (int i = 0; i < NEWTON_STEPS; i++) {
        const double z = *x + theta * *d;
        n->callback_status = evaluate_slopes(n, z, g);
        if (n->callback_status)
            return n->callback_status;
        const fvi_newton_move to =
            fvi_newton_move_of(A, s, theta, *r, z, *g, *n->H, *d, n->size);
        if (to.J == 0)
            return FVI_ESING;
        *d = to.d;
        n->last = n->size;
        n->size = to.size;
        n->largest = fabs(to.d);
        if (to.is_enough)
            return FVI_SUCCESS;
        if (!isfinite(to.size))
            break;
    }
    return FVI_EMAXITER;
}

/* ---- when Newton's method fails ---- */

/* Return 1 if the step goes downhill and does not end far up the other side of the valley. The residual e points
 * downhill, so e . step must not be negative before the step. After the step it may be negative, but not below minus
 * half of its value before. Rounding errors are allowed for. */
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

/* Return 1 if the square of a force overflows, so the motion has diverged. */
static int is_hopeless(const fvi_newton *n)
{
    double sum = 0;
    for (size_t i = 0; i < n->q * n->system->d; i++)
        sum += n->terms[i] * n->terms[i];
    return !gsl_finite(sum);
}

//> descend
/* Solve A d' = e(d) from d = 0 by implicit Euler steps of length 1 / mu: (J + mu A) step = e. A step that goes downhill
 * is kept, and the next step is four times longer. Any other step is undone, and the next step is shorter. With mu = 0
 * the step is Newton's. */
static int descend(fvi_newton *n, const double *x, const double *r, double *d,
                   double *g)
{
    const size_t bytes = n->q * n->system->d * sizeof *d;
    double mu = 1;
    memset(d, 0, bytes);
    if (evaluate_residual(n, x, r, d, g))
        return n->callback_status;
    if (is_hopeless(n)) {
        d[0] = GSL_NAN;
        return FVI_SUCCESS;
    }
    for (int i = 0; i < CAREFUL_STEPS; i++) {
        if (fvi_newton_jacobian(n, x, d, mu))
            return n->callback_status;
        if (is_noise(n))
            return FVI_SUCCESS;
        memcpy(n->from, d, bytes);
        memcpy(n->before, n->e, bytes);
        int good = !newton_step(n, d);
        if (n->callback_status)
            return n->callback_status;
        if (good && mu == 0 && is_stuck(n))
            return FVI_SUCCESS;
        if (evaluate_residual(n, x, r, d, g))
            return n->callback_status;
        good = good && is_descent(n);
        mu = !good ? 4 * mu + 0x1p-10 : mu > 0x1p-10 ? mu / 4 : 0;
        if (!good) {
            memcpy(d, n->from, bytes);
            if (evaluate_residual(n, x, r, d, g))
                return n->callback_status;
        }
    }
    return FVI_EMAXITER;
}
//< descend

/* Return 1 if the coordinates are lanes and each lane has its own solution. */
static int is_of_lanes(const fvi_newton *n)
{
    return fvi_lanes_of(n->system) && (n->q > 1 || !n->linear);
}

static int solve_nonlinear(fvi_newton *n, const double *x, const double *r,
                           double *d, double *g)
{
    const int status = (is_single_equation(n) ? newton_of_one_equation : newton)(n, x, r, d, g);
    if (!status || !descend(n, x, r, d, g))
        return FVI_SUCCESS;
    return n->callback_status ? n->callback_status : status;
}

const double *fvi_newton_diagonal(const fvi_newton *n)
{
    return n->A;
}

int fvi_newton_solve(fvi_newton *n, const double *x, const double *r, double *d,
                     double *g)
{
    if (!n || !x || !r || !d || !g)
        FVI_FAIL("null pointer", FVI_EFAULT);
    n->callback_status = 0;
    solver *solve = n->system->matrices         ? fvi_newton_by_matrices
                    : !n->implicit              ? solve_explicit
                    : fvi_linearised_of(n->system) ? fvi_newton_by_linearised
                    : is_of_lanes(n)            ? fvi_newton_by_lanes
                    : !n->linear                ? solve_nonlinear
                    : n->q > 1                  ? solve_linear_stages
                    : fvi_newton_is_diagonal(n) ? solve_diagonal
                                                : solve_linear;
    return solve(n, x, r, d, g);
}
