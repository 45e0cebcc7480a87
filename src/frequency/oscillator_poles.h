/* src/frequency/oscillator_poles.h -- The poles of a system of one unknown.    [H 30] */
#ifndef FVI_OSCILLATOR_POLES_H
#define FVI_OSCILLATOR_POLES_H

#include "dynamic_stiffness.h"
#include "exact_pole.h"

/* fvi_oscillator_poles -- the poles of H 11, or all those of (26.11). *count is 0 where the law is left to the
 * general search: several terms with functions, or a pole that is further away than (26.11) looks.
 *
 *   response  of one unknown
 *   most      room in pole, at least 1
 *   pole      output, count of them
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_oscillator_poles(const fvi_response *response, size_t most, fvi_pole *pole, size_t *count);

#endif
