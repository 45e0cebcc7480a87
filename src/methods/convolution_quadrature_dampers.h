/* src/methods/convolution_quadrature_dampers.h -- The dampers of a run of order 2.   [H 13]
 *
 * Internal: convolution_quadrature_methods.c takes the steps of what is started, copied and
 * saved here. */
#ifndef FVI_CONVOLUTION_QUADRATURE_DAMPERS_H
#define FVI_CONVOLUTION_QUADRATURE_DAMPERS_H

#include <fvi/convolution_quadrature.h>
#include "damping.h"
#include "initial_history_force.h"

/* One damper of a run, and what a step knows of it. */
typedef struct {
    fvi_damping *damping; /* its history; the method owns the first, which owns the next */
    double theta;         /* the part of its force that is that of the later end, (13.10) */
    double *H;            /* h^(2 alpha) D_k of each damped coordinate; */
    double *ahead;        /* that of the next step if x stands still */
    double g[FVI_BDF2_TAPS]; /* (13.11), (13.16) */
    size_t taps, place;      /* taps == 0: no factor */
    int increments;          /* are summed, and stand in past */
    double *past; /* rows of the last terms, the latest is number `place`, twice */
    fvi_initial_history_force history_force;
    double impulse[2]; /* of this step, at its ends (19.5) */
} fvi_cq_damper;

typedef struct {
    double kappa;
    double *r; /* right-hand side of the step, d numbers */
    fvi_damping *damping; /* NULL if nothing is damped */
    size_t count;         /* as many dampers with a history */
    fvi_cq_damper *each;
} fvi_cq_state;

/* fvi_cq_first_weight -- of z_{k+1} in H_{k+1}: w_0 = 1, times g_0. */
static inline double fvi_cq_first_weight(const fvi_cq_damper *o)
{
    return o->taps ? o->g[0] : 1;
}

/* Members of fvi_method: start, copy, serialize, stop and keep_dampers of the methods of order 2. */
int fvi_cq_start(fvi_stepper *s);
int fvi_cq_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_cq_serialize(fvi_stepper *s, fvi_archive *v);
void fvi_cq_stop(fvi_stepper *s);
int fvi_cq_keep_dampers(fvi_stepper *s);

#endif
