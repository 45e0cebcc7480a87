/* tests/exact_solution/exact_problems.h -- What the tests of H 11 share. */
#ifndef EXACT_PROBLEMS_H
#define EXACT_PROBLEMS_H

#include <fvi/error.h>
#include <fvi/exact_solution.h>
#include "harness/ulp.h"

#include <gsl/gsl_math.h>

/* The bound of the header. For x = 1 the terms of the integral have
 * sum |term| <= 5.3, each within 30 u, and added from the small end they leave
 * partial sums of together at most 22 (eq_11_10_every_contour_inverts_powers):
 * (5.3 * 30 + 22) u. The residues, 40 u more: 221 u. Half as much again for the
 * problems whose terms cancel more than those of x = 1. */
#define TOL (320 * U)

static const double RHO = 0.2;

/* m = c = 1, rho = 1/5. */
static inline fvi_linear_oscillator oscillator(double alpha, int caputo, double x0,
                                    double v0)
{
    return (fvi_linear_oscillator){ .m = 1,
                         .c = 1,
                         .rho = RHO,
                         .alpha = alpha,
                         .past = caputo ? FVI_INITIAL_HISTORY_CAPUTO
                                        : FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE,
                         .x0 = x0,
                         .v0 = v0 };
}

static inline void solve(const fvi_linear_oscillator *p, double t, double *x, double *v)
{
    ck_assert_int_eq(fvi_exact_at(p, 1, &t, x, v, NULL), FVI_SUCCESS);
}

static inline double solve_x(fvi_linear_oscillator p, double t)
{
    double x = GSL_NAN;
    ck_assert_int_eq(fvi_exact_at(&p, 1, &t, &x, NULL, NULL), FVI_SUCCESS);
    return x;
}

#endif
