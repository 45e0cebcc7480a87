/* src/observer/observer_structure.c -- Dampers of matrices, by a method that chooses its steps. [H 27]
 *
 * Each step has the forces of all dampers at its stages. The force at a time is the polynomial through them, and the
 * impulse and the work are its integrals. */
#include "observer_state.h"

#include "mechanism/mechanism.h"
#include "system/dot.h"
#include "variable_step/variable_structure.h"

#include <string.h>

int fvi_observer_is_on_structure(const fvi_observer *o, const fvi_stepper *s)
{
    return s->method->dense && o->is_summed && fvi_has_dampers_of_matrices(s->run.system);
}

/* Add the sums from the beginning of the last step to t. */
static int add_last_step(const fvi_observer *o, const fvi_stepper *s, double t, double *impulse, double *work)
{
    double now[FVI_LANES], sum[FVI_LANES];
    int status = FVI_SUCCESS;
    fvi_structure_mesh_weights(s, t, now, sum);
    for (size_t j = 0; j < o->dampers && !status; j++) {
        status = fvi_structure_mesh_force(s, j, sum, impulse + j * o->d);
        work[j] += fvi_dot(FVI_LANES, sum, o->stage_power + j * FVI_LANES);
    }
    return status;
}

int fvi_observer_close_structure(fvi_observer *o, const fvi_stepper *s)
{
    return add_last_step(o, s, s->t, o->impulse, o->begun_work);
}

int fvi_observer_keep_structure(fvi_observer *o, const fvi_stepper *s)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; o->wanted & FVI_OBSERVE_WORK && j < o->dampers && !status; j++)
        status = fvi_structure_mesh_power(s, j, o->stage_power + j * FVI_LANES);
    return status;
}

int fvi_observer_structure_sums(fvi_observer *o, const fvi_stepper *s, double t)
{
    memcpy(o->impulse_now, o->impulse, o->forces * sizeof *o->impulse);
    memcpy(o->work, o->begun_work, o->dampers * sizeof *o->work);
    return add_last_step(o, s, t, o->impulse_now, o->work);
}

int fvi_observer_structure_forces(fvi_observer *o, const fvi_stepper *s, double t)
{
    double now[FVI_LANES], sum[FVI_LANES];
    int status = FVI_SUCCESS;
    fvi_structure_mesh_weights(s, t, now, sum);
    memset(o->force, 0, o->forces * sizeof *o->force);
    for (size_t j = 0; j < o->dampers && !status; j++)
        status = fvi_structure_mesh_force(s, j, now, o->force + j * o->d);
    return status;
}
