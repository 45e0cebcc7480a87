/* src/run/dampers_check.c -- Check the dampers of a structure before a run. [H 27] */
#include "dampers_check.h"

#include "system/fail.h"

#include "kernel/kernel_terms.h"
#include "solution.h"

#include <fvi/dampers.h>

#include <math.h>

static int refuse(size_t j, int code, const char *reason, fvi_error *error)
{
    return fvi_at_index(error, j, fvi_fail(error, code, "damper", (double)j + 1, "damper %zu: %s", j + 1, reason));
}

/* Riemann and Liouville's past. If x0 stretches a damper, its law must be one power up to the order 1, for which a
 * motion exists. The method of the paper needs no motion: it takes the sum (7a) whatever the law. */
static int check_liouville(const fvi_method *method, const fvi_run *run, size_t j,
                           fvi_error *error)
{
    const fvi_kernel *kernel = run->system->mechanism->damper[j].kernel;
    int is_stretched;
    if (method->paper_convention
        || (fvi_kernel_is_power(kernel) && kernel->term->alpha <= 0.5))
        return FVI_SUCCESS;
    const int status = fvi_damper_is_stretched(run, j, &is_stretched);
    if (status)
        return refuse(j, status, fvi_error_name(status), error);
    return is_stretched ? refuse(j, FVI_EUNSUP,
                                 "the past rl wants one power of order 1 at most, or a start "
                                 "that does not stretch the damper; fvi takes it",
                                 error)
                        : FVI_SUCCESS;
}

static int check_damper(const fvi_method *method, const fvi_run *run, size_t j, fvi_error *error)
{
    const fvi_damper *damper = run->system->mechanism->damper + j;
    const int status = damper->kernel ? fvi_kernel_check(damper->kernel) : FVI_EFAULT;
    if (status)
        return fvi_at_index(error, j,
                            fvi_fail(error, status, "damper", (double)j + 1,
                                     "damper %zu: its kernel is no law of damping: %s", j + 1, fvi_error_name(status)));
    switch (damper->past) {
    case FVI_INITIAL_HISTORY_HELD:
        return FVI_SUCCESS;
    case FVI_INITIAL_HISTORY_CAPUTO:
        return fvi_kernel_is_power(damper->kernel) || fvi_kernel_takes_caputo(damper->kernel)
                   ? FVI_SUCCESS
                   : refuse(j, FVI_EUNSUP,
                            "Caputo's past is that of one power, or of orders up to 1",
                            error);
    case FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE:
        return check_liouville(method, run, j, error);
    }
    return refuse(j, FVI_EINVAL, "unknown past", error);
}

int fvi_check_dampers_of_matrices(const fvi_method *method, const fvi_run *run, fvi_error *error)
{
    const fvi_mechanism *mechanism = run->system->mechanism;
    const size_t count = mechanism ? mechanism->damper_count : 0;
    int status = FVI_SUCCESS;
    if (count != run->system->matrices->damper_count)
        return fvi_refuse(error, "mechanism", "the dampers are not those of the matrices: "
                        "fvi_structure_alloc_dampers makes both");
    if (mechanism && (mechanism->lagrangian || mechanism->force_on || mechanism->constraints))
        return fvi_fail(error, FVI_EUNSUP, "mechanism", NAN,
                        "matrices go with dampers, and with no Lagrangian, force of velocity or constraint");
    if (count > 0 && run->law)
        return fvi_fail(error, FVI_EUNSUP, "law", NAN, "with several dampers each has its own kernel");
    if (count > 0 && run->past != FVI_INITIAL_HISTORY_HELD)
        return fvi_fail(error, FVI_EUNSUP, "past", run->past, "with several dampers each has its own past");
    for (size_t j = 0; !status && j < count; j++)
        status = check_damper(method, run, j, error);
    return status;
}
