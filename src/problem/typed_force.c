/* src/problem/typed_force.c -- Compute values, bounds and jumps of a force that was typed. */
#include "typed_force.h"
#include "polygon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static fvi_polygon rows_of(const fvi_force_part *p)
{
    return (fvi_polygon){ p->n, 1, 1, p->t, p->F };
}

static fvi_force ready_made(const fvi_force_part *p)
{
    return p->kind == FVI_FORCING_STEP ? fvi_force_step(p->p)
                                       : fvi_force_cosine(p->p);
}

/* Return nonzero for none, a step or a cosine. */
static int is_ready_made(const fvi_force_part *p)
{
    return !p->expression && !p->t && !p->hits;
}

int fvi_typed_force_part_value(const fvi_force_part *p, double t, double *F)
{
    if (p->expression) {
        *F = fvi_expression_value(p->expression, &t);
        return 0;
    }
    if (p->t) {
        const fvi_polygon rows = rows_of(p);
        *F = fvi_polygon_value(&rows, t);
        return 0;
    }
    *F = 0;
    if (p->hits)
        return 0;
    const fvi_force force = ready_made(p);
    return force.value(t, 1, force.params, F);
}

static int bound_of(const fvi_force_part *p, double from, double to, size_t order,
                    double *most)
{
    memset(most, 0, (order + 1) * sizeof *most);
    if (p->t) {
        const fvi_polygon rows = rows_of(p);
        fvi_polygon_bound(&rows, from, to, order, 1, most);
        return 0;
    }
    if (p->hits)
        return 0;
    const fvi_force force = p->expression
                                ? fvi_force_expression(p->expression)
                                : ready_made(p);
    return force.bound(from, to, order, 1, force.params, most);
}

double fvi_typed_force_by_parameter(const fvi_typed_force *f, size_t j, double t)
{
    double sum = 0;
    for (size_t i = 0; i < f->count; i++) {
        double one = 0;
        if (f->parts[i].expression)
            fvi_expression_parameter_gradient(f->parts[i].expression, j, &t, &one,
                                        NULL);
        sum += one;
    }
    return sum;
}

static int force_value(double t, size_t d, void *params, double *F)
{
    const fvi_typed_force *f = params;
    double sum = 0;
    for (size_t i = 0; i < f->count; i++) {
        double one;
        int status = fvi_typed_force_part_value(&f->parts[i], t, &one);
        if (status)
            return status;
        sum += one;
    }
    for (size_t i = 0; i < d; i++)
        F[i] = sum;
    return 0;
}

static int force_bound(double from, double to, size_t order, size_t d,
                       void *params, double *most)
{
    const fvi_typed_force *f = params;
    double one[FVI_BOUND_ORDER + 1], sum[FVI_BOUND_ORDER + 1] = { 0 };
    for (size_t i = 0; i < f->count; i++) {
        int status = bound_of(&f->parts[i], from, to, order, one);
        if (status)
            return status;
        for (size_t k = 0; k <= order; k++)
            sum[k] += one[k];
    }
    for (size_t k = 0; k <= order; k++)
        for (size_t i = 0; i < d; i++)
            most[k * d + i] = sum[k];
    return 0;
}

/* A single step or cosine is evaluated directly. */
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
    memcpy(constants, f->parts->p, sizeof f->parts->p);
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
        if ((f->parts[n].kind == FVI_FORCING_STEP || f->parts[n].hits)
            && i-- == 0)
            return f->parts[n].p[1];
    return NAN;
}

void fvi_typed_force_free(fvi_typed_force *f)
{
    for (size_t i = 0; f && i < f->count; i++) {
        fvi_expression_free(f->parts[i].expression);
        free(f->parts[i].file);
        free(f->parts[i].t);
    }
    if (f) {
        free(f->parts);
        free(f->jumps);
        free(f->impulses);
        free(f->J);
    }
    free(f);
}
