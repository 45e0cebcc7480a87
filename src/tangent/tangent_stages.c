/* src/tangent/tangent_stages.c -- A step of the derivatives by a method with stages. [H 24] */
#include "tangent.h"

#include "methods/lobatto_matrices.h"
#include "methods/lobatto_stages.h"

#include <math.h>
#include <string.h>

/* Entry i of the inverse of A times w in form D, and of D w in form M. (17.3) The numbers of w are `stride` apart. */
static double differentiate_stages(const fvi_tangent_run *o, size_t i, const double *w, size_t stride)
{
    double sum = o->method->damped_inertia && i == 0 ? w[0] / o->rule->b[0] : 0;
    for (size_t l = 0; l < o->s; l++)
        sum += o->rule->D[i][l] * w[l * stride];
    return sum;
}

/* Read the velocities and positions of the stages of the last step, which began at x_k with v_k. */
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
                o->V[i * d + n] = differentiate_stages(o, i, stages->dX + n, d) / h;
            for (size_t l = 0; m && l < s; l++)
                moved += h * o->A[i][l] * m->V[l * d + n];
            o->X[i * d + n] = o->x_k[n] + (stages ? stages->dX[i * d + n] : moved);
        }
}

/* The force at stage i that a unit of mass more adds to coordinate n: minus the inertia force of that unit. */
static double inertia(const fvi_tangent_run *o, size_t i, size_t n)
{
    const double *b = o->rule->b, h = o->run->h, *V = o->V + n;
    const size_t s = o->s, d = o->d;
    double sum = 0, away[FVI_STAGES];
    if (o->method->damped_inertia) {
        for (size_t l = 0; l < s; l++)
            away[l] = V[l * d] - o->left[n];
        return -differentiate_stages(o, i, away, 1) / h;
    }
    for (size_t l = 0; l < s; l++)
        sum += o->rule->D[l][i] * b[l] * V[l * d];
    return sum / (h * b[i]);
}

/* Write the forces that come from changes of the masses, of the parameters of U and of the force itself. */
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

/* ---- dampers ---- */

/* Write what the history of a damper gets: the velocities of the stages without the line. */
static int find_velocities(fvi_tangent_run *o, fvi_tangent_damper *a)
{
    const fvi_damping_matrix *C = &a->of.matrix;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < o->s; i++) {
        const double *V = o->V + i * o->d;
        double *v = C->select_history ? o->room : a->by_theta, *selected = a->by_theta;
        for (size_t n = 0; n < o->d; n++)
            v[n] = V[n] - (a->has_line ? o->v0[n] : 0);
        if (C->select_history)
            status = C->select_history(o->d, v, a->zeros, C->params, selected);
        for (size_t n = 0; n < a->r; n++)
            a->v[n * o->s + i] = selected[n];
    }
    return status;
}

/* Write W v plus the history, and its derivative by beta, and compute the history of the next step. */
static int find_sums(fvi_tangent_run *o, fvi_tangent_damper *a)
{
    const size_t s = o->s;
    double *Y = a->sum, *Ydot = a->sumdot;
    const double *W = fvi_lobatto_history_w0(a->of_stages),
                 *rate = a->of.law ? NULL : fvi_lobatto_history_w0_by_order(a->of_stages),
                 log_h = log(o->run->h);
    for (size_t n = 0; n < a->r; n++)
        for (size_t i = 0, at = n * s; i < s; i++, at++) {
            Y[at] = a->Y[at];
            Ydot[at] = a->Ydot[at];
            for (size_t l = 0; l < s; l++) {
                Y[at] += W[i * s + l] * a->v[n * s + l];
                Ydot[at] += rate ? rate[i * s + l] * a->v[n * s + l] : 0;
            }
            Y[at] *= a->unit;
            Ydot[at] = a->unit * Ydot[at] - log_h * Y[at];
        }
    return fvi_lobatto_history_push(a->of_stages, a->v, a->Y, a->of.law ? NULL : a->Ydot);
}

/* The force that direction j changes through the numbers of a law, for rho = 1. `at` is the index of number and
 * stage. */
static double terms_along(const fvi_tangent_run *o, const fvi_tangent_damper *a, size_t j, size_t at)
{
    double sum = 0;
    for (size_t l = 0; l < a->terms_of_stages.count; l++) {
        const fvi_stage_term *t = a->terms_of_stages.each + l;
        double number[4];
        fvi_tangent_numbers(o, a, j, l, number);
        for (size_t by = 0; by < 4; by++)
            if (t->by[by])
                sum += number[by] * t->factor[by] * t->by[by][at];
    }
    return sum;
}

static int add_forces(fvi_tangent_run *o, size_t k, fvi_tangent_damper *a)
{
    const double *Y = a->sum, *Ydot = a->sumdot;
    double at[FVI_STAGES] = { 0 }, slope[FVI_STAGES] = { 0 }, change[FVI_STAGES] = { 0 }, *y = a->now;
    const double log_h = log(o->run->h);
    const int is_matrix = a->of.matrix.select_history != NULL;
    int status = FVI_SUCCESS;
    if (a->impulse_unit != 0)
        fvi_tangent_past(a, k, at, slope);
    for (size_t j = 0; j < o->P; j++) {
        const double order = fvi_tangent_order(o, a, j);
        for (size_t i = 0; !status && i < o->s; i++) {
            double *source = fvi_tangent_source(o, j, i);
            for (size_t n = 0; n < a->r; n++) {
                const size_t place = n * o->s + i;
                const double impulse = is_matrix ? 0 : a->CA[n] * a->impulse_unit / (o->run->h * o->rule->b[i]);
                y[n] = fvi_tangent_factor(o, a, j, n) * (Y[place] + impulse * at[i])
                       + 2 * fvi_tangent_rho(o, a, n) * order
                             * (Ydot[place] - impulse * (log_h * at[i] + slope[i]))
                       + fvi_tangent_rho(o, a, n) * terms_along(o, a, j, place);
            }
            status = fvi_tangent_multiply(o, a, -1, y, source);
        }
        for (size_t c = 0; is_matrix && a->impulse_unit != 0 && c < o->d; c++) {
            fvi_tangent_past_along(o, a, k, j, c, at, slope, o->s, change);
            for (size_t i = 0; i < o->s; i++)
                fvi_tangent_source(o, j, i)[c] -= a->CA[c] * change[i] / (o->run->h * o->rule->b[i]);
        }
    }
    return status;
}

static int step_damper(fvi_tangent_run *o, size_t k, fvi_tangent_damper *a)
{
    if (!a->block)
        return FVI_SUCCESS;
    int status = find_velocities(o, a);
    if (!status && a->of_stages)
        status = find_sums(o, a);
    for (size_t n = 0; !status && n < a->r; n++)
        for (size_t l = 0; l < a->terms_of_stages.count; l++)
            fvi_stage_term_next(a->terms_of_stages.each + l, n, a->v + n * o->s);
    if (!status)
        status = add_forces(o, k, a);
    if (!status)
        status = fvi_stage_terms_update_history(&a->terms_of_stages, a->v);
    return status;
}

/* ---- a step ---- */

//> stages
/* A step of (24.12). The forces q_i on the derivatives come from the stages of the step that the run has just taken. */
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
        status = step_damper(o, k, o->each + j);
    for (size_t l = 0; !status && l < o->tangents; l++) {
        o->linearised[l].evaluated_stages = 0;
        status = fvi_stepper_step(o->tangent[l]);
    }
    return status;
}
//< stages
