/* src/parameter_derivatives/stage_terms.h -- The derivatives of a law by the numbers of its terms, on stages. [H 23]
 *
 * Internal, for adjoint runs and for tangents. The derivative by the factor of a term is the derivative by rho with the
 * weights of this term alone, so each term has a history of the velocities of its own. With W = (Delta/h)^-1 C(Delta/h)
 * and u = W nu, the derivatives by the time and by the order are -W (Delta/h) u and 2 L (u - time W (Delta/h) u), where
 * L = ln(Delta/h). (23.21) One history after another computes these products. */
#ifndef FVI_STAGE_TERMS_H
#define FVI_STAGE_TERMS_H

#include "node_terms.h"
#include "stages/lobatto_history.h"

/* A history, its sums over the steps before, and its sums including this step; s d numbers each. */
typedef struct {
    fvi_lobatto_history *memory; /* NULL: not needed */
    double *past, *now;
} fvi_stage_convolution;

/* One term of a law, for d numbers. Stage i of number j stands at [j * s + i]; "each" means that an array has s d
 * numbers. */
typedef struct {
    fvi_kernel_function unit; /* the term with rho = 1 */
    double rho, h, log_h; /* rho: of the term in the law */
    size_t s, d;
    const fvi_lobatto_rule *rule;
    fvi_stage_convolution self, again, slopes[FVI_KERNEL_DERIVATIVES];
    fvi_kernel_derivative slope[FVI_KERNEL_DERIVATIVES];
    fvi_stage_convolution log; /* Delta^beta at beta = 0: only its derivative by beta is used */
    fvi_kernel_term *relaxation; /* Maxwell elements whose sum is ln(1 + time s), for a DAVIDSON, and for a HAVRILIAK
                                    that is a Maxwell element; owned */
    fvi_stage_convolution less;  /* for a DAVIDSON: the history of these elements, of (Delta/h) u */
    int end_is_product;          /* nonzero for such a HAVRILIAK: the history of these elements is that of the end */
    double *rate, *left;      /* each: (Delta/h) u, and u - time W (Delta/h) u; u is self.now */
    double *by_order;         /* each: L left, without ln(1 + time s) u of a DAVIDSON */
    const double *by[4];      /* each: the derivative of W nu by rho, alpha, time and end, without the factor; NULL: not
                                 wanted, or the term has no such number */
    double factor[4];         /* the factor */
    double *before;           /* d numbers: u of the last stage of the step before */
    double *room, *block;     /* each; the memory of all these arrays and of past and now; owned */
} fvi_stage_term;

/* fvi_stage_term_next -- take in nu of number j, s velocities, and write the derivatives of W nu to t->by. */
void fvi_stage_term_next(fvi_stage_term *t, size_t j, const double *nu);

/* All terms of a law; zeroed before the start. */
typedef struct {
    size_t count;
    fvi_stage_term *each; /* owned */
} fvi_stage_terms;

/* fvi_stage_terms_start -- start the histories for the wanted derivatives by all terms of a law, with the tolerance
 * `keep`. Give *terms back with fvi_stage_terms_stop, also after an error. Returns FVI_SUCCESS; what
 * fvi_lobatto_history_of_kernel and fvi_lobatto_history_alloc return; FVI_ENOMEM.
 * fvi_stage_terms_accumulate -- take in nu of number j, a multiplier at the stages in reverse order. Then subtract the
 * products of the sums with `weight` times the velocities v of this number from the wanted derivatives by the terms
 * `first`, first + 1, ...
 * fvi_stage_terms_update_history -- add a finished step to the histories; nu of all numbers.
 * fvi_stage_terms_stop -- free the histories. */
int fvi_stage_terms_start(const fvi_run *run, const fvi_sensitivities *want, size_t s, size_t d,
                          double keep, const fvi_kernel *law, fvi_stage_terms *terms);
void fvi_stage_terms_accumulate(fvi_stage_terms *terms, size_t j, const double *nu, double weight,
                                const double *v, const fvi_sensitivities *want, size_t first);
int fvi_stage_terms_update_history(fvi_stage_terms *terms, const double *nu);
void fvi_stage_terms_stop(fvi_stage_terms *terms);

#endif
