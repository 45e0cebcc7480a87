/* src/expression/expression_values.c -- Compute values and derivatives of an expression.  [H 9] */
#include <fvi/expression.h>

#include "enclosure.h"
#include "expression_lanes.h"
#include "expression_terms.h"

#include <stdlib.h>
#include <string.h>

double fvi_expression_value(const fvi_expression *e, const double *x)
{
    double sum = 0;
    for (const term *t = e->terms; t < e->terms + e->count; t++)
        sum += fvi_tape_value(t->node, t->count, x, e->values);
    return sum;
}

void fvi_expression_parameter_gradient(const fvi_expression *e, size_t j,
                                 const double *x, double *value, double *grad)
{
    const int parameter = -1 - (int)j;
    *value = 0;
    if (grad)
        memset(grad, 0, e->d * sizeof *grad);
    for (const term *t = e->terms; t < e->terms + e->count; t++) {
        *value += fvi_tape_slope(t->node, t->count, x, e->values, parameter).a;
        for (size_t i = 0; grad && i < t->coordinates; i++)
            grad[t->coordinate[i]] +=
                fvi_tape_second_derivative(t->node, t->count, x, e->values, t->coordinate[i],
                              parameter)
                    .c;
    }
}

static int potential_value(size_t d, const double *x, void *params,
                           double *value)
{
    (void)d;
    *value = fvi_expression_value(params, x);
    return FVI_SUCCESS;
}

void fvi_expression_gradient(const fvi_expression *e, const double *x,
                             double *grad)
{
    memset(grad, 0, e->d * sizeof *grad);
    for (const term *t = e->terms; t < e->terms + e->count; t++)
        for (size_t i = 0; i < t->coordinates; i++)
            grad[t->coordinate[i]] +=
                fvi_tape_slope(t->node, t->count, x, e->values,
                               t->coordinate[i])
                    .a;
}

void fvi_expression_add_hessian(const fvi_expression *e, const double *x,
                                double factor, double *H)
{
    for (const term *t = e->terms; t < e->terms + e->count; t++)
        for (size_t m = 0; m < t->coordinates; m++)
            for (size_t n = 0; n <= m; n++) {
                const size_t i = (size_t)t->coordinate[m],
                             j = (size_t)t->coordinate[n];
                const double c =
                    factor
                    * fvi_tape_second_derivative(t->node, t->count, x,
                                                 e->values, (int)i, (int)j)
                          .c;
                H[i * e->d + j] += c;
                if (i != j)
                    H[j * e->d + i] += c;
            }
}

static int potential_gradient(size_t d, const double *x, void *params,
                              double *grad)
{
    (void)d;
    fvi_expression_gradient(params, x, grad);
    return FVI_SUCCESS;
}

static int potential_hessian(size_t d, const double *x, void *params, double *H)
{
    const fvi_expression *e = params;
    const size_t diagonals = e->half_bandwidth + 1;
    for (size_t i = 0; i < d; i++)
        for (size_t k = 0; k < diagonals && i + k < d; k++)
            H[i * diagonals + k] = 0;
    for (const term *t = e->terms; t < e->terms + e->count; t++)
        for (size_t m = 0; m < t->coordinates; m++)
            for (size_t n = 0; n < t->coordinates; n++) {
                const int i = t->coordinate[m], j = t->coordinate[n];
                if (i <= j)
                    H[(size_t)i * diagonals + (size_t)(j - i)] +=
                        fvi_tape_second_derivative(t->node, t->count, x, e->values, i, j).c;
            }
    return FVI_SUCCESS;
}

static int is_quadratic(const void *params)
{
    return ((const fvi_expression *)params)->degree <= 2;
}

fvi_potential fvi_potential_expression(const fvi_expression *e)
{
    return (fvi_potential){ .value = potential_value,
                            .gradient = potential_gradient,
                            .hessian = potential_hessian,
                            .params = (void *)e,
                            .quadratic = is_quadratic,
                            .diagonals = e->half_bandwidth + 1,
                            .lanes = e->d == 1 ? &fvi_expression_slope_lanes : NULL };
}

static int force_value(double t, size_t d, void *params, double *F)
{
    const double value = fvi_expression_value(params, &t);
    for (size_t i = 0; i < d; i++)
        F[i] = value;
    return FVI_SUCCESS;
}

/* An expression of one variable has a single term. */
static int force_bound(double from, double to, size_t order, size_t d,
                       void *params, double *most)
{
    const fvi_expression *e = params;
    fvi_enclosure f;
    int status = fvi_tape_enclose(e->terms->node, e->terms->count, from, to,
                                  e->values, (int)order, &f);
    for (size_t k = 0; !status && k <= order; k++)
        for (size_t i = 0; i < d; i++)
            most[k * d + i] = k == 0             ? fvi_enclosure_half(&f)
                              : k <= (size_t)f.top ? f.most[k]
                                                   : 0;
    return status;
}

fvi_force fvi_force_expression(const fvi_expression *e)
{
    return (fvi_force){ .value = force_value,
                        .bound = force_bound,
                        .params = (void *)e,
                        .lanes = &fvi_expression_value_lanes };
}

void fvi_expression_complex_value(const fvi_expression *e, double re, double im,
                                  double *value_re, double *value_im)
{
    const double complex v = fvi_tape_complex(e->terms->node, e->terms->count,
                                              re + im * I, e->values);
    *value_re = creal(v);
    *value_im = cimag(v);
}
