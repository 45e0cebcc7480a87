/* src/stability/inertia.c -- Warn if the inertia of a Lagrangian vanishes along a run. [H 29]
 *
 * The watch factorises L_vv at each row of a run. A pivot near zero means that L_vv is nearly singular. Between two
 * rows the watch follows the straight line from one state to the next and searches for the least pivot there. */
#include <fvi/warnings.h>

#include <fvi/error.h>
#include "system/arrays.h"
#include "system/lagrangian_point.h"
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* L_vv is called nearly singular if a pivot is at most SINGULAR times the largest inertia of its coordinate so far. The
 * search between two rows takes place if the least pivot at one of them is below SUSPICIOUS, or if a velocity changes
 * its sign between them. */
static const double SINGULAR = 1e-6, SUSPICIOUS = 0.3;
enum { SEARCHES = 40 };
#define NO_MEMORY "there is no memory to find out whether the inertia vanishes"

struct fvi_inertia_watch {
    const fvi_system *system;
    int has_last_point, has_warned;
    double t;
    double *x, *v, *largest; /* d numbers each: x and v of the last row; the largest diagonal entries of L_vv so far */
    double *xm, *vm, *x1, *v1, *matrix; /* room: d, d, d, d, d d numbers */
};

void fvi_inertia_watch_free(fvi_inertia_watch *w)
{
    if (!w)
        return;
    free(w->x);
    free(w);
}

static int evaluate_inertia(fvi_inertia_watch *w, double t, const double *x, const double *v)
{
    const int status =
        fvi_lagrangian_point(w->system, t, x, v, NULL, NULL, NULL, NULL, NULL, w->matrix);
    for (size_t i = 0; i < w->system->d && !status; i++)
        w->largest[i] = larger(w->largest[i], fabs(w->matrix[i * (w->system->d + 1)]));
    return status;
}

/* The least pivot of L_vv, after row and column i have been divided by the square root of the largest inertia of
 * coordinate i. Coordinates that never had any inertia do not count. The elimination exchanges no rows, because L_vv is
 * positive definite for most systems. */
static double least_pivot(fvi_inertia_watch *w)
{
    const size_t d = w->system->d;
    double *M = w->matrix, least = INFINITY;
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            if (w->largest[i] > 0 && w->largest[j] > 0)
                M[i * d + j] /= sqrt(w->largest[i] * w->largest[j]);
    for (size_t k = 0; k < d; k++) {
        const double pivot = M[k * d + k];
        if (w->largest[k] == 0)
            continue;
        least = smaller(least, fabs(pivot));
        if (!(fabs(pivot) > 0))
            return 0;
        for (size_t i = k + 1; i < d; i++)
            for (size_t j = k + 1; j < d; j++)
                M[i * d + j] -= M[i * d + k] * M[k * d + j] / pivot;
    }
    return least;
}

/* The least pivot at the fraction `tau` of the straight line from the last row to this one; 1 where L returns an
 * error. */
static double pivot_between(fvi_inertia_watch *w, double t, double tau)
{
    for (size_t i = 0; i < w->system->d; i++) {
        w->xm[i] = w->x[i] + tau * (w->x1[i] - w->x[i]);
        w->vm[i] = w->v[i] + tau * (w->v1[i] - w->v[i]);
    }
    return evaluate_inertia(w, w->t + tau * (t - w->t), w->xm, w->vm) ? 1 : least_pivot(w);
}

/* Search for the least pivot between both rows by the golden section. *tau is where it lies. */
static double least_between(fvi_inertia_watch *w, double t, double *tau)
{
    const double part = (sqrt(5) - 1) / 2;
    double low = 0, high = 1, a = 1 - part, b = part, at_a = pivot_between(w, t, a),
           at_b = pivot_between(w, t, b);
    for (int n = 0; n < SEARCHES; n++) {
        if (at_a < at_b) {
            high = b;
            b = a;
            at_b = at_a;
            at_a = pivot_between(w, t, a = high - part * (high - low));
        } else {
            low = a;
            a = b;
            at_a = at_b;
            at_b = pivot_between(w, t, b = low + part * (high - low));
        }
    }
    *tau = at_a < at_b ? a : b;
    return smaller(at_a, at_b);
}

