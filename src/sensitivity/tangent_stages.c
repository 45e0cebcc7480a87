/* src/sensitivity/tangent_stages.c -- What a direction changes at the stages of a step.       [H 24] */
#include "tangent.h"

#include "methods/lobatto_matrices.h"
#include "methods/lobatto_stages.h"

#include <string.h>

/* (17.3): the inverse of A, of form D; or D alone, of form M: of numbers that are `stride` apart. */
static double differentiated(const fvi_tangent_run *o, size_t i, const double *w, size_t stride)
{
    double sum = o->method->damped_inertia && i == 0 ? w[0] / o->rule->b[0] : 0;
    for (size_t l = 0; l < o->s; l++)
        sum += o->rule->D[i][l] * w[l * stride];
    return sum;
}

/* Velocities and positions of the stages of the step just done, which began at x_k with v_k. */
static void read_stages(fvi_tangent_run *o)
{
    const size_t d = o->d, s = o->s;
    const double h = o->run->h;
    const fvi_lobatto_matrices *m = fvi_lobatto_matrices_of(o->stepper);
    const fvi_lobatto_stages *stages = m ? NULL : o->stepper->method_state;
    if (m)
        memcpy(o->V, m->V, s * d * sizeof *o->V);
    for (size_t i = 0; i < s; i++)
        for (size_t n = 0; n < d; n++) {
            double moved = 0;
            if (stages)
                o->V[i * d + n] = differentiated(o, i, stages->dX + n, d) / h;
            for (size_t l = 0; m && l < s; l++)
                moved += h * o->A[i][l] * m->V[l * d + n];
            o->X[i * d + n] = o->x_k[n] + (stages ? stages->dX[i * d + n] : moved);
        }
}

/* What a unit of mass does to stage i, as a force: the inertia of the motion, of coordinate n. */
static double inertia(const fvi_tangent_run *o, size_t i, size_t n)
{
    const double *b = o->rule->b, h = o->run->h, *V = o->V + n;
    const size_t s = o->s, d = o->d;
    double sum = 0, away[FVI_STAGES];
    if (o->method->damped_inertia) {
        for (size_t l = 0; l < s; l++)
            away[l] = V[l * d] - o->left[n];
        return -differentiated(o, i, away, 1) / h;
    }
    for (size_t l = 0; l < s; l++)
        sum += o->rule->D[l][i] * b[l] * V[l * d];
    return sum / (h * b[i]);
}

/* The forces of the masses, of the parameters of U and of a force that is changed itself. */
static int fill_sources(fvi_tangent_run *o, size_t k)
{
    const fvi_matrices *m = o->run->system->matrices;
    const size_t d = o->d;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < o->s; i++) {
        double *of_mass = o->right, *slope = o->room;
        for (size_t n = 0; n < d; n++)
            (m ? slope : of_mass)[n] = inertia(o, i, n);
        if (m)
            status = m->inertia(d, slope, m->params, of_mass);
        for (size_t j = 0; j < o->P; j++) {
            const fvi_sensitivities *along = o->along + j;
            const double *dU = o->dU + (i * o->P + j) * d,
                         *F = along->force ? along->force + (k * (o->s - 1) + i) * d : NULL;
            double *source = fvi_tangent_source(o, j, i);
            for (size_t n = 0; n < d; n++) {
                source[n] = (along->mass ? along->mass[m ? 0 : n] * of_mass[n] : 0) - dU[n];
                source[n] += F ? F[n] : 0;
            }
        }
    }
    return status;
}

//> stages
/* (24.12): q_i, the forces on the slopes, from the stages of the step just done. */
int fvi_tangent_stages_step(fvi_tangent_run *o)
{
    fvi_stepper *s = o->stepper;
    const fvi_lobatto_matrices *m = fvi_lobatto_matrices_of(s);
    const size_t k = s->k;
    memcpy(o->x_k, s->x, o->d * sizeof *o->x_k);
    if (m)
        memcpy(o->left, m->v, o->d * sizeof *o->left);
    else
        fvi_tangent_velocity(o, o->left); /* v_k */
    int status = fvi_stepper_step(s);
    if (!status)
        read_stages(o);
    for (size_t i = 0; !status && i < o->s; i++)
        status = fvi_tangent_evaluate_potential(o, i, o->X + i * o->d);
    if (!status)
        status = fill_sources(o, k);
    for (size_t j = 0; !status && j < o->dampers; j++)
        status = fvi_tangent_damper_stages(o, k, o->each + j);
    for (size_t l = 0; !status && l < o->lanes; l++) {
        o->linearised[l].asked = 0;
        status = fvi_stepper_step(o->lane[l]);
    }
    return status;
}
//< stages
