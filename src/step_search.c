/* src/step_search.c -- The step that a wanted error needs.      [Chapter 18] */
#include "step_search.h"

#include "fvi.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FEWEST = 128, PATIENCE = 3 };

/* Rows 0, ..., rows of a run, parts steps apart. x and p have equal length. */
typedef struct {
    const fvi_method *method;
    const fvi_run *run;
    size_t first;        /* parts between the rows of the caller and of these */
    size_t rows, length; /* rows; (rows + 1) d */
    double *x, *before;  /* this run and the one with steps twice as long */
    double *p;
} search;

//> trial
/* One run with each step of the caller's cut into first * parts. */
static int trial(const search *o, size_t parts)
{
    const size_t d = o->run->system->d;
    fvi_run run = *o->run;
    run.h /= (double)(o->first * parts); /* a power of two: exact */
    run.steps = o->rows * parts;
    fvi_stepper *s;
    int status = fvi_start(o->method, &run, &s);
    if (status)
        return status;
    for (size_t row = 0;; row++) {
        memcpy(o->x + row * d, s->x, d * sizeof *o->x);
        memcpy(o->p + row * d, s->p, d * sizeof *o->p);
        for (size_t i = 0; i < parts && row < o->rows && !status; i++)
            status = fvi_step(s);
        if (status || row == o->rows)
            break;
    }
    fvi_stop(s);
    return status;
}
//< trial

static int too_long(int status)
{
    return status == GSL_EOVRFLW || status == GSL_EMAXITER
           || status == GSL_ESING;
}

/* max |x|, and D = max |x - before| */
static double distance(const search *o, double *largest)
{
    double D = 0;
    *largest = 0;
    for (size_t i = 0; i < o->length; i++) {
        D = fmax(D, fabs(o->x[i] - o->before[i]));
        *largest = fmax(*largest, fabs(o->x[i]));
    }
    return D;
}

/* 1/4, but where a kick at the start leaves only 1 - 2 alpha, (9.5). */
static double least_order(const fvi_method *method, const fvi_run *run)
{
    double least = 0.25;
    if (method == &fvi_fractional && run->past == FVI_PAST_RIEMANN_LIOUVILLE
        && run->alpha < 0.5)
        for (size_t i = 0; i < run->system->d; i++)
            if (run->x0[i] != 0 && run->system->damping[i] > 0)
                least = fmin(least, 1 - 2 * run->alpha);
    return least;
}

//> estimate
/* (18.2); infinite until there are three runs. */
static double estimate(double D_before, double D, double floor, double least,
                       double lowest, double *order)
{
    double q = D > 0 ? log2(D_before / D) : lowest;
    *order = fmin(fmax(q, least), lowest);
    return gsl_finite(D_before) ? D / expm1(*order * M_LN2) + floor
                                : GSL_POSINF;
}
//< estimate

//> search
/* Halve; the rows of the last run stay in o->x and o->p. */
static int halve(search *o, double error, size_t most, fvi_step_found *found)
{
    const double lowest = strtod(o->method->order, NULL);
    const double least = least_order(o->method, o->run);
    const double tolerance = o->run->tolerance > 0 ? o->run->tolerance : 1e-13;
    double D_before = GSL_POSINF, D, largest = 0;
    int have_before = 0, worse = 0;
    found->estimate = GSL_POSINF;
    for (size_t parts = 1; o->rows <= most / parts; parts *= 2) {
        int status = trial(o, parts);
        if (status && !too_long(status))
            return status;
        D = status || !have_before ? GSL_POSINF : distance(o, &largest);
        fvi_step_found now = { .parts = o->first * parts };
        now.estimate = estimate(D_before, D, tolerance * largest, least, lowest,
                                &now.order);
        if (now.estimate < found->estimate) {
            *found = now;
            worse = 0;
        } else if (D <= GSL_SQRT_DBL_EPSILON * largest) {
            worse++;
        }
        if (found->estimate <= error)
            return GSL_SUCCESS;
        if (worse == PATIENCE)
            break;
        D_before = D;
        have_before = !status;
        double *swap = o->x;
        o->x = o->before;
        o->before = swap;
    }
    return GSL_ETOL;
}
//< search

static int check(const fvi_method *method, const fvi_run *run, double error,
                 const double *x, const fvi_step_found *found)
{
    if (!x || !found)
        GSL_ERROR("null pointer", GSL_EFAULT);
    if (!(gsl_finite(error) && error > 0))
        GSL_ERROR("error must be finite and positive", GSL_EDOM);
    fvi_stepper *s;
    fvi_run shortest;
    if (run) { /* one step of it is enough to check it */
        shortest = *run;
        shortest.steps = run->steps > 0;
    }
    int status = fvi_start(method, run ? &shortest : NULL, &s);
    if (!status)
        fvi_stop(s);
    return status;
}

int fvi_step_search(const fvi_method *method, const fvi_run *run, double error,
                    size_t most, double *x, double *p, fvi_step_found *found)
{
    int status = check(method, run, error, x, found);
    if (status)
        return status;
    const size_t d = run->system->d;
    search o = { .method = method, .run = run, .first = 1 };
    while (run->steps * o.first < FEWEST)
        o.first *= 2;
    if (run->steps >= SIZE_MAX / sizeof(double) / 3 / d / o.first)
        GSL_ERROR("rows must be addressable", GSL_EINVAL);
    o.rows = run->steps * o.first;
    o.length = (o.rows + 1) * d;
    double *block = malloc(3 * o.length * sizeof *block);
    if (!block)
        GSL_ERROR("no memory for the rows", GSL_ENOMEM);
    o.x = block;
    o.before = block + o.length;
    o.p = block + 2 * o.length;
    fvi_step_found best = { 0 };
    status = halve(&o, error, most, &best);
    for (size_t k = 0; !status && k <= run->steps; k++) {
        memcpy(x + k * d, o.x + k * o.first * d, d * sizeof *x);
        if (p)
            memcpy(p + k * d, o.p + k * o.first * d, d * sizeof *p);
    }
    free(block);
    if (!status || status == GSL_ETOL)
        *found = best;
    if (status == GSL_ETOL)
        GSL_ERROR("the error was not reached", GSL_ETOL);
    return status;
}
