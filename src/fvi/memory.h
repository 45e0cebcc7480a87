/* src/fvi/memory.h -- The history of a fractional derivative: the weighted sum of all past positions.   [H 12]
 *
 *     H_k = sum_{n=0}^{k} w_n x_{k-n},     w_n = (-1)^n binom(beta, n)                               (12.1)
 *
 * for k = 0, 1, 2, ..., in d dimensions. The caller pushes x_0, x_1, ... one by one, and each push returns H_k.
 *
 *     fvi_history *memory;
 *     if (fvi_history_alloc(0.6, 1, N, FVI_HISTORY_AUTO, 0, &memory) == FVI_SUCCESS) {
 *         for (size_t k = 0; k <= N; k++)
 *             fvi_history_push(memory, &x[k], &dx[k], &H[k]);      // dx[k] = x[k] - x[k-1]
 *         fvi_history_free(memory);
 *     }
 *
 * One memory of dimension d can also hold d independent systems in one dimension with the same beta, for example a
 * sweep over starts, dampings or forces. */
#ifndef FVI_MEMORY_H
#define FVI_MEMORY_H

#include "archive.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_history_kind -- how the sum is computed. N is the number of steps.
 *
 *   AUTO    the kind that fvi_history_choose returns
 *   DIRECT  the sum as it stands: O(N^2 d) time, O(N d) memory
 *   MODES   the last 32 terms, and Q decaying modes for all earlier terms: O(N Q d) time, O(Q d) memory. Q is about
 *           40 to 100 for the default tolerance. From d = 16 on the modes are updated by products of matrices, with
 *           the same weights (H 28). The program and Python call this kind "exponentials" */
typedef enum {
    FVI_HISTORY_AUTO,
    FVI_HISTORY_DIRECT,
    FVI_HISTORY_MODES,
} fvi_history_kind;

typedef struct fvi_history fvi_history;

/* fvi_history_alloc -- Allocate a memory for at most steps + 1 terms.                        [(12.2), (12.6)]
 *
 *   beta   order of the derivative, 0 <= beta <= 2 (2 alpha for the damping)
 *   d      dimension, d >= 1
 *   steps  the last index k that will be pushed; at most 10^9 for MODES
 *   kind   how to sum
 *   tolerance  for MODES: 0 for the default 1e-13, or from 1e-14 to below 1. Every weight that the modes replace has
 *          a relative error of at most tolerance / 10. Trajectories then have an error of at most tolerance max |x|,
 *          under the conditions of (12.14). The direct sum has rounding errors only
 *   memory output; free it with fvi_history_free
 *
 * For beta = 0, 1, 2 only 1, 2, 3 weights are not zero. So the memory stores only the last term there, whatever the
 * kind. Cost, on the machine of figures/memory/memory_bench.tsv: 10 microseconds for MODES, some 20 ns for each step
 * for DIRECT.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if memory is NULL; FVI_EINVAL if d == 0, if kind is unknown, if steps and d are too
 * large to be addressed, or for more than 10^9 steps of MODES; FVI_EDOM if beta is not in [0, 2] or tolerance not in
 * [0, 1); FVI_ETOL for MODES with a tolerance above 0 and below 1e-14; FVI_ENOMEM. On error *memory is untouched. */
int fvi_history_alloc(double beta, size_t d, size_t steps, fvi_history_kind kind,
                     double tolerance, fvi_history **memory);

/* fvi_history_choose -- Return the kind that AUTO stands for, from beta and steps as above.
 *
 * It is DIRECT up to 256 steps, because the direct weights are exact and the direct sum is the faster one or loses
 * microseconds (figures/memory/memory_bench.tsv). It is DIRECT for beta = 0, 1, 2, too, where no past is stored. In
 * all other cases it is MODES. */
fvi_history_kind fvi_history_choose(double beta, size_t steps);

/* fvi_history_bytes -- Return the bytes that fvi_history_alloc takes from the heap for the same arguments; 0 if
 * it would refuse them. The error handler is called for such arguments. */
size_t fvi_history_bytes(double beta, size_t d, size_t steps,
                        fvi_history_kind kind, double tolerance);

