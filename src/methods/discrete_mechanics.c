/* src/methods/discrete_mechanics.c -- Discrete Lagrangians, Algorithms 1 and 2, and Euler's methods.  [H 2] */
#include <fvi/discrete_mechanics.h>

#include "stability_number.h"
#include "stability/stability_share.h"
#include "system/fail.h"
#include "system/system_check.h"
#include "newton/newton.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

/* ---- L_d and its slopes ---- */

/* Check the arguments. Allocate the point S = kappa x + (1 - kappa) y with room for grad U behind it. */
static int prepare_equation(const fvi_system *system, double kappa, double h,
                            const double *x, const double *y, double **S)
{
    int status = fvi_system_require(system);
    if (status)
        return status;
    if (!x || !y)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(kappa >= 0 && kappa <= 1))
        FVI_FAIL("kappa must be in [0, 1]", FVI_EDOM);
    if (!(gsl_finite(h) && h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    *S = calloc(2 * system->d, sizeof **S);
    if (!*S)
        FVI_FAIL("no memory for the midpoint", FVI_ENOMEM);
    for (size_t i = 0; i < system->d; i++)
        (*S)[i] = kappa * x[i] + (1 - kappa) * y[i];
    return FVI_SUCCESS;
}

int fvi_discrete_lagrangian(const fvi_system *system, double kappa, double h,
                            const double *x, const double *y, double *L)
{
    if (!L)
        FVI_FAIL("null pointer", FVI_EFAULT);
    double *S;
    int status = prepare_equation(system, kappa, h, x, y, &S);
    if (status)
        return status;
    double kinetic = 0, potential;
    for (size_t i = 0; i < system->d; i++)
        kinetic += (y[i] - x[i]) * system->mass[i] * (y[i] - x[i]) / (2 * h);
    status = fvi_potential_value(system, S, &potential);
    if (!status)
        *L = kinetic - h * potential; /* (2.5) */
    free(S);
    return status;
}

int fvi_discrete_slopes(const fvi_system *system, double kappa, double h,
                        const double *x, const double *y, double *D1,
                        double *D2)
{
    double *S;
    int status = prepare_equation(system, kappa, h, x, y, &S);
    if (status)
        return status;
    const size_t d = system->d;
    double *g = S + d;
    status = fvi_potential_gradient(system, S, g);
    //> slopes
    for (size_t i = 0; !status && i < d; i++) {
        double momentum = system->mass[i] * (y[i] - x[i]) / h;
        if (D1)
            D1[i] = -momentum - kappa * h * g[i]; /* (2.6) */
        if (D2)
            D2[i] = momentum - (1 - kappa) * h * g[i];
    }
    //< slopes
    free(S);
    return status;
}

/* ---- the solver of the variational methods ---- */

int fvi_variational_solver(fvi_stepper *s)
{
    const fvi_run *run = &s->run;
    const size_t d = run->system->d;
    const double spring = run->kappa * run->h;
    if (run->system->matrices)
        return fvi_newton_matrices_alloc(run->system, 1 / run->h, NULL, spring,
                                         1 - run->kappa, &s->newton);
    double *A = malloc(d * sizeof *A);
    if (!A)
        FVI_FAIL("no memory for the solver", FVI_ENOMEM);
    for (size_t i = 0; i < d; i++)
        A[i] = run->system->mass[i] / run->h;
    int status =
        fvi_newton_alloc(run->system, A, spring, 1 - run->kappa, &s->newton);
    free(A);
    return status;
}

/* ---- Algorithms 1 and 2 ---- */

//> algorithm-1
/* Solve p_k = -D1 L_d(x_k, x_{k+1}) for x_{k+1}. Then set p_{k+1} = D2 L_d(x_k, x_{k+1}). */
static int step_variational(fvi_stepper *s)
{
    const fvi_system *system = s->run.system;
    const double h = s->run.h, kappa = s->run.kappa;
    int status = fvi_newton_solve(s->newton, s->x, s->p, s->dx, s->g);
    if (status)
        return status;
    for (size_t i = 0; i < system->d; i++) {
        s->x[i] += s->dx[i];
        s->p[i] = system->mass[i] * s->dx[i] / h - (1 - kappa) * h * s->g[i];
    }
    return FVI_SUCCESS;
}
//< algorithm-1

//> algorithm-2
/* Do the same with the discrete force f^+ = -rho (x_{k+1} - x_k) + h F(t_{k+1}). */
static int step_forced(fvi_stepper *s)
{
    const fvi_system *system = s->run.system;
    int status = step_variational(s);
    if (!status)
        status = fvi_force_value(s, (double)(s->k + 1) * s->run.h);
    if (status)
        return status;
    for (size_t i = 0; i < system->d; i++)
        s->p[i] += -system->damping[i] * s->dx[i] + s->run.h * s->F[i];
    return FVI_SUCCESS;
}
//< algorithm-2

static int start_variational(fvi_stepper *s)
{
    const fvi_system *system = s->run.system;
    for (size_t i = 0; i < system->d; i++)
        if (system->damping[i] != 0)
            FVI_FAIL("Algorithm 1 has no damping", FVI_EINVAL);
    if (system->force.value || system->force.impulse_count)
        FVI_FAIL("Algorithm 1 has no force", FVI_EINVAL);
    return fvi_variational_solver(s);
}

const fvi_method fvi_midpoint_variational = { .name = "variational",
                                     .order = "1 or 2",
                                     .lowest = 1,
                                     .highest = 2,
                                     .memory = "none",
                                     .alpha_most = 1,
                                     .takes_kappa = 1,
                                     .implicit = 1,
                                     .stability_number = fvi_stability_number_backward,
                                     .stability_number_grows = 1,
                                     .start = start_variational,
                                     .step = step_variational };

/* the members that the methods with a dashpot have in common */
#define WITH_A_DASHPOT                                                                                             \
    .order = "1", .lowest = 1, .highest = 1, .memory = "none", .alpha_least = 0.5, .alpha_most = 0.5,              \
    .stability_number_grows = 1

const fvi_method fvi_lagrange_dalembert = { .name = "lda",
                                            .takes_kappa = 1,
                                            .implicit = 1,
                                            .stability_number = fvi_stability_number_backward,
                                            .start = fvi_variational_solver,
                                            .step = step_forced,
                                            WITH_A_DASHPOT };

/* ---- Euler's methods ---- */

static int step_euler_explicit(fvi_stepper *s)
{
    const fvi_system *system = s->run.system;
    const double h = s->run.h;
    int status = fvi_potential_gradient(system, s->x, s->g);
    if (!status)
        status = fvi_force_value(s, s->t);
    if (status)
        return status;
    for (size_t i = 0; i < system->d; i++) {
        double v = s->p[i] / system->mass[i];
        s->x[i] += h * v;
        s->p[i] += h * (-s->g[i] - system->damping[i] * v + s->F[i]);
    }
    return FVI_SUCCESS;
}

/* Insert x_{k+1} - x_k = dx = h p_{k+1} / m into the equation for p_{k+1}: (m / h + rho) dx + h grad
 * U(x_k + dx) = p_k + h F(t_{k+1}). (2.10) */
static int start_euler_implicit(fvi_stepper *s)
{
    const fvi_system *system = s->run.system;
    double *A = malloc(system->d * sizeof *A);
    if (!A)
        FVI_FAIL("no memory for the solver", FVI_ENOMEM);
    for (size_t i = 0; i < system->d; i++)
        A[i] = system->mass[i] / s->run.h + system->damping[i];
    int status = fvi_newton_alloc(system, A, s->run.h, 1, &s->newton);
    free(A);
    return status;
}

static int step_euler_implicit(fvi_stepper *s)
{
    const fvi_system *system = s->run.system;
    const double h = s->run.h;
    int status = fvi_force_value(s, (double)(s->k + 1) * h);
    if (status)
        return status;
    for (size_t i = 0; i < system->d; i++)
        s->p[i] += h * s->F[i];
    status = fvi_newton_solve(s->newton, s->x, s->p, s->dx, s->g);
    if (status)
        return status;
    for (size_t i = 0; i < system->d; i++) {
        s->x[i] += s->dx[i];
        s->p[i] = system->mass[i] * s->dx[i] / h;
    }
    return FVI_SUCCESS;
}

const fvi_method fvi_euler_explicit = { .name = "euler-explicit",
                                        .stability_number = fvi_stability_explicit,
                                        .step = step_euler_explicit,
                                        WITH_A_DASHPOT };
const fvi_method fvi_euler_implicit = { .name = "euler-implicit",
                                        .implicit = 1,
                                        .stability_number = fvi_stability_number_none,
                                        .start = start_euler_implicit,
                                        .step = step_euler_implicit,
                                        WITH_A_DASHPOT };
