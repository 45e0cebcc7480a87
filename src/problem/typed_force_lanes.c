/* src/problem/typed_force_lanes.c -- Evaluate a typed force for several oscillators at once. [H 28] */
#include "typed_force.h"

#include "expression/expression_lanes.h"

#include <stdlib.h>
#include <string.h>

enum { L = FVI_MOST_LANES };

/* How a part is evaluated: by the functions of its kind for all lanes; once for all lanes, if it is the same table; or
 * lane by lane. */
typedef struct {
    const fvi_lane_functions *functions;
    void *prepared; /* NULL: not by these functions */
    int is_shared;
} prepared_part;

typedef struct {
    const fvi_typed_force *of[L]; /* force of each lane; missing lanes have that of the last one */
    size_t count;
    prepared_part part[];
} prepared_force;

static int is_same_table(const fvi_force_part *a, const fvi_force_part *b)
{
    return a->times && b->times && a->rows == b->rows && memcmp(a->times, b->times, a->rows * sizeof *a->times) == 0
           && memcmp(a->values, b->values, a->rows * sizeof *a->values) == 0;
}

/* Prepare part i in all lanes. If the functions return FVI_EUNSUP, the part is evaluated lane by lane. */
static int prepare_part(const prepared_force *f, size_t count, size_t i, prepared_part *part)
{
    void *params[L];
    int is_expression = 1, is_cosine = 1;
    part->is_shared = 1;
    for (size_t l = 0; l < count; l++) {
        fvi_force_part *p = f->of[l]->parts + i;
        part->is_shared = part->is_shared && is_same_table(f->of[0]->parts + i, p);
        is_expression = is_expression && p->expression;
        is_cosine = is_cosine && !p->expression && !p->times && !p->is_impulse
                    && p->kind == FVI_FORCING_COSINE;
        params[l] = is_expression ? (void *)p->expression : (void *)p->constants;
    }
    if (is_expression)
        part->functions = &fvi_expression_value_lanes;
    else if (is_cosine)
        part->functions = fvi_force_cosine(params[0]).lanes;
    else
        return FVI_SUCCESS;
    const int status = part->functions->prepare(count, params, &part->prepared);
    return status == FVI_EUNSUP ? FVI_SUCCESS : status;
}

static void discard(void *prepared)
{
    prepared_force *f = prepared;
    for (size_t i = 0; i < f->count; i++)
        if (f->part[i].prepared)
            f->part[i].functions->discard(f->part[i].prepared);
    free(f);
}

static int prepare(size_t count, void *const *params, void **prepared)
{
    const fvi_typed_force *first = params[0];
    for (size_t l = 0; l < count; l++)
        if (((const fvi_typed_force *)params[l])->count != first->count)
            return FVI_EUNSUP;
    prepared_force *f = calloc(1, sizeof *f + first->count * sizeof *f->part);
    if (!f)
        return FVI_ENOMEM;
    f->count = first->count;
    for (size_t l = 0; l < L; l++)
        f->of[l] = params[l < count ? l : count - 1];
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < f->count && !status; i++)
        status = prepare_part(f, count, i, f->part + i);
    if (status)
        discard(f);
    else
        *prepared = f;
    return status;
}

static void evaluate_part(const prepared_force *f, size_t i, const double *t, double *one)
{
    const prepared_part *part = f->part + i;
    if (part->prepared) {
        part->functions->evaluate(part->prepared, t, NULL, one, NULL);
        return;
    }
    for (size_t l = 0; l < L; l++)
        if (l > 0 && part->is_shared)
            one[l] = one[0];
        else
            fvi_typed_force_part_value(f->of[l]->parts + i, t[l], one + l);
}

/* t is the same in all lanes. The slope is never asked for. */
static void evaluate(const void *prepared, const double *t, const double *active, double *F, double *slope)
{
    const prepared_force *f = prepared;
    double one[L];
    (void)active, (void)slope;
    memset(F, 0, L * sizeof *F);
    for (size_t i = 0; i < f->count; i++) {
        evaluate_part(f, i, t, one);
        for (size_t l = 0; l < L; l++)
            F[l] += one[l];
    }
}

const fvi_lane_functions fvi_typed_force_lanes = { prepare, evaluate, discard, NULL };
