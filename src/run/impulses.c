/* src/run/impulses.c -- The impulses of a force, as steps of one length take them. [H 2] */
#include "impulses.h"

#include "system/fail.h"

#include <fvi/error.h>

#include <gsl/gsl_machine.h>
#include <gsl/gsl_math.h>
#include <math.h>

static int refuse(int code, size_t i, double value, const char *reason,
                  fvi_error *error)
{
    return fvi_at_index(error, i, fvi_fail(error, code, "impulses", value, "impulse %zu: %s", i, reason));
}

int fvi_impulses_check(const fvi_force *force, size_t d, fvi_error *error)
{
    const size_t n = force->impulse_count;
    const fvi_impulse *hit = force->impulses;
    if (n > 0 && !hit)
        return fvi_fail(error, FVI_EFAULT, "impulses", NAN, "impulses is a null pointer");
    for (size_t i = 0; i < n; i++) {
        if (!hit[i].J)
            return refuse(FVI_EFAULT, i, NAN, "it needs its J", error);
        if (!(gsl_finite(hit[i].t) && hit[i].t >= 0)
            || !fvi_all_finite(d, hit[i].J))
            return refuse(FVI_EDOM, i, hit[i].t,
                          "it must be finite, at a time t >= 0", error);
        if (i > 0 && hit[i].t < hit[i - 1].t)
            return refuse(FVI_EINVAL, i, hit[i].t,
                          "impulses stand in the order of their times", error);
    }
    return FVI_SUCCESS;
}

/* The index of the first impulse at the time t or later, by bisection. */
static size_t first_impulse(const fvi_force *force, double t)
{
    size_t low = 0, high = force->impulse_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (force->impulses[middle].t < t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

//> share
/* The share of an impulse at the time t that node k gets. h, the product k h and t may each be off by half an ulp, and
 * h may be off by as much again if it is T / N. So an impulse within four ulp of a node is at the node. */
static double share_of_node(double t, double h, size_t k)
{
    double steps = t / h;
    const double nearest = round(steps);
    if (fabs(steps - nearest) <= 4 * GSL_DBL_EPSILON * nearest)
        steps = nearest;
    return fmax(0, 1 - fabs(steps - (double)k)); /* (2.15) */
}

void fvi_impulses_add(const fvi_force *force, double h, size_t k, size_t d,
                      double *J)
{
    for (size_t i = first_impulse(force, ((double)k - 1) * h);
         i < force->impulse_count && force->impulses[i].t < (double)(k + 1) * h;
         i++) {
        const double part = share_of_node(force->impulses[i].t, h, k);
        for (size_t j = 0; j < d; j++)
            J[j] += part * force->impulses[i].J[j];
    }
}
//< share

void fvi_impulses_act(fvi_stepper *s, size_t k)
{
    fvi_impulses_add(&s->run.system->force, s->run.h, k, s->run.system->d, s->p);
}
