/* src/kernel/kernel_ready.h -- A law at one step, for its modes and its memory. [H 26]
 *
 * Internal; nothing is checked. */
#ifndef FVI_KERNEL_READY_H
#define FVI_KERNEL_READY_H

#include "kernel_general.h"

typedef struct {
    const fvi_kernel *law;
    fvi_kernel_simple *term; /* the fractions of powers of the law */
    size_t terms;
    fvi_delta kind;
    double h;
    int increments;
    double strip; /* of a SYMBOL, as a part of pi/2; 0: it has no modes */
} fvi_kernel_ready;

/* fvi_kernel_ready_function -- the symbol that the caller gave, if that is the law; or NULL. */
const fvi_kernel_term *fvi_kernel_ready_function(const fvi_kernel_ready *r);

/* fvi_kernel_ready_has_modes -- can the tail be a sum of decaying modes? (26.6) The answer goes
 * to *has. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_ready_has_modes(const fvi_kernel_ready *r, int *has);

/* fvi_kernel_ready_modes -- the modes for lags up to N, relative to delta, and how many: rates
 * s and coefficients c, or with s == NULL their number alone. First those of the cut, then
 * those of the poles, then a spring among increments. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_ready_modes(const fvi_kernel_ready *r, double N, double delta,
                           double *s, double *c, size_t *count);

#endif
