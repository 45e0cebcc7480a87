/* src/exact/exact_vectors.h -- Complex exponentials, many at once.     [Chapter 11] */
#ifndef FVI_EXACT_VECTORS_H
#define FVI_EXACT_VECTORS_H

#include <stddef.h>

/* fvi_vector_exp -- exp(re[i] + i im[i]) in place of re[i] + i im[i].
 *
 *   n       how many
 *   re, im  |re[i]| <= 700, |im[i]| <= 10^6; no overlap
 *
 * Accuracy: 4 u |exp|, u = 2^-53; seen 1.9 u. The same digits on every processor. */
void fvi_vector_exp(size_t n, double *re, double *im);

#endif
