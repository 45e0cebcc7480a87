/* src/methods/fvi.c -- The fractional variational integrator, Algorithm 3.               [H 9] */
#include <fvi/fvi.h>

#include "damping.h"
#include "mechanism/mechanism.h"
#include "stability_number.h"
#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "memory/history_parts.h"
#include "system/fail.h"
#include "newton/newton_stages.h"

enum { PART = 2048 }; /* coordinates in a part; their numbers fit into the cache */

static int start_fractional(fvi_stepper *s)
{
    fvi_damping *d;
    if (fvi_has_mechanism_steps(s->run.system))
        return fvi_mechanism_start(s, FVI_MECHANISM_FIRST_ORDER, 0);
    int status = fvi_variational_solver(s);
    if (status)
        return status;
    status = fvi_damping_start(s, 0, &d);
    s->method_state = d;
    return status;
}

static void stop_fractional(fvi_stepper *s)
{
    fvi_damping_free(s->method_state);
}

static int copy_fractional(const fvi_stepper *from, fvi_stepper *to)
{
    fvi_damping *d;
    int status = fvi_damping_copy(from->method_state, &d);
    to->method_state = d;
    return status;
}

static int serialize_fractional(fvi_stepper *s, fvi_archive *v)
{
    return fvi_damping_archive(s->method_state, s->k, v);
}

//> apply-damping
/* p_{k+1} -= h rho Delta_-^alpha Delta_-^alpha x_{k+1} for every damper */
static int apply_damping(fvi_stepper *s, fvi_damping *d)
{
    int status = FVI_SUCCESS;
    for (; d && !status; d = d->next) {
        status = fvi_damping_terms(d, s);
        if (!status)
            status = fvi_damping_update_history(d, d->z);
        fvi_damping_before(d, s->p);
        if (!status)
            status = fvi_damping_apply_force(d, 1, d->z, s->p);
        fvi_damping_after(d, s->p);
        fvi_damping_end_step(d, s->run.h, s->dx);
    }
    return status;
}
//< apply-damping

//> step
static int step_fractional(fvi_stepper *s)
{
    const double h = s->run.h;
    int status = fvi_newton_solve(s->newton, s->x, s->p, s->dx, s->g);
    if (!status)
        status = fvi_force_value(s, (double)(s->k + 1) * h);
    if (status)
        return status;
#pragma omp simd
    for (size_t i = 0; i < s->run.system->d; i++) {
        s->x[i] += s->dx[i];
        s->p[i] += h * (s->F[i] - s->g[i]);
    }
    return apply_damping(s, s->method_state); /* (9.4) */
}
//< step

static int keep_dampers(fvi_stepper *s)
{
    return fvi_damping_keep(s->method_state);
}

/* ---- a step of one coordinate ---- */

/* Return 1 if there is one coordinate, which is damped, and its equation is a division. */
static int is_single_equation(const fvi_stepper *s)
{
    const fvi_damping *d = s->method_state;
    return d && d->all && d->count == 1 && fvi_newton_is_diagonal(s->newton);
}

/* Give the digits of step_fractional with about half of its instructions. A run of one coordinate spends its time on
 * instructions, so this function has no loops. */
static int step_one_coordinate(fvi_stepper *s)
{
    const fvi_damping *d = s->method_state;
    const fvi_newton *n = s->newton;
    const fvi_potential *u = &s->run.system->potential;
    const double h = s->run.h, t = (double)(s->k + 1) * h;
    double g, H;
    int status = u->gradient(1, s->x, u->params, &g);
    if (!status)
        status = fvi_force_value(s, t);
    if (status)
        return status;
    const double dx = (*s->p - *n->s * g) / *fvi_band_row(&n->J, 0);
    g += n->theta * *n->H * dx;
    const double x = *s->x + dx, z = x - *d->origin, dz = dx - *d->drift;
    status = fvi_history_push(d->memory, &z, &dz, &H);
    *s->x = x;
    *s->dx = dx;
    *s->g = g;
    *s->p = *s->p + h * (*s->F - g) - *d->factor * H;
    return status;
}

/* ---- a step of many coordinates ---- */

/* Return 1 if the next position is explicit (kappa = 1), every coordinate is damped, and the history takes parts. */
static int can_step_by_parts(const fvi_stepper *s)
{
    const fvi_damping *d = s->method_state;
    return d && s->run.kappa == 1 && d->all && !d->H
           && fvi_history_takes_parts(d->memory);
}

//> drift
/* Compute x_{k+1}, the new p, and the terms of the history for some coordinates. A is m / h. */
FVI_VECTORS static void drift_part(double h, size_t count, const double *A,
                                   const double *g, const double *F,
                                   const double *origin, const double *drift,
                                   double *x, double *p, double *z, double *dz)
{
#pragma omp simd
    for (size_t j = 0; j < count; j++) {
        const double dx = (p[j] - h * g[j]) / A[j];
        x[j] += dx;
        p[j] += h * (F[j] - g[j]);
        z[j] = x[j] - origin[j];
        dz[j] = dx - drift[j];
    }
}

/* Give the digits of step_fractional in nine tenths of its time for a million coordinates. Each part of the coordinates
 * is loaded from memory once and goes through the whole step. z and dz hold one part only, and dx is not stored. */
static int step_by_parts(fvi_stepper *s)
{
    static const double none[PART];
    fvi_damping *d = s->method_state;
    const size_t dim = s->run.system->d;
    const double *A = fvi_newton_diagonal(s->newton);
    int status = fvi_potential_gradient(s->run.system, s->x, s->g);
    if (!status)
        status = fvi_force_value(s, (double)(s->k + 1) * s->run.h);
    for (size_t i = 0; i < dim && !status; i += PART) {
        const size_t count = dim - i < PART ? dim - i : PART;
        const double *factor = d->factor + i,
                     *F = s->run.system->force.value ? s->F + i : none;
        double *p = s->p + i;
        drift_part(s->run.h, count, A + i, s->g + i, F, d->origin + i,
                   d->increments ? d->drift + i : none, s->x + i, p, d->z,
                   d->dz);
        status = fvi_history_push_part(d->memory, i, count, d->z, d->dz, d->z);
#pragma omp simd
        for (size_t j = 0; j < count; j++)
            p[j] -= factor[j] * d->z[j];
    }
    return status;
}
//< drift

/* The function is not inlined, so that the path of one coordinate need not save registers for it. */
__attribute__((noinline)) static int step_coordinates(fvi_stepper *s)
{
    return can_step_by_parts(s) ? step_by_parts(s) : step_fractional(s);
}

static int step(fvi_stepper *s)
{
    return is_single_equation(s) ? step_one_coordinate(s) : step_coordinates(s);
}

const fvi_method fvi_fractional = { .name = "fvi",
                                    .order = "1",
                                    .lowest = 1,
                                    .highest = 1,
                                    .memory = "full",
                                    .alpha_most = 1,
                                    .memories = FVI_ALL_MEMORIES,
                                    .scheme = FVI_SCHEME_FVI,
                                    .takes_kappa = 1,
                                    .takes_laws = 1,
                                    .takes_matrices = 1,
                                    .takes_mechanism = 1,
                                    .implicit = 1,
                                    .paper_convention = 1,
                                    .stability_number = fvi_stability_number_backward,
                                    .stability_number_grows = 1,
                                    .start = start_fractional,
                                    .step = step,
                                    .copy = copy_fractional,
                                    .serialize = serialize_fractional,
                                    .damper = fvi_damping_sums,
                                    .keep_dampers = keep_dampers,
                                    .stop = stop_fractional };
