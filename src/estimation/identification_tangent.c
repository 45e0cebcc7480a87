/* src/estimation/identification_tangent.c -- Compute a run with its derivatives by free parameters. [H 24] */
#include "identification_tangent.h"

#include <fvi/fvi.h>
#include "system/fail.h"
#include "system/system_check.h"

#include <stdlib.h>
#include <string.h>

/* Tolerance for a memory of stages: derivatives lead to the minimum, but the minimum does not depend on their last
 * digits. */
#define ENOUGH 1e-10

static double one = 1;

static int check(const fvi_run *run, size_t P, const fvi_free_parameter *which)
{
    if (!run || !which || !run->x0 || !run->p0)
        FVI_FAIL("a pointer of the tangents is NULL", FVI_EFAULT);
    if (run->law)
        FVI_FAIL("the tangents are those of a power", FVI_EUNSUP);
    int status = fvi_system_require(run->system);
    if (!status && (run->system->d != 1 || P == 0))
        FVI_FAIL("tangents are of one mass, by a parameter or more", FVI_EINVAL);
    for (size_t j = 0; j < P && !status; j++)
        if (which[j] >= FVI_FREE_PARAMETER_CONSTANT
            && which[j] - FVI_FREE_PARAMETER_CONSTANT
                   >= fvi_parameter_gradient_of(&run->system->potential).count)
            FVI_FAIL("the potential has no such constant", FVI_EINVAL);
    return status;
}

/* Set the direction in which one parameter changes by 1. */
static void set_direction(fvi_free_parameter which, double *unit, fvi_sensitivities *along)
{
    switch (which) {
    case FVI_FREE_PARAMETER_ALPHA:
        along->alpha = &one;
        break;
    case FVI_FREE_PARAMETER_RHO:
        along->damping = &one;
        break;
    case FVI_FREE_PARAMETER_MASS:
        along->mass = &one;
        break;
    case FVI_FREE_PARAMETER_X0:
        along->x0 = &one;
        break;
    case FVI_FREE_PARAMETER_P0:
        along->p0 = &one;
        break;
    default:
        if (which < FVI_FREE_PARAMETER_CONSTANT)
            break; /* an offset or a drift belongs to the record, not to the motion */
        unit[which - FVI_FREE_PARAMETER_CONSTANT] = 1;
        along->parameters = unit;
    }
}

int fvi_estimation_tangents_start(const fvi_method *method, const fvi_run *run, size_t P,
                                  const fvi_free_parameter *which, fvi_estimation_tangents *o)
{
    *o = (fvi_estimation_tangents){ .P = P, .which = which };
    const int status = check(run, P, which);
    if (status)
        return status;
    const fvi_parameter_gradient by = fvi_parameter_gradient_of(&run->system->potential);
    o->along = calloc(P, sizeof *o->along);
    o->unit = calloc(P * by.count + 1, sizeof *o->unit);
    if (!o->along || !o->unit)
        FVI_FAIL("no memory for the tangents", FVI_ENOMEM);
    for (size_t j = 0; j < P; j++) {
        o->along[j].sensitivity = by;
        set_direction(which[j], o->unit + j * by.count, o->along + j);
    }
    return fvi_tangent_start(method, run, P, o->along, ENOUGH, &o->of);
}

void fvi_estimation_tangents_stop(fvi_estimation_tangents *o)
{
    fvi_tangent_stop(&o->of);
    free(o->along);
    free(o->unit);
}

int fvi_tangent(const fvi_run *run, size_t P, const fvi_free_parameter *which,
                 double *x, double *slope)
{
    fvi_estimation_tangents o;
    if (!x || !slope)
        FVI_FAIL("a pointer of the tangents is NULL", FVI_EFAULT);
    int status = fvi_estimation_tangents_start(&fvi_fractional, run, P, which, &o);
    for (size_t k = 0; !status; k++) {
        x[k] = o.of.stepper->x[0];
        memcpy(slope + k * P, o.of.dx, P * sizeof *slope);
        if (k == run->steps)
            break;
        status = fvi_tangent_step(&o.of);
        if (!status && !fvi_all_finite(P, o.of.dx))
            status = FVI_EOVRFLW;
    }
    fvi_estimation_tangents_stop(&o);
    return status;
}
