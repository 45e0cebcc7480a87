/* src/newton.h -- The one equation that a step has to solve.     [Chapter 2]
 *
 *     A d + s grad U(x + theta d) = r      for d in R^d,            (2.10)
 *
 * with A diagonal. Every integrator of this library meets the new position in
 * this form and no other: the start and the step of Algorithms 1, 2 and 3
 * (A = m/h, s = kappa h, theta = 1 - kappa) and the implicit Euler method. */
#ifndef FVI_NEWTON_H
#define FVI_NEWTON_H

#include "system.h"

typedef struct fvi_newton fvi_newton;

/* fvi_newton_alloc -- prepare (2.10) for one system.
 *
 *   system    d, potential; must outlive the solver
 *   A         d numbers, finite, > 0; copied
 *   s, theta  finite
 *   newton    output; free it with fvi_newton_free
 *
 * If s theta == 0 or there is no potential the equation is explicit, and no
 * matrix is made. If the Hessian is constant, A + s theta Hess U is factorised
 * here, once (GSL's LU). Else Newton's method, with the exact Hessian.
 * Memory O(d) if explicit or d == 1, else O(d^2).
 *
 * Returns GSL_SUCCESS; what fvi_system_check returns; GSL_EFAULT if A or newton
 * is NULL; GSL_EDOM if A, s or theta is out of range; GSL_ENOMEM; GSL_ESING if
 * the constant matrix is singular. On error *newton is untouched. */
int fvi_newton_alloc(const fvi_system *system, const double *A, double s,
                     double theta, fvi_newton **newton);

/* fvi_newton_solve -- one solution of (2.10).
 *
 *   x, r  d numbers each
 *   d     in: a guess (any finite numbers); out: the solution
 *   g     output: grad U(x + theta d), d numbers
 *
 * Stops when an update is below the rounding of the residual, or no longer
 * shrinks and is tiny against d, or below 16 ulp of x. Cost: explicit or quadratic,
 * two gradients and O(d^2); else two to four gradients, Hessians and
 * factorisations, O(d^3) each; GSL's factorisation takes d indices from the heap,
 * the only memory that a step asks for.
 *
 * Returns GSL_SUCCESS; GSL_EFAULT if a pointer is NULL; GSL_EMAXITER if 50
 * iterations were not enough; GSL_ESING if the Jacobian is singular. A value
 * that is not finite is not an error here: it comes back in d. */
int fvi_newton_solve(fvi_newton *newton, const double *x, const double *r,
                     double *d, double *g);

/* fvi_newton_free -- give everything back. NULL is allowed. */
void fvi_newton_free(fvi_newton *newton);

#endif
