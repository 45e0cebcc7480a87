/* src/error_control/step_search_force.h -- Do the steps see the force?      [H 18] */
#ifndef FVI_STEP_SEARCH_FORCE_H
#define FVI_STEP_SEARCH_FORCE_H

#include <fvi/trajectory.h>

#include <stdint.h>

/* A probe of F, for steps that are halved from one call to the next. */
typedef struct {
    uint64_t seed;
    double *left, *right, *middle; /* three values of F, d numbers each */
    /* how far F is off a line, d numbers each: for this step and the one before */
    double *deviation, *coarse;
} fvi_force_probe;

enum { FVI_PROBE_ROOM = 5 /* d numbers each */ };

/* Begin; room is for FVI_PROBE_ROOM d numbers, stays the caller's, and outlives the
 * probe. */
void fvi_force_probe_start(fvi_force_probe *probe, size_t d, double *room);

/* fvi_force_probe_evaluate -- evaluate F between the nodes of the run, each step of it cut
 * into so many parts. *resolved is nonzero if F has come twice as near to a line as at
 * the last evaluation, or there is no F. Returns FVI_SUCCESS, or what F returned. (18.7) */
int fvi_force_probe_evaluate(fvi_force_probe *probe, const fvi_run *run,
                         size_t parts, int *resolved);

#endif
