/* src/parameter_derivatives/node_terms.h -- The terms of a law by their numbers, at nodes.    [H 23]
 *
 * Internal, for runs that go backwards and for tangents. With C the symbol of the term for rho = 1 and
 * L = ln(delta(z)/h),
 *
 *     dC/d alpha = 2 L C (1 - time C),     dC/d time = -C^2               (23.21)
 *
 * of a power (time 0), a fraction or a Maxwell element; of a range of orders a and e
 * dC/da = -s^{2a}, dC/de = s^{2e}. All of these are memories, one behind another. */
#ifndef FVI_NODE_TERMS_H
#define FVI_NODE_TERMS_H

#include <fvi/sensitivity.h>
#include <fvi/convolution_quadrature.h>
#include "kernel_derivatives.h"
#include "kernel/kernel_impulses.h"
#include "methods/damping.h"

/* One memory of a law with its first weight. */
typedef struct {
    fvi_history *memory;
    double first;
} fvi_node_convolution;

/* Where the comment says "each", d numbers. */
typedef struct {
    fvi_kernel_function unit; /* its term has rho = 1, */
    fvi_kernel alone;     /* and as a law */
    size_t d;
    double log_h, rho;                   /* of the law */
    fvi_node_convolution self, again;    /* of nu; of what self gives */
    fvi_kernel_derivative slope[FVI_KERNEL_DERIVATIVES]; /* derivatives that are kernels, */
    fvi_node_convolution slopes[FVI_KERNEL_DERIVATIVES]; /* of nu, of a range or a symbol */
    fvi_history *log;                     /* of (1 - z)^0, with its rate */
    fvi_impulses_of_kernel *impulses[4];  /* of C and its derivatives by order, time and end,
                                           * where the start of the run has impulses; or NULL */
    size_t taps, place;                  /* of ln((3 - z)/2); 0: none */
    double l[FVI_BDF2_TAPS];
    double *sum, *change; /* each: C nu, and its increment */
    double *square;       /* each: C^2 nu */
    double *by_slope[FVI_KERNEL_DERIVATIVES]; /* each: what the slopes give */
    double *left, *moved; /* each: C (1 - time C) nu, and its increment */
    double *rate;         /* each: its derivative by the order of (1 - z)^0 */
    const double *by[4];  /* each: what C nu changes by with rho, alpha, time and end, but for */
    double factor[4];     /* this factor; NULL: not wanted, or there is no such number */
    double *past;         /* each of taps: left */
    const fvi_damping_matrix *matrix; /* C = S B^T: the history has B^T nu; or NULL, */
    size_t whole;                     /* and else C has so many rows, */
    double *product;                  /* room for so many numbers */
    double *block;        /* all these; owned */
} fvi_node_term;

/* fvi_wanted_kernel_numbers -- are derivatives by numbers of a law wanted? */
int fvi_wanted_kernel_numbers(const fvi_sensitivities *want);

/* fvi_kernel_term_is_fraction, _has_order -- a ZENER or MAXWELL; a POWER or ZENER: their derivatives are
 * products of memories. */
int fvi_kernel_term_is_fraction(const fvi_kernel_term *t);
int fvi_kernel_term_has_order(const fvi_kernel_term *t);

/* fvi_kernel_unit_term -- the term with rho = 1, time = 0 if it has none; and its rho. A SYMBOL is the
 * first member of a function, which comes with it. */
void fvi_kernel_unit_term(const fvi_kernel_term *of, fvi_kernel_function *unit,
                          double *rho);

/* fvi_node_term_start -- the memories for what is wanted of a term of the law of a run, of `d`
 * numbers.
 *
 *   matrix  NULL; or of a structure C = S B^T, of which the memories take in B^T nu, d numbers, and
 *           what they give has S and is multiplied by weights of run->system->d numbers
 *
 * t is in any case to be given back by fvi_node_term_stop, and stays where it is. Returns
 * FVI_SUCCESS; what fvi_kernel_history and fvi_history_alloc_by_order return; FVI_ENOMEM. */
int fvi_node_term_start(const fvi_run *run, const fvi_sensitivities *want,
                        fvi_delta kind, const fvi_kernel_term *term, size_t d,
                        const fvi_damping_matrix *matrix, fvi_node_term *t);

/* fvi_node_term_next -- nu comes in: t->by is what the derivatives of C make of it.
 * fvi_node_term_accumulate -- the same, and the products of these sums with `weight` are taken away
 * from entry i of what is wanted.
 *
 *   nu, dnu, weight  d numbers each; dnu the increment of nu. With a matrix the weight is of all
 *                    unknowns */
int fvi_node_term_next(fvi_node_term *t, const double *nu, const double *dnu);
int fvi_node_term_accumulate(fvi_node_term *t, const double *nu,
                             const double *dnu, const double *weight,
                             const fvi_sensitivities *want, size_t i);

/* fvi_node_term_start_impulses -- what the impulses of the start have of the term: for a run
 * whose law grows faster than s, with a velocity at the start.
 * fvi_node_term_accumulate_impulses -- those of step k, times `left` and `right`, are taken away
 * from entry i of what is wanted: the products of C A with the multipliers of its ends.
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
int fvi_node_term_start_impulses(fvi_node_term *t, double h,
                                 const fvi_sensitivities *want);
void fvi_node_term_accumulate_impulses(fvi_node_term *t, size_t k, double left,
                                       double right, const fvi_sensitivities *want,
                                       size_t i);

void fvi_node_term_stop(fvi_node_term *t);

#endif
