/* src/kernel/kernel_responses.h -- The responses of a law to a jump, a line and a parabola. [H 26]
 *
 * A body that was held until t = 0 begins with z = z_0 + v_0 t + a t^2/2 + ... The law C(s) responds to each term
 * separately with
 *
 *     G_m(t), whose Laplace transform is C(s)/s^m.                            (26.21)
 *
 * G_1 is the force of a unit jump, G_2 of the line t, and G_3 of the parabola t^2/2. Each G_m is the derivative of
 * G_(m+1), so G_2, G_3 and G_4 are the impulses of these three forces. */
#ifndef FVI_KERNEL_RESPONSES_H
#define FVI_KERNEL_RESPONSES_H

#include <fvi/damping_laws.h>

enum { FVI_KERNEL_RESPONSES = 4 };

/* fvi_kernel_responses -- Compute G_1 to G_4 at t = h, 2 h, ..., count h.
 *
 *   law       a law that has passed fvi_kernel_check
 *   h         finite, > 0, seconds
 *   response  output: count times four numbers, G_m(k h) in response[4 (k - 1) + m - 1]; owned by the caller
 *
 * For example, a dashpot C = s has 0, 1, t and t^2/2. Accuracy: 1e-12 of each number (no proof; seen 4e-14). If a law
 * rings, 1e-12 of the largest earlier number. Cost: 63 values C(s) for the times from t to 4 t, and 63 exponential
 * functions for each time; a single power takes 4 powers of t for each time.
 *
 * Return FVI_SUCCESS; FVI_ENOMEM; FVI_EUNSUP for a law with more than 64 poles off the cut. On error
 * response is unchanged. */
int fvi_kernel_responses(const fvi_kernel *law, double h, size_t count, double *response);

#endif
