/* src/methods/lobatto_damped.c -- Take a step of form D, which treats the inertia as a damping of order 1.    [H 17] */

#include "lobatto_stages.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/lu.h"
#include "newton/linearised.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- matrices ---- */

//> inverse
/* Compute G = (m A^(-1) + rho h W)^(-1) = (m + rho h A W)^(-1) A; W contains h^(-beta). (17.25) */
static int make_G(const fvi_lobatto_stages *o, double m, double rho_h,
                  double *G)
{
    const size_t s = o->s;
    double N[FVI_STAGES * FVI_STAGES], A[FVI_STAGES * FVI_STAGES];
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++) {
            double AW = 0;
            for (size_t l = 0; l < s; l++)
                AW += o->A[i][l] * o->W[l][j];
            N[i * s + j] = (i == j ? m : 0) + rho_h * AW;
            A[j * s + i] = o->A[i][j]; /* column by column, for the solver */
        }
    size_t order[FVI_STAGES];
    gsl_permutation permutation = { s, order };
    gsl_matrix_view matrix = gsl_matrix_view_array(N, s, s);
    fvi_lu_factorise(&matrix.matrix, &permutation);
    for (size_t i = 0; i < s; i++)
        if (N[i * s + i] == 0)
            return FVI_ESING;
    for (size_t j = 0; j < s; j++) {
        gsl_vector_view column = gsl_vector_view_array(A + j * s, s);
        gsl_linalg_LU_svx(&matrix.matrix, &permutation, &column.vector);
        for (size_t i = 0; i < s; i++)
            G[i * s + j] = A[j * s + i];
    }
    return FVI_SUCCESS;
}
//< inverse

/* ---- a step ---- */

/* Write V_i - v_k of coordinate j to delta, from the forces in S and g = grad U; g = NULL: no potential. */
static void find_velocity_changes(const fvi_stepper *s, const fvi_lobatto_stages *o,
                                  size_t j, const double *g, double *delta)
{
    const size_t n = o->s, d = o->d;
    const double *G = o->M + j * n * n;
    double f[FVI_STAGES];
    for (size_t i = 0; i < n; i++) {
        f[i] = o->S[i * d + j] / o->rule->b[i];
        if (g)
            f[i] += s->run.h * o->share[j] * g[i * d + j];
    }
    for (size_t i = 0; i < n; i++) {
        delta[i] = 0;
        for (size_t l = 0; l < n; l++)
            delta[i] -= G[i * n + l] * f[l];
    }
}

/* Return X_i - x_k = h c_i v_k + h (A delta)_i. */
static double stage_displacement(const fvi_stepper *s, const fvi_lobatto_stages *o, size_t i,
                                 size_t j, const double *delta)
{
    return s->run.h * (o->rule->c[i] * (s->p[j] / s->run.system->mass[j]) + fvi_dot(o->s, o->A[i], delta));
}

/* Solve for all stages: dX + h^2 A G grad U(x + dX) = the value of dX without U. (17.24) */
static int solve(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t n = o->s, d = o->d;
    double delta[FVI_STAGES];
    memset(o->grad, 0, n * d * sizeof *o->grad);
    for (size_t j = 0; j < d; j++) {
        find_velocity_changes(s, o, j, NULL, delta);
        for (size_t i = 0; i < n; i++) {
            o->r[i * d + j] = stage_displacement(s, o, i, j, delta);
            o->dX[i * d + j] = o->rule->c[i] * s->run.h * s->p[j]
                               / s->run.system->mass[j]; /* an initial guess */
        }
    }
    return fvi_newton_solve(s->newton, s->x, o->r, o->dX, o->grad);
}

/* Add S += h b rho W v_k, the present part of the damping for the constant velocity v_k. */
static void apply_damping(const fvi_stepper *s, fvi_lobatto_stages *o)
{
    for (size_t l = 0; l < o->damped; l++) {
        const size_t j = o->index[l];
        const double push = s->run.h * s->run.system->damping[j]
                            * (s->p[j] / s->run.system->mass[j]);
        for (size_t i = 0; i < o->s; i++) {
            double W = 0;
            for (size_t c = 0; c < o->s; c++)
                W += o->W[i][c];
            o->S[i * o->d + j] += o->rule->b[i] * push * W;
        }
    }
}

