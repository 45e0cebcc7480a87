/* src/reference/exact_window.h -- Use one contour for many times.              [H 11]
 *
 * exact_rows.c uses these functions. They compute the integral of (11.10) at the rows of a window [first, last] of
 * times. All rows use the nodes of the same hyperbola, whose unit of time is `last`. */
#ifndef FVI_EXACT_WINDOW_H
#define FVI_EXACT_WINDOW_H

#include "exact_inverse.h"
#include "exact_pairs.h"

enum { FVI_BLOCK = 16 }; /* number of rows that are summed together */

/* A contour and the factors at its nodes, sorted by |z|. */
typedef struct {
    const fvi_inverse *S;
    double unit, folds; /* terms of e^-folds and less are left out */
    double C, R;        /* of t^2 Q(z/t) / m = z^2 + C + R z^beta at t = unit */
    int passed[FVI_POLES], all_passed;
    size_t count; /* number of nodes; 0: the integral is zero */
    fvi_parts z, weight, power, scratch;
    fvi_parts x, v; /* factors of a source at the nodes */
    double *steps; /* e^{z j h} for j < FVI_BLOCK: for each node the real parts, then the imaginary parts */
    double *memory;
} fvi_window;

/* fvi_window_growth -- Return the approximate factor by which the response to a constant force grows from one time to a
 * later one, which is that of 1 / (s Q(s)) at s = 1 / t.                  [(11.17)] */
double fvi_window_growth(const fvi_inverse *S, double from, double to);

/* fvi_window_open -- Make the contour, and everything that is the same for its rows.
 *
 *   S            prepared; must outlive the window
 *   first, last  times, 0 < first <= last; the sums are for times between them
 *   h            step from row to row
 *   tolerance    in (0, 1)
 *   grows        1; or the factor by which a force, had it lasted, would outgrow the motion
 *
 * Return FVI_SUCCESS or FVI_ENOMEM. Free the memory with fvi_window_close. */
int fvi_window_open(const fvi_inverse *S, double first, double last, double h,
                    double tolerance, double grows, fvi_window *w,
                    fvi_error *error);
void fvi_window_close(fvi_window *w);

/* fvi_window_add -- Add the contribution of a source, without the residues, at the times source->t + j h, j < rows, to
 * x[j] and v[j]. Either may be NULL. The times of a force that has ended (source->lasts > 0 and source->start = 0)
 * count from its end. */
void fvi_window_add(fvi_window *w, const fvi_exact_source *source, double h,
                    size_t rows, double *x, double *v);

#endif
