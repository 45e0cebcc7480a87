/* src/reference/exact_vectors.h -- Compute complex functions of many numbers at once.        [H 11]
 *
 * Each function replaces z = re[i] + i im[i] for i < n by its value. Errors are in units of u |f(z)|, u = 2^-53. The
 * digits are the same on every processor. The arrays must not overlap. */
#ifndef FVI_EXACT_VECTORS_H
#define FVI_EXACT_VECTORS_H

#include <stddef.h>

/* fvi_vector_exp -- Compute e^z for |re| <= 700, |im| <= 10^4. Error: 6 u, seen 4.2 u. */
void fvi_vector_exp(size_t n, double *re, double *im);

/* fvi_vector_expm1 -- Compute e^z - 1, also for small z, in the same range. Error: 8 u. */
void fvi_vector_expm1(size_t n, double *re, double *im);

/* fvi_vector_log -- Compute ln |z| + i arg z for im > 0 and |z| from 10^-150 to 10^150. Error: 4 u of |ln |z|| + 1, and
 * 10 u of arg z. */
void fvi_vector_log(size_t n, double *re, double *im);

#endif
