/* tests/structures/building_error.h -- How far a run of the building is from the exact motion. */
#ifndef BUILDING_ERROR_H
#define BUILDING_ERROR_H

#include "building.h"
#include "structures_ref.h"
#include "system/larger.h"

/* max |x - x(t)| and |p - v(t)| / 10 at t = 6, after so many steps. */
static inline double error_of(const fvi_method *method, const building *b, size_t steps)
{
    fvi_stepper *s;
    const fvi_run run = run_of(&b->system, 0.5, 6. / (double)steps, steps, shape, push);
    double worst = 0;
    OK(fvi_stepper_start(method, &run, &s, NULL));
    while (s->k < steps)
        OK(fvi_stepper_step(s));
    for (size_t i = 0; i < D; i++)
        worst = larger(worst, larger(fabs(s->x[i] - ref_building[2].x[i]),
                                     fabs(s->p[i] - ref_building[2].v[i]) / 10));
    fvi_stepper_free(s);
    return worst;
}

#endif
