/* src/stability/stability_share.h -- The load of a step, for a share of the damping.
 *                                                                [Chapter 14] */
#ifndef FVI_STABILITY_SHARE_H
#define FVI_STABILITY_SHARE_H

#include <fvi/trajectory.h>

/* fvi_stability_share -- (14.3) with share rho for rho. All else, and the
 * errors, as for the methods fvi and lda in fvi_stability_load. */
int fvi_stability_share(double share, const fvi_run *run, double *load);

#endif
