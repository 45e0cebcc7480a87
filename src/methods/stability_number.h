/* src/methods/stability_number.h -- Stability numbers and kinds of history of the methods.  [H 13, 14, 17]
 *
 * Each function is a member stability_number of a method. It computes the load that fvi_stability_number describes, and
 * returns its codes. */
#ifndef FVI_STABILITY_NUMBER_H
#define FVI_STABILITY_NUMBER_H

#include <fvi/trajectory.h>

#define FVI_ALL_MEMORIES                                                       \
    (1u << FVI_HISTORY_AUTO | 1u << FVI_HISTORY_DIRECT                         \
     | 1u << FVI_HISTORY_MODES)

/* (14.3): the damping acts at the beginning of a step, as in Algorithms 1, 2 and 3. */
int fvi_stability_number_backward(const fvi_run *run, double *load);

/* The same formula with 1 - 2 alpha times the damping, but not below 0; and with 4^alpha times the damping. (13.14) */
int fvi_stability_number_shifted(const fvi_run *run, double *load);
int fvi_stability_number_bdf2(const fvi_run *run, double *load);

/* The load is 0, because every step is stable: (13.17), (17.28), and Euler's implicit method. */
int fvi_stability_number_none(const fvi_run *run, double *load);

#endif
