/* src/parameter_derivatives/constant_history.h -- What a memory of differences leaves out: a constant. [H 23]
 *
 * Internal. The adjoint run of a method of order 2 begins at J_p; its memory should begin
 * at zero, (23.3), and takes in mu - J_p. What is left out is the memory of a constant, a sum
 * of weights. Where J depends on every p_k, mu jumps at every node, and what is left out is
 * the memory of the sum B of its jumps. */
#ifndef FVI_CONSTANT_HISTORY_H
#define FVI_CONSTANT_HISTORY_H

#include <fvi/convolution_quadrature.h>
#include "run/run_damper.h"
#include "system/dot.h"

/* Of a sequence of `width` numbers at the nodes; where the comment says "each", so many. */
typedef struct {
    fvi_history *memory; /* NULL: nothing is left out */
    size_t width;
    int by_order, has_begun;
    double first;                      /* the first weight, taken out of the sums, which a damping has */
    double theta;                      /* the shift of (23.7); 1/2 of Algorithm 3 */
    double *sum, *sum_by_order;        /* each: what the memory has of this node */
    double *value, *rate, *by_theta;   /* each: see below */
    size_t taps, place;                /* of a factor of the weights; the latest is at [place] */
    double g[FVI_BDF2_TAPS], gdot[FVI_BDF2_TAPS];
    double *past, *past_by_order; /* 2 taps each: without the factor, twice, so that the last
                                     ones stand in a row */
    double *now, *now_by_order;   /* each: what the memory gives */
    double *block;                /* all these; owned */
} fvi_constant_history;

/* fvi_power_factor -- what the weights of a power have besides (1 - z)^(2 alpha).
 *
 *   scheme   as below
 *   g, gdot  output, zeros, FVI_BDF2_TAPS numbers each: the factor by powers of z, (13.11)
 *            or (13.16), and its derivative by 2 alpha
 *
 * Returns how many of them there are; 1 if there is no factor. */
size_t fvi_power_factor(fvi_scheme scheme, double alpha, double *g,
                        double *gdot);

/* fvi_bdf2_log -- ln((3 - z)/2) by powers of z, FVI_BDF2_TAPS numbers, into l. Returns how many. */
size_t fvi_bdf2_log(double *l);

/* fvi_power_factor_sum -- sum_n g_n past_n, `taps` >= 1 numbers each, past[0] having come in last. Of many
 * taps in four partial sums, so that no product waits for the sum of those before. */
double fvi_power_factor_sum_by_fours(size_t taps, const double *g, const double *past);

static inline double fvi_power_factor_sum(size_t taps, const double *g, const double *past)
{
    return taps > 4 ? fvi_power_factor_sum_by_fours(taps, g, past) : fvi_dot(taps, g, past);
}

/* fvi_constant_history_start -- before node N.
 *
 *   method    without stages
 *   of        the damper whose memory it is
 *   width     1, of a constant; d, of what lambda has jumped by
 *   by_order  nonzero if the derivatives by 2 alpha and by the shift are wanted
 *   c         output; in any case to be given back by fvi_constant_history_stop
 *
 * Returns FVI_SUCCESS, what fvi_run_damper_history returns; FVI_ENOMEM. */
int fvi_constant_history_start(const fvi_method *method, const fvi_run *run,
                               const fvi_run_damper *of, size_t width, int by_order,
                               fvi_constant_history *c);

/* fvi_constant_history_next -- for N, N - 1, ..., 0: B is the sequence there, `change` its
 * increment. By what of h^(1 - 2 alpha) C the momentum falls, as c->value; its derivative by
 * 2 alpha, the shift held, as c->rate, and by the shift as c->by_theta.          [(23.23)] */
int fvi_constant_history_next(fvi_constant_history *c, const double *B,
                              const double *change);

void fvi_constant_history_stop(fvi_constant_history *c);

#endif
