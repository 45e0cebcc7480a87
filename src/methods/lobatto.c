/* src/methods/lobatto.c -- Take a step of form M of the variational integrators on Lobatto nodes.    [H 17]
 *
 * In form M the inertia is that of the discrete Lagrangian, (17.8). Form D stands in lobatto_damped.c. In this file i, l
 * and c count stages, and j counts coordinates. */
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

/* Compute grad U at X_i = x_k + dX_i. */
static int evaluate_gradient(fvi_stepper *s, fvi_lobatto_stages *o, size_t i)
{
    double *X = s->dx; /* serves as room, because the increment of a step stands in o->dX */
    fvi_linearised *linearised = fvi_linearised_of(s->run.system);
    for (size_t j = 0; j < o->d; j++)
        X[j] = s->x[j] + o->dX[i * o->d + j];
    if (linearised) /* each stage has its own Hessian */
        linearised->stage = i;
    return fvi_potential_gradient(s->run.system, X, o->grad + i * o->d);
}

/* Return X_i - x_k for coordinate j and a stage i > 0, which is row i of (17.8) times L^-1:
 *
 *     sum_{l < s - 1} M_il (S_l + h b_l share grad U(X_l) - [l = 0] p_k)
 *
 * The gradients in o->grad need not be final: solve_inner_stages sets some of them to zero. */
static double stage_displacement(const fvi_stepper *s, const fvi_lobatto_stages *o,
                                 size_t i, size_t j)
{
    const double *M = o->M + (j * o->unknowns + i - 1) * o->unknowns; /* its row of stage i; stage 0 has none */
    double sum = -M[0] * s->p[j];
    for (size_t l = 0; l < o->s - 1; l++) {
        const size_t at = l * o->d + j;
        sum += M[l] * (o->S[at] + force_weight(s, o, l, j) * o->grad[at]);
    }
    return sum;
}

//> inner
/* Solve for the inner stages 1, ..., s - 2: dX - M h b grad U(x + dX) = r. The right-hand side r has all terms of
 * (17.8) but those of the gradients at these stages. So it is stage_displacement with zeros in their place. The
 * gradient at stage 0 is known from the step before. */
static int solve_inner_stages(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t d = o->d, inner = o->s - 2;
    memset(o->grad + d, 0, inner * d * sizeof *o->grad);
    for (size_t i = 0; i < inner; i++)
        for (size_t j = 0; j < d; j++) {
            o->r[i * d + j] = stage_displacement(s, o, 1 + i, j);
            /* the initial guess: x moves with the velocity p/m */
            o->dX[(1 + i) * d + j] = o->rule->c[1 + i] * s->run.h * s->p[j] / s->run.system->mass[j];
        }
    return fvi_newton_solve(s->newton, s->x, o->r, o->dX + d, o->grad + d);
}

/* Allocate the solver of the inner stages. `coupling` has the factors of grad U in their equation, -M h b. */
static int prepare_inner_stages(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t d = o->d, inner = o->s - 2;
    double *coupling = malloc(d * inner * inner * sizeof *coupling);
    if (!coupling)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    double *next = coupling;
    for (size_t j = 0; j < d; j++)
        for (size_t i = 0; i < inner; i++) /* row i of M is that of stage i + 1, and column l that of stage l */
            for (size_t l = 1; l <= inner; l++)
                *next++ = -o->M[(j * o->unknowns + i) * o->unknowns + l] * force_weight(s, o, l, j);
    int status =
        fvi_newton_stages_alloc(s->run.system, inner, coupling, &s->newton);
    if (!status)
        s->newton->first = 1; /* its first unknown stage is stage 1 of the step */
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
    const double jump = o->from_zero && s->k == 0 ? s->run.x0[j]
                        : o->jump                 ? o->jump[j]
                                                  : 0;
    return jump != 0 ? jump / (s->run.h * o->rule->b[0]) : 0;
}

/* Push the velocities o->v of the step before into the history. Add to S the part of the damping in this step that is
 * known by now: h b rho (h^(-beta) H - W v0 + W e_1 jump). */
