/* src/run/run_damper.c -- The dampers of a run, as the methods see them. [H 9, 26, 27] */
#include "run_damper.h"

#include "kernel/kernel_terms.h"
#include "system/fail.h"

#include <math.h>

/* ---- which dampers a run has ---- */

size_t fvi_run_damper_count(const fvi_run *run)
{
    const fvi_mechanism *mechanism = run->system->mechanism;
    return mechanism ? mechanism->damper_count : 1;
}

static fvi_run_damper damper_of_power(double rho, double alpha)
{
    return (fvi_run_damper){ .alpha = alpha, .rho = rho, .growth = 2 * alpha };
}

static fvi_run_damper damper_of_kernel(const fvi_kernel *law)
{
    return (fvi_run_damper){ .law = law, .rho = 1, .growth = fvi_kernel_growth(law) };
}

fvi_run_damper fvi_run_damper_of(const fvi_run *run, size_t j)
{
    const fvi_system *system = run->system;
    const fvi_matrices *m = system->matrices;
    const int of_mechanism = system->mechanism && j < system->mechanism->damper_count;
    fvi_run_damper damper = run->law ? damper_of_kernel(run->law) : damper_of_power(1, run->alpha);
    damper.past = run->past;
    if (of_mechanism) {
        const fvi_damper *of = system->mechanism->damper + j;
        const fvi_kernel_term *term = of->kernel->term;
        damper = fvi_kernel_is_power(of->kernel)
                     ? damper_of_power(term->rho, term->alpha)
                     : damper_of_kernel(of->kernel);
        damper.past = of->past;
    }
    if (m)
        damper.matrix = of_mechanism ? m->damper[j] : m->damping;
    return damper;
}

fvi_run fvi_run_normal(const fvi_method *method, const fvi_run *run)
{
    fvi_run normal = *run;
    if (!run->law)
        return normal;
    normal.past = FVI_INITIAL_HISTORY_HELD;
    normal.alpha = method->dense ? 0.25 : 0;
    return normal;
}

static int is_same_term(const fvi_kernel_term *a, const fvi_kernel_term *b)
{
    if (a->kind == FVI_KERNEL_SYMBOL || b->kind == FVI_KERNEL_SYMBOL)
        return a == b;
    return a->kind == b->kind && a->rho == b->rho && a->alpha == b->alpha && a->time == b->time
           && a->end == b->end;
}

int fvi_is_same_law(const fvi_kernel *a, const fvi_kernel *b)
{
    if (a == b)
        return 1;
    if (!a || !b || a->count != b->count)
        return 0;
    for (size_t i = 0; i < a->count; i++)
        if (!is_same_term(a->term + i, b->term + i))
            return 0;
    return 1;
}

/* ---- the functions of a damper ---- */

int fvi_run_damper_stages(const fvi_run_damper *damper, size_t d, size_t s, const double *force, double *load)
{
    const fvi_damping_matrix *C = &damper->matrix;
    int status = FVI_SUCCESS;
    if (C->apply_damping_to_stages)
        return C->apply_damping_to_stages(d, s, 1, force, C->params, load);
    for (size_t i = 0; !status && i < s; i++)
        status = C->apply_damping(d, 1, force + i * C->history_size, C->params, load + i * d);
    return status;
}

double fvi_run_damper_symbol(const fvi_run_damper *damper, double s)
{
    return damper->law ? fvi_kernel_symbol(damper->law, s)
                       : damper->rho * pow(s, 2 * damper->alpha);
}

int fvi_run_damper_history(const fvi_run_damper *damper, const fvi_run *run, fvi_delta kind,
                           int by_order, size_t d, double *first, fvi_history **memory)
{
    *first = 1;
    if (damper->law)
        return fvi_kernel_history(damper->law, kind, run->h, d, run->steps, run->memory,
                                  run->tolerance, first, memory);
    return (by_order ? fvi_history_alloc_by_order : fvi_history_alloc)(
        2 * damper->alpha, d, run->steps, run->memory, run->tolerance, memory);
}

int fvi_run_damper_name_refused(const fvi_run *run, size_t j, int status, fvi_error *error)
{
    const char *reason = run->memory == FVI_HISTORY_MODES
                             ? "its law is no sum of exponentials with this step; the memory auto sums it all"
                             : "the tail of its law is no sum of decaying modes; fvi and fvi-stable take it";
    return status != FVI_EUNSUP ? status
                                : fvi_at_index(error, j, fvi_fail(error, status, "damper", (double)j + 1,
                                                                  "damper %zu: %s", j + 1, reason));
}

double fvi_run_damper_bytes_order(const fvi_run_damper *damper)
{
    return damper->law ? 0.5 : 2 * damper->alpha;
}
