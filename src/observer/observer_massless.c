/* src/observer/observer_massless.c -- The velocities with which coordinates without inertia start. [H 29]
 *
 * The caller does not give them. The forces on such a coordinate are in balance. Just after t = 0 a damper of the order
 * 1 answers to a velocity at once, and a damper of a lower order not yet. So the velocities w of the coordinates
 * without inertia solve
 *
 *     sum_j rho_j g_j (g_j . w + the part of zdot_j from the other coordinates) = F - grad U   in their rows,   (29.27)
 *
 * with rho_j the dashpot in damper j and g_j the gradient of its elongation. If this has no solution, for example
 * because a damper has another order, the velocity may be infinite, and the observer gives the mean over the first
 * row. */
#include "observer_state.h"

#include "kernel/kernel_terms.h"
#include "mechanism/mechanism_state.h"
#include "run/run_damper.h"
#include "system/lagrangian_point.h"

#include <stdlib.h>
#include <string.h>

/* Return nonzero if all forces on such coordinates are forces of the potential, of time, or of dampers. */
static int is_balance_known(const fvi_stepper *s)
{
    const fvi_mechanism *m = s->run.system->mechanism;
    return !m->lagrangian && !m->force_on && s->mechanism->m == 0;
}

static double dashpot_of(const fvi_run_damper *of)
{
    return of->growth < 1 ? 0 : of->law ? fvi_kernel_dashpot(of->law) : of->rho;
}

/* Add damper j to the matrix B, d times d, and subtract its part from r. Returns FVI_EUNSUP if the damper does not let
 * them start with finite velocities, or if its past jumps. */
static int add_damper(fvi_observer *o, const fvi_stepper *s, size_t j, double *B, double *r)
{
    const fvi_elongation *of = &o->mechanism->damper[j].of;
    const fvi_run_damper damper = fvi_run_damper_of(&s->run, j);
    const double rho = dashpot_of(&damper);
    double z, rate;
    const int status = fvi_observer_elongation(o, s, of, &z, &rate);
    const double *g = of->row ? of->row : o->F;
    if (status)
        return status;
    if (damper.past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && z != 0)
        return FVI_EUNSUP;
    for (size_t i = 0; i < o->d; i++) {
        if (damper.growth > 1 && s->mechanism->is_massless[i] && g[i] != 0)
            return FVI_EUNSUP;
        r[i] -= rho * rate * g[i];
        for (size_t l = 0; l < o->d; l++)
            B[i * o->d + l] += rho * g[i] * g[l];
    }
    return FVI_SUCCESS;
}

/* Write F - grad U, and the matrix of all dampers. */
static int make_balance(fvi_observer *o, const fvi_stepper *s, double *B, double *r)
{
    int status = is_balance_known(s) ? fvi_step_force(s, 0, r) : FVI_EUNSUP;
    if (!status)
        status = fvi_potential_gradient(s->run.system, s->x, o->g);
    for (size_t i = 0; i < o->d && !status; i++)
        r[i] -= o->g[i];
    for (size_t j = 0; j < o->dampers && !status; j++)
        status = add_damper(o, s, j, B, r);
    for (size_t i = 0; i < o->d && !status; i++) { /* the other coordinates keep their velocities */
        if (s->mechanism->is_massless[i])
            continue;
        memset(B + i * o->d, 0, o->d * sizeof *B);
        B[i * o->d + i] = 1;
        r[i] = 0;
    }
    return status;
}

int fvi_observer_begin_massless(fvi_observer *o, const fvi_stepper *s)
{
    const size_t d = o->d;
    double *B = calloc(d * d + d, sizeof *B), *w = B + d * d;
    size_t *order = calloc(d, sizeof *order);
    int status = B && order ? fvi_observer_velocity(o, s, s->p, o->v) : FVI_ENOMEM;
    if (!status)
        status = make_balance(o, s, B, w);
    if (!status)
        status = fvi_solve_matrix(d, B, w, order);
    for (size_t i = 0; i < d && !status; i++)
        o->begin_v[i] = w[i];
    o->begin_v_known = !status && fvi_all_finite(d, w);
    free(B);
    free(order);
    return status == FVI_ENOMEM ? status : FVI_SUCCESS;
}

int fvi_observer_begin_accelerations(fvi_observer *o, const fvi_stepper *s)
{
    const double *mass = s->run.system->mass;
    memcpy(o->force, o->start, o->forces * sizeof *o->force);
    int status = fvi_observer_damping(o, s, o->a);
    if (!status)
        status = fvi_step_force(s, 0, o->F);
    if (!status)
        status = fvi_potential_gradient(s->run.system, s->x, o->g);
    for (size_t i = 0; i < o->slopes && !status; i++)
        if (!s->mechanism->is_massless[i])
            o->start[o->forces + i] = (o->F[i] - o->g[i] - o->a[i]) / mass[i];
    return status;
}

int fvi_observer_mean_massless(fvi_observer *o, const fvi_stepper *s)
{
    double end = s->run.h;
    const double *row = fvi_short_row(&o->short_rows, 1), *x = row ? row + o->forces + 2 * o->d + o->ties : o->x;
    fvi_stepper *fork = NULL;
    int status = row ? FVI_SUCCESS : fvi_stepper_copy(s, &fork);
    if (!row && !status)
        status = fvi_observer_take_first_row(fork, NULL, &end);
    if (!row && !status)
        status = fvi_stepper_advance_to(fork, end, o->x, NULL);
    fvi_stepper_free(fork);
    for (size_t i = 0; i < o->d && !status; i++)
        o->begin_v[i] = (x[i] - s->x[i]) / end;
    return status;
}

void fvi_observer_put_massless(const fvi_observer *o, const fvi_stepper *s, double *v)
{
    for (size_t i = 0; i < o->d; i++)
        if (s->mechanism->is_massless[i])
            v[i] = o->begin_v[i];
}
