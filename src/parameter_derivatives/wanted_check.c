/* src/parameter_derivatives/wanted_check.c -- Refuse derivatives by dampers and their laws that are not known.
 * [H 23] */
#include "wanted_check.h"

#include <fvi/dampers.h>
#include <fvi/methods.h>
#include "kernel/kernel_terms.h"
#include "node_terms.h"
#include "run/run_damper.h"
#include "system/fail.h"

int fvi_wanted_check_scheme(const fvi_method *method)
{
    for (size_t i = 0; fvi_methods[i]; i++) {
        const fvi_method *known = fvi_methods[i];
        if (method->scheme != FVI_SCHEME_CLASSICAL && method->scheme == known->scheme
            && method->start == known->start && method->step == known->step)
            return FVI_SUCCESS;
    }
    FVI_FAIL("this method has no adjoint and no tangents: its step is none of the steps of fvi, fvi-shifted, fvi-bdf2, "
             "fvi-stable, fvi-lobatto2 to 8d and fvi-adaptive",
             FVI_EUNSUP);
}

int fvi_wanted_check_dampers(const fvi_method *method, const fvi_run *run,
                             const fvi_sensitivities *want)
{
    const fvi_mechanism *m = run->system->mechanism;
    if (want->alpha)
        FVI_FAIL("several dampers have orders, and no alpha", FVI_EINVAL);
    if (want->mass && !run->system->matrices->inertia)
        FVI_FAIL("no derivative by a factor of M without its products", FVI_EUNSUP);
    for (size_t j = 0; j < m->damper_count; j++) {
        const fvi_kernel *kernel = m->damper[j].kernel;
        if (m->damper[j].past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
            continue;
        if (method->scheme == FVI_SCHEME_FVI)
            FVI_FAIL("fvi has no adjoint if one of several dampers has Riemann and Liouville's past; the other "
                     "methods have",
                     FVI_EUNSUP);
        if (!fvi_kernel_is_power(kernel) || kernel->term->alpha > 0.5)
            FVI_FAIL("one of several dampers may have Riemann and Liouville's past in an adjoint if its law is one "
                     "power of an order up to 1",
                     FVI_EUNSUP);
    }
    return FVI_SUCCESS;
}

int fvi_wanted_check_stage_laws(const fvi_run *run, const fvi_sensitivities *want)
{
    for (size_t j = 0; j < fvi_run_damper_count(run); j++) {
        const fvi_run_damper of = fvi_run_damper_of(run, j);
        if (of.law && run->system->matrices && of.growth > 1
            && fvi_wanted_kernel_numbers(want))
            FVI_FAIL("with stages a law that grows faster than s has no derivative by "
                     "its numbers; by fvi-bdf2 and fvi-stable it has",
                     FVI_EUNSUP);
    }
    return FVI_SUCCESS;
}
