/* src/methods/damping.c -- The damped coordinates of a run and their histories.    [H 9] */
#include "damping.h"

#include "memory/history_kinds.h"
#include "shifted_kernel.h"
#include "memory/history_parts.h"
#include "system/archive_pieces.h"
#include "system/arrays.h"
#include "system/fail.h"
#include "newton/linearised.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- allocation ---- */

void fvi_damping_free(fvi_damping *d)
{
    while (d) {
        fvi_damping *next = d->next;
        fvi_history_free(d->memory);
        free(d->index);
        free(d->factor);
        free(d->H);
        free(d->impulse_sums);
        free(d);
        d = next;
    }
}

/* Allocate a damper with zeros for `count` coordinates. */
static int damping_alloc(const fvi_system *system, const fvi_run_damper *of, size_t count,
                         fvi_damping **damping)
{
    fvi_damping *d = *damping = calloc(1, sizeof *d);
    if (!d)
        FVI_FAIL("no memory for the damping", FVI_ENOMEM);
    d->system = system;
    d->of = *of;
    d->count = count;
    d->covers_all = count == system->d && !system->matrices;
    d->index = malloc((system->matrices ? 1 : count) * sizeof *d->index);
    d->factor = FVI_ARRAYS({ &d->factor, count }, { &d->origin, count }, { &d->drift, count }, { &d->z, count },
                           { &d->dz, count });
    if (!d->index || !d->factor)
        FVI_FAIL("no memory for the damping", FVI_ENOMEM);
    return FVI_SUCCESS;
}

fvi_delta fvi_damping_quadrature(const fvi_method *method)
{
    return method->scheme == FVI_SCHEME_CQ2_MIDPOINT ? FVI_DELTA_BDF2
                                               : method->quadrature;
}

/* Allocate the history of the damper, with derivatives by the order if d->Hdot is not NULL. The first weight of a law
 * is multiplied into the factors. */
static int alloc_history(const fvi_stepper *s, fvi_damping *d)
{
    const fvi_run *run = &s->run;
    fvi_run_damper of = d->of;
    double first;
    fvi_shifted_kernel shifted = { of.law, run->h, of.growth / 2 };
    const fvi_kernel_function function = { { FVI_KERNEL_SYMBOL, 1, 0, 0, 0 },
                                           fvi_shifted_symbol,
                                           &shifted };
    fvi_kernel corrected;
    if (s->method->scheme == FVI_SCHEME_CQ2_SHIFTED && !fvi_shifted_is_itself(of.law)) {
        corrected = fvi_kernel_of_function(&function);
        of.law = &corrected;
    }
    const int status = fvi_run_damper_history(&of, run, fvi_damping_quadrature(s->method),
                                              d->Hdot != NULL, d->count, &first,
                                              &d->memory);
    for (size_t j = 0; j < d->count; j++)
        d->factor[j] *= first;
    d->unit *= first;
    return status;
}

/* ---- all coordinates and damped coordinates ---- */

static void subtract(size_t n, const double *x, const double *from, double *z)
{
#pragma omp simd
    for (size_t j = 0; j < n; j++)
        z[j] = x[j] - from[j];
}

int fvi_damping_gather(const fvi_damping *d, const double *x,
                       const double *from, double *z)
{
    const fvi_damping_matrix *m = &d->of.matrix;
    if (m->select_history)
        return m->select_history(d->system->d, x, from, m->params, z);
    if (d->covers_all)
        subtract(d->count, x, from, z);
    for (size_t j = 0; j < d->count && !d->covers_all; j++)
        z[j] = x[d->index[j]] - from[j];
    return FVI_SUCCESS;
}

int fvi_damping_set_terms(fvi_damping *d, const fvi_stepper *s)
{
    const int status = fvi_damping_gather(d, s->x, d->origin, d->z);
    return status || !d->sums_increments ? status : fvi_damping_gather(d, s->dx, d->drift, d->dz);
}

int fvi_damping_update_history(fvi_damping *d, double *H)
{
    if (!d->H)
        return fvi_history_push(d->memory, d->z, d->dz, H);
    const int status =
        d->Hdot ? fvi_history_push_by_order(d->memory, d->z, d->dz, d->H, d->Hdot)
                : fvi_history_push(d->memory, d->z, d->dz, d->H);
    memcpy(H, d->H, d->count * sizeof *H);
    return status;
}

int fvi_damping_apply_force(const fvi_damping *d, double share, const double *H,
                     double *p)
{
    const fvi_damping_matrix *m = &d->of.matrix;
    if (d->covers_all) {
#pragma omp simd
        for (size_t j = 0; j < d->count; j++)
            p[j] -= share * d->factor[j] * H[j];
        return FVI_SUCCESS;
    }
    if (m->apply_damping)
        return m->apply_damping(d->system->d, share * d->factor[0], H, m->params, p);
    for (size_t j = 0; j < d->count; j++)
        p[d->index[j]] -= share * d->factor[j] * H[j];
    return FVI_SUCCESS;
}

/* ---- start ---- */

