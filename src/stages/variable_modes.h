/* src/stages/variable_modes.h -- The history of variable steps as a sum of modes. [H 22]
 *
 * The derivative of order beta, -1 < beta < 1, of velocities v is a sum over modes w. Each mode follows w' = -sigma
 * w + v, with one mode for each sigma = exp(L j), where j is an integer and L is the spacing. Over a step of length h
 * with the values v at its stages, Lobatto IIIC gives
 *
 *     mu = h sigma,   a(mu) = (mu + A^{-1})^{-1} e_1 / b_1,   p = mu b.a,
 *
 *     beta <= 0: y = sigma w,         y += mu a.u - p y,       u_i = b_i v_i backwards  (22.6)
 *     beta > 0:  z = v_e - sigma w,   z += ds - mu a.u - p z,  with v - v_e in place of v    (22.7)
 *
 * Here v_e is the last velocity of the step before, and ds = v_s - v_e. The history at the stages of the next step, of
 * length h, is
 *
 *     H_i = sum_q weight_q a_i(h sigma_q) y_q,                                    (22.10)
 *     weight_q = (sin(pi min(|beta|, 1 - |beta|)) / pi) L sigma_q^beta
 *
 * with corrections at both ends (22.12). A step h = exp(L k) finds a and p of all its modes in one table over j + k,
 * which is computed once in a process.
 *
 * A mode with mu far above 1 depends on the last step only, so the loops skip it: the mode is inactive. If the steps
 * become shorter, the mode is activated, that is, its state is computed from the last step. */
#ifndef FVI_VARIABLE_MODES_H
#define FVI_VARIABLE_MODES_H

#include "variable_rule.h"
#include <fvi/archive.h>

/* The length of a step: h = exp(L k), or any h with k = FVI_OFF_LATTICE. */
enum { FVI_OFF_LATTICE = -100000 };
typedef struct {
    double h;
    int k;
} fvi_length;

/* fvi_length_is_possible -- Return nonzero if a step may have this length: 0 < h <= longest, and h = exp(L k) up to
 * rounding errors unless k is FVI_OFF_LATTICE. */
int fvi_length_is_possible(fvi_length length, double longest);

typedef struct fvi_modes fvi_modes;

/* The density of the modes: every point of the lattice in a wide range, every point in a narrower range, or every
 * second point in the narrower range. */
typedef enum {
    FVI_MODES_FINE,
    FVI_MODES_MEDIUM,
    FVI_MODES_COARSE
} fvi_modes_kind;

/* fvi_modes_alloc -- Allocate the modes of d coordinates, at rest.
 *
 *   rule   a rule of 6 or 8 stages
 *   beta   -1 <= beta <= 1. For 0 and 1, H is 0 up to rounding errors, and the modes serve only its derivative by beta,
 *          taken from below; for -1, H is the integral of v
 *   d      number of coordinates, >= 1
 *   T      duration of the whole run, > 0, seconds; no step is longer
 *   least  no step is shorter; >= 1e-250 T
 *   modes  output; free it with fvi_modes_free
 *
 * Accuracy of H, relative to the sum of the absolute values of its terms: 2e-14 for FINE, 3e-10 for MEDIUM, 1e-7 for
 * COARSE (no proof; tested against the matrix power). Memory: O(d Q), where Q is about 64 + 3.9 ln(T / least), 48 + 3.9
 * ln(T / least) or 24 + 1.9 ln(T / least).
 *
 * Return FVI_SUCCESS; FVI_EDOM if `least` is so short that the fastest decay rate, up to 2e4 / least, is no finite
 * number; or FVI_ENOMEM. */
int fvi_modes_alloc(const fvi_variable_rule *rule, fvi_modes_kind kind,
                    double beta, size_t d, double T, double least,
                    fvi_modes **modes);

/* fvi_modes_of_rates -- Allocate modes with arbitrary decay rates. They are always active.
 *
 *   rises         zero: the modes are y of (22.6); nonzero: z of (22.7)
 *   d, T          as for fvi_modes_alloc
 *   count         number of modes, >= 1
 *   rate, weight  count numbers each, as sigma and weight in (22.10); rate > 0
 *
 * A step of a new length costs O(Q s^2), where Q is count rounded up to a multiple of FVI_LANES. fvi_modes_add_order
 * cannot be used. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_modes_of_rates(const fvi_variable_rule *rule, int rises, size_t d,
                       double T, size_t count, const double *rate,
                       const double *weight, fvi_modes **modes);

/* fvi_modes_add_order -- Prepare fvi_modes_history_by_order. Call it before the first step. A copy of the modes has no
 * derivatives. Memory: O(Q). Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_modes_add_order(fvi_modes *modes);

/* fvi_modes_copy -- Copy the modes without their derivatives by beta. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_modes_copy(const fvi_modes *from, fvi_modes **to);

/* fvi_modes_archive -- Serialise the state of the modes between two steps, and their rates and weights as constants.
 * Return FVI_SUCCESS; FVI_EINVAL if the archive holds no possible state; or the code of the archive. */
int fvi_modes_archive(fvi_modes *modes, fvi_archive *archive);

/* fvi_modes_free -- Free the modes. NULL is allowed. */
void fvi_modes_free(fvi_modes *modes);

/* fvi_modes_begin -- Begin the next step, or another trial of it, with this length. Activate the modes that the step
 * needs. Cost: O(Q s) if the step is off the lattice or modes are activated. */
void fvi_modes_begin(fvi_modes *modes, fvi_length length);

/* fvi_modes_history -- Compute H of (22.10) for coordinate j in the step that has begun. H is an output of FVI_LANES
 * numbers; those behind the s-th are zero. Cost: O(Q s). */
void fvi_modes_history(const fvi_modes *modes, size_t j, double *H);

/* fvi_modes_history_by_order -- Compute dH/dbeta with the states y or z held fixed, ordered as H. fvi_modes_add_order
 * must have been called. Cost: O(Q s). (23.18) */
void fvi_modes_history_by_order(const fvi_modes *modes, size_t j, double *H);

/* fvi_modes_advance -- Take the step that has begun, for coordinate j: (22.6), (22.7). Advance all coordinates before
 * the next call of fvi_modes_begin.
 *
 *   v   s numbers: the stage velocities of the step for beta <= 0, v - v_e for beta > 0
 *   ve  v_e, the last velocity of the step before */
void fvi_modes_advance(fvi_modes *modes, size_t j, const double *v, double ve);

/* fvi_modes_activate_all -- Activate all modes of all coordinates, between two steps. */
void fvi_modes_activate_all(fvi_modes *modes);

/* fvi_modes_count -- Return the number of modes of a coordinate.
 * fvi_modes_decay -- Return sigma of mode q.
 * fvi_modes_add -- Add `more` to y or z of mode q of coordinate j. All modes must be active. */
size_t fvi_modes_count(const fvi_modes *modes);
double fvi_modes_decay(const fvi_modes *modes, size_t q);
void fvi_modes_add(fvi_modes *modes, size_t j, size_t q, double more);

/* fvi_modes_accumulate -- Return sum_q weight_q more_q w_q for coordinate j, in an adjoint run with all modes active.
 * The sum is the factor of mu if a run adds `more` to its history. (23.25)
 *
 *   more  one number for each mode: the change of y divided by sigma, or the change of z
 *   ve    the last mu
 *   rate  NULL, or output: the derivative by beta; fvi_modes_add_order must have been called */
double fvi_modes_accumulate(const fvi_modes *modes, size_t j, const double *more,
                      double ve, double *rate);

#endif
