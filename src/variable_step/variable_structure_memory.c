/* src/variable_step/variable_structure_memory.c -- The modes of the dampers of a structure. [H 27, 22] */
#include "variable_structure.h"

#include "system/arrays.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

/* Allocate the arrays of each damper in one piece. */
int fvi_structure_mesh_allocate(const fvi_stepper *s, fvi_variable_step_state *o)
{
    const size_t d = o->d, n = o->rule->s, count = fvi_run_damper_count(&s->run);
    struct fvi_mesh_structure *m = o->structure = calloc(1, sizeof *m);
    if (m)
        m->damper = calloc(count + 1, sizeof *m->damper);
    if (m)
        m->numbers = FVI_ARRAYS({ &m->Kx, d }, { &m->Kv, d }, { &m->last, d }, { &m->size, d }, { &m->ones, d },
                                { &m->load, n * d }, { &m->delta, n * d });
    if (!m || !m->damper || !m->numbers)
        FVI_FAIL("no memory for the structure", FVI_ENOMEM);
    for (size_t j = 0; j < d; j++)
        m->ones[j] = 1;
    for (size_t j = 0; j < count; j++) {
        const fvi_run_damper of = fvi_run_damper_of(&s->run, j);
        const size_t r = of.matrix.history_size;
        if (r == 0)
            continue;
        fvi_mesh_matrix *to = &m->damper[m->count++];
        *to = (fvi_mesh_matrix){ .of = of, .number = j, .r = r };
        if (!FVI_ARRAYS({ &to->before, r }, { &to->now, r }, { &to->centre, r }, { &to->z, r }, { &to->zero, r },
                        { &to->force, n * r }, { &to->slope, n * r }))
            FVI_FAIL("no memory for a damper", FVI_ENOMEM);
    }
    return FVI_SUCCESS;
}

/* A law has Riemann and Liouville's past only if nothing is stretched at the start (dampers_check.h), and then the past
 * of a held body is the same. */
int fvi_structure_mesh_starts_with_jump(const fvi_run_damper *of)
{
    return of->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE && !of->law && of->growth < 1;
}

static int begin_damper(fvi_stepper *s, fvi_variable_step_state *o, fvi_mesh_matrix *to)
{
    const fvi_kernel_term power = { FVI_KERNEL_POWER, to->of.rho, to->of.alpha, 0, 0 };
    const fvi_kernel alone = { 1, &power };
    const fvi_damping_matrix *C = &to->of.matrix;
    int status = C->select_history(o->d, s->x, to->zero, C->params, to->z);
    memcpy(to->centre, to->z, to->r * sizeof *to->z);
    if (!status)
        status = C->select_history(o->d, o->v, to->zero, C->params, to->now);
    if (!status)
        status = fvi_mesh_begin_damper(s, o, to->of.law ? to->of.law : &alone, to->r, to->number,
                                       &to->memory);
    if (status)
        return status;
    if (to->of.growth <= 1 || to->of.past == FVI_INITIAL_HISTORY_CAPUTO) /* otherwise the body was at rest */
        memcpy(to->before, to->now, to->r * sizeof *to->now);
    if (fvi_structure_mesh_starts_with_jump(&to->of)) { /* the position jumps at t = 0 */
        memset(to->centre, 0, to->r * sizeof *to->centre);
        fvi_mesh_stretch_damper(o, &to->memory, to->r, to->z);
    }
    return FVI_SUCCESS;
}

int fvi_structure_mesh_begin_dampers(fvi_stepper *s, fvi_variable_step_state *o)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->structure->count && !status; j++)
        status = begin_damper(s, o, &o->structure->damper[j]);
    return status;
}

/* ---- in a step ---- */

/* Return the rung of this length, or the rung that has not been used for the longest time. */
static size_t find_rung(const struct fvi_mesh_structure *m, double h)
{
    size_t oldest = 0;
    for (size_t i = 0; i < FVI_MESH_RUNGS; i++) {
        if (m->rung[i].solver && m->rung[i].h == h)
            return i;
        if (m->rung[i].used < m->rung[oldest].used)
            oldest = i;
    }
    return oldest;
}

