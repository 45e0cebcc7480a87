/* src/stages/lobatto_history.h -- Compute the history of a fractional derivative on Lobatto nodes.    [H 17] */
#ifndef FVI_LOBATTO_HISTORY_H
#define FVI_LOBATTO_HISTORY_H

#include <fvi/damping_laws.h>
#include <fvi/memory.h>
#include <fvi/archive.h>
#include "lobatto_weights.h"

typedef struct fvi_lobatto_history fvi_lobatto_history;

/* fvi_lobatto_history_alloc -- Allocate a history of at most `steps` steps.
 *
 *     H_k = sum_{n=1}^{k} W_n v_{k-n},   v_k the s stages of step k   (17.9)
 *
 *   s, beta    as for fvi_lobatto_weights
 *   d          dimension, d >= 1
 *   steps      largest number of v_k that will be pushed
 *   by_order   nonzero: a history that also gives the derivatives of its sums by beta
 *   kind       DIRECT: sum with all W_n, O(N^2) time and O(N d) memory; MODES: sum with three W_n and Q modes, O(N Q)
 *              and O(Q d); AUTO: DIRECT up to 64 steps, else MODES
 *   tolerance  error of H_k if modes are used, relative to max|v| max(1, k^(-beta)): 0 for the default 1e-13, or
 *              1e-14 <= tolerance < 1
 *   memory     output; free it with fvi_lobatto_history_free
 *
 * For beta = 0 and beta = -1 no mode or one mode is enough, so they use modes whatever the kind. Their derivatives need
 * the full history.
 *
 * Return FVI_SUCCESS; FVI_EFAULT if memory is NULL; FVI_EINVAL if s is not in 2, ..., 8, if d = 0, if kind is unknown,
 * or if steps and d are too large to be addressed; FVI_EDOM if beta is not in [-1, 1] or tolerance is not in [0, 1);
 * FVI_ETOL if modes are used and 0 < tolerance < 1e-14; FVI_ENOMEM. On error *memory is unchanged. */
int fvi_lobatto_history_alloc(size_t s, double beta, size_t d, size_t steps,
                             fvi_history_kind kind, int by_order, double tolerance,
                             fvi_lobatto_history **memory);

/* fvi_lobatto_history_of_kernel -- Allocate a history for the W_n of a law (26.12), which include the step size. The
 * law has passed fvi_kernel_check. The codes are those of fvi_lobatto_history_alloc and fvi_lobatto_kernel_prepare,
 * FVI_EUNSUP if kind is MODES and the law has no modes, and the code of the interrupter (error.h). */
int fvi_lobatto_history_of_kernel(size_t s, const fvi_kernel *law, double h, size_t d,
                              size_t steps, fvi_history_kind kind,
                              double tolerance, fvi_lobatto_history **memory);

/* fvi_lobatto_history_bytes -- Return the number of bytes that fvi_lobatto_history_alloc will allocate and keep without
 * derivatives. The arguments are the same. The result is a double, because it may be too large to be addressed. Return
 * 0 if fvi_lobatto_history_alloc would refuse the arguments. */
double fvi_lobatto_history_bytes(size_t s, double beta, size_t d, size_t steps,
                                fvi_history_kind kind, double tolerance);

/* fvi_lobatto_history_copy -- Copy a history in its current state. Return FVI_SUCCESS or FVI_ENOMEM;
 * then *to is unchanged. */
int fvi_lobatto_history_copy(const fvi_lobatto_history *from,
                            fvi_lobatto_history **to);

/* fvi_lobatto_history_w0 -- Return W_0, entry (i, j) at [i * s + j], owned by the history. */
const double *fvi_lobatto_history_w0(const fvi_lobatto_history *memory);

/* fvi_lobatto_history_w0_by_order -- Return the derivative of W_0 by beta, owned by the history. The
 * history was made by_order. */
const double *fvi_lobatto_history_w0_by_order(const fvi_lobatto_history *memory);

/* fvi_lobatto_history_push -- Take in v_k, and compute H_{k+1} and its derivative by beta for fixed v. [(17.12),
 * (23.14)]
 *
 *   v     s d numbers: stage i of coordinate j at [j * s + i]
 *   H     output, ordered as v; may be v
 *   Hdot  NULL, or output: the derivative, ordered as H; only for a history that was made by_order
 *
 * H_0 is zero. The step size is not included: multiply H by h^(-beta). Cost: DIRECT O(k d s^2), MODES O(Q d s). Return
 * FVI_SUCCESS; FVI_EFAULT if memory, v or H is NULL; FVI_EINVAL after `steps` terms; FVI_EUNSUP if the history has no
 * derivatives. On error H is unchanged. */
int fvi_lobatto_history_push(fvi_lobatto_history *memory, const double *v, double *H, double *Hdot);

/* fvi_lobatto_history_archive -- Serialise the history as fvi_history_archive does. k is the number of terms. Return
 * FVI_EINVAL if the archive has another number of terms. */
int fvi_lobatto_history_archive(fvi_lobatto_history *memory, size_t k,
                             fvi_archive *archive);

/* fvi_lobatto_history_free -- Free the history. NULL is allowed. */
void fvi_lobatto_history_free(fvi_lobatto_history *memory);

#endif
