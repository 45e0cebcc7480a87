/* src/kernel/kernel_terms.h -- Functions on the terms of a law that several files share. [H 26]
 *
 * This header is internal. Only fvi_kernel_check_terms and fvi_kernel_check_weights check their arguments. */
#ifndef FVI_KERNEL_TERMS_H
#define FVI_KERNEL_TERMS_H

#include <fvi/damping_laws.h>

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>

/* A simple term is a fraction of two powers, or one power if time = 0:
 *
 *     rho s^{2 alpha} / (1 + time s^{2 below})
 *
 * Every term that is not general (kernel_general.h) is a simple term or a sum of simple terms. */
typedef struct {
    double rho;   /* factor, >= 0 */
    double alpha; /* half of the order above the fraction bar */
    double time;  /* >= 0, in units of a time to the power 2 below */
    double below; /* half of the order below the fraction bar; alpha for a power */
} fvi_kernel_simple;

/* fvi_kernel_term_is_power -- Return 1 if a term is rho s^{2 alpha}: a POWER, or a ZENER with time = 0. */
static inline int fvi_kernel_term_is_power(const fvi_kernel_term *t)
{
    return t->kind == FVI_KERNEL_POWER || (t->kind == FVI_KERNEL_ZENER && t->time == 0);
}

/* fvi_kernel_is_power -- Return 1 if the law is one POWER. A law of one ZENER with time = 0 is still a law. */
static inline int fvi_kernel_is_power(const fvi_kernel *law)
{
    return law->count == 1 && law->term->kind == FVI_KERNEL_POWER;
}

/* fvi_kernel_check_terms -- Check a law as fvi_kernel_check does, but do not search for poles of a SYMBOL. It is
 * for the library's own functions, such as that of src/methods/shifted_kernel.c, which changes its formula at h |s|
 * = 100. */
int fvi_kernel_check_terms(const fvi_kernel *law);

/* fvi_kernel_dashpot -- Return the limit of C(s)/s at infinity, which is the dashpot in a law that grows like s. A law
 * that grows like s / log s has the limit 0. */
double fvi_kernel_dashpot(const fvi_kernel *law);

/* fvi_kernel_is_relaxation -- Return 1 if the term is a Maxwell element. Its symbol has one pole, which lies on the
 * negative axis, and no cut. */
static inline int fvi_kernel_is_relaxation(const fvi_kernel_simple *t)
{
    return t->rho > 0 && t->alpha == 0.5 && t->below == 0.5 && t->time > 0;
}

/* fvi_kernel_has_cut -- Return 1 if the term has values on both sides of the negative axis that differ. Whole powers of
 * s have none, and neither has a Maxwell element. */
int fvi_kernel_has_cut(const fvi_kernel_simple *t);

/* fvi_kernel_on_the_cut -- Return Im C(-r + i0), the value on the upper side of the cut, with `factor` in place of rho.
 * The argument is ln r, because for orders near 0 some nodes have an r below the smallest double. With s = r e^{i pi}
 * it is the imaginary part of s^above times the conjugate of 1 + time s^below, divided by the square of the modulus of
 * 1 + time s^below. */
//> cut
static inline double fvi_kernel_on_the_cut(const fvi_kernel_simple *t,
                                           double factor, double ln_radius)
{
    const double above = 2 * t->alpha, below = 2 * t->below,
                 power = exp(above * ln_radius),
                 time_power = t->time * exp(below * ln_radius),
                 re = 1 + time_power * cos(M_PI * below),
                 im = time_power * sin(M_PI * below),
                 sine = sin(M_PI * above) + time_power * sin(M_PI * (above - below));
    return factor * power * sine / (re * re + im * im);
}
//< cut

/* fvi_kernel_tail -- Sum the trapezoidal rule over all slow rates mu of the cut, ln mu = first - step, first - 2 step,
 * ... without end. (17.12)
 *
 *   factor  takes the place of rho
 *   ln_h    logarithm of the step length
 *   n       the least power of mu
 *   S0      the sum of mu^n Im C(-mu/h + i0) is added to it
 *   S1      the sum of mu^(n + 1) Im C(-mu/h + i0) is added to it
 *
 * For a power the sums are geometric series. A fraction is summed term by term until it is a power to all digits. */
void fvi_kernel_tail(const fvi_kernel_simple *t, double factor, double ln_h,
                     double first, double step, double n, double *S0,
                     double *S1);

/* fvi_kernel_simple_at -- Return C(s) of a simple term at s = modulus e^(i angle). */
double complex fvi_kernel_simple_at(const fvi_kernel_simple *t, double modulus,
                                    double angle);

/* fvi_kernel_at -- Return C(s) at s != 0, with the principal logarithm, and write s C'(s) to *slope unless slope is
 * NULL. For a DISTRIBUTED the relative error is u / |ln s|. */
double complex fvi_kernel_at(const fvi_kernel *law, double complex s,
                          double complex *slope);

/* fvi_kernel_check_weights -- Check a law with fvi_kernel_check_terms, and check the quadrature and the step. Return
 * the codes of fvi_kernel_check_terms; FVI_EINVAL for kind; FVI_EDOM for h. */
int fvi_kernel_check_weights(const fvi_kernel *law, fvi_delta kind, double h);

/* fvi_kernel_flatten -- Write all terms that are not general as simple terms. A DISTRIBUTED becomes 64 simple terms.
 * `terms` is a new array, which the caller frees. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_flatten(const fvi_kernel *law, fvi_kernel_simple **terms, size_t *count);

/* fvi_kernel_series -- Add to w the first `count` weights of a simple term: the coefficients of C(delta(z)/h), divided
 * by 1 - z if increments = 1. room is workspace for 2 count numbers. */
void fvi_kernel_series(const fvi_kernel_simple *t, fvi_delta kind, double h,
                    int increments, size_t count, double *room, double *w);

/* fvi_kernel_has_modes -- Write to *has whether the weights of a law from lag FVI_TAIL on (memory/history_kinds.h) are
 * a sum of decaying modes. Return FVI_SUCCESS or FVI_ENOMEM. */
int fvi_kernel_has_modes(const fvi_kernel *law, fvi_delta kind, double h, int *has);

#endif
