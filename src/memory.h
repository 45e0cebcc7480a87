/* src/memory.h -- The history of a fractional derivative.       [Chapter 12]
 *
 *     H_k = sum_{n=0}^{k} w_n x_{k-n},     w_n = (-1)^n binom(beta, n)
 *
 * for k = 0, 1, 2, ... as the x_k come in, in d dimensions. */
#ifndef FVI_MEMORY_H
#define FVI_MEMORY_H

#include <stddef.h>

/* How the sum is done. AUTO takes the cheapest that keeps the tolerance. */
typedef enum {
    FVI_MEMORY_AUTO,
    FVI_MEMORY_DIRECT, /* the sum as it stands: O(N^2) time, O(N d) memory */
    FVI_MEMORY_FFT,    /* blocks of convolutions: O(N log^2 N), O(N d) */
    FVI_MEMORY_EXPONENTIALS, /* a window and decaying modes: O(N Q), O(Q d) */
} fvi_memory_kind;

typedef struct fvi_memory fvi_memory;

/* fvi_memory_alloc -- prepare for at most steps + 1 terms.
 *
 *   beta   order of the derivative, 0 <= beta <= 2 (2 alpha for the damping)
 *   d      dimension, d >= 1
 *   steps  the last index k that will be pushed
 *   kind   how to sum
 *   tolerance  of the compressed memory, relative to the direct sum; 0 means
 *          the default 1e-13
 *   memory output; free it with fvi_memory_free
 *
 * beta = 0, 1, 2 have 1, 2, 3 weights that are not zero: nothing is stored then
 * but the last term, whatever the kind. Else memory O(steps d), and the weights
 * once for all d dimensions.
 *
 * Returns GSL_SUCCESS; GSL_EFAULT if memory is NULL; GSL_EINVAL if d == 0, if
 * kind is unknown, or if steps and d are too large to be addressed; GSL_EDOM if
 * beta is not in [0, 2]; GSL_ENOMEM. On error *memory is untouched. */
int fvi_memory_alloc(double beta, size_t d, size_t steps, fvi_memory_kind kind,
                     double tolerance, fvi_memory **memory);

/* fvi_memory_push -- take in x_k, give out H_k. The step size is NOT included:
 * the derivative is h^(-beta) H_k.
 *
 *   x   x_k, d numbers
 *   dx  x_k - x_{k-1}, d numbers; x_0 for k = 0
 *   H   output, d numbers, may be x or dx
 *
 * Both are asked for because the sum is done on the one that rounds less: the
 * increments with weights of order beta - 1 where beta >= 1 (an identity, as
 * (1-z)^beta = (1-z)^(beta-1) (1-z)), the positions where beta < 1.
 * Cost O(k d).
 *
 * Returns GSL_SUCCESS; GSL_EFAULT if a pointer is NULL; GSL_EINVAL after
 * steps + 1 terms. */
int fvi_memory_push(fvi_memory *memory, const double *x, const double *dx,
                    double *H);

/* fvi_memory_free -- give everything back. NULL is allowed. */
void fvi_memory_free(fvi_memory *memory);

#endif
