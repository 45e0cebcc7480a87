/* src/methods/lobatto_matrices.c -- Take a step with stages for a system with matrices.  [H 27] */
#include "lobatto_matrices.h"

#include "newton/linearised.h"

#include <math.h>
#include <string.h>

/* Compute v from p if an impulse has changed p since the last step. */
static int find_velocity(fvi_stepper *s, fvi_lobatto_matrices *o)
{
    const size_t bytes = o->d * sizeof *s->p;
    if (memcmp(s->p, o->p, bytes) == 0)
        return FVI_SUCCESS;
    memcpy(o->p, s->p, bytes);
    return fvi_divide_by_mass(s->run.system, s->p, o->v);
}

/* Return 1 for a run in dual variables (23.15): v is the multiplier, and x is the force that drives it, summed from the
 * end of the original run. In the equations x takes the place of -K x. */
static int is_dual(const fvi_stepper *s)
{
    const fvi_linearised *linearised = fvi_linearised_of(s->run.system);
    return linearised && linearised->is_dual;
}

/* Compute K x_k, K v_k, and the input of the dampers. */
static int read_start(const fvi_stepper *s, fvi_lobatto_matrices *o)
{
    const fvi_matrices *m = s->run.system->matrices;
    int status = is_dual(s) ? FVI_SUCCESS : m->stiffness(o->d, s->x, m->params, o->Kx);
    for (size_t j = 0; is_dual(s) && j < o->d; j++)
        o->Kx[j] = -s->x[j];
    if (!status)
        status = m->stiffness(o->d, o->v, m->params, o->Kv);
    return status ? status : fvi_stage_dampers_read(s, o);
}

/* Set the load to F - K (x_k + h c_i v_k) at the stages. */
static void set_load(const fvi_stepper *s, fvi_lobatto_matrices *o)
{
    const size_t d = o->d;
    for (size_t i = 0; i < o->s; i++) {
        const double ch = s->run.h * o->rule->c[i];
        for (size_t j = 0; j < d; j++)
            o->load[i * d + j] = o->F[i * d + j] - o->Kx[j] - ch * o->Kv[j];
    }
}

/* Compute the mean of V_i - v_k with the weights b_i, dv = v_{k+1} - v_k, and dp = p_{k+1} - p_k = M dv. */
static int find_changes(const fvi_stepper *s, fvi_lobatto_matrices *o)
{
    const fvi_matrices *m = s->run.system->matrices;
    const size_t d = o->d, end = (o->s - 1) * d;
    memcpy(o->dv, o->V + end, d * sizeof *o->dv);
    for (size_t j = 0; j < d; j++) {
        double mean = 0;
        for (size_t i = 0; i < o->s; i++)
            mean += o->rule->b[i] * o->V[i * d + j];
        o->mean[j] = mean;
    }
    return m->inertia(d, o->dv, m->params, o->dp);
}

int fvi_lobatto_matrices_solve(const fvi_stepper *s, fvi_lobatto_matrices *o)
{
    set_load(s, o);
    int status = fvi_stage_dampers_begin_step(s, o);
    if (!status)
        status = fvi_stage_solver_solve(o->solver, o->load, o->V); /* (27.14) */
    if (!status)
        status = fvi_stage_dampers_end_step(o);
    return status ? status : find_changes(s, o);
}

/* Take a step without the map. On exit V holds the velocities of the stages. */
static int solve_step(const fvi_stepper *s, fvi_lobatto_matrices *o)
{
    const int status = fvi_lobatto_matrices_solve(s, o);
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < o->d; j++)
            o->V[i * o->d + j] += o->v[j];
    return status;
}

/* Add the changes of the step, with x_{k+1} - x_k = h sum_i b_i V_i. In dual variables x changes by -K times this, and
 * p stays unchanged, because no caller reads it. */
static int add_changes(fvi_stepper *s, fvi_lobatto_matrices *o)
{
    const fvi_matrices *m = s->run.system->matrices;
    const int dual = is_dual(s);
    double *dx = o->Kx; /* K x_k is no longer needed */
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->d; j++)
        dx[j] = s->run.h * (o->v[j] + o->mean[j]);
    if (dual)
        status = m->stiffness(o->d, dx, m->params, o->Kv);
    for (size_t j = 0; !status && j < o->d; j++) {
        s->x[j] += dual ? -o->Kv[j] : dx[j];
        o->v[j] += o->dv[j];
        s->p[j] += dual ? 0 : o->dp[j];
        o->p[j] = s->p[j];
    }
    return status;
}

//> step
int fvi_lobatto_matrices_step(fvi_stepper *s)
{
    fvi_lobatto_matrices *o = s->method_state;
    int status = find_velocity(s, o);
    if (!status)
        status = fvi_step_forces_at_stages(s, s->k, o->s, o->rule, o->F); /* limits from within the step at its ends */
    if (!status)
        status = read_start(s, o);
    if (!status && !fvi_step_map_apply(s, o))
        status = solve_step(s, o);
    if (!status)
        status = fvi_stage_dampers_push(o);
    if (!status)
        status = add_changes(s, o);
    for (size_t j = 0; !status && j < o->dampers; j++)
        if (o->each[j].kept)
            status = fvi_stage_damper_sums(s, j, o->each[j].kept, &o->each[j].work);
    return status;
}
//< step

int fvi_lobatto_matrices_ends(const fvi_stepper *s, fvi_step_sums *sums)
{
    const fvi_lobatto_matrices *o = fvi_lobatto_matrices_of(s);
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < o->d; j++)
            sums->by_force += s->run.h * o->rule->b[i] * o->F[i * o->d + j] * o->V[i * o->d + j];
    memset(sums->damper, 0, fvi_step_dampers(s->run.system) * o->d * sizeof *sums->damper);
    for (size_t j = 0; !status && j < o->dampers; j++) {
        const size_t number = o->each[j].number;
        status = fvi_stage_damper_sums(s, j, sums->damper + number * o->d, sums->work + number);
    }
    return status;
}
