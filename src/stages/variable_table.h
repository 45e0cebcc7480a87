/* src/stages/variable_table.h -- a(mu) of many modes.                 [H 22] */
#ifndef FVI_VARIABLE_TABLE_H
#define FVI_VARIABLE_TABLE_H

#include "variable_rule.h"

/* Lattice points: mu = exp(FVI_SPACING j), j from FVI_FIRST on, FVI_POINTS of them. */
enum { FVI_FIRST = -280, FVI_POINTS = 456 };

/* The coefficients of a row of modes: entry i of a(mu_q) at a[i * stride + q]. */
typedef struct {
    const double *mu, *p, *a;
    size_t stride;
} fvi_mode_row;

/* fvi_mode_row_make -- a and p of n values of mu.                              (22.8)
 *
 *     a_i = numerator_i(mu) / det(mu),   p = mu b.a
 *
 *   n     a multiple of FVI_LANES     mu  n numbers, 0 <= mu < 1e30
 *   p, a  outputs, n and s * n numbers, stride n
 *
 * Accuracy 1e-15 of max(1, mu) a (no proof; tested). Cost O(n s^2). */
void fvi_mode_row_make(const fvi_variable_rule *rule, size_t n,
                       const double *mu, double *p, double *a);

/* fvi_mode_table -- the row of all lattice points for a rule; NULL: no memory. It is made
 * when it is first asked for, 36 kB, and kept until the process ends. Threads that ask at
 * the same time make it each, and all but one give theirs back: no lock, and what has
 * been read never changes.
 *
 *   every  1: point FVI_FIRST + j at j; 2: those with even j first, then those with odd j */
const fvi_mode_row *fvi_mode_table(const fvi_variable_rule *rule, size_t every);

#endif
