/* src/mechanism/mechanism_check.c -- Check whether a method can take a mechanism.     [H 29] */
#include "mechanism.h"

#include "system/fail.h"

#include "kernel/kernel_terms.h"

#include <math.h>

static int refuse(int code, const char *field, size_t i, const char *text,
                  fvi_error *error)
{
    return fvi_at_index(error, i, fvi_fail(error, code, field, (double)i + 1, text, i + 1));
}

static int check_damper(const fvi_damper *damper, size_t i, int wants_hessian,
                        fvi_error *error)
{
    const fvi_elongation *of = &damper->of;
    if (damper->matrix)
        return refuse(FVI_EUNSUP, "damper", i,
                      "damper %zu is a matrix, which goes with a structure",
                      error);
    if (!damper->kernel || (!of->row && (!of->value || !of->gradient)))
        return refuse(FVI_EFAULT, "damper", i,
                      "damper %zu lacks its kernel, or value and gradient of "
                      "its elongation",
                      error);
    if (wants_hessian && !of->row && !of->hessian)
        return refuse(FVI_EFAULT, "damper", i,
                      "damper %zu lacks the second derivatives that stages "
                      "ask for; fvi-stable does not",
                      error);
    const int status = fvi_kernel_check(damper->kernel);
    if (status)
        return fvi_at_index(error, i,
                            fvi_fail(error, status, "damper", (double)i + 1,
                                     "damper %zu: its kernel is no law of damping: %s", i + 1, fvi_error_name(status)));
    if (damper->past != FVI_INITIAL_HISTORY_HELD
        && damper->past != FVI_INITIAL_HISTORY_CAPUTO
        && damper->past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
        return refuse(FVI_EINVAL, "damper", i, "damper %zu has an unknown past",
                      error);
    const fvi_kernel *kernel = damper->kernel;
    if (damper->past == FVI_INITIAL_HISTORY_CAPUTO
        && !fvi_kernel_is_power(kernel)
        && !fvi_kernel_takes_caputo(kernel))
        return refuse(FVI_EUNSUP, "damper", i,
                      "damper %zu: above the order 1 only a power alone has "
                      "Caputo's past",
                      error);
    return FVI_SUCCESS;
}

static int check_constraints(const fvi_method *method, const fvi_run *run,
                             fvi_error *error)
{
    const fvi_constraints *c = run->system->mechanism->constraints;
    const int is_node = method->scheme == FVI_SCHEME_CQ2_MIDPOINT;
    if (!is_node && !method->stages && method->scheme != FVI_SCHEME_VARIABLE_STEP)
        return fvi_fail(error, FVI_EUNSUP, "constraint", NAN, "this method takes no constraints; fvi-stable, "
                        "fvi-lobatto2 to 8, 2d to 8d and fvi-adaptive do");
    if (!c->value || !c->gradient || (!is_node && !c->hessian))
        return fvi_fail(error, FVI_EFAULT, "constraint", NAN, "a function of the constraints is missing");
    if (c->count == 0 || c->count > run->system->d)
        return fvi_fail(error, FVI_EINVAL, "constraint", (double)c->count, "%zu constraints of %zu coordinates",
                        c->count, run->system->d);
    if (run->system->force.impulse_count && method->scheme != FVI_SCHEME_VARIABLE_STEP)
        return fvi_fail(error, FVI_EUNSUP, "constraint", NAN,
                        "impulses and constraints go together with fvi-adaptive alone");
    return FVI_SUCCESS;
}

int fvi_mechanism_check(const fvi_method *method, const fvi_run *run,
                        fvi_error *error)
{
    const fvi_system *system = run->system;
    const fvi_mechanism *m = system->mechanism;
    if (run->law)
        return fvi_refuse(error, "law", "a system with a mechanism has its laws in its dampers");
    for (size_t i = 0; i < system->d && !m->lagrangian; i++)
        if (system->damping[i] != 0)
            return fvi_fail(error, FVI_EINVAL, "rho", system->damping[i],
                            "a system with a mechanism is damped by its dampers alone");
    if ((m->lagrangian && !m->lagrangian->at)
        || (m->force_on && !m->force_on->at)
        || (m->damper_count && !m->damper))
        return fvi_fail(error, FVI_EFAULT, "mechanism", NAN, "a function or the list of dampers is missing");
    int status = FVI_SUCCESS;
    const int has_stages = method->stages > 0 || method->scheme == FVI_SCHEME_VARIABLE_STEP;
    for (size_t i = 0; i < m->damper_count && !status; i++)
        status = check_damper(&m->damper[i], i, has_stages, error);
    return status || !m->constraints ? status
                                     : check_constraints(method, run, error);
}
