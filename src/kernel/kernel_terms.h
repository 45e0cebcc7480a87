/* src/kernel/kernel_terms.h -- What damping_laws.c shares with other files. [H 26]
 *
 * Internal; nothing is checked, but by fvi_kernel_check_weights. */
#ifndef FVI_KERNEL_TERMS_H
#define FVI_KERNEL_TERMS_H

#include <fvi/damping_laws.h>

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>

/* rho s^{2 alpha} / (1 + time s^{2 below}): every term is one of these, or many. */
typedef struct {
    double rho, alpha, time, below;
} fvi_kernel_simple;

/* fvi_kernel_is_power -- is the law one power of s? */
static inline int fvi_kernel_is_power(const fvi_kernel *law)
{
    return law->count == 1 && law->term->kind == FVI_KERNEL_POWER;
}

/* fvi_kernel_check_terms -- as fvi_kernel_check, but no poles of a function are looked for: it may be one of the library's
 * own, which stands for C in a part of the plane only (src/methods/shifted_kernel.c). */
int fvi_kernel_check_terms(const fvi_kernel *law);

/* fvi_kernel_dashpot -- lim C(s)/s, s to infinity, of a law that grows like s: the dashpot in it; like s / log s
 * it is 0. */
double fvi_kernel_dashpot(const fvi_kernel *law);

/* fvi_kernel_is_relaxation -- a Maxwell element: its one pole is on the cut, and all of it. */
static inline int fvi_kernel_is_relaxation(const fvi_kernel_simple *t)
{
    return t->rho > 0 && t->alpha == 0.5 && t->below == 0.5 && t->time > 0;
}

/* fvi_kernel_on_the_cut -- Im C(-r + i0) by ln r, with `factor` instead of rho: orders near 0
 * reach nodes where r is below all doubles. */
//> cut
static inline double fvi_kernel_on_the_cut(const fvi_kernel_simple *t,
                                           double factor, double ln_radius)
{
    const double above = 2 * t->alpha, below = 2 * t->below,
                 q = exp(above * ln_radius),
                 Tq = t->time * exp(below * ln_radius),
                 re = 1 + Tq * cos(M_PI * below), im = Tq * sin(M_PI * below),
                 turn = sin(M_PI * above) + Tq * sin(M_PI * (above - below));
    return factor * q * turn / (re * re + im * im);
}
//< cut

/* fvi_kernel_tail -- the sums of mu^n Im C(-mu/h + i0), and of mu^(n + 1) times that, over ln mu =
 * first - step, first - 2 step, ..., with `factor` instead of rho: of a power geometric
 * sequences, of a fraction in the end. Added to S0 and S1.                         (17.12) */
void fvi_kernel_tail(const fvi_kernel_simple *t, double factor, double ln_h,
                     double first, double step, double n, double *S0,
                     double *S1);

/* fvi_kernel_simple_at -- C(s) of one such term at s = modulus e^(i angle). */
double complex fvi_kernel_simple_at(const fvi_kernel_simple *t, double modulus,
                                    double angle);

/* fvi_kernel_at -- C(s) by the principal logarithm, s != 0, and in *slope s C'(s): of a range
 * of orders to a relative u / |ln s|. slope may be NULL. */
double complex fvi_kernel_at(const fvi_kernel *law, double complex s,
                          double complex *slope);

/* fvi_kernel_check_weights -- fvi_kernel_check, and are these weights that a law has?
 * Returns what it returns; FVI_EINVAL for kind, FVI_EDOM for h. */
int fvi_kernel_check_weights(const fvi_kernel *law, fvi_delta kind, double h);

/* fvi_kernel_flatten -- the terms that are so, as such, a new array for the caller to free.
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_flatten(const fvi_kernel *law, fvi_kernel_simple **terms, size_t *count);

/* fvi_kernel_series -- adds to w the coefficients of C(delta(z)/h), divided by 1 - z if
 * `increments` is 1; room for 2 count numbers. */
void fvi_kernel_series(const fvi_kernel_simple *t, fvi_delta kind, double h,
                    int increments, size_t count, double *room, double *w);

/* fvi_kernel_has_modes -- whether the weights of a law by `kind`, with step h, are a sum of
 * decaying modes after the window: 1 or 0 goes to *has. Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_has_modes(const fvi_kernel *law, fvi_delta kind, double h, int *has);

#endif
