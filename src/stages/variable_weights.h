/* src/stages/variable_weights.h -- Compute the weights of the modes of variable steps.       [H 22] */
#ifndef FVI_VARIABLE_WEIGHTS_H
#define FVI_VARIABLE_WEIGHTS_H

#include "variable_rule.h"

/* The modes have the rates sigma_q = exp(L (first + every q)), 0 <= q < Q, where L is the spacing. They represent a
 * derivative of order beta, -1 <= beta <= 1; at -1 the weights are the limit from above. up points to exp(L every q),
 * q < FVI_RUNGS, which every table contains (fvi_mode_table). */
enum { FVI_RUNGS = 16 };
typedef struct {
    size_t every, Q;
    int first;
    double beta;
    const double *up;
} fvi_mode_ladder;

/* fvi_mode_weights -- Compute the decay rates and the weights of the modes. (22.10) to (22.12)
 *
 *   sigma, weight  outputs, Q numbers each; the weights include the corrections of the lower end
 *   top            output, FVI_ENDS numbers: the corrections of the upper end. If mode t is the last mode that is read,
 *                  the weight of mode t - l fvi_variable_apart(every) grows by top[l] times the weight of mode t */
void fvi_mode_weights(const fvi_mode_ladder *ladder, double *sigma,
                      double *weight, double *top);

/* fvi_mode_weights_by_order -- Compute the derivatives of the weights by beta. At beta = 0 the derivative is taken from
 * below, and at beta = -1 from above, where the modes are y of (22.6). (23.18)
 *
 *   rate, top_rate  outputs, Q and FVI_ENDS numbers */
void fvi_mode_weights_by_order(const fvi_mode_ladder *ladder, double *rate,
                           double *top_rate);

#endif
