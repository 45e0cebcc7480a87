/* src/methods/adaptive_solve.c -- The equation of a step.             [Chapter 22]
 *
 *     L delta = R - h grad U(base + h to_x delta)                          (22.14)
 *
 * At once where grad U is linear and coordinates do not know of each other
 * (adaptive_linear.c); by Newton's method with one Hessian for all stages (adaptive_band.h)
 * where it has few diagonals and form D's to_x has those eigenvectors; in form M, or where
 * few digits make the steps long, with the Jacobian L + h^2 diag(U'') to_x where coordinates
 * do not know of each other; else by delta <- L^{-1} (R - h grad U), which needs no matrix
 * that couples them, as long as it contracts, and by Newton's method for all stages and
 * coordinates where it does not. */
#include "adaptive.h"

#include "memory/memory_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"
#include "system/newton.h"

#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* base + h to_x delta at all stages, to o->point. */
FVI_VECTORS static void points(const fvi_adaptive_run *o)
{
    const size_t d = o->d, s = o->rule->s;
    const double h = o->length.h;
    for (size_t j = 0; j < d; j++) {
        const double *delta = o->delta + j * FVI_LANES;
        fvi_four move[2] = { { 0 }, { 0 } };
        const fvi_four *base = (const fvi_four *)(o->base + j * FVI_LANES);
        for (size_t l = 0; l < s; l++) {
            const fvi_four *column = (const fvi_four *)o->to_x->column[l];
            move[0] += column[0] * delta[l];
            move[1] += column[1] * delta[l];
        }
        move[0] = base[0] + h * move[0];
        move[1] = base[1] + h * move[1];
        for (size_t i = 0; i < s; i++)
            o->point[i * d + j] = ((const double *)move)[i];
    }
}

/* U' there, to o->gradient. */
static int look(fvi_stepper *s, fvi_adaptive_run *o)
{
    int status = FVI_SUCCESS;
    points(o);
    for (size_t i = 0; !status && i < o->rule->s; i++)
        status = fvi_gradient(s->run.system, o->point + i * o->d,
                              o->gradient + i * o->d);
    return status;
}

/* left = R - h grad U of coordinate j */
static void left_of(const fvi_adaptive_run *o, size_t j, double *left)
{
    memset(left, 0, FVI_LANES * sizeof *left);
    for (size_t i = 0; i < o->rule->s; i++)
        left[i] =
            o->R[j * FVI_LANES + i] - o->length.h * o->gradient[i * o->d + j];
}

/* ---- when to stop ---- */

/* How far x still moves, from how far it has, h |change of delta|, and how far before
 * that: contraction / (1 - contraction) of it. Enough is 1e-5 of what the step may err, or 1e-3
 * where that is much; or rounding. 1 go on, 0 enough, -1 it does not contract. */
//> enough
static int verdict(fvi_adaptive_run *o, int iteration, double moved,
                   double moved_before, double worst)
{
    const double floor = 4 * GSL_DBL_EPSILON * o->scale;
    if (!gsl_finite(moved))
        return -1;
    if (moved <= floor)
        return 0;
    if (iteration > 0) {
        o->contraction = moved / moved_before;
        if (o->contraction > worst)
            return moved <= 64 * floor ? 0
                                       : -1; /* rounding contracts no more */
    }
    const double q = o->contraction,
                 part = o->wish > FVI_COARSE ? 1e-3 : 1e-5;
    return moved * q / (1 - q) > fmax(floor, part * o->allowed);
}
//< enough

/* Of the equations that are not linear: one Jacobian for each stage and coordinate, one
 * Hessian for all stages, none. */
typedef enum { NEWTON, ONE_HESSIAN, FIXED_POINT } way;

/* ---- coordinate by coordinate ---- */

/* left -= L delta of coordinate j */
static void subtract(const fvi_adaptive_run *o, size_t j, double *left)
{
    double L[FVI_LANES];
    fvi_square_apply(o->rule->s, &o->of_kind[o->kind[j]].L,
                     o->delta + j * FVI_LANES, L);
    for (size_t i = 0; i < FVI_LANES; i++)
        left[i] -= L[i];
}

