/* src/methods/initial_history_force.c -- What the past adds to Caputo's damping in a run. [H 19] */
#include "initial_history_force.h"

#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int fvi_initial_history_force_start(const fvi_stepper *s, size_t n, const double *c,
                   fvi_initial_history_force *history_force)
{
    const fvi_run *run = &s->run;
    const fvi_system *system = run->system;
    history_force->size = NULL;
    if (system->matrices)
        return fvi_initial_history_force_of_matrices(s, n, c, history_force);
    for (size_t i = 0; i < system->d; i++) {
        const double A = fvi_initial_history_amplitude(run->past, run->alpha, s->x[i],
                                            s->p[i] / system->mass[i]);
        if (A == 0 || system->damping[i] == 0)
            continue;
        if (!history_force->size) { /* the first that is pulled */
            history_force->size = calloc(system->d, sizeof *history_force->size);
            if (!history_force->size)
                FVI_FAIL("no memory for the past", FVI_ENOMEM);
            fvi_kernel_impulse_prepare(run->alpha, n, c, &history_force->initial_impulse);
        }
        history_force->size[i] = system->damping[i] * A
                        * pow(run->h, 1 + history_force->initial_impulse.e); /* (19.3) */
    }
    return FVI_SUCCESS;
}

int fvi_initial_history_force_copy(const fvi_initial_history_force *from, size_t d, fvi_initial_history_force *to)
{
    *to = (fvi_initial_history_force){ .initial_impulse = from->initial_impulse };
    if (!from->size)
        return FVI_SUCCESS;
    to->size = malloc(d * sizeof *to->size);
    if (!to->size)
        FVI_FAIL("no memory for the past", FVI_ENOMEM);
    memcpy(to->size, from->size, d * sizeof *to->size);
    return FVI_SUCCESS;
}
