/* figures/damping_laws/creep.h -- The force of a law after a sudden stretch, and its stretch under a sudden force.
 *
 * Both come from the weights of (26.3). After a stretch of 1 at t = 0 the force is the sum of the weights. The
 * stretch under a force of 1 is the sequence whose forces are all 1, so it is found by solving the same sums
 * one step after the other. */
#ifndef CREEP_H
#define CREEP_H

#include <fvi/damping_laws.h>

enum { PIECES = 1000 };

//> creep
/* Compute the force at t after a stretch of 1, and the stretch at t under a force of 1, with
 * PIECES steps of BDF2. Returns the code of fvi_kernel_weights. */
static inline int relaxation_and_creep(const fvi_kernel *law, double t,
                                       double *force, double *stretch)
{
    double w[PIECES + 1], z[PIECES + 1];
    const int status = fvi_kernel_weights(law, FVI_DELTA_BDF2, t / PIECES,
                                       PIECES + 1, w);
    *force = 0;
    for (int k = 0; k <= PIECES && !status; k++) {
        double past = 0;
        for (int n = 1; n <= k; n++)
            past += w[n] * z[k - n];
        z[k] = (1 - past) / w[0];
        *force += w[k];
    }
    *stretch = z[PIECES];
    return status;
}
//< creep

#endif
