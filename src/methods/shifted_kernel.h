/* src/methods/shifted_kernel.h -- The corrected symbol of a law for fvi-shifted.  [H 26]
 *
 *     E(s) = C(s) + h s (s C'(s)/2 - theta C(s)),   theta = growth/2               (26.19)
 *
 * fvi-shifted computes D_k with Euler's weights of E and takes the mean (1 - theta) D_k + theta D_{k+1}. The result is
 * C to the order 2. For a single power E is C. */
#ifndef FVI_SHIFTED_KERNEL_H
#define FVI_SHIFTED_KERNEL_H

#include "kernel/kernel_terms.h"

/* A law at one step, with theta. It is the params of fvi_shifted_symbol. */
typedef struct {
    const fvi_kernel *law;
    double h, theta;
} fvi_shifted_kernel;

/* fvi_shifted_symbol -- Compute E, as the value of a fvi_kernel_function. For |s| > 100/h, which no weight sees, the
 * result is C, so that E grows as C does. */
void fvi_shifted_symbol(double re, double im, void *params, double *E_re,
                        double *E_im);

/* fvi_shifted_is_itself -- Return nonzero if E = C, that is, for a single power. NULL means a power. */
static inline int fvi_shifted_is_itself(const fvi_kernel *law)
{
    return !law || fvi_kernel_is_power(law);
}

#endif
