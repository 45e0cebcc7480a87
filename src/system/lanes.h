/* src/system/lanes.h -- Evaluate potentials and forces of several oscillators as lanes of a vector.  [H 28]
 *
 * This header is internal. batch.h makes lanes of several runs. Each run has one coordinate and becomes a lane: one
 * coordinate of a common system. So one vector of the processor holds one number of each lane. The digits of a lane are
 * the digits of its own run. */
#ifndef FVI_LANES_H
#define FVI_LANES_H

#include <fvi/system.h>

/* Number of doubles in the widest vector. Arrays of lanes have this length. If there are fewer lanes, the numbers
 * behind the last lane have no meaning. */
enum { FVI_MOST_LANES = 8 };

/* fvi_lane_functions -- Functions that evaluate U'(x) or F(t) of all lanes at once. The lanes may differ in their
 * parameters only.
 *
 *   prepare   reads the parameters of `count` lanes. Returns FVI_SUCCESS, FVI_ENOMEM, or FVI_EUNSUP if the lanes differ
 *             in more than parameters
 *   evaluate  writes f(x) of each lane to f and f'(x) to slope, unless slope is NULL. For a force, x is the time t,
 *             which is the same in all lanes. active[l] = 0: the caller ignores f[l] and slope[l] of this lane, so the
 *             function may leave them unchanged. active = NULL: all lanes are active
 *   discard   frees what prepare has allocated
 *   alone     NULL, or a function that computes f(x) and f'(x) of one lane from its own params, if both together take
 *             less time than one after the other */
typedef struct fvi_lane_functions {
    int (*prepare)(size_t count, void *const *params, void **prepared);
    void (*evaluate)(const void *prepared, const double *x, const double *active, double *f, double *slope);
    void (*discard)(void *prepared);
    void (*alone)(const void *params, double x, double *f, double *slope);
} fvi_lane_functions;

/* fvi_lane_pairs -- Two parameters for each lane, for example c and g, or a and w.
 *
 * fvi_lane_pairs_prepare is a `prepare` that reads two numbers from the params of each lane. fvi_lane_numbers_prepare
 * reads only the first number and sets the second one to 0. For both, `discard` is free. */
typedef struct fvi_lane_pairs {
    double first[FVI_MOST_LANES], second[FVI_MOST_LANES];
    int has_one_second; /* nonzero if the second number is the same in all lanes */
} fvi_lane_pairs;

int fvi_lane_pairs_prepare(size_t count, void *const *params, void **prepared);
int fvi_lane_numbers_prepare(size_t count, void *const *params, void **prepared);

/* fvi_lanes -- The lanes of a common system.
 *
 *   count             number of lanes, 1 to FVI_MOST_LANES
 *   system            the system of each lane, with one coordinate. The systems must outlive the lanes
 *   potential, force  output of `prepare`, or NULL if each lane calls its own function */
typedef struct fvi_lanes {
    size_t count;
    const fvi_system *system[FVI_MOST_LANES];
    void *potential, *force;
} fvi_lanes;

/* fvi_lanes_prepare -- Prepare potential and force. The caller has set count and system. Return
 * FVI_SUCCESS or FVI_ENOMEM.
 * fvi_lanes_discard -- Free potential and force. */
int fvi_lanes_prepare(fvi_lanes *lanes);
void fvi_lanes_discard(fvi_lanes *lanes);

/* fvi_lanes_potential, fvi_lanes_force -- Return the potential and the force of the common system. Its U is the sum of
 * the potentials of the lanes. Either all lanes have a potential or no lane has one. The same holds for forces. */
fvi_potential fvi_lanes_potential(fvi_lanes *lanes);
fvi_force fvi_lanes_force(fvi_lanes *lanes);

/* fvi_lanes_of -- Return the lanes of a common system. Return NULL if the system is not made of lanes, or if the lanes
 * have no potential. */
extern const fvi_lane_functions fvi_lanes_together;
static inline const fvi_lanes *fvi_lanes_of(const fvi_system *system)
{
    return system->potential.lanes == &fvi_lanes_together ? system->potential.params : NULL;
}

/* fvi_lanes_slopes -- Compute U' and U'' of each active lane.
 *
 *   x       FVI_MOST_LANES numbers
 *   active  FVI_MOST_LANES numbers, 0 or 1
 *   g, H    outputs, FVI_MOST_LANES numbers each; H may be NULL
 *
 * Return FVI_SUCCESS, or the code that a potential returned. */
int fvi_lanes_slopes(const fvi_lanes *lanes, const double *x, const double *active,
                     double *g, double *H);

#endif