int fvi_inertia_watch_begin(const fvi_system *system, fvi_inertia_watch **watch)
{
    const size_t d = system->d;
    *watch = NULL;
    if (system->matrices || !fvi_lagrangian_of(system))
        return FVI_SUCCESS;
    fvi_inertia_watch *w = calloc(1, sizeof *w);
    if (w)
        w->x = FVI_ARRAYS({ &w->x, d }, { &w->v, d }, { &w->largest, d }, { &w->xm, d }, { &w->vm, d },
                          { &w->x1, d }, { &w->v1, d }, { &w->matrix, d * d });
    if (!w || !w->x) {
        free(w);
        return FVI_ENOMEM;
    }
    w->system = system;
    *watch = w;
    return FVI_SUCCESS;
}

static int write_warning(fvi_inertia_watch *w, double t, size_t size, char *text)
{
    w->has_warned = 1;
    snprintf(text, size,
             "the inertia of this Lagrangian, its second derivatives by the velocities, is nearly singular at "
             "t = %.4g: a method may lose its order there",
             t);
    return 1;
}

/* Return nonzero if a velocity changes its sign between the last row and this one. */
static int has_sign_change(const fvi_inertia_watch *w)
{
    for (size_t i = 0; i < w->system->d; i++)
        if (w->v[i] * w->v1[i] < 0)
            return 1;
    return 0;
}

int fvi_warning_of_inertia(fvi_inertia_watch *w, double t, const double *x, const double *p,
                           size_t size, char *text)
{
    if (!w || w->has_warned)
        return 0;
    const size_t d = w->system->d;
    double tau = 1, least, before = 1;
    memcpy(w->x1, x, d * sizeof *x);
    memcpy(w->v1, w->v, d * sizeof *w->v);
    int status = fvi_velocity_of_momentum(w->system, t, x, p, w->v1);
    if (status == FVI_ENOMEM) {
        snprintf(text, size, NO_MEMORY);
        return -1;
    }
    if (status == FVI_ESING || status == FVI_EMAXITER)
        return write_warning(w, t, size, text);
    for (size_t i = 0; i < d; i++)
        w->vm[i] = 1;
    if (!status && !w->has_last_point)
        status = evaluate_inertia(w, t, x, w->vm); /* so that `largest` knows inertias at velocities other than v */
    if (!status && w->has_last_point)
        before = pivot_between(w, t, 0);
    if (!status)
        status = evaluate_inertia(w, t, w->x1, w->v1);
    least = status ? 1 : least_pivot(w);
    if (w->has_last_point && !status && least > SINGULAR
        && (least < SUSPICIOUS || before < SUSPICIOUS || has_sign_change(w)))
        least = least_between(w, t, &tau);
    const double when = w->t + tau * (t - w->t);
    memcpy(w->x, w->x1, d * sizeof *x);
    memcpy(w->v, w->v1, d * sizeof *x);
    w->t = t;
    w->has_last_point = 1;
    return least <= SINGULAR ? write_warning(w, when, size, text) : 0;
}

int fvi_warning_of_inertia_in_rows(const fvi_system *system, size_t rows, const double *t,
                                   const double *x, const double *p, size_t size, char *text)
{
    const size_t d = system->d;
    fvi_inertia_watch *w;
    int warned = 0;
    if (fvi_inertia_watch_begin(system, &w)) {
        snprintf(text, size, NO_MEMORY);
        return -1;
    }
    for (size_t k = 0; w && !warned && k < rows && fvi_all_finite(d, x + k * d); k++)
        warned = fvi_warning_of_inertia(w, t[k], x + k * d, p + k * d, size, text);
    fvi_inertia_watch_free(w);
    return warned;
}
