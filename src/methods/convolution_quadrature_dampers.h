/* src/methods/convolution_quadrature_dampers.h -- The dampers in a run by a method of order 2.   [H 13]
 *
 * This header is internal. convolution_quadrature_dampers.c starts, copies and archives the state;
 * convolution_quadrature_methods.c takes the steps. */
#ifndef FVI_CONVOLUTION_QUADRATURE_DAMPERS_H
#define FVI_CONVOLUTION_QUADRATURE_DAMPERS_H

#include <fvi/convolution_quadrature.h>
#include "damping.h"
#include "initial_history_force.h"

/* One damper of a run and its state during a step. */
typedef struct {
    /* the history of the damper; the method owns the first history, and each history owns the next one */
    fvi_damping *damping;
    double theta;            /* weight of D_{k+1} in the force of step k, (13.10) */
    double *H;               /* h^(2 alpha) D_k of each damped coordinate */
    double *ahead;           /* H of the next step if x_{k+1} = x_k */
    double g[FVI_BDF2_TAPS]; /* factor of the weights (13.11), (13.16) */
    size_t taps, place;      /* taps: length of g, 0 if there is no factor; place: newest row in `past` */
    /* a ring of the last `taps` terms of the history (increments if it sums increments), stored twice; the newest term
     * is row `place` */
    double *past;
    fvi_initial_history_force history_force;
    double impulse[2]; /* the impulses of the initial history at the two ends of the step (19.5) */
} fvi_cq_damper;

typedef struct {
    double *r;            /* right-hand side of the step, d numbers */
    fvi_damping *damping; /* the first history; NULL if nothing is damped */
    size_t count;         /* number of dampers with a history */
    fvi_cq_damper *each;
} fvi_cq_state;

/* fvi_cq_first_weight -- Return the weight of z_{k+1} in H_{k+1}: w_0 = 1 times g_0, or 1 without a factor. */
static inline double fvi_cq_first_weight(const fvi_cq_damper *o)
{
    return o->taps ? o->g[0] : 1;
}

/* The members start, copy, serialize and stop of the methods of order 2 (fvi_method). */
int fvi_cq_start(fvi_stepper *s);
int fvi_cq_copy(const fvi_stepper *from, fvi_stepper *to);
int fvi_cq_serialize(fvi_stepper *s, fvi_archive *v);
void fvi_cq_stop(fvi_stepper *s);

#endif
