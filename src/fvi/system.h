/* src/fvi/system.h -- A mechanical system, as data.                                                     [H 2]
 *
 *     m x'' + grad U(x) + rho D^{2 alpha} x = F(t),     x in R^d.
 *
 * A system holds the masses, the dampings, the potential and the force. The order of the damping and everything about
 * time steps belong to a run (trajectory.h), not to the system.
 *
 *     const double m = 1, rho = 0.2, c = 4;
 *     const fvi_system system = { .d = 1, .mass = &m, .damping = &rho, .potential = fvi_potential_harmonic(&c) };
 *
 * Callbacks. The caller writes the functions of a potential and of a force. They return 0, or any other int. Such an
 * int ends the call of the library: that call returns the same int, and does not call the error handler. The codes of
 * the library are positive (error.h), so a negative number is always the caller's own code. A positive number means
 * what error.h says. If a callback returns FVI_EOVRFLW, FVI_EMAXITER or FVI_ESING, the search for a step (fvi_solve
 * with a tolerance) goes on with shorter steps.
 *
 * Notation in all headers. [H 2] names a chapter of the handbook, and (2.4) an equation in it. u = 2^-53 is the unit of
 * rounding. d is the dimension. "Seen" marks a measured value, for which there is no proof. */
#ifndef FVI_SYSTEM_H
#define FVI_SYSTEM_H

#include "error.h"

#include <math.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_potential -- a potential U: R^d -> R with its first two derivatives.
 *
 *   value      writes U(x) to *value
 *   gradient   writes the d numbers dU/dx_i to grad
 *   hessian    writes the numbers d^2U/dx_i dx_j to H, in the layout that `diagonals` selects
 *   params     handed to the functions, owned by the caller, may be NULL
 *   quadratic  NULL; or a function that is called once when a run starts. It returns nonzero if U is quadratic for
 *              these params. Then the run evaluates and factorises the Hessian once, not at each step
 *   diagonals  0: H is full, d * d numbers, row by row. n > 0: the Hessian is zero outside its main diagonal and the
 *              n - 1 diagonals on either side. Then H has d * n numbers,
 *                  H[i * n + k] = d^2U / dx_i dx_{i+k},   i + k < d,
 *              and the numbers with i + k >= d are not used. This is LAPACK's band storage of a symmetric matrix,
 *              UPLO = 'L', LDAB = n
 *   solve      NULL; or the caller's own solver for the equation of a step, for a Hessian that should not be stored. It
 *              overwrites r with (diag(a) + c Hess U(x))^-1 r, where a is d numbers > 0. It returns 0; FVI_ESING if
 *              that matrix is singular; or a code of its own. If U is quadratic, a and c are the same at each step, so
 *              solve may keep its factors. Every error of the solution is then an error of the step. If U is not
 *              quadratic, Newton's method corrects the solution, so eight correct digits are enough. They cost one
 *              iteration more than sixteen digits
 *   lanes      NULL; the library's own potentials have here their evaluation for several runs at once (batch.h)
 *
 * value, gradient and hessian are all set, or all NULL. A zeroed potential is that of a free particle.
 *
 * If solve is set, the steps of methods without stages make no matrix and do not call hessian. Methods with stages,
 * fvi_variable_step, fvi_stability_number and the adjoint may still call hessian. If your Hessian cannot be stored, let
 * hessian return a code. Whatever calls hessian then returns this code.
 *
 * The library calls the functions with arrays that do not overlap. A function that cannot compute a number returns a
 * code, or writes NaN. After NaN the step ends with FVI_EOVRFLW; or with FVI_EMAXITER if only the Hessian of a
 * potential that is not quadratic is NaN.
 *
 * The params may change until fvi_stepper_start. From then until fvi_stepper_free the functions must give the same
 * numbers for the same x. The functions may write to other members of the params, for example a count of calls; runs in
 * several threads share them. A force may change between two steps, because no method stores its values. */
