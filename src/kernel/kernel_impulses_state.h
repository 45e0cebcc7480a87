/* src/kernel/kernel_impulses_state.h -- What the impulses of a kernel are made of.  [H 26] */
#ifndef FVI_KERNEL_IMPULSES_STATE_H
#define FVI_KERNEL_IMPULSES_STATE_H

#include "kernel_impulses.h"
#include "laplace_parabola.h"

#include <fvi/past.h>

enum { NODES = FVI_PARABOLA_NODES, SPAN = FVI_PARABOLA_SPAN, EXACT = 64 };

/* Kernels like a fraction with 2 alpha > 1 have poles off the cut: one and its conjugate. */
enum { MOST_POLES = 16, MOST_IMPULSES = FVI_KERNEL_IMPULSE_NODES };

/* A pole s of C(s), with its residue. Of a derivative of C the pole moves: it gives the residue
 * times (part + moves s G'/G), where G(s) is what stands beside C in the integral, and `moves` is
 * the derivative of ln s. */
typedef struct {
    double complex s, residue, part, moves;
} pole;

struct fvi_impulses_of_kernel {
    fvi_symbol_function *symbol;
    const void *of;
    double h;
    size_t first, count, k;        /* the parabola is that of k from `first` on; the last k */
    size_t poles;
    pole pole[MOST_POLES];
    size_t n;                      /* impulses of a step: 2 at its ends, or one for each stage */
    double c[FVI_KERNEL_IMPULSE_NODES]; /* the stages; not read of ends */
    int at_stages;
    double start[MOST_IMPULSES]; /* of step 0 */
    double complex s[NODES + MOST_POLES], weight[NODES + MOST_POLES][MOST_IMPULSES],
        line[NODES + MOST_POLES][2], /* the weight of step k is weight + k line */
        step[NODES + MOST_POLES], power[NODES + MOST_POLES]; /* e^{s h}, e^{s k h} */
};

/* fvi_stage_moments -- int_0^1 l_i(u) e^{zu} du of all stages: |z| < 50. */
void fvi_stage_moments(const fvi_impulses_of_kernel *o, double complex z,
                       double complex *w);

#endif
