/* src/newton/newton.c -- The one equation that a step has to solve.     [H 2] */
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

/* ---- solutions ---- */

/* d becomes d + step. */
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

/* g and e at d; status of the gradients. */
static int evaluate_residual(fvi_newton *n, const double *x, const double *r,
                const double *d, double *g)
{
    if (!fvi_newton_gradients(n, x, d, g))
        fvi_newton_residual(n, r, d, g);
    return n->callback_status;
}

/* v = J^-1 v; 0, or the status of the factors, or of the potential's own solution
 * at `point`, which is in n->theirs too unless it only says that J is singular. */
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

/* U quadratic, one stage: grad U(x + theta d) = grad U(x) + theta Hess U d, so that
 * (A + s theta Hess U) d = r - s grad U(x) is exact, without iteration. */
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

/* The same for coordinates that do not see each other: a division each, and the Hessian
 * says what the gradient becomes. */
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

/* The same for stages, whose rows stand otherwise than d and r. */
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

/* s theta == 0, or no potential: each d_j by itself, and one gradient; where U is pulled,
 * s != 0, that at x. One pass over the numbers, which is what a step of a million takes. */
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
        const double *pull = g + l * dim;
#pragma omp simd
        for (size_t j = 0; j < dim; j++)
            d[j] = (s != 0 ? r[j] - s * pull[j] : r[j]) / n->A[j];
    }
    return s != 0 ? FVI_SUCCESS : fvi_newton_gradients(n, x, d - n->q * dim, g);
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

/* step = J^-1 e, and d + step; status of the elimination. */
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

/* ---- the same for one coordinate ---- */

/* Is there one coordinate, and one stage of it? */
static int is_alone(const fvi_newton *n)
{
    return n->q == 1 && n->system->d == 1 && !n->user_solve;
}

/* U' and U'' at z, the latter into n->H. Returns what the potential returned. */
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

/* The digits of newton() in half its time: what one coordinate and its callbacks do not
 * need is left out. */
static int newton_alone(fvi_newton *n, const double *x, const double *r,
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

/* ---- where Newton's method loses its way ---- */

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

/* Oscillators that are lanes, each with its own solution. */
static int is_of_lanes(const fvi_newton *n)
{
    return fvi_lanes_of(n->system) && (n->q > 1 || !n->linear);
}

static int solve_nonlinear(fvi_newton *n, const double *x, const double *r,
                           double *d, double *g)
{
    const int status = (is_alone(n) ? newton_alone : newton)(n, x, r, d, g);
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
