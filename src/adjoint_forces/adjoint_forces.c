/* src/adjoint_forces/adjoint_forces.c -- fvi_adjoint_forces: every derivative of a J of the forces of dampers. [H 23]
 *
 * The force of a damper in a row is a linear function of its impulses (23.32). The transpose of that function turns the
 * derivatives by forces into derivatives by impulses. Then fvi_adjoint differentiates the run with walls (23.33). */
#include "adjoint_forces.h"

#include "adjoint_forces_start.h"
#include "observer/observer_column.h"
#include "observer/observer_ramp.h"
#include "run/run_damper.h"
#include "system/fail.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- J of the run with walls ---- */

typedef struct {
    const fvi_walls *walls;
    const fvi_objective *of;
    const double *by_impulse;
    double *x, *Jx, *Jp; /* for the run without walls, d numbers each */
} walled;

/* The slopes of J for the run with walls: dJ/dx_k and dJ/dp_k go to the coordinates of the run, and dJ/dI to the
 * momenta of the walls. */
static int slopes(size_t k, size_t d, const double *x, const double *p, void *params, double *Jx, double *Jp)
{
    walled *o = params;
    const fvi_walls *w = o->walls;
    const int has_p = p || o->of->has_momenta;
    double *own_p = o->x + w->d;
    (void)d;
    for (size_t i = 0; i < w->d; i++) {
        o->x[i] = x[w->index[i]];
        own_p[i] = p ? p[w->index[i]] : 0;
        o->Jx[i] = o->Jp[i] = 0;
    }
    const int status = o->of->slopes(k, w->d, o->x, p ? own_p : NULL, o->of->params, o->Jx, has_p ? o->Jp : NULL);
    for (size_t i = 0; i < w->d; i++) {
        Jx[w->index[i]] += o->Jx[i];
        Jp[w->index[i]] += o->Jp[i];
    }
    for (size_t i = 0; i < w->n && k > 0; i++) {
        const double by = o->by_impulse[k * w->n + i];
        if (w->wall[i] != SIZE_MAX)
            Jp[w->wall[i]] += by;
        if (w->is_ghost)
            Jp[w->index[i]] -= by;
    }
    return status;
}

/* ---- derivatives of the run with walls, and of the run ---- */

typedef struct {
    double *x0, *p0, *mass, *damping, *force;
    size_t times;
} spread;

/* At how many times a force acts, as fvi_sensitivities counts them. */
static size_t count_force_times(const fvi_method *method, const fvi_run *run)
{
    return run->steps * (method->stages ? (size_t)method->stages - 1 : 1) + 1;
}

/* Allocate the derivatives that have a number for each coordinate. */
static int start_spread(spread *o, const fvi_walls *w, const fvi_sensitivities *want, fvi_sensitivities *to)
{
    const size_t whole = w->whole;
    o->x0 = calloc((4 + (want->force ? o->times : 0)) * whole, sizeof *o->x0);
    if (!o->x0)
        return FVI_ENOMEM;
    o->p0 = o->x0 + whole;
    o->mass = o->p0 + whole;
    o->damping = o->mass + whole;
    o->force = o->damping + whole;
    *to = *want;
    to->x0 = want->x0 ? o->x0 : NULL;
    to->p0 = want->p0 ? o->p0 : NULL;
    to->force = want->force ? o->force : NULL;
    to->mass = want->mass && !w->system.matrices ? o->mass : want->mass;
    to->damping = want->damping && w->is_ghost ? o->damping : want->damping;
    to->sensitivity = w->sensitivity;
    to->lagrangian = w->lagrangian;
    to->columns = want->columns ? &w->columns : NULL;
    return FVI_SUCCESS;
}

/* Copy the derivatives of the run with walls to the derivatives of the run. The force acts on a coordinate and on its
 * ghost, so the derivative by it is a sum of two. */
static void write_derivatives(const spread *o, const fvi_walls *w, const fvi_sensitivities *want,
                              const double *by_impulse)
{
    for (size_t i = 0; i < w->d; i++) {
        const size_t at = w->index[i];
        if (want->x0)
            want->x0[i] = o->x0[at];
        if (want->p0)
            want->p0[i] = o->p0[at];
        for (size_t k = 1; want->p0 && w->is_ghost && k <= w->run.steps; k++)
            want->p0[i] += by_impulse[k * w->n + i];
        if (want->mass && !w->system.matrices)
            want->mass[i] = o->mass[at];
        if (want->damping && w->is_ghost)
            want->damping[i] = o->damping[at];
        for (size_t k = 0; want->force && k < o->times; k++)
            want->force[k * w->d + i] =
                o->force[k * w->whole + at] + (w->is_ghost ? o->force[k * w->whole + w->wall[i]] : 0);
    }
}