struct fvi_lane_functions;
typedef struct {
    int (*value)(size_t d, const double *x, void *params, double *value);
    int (*gradient)(size_t d, const double *x, void *params, double *grad);
    int (*hessian)(size_t d, const double *x, void *params, double *H);
    void *params;
    int (*quadratic)(const void *params);
    size_t diagonals;
    int (*solve)(size_t d, const double *x, const double *a, double c,
                 void *params, double *r);
    const struct fvi_lane_functions *lanes;
} fvi_potential;

/* fvi_impulse -- an impulse: at the time t >= 0 each momentum p_j jumps by J[j]. J has d finite numbers. */
typedef struct {
    double t;
    const double *J;
} fvi_impulse;

/* fvi_force -- a force F(t). A zeroed force is no force.
 *
 *   value  writes the d numbers F(t) to F. Returns 0 or a code
 *   params handed to the functions, owned by the caller, may be NULL
 *   jumps, jump_count  the times at which F or a derivative of F jumps, in any order, and their number; NULL and 0:
 *          none. A method that chooses its steps ends a step at each of these times
 *   bound  NULL; or a function that bounds F at all times strictly between `from` and `to`, so that no pulse is hidden
 *          between the times at which value is called. It writes (order + 1) d numbers:
 *              most[j]          an upper bound of half the range of F_j
 *              most[k * d + j]  an upper bound of |d^k F_j / dt^k| / k!, k = 1, ..., order
 *          INFINITY stands for no known bound, and for a derivative that does not exist. F may have kinks, where its
 *          first derivative jumps.
 *          order <= FVI_BOUND_ORDER. Methods that choose their steps, and searches for a step, call bound. Returns 0 or
 *          a code
 *   impulses, impulse_count  the impulses, with times that do not decrease, and their number; NULL and 0: none. (2.14)
 *          and trajectory.h say how methods apply them
 *   lanes  NULL; the library's own forces have here their evaluation for several runs at once (batch.h) */
enum { FVI_BOUND_ORDER = 14 };
typedef struct {
    int (*value)(double t, size_t d, void *params, double *F);
    void *params;
    const double *jumps;
    size_t jump_count;
    const fvi_impulse *impulses;
    size_t impulse_count;
    int (*bound)(double from, double to, size_t order, size_t d, void *params,
                 double *most);
    const struct fvi_lane_functions *lanes;
} fvi_force;

/* fvi_damping_matrix -- a symmetric positive semidefinite matrix C = S B^T, as functions.              [(27.4)]
 *
 *   history_size  r >= 0: the history of a run has the r numbers z = B^T x. 0: the functions are not called
 *   select_history  writes B^T x - from to z. `from` and z are r numbers each; the arrays do not overlap
 *   apply_damping  subtracts a S z from the d numbers p
 *   params     handed to the functions, owned by the caller
 *   diagonal   NULL; or writes the diagonal of C, d numbers. A run uses it to decide whether C x0 is more than rounding
 *              errors
 *   apply_damping_to_stages  NULL; or does the same as apply_damping for s vectors z and s vectors p, s = 1, ..., 8,
 *              stored one after another
 *
 * The functions return 0, or a code as those of a potential do. */
typedef struct {
    size_t history_size;
    int (*select_history)(size_t d, const double *x, const double *from,
                          const void *params, double *z);
    int (*apply_damping)(size_t d, double a, const double *z, const void *params,
                         double *p);
    const void *params;
    int (*diagonal)(size_t d, const void *params, double *C);
    int (*apply_damping_to_stages)(size_t d, size_t s, double a, const double *z, const void *params, double *p);
} fvi_damping_matrix;

