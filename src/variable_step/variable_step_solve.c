/* src/variable_step/variable_step_solve.c -- The equation of a step.             [H 22]
 *
 *     L delta = R - h grad U(base + h to_x delta)                          (22.14)
 *
 * At once where grad U is linear and coordinates do not know of each other
 * (variable_step_linear.c); by Newton's method with one Hessian for all stages (variable_step_band.h)
 * where it has few diagonals and form D's to_x has those eigenvectors; in form M, or where
 * few digits make the steps long, with the Jacobian L + h^2 diag(U'') to_x where coordinates
 * do not know of each other; else by delta <- L^{-1} (R - h grad U), which needs no matrix
 * that couples them, as long as it contracts, and by Newton's method for all stages and
 * coordinates where it does not. */
#include "variable_step.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"
#include "system/larger.h"
#include "newton/newton.h"

#include <gsl/gsl_machine.h>
#include <stdlib.h>
#include <string.h>

/* base + h to_x delta at all stages, to o->point. */
FVI_VECTORS static void points(const fvi_variable_step_state *o)
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
static int evaluate_gradients(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const size_t d = o->d;
    int status = FVI_SUCCESS;
    points(o);
    for (size_t i = 0; !status && i < o->rule->s; i++)
        status =
            u->gradient(d, o->point + i * d, u->params, o->gradient + i * d);
    return status;
}

/* left = R - h grad U of coordinate j; what is behind the s-th stage is of no use. */
static inline __attribute__((always_inline)) void
left_of(const fvi_variable_step_state *o, size_t j, fvi_four *left)
{
    const size_t d = o->d;
    const int eight = o->rule->s == 8;
    const double h = o->length.h, *g = o->gradient + j, *g4 = g + 4 * d;
    const fvi_four *R = (const fvi_four *)(o->R + j * FVI_LANES);
    left[0] = R[0] - h * (fvi_four){ g[0], g[d], g[2 * d], g[3 * d] };
    left[1] = R[1]
              - h
                    * (fvi_four){ g4[0], g4[d], eight ? g4[2 * d] : 0,
                                  eight ? g4[3 * d] : 0 };
}

/* most becomes the larger of it and |x|, one by one. */
typedef long long bits __attribute__((vector_size(32), aligned(8), may_alias));
static inline __attribute__((always_inline)) void grow(fvi_four *most,
                                                       const fvi_four *x)
{
    const bits size = *(const bits *)x & 0x7fffffffffffffff,
               is = (fvi_four)size > *most;
    *most = (fvi_four)((size & is) | (*(bits *)most & ~is));
}

/* The largest of four, and NaN if one of those is not finite that add up to `all`. */
static inline __attribute__((always_inline)) double
largest(const fvi_four *most, const fvi_four *all)
{
    const double *sum = (const double *)all, *size = (const double *)most;
    double x = 0 * ((sum[0] + sum[1]) + (sum[2] + sum[3]));
    for (size_t i = 0; i < 4; i++)
        x = larger(x, size[i]);
    return x;
}

/* ---- when to stop ---- */

/* How far x still moves, from how far it has, h |change of delta|, and how far before
 * that: contraction / (1 - contraction) of it. Enough is 1e-5 of what the step may err, or 1e-3
 * where that is much; or rounding. 1 go on, 0 enough, -1 it does not contract. */
//> enough
static int verdict(fvi_variable_step_state *o, int iteration, double moved,
                   double moved_before, double worst)
{
    const double floor = 4 * GSL_DBL_EPSILON * o->scale;
    if (moved <= floor)
        return 0;
    if (iteration > 0) {
        o->contraction = moved / moved_before;
        if (o->contraction > worst)
            return moved <= 64 * floor ? 0
                                       : -1; /* rounding contracts no more */
    }
    const double q = o->contraction, part = o->tolerance > FVI_TOLERANCE_LOOSE ? 1e-3 : 1e-5;
    const double enough = part * o->allowed;
    return moved * q / (1 - q) > (enough > floor ? enough : floor);
}
//< enough