/* fvi_history_alloc_by_order -- Allocate a memory that also computes the rate dH_k/d beta.           [(23.10)]
 *
 * Arguments, errors and the accuracy of H are those of fvi_history_alloc. For beta = 0, 1, 2 the rate depends on the
 * whole past, although H does not; so the memory stores the whole past there, too, and AUTO chooses the kind by steps
 * alone.
 * Cost: DIRECT takes twice the time and twice the weights of fvi_history_alloc; MODES reads the same modes a second
 * time. */
int fvi_history_alloc_by_order(double beta, size_t d, size_t steps,
                          fvi_history_kind kind, double tolerance,
                          fvi_history **memory);

/* fvi_history_push_by_order -- Add x_k to the history, and compute H_k and its derivative by the order.
 *
 *     rate = sum_{n=1}^{k} (d w_n / d beta) x_{k-n}                                                  (23.10)
 *
 *   memory    made by fvi_history_alloc_by_order
 *   x, dx, H  as fvi_history_push
 *   rate      output, d numbers; must not be one of the other arrays
 *
 * The powers of the step size are NOT included: the derivative of h^(-beta) H by beta is h^(-beta) (rate - ln(h) H).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EUNSUP if the memory was made by fvi_history_alloc;
 * FVI_EINVAL after steps + 1 terms. On error H and rate are untouched. */
int fvi_history_push_by_order(fvi_history *memory, const double *x, const double *dx,
                         double *H, double *rate);

/* fvi_history_push -- Add x_k to the history, and compute H_k.                                        [(12.1)]
 * The step size is NOT included: the derivative is h^(-beta) H_k.
 *
 *   x   x_k, d numbers
 *   dx  x_k - x_{k-1}, d numbers; x_0 for k = 0
 *   H   output, d numbers, may be x or dx
 *
 * The function takes both x and dx, because it sums the one with smaller rounding errors. Where beta < 1 it sums the
 * positions. Where beta >= 1 it sums the increments with the weights of order beta - 1; the sum is the same because
 * (1-z)^beta = (1-z)^(beta-1) (1-z).
 * Cost: DIRECT O(k d), MODES O(Q d). From d = 16 on every 32nd push of MODES does nine tenths of the work of 32
 * pushes.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL after steps + 1 terms. On error H is untouched. */
int fvi_history_push(fvi_history *memory, const double *x, const double *dx,
                    double *H);

/* fvi_history_ahead -- Compute the value that H_{k+1} will have if x_{k+1} = x_k.                      [(12.1)]
 *
 *     H_{k+1} = ahead + (x_{k+1} - x_k)      for every x_{k+1}, because w_0 = 1.
 *
 * A step needs this if its equation contains H_{k+1}. The history does not change.
 *
 *   x      x_k, the last position that was pushed, d numbers (zeros before the first push)
 *   ahead  output, d numbers, may be x
 *
 * Cost: MODES none up to d = 15, then at most 7 d products; DIRECT O(k d).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL after steps + 1 terms. On error ahead is
 * untouched. */
int fvi_history_ahead(const fvi_history *memory, const double *x, double *ahead);

/* fvi_history_copy -- Copy a memory, with all terms so far. Both memories go on with the same digits, independently
 * of each other.
 *
 *   from  a memory
 *   to    output; free it with fvi_history_free
 *
 * Cost: the copy of as many bytes as fvi_history_bytes returns.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_ENOMEM. On error *to is
 * untouched. */
int fvi_history_copy(const fvi_history *from, fvi_history **to);

/* fvi_history_archive -- Save or load the state of a memory: hand its pieces to the archive, as fvi_stepper_archive
 * (trajectory.h) does. The pieces are the terms so far, or the modes that replace them.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if the loaded state has more terms than this
 * memory was made for, or has different numbers of terms in its parts: then free the memory; or the code that the
 * archive returned. */
int fvi_history_archive(fvi_history *memory, fvi_archive *archive);

/* fvi_history_free -- Free the memory. NULL is allowed. */
void fvi_history_free(fvi_history *memory);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
