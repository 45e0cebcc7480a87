/* tests/bench/peers/blocks.h -- Discrete convolutions, as they come.    [H 18] */
#ifndef BLOCKS_H
#define BLOCKS_H

#include <stddef.h>

/* blocks -- sum_{j=1}^{n-1} w_{n-j} g_j for n = 1, 2, ..., N, of d functions, while g is
 * still being made: directly while that is cheaper, else by FFT in blocks (E. Hairer,
 * Ch. Lubich, M. Schlichte, SIAM J. Sci. Stat. Comput. 6 (1985)).
 *
 *   w  w_0 ... w_N; kept by the caller until blocks_free
 *
 * blocks_alloc returns NULL if there is no memory. */
typedef struct blocks blocks;
blocks *blocks_alloc(const double *w, size_t N, size_t d);
void blocks_free(blocks *b);

/* blocks_sum -- the sums for n, d of them; n = 1, 2, ... each once, in order. Returns 0, or 1
 * if there is no memory. blocks_push gives g_n, n >= 1. */
int blocks_sum(blocks *b, size_t n, double *sum);
void blocks_push(blocks *b, size_t n, const double *g);

#endif