int fvi_structure_mesh_solver(const fvi_stepper *s, fvi_variable_step_state *o, double h)
{
    struct fvi_mesh_structure *m = o->structure;
    const fvi_matrices *matrices = s->run.system->matrices;
    for (size_t j = 0; m->h != h && j < m->count; j++)
        fvi_mesh_present_damper(o, h, &m->damper[j].memory, m->damper[j].W);
    m->h = h;
    const size_t i = find_rung(m, h);
    int status = FVI_SUCCESS;
    if (!m->rung[i].solver || m->rung[i].h != h) {
        const double **W = calloc(matrices->damper_count + 1, sizeof *W);
        if (!W)
            FVI_FAIL("no memory for the factors", FVI_ENOMEM);
        for (size_t j = 0; j < m->count; j++)
            W[m->damper[j].number] = m->damper[j].W;
        fvi_stage_solver_free(m->rung[i].solver);
        m->rung[i].solver = NULL;
        status = fvi_stage_solver_alloc(matrices, o->d, o->rule->s, h, W, FVI_STAGE_PAIRS, &m->rung[i].solver);
        free(W);
    }
    m->rung[i].h = h;
    m->rung[i].used = ++m->uses;
    m->solver = m->rung[i].solver;
    return status;
}

/* Compute the known part of the force of a damper: its modes, the present part of a constant velocity, and the force of
 * a spring at its position. */
static int predict_damper(fvi_variable_step_state *o, fvi_mesh_matrix *to)
{
    const fvi_damping_matrix *C = &to->of.matrix;
    const size_t s = o->rule->s, r = to->r;
    const double factor = to->memory.rho * pow(o->length.h, -to->memory.beta);
    int status = FVI_SUCCESS;
    if (to->memory.beta == -1)
        status = C->select_history(o->d, o->y, to->centre, C->params, to->z);
    for (size_t i = 0; i < s; i++) {
        double present = 0;
        for (size_t c = 0; c < s; c++)
            present += to->W[i * s + c];
        for (size_t n = 0; n < r; n++)
            to->force[i * r + n] =
                present * to->now[n]
                - (to->memory.W1[i] != 0 ? factor * to->memory.W1[i] * to->before[n] : 0)
                + (to->memory.beta == -1 ? to->memory.rho * to->z[n] : 0);
    }
    fvi_mesh_add_history(&to->memory, o->length, s, r, to->force);
    return status ? status : fvi_run_damper_stages(&to->of, o->d, s, to->force, o->structure->load);
}

int fvi_structure_mesh_predict(fvi_variable_step_state *o)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->structure->count && !status; j++)
        status = predict_damper(o, &o->structure->damper[j]);
    return status;
}

int fvi_structure_mesh_leak(fvi_variable_step_state *o, const double *last, double *size)
{
    struct fvi_mesh_structure *m = o->structure;
    int status = FVI_SUCCESS, any = 0;
    memset(m->Kv, 0, o->d * sizeof *m->Kv);
    for (size_t j = 0; j < m->count && !status; j++) {
        const fvi_mesh_matrix *of = &m->damper[j];
        const fvi_damping_matrix *C = &of->of.matrix;
        const double factor =
            of->memory.leakage * of->memory.rho * pow(o->length.h, -of->memory.beta);
        if (factor == 0)
            continue;
        any = 1;
        status = C->select_history(o->d, last, of->zero, C->params, of->z);
        if (!status)
            status = C->apply_damping(o->d, factor, of->z, C->params, m->Kv);
    }
    if (any && !status)
        return fvi_stage_solver_filter(m->solver, m->Kv, size);
    memset(size, 0, o->d * sizeof *size);
    return status;
}

/* ---- the step is taken ---- */

static int advance_damper(fvi_variable_step_state *o, fvi_mesh_matrix *of)
{
    const fvi_damping_matrix *C = &of->of.matrix;
    const size_t s = o->rule->s, r = of->r;
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < s && !status; i++)
        status = C->select_history(o->d, o->structure->delta + i * o->d, of->zero, C->params,
                                   of->slope + i * r);
    for (size_t n = 0; n < r && !status; n++) {
        double v[FVI_LANES] = { 0 };
        for (size_t i = 0; i < s; i++)
            v[i] = of->now[n] + of->slope[i * r + n];
        fvi_mesh_advance_damper(&of->memory, n, s, v, &of->before[n]);
        of->now[n] = v[s - 1];
    }
    return status;
}

int fvi_structure_mesh_advance(fvi_variable_step_state *o)
{
    int status = FVI_SUCCESS;
    for (size_t j = 0; j < o->structure->count && !status; j++)
        status = advance_damper(o, &o->structure->damper[j]);
    return status;
}
