/* src/methods/memory_warning.c -- Warn of a memory or a tolerance that a run does not read.                  [H 12] */
#include <fvi/warnings.h>

#include "damping.h"
#include "kernel/kernel_terms.h"
#include "run/run_damper.h"

#include <stdio.h>

/* Write to *has whether at least one damper of the run has decaying modes, of which the tolerance is. A power has them;
 * a law may have none. Methods with stages are not asked, because they refuse a law without modes. */
static int has_modes_somewhere(const fvi_method *method, const fvi_run *run, int *has)
{
    const size_t count = fvi_run_damper_count(run);
    int status = FVI_SUCCESS;
    *has = method->stages > 0 || count == 0;
    for (size_t j = 0; !status && !*has && j < count; j++) {
        const fvi_run_damper damper = fvi_run_damper_of(run, j);
        *has = 1;
        if (damper.law)
            status = fvi_kernel_has_modes(damper.law, fvi_damping_quadrature(method), run->h, has);
    }
    return status;
}

/* Write to *why what the method does instead of reading the tolerance; NULL if it reads the tolerance. */
static int find_why_tolerance_is_unread(const fvi_method *method, const fvi_run *run, const char **why)
{
    int status = FVI_SUCCESS, has = 1;
    *why = !method->memories                   ? "keeps no memory of the past"
           : method->dense                     ? "keeps its memory to the error of its steps"
           : run->memory == FVI_HISTORY_DIRECT ? "sums the whole past directly here, with rounding errors alone"
                                               : NULL;
    if (!*why && run->memory == FVI_HISTORY_AUTO)
        status = has_modes_somewhere(method, run, &has);
    if (!status && !has)
        *why = "sums the whole past directly here, because no law of the run has decaying modes";
    return status;
}

int fvi_warning_of_memory(const fvi_method *method, const fvi_run *run, size_t size, char *text)
{
    const char *name = method->name ? method->name : "this method", *why = NULL;
    const int asks_modes = run->memory == FVI_HISTORY_MODES && !method->memories;
    const int status = run->tolerance != 0 ? find_why_tolerance_is_unread(method, run, &why) : FVI_SUCCESS;
    *text = '\0';
    if (status == FVI_ENOMEM) {
        snprintf(text, size, "there is no memory to find out whether the tolerance is read");
        return -1;
    }
    if (asks_modes && why)
        snprintf(text, size, "memory exponentials and tolerance %g have no effect: %s %s", run->tolerance, name, why);
    else if (asks_modes)
        snprintf(text, size, "memory exponentials has no effect: %s keeps no memory of the past", name);
    else if (why)
        snprintf(text, size, "tolerance %g has no effect: %s %s", run->tolerance, name, why);
    return *text != '\0';
}