/* The inverses of all Jacobians at o->point, to o->jacobian. */
static int jacobians(fvi_stepper *s, fvi_adaptive_run *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const size_t d = o->d, stages = o->rule->s;
    const double hh = o->length.h * o->length.h;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < stages; i++)
        status = u->hessian(d, o->point + i * d, u->params, o->hessian + i * d);
    for (size_t j = 0; !status && j < d; j++) {
        o->jacobian[j] = o->of_kind[o->kind[j]].L;
        for (size_t l = 0; l < stages; l++)
            for (size_t i = 0; i < stages; i++)
                o->jacobian[j].column[l][i] +=
                    hh * o->hessian[i * d + j] * o->to_x->column[l][i];
        status = fvi_square_invert(stages, &o->jacobian[j]);
    }
    return status;
}

/* The factors of what is to be solved with the Hessian of the middle stage. */
static int factors(fvi_stepper *s, fvi_adaptive_run *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const size_t d = o->d, middle = o->rule->s / 2;
    int status = u->hessian(d, o->point + middle * d, u->params, o->hessian);
    if (!status)
        fvi_adaptive_factorise(o);
    return status;
}

/* The larger one, and NaN if one is. */
static double larger(double a, double b)
{
    return fabs(b) <= a ? a : fabs(b);
}

/* delta_j += M (left - L delta_j), M NULL for L^{-1}; returns the largest change. */
static double correct(fvi_adaptive_run *o, size_t j, const fvi_square *M)
{
    const size_t s = o->rule->s;
    const fvi_kind *kind = &o->of_kind[o->kind[j]];
    double left[FVI_LANES], change[FVI_LANES], most = 0;
    left_of(o, j, left);
    if (M)
        subtract(o, j, left);
    fvi_square_apply(s, M ? M : &kind->inverse, left, change);
    for (size_t i = 0; i < s; i++) {
        change[i] -= M ? 0 : o->delta[j * FVI_LANES + i];
        o->delta[j * FVI_LANES + i] += change[i];
        most = larger(most, change[i]);
    }
    return most;
}

/* eps = R - h grad U - L delta of all coordinates. */
FVI_VECTORS static void residuals(const fvi_adaptive_run *o, double *eps)
{
    const size_t d = o->d, s = o->rule->s;
    const double h = o->length.h;
    for (size_t j = 0; j < d; j++) {
        const size_t at = j * FVI_LANES;
        const fvi_square *L = &o->of_kind[o->kind[j]].L;
        const double *g = o->gradient + j, *g4 = g + 4 * d;
        const int eight = s == 8;
        fvi_four *left = (fvi_four *)(eps + at), *R = (fvi_four *)(o->R + at),
                 low = R[0] - h * (fvi_four){ g[0], g[d], g[2 * d], g[3 * d] },
                 high = R[1]
                        - h
                              * (fvi_four){ g4[0], g4[d],
                                            eight ? g4[2 * d] : 0,
                                            eight ? g4[3 * d] : 0 };
        for (size_t l = 0; l < s; l++) {
            const fvi_four *column = (const fvi_four *)L->column[l];
            low -= column[0] * o->delta[at + l];
            high -= column[1] * o->delta[at + l];
        }
        left[0] = low;
        left[1] = high;
    }
}

/* The same for all coordinates by the factors. eps stands where bend will, which is not
 * yet there. */
static double correct_band(fvi_adaptive_run *o)
{
    double *eps = o->bend, most = 0;
    residuals(o, eps);
    fvi_adaptive_band_solve(o->band, eps);
    for (size_t i = 0; i < o->d * FVI_LANES; i++) {
        o->delta[i] += eps[i];
        most = larger(most, eps[i]);
    }
    return most;
}

static double correct_all(fvi_adaptive_run *o, way by)
{
    double most = 0;
    if (by == ONE_HESSIAN)
        return correct_band(o);
    for (size_t j = 0; j < o->d; j++)
        most =
            larger(most, correct(o, j, by == NEWTON ? &o->jacobian[j] : NULL));
    return most;
}

//> newton
/* Newton's method with a Jacobian that is made anew while it contracts badly; or, with L
 * in its place, the fixed-point iteration. */
