/* src/fvi/response.h -- Linear motions by frequency: responses and poles.  [H 30]
 *
 *     Z(s) = s^2 M + K + sum_j C_j(s) B_j,     Z(s) X(s) = F(s)            (30.1)
 *
 * Z is the dynamic stiffness of a system: M its masses, K the Hessian of its potential at one
 * place, C_j the symbols of its dampings (damping_laws.h) and B_j which unknowns each acts on.
 * Z(i omega)^-1 is what a shaker test measures, and the zeros of det Z are the poles: the
 * frequencies and the damping ratios of the free motion.
 *
 *     fvi_response *response;
 *     fvi_poles poles;
 *     const fvi_linear_motion motion = { .system = &system, .alpha = 0.3 };
 *     if (fvi_response_alloc(&motion, &response, NULL) == FVI_SUCCESS
 *         && fvi_poles_find(response, 0, &poles, NULL) == FVI_SUCCESS)
 *         printf("%g %g\n", poles.pole[0], poles.pole[1]);
 *
 * A complex number is a pair of doubles, its real and its imaginary part, as C's double complex
 * and numpy's complex128 lay them out; n of them are 2 n doubles. */
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

/* fvi_linear_motion -- what is linear, or is made so.
 *
 *   system  masses, potential, dampings; or matrices that say their entries (structures.h); and
 *           the dampers of its mechanism, if it has one (dampers.h). Its force is not read
 *   alpha   0 <= alpha <= 1: each damping rho_i acts by s^{2 alpha}; not read with a law
 *   law     NULL; or C(s) in place of s^{2 alpha}
 *   at      d numbers, the place at which the potential and elongations are made linear; NULL: 0.
 *           Of a potential that is quadratic, and of rows, it does not matter
 *   along   d numbers, how each unknown moves with the ground; NULL: all alike, 1 */
typedef struct {
    const fvi_system *system;
    double alpha;
    const fvi_kernel *law;
    const double *at, *along;
} fvi_linear_motion;

/* fvi_response -- Z(s) with room for its factors; one thread at a time may use it. */
typedef struct fvi_response fvi_response;

/* fvi_response_alloc -- prepare Z(s).
 *
 *   motion    is read here; what its system, laws and matrices point to must outlive the response
 *   response  output; free it with fvi_response_free
 *
 * More than 24 unknowns are solved with sparse factors (UMFPACK) if three quarters of the entries or
 * more are zero, else with dense ones.
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EDOM or FVI_EINVAL, with the field,
 * for what the system, alpha, a law or a damper must not be; FVI_EUNSUP for matrices that do not
 * say their entries, for a Lagrangian, forces of velocity and constraints, and for an elongation whose
 * gradient changes with t; FVI_EBADFUNC if a Hessian or an elongation is not finite; what these
 * functions returned; FVI_ENOMEM. On error *response is untouched. */
int fvi_response_alloc(const fvi_linear_motion *motion, fvi_response **response,
                       fvi_error *error);

/* fvi_response_free -- give everything back. NULL is allowed. */
void fvi_response_free(fvi_response *response);

/* fvi_response_dimension -- d. */
size_t fvi_response_dimension(const fvi_response *response);

/* fvi_response_solve -- x = Z(s)^-1 f.
 *
 *   s     re, im, not zero. s = -r + i0, with im = 0, is the upper side of the cut
 *   f, x  d complex numbers each; may be the same
 *
 * One factorisation of Z(s), and none if s is that of the last call.
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EDOM if s is zero or not finite; FVI_ESING if Z(s) has no
 * inverse, at a pole; FVI_EOVRFLW if x is not finite; FVI_ENOMEM. On error x is of no use. */
int fvi_response_solve(fvi_response *response, const double s[2],
                       const double *f, double *x, fvi_error *error);

/* fvi_response_multiply -- y = Z(s) x, or Z'(s) x, the derivative, if `derivative` is nonzero; d
 * complex numbers each, y not x. Returns as fvi_response_solve, but for FVI_ESING. */
int fvi_response_multiply(fvi_response *response, const double s[2],
                          int derivative, const double *x, double *y,
                          fvi_error *error);

/* What is asked of unknown `at` at a frequency.                          [(30.2), (30.3)]
 *
 *   RECEPTANCE   its place by a force of 1 on unknown `by`: H = Z(i omega)^-1
 *   MOBILITY     its velocity: i omega H
 *   ACCELERANCE  its acceleration: -omega^2 H
 *   GROUND       its acceleration by one of 1 of the ground, beside which all are measured:
 *                r + omega^2 H M r, r the motion's `along`. `by` is not read */
