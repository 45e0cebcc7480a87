/* src/stages/lobatto_history.h -- The history of a derivative on Lobatto nodes.
 *                                                               [H 17] */
#ifndef FVI_LOBATTO_HISTORY_H
#define FVI_LOBATTO_HISTORY_H

#include <fvi/damping_laws.h>
#include <fvi/memory.h>
#include <fvi/archive.h>
#include "lobatto_weights.h"

typedef struct fvi_lobatto_history fvi_lobatto_history;

/* fvi_lobatto_history_alloc -- prepare for the sums over at most `steps` steps.
 *
 *     H_k = sum_{n=1}^{k} W_n v_{k-n},   v_k the s stages of step k   (17.9)
 *
 *   s, beta    as fvi_lobatto_weights
 *   d          dimension, d >= 1
 *   steps      how many v_k will be pushed at most
 *   kind       DIRECT: with all W_n, O(N^2) time and O(N d) memory;
 *              EXPONENTIALS: three of them and Q modes, O(N Q) and O(Q d);
 *              AUTO: DIRECT up to 64 steps, else EXPONENTIALS
 *   tolerance  where modes are used: 0 for the default 1e-13, or from 1e-14 to below 1:
 *              the errors of H_k, relative to max|v| max(1, k^(-beta))
 *   memory     output; free it with fvi_lobatto_history_free
 *
 * beta = 0 and beta = -1 need no history: they take the place of EXPONENTIALS
 * with no mode and with one, whatever the kind.
 * Returns FVI_SUCCESS; FVI_EFAULT if memory is NULL; FVI_EINVAL if s is not
 * in 2, ..., 8, if d == 0, if kind is unknown, or if steps and d are too large to be
 * addressed; FVI_EDOM if beta is not in [-1, 1] or tolerance
 * not in [0, 1); FVI_ETOL if EXPONENTIALS, asked for or taken by AUTO, would have to
 * keep less than 1e-14; FVI_ENOMEM. On error *memory is untouched. */
int fvi_lobatto_history_alloc(size_t s, double beta, size_t d, size_t steps,
                             fvi_history_kind kind, double tolerance,
                             fvi_lobatto_history **memory);

/* fvi_lobatto_history_alloc_by_order -- one that gives the derivatives of its sums by beta,
 * too: fvi_lobatto_history_push_by_order. The same arguments and errors; beta = 0 and -1 do need
 * their history here. */
int fvi_lobatto_history_alloc_by_order(size_t s, double beta, size_t d, size_t steps,
                                  fvi_history_kind kind, double tolerance,
                                  fvi_lobatto_history **memory);

/* fvi_lobatto_history_of_kernel -- as fvi_lobatto_history_alloc for a law, with the W_n of (26.12);
 * the step size IS included. The law has passed fvi_kernel_check. Errors also those of
 * fvi_lobatto_kernel_prepare. */
int fvi_lobatto_history_of_kernel(size_t s, const fvi_kernel *law, double h, size_t d,
                              size_t steps, fvi_history_kind kind,
                              double tolerance, fvi_lobatto_history **memory);

/* fvi_lobatto_history_bytes -- what fvi_lobatto_history_alloc will take from the heap
 * and keep. Arguments as there. A double, because it may be more than can be
 * addressed. Returns 0 where that would refuse. */
double fvi_lobatto_history_bytes(size_t s, double beta, size_t d, size_t steps,
                                fvi_history_kind kind, double tolerance);

/* fvi_lobatto_history_copy -- the same memory again, at the same step.
 * Returns FVI_SUCCESS or FVI_ENOMEM; *to is then untouched. */
int fvi_lobatto_history_copy(const fvi_lobatto_history *from,
                            fvi_lobatto_history **to);

/* fvi_lobatto_history_now -- W_0, entry (i, j) at [i * s + j]. It belongs to the
 * memory. */
const double *fvi_lobatto_history_now(const fvi_lobatto_history *memory);

/* fvi_lobatto_history_now_by_order -- its derivative by beta; of a memory with rates. */
const double *fvi_lobatto_history_now_by_order(const fvi_lobatto_history *memory);

/* fvi_lobatto_history_push -- take in v_k, give out H_{k+1}.           [(17.12)]
 * H_0 is zero. The step size is NOT included: multiply by h^(-beta).
 *
 *   v  s d numbers: stage i of coordinate j at [j * s + i]
 *   H  output, as v, may be v
 *
 * Cost: DIRECT O(k d s^2), EXPONENTIALS O(Q d s).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL after `steps`
 * terms. On error H is untouched. */
int fvi_lobatto_history_push(fvi_lobatto_history *memory, const double *v,
                            double *H);

/* fvi_lobatto_history_push_by_order -- and give out dH_{k+1} / d beta, v held.   [(23.14)]
 * Hdot: output, as H; errors as above, and FVI_EUNSUP if the memory has no rates. */
int fvi_lobatto_history_push_by_order(fvi_lobatto_history *memory, const double *v,
                                 double *H, double *Hdot);

/* fvi_lobatto_history_archive -- as fvi_history_archive; k is how many terms there are, which what
 * the archive has written must say, too, or FVI_EINVAL. */
int fvi_lobatto_history_archive(fvi_lobatto_history *memory, size_t k,
                             fvi_archive *archive);

/* fvi_lobatto_history_free -- give everything back. NULL is allowed. */
void fvi_lobatto_history_free(fvi_lobatto_history *memory);

#endif