/* Of the equations that are not linear: one Jacobian for each stage and coordinate, one
 * Hessian for all stages, none. */
typedef enum { NEWTON, ONE_HESSIAN, FIXED_POINT } way;

/* ---- coordinate by coordinate ---- */

/* L + h^2 to_x diag(H) for coordinate j, H of all stages. */
FVI_VECTORS static void jacobian(const fvi_variable_step_state *o, size_t j,
                                 fvi_square *J)
{
    const size_t d = o->d, s = o->rule->s;
    const double hh = o->length.h * o->length.h;
    const double *H0 = o->hessian + j, *H4 = H0 + 4 * d;
    const fvi_four H[2] = {
        hh * (fvi_four){ H0[0], H0[d], H0[2 * d], H0[3 * d] },
        hh
            * (fvi_four){ H4[0], H4[d], s == 8 ? H4[2 * d] : 0,
                          s == 8 ? H4[3 * d] : 0 }
    };
    *J = o->group[o->kind[j]].L;
    for (size_t l = 0; l < s; l++) {
        const fvi_four *column = (const fvi_four *)o->to_x->column[l];
        fvi_four *to = (fvi_four *)J->column[l];
        to[0] += H[0] * column[0];
        to[1] += H[1] * column[1];
    }
}

/* The inverses of all Jacobians at o->point, to o->jacobian. */
static int jacobians(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const size_t d = o->d, stages = o->rule->s;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < stages; i++)
        status = u->hessian(d, o->point + i * d, u->params, o->hessian + i * d);
    for (size_t j = 0; !status && j < d; j++) {
        jacobian(o, j, &o->jacobian[j]);
        status = fvi_square_invert(stages, &o->jacobian[j]);
    }
    return status;
}

/* The factors of what is to be solved with the Hessian of the middle stage. */
static int factors(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const size_t d = o->d, middle = o->rule->s / 2;
    int status = u->hessian(d, o->point + middle * d, u->params, o->hessian);
    if (!status)
        fvi_variable_step_factorise(o);
    return status;
}

/* M in, of s numbers. */
static inline __attribute__((always_inline)) void
apply(size_t s, const fvi_square *M, const double *in, fvi_four *out)
{
    out[0] = out[1] = (fvi_four){ 0 };
    for (size_t l = 0; l < s; l++) {
        const fvi_four *column = (const fvi_four *)M->column[l];
        out[0] += column[0] * in[l];
        out[1] += column[1] * in[l];
    }
}

/* delta_j += M (left - L delta_j), or L^{-1} left - delta_j without M, of all coordinates j;
 * returns the largest change, NaN if one is not finite. */
FVI_VECTORS static double correct(fvi_variable_step_state *o, const fvi_square *M)
{
    const size_t s = o->rule->s;
    fvi_four most = { 0 }, all = { 0 };
    for (size_t j = 0; j < o->d; j++) {
        const fvi_coordinate_group *kind = &o->group[o->kind[j]];
        fvi_four left[2], by[2],
            *delta = (fvi_four *)(o->delta + j * FVI_LANES);
        left_of(o, j, left);
        if (M) {
            apply(s, &kind->L, (const double *)delta, by);
            left[0] -= by[0];
            left[1] -= by[1];
        }
        apply(s, M ? M + j : &kind->inverse, (const double *)left, by);
        for (size_t i = 0; i < 2; i++) {
            if (!M)
                by[i] -= delta[i];
            delta[i] += by[i];
            grow(&most, &by[i]);
            all += by[i];
        }
    }
    return largest(&most, &all);
}

/* eps = R - h grad U - L delta of all coordinates. */
FVI_VECTORS static void residuals(const fvi_variable_step_state *o, double *eps)
{
    for (size_t j = 0; j < o->d; j++) {
        const size_t at = j * FVI_LANES;
        const fvi_square *L = &o->group[o->kind[j]].L;
        fvi_four *left = (fvi_four *)(eps + at), low, high;
        left_of(o, j, left);
        low = left[0];
        high = left[1];
        for (size_t l = 0; l < o->rule->s; l++) {
            const fvi_four *column = (const fvi_four *)L->column[l];
            low -= column[0] * o->delta[at + l];
            high -= column[1] * o->delta[at + l];
        }
        left[0] = low;
        left[1] = high;
    }
}

