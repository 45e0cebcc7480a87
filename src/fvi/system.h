/* src/fvi/system.h -- A mechanical system, as data.                  [H 2]
 *
 *     m x'' + grad U(x) + rho D^{2 alpha} x = F(t),     x in R^d.
 *
 * A system holds the masses, the dampings, the potential and the force. The
 * order of the damping and everything that has to do with time steps belong to
 * a run (trajectory.h), not to the system.
 *
 * The functions of a potential and of a force are the caller's callbacks. They return
 * 0, or any other int, which ends the call of the library in which they were asked:
 * that call returns the same int and calls no error handler. Negative numbers are
 * never codes of the library's (error.h); a number that is one says what it says
 * there. Only fvi_step_search goes on after one (step_search.h). */
#ifndef FVI_SYSTEM_H
#define FVI_SYSTEM_H

#include "error.h"

#include <math.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_potential -- U: R^d -> R with its first two derivatives.
 *
 *   value      writes U(x) to *value
 *   gradient   writes the d numbers dU/dx_i to grad
 *   hessian    writes d^2U/dx_i dx_j to H, in the form that `diagonals` says
 *   params     handed to the functions, owned by the caller, may be NULL
 *   quadratic  NULL, or asked once when a run starts: nonzero promises that U is
 *              quadratic for these params. Its Hessian is then evaluated and
 *              factorised once in the run, not at each step
 *   diagonals  0: H is full, d * d numbers, row by row. Else the Hessian is zero
 *              but for its main diagonal and the diagonals - 1 on either side,
 *              and a row of H holds one half of them,
 *                  H[i * diagonals + k] = d^2U / dx_i dx_{i+k},   i + k < d;
 *              there is no room where i + k >= d. This is LAPACK's band
 *              storage of a symmetric matrix, UPLO = 'L', LDAB = diagonals
 *   solve      NULL, or the caller's own way through the equation of a step, for
 *              Hessians that should not be written down: r becomes
 *              (diag(a) + c Hess U(x))^-1 r, where a is d numbers > 0. Returns 0;
 *              FVI_ESING if that matrix is singular; or a code of its own. If U is
 *              quadratic it is asked with the same a and c at each step, so factors
 *              may be kept, and what it leaves of r is an error of the step; else
 *              a solution to eight digits does, and costs a step of Newton's more
 *
 *   lanes      NULL; of the library's own potentials how they are evaluated for several
 *              runs at once (batch.h)
 *
 * The first three functions, or none: a zeroed potential is that of a free particle.
 * With solve a step of one equation makes no matrix and does not ask for the Hessian;
 * methods with stages, fvi_stability_number and the adjoint may. A Hessian that is out of
 * reach returns a code, which those calls then return.
 * The library calls them with arrays that do not overlap. A function that cannot
 * give a number returns a code, or writes NaN: the step then ends with FVI_EOVRFLW, or
 * with FVI_EMAXITER where only a Hessian that changes is NaN.
 *
 * The params may change until fvi_stepper_start. From then until fvi_stepper_free the functions must
 * give the same numbers for the same x; what else stands in the params, a count of the
 * calls, say, is theirs to write. Runs in several threads share it. A force may be
 * another one from a step on, as no method keeps it. */
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

/* fvi_impulse -- at the time t >= 0 each momentum p_j jumps by J[j]; d numbers, finite. */
typedef struct {
    double t;
    const double *J;
} fvi_impulse;

/* fvi_force -- F(t), d numbers written to F. A zeroed force is none.
 *
 *   jumps, jump_count  the times, in any order, at which F or a derivative of it jumps;
 *          NULL and 0 if there are none. Methods that choose their steps end one there
 *   bound  NULL; or it tells what F can be at all times strictly between two, so that no
 *          pulse hides between the times at which value is asked:
 *              most[j]          half of the range of F_j, at least
 *              most[k * d + j]  |d^k F_j / dt^k| / k! at most, k = 1, ..., order
 *          INFINITY where nothing is known, or where that derivative does not exist. The
 *          first derivative may jump. order <= FVI_BOUND_ORDER. Methods that choose their
 *          steps, and searches, ask for it. Returns 0 or a code
 *   impulses, impulse_count  what hits the body, t not falling; NULL and 0 if nothing does.
 *          How methods take them: (2.14), trajectory.h
 *   lanes  NULL; of the library's own forces how they are evaluated for several runs at
 *          once (batch.h) */
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

