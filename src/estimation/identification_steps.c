/* src/estimation/identification_steps.c -- Choose the method that suits the data.   [H 24] */
#include "identification_model.h"

#include "system/lagrangian_point.h"
#include "system/larger.h"
#include "system/stiffness.h"

#include <fvi/dampers.h>
#include <fvi/lobatto.h>
#include <fvi/variable_steps.h>

#include <stdlib.h>

enum { MANY_STEPS = 1 << 13, MOST_COORDINATES = 64 };

/* Return a bound of w^2 of each mode at the start; 0 if it is not known. */
static double fastest_square(const fvi_run *run)
{
    double most = 0;
    if (run->system->d > MOST_COORDINATES || !run->system->potential.hessian
        || fvi_potential_stiffness(run->system, run->x0, &most))
        return 0;
    return isfinite(most) ? most : 0;
}

int fvi_estimation_has_massless(const fvi_system *system, size_t index)
{
    const fvi_mechanism *mechanism = system->mechanism;
    for (size_t i = 0; i < system->d && mechanism && !mechanism->lagrangian && !system->matrices; i++)
        if (system->mass[i] == 0 && (index == 0 || index == i + 1))
            return 1;
    return 0;
}

/* Return nonzero if the Lagrangian of a run has a coordinate without inertia at its start. */
static int lacks_inertia(const fvi_run *run)
{
    const fvi_system *system = run->system;
    const size_t d = system->d;
    int vanishes, lacks = 0;
    if (!fvi_lagrangian_of(system))
        return 0;
    double *room = calloc(d * d + 2 * d, sizeof *room);
    size_t *is_zero = calloc(d, sizeof *is_zero);
    if (room && is_zero
        && !fvi_inertia_at_rest(system, 0, run->x0, room + d * d + d, room, is_zero, &vanishes))
        for (size_t i = 0; i < d; i++)
            lacks |= is_zero[i] != 0;
    free(room);
    free(is_zero);
    return lacks;
}

const fvi_method *fvi_estimate_method(const fvi_estimation *fit)
{
    fvi_estimation asked = { .method = &fvi_lobatto_m4 };
    if (fit)
        asked = *fit;
    asked.method = &fvi_lobatto_m4;
    if (fvi_estimation_check(&asked))
        return NULL;
    if (fit->run->system->matrices || fvi_estimation_has_massless(fit->run->system, 0) || lacks_inertia(fit->run))
        return &fvi_lobatto_d4;
    if (fit->run->system->mechanism)
        return &fvi_lobatto_m4;
    const double swings = fvi_estimation_last_time(fit) * sqrt(fastest_square(fit->run));
    return larger(fvi_estimation_equal_steps(fit), swings) > MANY_STEPS ? &fvi_variable_step
                                                                        : &fvi_lobatto_m4;
}
