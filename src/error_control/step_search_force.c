/* src/error_control/step_search_force.c -- Find out whether the steps are short enough to see the force. [H 18] */
#include "step_search_force.h"
#include "system/larger.h"
#include "system/seeded.h"

#include <fvi/error.h>

#include <gsl/gsl_math.h>
#include <string.h>

enum { PROBES = 128 };

void fvi_force_probe_start(fvi_force_probe *o, size_t d, double *room)
{
    *o = (fvi_force_probe){ .seed = 1,
                            .left = room,
                            .right = room + d,
                            .middle = room + 2 * d,
                            .coarse = room + 3 * d,
                            .deviation = room + 4 * d };
    for (size_t i = 0; i < d; i++)
        o->deviation[i] = GSL_POSINF;
}

/* A random number in [0, 1). The sequence is always the same, so that a search can be repeated. */
static double random_fraction(fvi_force_probe *o)
{
    return fvi_seeded_uniform(&o->seed, 0, 1);
}

static int force(const fvi_system *system, double t, double *F)
{
    return system->force.value(t, system->d, system->force.params, F);
}

//> probe
/* (18.7): find out whether F, at random times between two nodes, is at most half as far from the line through its
 * limits at both nodes as it was with steps twice as long. */
int fvi_force_probe_evaluate(fvi_force_probe *o, const fvi_run *run, size_t parts,
                         int *resolved)
{
    const fvi_system *system = run->system;
    const size_t d = system->d;
    const double steps = (double)(run->steps * parts),
                 h = run->h / (double)parts;
    *resolved = 1;
    if (!system->force.value)
        return FVI_SUCCESS;
    memcpy(o->coarse, o->deviation, d * sizeof *o->coarse);
    memset(o->deviation, 0, d * sizeof *o->deviation);
    for (int n = 0; n < PROBES; n++) {
        const double k = floor(steps * random_fraction(o)), theta = random_fraction(o);
        const double within = 0x1p-30 * h + 4 * GSL_DBL_EPSILON * (k + 1) * h;
        /* at a node F may jump, so take F beside it */
        int status = force(system, k * h + within, o->left);
        if (!status)
            status = force(system, (k + 1) * h - within, o->right);
        if (!status)
            status = force(system, (k + theta) * h, o->middle);
        if (status)
            return status;
        for (size_t i = 0; i < d; i++) {
            const double l = o->left[i], r = o->right[i], m = o->middle[i],
                         rounding = fabs(l) + fabs(r) + fabs(m),
                         off = fabs(m - ((1 - theta) * l + theta * r));
            o->deviation[i] =
                larger(o->deviation[i], off - 16 * GSL_DBL_EPSILON * rounding);
        }
    }
    for (size_t i = 0; i < d; i++)
        *resolved &= o->deviation[i] <= o->coarse[i] / 2;
    return FVI_SUCCESS;
}
//< probe
