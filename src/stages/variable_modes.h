/* src/stages/variable_modes.h -- The past of variable steps, as modes. [H 22]
 *
 * What a derivative of order beta, -1 < beta < 1, keeps of velocities v is a sum
 * over modes w' = -sigma w + v, one for each sigma = exp(L j), j whole, L the spacing.
 * Over a step of length h with the values v at its stages Lobatto IIIC gives, with
 *
 *     mu = h sigma,   a(mu) = (mu + A^{-1})^{-1} e_1 / b_1,   p = mu b.a,
 *
 *     beta <= 0: y = sigma w,         y += mu a.u - p y,       u_i = b_i v_i backwards  (22.6)
 *     beta > 0:  z = v_e - sigma w,   z += ds - mu a.u - p z,  v - v_e for v            (22.7)
 *
 * v_e the last velocity of the step before, ds = v_s - v_e; and the history at the
 * stages of the next step, of length h, is
 *
 *     H_i = sum_q weight_q a_i(h sigma_q) y_q,                                    (22.10)
 *     weight_q = (sin(pi min(|beta|, 1 - |beta|)) / pi) L sigma_q^beta
 *
 * corrected at both ends (22.12). A step h = exp(L k) finds a and p of all its modes in
 * one table over j + k, which is made once in a process. Modes with mu far above 1 see
 * only the last step: they sleep, and are woken from it when the steps become shorter. */
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

/* fvi_length_is_possible -- could a step have this length, where no step is longer than
 * `longest`? h must be what k says, but for roundings. */
int fvi_length_is_possible(fvi_length length, double longest);

typedef struct fvi_modes fvi_modes;

/* How many modes: every point of the lattice; those of a narrower range; every second one of
 * that. */
typedef enum {
    FVI_MODES_FINE,
    FVI_MODES_MEDIUM,
    FVI_MODES_COARSE
} fvi_modes_kind;

/* fvi_modes_alloc -- the modes of d coordinates, at rest.
 *
 *   rule   of 6 or 8 stages
 *   beta   -1 <= beta <= 1. At 0 and 1 H is 0 but for rounding: only its rate, from
 *          below, needs modes; at -1 H is the integral of v
 *   d      how many coordinates, >= 1
 *   T      the time of the whole run, > 0; no step is longer
 *   least  no step is shorter, 1e-250 T at least
 *   modes  output; free it with fvi_modes_free
 *
 * Accuracy of H: 2e-14 of its size without the modes' signs, 3e-10 and 1e-7 of the other
 * kinds (no proof; tested against the matrix power). Memory O(d Q), Q about 64 + 3.9 ln(T /
 * least), 48 + 3.9 ln(T / least) or 24 + 1.9 ln(T / least).
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_modes_alloc(const fvi_variable_rule *rule, fvi_modes_kind kind,
                    double beta, size_t d, double T, double least,
                    fvi_modes **modes);

/* fvi_modes_of_rates -- modes of any rates, none of which ever sleeps.
 *
 *   rises         zero: y is kept, (22.6); else z, (22.7)
 *   d, T          as above
 *   count         how many, >= 1
 *   rate, weight  count numbers each: those of (22.10); 0 < rate
 *
 * A step of a new length costs O(Q s^2), Q the next multiple of FVI_LANES. Not for
 * fvi_modes_add_order. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_modes_of_rates(const fvi_variable_rule *rule, int rises, size_t d,
                       double T, size_t count, const double *rate,
                       const double *weight, fvi_modes **modes);

/* fvi_modes_add_order -- before the first step: make what fvi_modes_history_by_order reads. A
 * copy has no rate. Memory O(Q). Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_modes_add_order(fvi_modes *modes);

/* fvi_modes_copy -- the same again. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_modes_copy(const fvi_modes *from, fvi_modes **to);

/* fvi_modes_archive -- between steps: what steps have changed; and where the modes are, which
 * they do not. Returns FVI_EINVAL if what the archive has written is no state of them; what
 * the archive returns. */
int fvi_modes_archive(fvi_modes *modes, fvi_archive *archive);

/* fvi_modes_free -- give everything back. NULL is allowed. */
void fvi_modes_free(fvi_modes *modes);

/* fvi_modes_begin -- the next step, or another trial of it, has this length.
 * Activates modes. Cost O(Q s) where it is off the lattice or modes are activated. */
void fvi_modes_begin(fvi_modes *modes, fvi_length length);

/* fvi_modes_history -- H of (22.10) for coordinate j in the step that has begun.
 *   H  output: FVI_LANES numbers, those behind the s-th zero. Cost O(Q s) */
void fvi_modes_history(const fvi_modes *modes, size_t j, double *H);

/* fvi_modes_history_by_order -- dH/dbeta, y or z as they are: a second reading of the modes.
 * fvi_modes_add_order must have been called.                                    (23.18)
 *   H  output, as above. Cost O(Q s) */
void fvi_modes_history_by_order(const fvi_modes *modes, size_t j, double *H);

/* fvi_modes_advance -- the step that has begun is taken: (22.6), (22.7) for coordinate j. All
 * coordinates must be advanced before the next fvi_modes_begin.
 *   v   the stage velocities of the step for beta <= 0, v - v_e for beta > 0, s numbers
 *   ve  v_e, the last velocity of the step before */
void fvi_modes_advance(fvi_modes *modes, size_t j, const double *v, double ve);

/* fvi_modes_activate_all -- between steps: all modes of all coordinates are active. */
void fvi_modes_activate_all(fvi_modes *modes);

/* fvi_modes_count, fvi_modes_decay, fvi_modes_add -- the modes of a coordinate: their
 * number, the sigma of the q-th, and `more` to be added to its y or z, when all are
 * active. */
size_t fvi_modes_count(const fvi_modes *modes);
double fvi_modes_decay(const fvi_modes *modes, size_t q);
void fvi_modes_add(fvi_modes *modes, size_t j, size_t q, double more);

/* fvi_modes_accumulate -- of an adjoint run, when all modes are active: what a run that keeps `more`
 * besides would do to what mu multiplies, sum_q weight_q more_q w_q.           (23.25)
 *   more   for each mode: what y would be more, over sigma; or z
 *   ve     the last mu
 *   rate   output, its derivative by beta; fvi_modes_add_order must have been called.
 *          NULL: not wanted */
double fvi_modes_accumulate(const fvi_modes *modes, size_t j, const double *more,
                      double ve, double *rate);

#endif
