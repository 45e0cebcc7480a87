/* src/reference/exact_motion_state.h -- Hold what an exact motion keeps.         [H 11]
 *
 * Internal to src/reference. */
#ifndef FVI_EXACT_MOTION_STATE_H
#define FVI_EXACT_MOTION_STATE_H

#include "frequency/dynamic_stiffness.h"
#include "kernel/laplace_parabola.h"

#include <fvi/exact_motion.h>

/* The sources of the motion: the start together with a cosine, and a constant force from a time on. */
typedef enum { BY_START, BY_STEP, SOURCES } source_kind;

/* Y(s) = Z(s)^-1 b(s) for one source: its poles in the upper half plane, and its values at the nodes of a parabola. */
typedef struct {
    double complex *pole, *residue; /* count poles; d residues for each; one block, which begins at pole */
    size_t count;
    double window; /* the parabola serves the times from `window` to FVI_PARABOLA_SPAN times `window`; 0: none yet */
    double complex *node_value; /* weight times Y at each node, d numbers for each */
} source;

struct fvi_exact_motion {
    size_t d;
    fvi_system system;
    fvi_response *response;
    fvi_poles poles; /* of Z^-1 */
    fvi_forcing forcing;
    double A, T, w; /* the force A on every unknown: until T for a step, A cos(w t) for a cosine */
    double *x0, *p0, *v0, *spring_force; /* d each, one block; spring_force is K x_0 */
    double complex *room;   /* d numbers */
    source source[SOURCES];
    fvi_parabola rule;      /* the parabola for the time that was asked for last */
    /* The next two are for the forces of dampers. They are made when forces are first asked for. */
    double *sum;      /* forces and then impulses, d for each damping; and d more */
    void *inertia;    /* factors of M, if the system has matrices */
};

/* The sums at a time, each NULL if it is not asked for: positions and velocities, d numbers each; force and impulse of
 * each damping of the response, d numbers each. */
typedef struct {
    double *x, *v, *force, *impulse;
} fvi_exact_sums;

/* fvi_exact_motion_sum -- Compute the sums of all sources at t >= 0. Force and impulse are added to what is there, and
 * only for t > 0. Return FVI_SUCCESS, or what the factors of Z return. */
int fvi_exact_motion_sum(fvi_exact_motion *motion, double t, const fvi_exact_sums *sums,
                         fvi_error *error);

/* fvi_exact_motion_add_dampers -- Add a node or pole s with the part a of Y to force and impulse of each damping: C(s)
 * B a and C(s) B a / s, times factor. Only the real parts count.                                          [(11.21)]
 * fvi_exact_motion_free_dampers -- Free what the forces keep. */
void fvi_exact_motion_add_dampers(const fvi_exact_motion *motion, const double complex *a,
                                  double complex s, double complex factor,
                                  const fvi_exact_sums *sums);
void fvi_exact_motion_free_dampers(fvi_exact_motion *motion);

#endif
