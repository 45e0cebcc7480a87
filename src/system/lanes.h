/* src/system/lanes.h -- Oscillators that take their steps together.       [H 28]
 *
 * Internal: what batch.h makes of several runs. Each has one coordinate, and is a lane; the
 * lanes are the coordinates of one system. A vector of the processor has one number of
 * each of them. The digits of a lane are those of its own run. */
#ifndef FVI_LANES_H
#define FVI_LANES_H

#include <fvi/system.h>

/* As many as the widest vectors have doubles. Arrays of lanes have this length, and where
 * there are fewer lanes the numbers behind them are of no use. */
enum { FVI_MOST_LANES = 8 };

/* fvi_lane_functions -- a function of one number, U'(x) or F(t), for all lanes at once. The
 * parameters of the lanes may differ, and nothing else.
 *
 *   prepare   reads the parameters of `count` lanes. Returns FVI_SUCCESS; FVI_ENOMEM; or
 *             FVI_EUNSUP if the lanes differ in more
 *   evaluate  of each lane: f(x), and f'(x) to slope unless that is NULL. The time t of a force, which is its x, is
 *             the same in all lanes. What is not active, 0 there, may be left as it is; NULL: all lanes are
 *   discard   gives back what prepare made
 *   alone     NULL; or f(x) and f'(x) of one lane from its own params, where both at once take less time than
 *             one after the other */
typedef struct fvi_lane_functions {
    int (*prepare)(size_t count, void *const *params, void **prepared);
    void (*evaluate)(const void *prepared, const double *x, const double *active, double *f, double *slope);
    void (*discard)(void *prepared);
    void (*alone)(const void *params, double x, double *f, double *slope);
} fvi_lane_functions;

/* fvi_lane_pairs -- params that are two numbers, such as c and g, or a and w, for all lanes.
 * fvi_lane_pairs_prepare is a `prepare` that makes them; its `discard` is free. fvi_lane_numbers_prepare
 * is one for params that are one number, the first; the second is 0. */
typedef struct fvi_lane_pairs {
    double first[FVI_MOST_LANES], second[FVI_MOST_LANES];
    int has_one_second; /* is it the same in all lanes? */
} fvi_lane_pairs;

int fvi_lane_pairs_prepare(size_t count, void *const *params, void **prepared);
int fvi_lane_numbers_prepare(size_t count, void *const *params, void **prepared);

/* fvi_lanes -- the lanes of a system.
 *
 *   count    1 to FVI_MOST_LANES
 *   system   each has one coordinate; they must outlive the lanes
 *   potential, force  what prepare made; NULL: each lane is asked by itself */
typedef struct fvi_lanes {
    size_t count;
    const fvi_system *system[FVI_MOST_LANES];
    void *potential, *force;
} fvi_lanes;

/* fvi_lanes_prepare -- make potential and force for lanes whose count and systems are there.
 * Returns FVI_SUCCESS or FVI_ENOMEM. fvi_lanes_discard gives them back. */
int fvi_lanes_prepare(fvi_lanes *lanes);
void fvi_lanes_discard(fvi_lanes *lanes);

/* fvi_lanes_potential, fvi_lanes_force -- those of the system whose coordinates are the lanes. Its
 * U is the sum of theirs. Either all lanes have a potential or none; the same of forces. */
fvi_potential fvi_lanes_potential(fvi_lanes *lanes);
fvi_force fvi_lanes_force(fvi_lanes *lanes);

/* fvi_lanes_of -- the lanes that are the coordinates of this system; NULL of another one, and where
 * the lanes have no potential. */
extern const fvi_lane_functions fvi_lanes_together;
static inline const fvi_lanes *fvi_lanes_of(const fvi_system *system)
{
    return system->potential.lanes == &fvi_lanes_together ? system->potential.params : NULL;
}

/* fvi_lanes_slopes -- U' and U'' of the lanes that are active.
 *
 *   x, active  FVI_MOST_LANES numbers; active: 0 or 1
 *   g, H       outputs, FVI_MOST_LANES numbers; H may be NULL
 *
 * Returns FVI_SUCCESS, or what a potential returned. */
int fvi_lanes_slopes(const fvi_lanes *lanes, const double *x, const double *active,
                     double *g, double *H);

#endif
