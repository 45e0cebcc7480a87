/* src/stages/lobatto_memory.h -- The history of a derivative on Lobatto nodes.
 *                                                               [Chapter 17] */
#ifndef FVI_LOBATTO_MEMORY_H
#define FVI_LOBATTO_MEMORY_H

#include <fvi/damping_laws.h>
#include <fvi/memory.h>
#include <fvi/visit.h>
#include "lobatto_weights.h"

typedef struct fvi_lobatto_memory fvi_lobatto_memory;

/* fvi_lobatto_memory_alloc -- prepare for the sums over at most `steps` steps.
 *
 *     H_k = sum_{n=1}^{k} W_n v_{k-n},   v_k the s stages of step k   (17.9)
 *
 *   s, beta    as fvi_lobatto_weights
 *   d          dimension, d >= 1
 *   steps      how many v_k will be pushed at most
 *   kind       DIRECT: with all W_n, O(N^2) time and O(N d) memory;
 *              EXPONENTIALS: three of them and Q modes, O(N Q) and O(Q d);
 *              AUTO: DIRECT up to 64 steps, else EXPONENTIALS. There is no FFT
 *   tolerance  where modes are used: 0 for the default 1e-13, or from 1e-14 to below 1:
 *              the errors of H_k, relative to max|v| max(1, k^(-beta))
 *   memory     output; free it with fvi_lobatto_memory_free
 *
 * beta = 0 and beta = -1 need no history: they take the place of EXPONENTIALS
 * with no mode and with one, whatever the kind.
 * Returns FVI_SUCCESS; FVI_EFAULT if memory is NULL; FVI_EINVAL if s is not
 * in 2, ..., 8, if d == 0, if kind is unknown, or if steps and d are too large to be
 * addressed; FVI_EUNSUP for FFT; FVI_EDOM if beta is not in [-1, 1] or tolerance
 * not in [0, 1); FVI_ETOL if EXPONENTIALS, asked for or taken by AUTO, would have to
 * keep less than 1e-14; FVI_ENOMEM. On error *memory is untouched. */
int fvi_lobatto_memory_alloc(size_t s, double beta, size_t d, size_t steps,
                             fvi_memory_kind kind, double tolerance,
                             fvi_lobatto_memory **memory);

/* fvi_lobatto_memory_alloc_rate -- one that gives the derivatives of its sums by beta,
 * too: fvi_lobatto_memory_push_rate. The same arguments and errors; beta = 0 and -1 do need
 * their history here. */
int fvi_lobatto_memory_alloc_rate(size_t s, double beta, size_t d, size_t steps,
                                  fvi_memory_kind kind, double tolerance,
                                  fvi_lobatto_memory **memory);

/* fvi_lobatto_memory_of_law -- as fvi_lobatto_memory_alloc for a law, with the W_n of (26.12);
 * the step size IS included. The law has passed fvi_law_check. Errors also those of
 * fvi_lobatto_law_of. */
int fvi_lobatto_memory_of_law(size_t s, const fvi_law *law, double h, size_t d,
                              size_t steps, fvi_memory_kind kind,
                              double tolerance, fvi_lobatto_memory **memory);

/* fvi_lobatto_memory_bytes -- what fvi_lobatto_memory_alloc will take from the heap
 * and keep. Arguments as there. A double, because it may be more than can be
 * addressed. Returns 0 where that would refuse. */
double fvi_lobatto_memory_bytes(size_t s, double beta, size_t d, size_t steps,
                                fvi_memory_kind kind, double tolerance);

/* fvi_lobatto_memory_copy -- the same memory again, at the same step.
 * Returns FVI_SUCCESS or FVI_ENOMEM; *to is then untouched. */
int fvi_lobatto_memory_copy(const fvi_lobatto_memory *from,
                            fvi_lobatto_memory **to);

/* fvi_lobatto_memory_now -- W_0, entry (i, j) at [i * s + j]. It belongs to the
 * memory. */
const double *fvi_lobatto_memory_now(const fvi_lobatto_memory *memory);

/* fvi_lobatto_memory_now_rate -- its derivative by beta; of a memory with rates. */
const double *fvi_lobatto_memory_now_rate(const fvi_lobatto_memory *memory);

/* fvi_lobatto_memory_push -- take in v_k, give out H_{k+1}.           [(17.12)]
 * H_0 is zero. The step size is NOT included: multiply by h^(-beta).
 *
 *   v  s d numbers: stage i of coordinate j at [j * s + i]
 *   H  output, as v, may be v
 *
 * Cost: DIRECT O(k d s^2), EXPONENTIALS O(Q d s).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL after `steps`
 * terms. On error H is untouched. */
int fvi_lobatto_memory_push(fvi_lobatto_memory *memory, const double *v,
                            double *H);

/* fvi_lobatto_memory_push_rate -- and give out dH_{k+1} / d beta, v held.   [(23.14)]
 * Hdot: output, as H; errors as above, and FVI_EUNSUP if the memory has no rates. */
int fvi_lobatto_memory_push_rate(fvi_lobatto_memory *memory, const double *v,
                                 double *H, double *Hdot);

/* fvi_lobatto_memory_visit -- as fvi_memory_visit; k is how many terms there are, which what
 * the visitor has written must say, too, or FVI_EINVAL. */
int fvi_lobatto_memory_visit(fvi_lobatto_memory *memory, size_t k,
                             fvi_visitor *visitor);

/* fvi_lobatto_memory_free -- give everything back. NULL is allowed. */
void fvi_lobatto_memory_free(fvi_lobatto_memory *memory);

#endif