/* Take the step in dual variables: v = p/m is the multiplier, and x is the force that drives it, summed from the end of
 * the run. U acts on V instead of X:
 *
 *     V + h^2 G A (Hess U o V) = the value of V without U,   x -= h sum_i b_i Hess U_i V_i
 *
 * G A = A G, because both are functions of A. So the solver is the same as for (17.24). (23.15) */
//> dual
static int step_dual(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t n = o->s, d = o->d;
    double *V = o->dX;
    for (size_t j = 0; j < d; j++) {
        double delta[FVI_STAGES];
        for (size_t i = 0; i < n; i++)
            o->S[i * d + j] -= s->run.h * o->rule->b[i] * s->x[j];
        find_velocity_changes(s, o, j, NULL, delta);
        for (size_t i = 0; i < n; i++)
            o->r[i * d + j] = s->p[j] / s->run.system->mass[j] + delta[i];
    }
    memset(s->dx, 0, d * sizeof *s->dx);
    const int status = fvi_newton_solve(s->newton, s->dx, o->r, V, o->grad);
    for (size_t j = 0; j < d; j++) {
        s->p[j] = s->run.system->mass[j] * V[(n - 1) * d + j];
        for (size_t i = 0; i < n; i++)
            s->x[j] -= s->run.h * o->rule->b[i] * o->grad[i * d + j];
    }
    for (size_t l = 0; l < o->damped; l++)
        for (size_t i = 0; i < n; i++)
            o->v[l * n + i] = V[i * d + o->index[l]];
    return status;
}
//< dual

//> step
int fvi_lobatto_damped_step(fvi_stepper *s)
{
    fvi_lobatto_stages *o = s->method_state;
    const fvi_linearised *linearised = fvi_linearised_of(s->run.system);
    const size_t n = o->s, d = o->d;
    const int is_free = !s->run.system->potential.gradient;
    int status = fvi_lobatto_assemble_known_rhs(s, o);
    if (status)
        return status;
    apply_damping(s, o);
    if (linearised && linearised->is_dual)
        return step_dual(s, o);
    if (!is_free)
        status = solve(s, o);
    if (status)
        return status;
    for (size_t j = 0, l = 0; j < d; j++) {
        const double m = s->run.system->mass[j], v = s->p[j] / m;
        double delta[FVI_STAGES];
        find_velocity_changes(s, o, j, is_free ? NULL : o->grad, delta);
        for (size_t i = 0; l < o->damped && o->index[l] == j && i < n; i++)
            o->v[l * n + i] = v + delta[i] - o->v0[l];
        l += l < o->damped && o->index[l] == j;
        for (size_t i = 0; is_free && i < n; i++)
            o->dX[i * d + j] = stage_displacement(s, o, i, j, delta);
        s->x[j] += stage_displacement(s, o, n - 1, j, delta);
        s->p[j] += m * delta[n - 1];
    }
    return FVI_SUCCESS;
}
//< step

/* ---- start ---- */

/* Allocate the solver, with h^2 A G share as the factor of grad U. */
static int make_solver(fvi_stepper *s, const fvi_lobatto_stages *o)
{
    const size_t n = o->s;
    double *coupling = calloc(o->d * n * n, sizeof *coupling), *to = coupling;
    if (!coupling)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    for (size_t j = 0; j < o->d; j++)
        for (size_t i = 0; i < n; i++)
            for (size_t l = 0; l < n; l++, to++)
                for (size_t c = 0; c < n; c++)
                    *to += s->run.h * s->run.h * o->share[j] * o->A[i][c]
                           * o->M[(j * n + c) * n + l];
    int status =
        fvi_newton_stages_alloc(s->run.system, n, coupling, &s->newton);
    free(coupling);
    return status;
}

int fvi_lobatto_damped_prepare(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const fvi_system *system = s->run.system;
    const size_t n = o->s;
    int status = FVI_SUCCESS;
    fvi_lobatto_table(o->rule, n, o->A);
    for (size_t j = 0; !status && j < o->d; j++)
        status = make_G(o, system->mass[j], s->run.h * system->damping[j],
                        o->M + j * n * n); /* for alpha = 1, W is 0 */
    return status || !system->potential.gradient ? status : make_solver(s, o);
}
