/* src/parameter_derivatives/constant_history.h -- The history of a constant, which a history of differences leaves out.
 * [H 23]
 *
 * Internal. The adjoint run of a method of order 2 begins at J_p. By (23.3) its history should begin at zero. But it
 * takes in mu - J_p, so the history of the constant J_p is left out. That history is a sum of weights, and it is
 * computed here. If J depends on every p_k, mu jumps at every node, and what is left out is the history of the sum B of
 * its jumps. */
#ifndef FVI_CONSTANT_HISTORY_H
#define FVI_CONSTANT_HISTORY_H

#include <fvi/convolution_quadrature.h>
#include "run/run_damper.h"
#include "system/dot.h"

/* For a sequence of `width` numbers at the nodes; "each" means that an array has so many numbers. */
typedef struct {
    fvi_history *memory; /* NULL: nothing is left out */
    size_t width;
    int by_order, has_begun;
    double first;                      /* the first weight, taken out of the sums, as in a damping */
    double theta;                      /* the shift of (23.7); 1/2 for Algorithm 3 */
    double *sum, *sum_by_order;        /* each: the sums of the history at this node */
    double *value, *rate, *by_theta;   /* each: see fvi_constant_history_next */
    size_t taps, place;                /* of a factor of the weights; the latest term is at [place] */
    double g[FVI_BDF2_TAPS], gdot[FVI_BDF2_TAPS];
    double *past, *past_by_order; /* 2 taps each: the last terms without the factor, stored twice so that they stand in
                                     a row */
    double *now, *now_by_order;   /* each: the last sums of the history without the factor */
    double *block;                /* the memory of all these arrays; owned */
} fvi_constant_history;

/* fvi_power_factor -- the factor g(z) that the weights of a power have besides (1 - z)^(2 alpha).
 *
 *   scheme   the method
 *   g, gdot  outputs, zeros before, FVI_BDF2_TAPS numbers each: the coefficients of the factor in powers of z, (13.11)
 *            or (13.16), and their derivatives by 2 alpha
 *
 * Returns how many coefficients there are; 1 if there is no factor. */
size_t fvi_power_factor(fvi_scheme scheme, double alpha, double *g,
                        double *gdot);

/* fvi_bdf2_log -- write the coefficients of ln((3 - z)/2) in powers of z to l, FVI_BDF2_TAPS numbers. Returns how
 * many. */
size_t fvi_bdf2_log(double *l);

/* fvi_power_factor_sum -- sum_n g_n past_n over `taps` >= 1 terms; past[0] is the latest. More than 4 terms are summed
 * in four partial sums, so that no product waits for the sum of the products before it. */
double fvi_power_factor_sum_by_fours(size_t taps, const double *g, const double *past);

static inline double fvi_power_factor_sum(size_t taps, const double *g, const double *past)
{
    return taps > 4 ? fvi_power_factor_sum_by_fours(taps, g, past) : fvi_dot(taps, g, past);
}

/* fvi_constant_history_start -- begin, before node N.
 *
 *   method    without stages
 *   of        the damper whose history it is
 *   width     1 for a constant; d, or the history numbers of a damper, for the jumps of lambda
 *   by_order  nonzero if the derivatives by 2 alpha and by the shift are wanted
 *   c         output; give it back with fvi_constant_history_stop, also after an error
 *
 * Returns FVI_SUCCESS; what fvi_run_damper_history returns; FVI_ENOMEM. */
int fvi_constant_history_start(const fvi_method *method, const fvi_run *run,
                               const fvi_run_damper *of, size_t width, int by_order,
                               fvi_constant_history *c);

/* fvi_constant_history_next -- take in B, the sequence at node N, then N - 1, ..., 0; `change` is its increment. Writes
 * the factor of h^(1 - 2 alpha) C by which the momentum falls to c->value, its derivative by 2 alpha with the shift
 * fixed to c->rate, and its derivative by the shift to c->by_theta. [(23.23)] */
int fvi_constant_history_next(fvi_constant_history *c, const double *B,
                              const double *change);

void fvi_constant_history_stop(fvi_constant_history *c);

#endif
