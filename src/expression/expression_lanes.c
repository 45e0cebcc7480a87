/* src/expression/expression_lanes.c -- Evaluate expressions for several oscillators at once. [H 28] */
#include "expression_lanes.h"

#include "expression_terms.h"
#include "tape_lanes.h"

#include <stdlib.h>
#include <string.h>

/* The tape of the first lane, which all lanes share. Parameter j of lane l is at k[j * FVI_MOST_LANES + l]. */
typedef struct {
    const term *of;
    double k[];
} prepared_expression;

static int is_same_node(const fvi_node *a, const fvi_node *b)
{
    return a->op == b->op && a->a == b->a && a->b == b->b
           && memcmp(&a->number, &b->number, sizeof a->number) == 0;
}

/* Return nonzero if the two expressions have the same text. Both must have one variable, so they have one term. */
static int is_same_text(const fvi_expression *a, const fvi_expression *b)
{
    const term *s = a->terms, *t = b->terms;
    if (a->count != 1 || b->count != 1 || a->d != 1 || b->d != 1 || s->count != t->count
        || s->count > FVI_TAPE_LANES_LONGEST)
        return 0;
    for (size_t m = 0; m < s->count; m++)
        if (!is_same_node(s->node + m, t->node + m))
            return 0;
    return 1;
}

/* Return the number of parameters, counted up to the last one that is used. */
static size_t parameters_of(const term *t)
{
    size_t most = 0;
    for (size_t m = 0; m < t->count; m++)
        if (t->node[m].op == TAPE_PARAMETER && (size_t)t->node[m].a + 1 > most)
            most = (size_t)t->node[m].a + 1;
    return most;
}

static int prepare(size_t count, void *const *params, void **prepared)
{
    const fvi_expression *first = params[0];
    for (size_t l = 0; l < count; l++)
        if (!is_same_text(first, params[l]))
            return FVI_EUNSUP;
    const size_t n = parameters_of(first->terms);
    prepared_expression *p = malloc(sizeof *p + n * FVI_MOST_LANES * sizeof *p->k);
    if (!p)
        return FVI_ENOMEM;
    p->of = first->terms;
    for (size_t l = 0; l < FVI_MOST_LANES; l++) {
        const fvi_expression *e = params[l < count ? l : count - 1];
        for (size_t j = 0; j < n; j++)
            p->k[j * FVI_MOST_LANES + l] = e->values[j];
    }
    *prepared = p;
    return FVI_SUCCESS;
}

static void evaluate_slopes(const void *prepared, const double *x, const double *active, double *f, double *slope)
{
    const prepared_expression *p = prepared;
    (void)active;
    double v[FVI_MOST_LANES], c[FVI_MOST_LANES];
    fvi_tape_lanes(p->of->node, p->of->count, x, p->k, v, f, c);
    for (size_t l = 0; l < FVI_MOST_LANES; l++) {
        f[l] = p->of->coordinates > 0 ? 0 + f[l] : 0; /* 0 + f, as in a sum of one term */
        if (slope)
            slope[l] = p->of->coordinates > 0 ? 0 + c[l] : 0;
    }
}

/* Evaluate without the slope, which is never asked for here. */
static void evaluate_values(const void *prepared, const double *x, const double *active, double *f, double *slope)
{
    const prepared_expression *p = prepared;
    (void)active, (void)slope;
    fvi_tape_lanes(p->of->node, p->of->count, x, p->k, f, NULL, NULL);
    for (size_t l = 0; l < FVI_MOST_LANES; l++)
        f[l] = 0 + f[l];
}

/* Compute both derivatives of one lane by one walk. Each is the same as by a walk for it alone. */
static void evaluate_one_lane(const void *params, double x, double *f, double *slope)
{
    const fvi_expression *e = params;
    const term *t = e->terms;
    fvi_jet jet = { 0, 0, 0, 0 };
    if (t->coordinates > 0)
        jet = fvi_tape_second_derivative(t->node, t->count, &x, e->values, 0, 0);
    *f = 0 + jet.a;
    *slope = 0 + jet.c;
}

const fvi_lane_functions fvi_expression_slope_lanes = { prepare, evaluate_slopes, free,
                                                        evaluate_one_lane };
const fvi_lane_functions fvi_expression_value_lanes = { prepare, evaluate_values, free, NULL };
