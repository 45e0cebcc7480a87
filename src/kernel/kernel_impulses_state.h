/* src/kernel/kernel_impulses_state.h -- The data of the impulses of a kernel.  [H 26] */
#ifndef FVI_KERNEL_IMPULSES_STATE_H
#define FVI_KERNEL_IMPULSES_STATE_H

#include "kernel_impulses.h"
#include "laplace_parabola.h"

#include <fvi/past.h>

enum { NODES = FVI_PARABOLA_NODES, SPAN = FVI_PARABOLA_SPAN, EXACT = 64 };

/* A fraction with 2 below > 1 has a pair of conjugate poles off the cut, and a law that the program reads has up to 64
 * terms (FVI_MOST_TERMS in fvi/parse.h). */
enum { MOST_POLES = 64, MOST_IMPULSES = FVI_KERNEL_IMPULSE_NODES };

/* A pole s of C(s) and its residue. If C is a derivative by a parameter, the pole moves with the parameter. Then it
 * contributes the residue times (part + moves s G'/G), where G(s) is the other factor in the integral, and `moves` is
 * the derivative of ln s by the parameter. */
typedef struct {
    double complex s, residue, part, moves;
} pole;

struct fvi_impulses_of_kernel {
    fvi_symbol_function *symbol;
    const void *of;
    double h;
    /* first: the parabola serves the steps from `first` on; k: the last step that was computed */
    size_t first, count, k;
    size_t poles;
    pole pole[MOST_POLES];
    size_t n;                           /* impulses of a step: 2 at its ends, or one for each stage */
    double c[FVI_KERNEL_IMPULSE_NODES]; /* the stages; not used for the ends of a step */
    int at_stages;
    double start[MOST_IMPULSES]; /* the impulses of step 0, for stages */
    double complex s[NODES + MOST_POLES], weight[NODES + MOST_POLES][MOST_IMPULSES],
        line[NODES + MOST_POLES][2], /* for a moving pole the weight of step k is weight + k line */
        step[NODES + MOST_POLES], power[NODES + MOST_POLES]; /* e^{s h} and e^{s k h} */
};

/* fvi_inverse_nodes -- Compute the inverse transform of C(s) for the times from t to SPAN t: it is the real part of the
 * sum of weight_j e^{s_j t} over the nodes of the parabola, followed by the poles off the cut. Return their number. */
size_t fvi_inverse_nodes(const fvi_impulses_of_kernel *o, double t, double complex *s, double complex *weight);

/* fvi_stage_moments -- Compute int_0^1 l_i(u) e^{zu} du for all stages i, |z| < 50. */
void fvi_stage_moments(const fvi_impulses_of_kernel *o, double complex z,
                       double complex *w);

#endif
