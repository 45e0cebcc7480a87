/* src/methods/shifted_kernel.h -- What fvi-shifted puts in the place of a law.  [H 26]
 *
 *     E(s) = C(s) + h s (s C'(s)/2 - theta C(s)),   theta = growth/2               (26.19)
 *
 * Euler's weights of E, and the mean (1 - theta) D_k + theta D_{k+1} that the method takes of
 * what they give, are C to the order 2. Of one power E is C. */
#ifndef FVI_SHIFTED_KERNEL_H
#define FVI_SHIFTED_KERNEL_H

#include "kernel/kernel_terms.h"

/* A law at one step, with theta, as the params of fvi_shifted_symbol. */
typedef struct {
    const fvi_kernel *law;
    double h, theta;
} fvi_shifted_kernel;

/* fvi_shifted_symbol -- E, as the value of a fvi_kernel_function. Beyond 100/h, which no
 * weight sees, it is C, so that E grows as C does. */
void fvi_shifted_symbol(double re, double im, void *params, double *E_re,
                        double *E_im);

/* fvi_shifted_is_itself -- is E = C? So it is of one power, which NULL is, too. */
static inline int fvi_shifted_is_itself(const fvi_kernel *law)
{
    return !law || fvi_kernel_is_power(law);
}

#endif
