/* src/parameter_derivatives/node_terms.h -- The derivatives of a law by the numbers of its terms, at nodes. [H 23]
 *
 * Internal, for adjoint runs and for tangents. With C the symbol of a term for rho = 1 and L = ln(delta(z)/h),
 *
 *     dC/d alpha = 2 L C (1 - time C),     dC/d time = -C^2               (23.21)
 *
 * for a power (time 0), a fraction or a Maxwell element. For a range of orders a to e, dC/da = -s^{2a} and
 * dC/de = s^{2e}. To multiply by a symbol is to take a sequence through a history, so one history after another
 * computes the products. */
#ifndef FVI_NODE_TERMS_H
#define FVI_NODE_TERMS_H

#include <fvi/sensitivity.h>
#include <fvi/convolution_quadrature.h>
#include "kernel_derivatives.h"
#include "kernel/kernel_impulses.h"
#include "methods/damping.h"

/* A history of a law and the weight that was taken out of its sums. */
typedef struct {
    fvi_history *memory;
    double first;
} fvi_node_convolution;

/* One term of a law; "each" means that an array has d numbers. */
typedef struct {
    fvi_kernel_function unit; /* the term with rho = 1 */
    fvi_kernel single_term; /* the same term as a law */
    size_t d;
    double log_h, rho;                   /* rho of the term in the law */
    fvi_node_convolution self, again;    /* the history of nu; the history of the sums of self */
    fvi_kernel_derivative slope[FVI_KERNEL_DERIVATIVES]; /* the derivatives that are kernels */
    fvi_node_convolution slopes[FVI_KERNEL_DERIVATIVES]; /* and their histories of nu */
    fvi_history *log;                     /* the history of (1 - z)^0, with its derivative by the order */
    fvi_impulses_of_kernel *impulses[4];  /* the impulses of C and of its derivatives by order, time and end, if the
                                             start of the run has impulses; or NULL */
    size_t taps, place;                  /* the coefficients of ln((3 - z)/2); 0: none */
    double l[FVI_BDF2_TAPS];
    double *sum, *change; /* each: C nu, and its increment */
    double *square;       /* each: C^2 nu */
    double *by_slope[FVI_KERNEL_DERIVATIVES]; /* each: the sums of the histories `slopes` */
    double *left, *moved; /* each: C (1 - time C) nu, and its increment */
    double *rate;         /* each: L times left */
    const double *by[4];  /* each: the derivative of C nu by rho, alpha, time and end, without the factor; NULL: not
                             wanted, or the term has no such number */
    double factor[4];     /* the factor */
    double *past;         /* each of taps: the last terms of left */
    const fvi_damping_matrix *matrix; /* a damping matrix C = S B^T, whose history keeps B^T nu; or NULL */
    size_t whole;                     /* with a matrix: how many unknowns S v has */
    double *product;                  /* room for S v */
    double *block;        /* the memory of all these arrays; owned */
} fvi_node_term;

/* fvi_wanted_kernel_numbers -- return nonzero if derivatives by numbers of a law are wanted. */
int fvi_wanted_kernel_numbers(const fvi_sensitivities *want);

/* fvi_kernel_is_zener_or_maxwell -- return nonzero if the derivative of the term by its time is -C^2, a product of two
 * histories.
 * fvi_kernel_is_power_or_zener -- return nonzero if its derivative by alpha is 2 L C (1 - time C), a product, too. */
int fvi_kernel_is_zener_or_maxwell(const fvi_kernel_term *t);
int fvi_kernel_is_power_or_zener(const fvi_kernel_term *t);

/* fvi_kernel_unit_term -- copy a term with rho = 1, and time = 0 if its kind has no time, to *unit, and its rho to
 * *rho. A SYMBOL is the first member of a fvi_kernel_function, all of which is copied. */
void fvi_kernel_unit_term(const fvi_kernel_term *of, fvi_kernel_function *unit,
                          double *rho);

/* fvi_node_term_start -- start the histories for the wanted derivatives by the numbers of a term of the law of a run.
 *
 *   d       how many numbers each history keeps
 *   matrix  NULL; or, for a structure, the damping matrix C = S B^T. The histories then take in B^T nu, d numbers, and
 *           their sums, multiplied by S, are multiplied by weights of run->system->d numbers
 *   t       output; give it back with fvi_node_term_stop, also after an error. It must stay where it is
 *
 * Returns FVI_SUCCESS; what fvi_kernel_history and fvi_history_alloc_by_order return; FVI_ENOMEM. */
int fvi_node_term_start(const fvi_run *run, const fvi_sensitivities *want,
                        fvi_delta kind, const fvi_kernel_term *term, size_t d,
                        const fvi_damping_matrix *matrix, fvi_node_term *t);

/* fvi_node_term_next -- take in nu, and write the sums of the derivatives of C to t->by.
 * fvi_node_term_accumulate -- the same; then subtract the products of these sums with `weight` from entry i of the
 * wanted derivatives.
 *
 *   nu, dnu  d numbers each; dnu is the increment of nu
 *   weight   d numbers; with a matrix as many as there are unknowns */
int fvi_node_term_next(fvi_node_term *t, const double *nu, const double *dnu);
int fvi_node_term_accumulate(fvi_node_term *t, const double *nu,
                             const double *dnu, const double *weight,
                             const fvi_sensitivities *want, size_t i);

/* fvi_node_term_start_impulses -- prepare the impulses of the start for the term. They occur if the law grows faster
 * than s and the run starts with a velocity. Returns FVI_SUCCESS or FVI_ENOMEM.
 * fvi_node_term_accumulate_impulses -- subtract the impulses of step k, times `left` and `right`, from entry i of the
 * wanted derivatives. left and right are the products of C A with the multipliers at the two ends of the step. */
int fvi_node_term_start_impulses(fvi_node_term *t, double h,
                                 const fvi_sensitivities *want);
void fvi_node_term_accumulate_impulses(fvi_node_term *t, size_t k, double left,
                                       double right, const fvi_sensitivities *want,
                                       size_t i);

void fvi_node_term_stop(fvi_node_term *t);

#endif
