/* tests/bench/peers/radau_algebra.h -- Small matrices in long double.   [H 18] */
#ifndef RADAU_ALGEBRA_H
#define RADAU_ALGEBRA_H

#include "radau_tables.h"

#include <complex.h>

typedef long double complex number;
typedef number matrix[RADAU_STAGES][RADAU_STAGES];

/* radau_divide -- x = B^{-1} x for n columns, by Gauss's elimination with exchanges of rows. B is overwritten. */
void radau_divide(int s, matrix B, int n, matrix x);

/* radau_eigenvalues -- compute all s eigenvalues of M, which must be different. */
void radau_eigenvalues(int s, matrix M, number *lambda);

/* radau_projector -- compute P = prod_{j != i} (M - lambda_j) / (lambda_i - lambda_j). */
void radau_projector(int s, matrix M, const number *lambda, int i, matrix P);

#endif
