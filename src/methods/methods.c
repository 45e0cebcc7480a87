/* src/methods/methods.c -- The table of the methods.  [H 2, 9, 13 and 17] */
#include <fvi/methods.h>

#include <fvi/convolution_quadrature_methods.h>
#include <fvi/discrete_mechanics.h>
#include <fvi/fvi.h>
#include <fvi/lobatto.h>
#include <fvi/variable_steps.h>

#include "damping.h"
#include "mechanism/mechanism.h"
#include "kernel/kernel_terms.h"
#include "stages/lobatto_history.h"
#include "system/lagrangian_point.h"

#include <string.h>

const fvi_method *const fvi_methods[] = {
    &fvi_fractional,     &fvi_lagrange_dalembert,
    &fvi_euler_explicit, &fvi_euler_implicit,
    &fvi_cq2_shifted,        &fvi_cq_bdf2,
    &fvi_lobatto_m2,       &fvi_lobatto_m3,
    &fvi_lobatto_m4,       &fvi_variable_step,
    &fvi_lobatto_m5,       &fvi_lobatto_m6,
    &fvi_lobatto_m7,       &fvi_lobatto_m8,
    &fvi_lobatto_d2,      &fvi_lobatto_d3,
    &fvi_lobatto_d4,      &fvi_lobatto_d5,
    &fvi_lobatto_d6,      &fvi_lobatto_d7,
    &fvi_lobatto_d8,      &fvi_cq2_midpoint,
    NULL
};

const fvi_method *fvi_method_find(const char *name)
{
    for (size_t i = 0; name && fvi_methods[i]; i++)
        if (strcmp(name, fvi_methods[i]->name) == 0)
            return fvi_methods[i];
    return NULL;
}

int fvi_method_has_modes(const fvi_method *method, const fvi_run *run, int *has)
{
    int status = FVI_SUCCESS;
    *has = 1;
    for (size_t j = 0; !status && *has && j < fvi_run_damper_count(run); j++) {
        const fvi_run_damper damper = fvi_run_damper_of(run, j);
        if (damper.law)
            status = fvi_kernel_has_modes(damper.law, fvi_damping_quadrature(method),
                                          run->h, has);
    }
    return status;
}

static int is_damped(const fvi_system *system)
{
    for (size_t i = 0; i < system->d; i++)
        if (system->damping[i] > 0)
            return 1;
    return 0;
}

/* Return the memory of the dampers of a system with matrices. Each damper has its own history. */
static double bytes_of_dampers(const fvi_method *method, const fvi_run *run)
{
    const size_t s = (size_t)method->stages;
    double bytes = (100 + 24 * (double)s) * (double)run->system->d;
    for (size_t j = 0; j < fvi_run_damper_count(run); j++) {
        const fvi_run_damper damper = fvi_run_damper_of(run, j);
        const size_t r = damper.matrix.history_size;
        const double order = fvi_run_damper_bytes_order(&damper);
        if (r > 0 && s > 0)
            bytes += fvi_lobatto_history_bytes(s, order - 1, r, run->steps, run->memory,
                                               run->tolerance);
        else if (r > 0)
            bytes += (double)fvi_history_bytes(order, r, run->steps, run->memory,
                                               run->tolerance);
    }
    return bytes;
}

double fvi_run_bytes(const fvi_method *method, const fvi_run *run)
{
    const fvi_system *system = run->system;
    const size_t s = (size_t)method->stages,
                 d = system->matrices ? system->matrices->damping.history_size
                                      : system->d;
    const double bytes = 100 * (double)system->d;
    if (fvi_has_mechanism_steps(system))
        return fvi_mechanism_bytes(method, run);
    if (system->matrices && (system->mechanism || s > 0))
        return bytes_of_dampers(method, run);
    const fvi_run_damper damper = fvi_run_damper_of(run, 0);
    const double order = fvi_run_damper_bytes_order(&damper);
    if (!method->memories || !is_damped(system) || (s > 0 && order == 2))
        return bytes;
    if (s > 0)
        return bytes
               + fvi_lobatto_history_bytes(s, order - 1, d, run->steps, run->memory,
                                           run->tolerance);
    return bytes
           + (double)fvi_history_bytes(order, d, run->steps, run->memory,
                                       run->tolerance);
}

int fvi_velocity(const fvi_system *system, const double *p, double *v)
{
    return !system->matrices && fvi_lagrangian_of(system)
               ? FVI_EUNSUP
               : fvi_divide_by_mass(system, p, v);
}
