/* src/methods/initial_history_force.c -- The force of the initial history in a run.  [H 19] */
#include "initial_history_force.h"

#include "system/all_zero.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_initial_history_force_prepare(const fvi_run_damper *damper, double h, size_t n,
                                      const double *c, fvi_initial_history_force *force,
                                      double *unit)
{
    *unit = 1;
    if (damper->law)
        return n == 2 ? fvi_impulses_of_kernel_alloc(damper->law, h, &force->of_law)
                      : fvi_impulses_of_kernel_at_stages(damper->law, h, n, c, &force->of_law);
    fvi_kernel_impulse_prepare(damper->alpha, n, c, &force->initial_impulse);
    *unit = pow(h, 1 + force->initial_impulse.e); /* (19.3) */
    return FVI_SUCCESS;
}

/* Return the past of the damper. For a law it counts as held, because a law accepts another past only if the result is
 * the same (dampers_check.h). */
static fvi_initial_history past_of(const fvi_run_damper *damper)
{
    return damper->law ? FVI_INITIAL_HISTORY_HELD : damper->past;
}

/* Compute size = unit rho A, or unit rho C A with matrices. */
static int set_size(const fvi_system *system, const fvi_run_damper *damper, double unit,
                    const double *A, double *size)
{
    if (system->matrices)
        return fvi_damping_multiply(&damper->matrix, system->d, damper->rho * unit, A,
                                    size);
    for (size_t i = 0; i < system->d; i++)
        size[i] = system->damping[i] * A[i] * unit;
    return FVI_SUCCESS;
}

/* Prepare the force. A matrix may be distributed over several processes, and all of them must take part in the
 * product with C. So before the product the function returns only for reasons that are the same in all
 * processes; A = 0 is none. To prepare the impulses of a law takes time, so this is done after the product, and
 * only if this process needs them. */
static int start(const fvi_stepper *s, const fvi_run_damper *damper, size_t n,
                 const double *c, double *A, fvi_initial_history_force *force)
{
    const fvi_system *system = s->run.system;
    double unit = 1;
    if (!fvi_initial_history_acts(past_of(damper), damper->growth / 2))
        return FVI_SUCCESS;
    int status = fvi_initial_history_amplitudes(system, damper, s->x, s->p, A);
    if (status || (!system->matrices && fvi_all_zero(system->d, A)))
        return status;
    force->size = calloc(system->d, sizeof *force->size);
    if (!force->size)
        return FVI_ENOMEM;
    if (!damper->law)
        status = fvi_initial_history_force_prepare(damper, s->run.h, n, c, force, &unit);
    if (!status)
        status = set_size(system, damper, unit, A, force->size);
    if (!status && fvi_all_zero(system->d, force->size))
        fvi_initial_history_force_stop(force);
    else if (!status && damper->law)
        status = fvi_initial_history_force_prepare(damper, s->run.h, n, c, force, &unit);
    return status;
}

int fvi_initial_history_force_start(const fvi_stepper *s, const fvi_run_damper *damper,
                                    size_t n, const double *c,
                                    fvi_initial_history_force *force)
{
    *force = (fvi_initial_history_force){ 0 };
    double *A = calloc(s->run.system->d, sizeof *A);
    const int status = A ? start(s, damper, n, c, A, force) : FVI_ENOMEM;
    free(A);
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the past", FVI_ENOMEM);
    return status;
}

int fvi_initial_history_amplitudes(const fvi_system *system,
                                   const fvi_run_damper *damper, const double *x0,
                                   const double *p0, double *A)
{
    int status = FVI_SUCCESS;
    if (damper->growth > 1) /* otherwise the velocity is not used */
        status = fvi_divide_by_mass(system, p0, A);
    for (size_t i = 0; !status && i < system->d; i++)
        A[i] = fvi_initial_history_amplitude(past_of(damper), damper->growth / 2,
                                             x0[i], A[i]);
    return status;
}

void fvi_initial_history_force_impulses(const fvi_initial_history_force *force, size_t k,
                                        double *impulse)
{
    if (force->of_law)
        fvi_impulses_of_kernel_at(force->of_law, k, impulse);
    else
        fvi_kernel_impulses(&force->initial_impulse, k, impulse);
}

int fvi_initial_history_force_copy(const fvi_initial_history_force *from, size_t d,
                                   fvi_initial_history_force *to)
{
    *to = (fvi_initial_history_force){ .initial_impulse = from->initial_impulse };
    if (!from->size)
        return FVI_SUCCESS;
    to->size = malloc(d * sizeof *to->size);
    if (!to->size)
        FVI_FAIL("no memory for the past", FVI_ENOMEM);
    memcpy(to->size, from->size, d * sizeof *to->size);
    return from->of_law ? fvi_impulses_of_kernel_copy(from->of_law, &to->of_law)
                        : FVI_SUCCESS;
}

void fvi_initial_history_force_stop(fvi_initial_history_force *force)
{
    if (force->of_law) /* the live page has no laws and does not link this function */
        fvi_impulses_of_kernel_free(force->of_law);
    free(force->size);
    force->of_law = NULL;
    force->size = NULL;
}
