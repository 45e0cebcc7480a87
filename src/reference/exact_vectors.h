/* src/reference/exact_vectors.h -- Complex functions, many at once.        [H 11]
 *
 * z = re[i] + i im[i] for i < n is replaced by a function of it. Accuracy is in u |f(z)|,
 * u = 2^-53; the digits are the same on every processor. Arrays do not overlap. */
#ifndef FVI_EXACT_VECTORS_H
#define FVI_EXACT_VECTORS_H

#include <stddef.h>

/* fvi_vector_exp -- e^z; |re| <= 700, |im| <= 10^4. Error: 6 u, seen 4.2 u. */
void fvi_vector_exp(size_t n, double *re, double *im);

/* fvi_vector_expm1 -- e^z - 1, also where z is small; as above. Error: 8 u. */
void fvi_vector_expm1(size_t n, double *re, double *im);

/* fvi_vector_log -- ln |z| + i arg z; im > 0, |z| from 10^-150 to 10^150. Error: 4 u of
 * |ln |z|| + 1, and 10 u of arg z. */
void fvi_vector_log(size_t n, double *re, double *im);

#endif
