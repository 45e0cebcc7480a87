/* src/memory/kernel_terms.h -- What damping_laws.c shares with other files. [H 26]
 *
 * Internal; nothing is checked, but by fvi_kernel_check_weights. */
#ifndef FVI_KERNEL_TERMS_H
#define FVI_KERNEL_TERMS_H

#include <fvi/damping_laws.h>

#include <complex.h>

/* rho s^{2 alpha} / (1 + time s^{2 alpha}): every term is one of these, or many. */
typedef struct {
    double rho, alpha, time;
} fvi_kernel_simple;

/* fvi_kernel_at -- C(s) by the principal logarithm, s != 0, and in *slope s C'(s): of a range
 * of orders to a relative u / |ln s|. */
double complex fvi_kernel_at(const fvi_kernel *law, double complex s,
                          double complex *slope);

/* fvi_kernel_check_weights -- fvi_kernel_check, and are these weights that a law has?
 * Returns what it returns; FVI_EINVAL for kind, FVI_EDOM for h. */
int fvi_kernel_check_weights(const fvi_kernel *law, fvi_delta kind, double h);

/* fvi_kernel_flatten -- the law as such terms, a new array for the caller to free.
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_flatten(const fvi_kernel *law, fvi_kernel_simple **terms, size_t *count);

/* fvi_kernel_series -- adds to w the coefficients of C(delta(z)/h), divided by 1 - z if
 * `increments` is 1; room for 2 count numbers. */
void fvi_kernel_series(const fvi_kernel_simple *t, fvi_delta kind, double h,
                    int increments, size_t count, double *room, double *w);

/* fvi_kernel_has_modes -- whether the weights of a law by `kind`, with step h, are a sum of
 * decaying modes after the window; 0 also if there is no memory to see. */
int fvi_kernel_has_modes(const fvi_kernel *law, fvi_delta kind, double h);

#endif
