/* tests/bench/peers/blocks.h -- Discrete convolutions of functions that are still being made. [H 18] */
#ifndef BLOCKS_H
#define BLOCKS_H

#include <stddef.h>

/* blocks -- sum_{j=1}^{n-1} w_{n-j} g_j for n = 1, 2, ..., N and d functions, while g is still being made. The
 * sum is direct as long as this is cheaper, and else by FFT in blocks (E. Hairer, Ch. Lubich, M. Schlichte,
 * SIAM J. Sci. Stat. Comput. 6 (1985)).
 *
 *   w  w_0 ... w_N; the caller keeps them until blocks_free
 *
 * blocks_alloc returns NULL if there is no memory. */
typedef struct blocks blocks;
blocks *blocks_alloc(const double *w, size_t N, size_t d);
void blocks_free(blocks *b);

/* blocks_sum -- compute the d sums for n. Call it for n = 1, 2, ..., once each and in order. Returns 0, or 1 if
 * there is no memory. blocks_push hands over g_n, n >= 1. */
int blocks_sum(blocks *b, size_t n, double *sum);
void blocks_push(blocks *b, size_t n, const double *g);

#endif