static int iterate(fvi_stepper *s, fvi_adaptive_run *o, way by, double worst,
                   int most)
{
    const double badly = by == NEWTON && o->wish <= FVI_FEW ? 0.05 : 0.3;
    double moved_before = 0;
    o->contraction = 0.5; /* until it is known */
    for (int i = 0; i < most; i++) {
        int status = look(s, o);
        const int anew = i == 0 || (i > 1 && o->contraction > badly);
        if (!status && anew && by != FIXED_POINT)
            status = by == NEWTON ? jacobians(s, o) : factors(s, o);
        if (status)
            return status;
        const double moved = o->length.h * correct_all(o, by);
        if (!isfinite(moved))
            return FVI_EMAXITER;
        const int go_on = verdict(o, i, moved, moved_before, worst);
        if (go_on <= 0)
            return go_on < 0 ? FVI_EMAXITER : FVI_SUCCESS;
        moved_before = moved;
    }
    return FVI_EMAXITER;
}
//< newton

/* ---- all together ---- */

/* X - x_k in place of delta: d + h to_x L^{-1} h grad U(x_k + d) = r. */
static int prepare_coupled(fvi_stepper *s, fvi_adaptive_run *o)
{
    const size_t n = o->rule->s, d = o->d;
    const double hh = o->length.h * o->length.h;
    double *coupling = malloc(d * n * n * sizeof *coupling);
    if (!coupling)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    for (size_t j = 0; j < d; j++)
        for (size_t i = 0; i < n; i++) {
            double column[FVI_LANES];
            fvi_square_apply(n, o->to_x,
                             o->of_kind[o->kind[j]].inverse.column[i], column);
            for (size_t l = 0; l < n; l++)
                coupling[(j * n + l) * n + i] = hh * column[l];
        }
    fvi_newton_free(s->newton);
    s->newton = NULL;
    int status =
        fvi_newton_stages_alloc(s->run.system, n, coupling, &s->newton);
    free(coupling);
    o->coupled = status ? 0 : o->length.h;
    return status;
}

static int solve_coupled(fvi_stepper *s, fvi_adaptive_run *o)
{
    const size_t n = o->rule->s, d = o->d;
    const double h = o->length.h;
    int status =
        o->coupled == h && s->newton ? FVI_SUCCESS : prepare_coupled(s, o);
    if (status)
        return status;
    double *r = o->hessian, *X = o->point; /* stage by stage */
    for (size_t j = 0; j < d; j++) {
        double by_R[FVI_LANES], move[FVI_LANES];
        fvi_square_apply(n, &o->of_kind[o->kind[j]].inverse,
                         o->R + j * FVI_LANES, by_R);
        fvi_square_apply(n, o->to_x, by_R, move);
        for (size_t i = 0; i < n; i++) {
            const double far = o->base[j * FVI_LANES + i] - o->y[j];
            r[i * d + j] = far + h * move[i];
            X[i * d + j] = far;
        }
    }
    status = fvi_newton_solve(s->newton, o->y, r, X, o->gradient);
    for (size_t j = 0; !status && j < d; j++) {
        double left[FVI_LANES];
        left_of(o, j, left);
        fvi_square_apply(n, &o->of_kind[o->kind[j]].inverse, left,
                         o->delta + j * FVI_LANES);
    }
    return status;
}

/* ---- the ways ---- */

/* Newton's method where coordinates do not know of each other or with one Hessian, or else
 * the fixed-point iteration. */
static int by_iterations(fvi_stepper *s, fvi_adaptive_run *o)
{
    if (o->band)
        return iterate(s, o, ONE_HESSIAN, 0.8, 30);
    if (o->solve == FVI_SOLVE_DIAGONAL)
        return iterate(s, o, NEWTON, 0.9, 12);
    return iterate(s, o, FIXED_POINT, 0.8, 60);
}

int fvi_adaptive_solve(fvi_stepper *s, fvi_adaptive_run *o)
{
    int status = FVI_EMAXITER;
    if (o->solve == FVI_SOLVE_LINEAR)
        return fvi_adaptive_solve_linear(s, o);
    if (o->solve == FVI_SOLVE_TOGETHER) {
        fvi_adaptive_extrapolate(o);
        return solve_coupled(s, o);
    }
    if (o->wish > FVI_FEW && !fvi_adaptive_leap(s, o))
        status = by_iterations(s, o);
    if (status) { /* also if a callback would not go so far */
        fvi_adaptive_extrapolate(o);
        status = by_iterations(s, o);
    }
    if (status != FVI_EMAXITER || o->solve != FVI_SOLVE_COUPLED || o->band)
        return status;
    if (++o->stuck == 20) /* it is not worth trying */
        o->solve = FVI_SOLVE_TOGETHER;
    return solve_coupled(s, o);
}