/* fvi_matrices -- the matrices M, C and K of a linear system, as functions.                           [H 27]
 *
 *     M x'' + C D^{2 alpha} x + K x = F(t),                                                           (27.1)
 *
 * M, C and K are symmetric, M is positive definite, and C is positive semidefinite. They are for systems whose masses
 * and dampings are not diagonal. structures.h makes these functions from sparse matrices.
 *
 *   damping    C; zeroed: no damping
 *   stiffness  writes K x to y
 *   inertia    writes M x to y. NULL: without it the system has no derivative by a factor of M (adjoint.h), no ground
 *              (parse.h), no form D (lobatto.h) and no fvi_variable_step
 *   factorise  prepares solve for m M + c[0] C + k K, or with several dampers for m M + sum_j c[j] C_j + k K, where
 *              m, c[j] >= 0, and writes the factors to *factors. c = NULL: all c[j] are 0. Returns FVI_ESING if the sum
 *              is not positive definite
 *   solve      overwrites r with the inverse of this sum times r. The factors belong to one run
 *   free_factors  frees the factors
 *   energy     writes p^T M^-1 p / 2 + x^T K x / 2 to *E; NULL: the energy is not known
 *   params     handed to the functions, owned by the caller
 *   M, K, C    NULL; or the entries of these matrices (structures.h), for responses and poles (response.h). C is NULL
 *              without damping
 *   damper_count, damper  0 and NULL; or the number and the matrices of several dampers. Each damper has its own kernel
 *              in the system's mechanism (dampers.h). Then there is no C, and `damping` is zeroed
 *   factorise_complex  NULL; or as factorise, for `count` such sums with complex numbers together, 1 to
 *              FVI_COMPLEX_SUMS. Form D of the methods with stages (lobatto.h) and fvi_variable_step need it. For each
 *              sum `factor` has m, then c or the c_j, then k, each with real and imaginary part. The real parts of m
 *              and k are > 0, that of c is >= 0
 *   solve_complex  overwrites r with the solutions of the first `count` of these equations. r has 2 count d numbers:
 *              for each unknown first the real parts, one for each equation, and then the imaginary parts
 *   free_complex_factors  frees these factors
 *
 * The functions return 0, or a code as those of a potential do. */
enum { FVI_COMPLEX_SUMS = 4 };
struct fvi_sparse;
typedef struct {
    fvi_damping_matrix damping;
    int (*stiffness)(size_t d, const double *x, const void *params, double *y);
    int (*inertia)(size_t d, const double *x, const void *params, double *y);
    int (*factorise)(size_t d, double m, const double *c, double k, const void *params,
                     void **factors);
    int (*solve)(size_t d, void *factors, double *r);
    void (*free_factors)(void *factors);
    int (*energy)(size_t d, const double *x, const double *p,
                  const void *params, double *E);
    const void *params;
    const struct fvi_sparse *M, *K, *C;
    size_t damper_count;
    const fvi_damping_matrix *damper;
    int (*factorise_complex)(size_t d, size_t count, const double *factor, const void *params,
                             void **factors);
    int (*solve_complex)(size_t d, size_t count, void *factors, double *r);
    void (*free_complex_factors)(void *factors);
} fvi_matrices;

/* fvi_system -- one mechanical system. The arrays belong to the caller and must outlive every run that uses the system.
 *
 *   d        dimension, d >= 1
 *   mass     d masses, finite, > 0; with a mechanism a mass may be 0
 *   damping  d coefficients rho, finite, >= 0
 *   potential, force  as above
 *   matrices  NULL; or M, C and K, for methods with takes_matrices (trajectory.h). Then mass and damping are the
 *            diagonals of M and C, and the potential is zeroed
 *   mechanism  NULL; or dampers between points of the system, a Lagrangian, or constraints (dampers.h), for methods
 *            with takes_mechanism. Then damping is zero */
struct fvi_mechanism;
//> system
typedef struct {
    size_t d;
    const double *mass;
    const double *damping;
    fvi_potential potential;
    fvi_force force;
    const fvi_matrices *matrices;
    const struct fvi_mechanism *mechanism;
} fvi_system;
//< system

/* fvi_system_check -- Check whether every function of the library can take the system.
 *
 *   error  output, or NULL. Its field is "mass", "rho", "d", "potential", "matrices", "mechanism" or "system"
 *
 *     if (fvi_system_check(&system, &error))
 *         fprintf(stderr, "%s: %s\n", error.field, error.text);
 *
 * Cost O(d). Returns FVI_SUCCESS; FVI_EFAULT if system, mass or damping is NULL; FVI_EINVAL if d == 0, if eight
 * Hessians cannot be addressed, or if the potential has some but not all of its three functions; FVI_EDOM if a mass is
 * not finite and > 0, or a damping not finite and >= 0; FVI_EUNSUP if the system has matrices or a mechanism, because
 * not every function takes them (fvi_stepper_start and fvi_solve do, and check them themselves). */
