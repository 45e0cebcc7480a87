/* src/frequency/oscillator_poles.h -- Find the poles of a system with one unknown.    [H 30] */
#ifndef FVI_OSCILLATOR_POLES_H
#define FVI_OSCILLATOR_POLES_H

#include "dynamic_stiffness.h"
#include "exact_pole.h"

/* fvi_oscillator_poles -- Find the pole of H 11, or all poles of (26.11). *count is 0 if the law is left to the general
 * search: if K is negative, if the law has several terms and one of them is a function, or if the poles of (26.11) are
 * not found.
 *
 *   response  with one unknown
 *   most      room in pole, at least 1
 *   pole      output, count of them
 *
 * Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_oscillator_poles(const fvi_response *response, size_t most, fvi_pole *pole, size_t *count);

#endif
