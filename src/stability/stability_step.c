/* src/stability/stability_step.c -- The longest stable step of a method. [H 14] */
#include <fvi/stability.h>

#include "run/run_damper.h"
#include "system/fail.h"
#include "system/system_check.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_stability_number(const fvi_method *method, const fvi_run *run,
                       double *load)
{
    if (!method || !run || !load)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!method->stability_number)
        FVI_FAIL("the load of this method is not known", FVI_EUNSUP);
    if (run->law && !method->takes_laws)
        FVI_FAIL("this method knows no laws of damping", FVI_EUNSUP);
    const fvi_run normal = fvi_run_normal(method, run);
    if (!(normal.alpha >= method->alpha_least && normal.alpha <= method->alpha_most))
        FVI_FAIL("this method does not know this alpha", FVI_EDOM);
    return method->stability_number(&normal, load);
}

/* The Hessian of U, which is asked for once, at x0, when a load first needs it. */
typedef struct {
    const fvi_potential *u;
    double *K;
    int status; /* what it returned */
} kept_hessian;

static int keep(size_t d, const double *x, void *params, double *H)
{
    kept_hessian *kept = params;
    const fvi_potential *u = kept->u;
    const size_t bytes = d * (u->diagonals ? u->diagonals : d) * sizeof *H;
    if (!kept->K) {
        kept->K = calloc(1, bytes); /* a row may have room that is not written */
        if (!kept->K)
            FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
        kept->status = u->hessian(d, x, u->params, kept->K);
    }
    memcpy(H, kept->K, bytes);
    return kept->status;
}

/* The longest step of trial, whose h is written to; log2 h to `digits` of itself, or of 1 if
 * it is less. */
static int bisect(const fvi_method *method, fvi_run *trial, double digits,
                  double *h)
{
    int status = FVI_SUCCESS;
    //> step
    /* The load does not fall while h grows. Bisection of log2 h over all doubles
     * that leave h^2 finite; a load that overflows is a load above 1. */
    double low = -500, high = 500;
    while (high - low > digits * fmax(1, fabs(low))) {
        double middle = (low + high) / 2, load = GSL_POSINF;
        trial->h = exp2(middle);
        status = fvi_stability_number(method, trial, &load);
        if (status && status != FVI_EOVRFLW)
            return status;
        if (load <= 1)
            low = middle;
        else
            high = middle;
    }
    //< step
    if (status && low == -500) /* the shortest step, too: it is not h */
        return status;
    *h = high == 500 ? GSL_POSINF : low == -500 ? 0 : exp2(low);
    return FVI_SUCCESS;
}

int fvi_stability_longest_step(const fvi_method *method, const fvi_run *run, double *h)
{
    if (!method || !run || !h)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!method->stability_number_grows)
        FVI_FAIL("the stable steps are not all those up to a longest", FVI_EUNSUP);
    int status = fvi_system_require_any(run->system);
    if (status)
        return status;
    if (run->system->mechanism && !run->system->matrices)
        FVI_FAIL("the load of a mechanism is not known", FVI_EUNSUP);
    kept_hessian kept = { .u = &run->system->potential };
    fvi_system system = *run->system;
    fvi_run trial = *run;
    trial.system = &system;
    if (kept.u->hessian) { /* of U, a load asks for no more than that */
        system.potential.hessian = keep;
        system.potential.params = &kept;
        system.potential.quadratic = NULL;
    }
    /* a load of matrices is an estimate, and dear */
    status = bisect(method, &trial, system.matrices ? 0x1p-12 : 0x1p-51, h);
    free(kept.K);
    return status;
}
