/* src/variable_step/variable_structure_forces.c -- The forces of a structure's dampers within a step. [H 27, 22] */
#include "variable_structure.h"

#include "system/dot.h"

#include <math.h>
#include <string.h>

void fvi_structure_mesh_weights(const fvi_stepper *s, double t, double *now, double *sum)
{
    const fvi_variable_step_state *o = s->method_state;
    const double h = s->t - o->t0, theta = h > 0 ? (t - o->t0) / h : 0;
    double once[FVI_LANES], power[FVI_LANES] = { 1 };
    memset(now, 0, FVI_LANES * sizeof *now);
    memset(sum, 0, FVI_LANES * sizeof *sum);
    fvi_variable_step_once(theta, once);
    for (size_t k = 1; k < FVI_LANES; k++)
        power[k] = theta * power[k - 1];
    for (size_t i = 0; i < o->rule->s; i++) {
        double one[FVI_LANES] = { 0 }, legendre[FVI_LANES], g[FVI_LANES];
        one[i] = 1;
        fvi_mesh_coefficients(o, one, legendre);
        fvi_variable_step_powers(o->rule->s, legendre, g);
        now[i] = fvi_dot(o->rule->s, power, g);
        sum[i] = h * fvi_dot(o->rule->s, once, g);
    }
}

/* Return damper `number` of the run, or NULL if it has no history. */
static fvi_mesh_matrix *find_damper(const fvi_variable_step_state *o, size_t number)
{
    for (size_t j = 0; j < o->structure->count; j++)
        if (o->structure->damper[j].number == number)
            return &o->structure->damper[j];
    return NULL;
}

/* The answer of a damper is the known part of its force and the present part, of V - v_k. */
int fvi_structure_mesh_force(const fvi_stepper *s, size_t number, const double *weights, double *force)
{
    const fvi_variable_step_state *o = s->method_state;
    const size_t stages = o->rule->s;
    fvi_mesh_matrix *of = find_damper(o, number);
    if (!of)
        return FVI_SUCCESS;
    memset(of->z, 0, of->r * sizeof *of->z);
    for (size_t i = 0; i < stages; i++) {
        double of_slope = 0;
        for (size_t c = 0; c < stages; c++)
            of_slope += weights[c] * of->W[c * stages + i];
        for (size_t n = 0; n < of->r; n++)
            of->z[n] += weights[i] * of->force[i * of->r + n] + of_slope * of->slope[i * of->r + n];
    }
    return of->of.matrix.apply_damping(o->d, -1, of->z, of->of.matrix.params, force);
}

int fvi_structure_mesh_power(const fvi_stepper *s, size_t number, double *power)
{
    const fvi_variable_step_state *o = s->method_state;
    double *force = o->structure->Kx;
    int status = FVI_SUCCESS;
    memset(power, 0, FVI_LANES * sizeof *power);
    for (size_t i = 0; i < o->rule->s && !status; i++) {
        double one[FVI_LANES] = { 0 };
        one[i] = 1;
        memset(force, 0, o->d * sizeof *force);
        status = fvi_structure_mesh_force(s, number, one, force);
        for (size_t j = 0; j < o->d; j++)
            power[i] += force[j] * (o->v0[j] + o->delta[j * FVI_LANES + i]);
    }
    return status;
}
