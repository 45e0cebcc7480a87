/* src/adjoint/held_dampers.h -- The dampers of an adjoint run. [H 23, 27]
 *
 * Internal. */
#ifndef FVI_HELD_DAMPERS_H
#define FVI_HELD_DAMPERS_H

#include <fvi/dampers.h>
#include <fvi/system.h>

/* fvi_hold_dampers -- give the system of an adjoint run the dampers of the run, all with the past HELD. If the run has
 * no list of dampers, the system stays as it is.
 *
 *   of         the system of the run
 *   held       room for its dampers
 *   mechanism  room for the mechanism that holds them; both rooms must outlive the adjoint run
 *   back       the system of the adjoint run */
void fvi_hold_dampers(const fvi_system *of, fvi_damper *held, fvi_mechanism *mechanism, fvi_system *back);

#endif
