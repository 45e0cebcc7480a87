/* src/run/run_check.c -- Check a run before a method starts it. [H 2] */
#include "run_check.h"

#include "impulses.h"
#include "run_damper.h"
#include "dampers_check.h"
#include <fvi/events.h>
#include "solution.h"
#include "system/fail.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>
#include <math.h>

static int check_law(const fvi_method *method, const fvi_run *run,
                     fvi_error *error)
{
    if (!run->law)
        return FVI_SUCCESS;
    if (!method->takes_laws)
        return fvi_fail(error, FVI_EUNSUP, "law", NAN, "this method knows no laws of damping");
    const int status = fvi_kernel_check(run->law);
    if (status)
        return fvi_fail(error, status, "law", NAN, "not a law of damping: %s", fvi_error_name(status));
    if (run->past == FVI_INITIAL_HISTORY_HELD
        || (run->past == FVI_INITIAL_HISTORY_CAPUTO
            && fvi_kernel_takes_caputo(run->law)))
        return FVI_SUCCESS;
    return fvi_fail(error, FVI_EUNSUP, "past", run->past,
                    "a law of damping is that of a body that was held; up to the order 1 Caputo's past is the same");
}

static int check_impulses(const fvi_method *method, const fvi_run *run,
                          fvi_error *error)
{
    const fvi_system *system = run->system;
    const int status = fvi_impulses_check(&system->force, system->d, error);
    if (status || !system->force.impulse_count || !method->stages
        || run->alpha < 1 || system->mechanism)
        return status;
    for (size_t i = 0; i < system->d; i++)
        if (system->damping[i] > 0) /* then p is not m x', (17.17) */
            return fvi_fail(error, FVI_EUNSUP, "impulses", NAN, "stages take no impulse at alpha = 1");
    return FVI_SUCCESS;
}

static int check_past(const fvi_method *method, const fvi_run *run,
                      fvi_error *error)
{
    if (run->past != FVI_INITIAL_HISTORY_HELD
        && run->past != FVI_INITIAL_HISTORY_CAPUTO
        && run->past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
        return fvi_fail(error, FVI_EINVAL, "past", run->past, "unknown past");
    int has = 1, status = FVI_SUCCESS;
    if (!method->paper_convention && !run->system->mechanism)
        status = fvi_run_has_solution(run, &has);
    if (!has)
        return fvi_fail(error, FVI_EDOM, "past", run->past,
                        "Riemann-Liouville with a damped x0 != 0 has no solution for alpha > 1/2");
    return status ? fvi_fail(error, status, NULL, NAN, "%s", fvi_error_name(status))
                  : FVI_SUCCESS;
}

/* Check the d numbers of x0 or p0. */
static int check_start(const char *field, size_t d, const double *v,
                       fvi_error *error)
{
    for (size_t i = 0; i < d; i++)
        if (!isfinite(v[i]))
            return fvi_at_index(error, i,
                                fvi_fail(error, FVI_EDOM, field, v[i], "%s[%zu] is %g; it must be finite", field, i,
                                         v[i]));
    return FVI_SUCCESS;
}

static int refuse(const char *field, double value, const char *range,
                  fvi_error *error)
{
    return fvi_fail(error, FVI_EDOM, field, value, "%s is %g; it must be %s", field, value, range);
}

/* Check the ranges of the numbers of a run. */
static int check_numbers(const fvi_method *method, const fvi_run *run,
                         fvi_error *error)
{
    if (!(gsl_finite(run->h) && run->h > 0))
        return refuse("h", run->h, "finite and positive", error);
    if (!(run->kappa >= 0 && run->kappa <= 1))
        return refuse("kappa", run->kappa, "in [0, 1]", error);
    if (!(run->alpha >= method->alpha_least && run->alpha <= method->alpha_most))
        return fvi_fail(error, FVI_EDOM, "alpha", run->alpha,
                        method->alpha_least < method->alpha_most ? "alpha is %g; it must be in [%g, %g]"
                                                                 : "alpha is %g; it must be %g for this method",
                        run->alpha, method->alpha_least, method->alpha_most);
    if (!(run->tolerance >= 0 && run->tolerance < 1))
        return refuse("tolerance", run->tolerance, "in [0, 1)", error);
    if (!(run->step_error >= 0 && gsl_finite(run->step_error)))
        return refuse("step_error", run->step_error, "finite and not negative",
                      error);
    if (!(run->longest >= 0 && gsl_finite(run->longest)))
        return refuse("longest", run->longest, "finite and not negative",
                      error);
    return FVI_SUCCESS;
}

int fvi_run_check(const fvi_method *method, const fvi_run *run,
                  fvi_error *error)
{
    if (!method || !run || !run->x0 || !run->p0)
        return fvi_fail(error, FVI_EFAULT, !method ? "method" : !run ? "run" : !run->x0 ? "x0" : "p0", NAN,
                        "null pointer");
    const fvi_system *system = run->system;
    if (system && system->matrices && !method->takes_matrices)
        return fvi_fail(error, FVI_EUNSUP, "matrices", NAN, "this method takes no system with matrices");
    if (system && system->mechanism && !system->matrices && !method->takes_mechanism)
        return fvi_fail(error, FVI_EUNSUP, "mechanism", NAN, "this method takes no system with a mechanism");
    const fvi_run normal = fvi_run_normal(method, run);
    int status = fvi_system_check_any(system, error);
    if (!status && system->matrices) /* the check of the dampers reads the start */
        status = check_start("x0", system->d, run->x0, error);
    if (!status && system->matrices)
        status = fvi_check_dampers_of_matrices(method, run, error);
    if (status)
        return status;
    if (run->steps == 0)
        return fvi_fail(error, FVI_EINVAL, "steps", 0, "a run has at least one step");
    status = check_law(method, run, error);
    if (!status)
        status = check_numbers(method, &normal, error);
    if (!status)
        status = check_start("x0", run->system->d, run->x0, error);
    if (!status)
        status = check_start("p0", run->system->d, run->p0, error);
    if (!status && !fvi_method_takes_history(method, run->memory))
        status = fvi_fail(error, FVI_EUNSUP, "memory", run->memory, "this method has no such memory");
    if (!status && run->event_count)
        status = fvi_events_check(method, run, error);
    if (!status)
        status = check_impulses(method, &normal, error);
    return status ? status : check_past(method, run, error);
}
