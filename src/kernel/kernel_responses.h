/* src/kernel/kernel_responses.h -- How a law answers to a jump, a line and a parabola. [H 26]
 *
 * A body that was held until t = 0 begins with z = z_0 + v_0 t + a t^2/2 + ... The law C(s) answers to each term alone:
 *
 *     G_m(t), whose Laplace transform is C(s)/s^m.                            (26.21)
 *
 * G_1 is the force of a unit jump, G_2 of the line t, G_3 of the parabola t^2/2. Each G_m is the slope of G_(m+1),
 * so G_2, G_3 and G_4 are the impulses of these three forces. */
#ifndef FVI_KERNEL_RESPONSES_H
#define FVI_KERNEL_RESPONSES_H

#include <fvi/damping_laws.h>

enum { FVI_KERNEL_RESPONSES = 4 };

/* fvi_kernel_responses -- G_1 to G_4 at t = h, 2 h, ..., count h.
 *
 *   law       a law that fvi_kernel_check takes
 *   h         finite, > 0, seconds
 *   response  output: count times four numbers, G_m(k h) in response[4 (k - 1) + m - 1]; owned by the caller
 *
 * For example, a dashpot C = s has 0, 1, t and t^2/2. Accuracy: 1e-12 of each number (no proof; seen 4e-14), and
 * 1e-12 of the largest earlier one where a law rings. Cost: 63 values C(s) for the times from t to 4 t, and 63
 * exponential functions for each time; of one power 4 powers of t for each time. Returns FVI_SUCCESS or FVI_ENOMEM;
 * on error response is untouched. */
int fvi_kernel_responses(const fvi_kernel *law, double h, size_t count, double *response);

#endif
