/* src/methods/lobatto_matrices_start.c -- Start a run with stages for a system with matrices.  [H 27] */
#include "lobatto_matrices.h"

#include "system/arrays.h"
#include "system/fail.h"

#include <stdlib.h>
#include <string.h>

static void stop(fvi_stepper *s)
{
    fvi_lobatto_matrices *o = s->method_state;
    if (!o)
        return;
    fvi_stage_solver_free(o->solver);
    fvi_stage_dampers_stop(o);
    fvi_step_map_stop(&o->map);
    free(o->numbers);
    free(o);
}

/* ---- the solver ---- */

static int make_solver(fvi_stepper *s, fvi_lobatto_matrices *o)
{
    const fvi_matrices *m = s->run.system->matrices;
    const double **W = calloc(m->damper_count + 1, sizeof *W);
    if (!W)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    for (size_t j = 0; j < o->dampers; j++)
        W[o->each[j].number] = o->each[j].W;
    const int status = fvi_stage_solver_alloc(m, o->d, o->s, s->run.h, W, FVI_STAGE_AUTO, &o->solver);
    free(W);
    return status;
}

/* ---- the state ---- */

static int copy(const fvi_stepper *from, fvi_stepper *to);
static int serialize(fvi_stepper *s, fvi_archive *v);

/* Return the number of doubles that a copy and an archive need. A step reads v and p of the step before; V and F are
 * read after the step. */
static size_t count_saved_numbers(const fvi_lobatto_matrices *o)
{
    return (2 + 2 * o->s) * o->d;
}

/* Allocate a state. The stepper gets a copy of its method with these steps. */
static int make_state(fvi_stepper *s, size_t stages)
{
    const size_t d = s->run.system->d;
    fvi_lobatto_matrices *o = s->method_state = calloc(1, sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    o->method = *s->method;
    o->method.step = fvi_lobatto_matrices_step;
    o->method.copy = copy;
    o->method.serialize = serialize;
    o->method.stop = stop;
    o->method.damper = fvi_stage_dampers_told;
    o->method.keep_dampers = fvi_stage_dampers_keep;
    s->method = &o->method;
    o->rule = fvi_lobatto(stages);
    o->s = stages;
    o->d = d;
    o->numbers = FVI_ARRAYS({ &o->v, d }, { &o->p, d }, { &o->V, stages * d }, { &o->F, stages * d },
                            { &o->load, stages * d }, { &o->Kx, d }, { &o->Kv, d }, { &o->mean, d },
                            { &o->dv, d }, { &o->dp, d }, { &o->room, d });
    if (!o->numbers)
        FVI_FAIL("no memory for the stages", FVI_ENOMEM);
    return FVI_SUCCESS;
}

int fvi_lobatto_matrices_start(fvi_stepper *s, size_t stages)
{
    const fvi_matrices *m = s->run.system->matrices;
    if (!m->factorise_complex || !m->solve_complex || !m->free_complex_factors || !m->inertia)
        return fvi_fail(s->error, FVI_EUNSUP, "matrices", NAN,
                        "these matrices have no complex factors, or no product with M, which "
                        "methods with stages need");
    int status = make_state(s, stages);
    if (status)
        return status;
    fvi_lobatto_matrices *o = s->method_state;
    status = fvi_divide_by_mass(s->run.system, s->p, o->v);
    memcpy(o->p, s->p, o->d * sizeof *o->p);
    if (!status)
        status = fvi_stage_dampers_start(s, o->v);
    if (!status)
        status = make_solver(s, o);
    return status ? status : fvi_step_map_start(s, o);
}

fvi_lobatto_matrices *fvi_lobatto_matrices_of(const fvi_stepper *s)
{
    if (s->method->step != fvi_lobatto_matrices_step)
        return NULL;
    fvi_step_map_finish(s->method_state);
    return s->method_state;
}

int fvi_lobatto_matrices_has_initial_history_force(const fvi_stepper *s)
{
    const fvi_lobatto_matrices *o = s->method_state;
    for (size_t j = 0; j < o->dampers; j++)
        if (o->each[j].past.size)
            return 1;
    return 0;
}

/* Copy a run. The factors belong to one run, so they are computed again. */
static int copy(const fvi_stepper *from, fvi_stepper *to)
{
    const fvi_lobatto_matrices *old = fvi_lobatto_matrices_of(from);
    int status = make_state(to, old->s);
    if (status)
        return status;
    fvi_lobatto_matrices *o = to->method_state;
    memcpy(o->numbers, old->numbers, count_saved_numbers(o) * sizeof *o->numbers);
    status = fvi_stage_dampers_copy(from, to);
    if (!status)
        status = make_solver(to, o);
    return status ? status : fvi_step_map_copy(o->d, &old->map, &o->map);
}

static int serialize(fvi_stepper *s, fvi_archive *v)
{
    fvi_lobatto_matrices *o = fvi_lobatto_matrices_of(s);
    const int status = v->serialize(v, o->numbers, count_saved_numbers(o) * sizeof *o->numbers, 0);
    return status ? status : fvi_stage_dampers_serialize(s, v);
}