typedef enum {
    FVI_RESPONSE_RECEPTANCE,
    FVI_RESPONSE_MOBILITY,
    FVI_RESPONSE_ACCELERANCE,
    FVI_RESPONSE_GROUND
} fvi_response_kind;

/* fvi_response_at -- a response at n frequencies.
 *
 *   omega   n numbers, finite, > 0, in radians per unit of time
 *   at, by  unknowns, from 0, < d
 *   H       output, n complex numbers
 *
 * Accuracy: relative to the norm of Z^-1, some d u times the condition of Z. Cost: one
 * factorisation a frequency.
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EINVAL for kind, at, by; FVI_EDOM for a frequency, the
 * error's index says which; FVI_ESING at the resonance of a mode without damping; FVI_EOVRFLW;
 * FVI_ENOMEM. On error the numbers before error->index stand. */
int fvi_response_at(fvi_response *response, fvi_response_kind kind, size_t n,
                    const double *omega, size_t at, size_t by, double *H,
                    fvi_error *error);

/* fvi_poles -- zeros s_k of det Z with Im s > 0; their conjugates are poles, too.   [(30.4)]
 *
 *   count     how many were found, |s| increasing
 *   expected  how many there are; SIZE_MAX: not known
 *   d         numbers in a shape
 *   pole      count complex numbers s_k. Frequency |s| / 2 pi, damping ratio -Re s / |s|
 *   shape     d complex numbers each: v with Z(s) v = 0 and v^T Z'(s) v = 1 (transposed, not
 *             conjugated), so that v v^T is the residue of Z^-1 at s                  (30.5)
 *   residual  |Z v| / ((|s|^2 |M| + |K| + sum |C_j B_j|) |v|), in Frobenius's norms
 *
 * Z^-1 is the sum over these poles and their conjugates, and an integral along the cut (30.6). */
enum { FVI_MOST_POLES = 500 };
typedef struct {
    size_t count, expected, d;
    double *pole, *shape, *residual;
} fvi_poles;

/* fvi_poles_find -- the oscillating poles.
 *
 *   count  how many of the lowest, at most FVI_MOST_POLES; 0: all d
 *   poles  output; give it back with fvi_poles_free
 *
 * Each is looked for from an undamped mode, by Newton's method; if two arrive at one pole, they
 * follow the poles as the damping grows from 0. Of up to 64 unknowns all poles are found and the
 * lowest are kept; of more, those that the lowest count + 4 modes become, if fewer are asked for. Of the four
 * those are left out that stay a tenth above the others by v^T Z(s) v = 0 of their undamped shapes.
 * By (30.7) there are d poles if K is positive definite and all orders are below 1. A dashpot or a
 * Maxwell element may stand in one law with a power of such an order. There are d as well if all orders of powers
 * and ranges lie between 1 and 2. Both suppose matrices of dampers that are positive semidefinite; of
 * dampers.h's this is not checked. Else up to 24 unknowns are counted by the argument principle, which
 * sees poles with arg s < 3.14, and one oscillator by (26.11). The principle may count two overdamped
 * modes by mistake if they are nearly alike. If fewer poles are found than there are, that is no error:
 * compare count with expected.
 *
 * Accuracy: seen 1e-15 of |s| for well conditioned Z. Cost: one to four factorisations a pole, and
 * the undamped modes: O(d^3) up to 256 unknowns or for all modes, else by subspace iteration with
 * factors of K.
 * Returns FVI_SUCCESS; FVI_EFAULT; FVI_EINVAL if count > d; FVI_EUNSUP for more than FVI_MOST_POLES
 * poles; FVI_ESING if M is not positive definite; FVI_EMAXITER if the undamped modes were
 * not found; FVI_ENOMEM. On error *poles is untouched. */
int fvi_poles_find(fvi_response *response, size_t count, fvi_poles *poles,
                   fvi_error *error);

/* fvi_poles_free -- give the arrays back; a zeroed one is allowed. */
void fvi_poles_free(fvi_poles *poles);

/* fvi_response_warning_of_... -- what to know before an answer is believed, as the functions of
 * warnings.h: 1 and a text; or 0; or -1, with a text that says so, where there is no memory to find out.
 *
 *   place  the motion is made linear at x, d numbers, where a potential that is not quadratic has a
 *          slope of more than 1e-8 (1 + |x_i|); text: a constant text, or NULL for 0
 *   poles  fewer were found than there are, or how many there are is not known; or all were found that
 *          oscillate, and they are fewer than d. Of 0 the text is untouched
 *
 * Cost: a gradient; nothing. */
int fvi_response_warning_of_place(const fvi_system *system, const double *x, const char **text);
int fvi_response_warning_of_poles(const fvi_poles *poles, size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
