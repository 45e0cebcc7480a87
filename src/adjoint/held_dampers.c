/* src/adjoint/held_dampers.c -- The dampers of an adjoint run. [H 23, 27] */
#include "held_dampers.h"

void fvi_hold_dampers(const fvi_system *of, fvi_damper *held, fvi_mechanism *mechanism, fvi_system *back)
{
    if (!of->mechanism)
        return;
    *mechanism = (fvi_mechanism){ .damper_count = of->mechanism->damper_count, .damper = held };
    for (size_t j = 0; j < mechanism->damper_count; j++) {
        held[j] = of->mechanism->damper[j];
        held[j].past = FVI_INITIAL_HISTORY_HELD;
    }
    back->mechanism = mechanism;
}
