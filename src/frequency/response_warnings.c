/* src/frequency/response_warnings.c -- Warn about a response or poles that may mislead.  [H 30] */
#include <fvi/response.h>

#include "system/quadratic.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int fvi_response_warning_of_place(const fvi_system *system, const double *x, const char **text)
{
    const fvi_potential *u = &system->potential;
    *text = NULL;
    if (!u->value || fvi_potential_is_quadratic(u))
        return 0; /* linear at every place */
    double *slope = malloc(system->d * sizeof *slope);
    if (!slope) {
        *text = "there is no memory to find out whether this is an equilibrium";
        return -1;
    }
    int is_equilibrium = 1; /* also if the gradient fails: the function that linearises the motion reports that */
    if (!fvi_potential_gradient(system, x, slope))
        for (size_t i = 0; i < system->d; i++)
            is_equilibrium = is_equilibrium && fabs(slope[i]) <= 1e-8 * (1 + fabs(x[i]));
    free(slope);
    if (!is_equilibrium)
        *text = "the potential has a slope at x0: this is no equilibrium";
    return !is_equilibrium;
}

int fvi_response_warning_of_poles(const fvi_poles *poles, size_t size, char *text)
{
    if (poles->count == poles->expected && poles->expected >= poles->d)
        return 0;
    if (poles->count == poles->expected)
        snprintf(text, size, "what creeps or grows, e^{st} with a real s or with Re s > 0, is no row");
    else if (poles->expected == SIZE_MAX)
        snprintf(text, size, "these are %zu of ? poles", poles->count);
    else
        snprintf(text, size, "these are %zu of %zu poles", poles->count, poles->expected);
    return 1;
}