/* fvi_damping_matrix -- one symmetric C = S B^T that is not negative, as functions. [(27.4)]
 *
 *   history_size  r >= 0: the history of a run has the r numbers z = B^T x. 0: the functions are
 *              not called
 *   select_history  writes B^T x - from to z, r numbers each; none is another
 *   apply_damping  takes a S z away from the d numbers p
 *   params     handed to the functions, owned by the caller
 *   diagonal   NULL; or writes the diagonal of C, d numbers, by which a run tells whether C x0 is
 *              more than roundings
 *   apply_damping_to_stages  NULL; or what apply_damping does, of s vectors z, 1 to 8, one behind the other,
 *              and as many p
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

/* fvi_matrices -- M, C and K of a linear system                          [H 27]
 *
 *     M x'' + C D^{2 alpha} x + K x = F(t),                               (27.1)
 *
 * all symmetric, M positive definite, C not negative, as functions: for systems whose
 * masses and dampings are more than the numbers of a diagonal. structures.h makes them
 * of sparse matrices.
 *
 *   history_size  r >= 0 of the damping: C = S B^T, and the history of a run has the r numbers
 *              z = B^T x. 0: no damping, the next two functions are not called
 *   select_history  writes B^T x - from to z, r numbers each; none is another
 *   apply_damping  takes a S z away from the d numbers p
 *   apply_damping_to_stages  NULL; or as that of fvi_damping_matrix
 *   stiffness  writes K x to y
 *   inertia    writes M x to y; NULL: there is no derivative by a factor of M (adjoint.h)
 *   factorise  what solve needs to know of m M + c C + k K, into *factors; m, c >= 0.
 *              FVI_ESING if that is not positive definite
 *   solve      r becomes (m M + c C + k K)^-1 r. The factors belong to one run
 *   free_factors  gives the factors back
 *   energy     writes p^T M^-1 p / 2 + x^T K x / 2 to *E; NULL: energies are not known
 *   params     handed to the functions, owned by the caller
 *   M, K, C    NULL; or the entries of these matrices (structures.h), C NULL without damping, for
 *              those who ask for responses and poles (response.h)
 *   damper_count, damper  0 and NULL; or the matrices of as many dampers, each with a kernel of
 *              its own in the system's mechanism (dampers.h). Then there is no C, and
 *   factorise_dampers  as factorise, of m M + sum_j c_j C_j + k K
 *   factorise_complex  NULL; or as factorise, of `count` such sums with complex numbers together, 1 to
 *              FVI_COMPLEX_SUMS, for form D of the methods with stages (lobatto.h). `factor` is of each sum
 *              m, then c or the c_j, then k, of each the real and the imaginary part; real parts of m and k
 *              are > 0, of c >= 0
 *   solve_complex  r becomes the solution of the first `count` of these equations, 2 count d numbers: of
 *              each unknown first the real parts, one for each equation, and then the imaginary parts
 *   free_complex_factors  gives these factors back
 *
 * The functions return 0, or a code as those of a potential do. */
enum { FVI_COMPLEX_SUMS = 4 };
struct fvi_sparse;
typedef struct {
    size_t history_size;
    int (*select_history)(size_t d, const double *x, const double *from,
                          const void *params, double *z);
    int (*apply_damping)(size_t d, double a, const double *z, const void *params,
                         double *p);
    int (*stiffness)(size_t d, const double *x, const void *params, double *y);
    int (*inertia)(size_t d, const double *x, const void *params, double *y);
    int (*factorise)(size_t d, double m, double c, double k, const void *params,
                     void **factors);
    int (*solve)(size_t d, void *factors, double *r);
    void (*free_factors)(void *factors);
    int (*energy)(size_t d, const double *x, const double *p,
                  const void *params, double *E);
    const void *params;
    const struct fvi_sparse *M, *K, *C;
    size_t damper_count;
    const fvi_damping_matrix *damper;
    int (*factorise_dampers)(size_t d, double m, const double *c, double k,
                             const void *params, void **factors);
    int (*factorise_complex)(size_t d, size_t count, const double *factor, const void *params,
                             void **factors);
    int (*solve_complex)(size_t d, size_t count, void *factors, double *r);
    void (*free_complex_factors)(void *factors);
    int (*apply_damping_to_stages)(size_t d, size_t s, double a, const double *z, const void *params, double *p);
} fvi_matrices;

