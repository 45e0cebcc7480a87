/* src/inverse/mirror_constant.h -- What a memory held at J_p leaves out.      [Chapter 23]
 *
 * Internal. The mirrored run begins at J_p; its memory should begin at zero, (23.3), and
 * takes in mu - J_p. What is left out is the memory of a constant, a sum of weights. */
#ifndef FVI_MIRROR_CONSTANT_H
#define FVI_MIRROR_CONSTANT_H

#include <fvi/convolution_quadrature.h>
#include <fvi/trajectory.h>

typedef struct {
    fvi_memory *memory;     /* of the number 1; NULL: no damping */
    double unit;            /* h^(1 - 2 alpha), or h w_0 of a law */
    double theta, before;   /* (23.7); the sum of the node before */
    int printed, has_begun; /* Algorithm 3 */
    size_t taps;            /* of a factor of the weights */
    double g[FVI_BDF2_TAPS], past[FVI_BDF2_TAPS];
} fvi_mirror_constant;

/* fvi_mirror_constant_start -- at node N.
 *
 *   method  its scheme is FVI_SCHEME_ALGORITHM_3, SHIFTED, BDF2 or STABLE
 *   run     with matrices
 *   c       output; in any case to be given back by fvi_mirror_constant_stop
 *
 * Returns FVI_SUCCESS, what fvi_memory_alloc and fvi_law_memory return. */
int fvi_mirror_constant_start(const fvi_method *method, const fvi_run *run,
                              fvi_mirror_constant *c);

/* fvi_mirror_constant_next -- for N, N - 1, ..., 0: by what of C J_p the momentum falls there
 * besides; a number.                                                   [(23.23)] */
int fvi_mirror_constant_next(fvi_mirror_constant *c, double *impulse);

void fvi_mirror_constant_stop(fvi_mirror_constant *c);

#endif
