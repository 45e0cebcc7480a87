/* src/variable_step/variable_step_solve.c -- Solve the equation of a step. [H 22]
 *
 *     L delta = R - h grad U(base + h to_x delta)                          (22.14)
 *
 * The solver depends on U:
 *
 *   linear    grad U is linear and the coordinates are not coupled. No iteration is needed (variable_step_linear.c)
 *   band      the Hessian has few diagonals, and all matrices of form D have common eigenvectors. Newton's method takes
 *             one Hessian for all stages (variable_step_band.h)
 *   diagonal  the coordinates are not coupled, but form M has other matrices, or few digits make the steps long.
 *             Newton's method takes the Jacobian L + h^2 diag(U'') to_x
 *   general   the iteration delta <- L^{-1} (R - h grad U) needs no matrix that couples the coordinates. If it does not
 *             contract, Newton's method for all stages and coordinates at once takes over */
#include "variable_step.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"
#include "system/larger.h"
#include "newton/newton.h"

#include <gsl/gsl_machine.h>
#include <stdlib.h>
#include <string.h>

/* Compute base + h to_x delta at all stages, to o->point. */
FVI_VECTORS static void find_stage_points(const fvi_variable_step_state *o)
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

/* Compute grad U at o->point, to o->gradient. */
static int evaluate_gradients(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const size_t d = o->d;
    int status = FVI_SUCCESS;
    find_stage_points(o);
    for (size_t i = 0; !status && i < o->rule->s; i++)
        status =
            u->gradient(d, o->point + i * d, u->params, o->gradient + i * d);
    return status;
}

/* Compute left = R - h grad U of coordinate j. The numbers behind the s-th have no meaning. */
static inline __attribute__((always_inline)) void
find_residual(const fvi_variable_step_state *o, size_t j, fvi_four *left)
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

/* Replace each number of most by the larger of it and |x|. */
typedef long long bits __attribute__((vector_size(32), aligned(8), may_alias));
static inline __attribute__((always_inline)) void update_largest(fvi_four *most,
                                                                 const fvi_four *x)
{
    const bits size = *(const bits *)x & 0x7fffffffffffffff,
               is = (fvi_four)size > *most;
    *most = (fvi_four)((size & is) | (*(bits *)most & ~is));
}

/* Return the largest of four numbers, or NaN if a term of the sum `all` was not finite. */
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

/* Decide whether the iteration goes on: return 1 to go on, 0 if x is accurate enough, -1 if the iteration does not
 * contract. The last change moved x by `moved` = h |change of delta|, the change before by moved_before. With
 * q = contraction, the changes still to come move x by moved q / (1 - q). Enough is 1e-5 of the error that the step may
 * have, or 1e-3 of it if the tolerance is loose; or a rounding error. */
//> enough
static int judge_iteration(fvi_variable_step_state *o, int iteration, double moved,
                           double moved_before, double worst)
{
    const double floor = 4 * GSL_DBL_EPSILON * o->scale;
    if (moved <= floor)
        return 0;
    if (iteration > 0) {
        o->contraction = moved / moved_before;
        if (o->contraction > worst)
            return moved <= 64 * floor ? 0
                                       : -1; /* rounding errors do not contract */
    }
    const double q = o->contraction, part = o->tolerance > FVI_TOLERANCE_LOOSE ? 1e-3 : 1e-5;
    const double enough = part * o->allowed;
    return moved * q / (1 - q) > (enough > floor ? enough : floor);
}
//< enough

/* How a nonlinear equation is solved: with one Jacobian for each stage and coordinate, with one Hessian for all stages,
 * or without derivatives. */
typedef enum { NEWTON, ONE_HESSIAN, FIXED_POINT } iteration_kind;

/* ---- coordinate by coordinate ---- */

/* Compute J = L + h^2 diag(H) to_x for coordinate j, with the Hessians H of all stages. */
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
    *J = o->group[o->group_of[j]].L;
    for (size_t l = 0; l < s; l++) {
        const fvi_four *column = (const fvi_four *)o->to_x->column[l];
        fvi_four *to = (fvi_four *)J->column[l];
        to[0] += H[0] * column[0];
        to[1] += H[1] * column[1];
    }
}

/* Compute the inverses of all Jacobians at o->point, to o->jacobian. */
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

/* Compute the factors of the band, with the Hessian of the middle stage. */
static int factorise_middle(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const size_t d = o->d, middle = o->rule->s / 2;
    int status = u->hessian(d, o->point + middle * d, u->params, o->hessian);
    if (!status)
        fvi_variable_step_factorise(o);
    return status;
}

/* Compute M in, for s numbers. */
static inline __attribute__((always_inline)) void
multiply_stages(size_t s, const fvi_square *M, const double *in, fvi_four *out)
{
    out[0] = out[1] = (fvi_four){ 0 };
    for (size_t l = 0; l < s; l++) {
        const fvi_four *column = (const fvi_four *)M->column[l];
        out[0] += column[0] * in[l];
        out[1] += column[1] * in[l];
    }
}

/* Correct delta of all coordinates: delta_j += M (left - L delta_j), or, for M = NULL, delta_j = L^{-1} left. Return
 * the largest change, or NaN if a change is not finite. */
