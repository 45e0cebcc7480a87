/* src/parameter_derivatives/stage_terms.h -- The terms of a law by their numbers, through stages. [H 23]
 *
 * Internal, for runs that go backwards and for tangents. The derivative by the factor of a term is that by
 * rho with the weights of this term alone: each has a memory of the velocities that come in. With
 * W = (Delta/h)^-1 C(Delta/h) of it and u = W nu, the derivatives by time and order are -W (Delta/h) u and
 * 2 L (u - time W (Delta/h) u), L = ln(Delta/h): (23.21), memories one behind another. */
#ifndef FVI_STAGE_TERMS_H
#define FVI_STAGE_TERMS_H

#include "node_terms.h"
#include "stages/lobatto_history.h"

/* One memory, what it has of the steps before, and what it gives of this step; s d numbers each. */
typedef struct {
    fvi_lobatto_history *memory; /* NULL: not asked for */
    double *past, *now;
} fvi_stage_convolution;

/* Of d numbers; that of stage i of number j stands at [j * s + i]. Where the comment says "each", s d numbers. */
typedef struct {
    fvi_kernel_function unit; /* its term has rho = 1 */
    double rho, h;     /* rho: of the law */
    size_t s, d;
    const fvi_lobatto_rule *rule;
    fvi_stage_convolution self, again, slopes[FVI_KERNEL_DERIVATIVES];
    fvi_kernel_derivative slope[FVI_KERNEL_DERIVATIVES];
    fvi_stage_convolution log; /* Delta^beta at beta = 0: its rate */
    double by_time;            /* -by_time rho again.now is the derivative by the time: 1, or 2 alpha */
    fvi_kernel_term *relaxation; /* of a DAVIDSON: Maxwell elements with the sum ln(1 + time s); owned */
    fvi_stage_convolution less;  /* what they make of (Delta/h) u */
    double *rate, *left;      /* each: (Delta/h) u, u - time W rate; u is self.now */
    double *before;           /* d numbers: the last of u of the step before */
    double *room, *block;     /* each; all these and past and now; owned */
} fvi_stage_term;

/* fvi_stage_term_next -- nu of number j comes in, s velocities. By rho W nu changes by self.now, by the
 * time by -by_time rho again.now, by the order by 2 rho times fvi_stage_term_by_order; where its derivative is a
 * kernel, by sign rho slopes.now. */
void fvi_stage_term_next(fvi_stage_term *t, size_t j, const double *nu);

/* fvi_stage_term_by_order -- of number n of a term with log.memory, log.now - ln h left - less.now. */
static inline double fvi_stage_term_by_order(const fvi_stage_term *t, size_t n, double log_h)
{
    return t->log.now[n] - log_h * t->left[n] - t->less.now[n];
}

/* All terms of a law; zeroed before. */
typedef struct {
    size_t count;
    fvi_stage_term *each; /* owned */
} fvi_stage_terms;

/* fvi_stage_terms_start, _update_history, _stop -- the memories for what is wanted of all of them, with the tolerance
 * `keep`, in any case to be given back; nu of all numbers of a step that is over. The first returns what
 * fvi_lobatto_history_of_kernel and fvi_lobatto_history_alloc_by_order return; FVI_ENOMEM.
 * fvi_stage_terms_accumulate -- nu of number j comes in, a multiplier at the stages in reverse order. Its products
 * with `weight` times the velocities v of this number are taken away from what is wanted of term `first` and those
 * behind it. */
int fvi_stage_terms_start(const fvi_run *run, const fvi_sensitivities *want, size_t s, size_t d,
                          double keep, const fvi_kernel *law, fvi_stage_terms *terms);
void fvi_stage_terms_accumulate(fvi_stage_terms *terms, size_t j, const double *nu, double weight,
                                const double *v, const fvi_sensitivities *want, size_t first);
int fvi_stage_terms_update_history(fvi_stage_terms *terms, const double *nu);
void fvi_stage_terms_stop(fvi_stage_terms *terms);

#endif
