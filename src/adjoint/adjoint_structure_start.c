/* src/adjoint/adjoint_structure_start.c -- The adjoint run of a structure with stages: its checks and its start. [H 23,
 * 27] */
#include "adjoint_structure.h"

#include "held_dampers.h"
#include "methods/lobatto_stages.h"
#include "parameter_derivatives/wanted_check.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <stdlib.h>
#include <string.h>

/* ---- which derivatives are known ---- */

int fvi_adjoint_structure_check(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want)
{
    int status = run->system->mechanism ? fvi_wanted_check_dampers(method, run, want) : FVI_SUCCESS;
    if (!status && want->mass && !run->system->matrices->inertia)
        FVI_FAIL("no derivative by a factor of M without its products", FVI_EUNSUP);
    return status ? status : fvi_wanted_check_stage_laws(run, want);
}

/* ---- the start ---- */

static int allocate(fvi_adjoint_structure *m)
{
    const size_t d = m->d;
    enum { OF_A_DAMPER = 3 };
    double *next;
    m->each = calloc(m->count + 1, sizeof *m->each);
    m->held = calloc(m->count + 1, sizeof *m->held);
    m->block = FVI_ARRAYS({ &m->v0, d }, { &m->lambda_after, d }, { &m->zeros, d }, { &m->product, d }, { &m->room, d },
                          { &m->y, d }, { &m->v, m->s * d }, { &next, OF_A_DAMPER * m->count * d });
    if (!m->each || !m->held || !m->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    for (size_t j = 0; j < m->count; j++, next += OF_A_DAMPER * d) {
        m->each[j].force_sum = next;
        m->each[j].impulse_sum = next + d;
        m->each[j].impulse_sum_by_order = next + 2 * d;
    }
    return FVI_SUCCESS;
}

/* Start the adjoint run at node N, with the velocity J_p. No history gets this velocity. */
static int start_stepper(fvi_adjoint_structure *m, const fvi_method *method, const double *Jp)
{
    const fvi_system *system = m->run->system;
    fvi_run back = *m->run;
    m->linearised = fvi_linearised_begin(system, m->s);
    m->linearised.is_dual = 1;
    m->linearised.by_order = m->by_order;
    m->system = fvi_linearised_system(system, &m->linearised);
    fvi_hold_dampers(system, m->held, &m->mechanism, &m->system);
    back.system = &m->system;
    back.x0 = back.p0 = m->zeros;
    back.past = FVI_INITIAL_HISTORY_HELD;
    const int status = fvi_stepper_start(method, &back, &m->stepper, NULL);
    if (status)
        return status;
    m->state = fvi_lobatto_matrices_of(m->stepper);
    memcpy(m->state->v, Jp, m->d * sizeof *Jp);
    return FVI_SUCCESS;
}

/* Prepare the derivatives by the numbers of the kernel of a damper. The kernel of alpha is one power. */
static int start_numbers(fvi_adjoint_structure *m, fvi_adjoint_structure_damper *a, size_t j)
{
    const fvi_run *run = m->run;
    const fvi_mechanism *mechanism = run->system->mechanism;
    a->power = (fvi_kernel_term){ FVI_KERNEL_POWER, 1, run->alpha, 0, 0 };
    a->kernel = mechanism ? *mechanism->damper[j].kernel : run->law ? *run->law : (fvi_kernel){ 1, &a->power };
    if (!m->by_numbers)
        return FVI_SUCCESS;
    a->by_number[0] = calloc(FVI_NUMBERS_OF_TERM * a->kernel.count, sizeof *a->by_number[0]);
    if (!a->by_number[0])
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    for (size_t i = 1; i < FVI_NUMBERS_OF_TERM; i++)
        a->by_number[i] = a->by_number[0] + i * a->kernel.count;
    const fvi_sensitivities want = { .terms = m->want->terms,
                                     .orders = m->want->alpha ? m->want->alpha : m->want->orders,
                                     .times = m->want->times,
                                     .ends = m->want->ends };
    return a->adjoint && !a->adjoint->Ydot
               ? fvi_stage_terms_start(run, &want, m->s, a->adjoint->r, fvi_stage_dampers_tolerance(run), &a->kernel,
                                       &a->terms)
               : FVI_SUCCESS;
}

static int start_damper(fvi_adjoint_structure *m, size_t j)
{
    fvi_adjoint_structure_damper *a = m->each + j;
    a->of = fvi_run_damper_of(m->run, j);
    for (size_t i = 0; i < m->state->dampers; i++)
        if (m->state->each[i].number == j)
            a->adjoint = m->state->each + i;
    const int is_mass = a->of.law && a->of.growth == 2;
    a->has_line = a->of.growth > 1 && !is_mass;
    int status = start_numbers(m, a, j);
    return status || is_mass || !fvi_initial_history_acts(a->of.past, a->of.growth / 2)
               ? status
               : fvi_initial_history_force_prepare(&a->of, m->run->h, m->s, m->rule->c, &a->history_force,
                                                   &a->impulse_unit);
}

int fvi_adjoint_structure_start(const fvi_method *method, const fvi_run *run,
                                const fvi_sensitivities *want, const double *Jp,
                                fvi_adjoint_structure *m)
{
    const size_t s = (size_t)method->stages;
    *m = (fvi_adjoint_structure){ .run = run,
                                  .want = want,
                                  .rule = fvi_lobatto(s),
                                  .s = s,
                                  .d = run->system->d,
                                  .count = fvi_run_damper_count(run),
                                  .by_order = want->orders || want->alpha,
                                  .by_numbers = fvi_wanted_kernel_numbers(want) || want->alpha };
    int status = allocate(m);
    fvi_lobatto_table(m->rule, s, m->A);
    if (!status)
        status = fvi_divide_by_mass(run->system, run->p0, m->v0);
    if (!status)
        status = start_stepper(m, method, Jp);
    for (size_t j = 0; !status && j < m->count; j++)
        status = start_damper(m, j);
    return status;
}

void fvi_adjoint_structure_free(fvi_adjoint_structure *m)
{
    fvi_stepper_free(m->stepper);
    for (size_t j = 0; m->each && j < m->count; j++) {
        fvi_stage_terms_stop(&m->each[j].terms);
        fvi_initial_history_force_stop(&m->each[j].history_force);
        free(m->each[j].by_number[0]);
    }
    free(m->each);
    free(m->held);
    free(m->block);
}