static int run_adjoint_of_walls(const fvi_method *method, const fvi_walls *w, const fvi_objective *of,
                                const double *by_impulse, const fvi_sensitivities *want)
{
    double *room = malloc(4 * w->d * sizeof *room);
    walled params = { w, of, by_impulse, room, room + 2 * w->d, room + 3 * w->d };
    const fvi_objective J = { slopes, &params, 1 };
    fvi_sensitivities to;
    spread o = { .times = count_force_times(method, &w->run) };
    int status = room ? start_spread(&o, w, want, &to) : FVI_ENOMEM;
    if (!status)
        status = fvi_adjoint(method, &w->run, NULL, NULL, &J, &to);
    if (!status)
        write_derivatives(&o, w, want, by_impulse);
    free(o.x0);
    free(room);
    return status;
}

/* ---- from forces to impulses ---- */

/* Turn dL/d(force) into dL/d(impulse), dL/d(jump) and dL/d(line). The line of a damper also adds its lead (13.18) to
 * the impulses. */
static int transpose(const fvi_stepper *s, fvi_observer *o, const double *force, fvi_force_shares *shares)
{
    const fvi_run *run = &s->run;
    const size_t n = shares->n;
    double *lead = malloc((run->steps + 1) * sizeof *lead);
    int status = lead ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status && force)
        status = fvi_observer_transpose(o, run, force, shares->impulse, shares->jump, shares->line);
    for (size_t i = 0, of = SIZE_MAX; i < n && !status; i++) {
        size_t coordinate;
        const size_t j = fvi_observer_damper_of(o, i, &coordinate);
        if (j != of)
            status = fvi_ramp_leads(s, j, run->steps, 0, lead);
        of = j;
        const double rho = run->system->matrices ? fvi_run_damper_of(run, j).rho : 1;
        for (size_t k = 1; k <= run->steps && !status; k++)
            shares->line[i] += rho * shares->impulse[k * n + i] * lead[k - 1];
    }
    free(lead);
    return status;
}

static int start_shares(fvi_force_shares *o, const fvi_observer *of, size_t steps, const double *impulse)
{
    const size_t n = o->n = fvi_observer_numbers(of), rows = (steps + 1) * n;
    o->impulse = calloc(rows + 2 * n + 1, sizeof *o->impulse);
    if (!o->impulse)
        return FVI_ENOMEM;
    o->jump = o->impulse + rows;
    o->line = o->jump + n;
    if (impulse)
        memcpy(o->impulse, impulse, rows * sizeof *impulse);
    return FVI_SUCCESS;
}

static int derivatives_of_walls(const fvi_method *method, const fvi_run *run, const fvi_objective *objective,
                                const double *by_impulse, const fvi_sensitivities *want)
{
    fvi_walls w = { 0 };
    int status = run->system->matrices    ? fvi_walls_of_structure(&w, run)
                 : run->system->mechanism ? fvi_walls_of_mechanism(&w, run, want)
                                          : fvi_walls_of_chain(&w, run, want);
    if (!status)
        status = run_adjoint_of_walls(method, &w, objective, by_impulse, want);
    fvi_walls_free(&w);
    return status;
}

/* ---- what can be differentiated ---- */

static int check(const fvi_method *method, const fvi_run *run, const fvi_objective *objective,
                 const fvi_sensitivities *gradients)
{
    if (!method || !run || !run->system || !objective || !objective->slopes || !gradients)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (method->dense)
        FVI_FAIL("fvi-adaptive has no derivatives of the forces of dampers; methods whose steps have one length have",
                 FVI_EUNSUP);
    if (run->system->matrices && (!run->system->matrices->M || !run->system->matrices->K))
        FVI_FAIL("matrices without their entries have no derivatives of the forces of dampers", FVI_EUNSUP);
    if (run->event_count > 0)
        FVI_FAIL("a run with events has no derivatives of the forces of dampers", FVI_EUNSUP);
    if (!run->system->matrices && !run->system->mechanism && !run->law && run->alpha == 1)
        FVI_FAIL("at alpha = 1 the damping is a mass, and has no derivatives of its forces", FVI_EUNSUP);
    return FVI_SUCCESS;
}

int fvi_adjoint_forces(const fvi_method *method, const fvi_run *run, const fvi_objective *objective,
                       const double *force, const double *impulse, const fvi_sensitivities *gradients)
{
    int status = check(method, run, objective, gradients);
    fvi_stepper *s = NULL;
    fvi_observer *o = NULL;
    fvi_force_shares shares = { 0 };
    if (!status)
        status = fvi_stepper_start(method, run, &s, NULL);
    if (!status)
        status = fvi_observer_start(s, FVI_OBSERVE_FORCE | FVI_OBSERVE_OWN_STEPS, &o, NULL);
    if (!status)
        status = start_shares(&shares, o, run->steps, impulse);
    if (!status)
        status = transpose(s, o, force, &shares);
    if (!status)
        status = derivatives_of_walls(method, run, objective, shares.impulse, gradients);
    if (!status)
        status = fvi_force_start(s, &shares, gradients);
    if (!status)
        status = fvi_force_numbers(method, run, force, &shares, gradients);
    fvi_observer_free(o);
    fvi_stepper_free(s);
    free(shares.impulse);
    return status;
}