FVI_VECTORS static double correct(fvi_variable_step_state *o, const fvi_square *M)
{
    const size_t s = o->rule->s;
    fvi_four most = { 0 }, all = { 0 };
    for (size_t j = 0; j < o->d; j++) {
        const fvi_coordinate_group *group = &o->group[o->group_of[j]];
        fvi_four left[2], by[2],
            *delta = (fvi_four *)(o->delta + j * FVI_LANES);
        find_residual(o, j, left);
        if (M) {
            multiply_stages(s, &group->L, (const double *)delta, by);
            left[0] -= by[0];
            left[1] -= by[1];
        }
        multiply_stages(s, M ? M + j : &group->inverse, (const double *)left, by);
        for (size_t i = 0; i < 2; i++) {
            if (!M)
                by[i] -= delta[i];
            delta[i] += by[i];
            update_largest(&most, &by[i]);
            all += by[i];
        }
    }
    return largest(&most, &all);
}

/* Compute the residuals eps = R - h grad U - L delta of all coordinates. */
FVI_VECTORS static void residuals(const fvi_variable_step_state *o, double *eps)
{
    for (size_t j = 0; j < o->d; j++) {
        const size_t at = j * FVI_LANES;
        const fvi_square *L = &o->group[o->group_of[j]].L;
        fvi_four *left = (fvi_four *)(eps + at), low, high;
        find_residual(o, j, left);
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

/* Add eps to delta of all coordinates. Return the largest |eps|, or NaN if a number is not finite. */
FVI_VECTORS static double apply_correction(fvi_variable_step_state *o, const double *eps)
{
    fvi_four most = { 0 }, all = { 0 };
    for (size_t i = 0; i < o->d * FVI_LANES; i += 4) {
        const fvi_four change = *(const fvi_four *)(eps + i);
        *(fvi_four *)(o->delta + i) += change;
        update_largest(&most, &change);
        all += change;
    }
    return largest(&most, &all);
}

/* Compute the next delta, and return the largest change. With a band, eps takes the room of accel_legendre, which is
 * computed later. */
static double correct_all(fvi_variable_step_state *o, iteration_kind by)
{
    if (by != ONE_HESSIAN)
        return correct(o, by == NEWTON ? o->jacobian : NULL);
    residuals(o, o->accel_legendre);
    fvi_variable_step_band_solve(o->band, o->accel_legendre);
    return apply_correction(o, o->accel_legendre);
}

//> newton
/* Iterate by Newton's method. Its Jacobian is computed again if the last iteration contracted badly. FIXED_POINT has L
 * in place of the Jacobian. */
static int iterate(fvi_stepper *s, fvi_variable_step_state *o, iteration_kind by, double worst,
                   int most)
{
    const double badly = by == NEWTON && o->tolerance <= FVI_TOLERANCE_VERY_LOOSE ? 0.05 : 0.3;
    double moved_before = 0;
    o->contraction = 0.5; /* until it is known */
    for (int i = 0; i < most; i++) {
        int status = evaluate_gradients(s, o);
        const int anew = i == 0 || (i > 1 && o->contraction > badly);
        if (!status && anew && by != FIXED_POINT)
            status = by == NEWTON ? jacobians(s, o) : factorise_middle(s, o);
        if (status)
            return status;
        const double moved = o->length.h * correct_all(o, by);
        if (!isfinite(moved))
            return FVI_EMAXITER;
        const int go_on = judge_iteration(o, i, moved, moved_before, worst);
        if (go_on <= 0)
            return go_on < 0 ? FVI_EMAXITER : FVI_SUCCESS;
        moved_before = moved;
    }
    return FVI_EMAXITER;
}
//< newton

/* ---- all stages and coordinates together ---- */

/* Prepare the solver for d = X - x_k in place of delta: d + h to_x L^{-1} h grad U(x_k + d) = r. */
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
                             o->group[o->group_of[j]].inverse.column[i], column);
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
    double *r = o->hessian, *X = o->point; /* ordered by stages */
    for (size_t j = 0; j < d; j++) {
        double by_R[FVI_LANES], move[FVI_LANES];
        fvi_square_apply(n, &o->group[o->group_of[j]].inverse,
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
        find_residual(o, j, left);
        fvi_square_apply(n, &o->group[o->group_of[j]].inverse,
                         (const double *)left, o->delta + j * FVI_LANES);
    }
    return status;
}

/* ---- the choice ---- */

/* Solve by Newton's method if there is a band or the coordinates are not coupled, else by the fixed-point iteration. */
static int solve_by_iterations(fvi_stepper *s, fvi_variable_step_state *o)
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
        status = solve_by_iterations(s, o);
    if (status) { /* or a callback failed at the guess */
        fvi_variable_step_extrapolate(o);
        status = solve_by_iterations(s, o);
    }
    if (!status && o->tolerance > FVI_TOLERANCE_VERY_LOOSE && fvi_variable_step_is_astray(o))
        return FVI_EMAXITER; /* a shorter step will not be astray */
    if (status != FVI_EMAXITER || o->solve != FVI_SOLVE_COUPLED || o->band)
        return status;
    if (++o->stalled_iterations == FVI_VARIABLE_STEP_STUCK) /* the iteration is not worth trying again */
        o->solve = FVI_SOLVE_TOGETHER;
    return solve_coupled(s, o);
}
