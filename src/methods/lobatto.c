/* src/methods/lobatto.c -- Take a step of form M of the variational integrators on Lobatto nodes.    [H 17] */
#include <fvi/lobatto.h>

#include "lobatto_stages.h"
#include "system/fail.h"
#include "newton/linearised.h"
#include "run/step_times.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the equation of a step ---- */

/* Return the weight of a force on coordinate j at stage i: h b_i times the share of the coordinate. */
static double force_weight(const fvi_stepper *s, const fvi_lobatto_stages *o,
                           size_t i, size_t j)
{
    return s->run.h * o->rule->b[i] * o->share[j];
}

/* Compute grad U at x_k + dX_i. */
static int gradient(fvi_stepper *s, fvi_lobatto_stages *o, size_t i)
{
    fvi_linearised *linearised = fvi_linearised_of(s->run.system);
    for (size_t j = 0; j < o->d; j++)
        s->dx[j] = s->x[j] + o->dX[i * o->d + j];
    if (linearised)
        linearised->stage = i;
    return fvi_potential_gradient(s->run.system, s->dx, o->grad + i * o->d);
}

/* Return X_i - x_k of (17.8) for coordinate j, from the forces in S and grad. */
static double stage_displacement(const fvi_stepper *s, const fvi_lobatto_stages *o,
                                 size_t i, size_t j)
{
    const double *M = o->M + (j * o->n + i - 1) * o->n;
    double sum = -M[0] * s->p[j];
    for (size_t l = 0; l < o->s - 1; l++)
        sum +=
            M[l]
            * (o->S[l * o->d + j] + force_weight(s, o, l, j) * o->grad[l * o->d + j]);
    return sum;
}

//> inner
/* Solve for the inner stages: dX - M h b grad U(x + dX) = M (S - p). The gradient at the first stage is known. */
static int solve_inner(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t d = o->d, inner = o->s - 2;
    memset(o->grad + d, 0, inner * d * sizeof *o->grad);
    for (size_t i = 0; i < inner; i++)
        for (size_t j = 0; j < d; j++) {
            o->r[i * d + j] = stage_displacement(s, o, 1 + i, j);
            o->dX[(1 + i) * d + j] = o->rule->c[1 + i] * s->run.h * s->p[j]
                                     / s->run.system->mass[j]; /* an initial guess */
        }
    return fvi_newton_solve(s->newton, s->x, o->r, o->dX + d, o->grad + d);
}

/* Allocate the solver of the inner stages, with the factors of grad U in their equation. */
static int prepare_inner(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t d = o->d, inner = o->s - 2;
    double *coupling = malloc(d * inner * inner * sizeof *coupling);
    if (!coupling)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    double *to = coupling;
    for (size_t j = 0; j < d; j++)
        for (size_t i = 0; i < inner; i++)
            for (size_t l = 1; l <= inner; l++)
                *to++ = -o->M[(j * o->n + i) * o->n + l] * force_weight(s, o, l, j);
    int status =
        fvi_newton_stages_alloc(s->run.system, inner, coupling, &s->newton);
    if (!status)
        s->newton->first = 1;
    free(coupling);
    return status;
}
//< inner

/* ---- a step ---- */

/* Return the velocity at the first stage that stands for a jump of x, jump/(h b_1) by (17.3). If the history begins at
 * 0, x jumps to x0 at the start of the first step. In other steps x may jump by o->jump. */
static double jump_of_velocity(const fvi_stepper *s, const fvi_lobatto_stages *o,
                               size_t j)
{
    const double jump = o->from_zero && s->k == 0 ? s->run.x0[j] : o->jump ? o->jump[j] : 0;
    return jump != 0 ? jump / (s->run.h * o->rule->b[0]) : 0;
}

/* Add the forces of the history to S for the damped coordinates: S += h b rho Y, where Y does not contain the velocity
 * v0. On entry o->v holds v of the step before. */
