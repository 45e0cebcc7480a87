/* src/variable_step/variable_step_solve.c -- Solve the equation of a step. [H 22]
 *
 *     L delta = R - h grad U(base + h to_x delta)                          (22.14)
 *
 * The unknowns delta are the changes of the velocity since the start of the step, at each stage. L and to_x act on the
 * stages of one coordinate, grad U acts on the coordinates of one stage. Stage i of coordinate j stands at [j *
 * FVI_LANES + i], but in point, gradient and hessian at [i * d + j]. A vector of stages is two fvi_four, for up to
 * eight stages; the numbers behind the last stage have no meaning.
 *
 * The solver depends on U:
 *
 *   linear    grad U is linear and the coordinates are not coupled. No iteration is needed (variable_step_linear.c)
 *   band      the Hessian has few diagonals, and all matrices of form D have common eigenvectors. Newton's method takes
 *             one Hessian for all stages (variable_step_band.h)
 *   diagonal  the coordinates are not coupled, but form M has other matrices, or few digits make the steps long.
 *             Newton's method takes the Jacobian L + h^2 diag(U'') to_x
 *   general   the iteration delta <- L^{-1} (R - h grad U) needs no matrix that couples the coordinates. If it does not
 *             contract, Newton's method for all stages and coordinates at once takes over
 *
 * o->solve is FVI_SOLVE_LINEAR, FVI_SOLVE_DIAGONAL, or for "general" FVI_SOLVE_COUPLED, and FVI_SOLVE_TOGETHER once
 * Newton's method has taken over for good. With a band it is FVI_SOLVE_DIAGONAL or FVI_SOLVE_COUPLED. */
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
    const size_t d = o->d, stages = o->rule->s;
    const double h = o->length.h;
    for (size_t j = 0; j < d; j++) {
        const double *delta = o->delta + j * FVI_LANES;
        fvi_four move[2] = { { 0 }, { 0 } };
        const fvi_four *base = (const fvi_four *)(o->base + j * FVI_LANES);
        for (size_t l = 0; l < stages; l++) {
            const fvi_four *column = (const fvi_four *)o->to_x->column[l];
            move[0] += column[0] * delta[l];
            move[1] += column[1] * delta[l];
        }
        move[0] = base[0] + h * move[0];
        move[1] = base[1] + h * move[1];
        for (size_t i = 0; i < stages; i++)
            o->point[i * d + j] = ((const double *)move)[i];
    }
}

/* Compute the positions of all stages, to o->point, and grad U there, to o->gradient. */
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

/* Compute the right-hand side R - h grad U of coordinate j. A rule has six or eight stages. */
static inline __attribute__((always_inline)) void
evaluate_right_side(const fvi_variable_step_state *o, size_t j, fvi_four *right)
{
    const size_t d = o->d;
    const int has_eight_stages = o->rule->s == 8;
    const double h = o->length.h;
    const double *g = o->gradient + j, *g4 = g + 4 * d; /* of coordinate j at the first and at the fifth stage */
    const fvi_four *R = (const fvi_four *)(o->R + j * FVI_LANES);
    right[0] = R[0] - h * (fvi_four){ g[0], g[d], g[2 * d], g[3 * d] };
    right[1] = R[1]
              - h
                    * (fvi_four){ g4[0], g4[d], has_eight_stages ? g4[2 * d] : 0,
                                  has_eight_stages ? g4[3 * d] : 0 };
}

/* Replace each number of *most by the larger of it and |x|. Without its sign bit, x is |x|. A comparison of vectors
 * gives a mask: all bits where it holds, else none. A NaN of x is not taken over. */
typedef long long bits __attribute__((vector_size(32), aligned(8), may_alias));
static inline __attribute__((always_inline)) void update_largest(fvi_four *most,
                                                                 const fvi_four *x)
{
    const bits size = *(const bits *)x & 0x7fffffffffffffff,
               is_larger = (fvi_four)size > *most;
    *most = (fvi_four)((size & is_larger) | (*(bits *)most & ~is_larger));
}

/* Return the largest of four numbers, or NaN if a term of the sums `all` was not finite. Then a sum is NaN or infinite,
 * and 0 times it is NaN. */
static inline __attribute__((always_inline)) double
largest_or_nan(const fvi_four *most, const fvi_four *all)
{
    const double *sum = (const double *)all, *size = (const double *)most;
    double x = 0 * ((sum[0] + sum[1]) + (sum[2] + sum[3]));
    for (size_t i = 0; i < 4; i++)
        x = larger(x, size[i]);
    return x;
}

/* ---- when to stop ---- */

typedef enum { DIVERGES, IS_ACCURATE, GOES_ON } verdict;

