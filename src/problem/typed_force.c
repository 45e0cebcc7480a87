/* src/problem/typed_force.c -- Compute values, bounds and jumps of a force that was typed. */
#include "typed_force.h"
#include "polygon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Return the table of a part as a polygon of one column. */
static fvi_polygon table_of(const fvi_force_part *part)
{
    return (fvi_polygon){ part->rows, 1, 1, part->times, part->values };
}

/* Return the force of a part that is a step or a cosine; for none, a cosine of amplitude 0. */
static fvi_force ready_made(const fvi_force_part *part)
{
    return part->kind == FVI_FORCING_STEP ? fvi_force_step(part->constants)
                                          : fvi_force_cosine(part->constants);
}

/* Return nonzero if the part has only a kind: none, a step or a cosine. */
static int is_ready_made(const fvi_force_part *part)
{
    return !part->expression && !part->times && !part->is_impulse;
}

int fvi_typed_force_part_value(const fvi_force_part *part, double t, double *F)
{
    if (part->expression) {
        *F = fvi_expression_value(part->expression, &t);
        return FVI_SUCCESS;
    }
    if (part->times) {
        const fvi_polygon table = table_of(part);
        *F = fvi_polygon_value(&table, t);
        return FVI_SUCCESS;
    }
    *F = 0;
    if (part->is_impulse)
        return FVI_SUCCESS;
    const fvi_force force = ready_made(part);
    return force.value(t, 1, force.params, F);
}

/* Compute bounds of one part and its derivatives between two times, as the member `bound` of fvi_force does for one
 * coordinate: most[k] for the derivative of order k, k = 0, ..., order. */
static int bound_part(const fvi_force_part *part, double from, double to, size_t order,
                      double *most)
{
    memset(most, 0, (order + 1) * sizeof *most);
    if (part->times) {
        const fvi_polygon table = table_of(part);
        fvi_polygon_bound(&table, from, to, order, 1, most);
        return FVI_SUCCESS;
    }
    if (part->is_impulse)
        return FVI_SUCCESS;
    const fvi_force force = part->expression
                                ? fvi_force_expression(part->expression)
                                : ready_made(part);
    return force.bound(from, to, order, 1, force.params, most);
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
        int status = bound_part(&f->parts[i], from, to, order, bound);
        if (status)
            return status;
        for (size_t k = 0; k <= order; k++)
            sum[k] += bound[k];
    }
    for (size_t k = 0; k <= order; k++)
        for (size_t i = 0; i < d; i++)
            most[k * d + i] = sum[k];
    return FVI_SUCCESS;
}

/* A single step or cosine is evaluated by its own functions, and no force by none. */
fvi_force fvi_force_typed(const fvi_typed_force *f)
{
    const fvi_force_part *first = f->parts;
    if (f->count == 1 && is_ready_made(first))
        return first->kind == FVI_FORCING_NONE ? (fvi_force){ 0 }
                                               : ready_made(first);
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
        free(f->parts[i].times);
    }
    if (f) {
        free(f->parts);
        free(f->jumps);
        free(f->impulses);
        free(f->J);
    }
    free(f);
}
