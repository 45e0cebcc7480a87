/* src/stability/stability_step.c -- The load of a method, at the start and along a run, and its longest stable step.
 * [H 14] */
#include <fvi/stability.h>

#include "run/run_damper.h"
#include "system/fail.h"
#include "system/stiffness.h"
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

//> along
int fvi_stability_along_run(const fvi_method *method, const fvi_run *run,
                        const double *x, double *stiffest, double *load)
{
    if (!method || !run || !x || !stiffest || !load)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = fvi_system_require(run->system);
    if (status)
        return status;
    double stiffness = 0, there = 0;
    if (run->system->potential.hessian)
        status = fvi_potential_stiffness(run->system, x, &stiffness);
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
    if (!status && stiffness > 1.05 * *stiffest) {
        fvi_run here = *run;
        here.x0 = x;
        status = fvi_stability_number(method, &here, &there);
        if (!status)
            *stiffest = stiffness;
    }
    if (!status)
        *load = there;
    return status;
}
//< along

/* The Hessian of U at x0. The caller's function is called once, when a load first needs the Hessian; the loads of all
 * other steps read this copy. */
typedef struct {
    const fvi_potential *u;
    double *K;
    int status; /* what the caller's function returned */
} kept_hessian;

static int store_hessian(size_t d, const double *x, void *params, double *H)
{
    kept_hessian *kept = params;
    const fvi_potential *u = kept->u;
    const size_t bytes = d * (u->diagonals ? u->diagonals : d) * sizeof *H;
    if (!kept->K) {
        kept->K = calloc(1, bytes); /* zeros, because a row may have entries that no function writes */
        if (!kept->K)
            FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
        kept->status = u->hessian(d, x, u->params, kept->K);
    }
    memcpy(H, kept->K, bytes);
    return kept->status;
}

/* Find the longest stable step of `trial`, whose h is overwritten. The error of log2 h is at most `digits` times
 * |log2 h|, or `digits` if |log2 h| < 1. */
static int bisect(const fvi_method *method, fvi_run *trial, double digits,
                  double *h)
{
    int status = FVI_SUCCESS;
    //> step
    /* The load does not fall while h grows. So bisect log2 h over all doubles whose h^2 is finite. A load that
     * overflows counts as a load above 1. */
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
    if (status && low == -500) /* the load overflows for the shortest step, too, so the cause is not h */
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
    if (kept.u->hessian) { /* a load asks for nothing of U but the Hessian */
        system.potential.hessian = store_hessian;
        system.potential.params = &kept;
        system.potential.quadratic = NULL;
    }
    /* A load of matrices is an estimate, and costs much time: so fewer digits of h are enough. */
    status = bisect(method, &trial, system.matrices ? 0x1p-12 : 0x1p-51, h);
    free(kept.K);
    return status;
}