/* Decide whether the iteration goes on. The last change moved x by `moved` = h |change of delta|, the change before by
 * moved_before. Their ratio q is the contraction. The changes still to come move x by moved q / (1 - q). Enough is 1e-5
 * of the error that the step may have, or 1e-3 of it if the tolerance is loose; or a rounding error. The iteration
 * diverges if q > worst_contraction, unless `moved` is near the rounding errors, which do not contract. */
//> enough
static verdict judge_iteration(fvi_variable_step_state *o, int iteration, double moved,
                               double moved_before, double worst_contraction)
{
    const double floor = 4 * GSL_DBL_EPSILON * o->scale;
    if (moved <= floor)
        return IS_ACCURATE;
    if (iteration > 0) {
        o->contraction = moved / moved_before;
        if (o->contraction > worst_contraction)
            return moved <= 64 * floor ? IS_ACCURATE : DIVERGES;
    }
    const double q = o->contraction, part = o->tolerance > FVI_TOLERANCE_LOOSE ? 1e-3 : 1e-5;
    const double enough = part * o->allowed;
    return moved * q / (1 - q) > (enough > floor ? enough : floor) ? GOES_ON : IS_ACCURATE;
}
//< enough

/* How a nonlinear equation is solved. The comment at the top says when. */
typedef enum {
    NEWTON,      /* "diagonal": with the Hessian of every stage, and one Jacobian for each coordinate */
    ONE_HESSIAN, /* "band": with the Hessian of the middle stage for all stages */
    FIXED_POINT  /* "general": without derivatives */
} iteration_kind;

/* ---- coordinate by coordinate ---- */

/* Compute J = L + h^2 diag(H) to_x for coordinate j, with the Hessians H of all stages. */
FVI_VECTORS static void compute_jacobian(const fvi_variable_step_state *o, size_t j,
                                         fvi_square *J)
{
    const size_t d = o->d, stages = o->rule->s;
    const double hh = o->length.h * o->length.h;
    const double *H0 = o->hessian + j, *H4 = H0 + 4 * d; /* of coordinate j at the first and at the fifth stage */
    const fvi_four H[2] = {
        hh * (fvi_four){ H0[0], H0[d], H0[2 * d], H0[3 * d] },
        hh
            * (fvi_four){ H4[0], H4[d], stages == 8 ? H4[2 * d] : 0,
                          stages == 8 ? H4[3 * d] : 0 }
    };
    *J = o->group[o->group_of[j]].L;
    for (size_t l = 0; l < stages; l++) {
        const fvi_four *column = (const fvi_four *)o->to_x->column[l];
        fvi_four *to = (fvi_four *)J->column[l];
        to[0] += H[0] * column[0];
        to[1] += H[1] * column[1];
    }
}

