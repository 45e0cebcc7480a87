/* src/newton/newton.h -- The one equation that a step has to solve.     [H 2]
 *
 *     A d + s grad U(x + theta d) = r      for d in R^d,            (2.10)
 *
 * with A diagonal. Every integrator of this library meets the new position in
 * this form and no other: the start and the step of Algorithms 1, 2 and 3
 * (A = m/h, s = kappa h, theta = 1 - kappa) and the implicit Euler method; and the
 * integrators of H 17, several d at a time. */
#ifndef FVI_NEWTON_H
#define FVI_NEWTON_H

#include <fvi/system.h>

typedef struct fvi_newton fvi_newton;

/* fvi_newton_alloc -- prepare (2.10) for one system.
 *
 *   system    d, potential; must outlive the solver
 *   A         d numbers, finite, > 0; copied
 *   s, theta  finite
 *   newton    output; free it with fvi_newton_free
 *
 * If s theta == 0 or there is no potential the equation is explicit, and no
 * matrix is made. If U is quadratic, A + s theta Hess U is factorised here, once.
 * Else Newton's method, with the exact Hessian. The factors keep to the diagonals
 * of the Hessian, with room for exchanges of rows: U need not be convex.
 * Memory O(d) if explicit, O(d w) for 2 w - 1 diagonals, O(d^2) if it is full. Where
 * the potential solves for itself no matrix is made, and memory is O(d).
 *
 * Returns FVI_SUCCESS; what fvi_system_check returns; FVI_EFAULT if A or newton
 * is NULL; FVI_EDOM if A, s or theta is out of range; FVI_ENOMEM; FVI_ESING if
 * the constant matrix is singular; what the Hessian returned, if U is quadratic. On
 * error *newton is untouched. */
int fvi_newton_alloc(const fvi_system *system, const double *A, double s,
                     double theta, fvi_newton **newton);

/* fvi_newton_stages_alloc -- prepare the equations of q stages.       [(17.8)]
 *
 *     d_l + sum_{i=1}^{q} s_li o grad U(x + d_i) = r_l,   l = 1, ..., q
 *
 *   q  1 to 8
 *   s  d q^2 finite numbers: s_li of coordinate j at [(j * q + l) * q + i]; copied
 *
 * o is the product coordinate by coordinate: s couples the stages of one coordinate,
 * U the coordinates of one stage. With the stages of a coordinate beside each other
 * the matrix has q times as many diagonals as the Hessian.
 * Returns as fvi_newton_alloc, and FVI_EINVAL if q is out of range. */
int fvi_newton_stages_alloc(const fvi_system *system, size_t q, const double *s,
                            fvi_newton **newton);

/* fvi_newton_matrices_alloc -- prepare (2.10) with matrices:              [(27.3)]
 *
 *     (m M + sum_j c_j C_j) d + s K (x + theta d) = r
 *
 *   system    with matrices
 *   m         finite, > 0
 *   c         a number for C, or one for each of the dampers of the matrices, finite, >= 0;
 *             copied; NULL: no damping
 *   s, theta  finite
 *
 * The matrix of d is factorised here, once. Returns FVI_SUCCESS; FVI_EDOM if a number is out of
 * range; FVI_ENOMEM; what factorise returned. */
int fvi_newton_matrices_alloc(const fvi_system *system, double m, const double *c,
                              double s, double theta, fvi_newton **newton);

/* fvi_newton_solve -- one solution of (2.10), or of the equations of q stages.
 *
 *   x     d numbers
 *   r     q d numbers, stage after stage, as d and g; q = 1 in (2.10)
 *   d     in: a guess (any finite numbers); out: the solution
 *   g     output: grad U(x + theta d)
 *
 * Stops when what is left of each equation is within the rounding of its terms, and
 * takes one step more. If fifty steps do not do, or a Jacobian is singular, it begins
 * again at d = 0 and goes down A d' = r - A d - s grad U(x + theta d) with steps as
 * long as they may be. Which solution is found where there are several is not said.
 *
 * Cost: explicit or quadratic, two gradients, or one if the Hessian is constant and diagonal,
 * and the solution with the factors, O(d w) for 2 w - 1 diagonals, O(d^2) for a full one.
 * Else mostly two to five gradients, Hessians and factorisations, O(d w^2) or O(d^3) each,
 * or as many solutions by the potential itself; up to 1050, and twice as many gradients,
 * where Newton's method fails.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EMAXITER, or FVI_ESING if
 * it was a singular Jacobian that made it begin again, if no solution was found; what
 * the potential returned (these without a call of the error handler, as in
 * fvi_newton_alloc). A gradient that is not finite, or whose square is not, is no error
 * here: d is then not finite. */
int fvi_newton_solve(fvi_newton *newton, const double *x, const double *r,
                     double *d, double *g);

/* fvi_newton_diagonal -- A of (2.10) without matrices, d numbers that the solver keeps. */
const double *fvi_newton_diagonal(const fvi_newton *newton);

/* fvi_newton_copy -- a solver of its own for the same equation, factors included.
 * Returns FVI_SUCCESS or FVI_ENOMEM; *to is then untouched. */
int fvi_newton_copy(const fvi_newton *from, fvi_newton **to);

/* fvi_newton_free -- give everything back. NULL is allowed. */
void fvi_newton_free(fvi_newton *newton);

#endif
