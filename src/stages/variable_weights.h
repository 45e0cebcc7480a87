/* src/stages/variable_weights.h -- What the modes are read with.       [H 22] */
#ifndef FVI_VARIABLE_WEIGHTS_H
#define FVI_VARIABLE_WEIGHTS_H

#include "variable_rule.h"

/* Modes sigma_q = exp(L (first + every q)), L the spacing, 0 <= q < Q, and the order of
 * what they keep, -1 <= beta <= 1; at -1 the weights are the limit of those above. Also
 * exp(L every q), q < FVI_RUNGS: they are in every table (fvi_mode_table). */
enum { FVI_RUNGS = 16 };
typedef struct {
    size_t every, Q;
    int first;
    double beta;
    const double *up;
} fvi_mode_ladder;

/* fvi_mode_weights -- their rates and their weights.                  (22.10) to (22.12)
 *
 *   sigma, weight  outputs, Q numbers each, the lower end of the weights closed
 *   top            output, FVI_ENDS numbers: what the upper end adds to the weight of the
 *                  mode l fvi_variable_apart(every) below the last one that is read, times
 *                  the weight of that */
void fvi_mode_weights(const fvi_mode_ladder *ladder, double *sigma,
                      double *weight, double *top);

/* fvi_mode_weights_by_order -- their derivatives by beta, at beta = 0 and -1 from the side where
 * y is kept, (22.6), and not z: from below, and from above.                (23.18)
 *
 *   rate, top_rate  outputs, Q and FVI_ENDS numbers */
void fvi_mode_weights_by_order(const fvi_mode_ladder *ladder, double *rate,
                           double *top_rate);

#endif
