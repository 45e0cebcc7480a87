/* src/fvi/response.h -- Linear motions in the frequency domain: responses and poles.                    [H 30]
 *
 *     Z(s) = s^2 M + K + sum_j C_j(s) B_j,     Z(s) X(s) = F(s)                                      (30.1)
 *
 * Z is the **dynamic stiffness** of a system. M has its masses, and K is the Hessian of its potential at one place. C_j
 * is the symbol of damping j (damping_laws.h), and the matrix B_j says on which unknowns it acts. A shaker test
 * measures Z(i omega)^-1. The zeros of det Z are the **poles**: they give the frequencies and the damping ratios of the
 * free motion.
 *
 *     fvi_response *response;
 *     fvi_poles poles;
 *     const fvi_linear_motion motion = { .system = &system, .alpha = 0.3 };
 *     if (fvi_response_alloc(&motion, &response, NULL) == FVI_SUCCESS
 *         && fvi_poles_find(response, 0, &poles, NULL) == FVI_SUCCESS)
 *         printf("%g %g\n", poles.pole[0], poles.pole[1]);
 *
 * A complex number is a pair of doubles, real part and imaginary part, as C's double complex and numpy's complex128
 * store it. An array of n complex numbers has 2 n doubles. */
#ifndef FVI_RESPONSE_H
#define FVI_RESPONSE_H

#include "damping_laws.h"
#include "error.h"
#include "system.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_linear_motion -- a system that is linear, or that is linearised at one place.
 *
 *   system  its masses, potential and dampings; or its matrices, if they have entries (structures.h); and the dampers
 *           of its mechanism, if it has one (dampers.h). Its force is not read
 *   alpha   0 <= alpha <= 1: the symbol of each damping rho_i is rho_i s^{2 alpha}; not read with a law
 *   law     NULL; or the law C(s) that replaces s^{2 alpha}
 *   at      d numbers: the place at which the potential and the elongations are linearised; NULL: 0. A quadratic
 *           potential and elongations by rows do not depend on it
 *   along   d numbers: the displacement of each unknown for a ground displacement of 1; NULL: 1 for all unknowns */
typedef struct {
    const fvi_system *system;
    double alpha;
    const fvi_kernel *law;
    const double *at, *along;
} fvi_linear_motion;

/* fvi_response -- Z(s), with memory for its factors. Only one thread at a time may use it. */
typedef struct fvi_response fvi_response;

/* fvi_response_alloc -- Prepare Z(s).
 *
 *   motion    read in this call only; but everything to which its system, laws and matrices point must outlive the
 *             response
 *   response  output; free it with fvi_response_free
 *   error     output, or NULL
 *
 * Z(s) has sparse factors (UMFPACK) if there are more than 24 unknowns and three quarters or more of its entries are
 * zero; otherwise it has dense factors.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EDOM or FVI_EINVAL, with the field, for a number of the
 * system, alpha, a law, a damper, `at` or `along` that is out of range; FVI_EUNSUP for matrices without entries, for a
 * Lagrangian, for forces that depend on velocity, for constraints, and for an elongation whose gradient changes with t;
 * FVI_EBADFUNC if a Hessian or an elongation is not finite; the code that a function of the potential or of an
 * elongation returned; FVI_ENOMEM. On error *response is untouched. */
int fvi_response_alloc(const fvi_linear_motion *motion, fvi_response **response,
                       fvi_error *error);

/* fvi_response_free -- Free the response. NULL is allowed. */
void fvi_response_free(fvi_response *response);

/* fvi_response_dimension -- Return d, the number of unknowns. */
size_t fvi_response_dimension(const fvi_response *response);

/* fvi_response_solve -- Compute x = Z(s)^-1 f.
 *
 *   s     real part and imaginary part; not zero. A negative real s, with imaginary part 0, stands for the upper side
 *         of the cut, s = -r + i0
 *   f, x  d complex numbers each; may be the same array
 *
 *     const double s[2] = { 0, omega }, f[2] = { 1, 0 };      // a force of 1 on the only unknown
 *     double x[2];
 *     status = fvi_response_solve(response, s, f, x, &error);
 *
 * Cost: one factorisation of Z(s), or none if the last call had the same s.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EDOM if s is zero or not finite; FVI_ESING if Z(s) has no
 * inverse, because s is a pole; FVI_EOVRFLW if x is not finite; FVI_ENOMEM; or the number of the interrupter (error.h).
 * On error x holds no result. */
int fvi_response_solve(fvi_response *response, const double s[2],
                       const double *f, double *x, fvi_error *error);

/* fvi_response_multiply -- Compute y = Z(s) x; or y = Z'(s) x, with the derivative of Z by s, if `derivative` is
 * nonzero.
 *
 *   s     as fvi_response_solve
 *   x, y  d complex numbers each; must not be the same array
 *
 * Returns FVI_SUCCESS; FVI_EFAULT, FVI_EDOM and FVI_EOVRFLW as fvi_response_solve. */
int fvi_response_multiply(fvi_response *response, const double s[2],
                          int derivative, const double *x, double *y,
                          fvi_error *error);

/* fvi_response_kind -- the response of unknown `at` at a frequency omega.                    [(30.2), (30.3)]
 *
 *   RECEPTANCE   its displacement per force on unknown `by`: the entry (at, by) of H = Z(i omega)^-1
 *   MOBILITY     its velocity per force: i omega H
 *   ACCELERANCE  its acceleration per force: -omega^2 H
 *   GROUND       its absolute acceleration per acceleration of the ground, r + omega^2 H M r, where r is `along` of the
 *                motion and the unknowns are measured relative to the ground. `by` is not read */
