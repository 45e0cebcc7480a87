/* src/problem/typed_force_lanes.c -- Evaluate a typed force for several oscillators at once. [H 28] */
#include "typed_force.h"

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
    const size_t bytes = a->table.n * sizeof *a->table.t;
    return a->table.t && b->table.t && a->table.n == b->table.n && memcmp(a->table.t, b->table.t, bytes) == 0
           && memcmp(a->table.F, b->table.F, bytes) == 0;
}

/* Prepare part i in all lanes. Parts of different kinds, and those for which the functions return FVI_EUNSUP, are
 * evaluated lane by lane. */
static int prepare_part(const prepared_force *f, size_t count, size_t i, prepared_part *part)
{
    const fvi_force_part *first = f->of[0]->parts + i;
    void *params[L];
    part->is_shared = 1;
    part->functions = first->force.lanes;
    for (size_t l = 0; l < count; l++) {
        const fvi_force_part *p = f->of[l]->parts + i;
        part->is_shared = part->is_shared && is_same_table(first, p);
        if (p->force.lanes != first->force.lanes)
            part->functions = NULL;
        params[l] = p->force.params;
    }
    if (!part->functions)
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
