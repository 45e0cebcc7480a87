/* src/methods/pull.c -- What the past adds to Caputo's damping in a run. [Chapter 19] */
#include "pull.h"

#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_pull_start(const fvi_stepper *s, size_t n, const double *c,
                   fvi_pull *pull)
{
    const fvi_run *run = &s->run;
    const fvi_system *system = run->system;
    pull->size = NULL;
    if (system->matrices)
        return fvi_pull_of_matrices(s, n, c, pull);
    for (size_t i = 0; i < system->d; i++) {
        const double A = fvi_past_amplitude(run->past, run->alpha, s->x[i],
                                            s->p[i] / system->mass[i]);
        if (A == 0 || system->damping[i] == 0)
            continue;
        if (!pull->size) { /* the first that is pulled */
            pull->size = calloc(system->d, sizeof *pull->size);
            if (!pull->size)
                FVI_FAIL("no memory for the past", FVI_ENOMEM);
            fvi_past_prepare(run->alpha, n, c, &pull->fading);
        }
        pull->size[i] = system->damping[i] * A
                        * pow(run->h, 1 + pull->fading.e); /* (19.3) */
    }
    return FVI_SUCCESS;
}

int fvi_pull_copy(const fvi_pull *from, size_t d, fvi_pull *to)
{
    *to = (fvi_pull){ .fading = from->fading };
    if (!from->size)
        return FVI_SUCCESS;
    to->size = malloc(d * sizeof *to->size);
    if (!to->size)
        FVI_FAIL("no memory for the past", FVI_ENOMEM);
    memcpy(to->size, from->size, d * sizeof *to->size);
    return FVI_SUCCESS;
}