typedef enum {
    FVI_RESPONSE_RECEPTANCE,
    FVI_RESPONSE_MOBILITY,
    FVI_RESPONSE_ACCELERANCE,
    FVI_RESPONSE_GROUND
} fvi_response_kind;

/* fvi_response_at -- Compute a response at n frequencies.
 *
 *   omega   n numbers, finite, > 0, in radians per unit of time
 *   at, by  unknowns, from 0, < d
 *   H       output, n complex numbers
 *
 *     double omega[] = { 0.5, 1, 2 }, H[2 * 3];
 *     status = fvi_response_at(response, FVI_RESPONSE_RECEPTANCE, 3, omega, 0, 0, H, &error);
 *
 * Accuracy: the error relative to the norm of Z^-1 is some d u times the condition number of Z, u = 2^-53. Cost: one
 * factorisation for each frequency.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL for an unknown kind, or an unknown that does not
 * exist; FVI_EDOM for a frequency; FVI_ESING at the resonance of a mode without damping; FVI_EOVRFLW if a response is
 * not finite; FVI_ENOMEM; or the number of the interrupter (error.h). After an error at a frequency, error->index is
 * its number, and the numbers of H before it are right. */
int fvi_response_at(fvi_response *response, fvi_response_kind kind, size_t n,
                    const double *omega, size_t at, size_t by, double *H,
                    fvi_error *error);

/* fvi_poles -- the zeros s_k of det Z with Im s > 0 that do not grow. Their conjugates are poles, too.  [(30.4)]
 *
 *   count     number of poles that were found, in the order of increasing |s|
 *   expected  number of such poles that exist; SIZE_MAX: not known
 *   d         number of unknowns
 *   pole      count complex numbers s_k. The frequency is |s| / 2 pi, the damping ratio -Re s / |s|
 *   shape     for each pole d complex numbers: the shape v, with Z(s) v = 0 and v^T Z'(s) v = 1 (transposed, not
 *             conjugated). So v v^T is the residue of Z^-1 at s                                       (30.5)
 *   residual  for each pole |Z v| / ((|s|^2 |M| + |K| + sum |C_j B_j|) |v|), in Frobenius norms
 *
 * Z^-1 is the sum of the residue terms of these poles and their conjugates, plus an integral along the cut (30.6). */
enum { FVI_MOST_POLES = 500 };
typedef struct {
    size_t count, expected, d;
    double *pole, *shape, *residual;
} fvi_poles;

/* fvi_poles_find -- Find the poles with Im s > 0 and Re s <= 0, which oscillate and do not grow.
 *
 *   count  the number of poles wanted, those of lowest |s|, at most FVI_MOST_POLES; 0: all d poles
 *   poles  output; free it with fvi_poles_free
 *
 * How it searches. Newton's method goes from each undamped mode to a pole. If two searches end at one pole, both start
 * again and follow their poles while the damping grows from 0. For up to 64 unknowns the function finds all poles and
 * keeps the lowest. For more unknowns, and if fewer poles are wanted, it starts from the lowest count + 4 modes. Of the
 * four additional modes it leaves out the last ones whose estimate of |s|, from v^T Z(s) v = 0 with the undamped shape
 * v, is more than a tenth above the largest estimate of the wanted modes. If the argument principle then counts more
 * poles than were found, the sector is cut into boxes, and Newton's method starts in the boxes with missing poles.
 *
 * How many poles exist (`expected`). By (30.7) there are d poles if K is positive definite and all orders are below 1.
 * A dashpot or a Maxwell element is allowed beside a power of such an order in the same law. There are d poles as well
 * if all orders of powers and ranges lie between 1 and 2. Both statements suppose positive semidefinite matrices of the
 * dampers; the function does not check the matrices of dampers.h. In all other cases the argument principle counts the
 * poles with 1.5 < arg s < 3.14 for up to 24 unknowns. It is no error if the function finds fewer poles than exist:
 * compare count with expected. A pole that grows slowly, with 1.5 < arg s < pi/2, may be counted, but is not found.
 *
 * Accuracy: seen 1e-15 of |s| for well conditioned Z. Cost: one to four factorisations for each pole, and the undamped
 * modes: O(d^3) up to 256 unknowns or for all modes, else subspace iteration with factors of K.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EINVAL if count > d; FVI_EUNSUP for more than
 * FVI_MOST_POLES poles; FVI_ESING if M is not positive definite; FVI_EMAXITER if the undamped modes were not found;
 * FVI_ENOMEM; or the number of the interrupter (error.h). On error *poles is untouched. */
int fvi_poles_find(fvi_response *response, size_t count, fvi_poles *poles,
                   fvi_error *error);

/* fvi_poles_free -- Free the arrays. A zeroed struct is allowed. */
void fvi_poles_free(fvi_poles *poles);

/* fvi_response_warning_of_place -- Warn if the place of linearisation is no equilibrium: a potential that is not
 * quadratic has |dU/dx_i| > 1e-8 (1 + |x_i|) at x for some i.
 *
 *   x     d numbers
 *   text  output: a constant text; NULL if there is no warning
 *
 * Returns 1 with a warning; 0 without; -1, with a text that says so, if there is no memory to find out. Cost: one
 * gradient.
 *
 * fvi_response_warning_of_poles -- Warn if fewer poles were found than exist, if it is not known how many exist, or if
 * all poles of this kind were found and they are fewer than d.
 *
 *   size, text  room for FVI_WARNING_ROOM characters (warnings.h); untouched if there is no warning
 *
 * Returns 1 with a warning, 0 without. */
int fvi_response_warning_of_place(const fvi_system *system, const double *x, const char **text);
int fvi_response_warning_of_poles(const fvi_poles *poles, size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
