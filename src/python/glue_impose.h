/* src/python/glue_impose.h -- Coordinates that functions of Python's and rows prescribe. */
#ifndef FVI_GLUE_IMPOSE_H
#define FVI_GLUE_IMPOSE_H
#include <fvi/fvi.h>
#include <stdlib.h>
static int ask_imposed(double t, void *function, double *u, double *rate);
/* Rows, and a cubic between two of them: twice differentiable, with one third derivative over the first two
 * pieces, and over the last two. */
typedef struct {
    size_t n;
    const double *t, *x;
    double *slope2; /* the second derivatives at the rows */
} cubic_rows;
/* u(t) of the constraint x_i - u(t), for which a text wrote x_i - 0: of a function, or of rows. */
typedef struct {
    size_t constraint;
    void *function;
    cubic_rows rows;
} own_place;
/* A mechanism of texts, but for the places. */
typedef struct {
    fvi_mechanism all;
    fvi_constraints own;
    const fvi_constraints *typed;
    size_t count;
    own_place *place;
} own_imposed;
/* The equations for the second derivatives M, a row for each inner point, by elimination; the ends follow from their
 * neighbours. */
static int find_cubics(cubic_rows *r)
{
    const size_t n = r->n;
    const double *t = r->t, *x = r->x;
    double *M = r->slope2 = calloc(2 * n, sizeof *M), *upper = M ? M + n : NULL;
    if (!M)
        return FVI_ENOMEM;
    const double first = (t[1] - t[0]) / (t[2] - t[1]), last = (t[n - 1] - t[n - 2]) / (t[n - 2] - t[n - 3]);
    for (size_t i = 1; i + 1 < n; i++) {
        const double left = t[i] - t[i - 1], right = t[i + 1] - t[i];
        double below = left, here = 2 * (left + right), above = right;
        if (i == 1) {
            here += left * (1 + first);
            above -= left * first;
            below = 0;
        }
        if (i + 2 == n) {
            here += right * (1 + last);
            below -= right * last;
            above = 0;
        }
        const double pivot = here - below * upper[i - 1],
                     bend = 6 * ((x[i + 1] - x[i]) / right - (x[i] - x[i - 1]) / left);
        upper[i] = above / pivot;
        M[i] = (bend - below * M[i - 1]) / pivot;
    }
    for (size_t i = n - 2; i > 1; i--)
        M[i - 1] -= upper[i - 1] * M[i];
    M[0] = (1 + first) * M[1] - first * M[2];
    M[n - 1] = (1 + last) * M[n - 2] - last * M[n - 3];
    return 0;
}
static void cubic_at(const cubic_rows *r, double t, double *u, double *rate)
{
    size_t low = 0, high = r->n - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(r->t[middle] <= t ? &low : &high) = middle;
    }
    const double h = r->t[high] - r->t[low], a = (r->t[high] - t) / h, b = (t - r->t[low]) / h, *M = r->slope2;
    *u = a * r->x[low] + b * r->x[high] + (a * (a * a - 1) * M[low] + b * (b * b - 1) * M[high]) * (h * h / 6);
    *rate = (r->x[high] - r->x[low]) / h + ((1 - 3 * a * a) * M[low] + (3 * b * b - 1) * M[high]) * (h / 6);
}
static int place_at(const own_place *of, double t, double *u, double *rate)
{
    if (of->function)
        return ask_imposed(t, of->function, u, rate);
    cubic_at(&of->rows, t, u, rate);
    return 0;
}
/* What is not NULL: c has u less, and its derivative by t has u' less. */
static int subtract_places(const own_imposed *own, double t, double *c, double *ct)
{
    double u, rate;
    int status = 0;
    for (size_t i = 0; i < own->count && !status; i++) {
        status = place_at(&own->place[i], t, &u, &rate);
        if (c && !status)
            c[own->place[i].constraint] -= u;
        if (ct && !status)
            ct[own->place[i].constraint] -= rate;
    }
    return status;
}
static int own_values(double t, size_t d, const double *x, void *params, double *c)
{
    const own_imposed *own = params;
    const int status = own->typed->value(t, d, x, own->typed->params, c);
    return status ? status : subtract_places(own, t, c, NULL);
}
static int own_gradients(double t, size_t d, const double *x, void *params, double *C, double *ct)
{
    const own_imposed *own = params;
    const int status = own->typed->gradient(t, d, x, own->typed->params, C, ct);
    return status || !ct ? status : subtract_places(own, t, NULL, ct);
}
static int own_hessians(double t, size_t d, const double *x, const double *factor, void *params, double *H)
{
    const own_imposed *own = params;
    return own->typed->hessian(t, d, x, factor, own->typed->params, H);
}
static void own_imposed_free(own_imposed *own)
{
    for (size_t i = 0; own && own->place && i < own->count; i++)
        free(own->place[i].rows.slope2);
    if (own)
        free(own->place);
    free(own);
}
/* `count` places, each yet to be put. The names of all constraints belong to the caller. NULL: no memory. */
static own_imposed *own_imposed_alloc(const fvi_mechanism *typed, const char *const *names, size_t count)
{
    own_imposed *own = calloc(1, sizeof *own);
    if (!own || !(own->place = calloc(count, sizeof *own->place))) {
        free(own);
        return NULL;
    }
    own->all = *typed;
    own->typed = typed->constraints;
    own->own = *typed->constraints;
    own->own.name = names;
    own->own.value = own_values;
    own->own.gradient = own_gradients;
    own->own.hessian = own_hessians;
    own->own.params = own;
    own->all.constraints = &own->own;
    own->count = count;
    return own;
}
/* Place number i is that of a constraint: by a function, or, where that is NULL, by n >= 4 rows, which
 * belong to the caller. */
static int own_imposed_put(own_imposed *own, size_t i, size_t constraint, void *function, size_t n, const double *t,
                           const double *x)
{
    own_place *to = &own->place[i];
    to->constraint = constraint;
    to->function = function;
    if (function)
        return 0;
    to->rows = (cubic_rows){ n, t, x, NULL };
    return find_cubics(&to->rows);
}
/* u and u' of place number i, which is given by rows. */
static void own_imposed_at(const own_imposed *own, size_t i, double t, double *u, double *rate)
{
    cubic_at(&own->place[i].rows, t, u, rate);
}
static const fvi_mechanism *own_imposed_mechanism(const own_imposed *own)
{
    return &own->all;
}
#endif