/* delta += eps, of all coordinates; returns the largest, NaN if one is not finite. */
FVI_VECTORS static double move(fvi_variable_step_state *o, const double *eps)
{
    fvi_four most = { 0 }, all = { 0 };
    for (size_t i = 0; i < o->d * FVI_LANES; i += 4) {
        const fvi_four change = *(const fvi_four *)(eps + i);
        *(fvi_four *)(o->delta + i) += change;
        grow(&most, &change);
        all += change;
    }
    return largest(&most, &all);
}

/* The next delta, and the largest change. With the factors eps stands where bend will, which
 * is not yet there. */
static double correct_all(fvi_variable_step_state *o, way by)
{
    if (by != ONE_HESSIAN)
        return correct(o, by == NEWTON ? o->jacobian : NULL);
    residuals(o, o->accel_legendre);
    fvi_variable_step_band_solve(o->band, o->accel_legendre);
    return move(o, o->accel_legendre);
}

//> newton
/* Newton's method with a Jacobian that is made anew while it contracts badly; or, with L
 * in its place, the fixed-point iteration. */
static int iterate(fvi_stepper *s, fvi_variable_step_state *o, way by, double worst,
                   int most)
{
    const double badly = by == NEWTON && o->tolerance <= FVI_TOLERANCE_VERY_LOOSE ? 0.05 : 0.3;
    double moved_before = 0;
    o->contraction = 0.5; /* until it is known */
    for (int i = 0; i < most; i++) {
        int status = evaluate_gradients(s, o);
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
static int prepare_coupled(fvi_stepper *s, fvi_variable_step_state *o)
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
                             o->group[o->kind[j]].inverse.column[i], column);
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

static int solve_coupled(fvi_stepper *s, fvi_variable_step_state *o)
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
        fvi_square_apply(n, &o->group[o->kind[j]].inverse,
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
        fvi_four left[2];
        left_of(o, j, left);
        fvi_square_apply(n, &o->group[o->kind[j]].inverse,
                         (const double *)left, o->delta + j * FVI_LANES);
    }
    return status;
}

/* ---- the ways ---- */

/* Newton's method where coordinates do not know of each other or with one Hessian, or else
 * the fixed-point iteration. */
static int by_iterations(fvi_stepper *s, fvi_variable_step_state *o)
{
    if (o->band)
        return iterate(s, o, ONE_HESSIAN, 0.8, 30);
    if (o->solve == FVI_SOLVE_DIAGONAL)
        return iterate(s, o, NEWTON, 0.9, 12);
    return iterate(s, o, FIXED_POINT, 0.8, 60);
}

int fvi_variable_step_solve(fvi_stepper *s, fvi_variable_step_state *o)
{
    int status = FVI_EMAXITER;
    if (o->solve == FVI_SOLVE_LINEAR)
        return fvi_variable_step_solve_linear(s, o);
    if (o->solve == FVI_SOLVE_TOGETHER) {
        fvi_variable_step_extrapolate(o);
        return solve_coupled(s, o);
    }
    if (o->tolerance > FVI_TOLERANCE_VERY_LOOSE && !fvi_variable_step_guess_by_leapfrog(s, o))
        status = by_iterations(s, o);
    if (status) { /* also if a callback would not go so far */
        fvi_variable_step_extrapolate(o);
        status = by_iterations(s, o);
    }
    if (!status && o->tolerance > FVI_TOLERANCE_VERY_LOOSE && fvi_variable_step_is_astray(o))
        return FVI_EMAXITER; /* a shorter step does not lose its way */
    if (status != FVI_EMAXITER || o->solve != FVI_SOLVE_COUPLED || o->band)
        return status;
    if (++o->stalled_iterations == FVI_VARIABLE_STEP_STUCK) /* it is not worth trying */
        o->solve = FVI_SOLVE_TOGETHER;
    return solve_coupled(s, o);
}