/* Compute the inverses of all Jacobians at o->point, to o->jacobian. */
static int invert_jacobians(fvi_stepper *s, fvi_variable_step_state *o)
{
    const fvi_potential *u = &s->run.system->potential;
    const size_t d = o->d, stages = o->rule->s;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < stages; i++)
        status = u->hessian(d, o->point + i * d, u->params, o->hessian + i * d);
    for (size_t j = 0; !status && j < d; j++) {
        compute_jacobian(o, j, &o->jacobian[j]);
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

/* Compute out = M in for the stages of one coordinate. */
static inline __attribute__((always_inline)) void
multiply(size_t stages, const fvi_square *M, const double *in, fvi_four *out)
{
    out[0] = out[1] = (fvi_four){ 0 };
    for (size_t l = 0; l < stages; l++) {
        const fvi_four *column = (const fvi_four *)M->column[l];
        out[0] += column[0] * in[l];
        out[1] += column[1] * in[l];
    }
}

/* Correct delta of all coordinates, with the right-hand side `right` of each. If M is NULL, delta_j = L^{-1} right.
 * Else delta_j += M_j (right - L delta_j), where M_j is the inverse Jacobian of coordinate j. Return the largest
 * change, or NaN if a change is not finite. */
FVI_VECTORS static double correct_by_matrices(fvi_variable_step_state *o, const fvi_square *M)
{
    const size_t stages = o->rule->s;
    fvi_four most = { 0 }, all = { 0 };
    for (size_t j = 0; j < o->d; j++) {
        const fvi_coordinate_group *group = &o->group[o->group_of[j]];
        fvi_four right[2], by[2],
            *delta = (fvi_four *)(o->delta + j * FVI_LANES);
        evaluate_right_side(o, j, right);
        if (M) {
            multiply(stages, &group->L, (const double *)delta, by);
            right[0] -= by[0];
            right[1] -= by[1];
        }
        multiply(stages, M ? M + j : &group->inverse, (const double *)right, by);
        for (size_t i = 0; i < 2; i++) {
            if (!M)
                by[i] -= delta[i]; /* the change, from the new delta */
            delta[i] += by[i];
            update_largest(&most, &by[i]);
            all += by[i];
        }
    }
    return largest_or_nan(&most, &all);
}

/* Compute the residuals eps = R - h grad U - L delta of all coordinates. */
FVI_VECTORS static void compute_residuals(const fvi_variable_step_state *o, double *eps)
{
    for (size_t j = 0; j < o->d; j++) {
        const size_t at = j * FVI_LANES;
        const fvi_square *L = &o->group[o->group_of[j]].L;
        fvi_four *of_j = (fvi_four *)(eps + at), low, high;
        evaluate_right_side(o, j, of_j);
        low = of_j[0];
        high = of_j[1];
        for (size_t l = 0; l < o->rule->s; l++) {
            const fvi_four *column = (const fvi_four *)L->column[l];
            low -= column[0] * o->delta[at + l];
            high -= column[1] * o->delta[at + l];
        }
        of_j[0] = low;
        of_j[1] = high;
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
    return largest_or_nan(&most, &all);
}

/* Compute the next delta, and return the largest change, or NaN. With a band, the residuals stand in the room of
 * accel_legendre, which is computed later. */
static double correct_by(fvi_variable_step_state *o, iteration_kind by)
{
    if (by != ONE_HESSIAN)
        return correct_by_matrices(o, by == NEWTON ? o->jacobian : NULL);
    compute_residuals(o, o->accel_legendre);
    fvi_variable_step_band_solve(o->band, o->accel_legendre);
    return apply_correction(o, o->accel_legendre);
}

//> newton
/* Iterate by Newton's method. Its Jacobian is computed again if the last iteration contracted badly. FIXED_POINT has L
 * in place of the Jacobian. Return FVI_SUCCESS; FVI_EMAXITER if the iteration diverges or is not accurate after
 * most_iterations; FVI_ESING; or the code of a callback. */
static int iterate(fvi_stepper *s, fvi_variable_step_state *o, iteration_kind by, double worst_contraction,
                   int most_iterations)
{
    const double badly = by == NEWTON && o->tolerance <= FVI_TOLERANCE_VERY_LOOSE ? 0.05 : 0.3;
    double moved_before = 0;
    o->contraction = 0.5; /* until it is known */
    for (int i = 0; i < most_iterations; i++) {
        int status = evaluate_gradients(s, o);
        const int anew = i == 0 || (i > 1 && o->contraction > badly);
        if (!status && anew && by != FIXED_POINT)
            status = by == NEWTON ? invert_jacobians(s, o) : factorise_middle(s, o);
        if (status)
            return status;
        const double moved = o->length.h * correct_by(o, by);
        if (!isfinite(moved))
            return FVI_EMAXITER;
        const verdict next = judge_iteration(o, i, moved, moved_before, worst_contraction);
        if (next != GOES_ON)
            return next == DIVERGES ? FVI_EMAXITER : FVI_SUCCESS;
        moved_before = moved;
    }
    return FVI_EMAXITER;
}
//< newton

/* ---- all stages and coordinates together ---- */

/* Prepare s->newton for the unknowns X - x_k, the positions of all stages relative to the last node, in place of delta:
 *
 *     (X - x_k) + h to_x L^{-1} h grad U(X) = r,   r = base - x_k + h to_x L^{-1} R */
static int prepare_coupled(fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t n = o->rule->s, d = o->d; /* n stages */
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

/* Solve by Newton's method for all stages and coordinates at once. Then compute delta from grad U. */
static int solve_coupled(fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t n = o->rule->s, d = o->d; /* n stages */
    const double h = o->length.h;
    int status =
        o->coupled == h && s->newton ? FVI_SUCCESS : prepare_coupled(s, o);
    if (status)
        return status;
    double *r = o->hessian, *X = o->point; /* room for r; the unknowns X - x_k. Both are ordered by stages */
    for (size_t j = 0; j < d; j++) {
        double by_R[FVI_LANES], move[FVI_LANES];
        fvi_square_apply(n, &o->group[o->group_of[j]].inverse,
                         o->R + j * FVI_LANES, by_R);
        fvi_square_apply(n, o->to_x, by_R, move);
        for (size_t i = 0; i < n; i++) {
            const double base_move = o->base[j * FVI_LANES + i] - o->y[j];
            r[i * d + j] = base_move + h * move[i];
            X[i * d + j] = base_move;
        }
    }
    status = fvi_newton_solve(s->newton, o->y, r, X, o->gradient);
    for (size_t j = 0; !status && j < d; j++) {
        fvi_four right[2];
        evaluate_right_side(o, j, right);
        fvi_square_apply(n, &o->group[o->group_of[j]].inverse,
                         (const double *)right, o->delta + j * FVI_LANES);
    }
    return status;
}

/* ---- the choice ---- */

/* Solve by Newton's method if there is a band or the coordinates are not coupled, else by the fixed-point iteration.
 * The last two arguments are the worst contraction and the most iterations. */
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
    int status = FVI_EMAXITER; /* until an iteration has been tried */
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
