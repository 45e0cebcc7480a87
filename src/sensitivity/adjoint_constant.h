/* src/sensitivity/adjoint_constant.h -- What a memory held at J_p leaves out.      [H 23]
 *
 * Internal. The mirrored run begins at J_p; its memory should begin at zero, (23.3), and
 * takes in mu - J_p. What is left out is the memory of a constant, a sum of weights. */
#ifndef FVI_ADJOINT_CONSTANT_H
#define FVI_ADJOINT_CONSTANT_H

#include <fvi/convolution_quadrature.h>
#include <fvi/trajectory.h>

typedef struct {
    fvi_history *memory;     /* of the number 1; NULL: no damping */
    double unit;            /* h^(1 - 2 alpha), or h w_0 of a law */
    double theta, before;   /* (23.7); the sum of the node before */
    int paper_convention, has_begun; /* Algorithm 3 */
    size_t taps;            /* of a factor of the weights */
    double g[FVI_BDF2_TAPS], past[FVI_BDF2_TAPS];
} fvi_adjoint_constant;

/* fvi_adjoint_constant_start -- at node N.
 *
 *   method  its scheme is FVI_SCHEME_FVI, SHIFTED, BDF2 or STABLE
 *   run     with matrices
 *   c       output; in any case to be given back by fvi_adjoint_constant_stop
 *
 * Returns FVI_SUCCESS, what fvi_history_alloc and fvi_kernel_history return. */
int fvi_adjoint_constant_start(const fvi_method *method, const fvi_run *run,
                              fvi_adjoint_constant *c);

/* fvi_adjoint_constant_next -- for N, N - 1, ..., 0: by what of C J_p the momentum falls there
 * besides; a number.                                                   [(23.23)] */
int fvi_adjoint_constant_next(fvi_adjoint_constant *c, double *impulse);

void fvi_adjoint_constant_stop(fvi_adjoint_constant *c);

#endif
