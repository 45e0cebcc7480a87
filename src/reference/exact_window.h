/* src/reference/exact_window.h -- One contour for many times.              [H 11]
 *
 * What exact_rows.c needs: the integral of (11.10) at the rows of a window [first, last] of
 * times, all from the nodes of one hyperbola, whose unit of time is `last`. */
#ifndef FVI_EXACT_WINDOW_H
#define FVI_EXACT_WINDOW_H

#include "exact_inverse.h"
#include "exact_pairs.h"

enum { FVI_BLOCK = 16 }; /* rows that are summed together */

/* A contour and what stands on its nodes, sorted by |z|. */
typedef struct {
    const fvi_inverse *S;
    double unit, folds; /* all of e^-folds and less is cut off */
    double C, R;        /* of t^2 Q(z/t) / m = z^2 + C + R z^beta, t = unit */
    int passed[FVI_POLES], all_passed;
    size_t count; /* nodes; 0: the integral is zero */
    fvi_parts z, weight, power, scratch;
    fvi_parts x, v; /* what a source has on the nodes */
    double *steps; /* e^{z j h} for j < FVI_BLOCK, real parts, then imaginary */
    double *memory;
} fvi_window;

/* fvi_window_growth -- by what factor the answer to a constant force grows from one time to a
 * later one, roughly: of 1 / (s Q(s)) at s = 1 / t.                  [(11.17)] */
double fvi_window_growth(const fvi_inverse *S, double from, double to);

/* fvi_window_open -- the contour, and all that is the same for its rows.
 *
 *   S            prepared; stays in use
 *   first, last  times, 0 < first <= last; the sums are for times in between
 *   h            the step from row to row
 *   tolerance    in (0, 1)
 *   grows        1; or by what factor a force, had it lasted, would outgrow the motion
 *
 * Returns FVI_SUCCESS, or FVI_ENOMEM. fvi_window_close gives the memory back. */
int fvi_window_open(const fvi_inverse *S, double first, double last, double h,
                    double tolerance, double grows, fvi_window *w,
                    fvi_error *error);
void fvi_window_close(fvi_window *w);

/* fvi_window_add -- add what a source does, without the residues, at the times
 * source->t + j h, j < rows, to x[j] and v[j]; either may be NULL. The times of a force that
 * has ended (source->lasts > 0, and source->start = 0) count from its end. */
void fvi_window_add(fvi_window *w, const fvi_exact_source *source, double h,
                    size_t rows, double *x, double *v);

/* ---- what exact_window.c and exact_weights.c have of each other ---- */

/* fvi_window_exp -- e^{a z}, or that less `less` = 1, for the first n nodes. */
void fvi_window_exp(const fvi_window *w, size_t n, double a, int less,
                    const fvi_parts *to);

/* fvi_window_divide -- the weights of the rule become weights over t^2 Q(z/t) / m. */
void fvi_window_divide(fvi_window *w);

/* fvi_window_weigh -- x and v: what a source has on the nodes. */
void fvi_window_weigh(fvi_window *w, const fvi_exact_source *source);

#endif
