/* src/adjoint/adjoint_dampers_start.c -- The adjoint run of several dampers: its start. [H 23, 27] */
#include "adjoint_dampers.h"

#include "kernel/kernel_terms.h"
#include "system/all_zero.h"
#include "system/arrays.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the start ---- */

static int allocate(fvi_adjoint_dampers *m)
{
    enum { OF_A_DAMPER = 7 };
    double *next;
    const size_t d = m->d;
    m->each = calloc(m->count, sizeof *m->each);
    m->held = calloc(m->count, sizeof *m->held);
    m->block = FVI_ARRAYS({ &m->Jp, d }, { &m->v0, d }, { &m->right, d }, { &m->by_start, d }, { &m->z, d },
                          { &m->work, d }, { &m->column, d }, { &m->moved, d }, { &m->zeros, d }, { &m->jump, d },
                          { &m->multipliers.nu, d }, { &m->multipliers.behind, d }, { &m->multipliers.mean, d },
                          { &m->multipliers.change, d }, { &m->history_input, 2 * d },
                          { &next, OF_A_DAMPER * m->count * d });
    if (!m->each || !m->held || !m->block)
        FVI_FAIL("no memory for the adjoint run", FVI_ENOMEM);
    for (size_t j = 0; j < m->count; j++, next += OF_A_DAMPER * d) {
        m->each[j].by_drift = next;
        m->each[j].impulse_sum = next + d;
        m->each[j].CJ = next + 2 * d;
        m->each[j].impulse_sum_by_order = next + 3 * d;
        m->each[j].CA = next + 4 * d;
        m->each[j].B = next + 5 * d;
        m->each[j].dB = next + 6 * d;
    }
    return FVI_SUCCESS;
}

/* Start the adjoint run at node N, at rest at J_p; all its dampers have the past HELD. */
static int start_stepper(fvi_adjoint_dampers *m, const fvi_method *method)
{
    fvi_run back = *m->run;
    const fvi_system *system = m->run->system;
    for (size_t j = 0; j < m->count; j++) {
        m->held[j] = system->mechanism->damper[j];
        m->held[j].past = FVI_INITIAL_HISTORY_HELD;
    }
    m->mechanism = (fvi_mechanism){ .damper_count = m->count, .damper = m->held };
    m->linearised = fvi_linearised_begin(system, 1);
    m->linearised.from_zero = m->paper_convention;
    m->linearised.by_order = m->want->orders != NULL;
    m->system = fvi_linearised_system(system, &m->linearised);
    m->system.mechanism = &m->mechanism;
    back.system = &m->system;
    back.x0 = m->Jp;
    back.p0 = m->work; /* zeros */
    back.kappa = 1 - m->kappa;
    return fvi_stepper_start(method, &back, &m->stepper, NULL);
}

/* Prepare the impulses of the past for an amplitude of 1. */
static int start_impulses(const fvi_adjoint_dampers *m, fvi_adjoint_damper *a)
{
    static const double ends[] = { 0, 1 };
    if (m->paper_convention || !fvi_initial_history_acts(a->of.past, a->of.growth / 2))
        return FVI_SUCCESS;
    return fvi_initial_history_force_prepare(&a->of, m->run->h, 2, ends, &a->history_force,
                                             &a->impulse_unit);
}

/* Return nonzero if the derivative by the order is read from the history of the adjoint run. A law has histories of its
 * own for it. */
static int is_by_order(const fvi_adjoint_dampers *m, const fvi_adjoint_damper *a)
{
    return m->want->orders && !a->of.law;
}

/* Start the history of the constant J_p, which a history held at J_p leaves out, (23.23). */
static int start_constant(const fvi_adjoint_dampers *m, const fvi_method *method,
                          fvi_adjoint_damper *a)
{
    if (m->paper_convention || fvi_all_zero(m->d, m->Jp))
        return FVI_SUCCESS;
    const int status = fvi_constant_history_start(method, m->run, &a->of, 1, is_by_order(m, a),
                                                  &a->constant);
    return status ? status
                  : fvi_damping_multiply(&a->of.matrix, m->d, 1, m->Jp, a->CJ);
}

static int start_damper(fvi_adjoint_dampers *m, const fvi_method *method, size_t j)
{
    fvi_adjoint_damper *a = m->each + j;
    a->of = fvi_run_damper_of(m->run, j);
    a->first = j > 0 ? a[-1].first + m->run->system->mechanism->damper[j - 1].kernel->count : 0;
    a->damping = fvi_damping_of(m->stepper);
    while (a->damping && a->damping->number != j)
        a->damping = a->damping->next;
    if (!a->damping)
        return FVI_SUCCESS;
    a->unit = a->of.law ? a->damping->unit : pow(m->run->h, 1 - 2 * a->of.alpha);
    a->theta = method->scheme == FVI_SCHEME_CQ2_SHIFTED    ? a->of.growth / 2
               : method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5
                                                           : 0;
    a->has_drift = a->of.growth > 1
                   && (a->of.past == FVI_INITIAL_HISTORY_CAPUTO || !m->paper_convention);
    int status = start_impulses(m, a);
    if (!status)
        status = start_constant(m, method, a);
    if (!status && m->has_jumps)
        status = fvi_constant_history_start(method, m->run, &a->of, a->of.matrix.history_size,
                                            is_by_order(m, a), &a->jumped);
    return status || !m->by_numbers ? status
                                    : fvi_adjoint_dampers_numbers_start(m, method, a);
}

int fvi_adjoint_dampers_start(const fvi_method *method, const fvi_run *run,
                              const fvi_sensitivities *want, int has_jumps,
                              const double *rows, const double *Jp, fvi_adjoint_dampers *m)
{
    *m = (fvi_adjoint_dampers){ .run = run,
                                .want = want,
                                .has_jumps = has_jumps,
                                .d = run->system->d,
                                .count = run->system->mechanism->damper_count,
                                .paper_convention = method->scheme == FVI_SCHEME_FVI,
                                .is_shifted = method->scheme == FVI_SCHEME_CQ2_SHIFTED,
                                .by_numbers = fvi_wanted_kernel_numbers(want),
                                .kappa = method->takes_kappa ? run->kappa : 0.5 };
    m->multipliers = (fvi_adjoint_multipliers){
        .d = m->d,
        .is_first_order = m->paper_convention,
        .is_mean = method->scheme == FVI_SCHEME_CQ2_MIDPOINT,
        .theta = method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? 0.5 : 0
    };
    int status = allocate(m);
    if (status)
        return status;
    memcpy(m->Jp, Jp, m->d * sizeof *Jp);
    status = start_stepper(m, method);
    if (!status)
        status = fvi_divide_by_mass(run->system, run->p0, m->v0);
    for (size_t j = 0; !status && j < m->count; j++) {
        status = start_damper(m, method, j);
        if (!status && m->paper_convention && m->each[j].damping)
            status = fvi_adjoint_dampers_first_sums(m, m->each + j, rows + m->d);
    }
    return status;
}

void fvi_adjoint_dampers_free(fvi_adjoint_dampers *m)
{
    fvi_stepper_free(m->stepper);
    for (size_t j = 0; m->each && j < m->count; j++) {
        fvi_constant_history_stop(&m->each[j].constant);
        fvi_constant_history_stop(&m->each[j].jumped);
        fvi_initial_history_force_stop(&m->each[j].history_force);
        fvi_adjoint_dampers_numbers_stop(m->each + j);
    }
    free(m->each);
    free(m->held);
    free(m->block);
}
