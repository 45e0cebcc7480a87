/* src/stages/variable_table.h -- Compute a(mu) for many modes.                 [H 22] */
#ifndef FVI_VARIABLE_TABLE_H
#define FVI_VARIABLE_TABLE_H

#include "variable_rule.h"

/* The lattice points are mu = exp(FVI_SPACING j), j = FVI_FIRST, ..., FVI_FIRST + FVI_POINTS - 1. */
enum { FVI_FIRST = -280, FVI_POINTS = 456 };

/* The coefficients of a row of modes. Entry i of a(mu_q) is at a[i * stride + q]. */
typedef struct {
    const double *mu, *p, *a;
    size_t stride;
} fvi_mode_row;

/* fvi_mode_row_make -- Compute a and p for n values of mu. (22.8)
 *
 *     a_i = numerator_i(mu) / det(mu),   p = mu b.a
 *
 *   n     a multiple of FVI_LANES
 *   mu    n numbers, 0 <= mu < 1e30
 *   p, a  outputs, n and s * n numbers, stride n
 *
 * Accuracy: 1e-15 of max(1, mu) a (no proof; tested). Cost: O(n s^2). */
void fvi_mode_row_make(const fvi_variable_rule *rule, size_t n,
                       const double *mu, double *p, double *a);

/* fvi_mode_table -- Return the row of all lattice points for a rule, or NULL if memory is short. The first call
 * computes the table, 36 kB, and the process keeps it. If several threads call at the same time, each computes a table,
 * and all but one free theirs. So there is no lock, and a table never changes after it was returned.
 *
 *   every  1: point FVI_FIRST + j at index j; 2: first the points with even j, then those with odd j */
const fvi_mode_row *fvi_mode_table(const fvi_variable_rule *rule, size_t every);

#endif