int fvi_system_check(const fvi_system *system, fvi_error *error);

/* fvi_energy -- Compute the energy E = sum_i p_i^2 / (2 m_i) + U(x).                                    [(2.4)]
 *
 *   x, p  position and momentum, d numbers each
 *   E     output, one number
 *
 *     double E;
 *     status = fvi_energy(&system, s->x, s->p, &E);      // of a stepper
 *
 * With matrices E is their energy. With a Lagrangian use fvi_energy_at (lagrangian.h). Nothing is checked, because the
 * function is called for every row. Cost O(d) and one value of U.
 * Returns FVI_SUCCESS; FVI_EOVRFLW if E is not finite; FVI_EUNSUP if the matrices have no energy, or if there is a
 * Lagrangian; or what the potential or the matrices returned. No handler is called. On error E is untouched. */
int fvi_energy(const fvi_system *system, const double *x, const double *p,
               double *E);

/* fvi_potential_value -- Compute U at x.
 * fvi_potential_gradient -- Compute grad U at x; K x for a system with matrices. Both are 0 if there is no U.
 *
 *   x      d numbers
 *   value  output, one number
 *   grad   output, d numbers; must not be x
 *
 * Nothing is checked. Returns FVI_SUCCESS, or what the potential returned. */
int fvi_potential_value(const fvi_system *system, const double *x,
                        double *value);
int fvi_potential_gradient(const fvi_system *system, const double *x, double *grad);

/* fvi_potential_hessian_size -- Return the number of doubles that a Hessian needs in fvi_potential_hessian: d * d, or
 * d * diagonals if that is more. Return SIZE_MAX / 64, which no allocator can provide, if it cannot be addressed.
 * Nothing is checked. */
size_t fvi_potential_hessian_size(const fvi_system *system);

/* fvi_potential_hessian -- Compute the Hessian of U at x as a full matrix, also for a potential with `diagonals` > 0.
 *
 *   x  d numbers
 *   H  output: d * d numbers, row by row; zeros if there is no U. The array must have fvi_potential_hessian_size
 *      numbers; the numbers after the first d * d hold no result
 *
 * Nothing is checked. Cost O(d^2) and one Hessian.
 * Returns FVI_SUCCESS, or what the potential returned; H then holds no result. */
int fvi_potential_hessian(const fvi_system *system, const double *x, double *H);

/* fvi_all_finite -- Return 1 if all n numbers of v are finite, else 0. The function is in the header because every step
 * calls it; so it is inlined. */
static inline int fvi_all_finite(size_t n, const double *v)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(v[i]))
            return 0;
    return 1;
}

/* Ready-made potentials. Each returns a potential for use in a system. The potential points to the parameters, so they
 * must outlive the system. The first three potentials treat every coordinate alike, and their Hessian is diagonal; the
 * Hessian of a chain has two diagonals. The harmonic potential is quadratic. A Duffing potential and a chain are
 * quadratic if g is zero when the run starts. A pendulum always counts as not quadratic.
 *
 *     harmonic  c        U = sum_i c x_i^2 / 2
 *     duffing   c, g     U = sum_i c x_i^2 / 2 + g x_i^4 / 4
 *     pendulum  g        U = sum_i g (1 - cos x_i)
 *     chain     c, g     U = sum_{i=0}^{d} c r_i^2 / 2 + g r_i^4 / 4,
 *                        r_i = x_i - x_{i-1}, x_{-1} = x_d = 0:
 *                        d masses in a row between two walls, d + 1 springs */
fvi_potential fvi_potential_harmonic(const double *c);
fvi_potential fvi_potential_duffing(const double cg[2]);
fvi_potential fvi_potential_pendulum(const double *g);
fvi_potential fvi_potential_chain(const double cg[2]);

/* Ready-made forces, the same on every mass. Each returns a force that points to its parameters, so they must outlive
 * the system.
 *
 *     step    a, T   F = a for 0 <= t <= T, then 0
 *     cosine  a, w   F = a cos(w t) */
fvi_force fvi_force_step(const double aT[2]);
fvi_force fvi_force_cosine(const double aw[2]);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
