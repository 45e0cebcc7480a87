/* src/problem/typed_force.c -- Compute values, bounds and jumps of a force that was typed. */
#include "typed_force.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Return nonzero if the part has only a kind: none, a step or a cosine. */
static int is_ready_made(const fvi_force_part *part)
{
    return !part->expression && !part->table.t && !part->is_impulse;
}

/* Return the part as a force. None is a cosine of amplitude 0. */
static fvi_force force_of(const fvi_force_part *part)
{
    return part->expression                   ? fvi_force_expression(part->expression)
           : part->table.t                    ? fvi_force_table(&part->table)
           : part->is_impulse                 ? (fvi_force){ .value = NULL }
           : part->kind == FVI_FORCING_STEP ? fvi_force_step(part->constants)
                                              : fvi_force_cosine(part->constants);
}

void fvi_typed_force_finish(fvi_typed_force *f)
{
    for (size_t i = 0; i < f->count; i++)
        f->parts[i].force = force_of(f->parts + i);
}

int fvi_typed_force_part_value(const fvi_force_part *part, double t, double *F)
{
    *F = 0;
    return part->force.value ? part->force.value(t, 1, part->force.params, F) : FVI_SUCCESS;
}

double fvi_typed_force_by_parameter(const fvi_typed_force *f, size_t j, double t)
{
    double sum = 0;
    for (size_t i = 0; i < f->count; i++) {
        double slope = 0;
        if (f->parts[i].expression)
            fvi_expression_parameter_gradient(f->parts[i].expression, j, &t, &slope, NULL);
        sum += slope;
    }
    return sum;
}

static int force_value(double t, size_t d, void *params, double *F)
{
    const fvi_typed_force *f = params;
    double sum = 0;
    for (size_t i = 0; i < f->count; i++) {
        double value;
        int status = fvi_typed_force_part_value(&f->parts[i], t, &value);
        if (status)
            return status;
        sum += value;
    }
    for (size_t i = 0; i < d; i++)
        F[i] = sum;
    return FVI_SUCCESS;
}

static int force_bound(double from, double to, size_t order, size_t d,
                       void *params, double *most)
{
    const fvi_typed_force *f = params;
    double bound[FVI_BOUND_ORDER + 1], sum[FVI_BOUND_ORDER + 1] = { 0 };
    for (size_t i = 0; i < f->count; i++) {
        const fvi_force *part = &f->parts[i].force;
        const int status = part->bound ? part->bound(from, to, order, 1, part->params, bound) : FVI_SUCCESS;
        if (status)
            return status;
        for (size_t k = 0; part->bound && k <= order; k++)
            sum[k] += bound[k];
    }
    for (size_t k = 0; k <= order; k++)
        for (size_t i = 0; i < d; i++)
            most[k * d + i] = sum[k];
    return FVI_SUCCESS;
}

/* A single expression, step or cosine is evaluated by its own functions, and no force by none. */
fvi_force fvi_force_typed(const fvi_typed_force *f)
{
    const fvi_force_part *first = f->parts;
    if (f->count == 1 && first->expression)
        return first->force;
    if (f->count == 1 && is_ready_made(first))
        return first->kind == FVI_FORCING_NONE ? (fvi_force){ 0 }
                                               : first->force;
    return (fvi_force){ .value = force_value,
                        .bound = force_bound,
                        .params = (void *)f,
                        .jumps = f->jumps,
                        .jump_count = f->jump_count,
                        .impulses = f->impulses,
                        .impulse_count = f->impulse_count,
                        .lanes = &fvi_typed_force_lanes };
}

int fvi_typed_force_is_simple(const fvi_typed_force *f, fvi_forcing *kind,
                              double constants[2])
{
    if (f->count != 1 || !is_ready_made(f->parts))
        return 0;
    *kind = f->parts->kind;
    memcpy(constants, f->parts->constants, sizeof f->parts->constants);
    return 1;
}

const char *fvi_typed_force_file(const fvi_typed_force *f, size_t i)
{
    for (size_t n = 0; n < f->count; n++)
        if (f->parts[n].file && i-- == 0)
            return f->parts[n].file;
    return NULL;
}

double fvi_typed_force_jump(const fvi_typed_force *f, size_t i)
{
    for (size_t n = 0; n < f->count; n++)
        if ((f->parts[n].kind == FVI_FORCING_STEP || f->parts[n].is_impulse)
            && i-- == 0)
            return f->parts[n].constants[1];
    return NAN;
}

void fvi_typed_force_free(fvi_typed_force *f)
{
    for (size_t i = 0; f && i < f->count; i++) {
        fvi_expression_free(f->parts[i].expression);
        free(f->parts[i].file);
        free((void *)f->parts[i].table.t);
    }
    if (f) {
        free(f->parts);
        free(f->jumps);
        free(f->impulses);
        free(f->J);
    }
    free(f);
}