/* Return the number of history numbers of the damper. */
static size_t count_history_numbers(const fvi_system *system, const fvi_run_damper *of)
{
    const fvi_linearised *linearised = fvi_linearised_of(system);
    size_t count = 0;
    if (system->matrices)
        return of->matrix.history_size;
    if (linearised && linearised->history_includes_undamped)
        return system->d;
    for (size_t i = 0; i < system->d; i++)
        count += system->damping[i] > 0;
    return count;
}

static void begin(const fvi_stepper *s, fvi_initial_history past, fvi_damping *d)
{
    const fvi_run *run = &s->run;
    const fvi_system *system = run->system;
    d->count = 0;
    //> start
    for (size_t i = 0; i < system->d; i++) {
        if (!d->covers_all && system->damping[i] == 0)
            continue;
        size_t j = d->count++;
        d->index[j] = i;
        d->factor[j] = system->damping[i] * d->unit;
        if (past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
            d->origin[j] = s->x[i]; /* (9.6) */
        if (past == FVI_INITIAL_HISTORY_CAPUTO && d->of.growth > 1)
            d->drift[j] = run->h * s->p[i] / system->mass[i];
        d->z[j] = d->dz[j] = s->x[i] - d->origin[j]; /* the term k = 0 */
    }
    //< start
}

/* Allocate the arrays for the sums, which the adjoint and the tangent of a run read. */
static int allocate_sums(fvi_damping *d, int by_order)
{
    d->H = calloc(2 * d->count, sizeof *d->H);
    if (!d->H)
        FVI_FAIL("no memory for the damping", FVI_ENOMEM);
    d->Hdot = by_order ? d->H + d->count : NULL;
    return FVI_SUCCESS;
}

/* Allocate the history of one damper and push its first term. */
static int start_one(const fvi_stepper *s, fvi_initial_history past, fvi_damping *d)
{
    const fvi_run *run = &s->run;
    const fvi_linearised *linearised = fvi_linearised_of(run->system);
    int status = FVI_SUCCESS;
    d->unit = d->of.rho * pow(run->h, 1 - 2 * d->of.alpha);
    if (linearised)
        status = allocate_sums(d, linearised->by_order && !d->of.law);
    if (status)
        return status;
    if (run->system->matrices)
        status = fvi_damping_begin_matrices(s, past, d);
    else
        begin(s, past, d);
    if (status)
        return status;
    status = alloc_history(s, d);
    d->sums_increments = !status && fvi_history_sums_increments(d->memory);
    return status ? status : fvi_damping_update_history(d, d->dz);
}

int fvi_damping_start(const fvi_stepper *s, int is_caputo, fvi_damping **damping)
{
    const fvi_run *run = &s->run;
    const fvi_linearised *linearised = fvi_linearised_of(run->system);
    int status = FVI_SUCCESS;
    *damping = NULL;
    for (size_t j = 0; !status && j < fvi_run_damper_count(run); j++) {
        const fvi_run_damper of = fvi_run_damper_of(run, j);
        const size_t count = count_history_numbers(run->system, &of);
        const fvi_initial_history past =
            linearised && linearised->from_zero ? FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
            : is_caputo                         ? FVI_INITIAL_HISTORY_CAPUTO
                                                : of.past;
        if (count == 0) /* without damping there is no history */
            continue;
        status = damping_alloc(run->system, &of, count, damping);
        if (!status)
            status = start_one(s, past, *damping);
        if (!*damping)
            break;
        (*damping)->number = j;
        damping = &(*damping)->next;
    }
    return status;
}

static int copy_sums(const fvi_damping *from, fvi_damping *to)
{
    const size_t d = from->system->d;
    to->impulse_sums = malloc(3 * d * sizeof *to->impulse_sums);
    if (!to->impulse_sums)
        FVI_FAIL("no memory for the sums of the dampers", FVI_ENOMEM);
    memcpy(to->impulse_sums, from->impulse_sums, 3 * d * sizeof *to->impulse_sums);
    to->work = from->work;
    return FVI_SUCCESS;
}

int fvi_damping_copy(const fvi_damping *from, fvi_damping **to)
{
    *to = NULL;
    for (; from; from = from->next, to = &(*to)->next) {
        int status = damping_alloc(from->system, &from->of, from->count, to);
        if (status)
            return status;
        (*to)->sums_increments = from->sums_increments;
        (*to)->number = from->number;
        if (from->impulse_sums)
            status = copy_sums(from, *to);
        if (status)
            return status;
        if (!from->system->matrices)
            memcpy((*to)->index, from->index, from->count * sizeof *from->index);
        memcpy((*to)->factor, from->factor,
               5 * from->count * sizeof *from->factor);
        status = fvi_history_copy(from->memory, &(*to)->memory);
        if (status)
            return status;
    }
    return FVI_SUCCESS;
}

/* z and dz belong to one step only, so they are not archived. The history has one term from the start
 * and one from each step. */
int fvi_damping_archive(fvi_damping *d, size_t k, fvi_archive *v)
{
    int status = FVI_SUCCESS;
    for (; d && !status; d = d->next) {
        status = fvi_history_archive(d->memory, v);
        if (!status)
            status = fvi_check_count(fvi_history_terms(d->memory), k + 1);
        if (!status && d->impulse_sums)
            status = FVI_SERIALIZE(v, FVI_STATES(d->impulse_sums, d->system->d), FVI_STATE(d->work));
    }
    return status;
}
