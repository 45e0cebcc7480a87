/* src/fvi/memory.h -- The history of a fractional derivative.       [H 12]
 *
 *     H_k = sum_{n=0}^{k} w_n x_{k-n},     w_n = (-1)^n binom(beta, n)   (12.1)
 *
 * for k = 0, 1, 2, ... as the x_k come in, in d dimensions. A sweep over starts,
 * dampings or forces at one beta can be d such systems in one memory. */
#ifndef FVI_MEMORY_H
#define FVI_MEMORY_H

#include "archive.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* How the sum is done. N is the number of steps, Q about 40 to 100 by default.
 *
 *   AUTO          what fvi_history_choose says
 *   DIRECT        the sum as it stands: O(N^2) time, O(N d) memory
 *   EXPONENTIALS  the last 32 terms and Q decaying modes: O(N Q), O(Q d); from d = 16 on
 *                 as products of matrices, with the same weights (H 28) */
typedef enum {
    FVI_HISTORY_AUTO,
    FVI_HISTORY_DIRECT,
    FVI_HISTORY_MODES,
} fvi_history_kind;

typedef struct fvi_history fvi_history;

/* fvi_history_alloc -- prepare for at most steps + 1 terms.     [(12.2), (12.6)]
 *
 *   beta   order of the derivative, 0 <= beta <= 2 (2 alpha for the damping)
 *   d      dimension, d >= 1
 *   steps  the last index k that will be pushed; at most 10^9 for EXPONENTIALS
 *   kind   how to sum
 *   tolerance  EXPONENTIALS: 0 for the default 1e-13, or from 1e-14 to below 1.
 *          Every weight that is replaced is kept to a relative error of
 *          tolerance / 10, and trajectories to tolerance max |x| as far as
 *          (12.14) says. The direct sum has only rounding errors.
 *   memory output; free it with fvi_history_free
 *
 * beta = 0, 1, 2 have 1, 2, 3 weights that are not zero: nothing is stored then
 * but the last term, whatever the kind. Cost, on the machine of memory_bench.tsv:
 * EXPONENTIALS 10 microseconds, DIRECT some 20 ns a step.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if memory is NULL; FVI_EINVAL if d == 0, if
 * kind is unknown, if steps and d are too large to be addressed, or beyond 10^9
 * steps of EXPONENTIALS; FVI_EDOM if beta is not in [0, 2] or tolerance not in
 * [0, 1); FVI_ETOL if EXPONENTIALS would have to keep less than 1e-14;
 * FVI_ENOMEM. On error *memory is untouched. */
int fvi_history_alloc(double beta, size_t d, size_t steps, fvi_history_kind kind,
                     double tolerance, fvi_history **memory);

/* fvi_history_choose -- what AUTO stands for: DIRECT up to 256 steps, where its weights are
 * exact and it is the faster one or loses microseconds (figures/memory/memory_bench.tsv),
 * and where no memory is needed; else EXPONENTIALS. */
fvi_history_kind fvi_history_choose(double beta, size_t steps);

/* fvi_history_bytes -- what fvi_history_alloc will take from the heap. Arguments
 * as there. Returns 0 where that would refuse. */
size_t fvi_history_bytes(double beta, size_t d, size_t steps,
                        fvi_history_kind kind, double tolerance);

/* fvi_history_alloc_by_order -- a memory that also knows dH_k/d beta.          [(23.10)]
 *
 * Arguments, errors and what is promised of H: as fvi_history_alloc. The rate needs the
 * whole past even where beta is 0, 1 or 2 and H does not, so nothing is saved there.
 * Cost: DIRECT twice the time and the weights of fvi_history_alloc;
 * EXPONENTIALS reads the same modes a second time. */
int fvi_history_alloc_by_order(double beta, size_t d, size_t steps,
                          fvi_history_kind kind, double tolerance,
                          fvi_history **memory);

/* fvi_history_push_by_order -- take in x_k, give out H_k and its derivative by the order.
 *
 *     rate = sum_{n=1}^{k} (d w_n / d beta) x_{k-n}                       (23.10)
 *
 *   memory   made by fvi_history_alloc_by_order
 *   x, dx, H  as fvi_history_push
 *   rate      output, d numbers, none of the other arrays
 *
 * The powers of the step size are NOT included: d/d beta of h^(-beta) H is
 * h^(-beta) (rate - ln(h) H).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EUNSUP if the memory was
 * made by fvi_history_alloc; FVI_EINVAL after steps + 1 terms. On error H and rate are
 * untouched. */
int fvi_history_push_by_order(fvi_history *memory, const double *x, const double *dx,
                         double *H, double *rate);

/* fvi_history_push -- take in x_k, give out H_k.                        [(12.1)]
 * The step size is NOT included: the derivative is h^(-beta) H_k.
 *
 *   x   x_k, d numbers
 *   dx  x_k - x_{k-1}, d numbers; x_0 for k = 0
 *   H   output, d numbers, may be x or dx
 *
 * Both are asked for because the sum is done on the one that rounds less: the
 * increments with weights of order beta - 1 where beta >= 1 (an identity, as
 * (1-z)^beta = (1-z)^(beta-1) (1-z)), the positions where beta < 1.
 * Cost: DIRECT O(k d), EXPONENTIALS O(Q d).
 * From d = 16 on every 32nd push of EXPONENTIALS does nine tenths of the work of 32.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL after
 * steps + 1 terms. On error H is untouched. */
int fvi_history_push(fvi_history *memory, const double *x, const double *dx,
                    double *H);

/* fvi_history_ahead -- H_{k+1} as it will be if x_{k+1} = x_k.          [(12.1)]
 *
 *     H_{k+1} = ahead + (x_{k+1} - x_k)      for any x_{k+1}, as w_0 = 1:
 *
 * for a step whose equation contains H_{k+1}. Nothing is taken in.
 *
 *   x      x_k, the last that was pushed, d numbers (zeros before the first)
 *   ahead  output, d numbers, may be x
 *
 * Cost: none for EXPONENTIALS up to d = 15, then at most 7 d products; DIRECT O(k d).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL after
 * steps + 1 terms. On error ahead is untouched. */
int fvi_history_ahead(const fvi_history *memory, const double *x, double *ahead);

/* fvi_history_copy -- the same memory again, at the same term: both go on with the same
 * digits, and neither knows of the other.
 *
 *   from  a memory
 *   to    output; free it with fvi_history_free
 *
 * Cost: as many bytes as fvi_history_bytes says are copied.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_ENOMEM. On error *to is
 * untouched. */
int fvi_history_copy(const fvi_history *from, fvi_history **to);

/* fvi_history_archive -- show the terms that came in, or what is left of them, to a visitor; as
 * fvi_stepper_archive (trajectory.h). Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL;
 * FVI_EINVAL if what was loaded has more terms than this memory was made for, or not the
 * same number everywhere: free the memory then; what the visitor returns. */
int fvi_history_archive(fvi_history *memory, fvi_archive *archive);

/* fvi_history_free -- give everything back. NULL is allowed. */
void fvi_history_free(fvi_history *memory);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
