/* tests/bench/fft_blocks.h -- Sum the history by convolutions in blocks whose lengths double. [H 12]
 *
 * The library has no FFT, because it is the fastest way at no number of steps. It is here to be measured against
 * the two ways of the library. */
#ifndef FFT_BLOCKS_H
#define FFT_BLOCKS_H

#include <stddef.h>

typedef struct fft_blocks fft_blocks;

/* fft_blocks_alloc -- prepare for the terms 0 ... steps of one coordinate, with the weights of order nu, 0 < nu
 * < 1. Returns NULL if there is no memory. */
fft_blocks *fft_blocks_alloc(double nu, size_t steps);
void fft_blocks_free(fft_blocks *b);

/* fft_blocks_push -- take in x_k, k = 0, 1, ..., steps. Returns sum_{n=0}^{k} w_n x_{k-n}. */
double fft_blocks_push(fft_blocks *b, double x);

/* fft_blocks_bytes -- the bytes that fft_blocks_alloc allocates. */
size_t fft_blocks_bytes(size_t steps);

#endif
