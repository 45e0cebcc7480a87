/* src/frequency/exact_law.h -- Find the complex poles of 1 / Q for a law of damping. [H 26]
 *
 *     Q(s) = m s^2 + c + rho C(s) */
#ifndef FVI_EXACT_LAW_H
#define FVI_EXACT_LAW_H

#include <fvi/error.h>
#include "exact_pole.h"

#define FVI_BEHIND_CONTOURS 2.95 /* arg s */

/* fvi_kernel_poles -- Find the zeros of Q in the sector 1.5 <= arg s <= widest.     [(26.11)]
 *
 * All zeros in the upper half plane have arg s >= pi/2. The zeros are counted by the argument principle in rectangles
 * of ln s. The rectangles are cut until Newton's method finds the single zero in each.
 *
 *   m, c, rho  as for fvi_pole_find     law  has passed fvi_kernel_check
 *   widest     < pi; FVI_BEHIND_CONTOURS: zeros beyond it lie behind every contour of (11.10) and need no residue
 *   most       room in pole
 *   pole       output, count of them
 *
 * Return FVI_SUCCESS; FVI_EUNSUP if there are more than `most`; FVI_EMAXITER if two zeros agree to twelve digits, or if
 * a zero is not between e^-150 and e^150; FVI_EOVRFLW if Q is not finite. */
int fvi_kernel_poles(double m, double c, double rho, const fvi_kernel *law, double widest,
                     size_t most, fvi_pole *pole, size_t *count, fvi_error *error);

#endif
