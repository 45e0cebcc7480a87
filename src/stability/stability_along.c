/* src/stability/stability_along.c -- Find out whether the step is still stable at the place that a run has reached.
 * [H 14] */
#include <fvi/stability.h>

#include "system/fail.h"
#include "system/system_check.h"
#include "system/stiffness.h"

#include <stdlib.h>

/* An upper bound of the eigenvalues of M^{-1} Hess U(x), the largest sum of a row (system/stiffness.h). */
static int stiffness_at(const fvi_system *system, const double *x,
                        double *stiffness)
{
    const fvi_potential *u = &system->potential;
    const size_t d = system->d, width = u->diagonals ? u->diagonals : d;
    double *H = malloc(d * width * sizeof *H);
    if (!H)
        FVI_FAIL("no memory for the Hessian", FVI_ENOMEM);
    int status = u->hessian(d, x, u->params, H);
    if (!status)
        *stiffness = fvi_stiffness(system, H);
    free(H);
    return status;
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
        status = stiffness_at(run->system, x, &stiffness);
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
