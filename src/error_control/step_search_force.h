/* src/error_control/step_search_force.h -- Find out whether the steps are short enough to see the force. [H 18] */
#ifndef FVI_STEP_SEARCH_FORCE_H
#define FVI_STEP_SEARCH_FORCE_H

#include <fvi/trajectory.h>

#include <stdint.h>

/* A probe of F, for steps that are halved from one call to the next. */
typedef struct {
    uint64_t seed;
    double *left, *right, *middle; /* three values of F, d numbers each */
    /* the largest distance of F from a line, d numbers each: for these steps and for the steps twice as long */
    double *deviation, *coarse;
} fvi_force_probe;

enum { FVI_PROBE_ROOM = 5 /* d numbers each */ };

/* fvi_force_probe_start -- begin. `room` has space for FVI_PROBE_ROOM d numbers; it stays the caller's, and must
 * outlive the probe. */
void fvi_force_probe_start(fvi_force_probe *probe, size_t d, double *room);

/* fvi_force_probe_evaluate -- evaluate F between the nodes of the run, after each of its steps is cut into `parts`.
 * *resolved becomes nonzero if F is at most half as far from a line between the nodes as in the call before, or if
 * there is no F. Returns FVI_SUCCESS, or what F returned. (18.7) */
int fvi_force_probe_evaluate(fvi_force_probe *probe, const fvi_run *run,
                         size_t parts, int *resolved);

#endif
