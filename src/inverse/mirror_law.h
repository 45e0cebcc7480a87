/* src/inverse/mirror_law.h -- What a term of a law gives, going backwards. [Chapter 23]
 *
 * Internal. With C the symbol of the term for rho = 1 and L = ln(delta(z)/h),
 *
 *     dC/d alpha = 2 L C (1 - time C),     dC/d time = -C^2               (23.21)
 *
 * of a power (time 0), a fraction or a Maxwell element; of a range of orders a and e
 * dC/da = -s^{2a}, dC/de = s^{2e}. All of these are memories, one behind another. */
#ifndef FVI_MIRROR_LAW_H
#define FVI_MIRROR_LAW_H

#include <fvi/adjoint.h>
#include <fvi/convolution_quadrature.h>

/* One memory of a law with its first weight. */
typedef struct {
    fvi_memory *memory;
    double first;
} fvi_mirror_convolution;

/* Where the comment says "each", d numbers. */
typedef struct {
    fvi_law_term term; /* with rho = 1 */
    size_t d;
    double log_h, rho;                   /* of the law */
    fvi_mirror_convolution self, again;  /* of nu; of what self gives */
    fvi_mirror_convolution lower, upper; /* of a range: powers of its ends */
    fvi_memory *log;                     /* of (1 - z)^0, with its rate */
    size_t taps, place;                  /* of ln((3 - z)/2); 0: none */
    double l[FVI_BDF2_TAPS];
    double *sum, *change; /* each: C nu, and its increment */
    double *square;       /* each: C^2 nu, or a power */
    double *left, *moved; /* each: C (1 - time C) nu, and its increment */
    double *rate;         /* each: its derivative by the order of (1 - z)^0 */
    double *past;         /* each of taps: left */
    double *block;        /* all these; owned */
} fvi_mirror_term;

/* fvi_mirror_law_asks -- are derivatives by numbers of a law wanted? */
int fvi_mirror_law_asks(const fvi_gradients *want);

/* fvi_mirror_is_fraction, _has_order -- a ZENER or MAXWELL; a POWER or ZENER. */
int fvi_mirror_is_fraction(const fvi_law_term *t);
int fvi_mirror_has_order(const fvi_law_term *t);

/* fvi_mirror_unit_term -- the term with rho = 1, time = 0 if it has none; and its rho. */
void fvi_mirror_unit_term(const fvi_law_term *of, fvi_law_term *unit,
                          double *rho);

/* fvi_mirror_term_start -- the memories for what is wanted of term i of run->law, of `d`
 * numbers. t is in any case to be given back by fvi_mirror_term_stop. Returns FVI_SUCCESS;
 * what fvi_law_memory and fvi_memory_alloc_rate return; FVI_ENOMEM. */
int fvi_mirror_term_start(const fvi_run *run, const fvi_gradients *want,
                          fvi_quadrature kind, size_t i, size_t d,
                          fvi_mirror_term *t);

/* fvi_mirror_term_meet -- nu comes in; the sums that the derivatives of C make of it, times
 * `weight`, are taken away from entry i of what is wanted.
 *
 *   nu, dnu, weight  d numbers each; dnu the increment of nu */
int fvi_mirror_term_meet(fvi_mirror_term *t, const double *nu,
                         const double *dnu, const double *weight,
                         const fvi_gradients *want, size_t i);

void fvi_mirror_term_stop(fvi_mirror_term *t);

#endif
