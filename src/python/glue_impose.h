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
} imposed_place;
/* A mechanism of texts, but for the places. */
typedef struct {
    fvi_mechanism all;
    fvi_constraints constraints;
    const fvi_constraints *typed;
    size_t count;
    imposed_place *place;
} imposed_places;
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
static int place_at(const imposed_place *of, double t, double *u, double *rate)
{
    if (of->function)
        return ask_imposed(t, of->function, u, rate);
    cubic_at(&of->rows, t, u, rate);
    return 0;
}
/* What is not NULL: c has u less, and its derivative by t has u' less. */
static int subtract_places(const imposed_places *o, double t, double *c, double *ct)
{
    double u, rate;
    int status = 0;
    for (size_t i = 0; i < o->count && !status; i++) {
        status = place_at(&o->place[i], t, &u, &rate);
        if (c && !status)
            c[o->place[i].constraint] -= u;
        if (ct && !status)
            ct[o->place[i].constraint] -= rate;
    }
    return status;
}
static int imposed_values(double t, size_t d, const double *x, void *params, double *c)
{
    const imposed_places *o = params;
    const int status = o->typed->value(t, d, x, o->typed->params, c);
    return status ? status : subtract_places(o, t, c, NULL);
}
static int imposed_gradients(double t, size_t d, const double *x, void *params, double *C, double *ct)
{
    const imposed_places *o = params;
    const int status = o->typed->gradient(t, d, x, o->typed->params, C, ct);
    return status || !ct ? status : subtract_places(o, t, NULL, ct);
}
static int imposed_hessians(double t, size_t d, const double *x, const double *factor, void *params, double *H)
{
    const imposed_places *o = params;
    return o->typed->hessian(t, d, x, factor, o->typed->params, H);
}
static void imposed_places_free(imposed_places *o)
{
    for (size_t i = 0; o && o->place && i < o->count; i++)
        free(o->place[i].rows.slope2);
    if (o)
        free(o->place);
    free(o);
}
/* `count` places, each yet to be put. The names of all constraints belong to the caller. NULL: no memory. */
static imposed_places *imposed_places_alloc(const fvi_mechanism *typed, const char *const *names, size_t count)
{
    imposed_places *o = calloc(1, sizeof *o);
    if (!o || !(o->place = calloc(count, sizeof *o->place))) {
        free(o);
        return NULL;
    }
    o->all = *typed;
    o->typed = typed->constraints;
    o->constraints = *typed->constraints;
    o->constraints.name = names;
    o->constraints.value = imposed_values;
    o->constraints.gradient = imposed_gradients;
    o->constraints.hessian = imposed_hessians;
    o->constraints.params = o;
    o->all.constraints = &o->constraints;
    o->count = count;
    return o;
}
/* Place number i is that of a constraint: by a function, or, where that is NULL, by n >= 4 rows, which
 * belong to the caller. */
static int imposed_places_put(imposed_places *o, size_t i, size_t constraint, void *function, size_t n, const double *t,
                              const double *x)
{
    imposed_place *to = &o->place[i];
    to->constraint = constraint;
    to->function = function;
    if (function)
        return 0;
    to->rows = (cubic_rows){ n, t, x, NULL };
    return find_cubics(&to->rows);
}
/* u and u' of place number i, which is given by rows. */
static void imposed_places_at(const imposed_places *o, size_t i, double t, double *u, double *rate)
{
    cubic_at(&o->place[i].rows, t, u, rate);
}
static const fvi_mechanism *imposed_places_mechanism(const imposed_places *o)
{
    return &o->all;
}
#endif
