/* src/variable_step/variable_step_linear.c -- Solve the equation of a step for a linear force. [H 22]
 *
 * Let grad U = g + c (x - x_k) for each coordinate, with g at the start of the step:
 *
 *     [L + c h^2 to_x] delta = R - h (g + c (base - x_k))                  (22.14)
 *
 * If many coordinates share this matrix, delta is a product with its inverse. Otherwise the solution goes by the
 * eigenvectors of the matrix. */
#include "variable_step.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include <fvi/error.h>

#include <string.h>

/* Compute the right sides, in place of R. */
FVI_VECTORS static void right_sides(fvi_variable_step_state *o, const double *g)
{
    const double h = o->length.h;
    for (size_t j = 0; j < o->d; j++) {
        const double c = o->group[o->group_of[j]].spring, x = o->y[j];
        const fvi_four *base = (const fvi_four *)(o->base + j * FVI_LANES);
        fvi_four *R = (fvi_four *)(o->R + j * FVI_LANES);
        R[0] -= h * (g[j] + c * (base[0] - x));
        R[1] -= h * (g[j] + c * (base[1] - x));
    }
}

/* Compute the residuals eps = R - [L + c h^2 to_x] delta. */
FVI_VECTORS static void find_linear_residual(const fvi_variable_step_state *o, double *eps)
{
    for (size_t j = 0; j < o->d; j++) {
        const size_t at = j * FVI_LANES;
        const fvi_square *L = &o->group[o->group_of[j]].L;
        fvi_four low = *(fvi_four *)(o->R + at),
                 high = *(fvi_four *)(o->R + at + 4);
        for (size_t l = 0; l < o->rule->s; l++) {
            const fvi_four *column = (const fvi_four *)L->column[l];
            low -= column[0] * o->delta[at + l];
            high -= column[1] * o->delta[at + l];
        }
        *(fvi_four *)(eps + at) = low;
        *(fvi_four *)(eps + at + 4) = high;
    }
}

void fvi_variable_step_factorise(fvi_variable_step_state *o)
{
    const double h = o->length.h;
    for (size_t n = 0; n < o->groups; n++)
        fvi_variable_step_band_group(o->band, n, o->group[n].mass,
                               o->group[n].damping_coeff);
    fvi_variable_step_band_factorise(o->band, o->group_of, h * h, o->hessian);
}

/* Solve by the eigenvectors. With eight stages the factors are accurate to 1e-12 of delta only, so the residual is
 * solved for once more. eps takes the room of accel_legendre, which is computed later. */
static void solve_by_pairs(fvi_variable_step_state *o)
{
    double *eps = o->accel_legendre;
    const size_t n = o->d * FVI_LANES;
    if (o->coupled != o->length.h) {
        for (size_t j = 0; j < o->d; j++)
            o->hessian[j] = o->group[o->group_of[j]].spring;
        fvi_variable_step_factorise(o);
        o->coupled = o->length.h;
    }
    memcpy(o->delta, o->R, n * sizeof *o->delta);
    fvi_variable_step_band_solve(o->band, o->delta);
    if (o->rule->s < 8)
        return;
    find_linear_residual(o, eps);
    fvi_variable_step_band_solve(o->band, eps);
    for (size_t i = 0; i < n; i++)
        o->delta[i] += eps[i];
}

//> linear
int fvi_variable_step_solve_linear(fvi_stepper *s, fvi_variable_step_state *o)
{
    int status = fvi_potential_gradient(s->run.system, o->y, s->g);
    if (status)
        return status;
    right_sides(o, s->g);
    if (o->band)
        solve_by_pairs(o);
    for (size_t j = 0; j < o->d && !o->band; j++)
        fvi_square_apply(o->rule->s, &o->group[o->group_of[j]].inverse,
                         o->R + j * FVI_LANES, o->delta + j * FVI_LANES);
    return FVI_SUCCESS;
}
//< linear