static int add_history_force(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t stages = o->s;
    if (o->memory && s->k > 0) {
        int status =
            fvi_lobatto_history_push(o->memory, o->v, o->Y, o->Ydot);
        if (status)
            return status;
    }
    for (size_t damped = 0; damped < o->damped; damped++)
        for (size_t i = 0, j = o->index[damped]; i < stages; i++) {
            double Y = o->memory && s->k > 0 ? o->scale * o->Y[damped * stages + i] : 0;
            for (size_t c = 0; c < stages; c++)
                Y -= o->W[i][c] * o->v0[damped];
            Y += o->W[i][0] * jump_of_velocity(s, o, j);
            o->S[i * o->d + j] += force_weight(s, o, i, j) * s->run.system->damping[j] * Y;
        }
    return FVI_SUCCESS;
}

/* Add the rest of the damping in this step, which depends on its velocities: S += h b rho W D X/h. Then write o->v, the
 * velocities that the next step pushes into the history. */
static void add_damping_of_step(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const size_t stages = o->s, d = o->d;
    for (size_t damped = 0; damped < o->damped; damped++) {
        const size_t j = o->index[damped];
        double *v = o->v + damped * stages;
        for (size_t i = 0; i < stages; i++) {
            v[i] = 0;
            for (size_t c = 1; c < stages; c++) /* dX is 0 at stage 0 */
                v[i] += o->rule->D[i][c] * o->dX[c * d + j];
            v[i] /= s->run.h;
        }
        for (size_t i = 0; i < stages; i++) {
            double Y = 0;
            for (size_t c = 0; c < stages; c++)
                Y += o->W[i][c] * v[c];
            o->S[i * d + j] += force_weight(s, o, i, j) * s->run.system->damping[j] * Y;
        }
        for (size_t i = 0; i < stages; i++)
            v[i] -= o->v0[damped];
        v[0] += jump_of_velocity(s, o, j);
    }
}

//> force
/* Set S = -h b F, and add the impulses by which the initial history acts in this step (19.5). At the ends of the step F
 * is the limit from within the step, because a jump of F at a node t_k belongs to neither side. */
static int set_known_forces(fvi_stepper *s, fvi_lobatto_stages *o)
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
    int status = set_known_forces(s, o);
    return status ? status : add_history_force(s, o);
}

//> step
int fvi_lobatto_step(fvi_stepper *s)
{
    fvi_lobatto_stages *o = s->method_state;
    const size_t d = o->d, last = o->s - 1; /* the last stage stands at x_{k+1} */
    int status = fvi_lobatto_assemble_known_rhs(s, o);
    if (!status && last > 1 && s->run.system->potential.gradient)
        status = solve_inner_stages(s, o);
    for (size_t i = 1; !status && i < last; i++)
        status = evaluate_gradient(s, o, i);
    if (status)
        return status;
    for (size_t i = 1; i <= last; i++)
        for (size_t j = 0; j < d; j++)
            o->dX[i * d + j] = stage_displacement(s, o, i, j);
    status = evaluate_gradient(s, o, last);
    if (status)
        return status;
    add_damping_of_step(s, o);
    for (size_t j = 0; j < d; j++) {
        for (size_t i = 0; i <= last; i++) /* (17.8) */
            s->p[j] -= o->S[i * d + j] + force_weight(s, o, i, j) * o->grad[i * d + j];
        s->x[j] += o->dX[last * d + j];
    }
    memcpy(o->grad, o->grad + last * d, d * sizeof *o->grad); /* stage 0 of the next step stands at x_{k+1}, too */
    return FVI_SUCCESS;
}
//< step

int fvi_lobatto_prepare(fvi_stepper *s, fvi_lobatto_stages *o)
{
    const int has_inner_stages = o->s > 2 && s->run.system->potential.gradient;
    const int status = evaluate_gradient(s, o, 0); /* at x_0, because dX is zero */
    return status || !has_inner_stages ? status : prepare_inner_stages(s, o);
}
