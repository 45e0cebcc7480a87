/* src/problem/start_check.c -- Check what was typed for the start of a motion: velocities, and forces at t = 0. */
#include "words.h"

#include <fvi/lagrangian.h>

#include <math.h>
#include <stdlib.h>

/* sin(t)/t is not a number at t = 0, but has a limit, which the methods find within the first step. */
int fvi_check_start_force(const fvi_method *method, const char *field, const char *text,
                          const fvi_typed_force *force, fvi_error *error)
{
    const fvi_force typed = force ? fvi_force_typed(force) : (fvi_force){ .value = NULL };
    double F = 0;
    if (method->scheme == FVI_SCHEME_CLASSICAL || method->scheme == FVI_SCHEME_FVI || !typed.value
        || typed.value(0, 1, typed.params, &F) != FVI_SUCCESS || !isinf(F))
        return FVI_SUCCESS;
    return fvi_refuse(error, field, "'%s' is infinite at t = 0: %s takes its first step from its limit there", text,
                      method->name);
}

/* fvi_velocity_of_momentum leaves the guess 0 of a coordinate without inertia as it is. */
int fvi_check_start_velocity(const fvi_system *system, const double *x0, const double *v0, const double *p0,
                             fvi_error *error)
{
    double *moves = calloc(system->d, sizeof *moves);
    if (!moves)
        return fvi_no_memory(error, NULL);
    int status = FVI_SUCCESS;
    if (!(system->mechanism && system->mechanism->constraints)
        && fvi_velocity_of_momentum(system, 0, x0, p0, moves) == FVI_SUCCESS)
        for (size_t i = 0; i < system->d && !status; i++)
            if (v0[i] != 0 && moves[i] == 0)
                status = fvi_refuse(error, "v0", "v%zu is %g: this coordinate has no inertia, and its velocity follows "
                                    "from the forces: give 0", i + 1, v0[i]);
    free(moves);
    return status;
}
