/* src/newton/newton.h -- Solve the equation of a time step.     [H 2]
 *
 *     A d + s grad U(x + theta d) = r      for d in R^d,            (2.10)
 *
 * with a diagonal matrix A. Every integrator of this library brings its step into this form. Examples are the start and
 * the step of Algorithms 1, 2 and 3 (A = m/h, s = kappa h, theta = 1 - kappa) and the implicit Euler method. The
 * integrators of H 17 solve for several d at a time. */
#ifndef FVI_NEWTON_H
#define FVI_NEWTON_H

#include <fvi/system.h>

typedef struct fvi_newton fvi_newton;

/* fvi_newton_alloc -- Allocate a solver of (2.10) for one system.
 *
 *   system    its d and its potential are used; it must outlive the solver
 *   A         d numbers, finite, > 0; copied
 *   s, theta  finite
 *   newton    output; free it with fvi_newton_free
 *
 * If s theta = 0 or there is no potential, the equation is explicit and needs no matrix. If U is quadratic, A + s theta
 * Hess U is factorised here, once. Otherwise fvi_newton_solve uses Newton's method with the exact Hessian. The factors
 * keep the band of the Hessian, with room for row exchanges, because U need not be convex. Memory: O(d) if the equation
 * is explicit or the potential has its own `solve`, because then there is no matrix; O(d w) for 2 w - 1 diagonals;
 * O(d^2) for a full Hessian.
 *
 * Return FVI_SUCCESS; the code of fvi_system_check; FVI_EFAULT if A or newton is NULL; FVI_EDOM if A, s or theta is out
 * of range; FVI_ENOMEM; FVI_ESING if the constant matrix is singular; the code of the Hessian, if U is quadratic. After
 * an error *newton is unchanged. */
int fvi_newton_alloc(const fvi_system *system, const double *A, double s,
                     double theta, fvi_newton **newton);

/* fvi_newton_stages_alloc -- Allocate a solver of the equations of q stages. [(17.8)]
 *
 *     d_l + sum_{i=1}^{q} s_li o grad U(x + d_i) = r_l,   l = 1, ..., q
 *
 *   q  1 to 8
 *   s  d q^2 finite numbers: s_li of coordinate j at [(j * q + l) * q + i]; copied
 *
 * The sign o is the product coordinate by coordinate: s couples the stages of one coordinate, and U couples the
 * coordinates of one stage. The unknowns are ordered so that the stages of a coordinate are neighbours. So the matrix
 * has q times as many diagonals as the Hessian.
 *
 * Return the codes of fvi_newton_alloc, and FVI_EINVAL if q is out of range. */
int fvi_newton_stages_alloc(const fvi_system *system, size_t q, const double *s,
                            fvi_newton **newton);

/* fvi_newton_matrices_alloc -- Allocate a solver of (2.10) for a system with matrices: [(27.3)]
 *
 *     (m M + sum_j c_j C_j) d + s K (x + theta d) = r
 *
 *   system    a system with matrices
 *   m         finite, > 0
 *   c         one number for C, or one number for each damper of the matrices, finite, >= 0; copied. NULL: no damping
 *   s, theta  finite
 *
 * The matrix of d is factorised here, once. Return FVI_SUCCESS; FVI_EDOM if a number is out of range; FVI_ENOMEM; or
 * the code of the factorisation. */
int fvi_newton_matrices_alloc(const fvi_system *system, double m, const double *c,
                              double s, double theta, fvi_newton **newton);

/* fvi_newton_solve -- Solve (2.10), or the equations of q stages.
 *
 *   x  d numbers
 *   r  q d numbers, stage after stage, with q = 1 in (2.10)
 *   d  input: an initial guess (any finite numbers); output: the solution; q d numbers
 *   g  output: grad U(x + theta d), q d numbers
 *
 * Newton's method stops when the residual of each equation is within the rounding errors of its terms, and takes one
 * more step. If it has not stopped after fifty steps, or if a Jacobian is singular, the solver begins again at d = 0.
 * It follows A d' = r - A d - s grad U(x + theta d) downhill, with steps as long as possible. If the equation has
 * several solutions, any of them may be found.
 *
 * Cost of an explicit equation or a quadratic U: two gradients, or one if the Hessian is constant and diagonal, and one
 * solution with the factors, which takes O(d w) for 2 w - 1 diagonals and O(d^2) for a full Hessian. Cost of any other
 * U: usually two to five gradients, Hessians and factorisations, O(d w^2) or O(d^3) each. A potential with its own
 * `solve` is called instead of each factorisation. If Newton's method fails, up to 1050 factorisations and twice as
 * many gradients.
 *
 * Return FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; the code of the potential; and if there is no solution,
 * FVI_ESING if a singular Jacobian ended Newton's method, else FVI_EMAXITER. The codes of the potential, FVI_ESING and
 * FVI_EMAXITER do not call the error handler. A gradient that is not finite, or whose square overflows, is no error
 * here, but then d is not finite. */
int fvi_newton_solve(fvi_newton *newton, const double *x, const double *r,
                     double *d, double *g);

/* fvi_newton_diagonal -- Return the diagonal A of (2.10), d numbers owned by the solver. The system has no matrices. */
const double *fvi_newton_diagonal(const fvi_newton *newton);

/* fvi_newton_copy -- Allocate a second solver of the same equation, with a copy of the factors. Return FVI_SUCCESS; or
 * FVI_ENOMEM, and then *to is unchanged. */
int fvi_newton_copy(const fvi_newton *from, fvi_newton **to);

/* fvi_newton_free -- Free the solver. NULL is allowed. */
void fvi_newton_free(fvi_newton *newton);

#endif
