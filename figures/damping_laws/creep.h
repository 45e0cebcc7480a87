/* figures/damping_laws/creep.h -- What a law does when it is held, and when it is pulled.
 *
 * By the weights of (26.3), as everything here: a stretch of 1 from t = 0 on is a force that
 * is their sum, and a force of 1 makes the stretch whose forces add up to 1. */
#ifndef CREEP_H
#define CREEP_H

#include <fvi/damping_laws.h>

enum { PIECES = 1000 };

//> creep
/* The force at t after a stretch of 1, and the stretch at t under a force of 1, by PIECES
 * steps of BDF2. Returns what fvi_kernel_weights returns. */
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