/* fvi_system -- one mechanical system. The arrays belong to the caller and
 * must outlive every run that uses the system.
 *
 *   d        dimension, d >= 1
 *   mass     d masses, finite, > 0; with a mechanism also 0
 *   damping  d coefficients rho, finite, >= 0
 *   potential, force  as above
 *   matrices  NULL; or M, C and K, for methods that say so (takes_matrices, trajectory.h):
 *            mass and damping are then the diagonals of M and C, the potential is none
 *   mechanism  NULL; or dampers between points of the system (dampers.h), for methods that say so
 *            (takes_mechanism, trajectory.h): damping is then zero */
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

/* fvi_system_check -- is the system one that everything in the library can take? If not, the error
 * has "mass", "rho", "d", "potential" or "matrices" for its field.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if system, mass or damping is NULL;
 * FVI_EINVAL if d == 0, if the Hessian and as much again seven times cannot be
 * addressed, or if the potential has some of its three functions but not all; FVI_EDOM
 * if a mass is not finite and > 0, or a damping not finite and >= 0; FVI_EUNSUP if it has
 * matrices, which fvi_stepper_start and fvi_stability_number take, and not everything. Cost O(d). */
int fvi_system_check(const fvi_system *system, fvi_error *error);

/* fvi_energy -- E = sum_i p_i^2 / (2 m_i) + U(x).                  [(2.4)]
 *
 *   x, p  d numbers each     E  output, one number
 *
 * With matrices it is theirs; of a Lagrangian it is asked by fvi_energy_at (lagrangian.h). Nothing is
 * checked: this is called once a row. Cost O(d) and one value of U.
 * Returns FVI_SUCCESS; FVI_EOVRFLW if E is not a finite number, of which no handler is
 * called; FVI_EUNSUP if the matrices have no energy, or there is a Lagrangian; or what the potential or they returned.
 * After an error E is untouched. */
int fvi_energy(const fvi_system *system, const double *x, const double *p,
               double *E);

/* fvi_potential_value, fvi_potential_gradient -- U and grad U at x; 0 if there is no U. The gradient
 * with matrices is K x.
 *
 *   x     d numbers
 *   value  output, one number
 *   grad  output, d numbers, not x
 *
 * Nothing is checked. Returns FVI_SUCCESS, or what the potential returned. */
int fvi_potential_value(const fvi_system *system, const double *x,
                        double *value);
int fvi_potential_gradient(const fvi_system *system, const double *x, double *grad);

/* fvi_potential_hessian_size -- d * d numbers, or d * diagonals if that is more: a Hessian in
 * full and in diagonals. SIZE_MAX / 64, which no allocator has, if it cannot be
 * addressed. Nothing is checked. */
size_t fvi_potential_hessian_size(const fvi_system *system);

/* fvi_potential_hessian -- the Hessian of U at x as a full matrix, whatever its diagonals.
 *
 *   x  d numbers     H  output: d * d numbers, row by row; 0 if there is no U.
 *                       Room for fvi_potential_hessian_size numbers, the rest is of no use
 *
 * Nothing is checked. Cost O(d^2) and one Hessian.
 * Returns FVI_SUCCESS, or what the potential returned; H is then of no use. */
int fvi_potential_hessian(const fvi_system *system, const double *x, double *H);

/* fvi_all_finite -- are all n numbers of v finite? In the header, because every
 * step asks: isfinite is a macro, and no call is made. */
static inline int fvi_all_finite(size_t n, const double *v)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(v[i]))
            return 0;
    return 1;
}

/* Potentials that are ready to use. The parameters are read when a run starts and
 * when U is, so they must outlive the system. The first three act on every
 * coordinate alike, and their Hessian is diagonal; that of a chain has two
 * diagonals. Harmonic is quadratic, the others are if g is zero as the run starts
 * (a pendulum never says so):
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

/* Forces that are ready to use, the same on every mass:
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
