/* tests/discrete_mechanics/newton_solver.h -- A solver of (2.10), for the tests of H 2. */
#ifndef NEWTON_SOLVER_H
#define NEWTON_SOLVER_H

#include <fvi/error.h>
#include "harness/fvi_runs.h"
#include "harness/ulp.h"
#include "newton/newton.h"

#include <gsl/gsl_math.h>

static const double one[] = { 1, 1, 1, 1, 1 }, none[5];

static inline fvi_newton *solver(const fvi_system *system, const double *A,
                                 double s, double theta)
{
    fvi_newton *newton = NULL;
    ck_assert_int_eq(fvi_newton_alloc(system, A, s, theta, &newton), 0);
    return newton;
}

#endif