static int update_history(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t n = o->s;
    if (o->memory && s->k > 0) {
        int status =
            fvi_lobatto_history_push_by_order(o->memory, o->v, o->Y, o->Ydot);
        if (status)
            return status;
    }
    for (size_t l = 0; l < o->damped; l++)
        for (size_t i = 0, j = o->index[l]; i < n; i++) {
            double Y = o->memory && s->k > 0 ? o->scale * o->Y[l * n + i] : 0;
            for (size_t c = 0; c < n; c++)
                Y -= o->W[i][c] * o->v0[l];
            Y += o->W[i][0] * jump_of_velocity(s, o, j);
            o->S[i * o->d + j] +=
                force_weight(s, o, i, j) * s->run.system->damping[j] * Y;
        }
    return FVI_SUCCESS;
}

/* Compute v = D X / h - v0, and add the present part of the damping: S += h b rho W v. */
static void apply_damping(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t n = o->s, d = o->d;
    for (size_t l = 0; l < o->damped; l++) {
        const size_t j = o->index[l];
        double *v = o->v + l * n;
        for (size_t i = 0; i < n; i++) {
            v[i] = 0;
            for (size_t c = 1; c < n; c++)
                v[i] += o->rule->D[i][c] * o->dX[c * d + j];
            v[i] /= s->run.h;
        }
        for (size_t i = 0; i < n; i++) {
            double Y = 0;
            for (size_t c = 0; c < n; c++)
                Y += o->W[i][c] * v[c];
            o->S[i * d + j] +=
                force_weight(s, o, i, j) * s->run.system->damping[j] * Y;
        }
        for (size_t i = 0; i < n; i++)
            v[i] -= o->v0[l];
        v[0] += jump_of_velocity(s, o, j);
    }
}

//> force
/* Set S = -h b F and add the impulses of the past. At the ends of the step F is the limit from within the step, because
 * a jump of F at a node t_k belongs to neither side. */
static int apply_forces(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const double h = s->run.h, left = (double)s->k * h,
                 right = (double)(s->k + 1) * h;
    for (size_t i = 0; i < o->s; i++) {
        int status = fvi_force_value(
            s, fvi_inner_time(left, right, h, left + o->rule->c[i] * h, i, o->s));
        if (status)
            return status;
        for (size_t j = 0; j < o->d; j++)
            o->S[i * o->d + j] = -force_weight(s, o, i, j) * s->F[j];
    }
    if (!o->history_force.size)
        return FVI_SUCCESS;
    double impulse[FVI_STAGES];
    fvi_kernel_impulses(&o->history_force.initial_impulse, s->k, impulse);
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < o->d; j++)
            o->S[i * o->d + j] += o->share[j] * o->history_force.size[j] * impulse[i];
    return FVI_SUCCESS;
}
//< force

int fvi_lobatto_assemble_known_rhs(fvi_stepper *s, fvi_lobatto_stages *o)
{
    int status = apply_forces(s, o);
    return status ? status : update_history(s, o);
}

//> step
int fvi_lobatto_step(fvi_stepper *s)
{
    fvi_lobatto_stages *o = s->method_state;
    const size_t d = o->d, end = o->s - 1;
    int status = fvi_lobatto_assemble_known_rhs(s, o);
    if (!status && end > 1 && s->run.system->potential.gradient)
        status = solve_inner(s, o);
    for (size_t i = 1; !status && i < end; i++)
        status = gradient(s, o, i);
    if (status)
        return status;
    for (size_t i = 1; i <= end; i++)
        for (size_t j = 0; j < d; j++)
            o->dX[i * d + j] = stage_displacement(s, o, i, j);
    status = gradient(s, o, end);
    if (status)
        return status;
    apply_damping(s, o);
    for (size_t j = 0; j < d; j++) {
        for (size_t i = 0; i <= end; i++) /* (17.8) */
            s->p[j] -=
                o->S[i * d + j] + force_weight(s, o, i, j) * o->grad[i * d + j];
        s->x[j] += o->dX[end * d + j];
    }
    memcpy(o->grad, o->grad + end * d, d * sizeof *o->grad); /* the gradient at x_{k+1} serves the next step */
    return FVI_SUCCESS;
}
//< step

int fvi_lobatto_prepare(fvi_stepper *s, fvi_lobatto_stages *o)
{
    int status = gradient(s, o, 0); /* dX is zero here */
    return status || o->s == 2 || !s->run.system->potential.gradient
               ? status
               : prepare_inner(s, o);
}
