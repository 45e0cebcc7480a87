/* src/reference/exact_motion_state.h -- What an exact motion keeps.         [H 11]
 *
 * Internal to the room. */
#ifndef FVI_EXACT_MOTION_STATE_H
#define FVI_EXACT_MOTION_STATE_H

#include "frequency/dynamic_stiffness.h"
#include "kernel/laplace_parabola.h"

#include <fvi/exact_motion.h>

/* What moves the body: the start and a cosine, or a force that is 1/s. */
typedef enum { BY_START, BY_STEP, SOURCES } source_kind;

/* Y(s) = Z(s)^-1 b(s) of one source: its poles, and its values at the nodes of the times from
 * `from` to SPAN from. */
typedef struct {
    double complex *pole, *residue; /* count, and d each */
    size_t count;
    double from;
    double complex *at; /* d each of the nodes */
} source;

struct fvi_exact_motion {
    size_t d;
    fvi_system system;
    fvi_response *response;
    fvi_poles poles;
    fvi_forcing forcing;
    double A, T, w;
    double *x0, *p0, *v0, *spring_force; /* d each; spring_force is K x_0 */
    double complex *room;        /* d */
    source source[SOURCES];
    fvi_parabola rule;
    /* of the forces, made when they are first asked for */
    double *gradient; /* d of each damper along an elongation */
    double *sum;      /* force and impulse, d of each damping; and d more */
    void *inertia;    /* factors of M, of matrices */
};

/* What is summed at a time, each NULL if it is not asked for: places and velocities; and of each damping of the
 * response, d numbers, its force and its impulse. */
typedef struct {
    double *x, *v, *force, *impulse;
} fvi_exact_sums;

/* fvi_exact_motion_sum -- of all sources at t >= 0; force and impulse, at t > 0 alone, are added to what is there.
 * Returns FVI_SUCCESS, or what the factors of Z returned. */
int fvi_exact_motion_sum(fvi_exact_motion *motion, double t, const fvi_exact_sums *sums,
                         fvi_error *error);

/* fvi_exact_motion_add_dampers -- one node or pole s with the part a of Y: C(s) B a and C(s) B a / s, times factor,
 * of each damping.                                                              [(11.21)]
 * fvi_exact_motion_forget_dampers -- give back what the forces keep. */
void fvi_exact_motion_add_dampers(const fvi_exact_motion *motion, const double complex *a,
                                  double complex s, double complex factor,
                                  const fvi_exact_sums *sums);
void fvi_exact_motion_free_dampers(fvi_exact_motion *motion);

#endif
