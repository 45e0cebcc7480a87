/* src/estimation/rheology_shapes.c -- Write the elements of a law with characteristic times. [H 24]
 *
 * In rho and time the numbers of an element are correlated, because the size of s^{2 alpha} is that at s = 1, wherever
 * the data are. An amplitude and a characteristic time are not correlated. */
#include "rheology_model.h"

#include <math.h>

size_t fvi_element_shape(fvi_element kind, fvi_kernel_range ranges[FVI_ELEMENT_SHAPE])
{
    size_t count = 0;
    for (; fvi_element_number(kind, count + 1, NULL); count++)
        ranges[count] = fvi_element_numbers(kind)[count + 1].range;
    if (kind == FVI_ELEMENT_MAXWELL2) { /* u = b, e, ln t */
        ranges[1] = FVI_RANGE_ORDER;
        ranges[2] = FVI_RANGE_SIZE;
    }
    return count;
}

/* An element as its kernel has it, and what its numbers u are there: phi = t^{2 alpha} C(s) for rho = 1, and time is
 * t^p. */
typedef struct {
    fvi_kernel_term term;
    double ln_t, order, power; /* order: 2 alpha; power: p */
    size_t a, t;               /* place of alpha and of ln t in u */
} element_kernel;

static element_kernel kernel_of_element(fvi_element kind, const double *u)
{
    const fvi_kernel_number *number = fvi_element_numbers(kind);
    double value[FVI_ELEMENT_NUMBERS] = { 1 };
    element_kernel o = { .order = 1, .a = FVI_ELEMENT_SHAPE, .t = FVI_ELEMENT_SHAPE };
    size_t count = 0;
    for (; fvi_element_number(kind, count + 1, NULL); count++) {
        const fvi_kernel_number *of = &number[count + 1];
        value[count + 1] = of->range == FVI_RANGE_SIZE ? exp(u[count]) : u[count];
        if (of->field == 1) {
            o.a = count;
            o.order = 2 * u[count];
        } else if (of->field == 2) {
            o.t = count;
            o.ln_t = u[count];
        }
    }
    o.power = fvi_element_has_time(kind) ? 1 : o.order;
    if (o.t < count)
        value[o.t + 1] = exp(o.power * o.ln_t);
    o.term = fvi_element_term(kind, value);
    return o;
}

/* Compute phi of any element from its kernel, and its derivatives by u. */
static void symbol_of_element(fvi_element kind, double complex s, const double *u, double complex *phi,
                              double complex d[FVI_ELEMENT_SHAPE])
{
    const fvi_kernel_number *number = fvi_element_numbers(kind);
    const element_kernel o = kernel_of_element(kind, u);
    const double scale = exp(o.order * o.ln_t);
    double complex by_time = 0;
    *phi = scale * fvi_kernel_at(&(fvi_kernel){ 1, &o.term }, s, NULL);
    for (size_t k = 0; fvi_element_number(kind, k + 1, NULL); k++) {
        const size_t field = number[k + 1].field;
        d[k] = scale * fvi_kernel_derivative_symbol(&o.term, (fvi_slope_by)(field - 1))(&o.term, s);
        d[k] *= k != o.t && number[k + 1].range == FVI_RANGE_SIZE ? exp(u[k]) : 1;
        by_time = k == o.t ? o.term.time * d[k] : by_time;
    }
    if (o.t < FVI_ELEMENT_SHAPE)
        d[o.t] = o.order * *phi + o.power * by_time;
    if (o.a < FVI_ELEMENT_SHAPE)
        d[o.a] += 2 * o.ln_t * (*phi + (fvi_element_has_time(kind) ? 0 : by_time));
}

/* Compute int_b^{b+e} s^{2a} da, with L = ln s. The derivative by the upper end is the integrand there. */
static void range_at(double complex L, double b, double e, double complex *phi,
                     double complex d[])
{
    /* (e^{2 (b + e) L} - e^{2 b L})/(2 L), by its series if the two exponents are near each other */
    const double complex x = 2 * e * L, low = cexp(2 * b * L);
    double complex part = 1, term = 1;
    if (cabs(x) < 0.5)
        for (int k = 2; k < 20; k++)
            part += term *= x / k;
    else
        part = (cexp(x) - 1) / x;
    *phi = e * low * part;
    d[0] = 2 * L * *phi;
    d[1] = low * cexp(x);
}

//> shapes
void fvi_element_at(fvi_element kind, double complex s, double complex L, const double *u,
                    double complex *phi, double complex d[FVI_ELEMENT_SHAPE])
{
    double complex q, part;
    switch (kind) {
    case FVI_ELEMENT_SPRING:
        *phi = 1;
        break;
    case FVI_ELEMENT_VISCOUS:
        *phi = s;
        break;
    case FVI_ELEMENT_POWER: /* s^{2a} */
        *phi = cexp(2 * u[0] * L);
        d[0] = 2 * L * *phi;
        break;
    case FVI_ELEMENT_ZENER: /* (s t)^{2a}/(1 + (s t)^{2a}) */
        L += u[1];
        q = cexp(2 * u[0] * L);
        part = 1 / (1 + q);
        *phi = q * part;
        d[0] = 2 * L * *phi * part;
        d[1] = 2 * u[0] * *phi * part;
        break;
    case FVI_ELEMENT_MAXWELL:
        q = s * exp(u[0]);
        part = 1 / (1 + q);
        *phi = q * part;
        d[0] = *phi * part;
        break;
    case FVI_ELEMENT_MAXWELL2: /* (s t)^{2(b+e)}/(1 + (s t)^{2e}), u = b, e, ln t */
        L += u[2];
        part = 1 / (1 + cexp(2 * u[1] * L));
        *phi = cexp(2 * (u[0] + u[1]) * L) * part;
        d[0] = 2 * L * *phi;
        d[1] = 2 * L * *phi * part;
        d[2] = *phi * (2 * u[0] + 2 * u[1] * part);
        break;
    case FVI_ELEMENT_DAVIDSON: /* (s t/(1 + s t))^{2a} */
        q = s * exp(u[1]);
        L = clog(q / (1 + q));
        *phi = cexp(2 * u[0] * L);
        d[0] = 2 * L * *phi;
        d[1] = 2 * u[0] * *phi / (1 + q);
        break;
    case FVI_ELEMENT_DISTRIBUTED:
        range_at(L, u[0], u[1], phi, d);
        break;
    default:
        symbol_of_element(kind, s, u, phi, d);
    }
}
//< shapes

double fvi_element_most(fvi_element kind, size_t i)
{
    const fvi_kernel_number *of = &fvi_element_numbers(kind)[i];
    return of->range == FVI_RANGE_ORDER ? 0.5 : of->most; /* 2 alpha <= 1 */
}

/* Write the numbers of an element whose u are its numbers, but for t: c = rho / t^{2 alpha}, and time = t^p. */
static void public_numbers(fvi_element kind, const double *u, double value[], double slope[][1 + FVI_ELEMENT_SHAPE])
{
    const element_kernel o = kernel_of_element(kind, u);
    for (size_t k = 0; fvi_element_number(kind, k + 1, NULL); k++) {
        value[k + 1] = u[k];
        slope[k + 1][k + 1] = 1;
    }
    if (o.t == FVI_ELEMENT_SHAPE)
        return;
    value[0] += o.order * o.ln_t;
    value[o.t + 1] = o.power * o.ln_t;
    slope[0][o.t + 1] = o.order;
    slope[o.t + 1][o.t + 1] = o.power;
    if (o.a == FVI_ELEMENT_SHAPE)
        return;
    slope[0][o.a + 1] = 2 * o.ln_t;
    slope[o.t + 1][o.a + 1] = fvi_element_has_time(kind) ? 0 : 2 * o.ln_t;
}

void fvi_element_public(fvi_element kind, double ln_c, const double *u,
                        double value[FVI_ELEMENT_NUMBERS],
                        double slope[FVI_ELEMENT_NUMBERS][1 + FVI_ELEMENT_SHAPE])
{
    for (size_t i = 0; i < FVI_ELEMENT_NUMBERS; i++)
        for (size_t k = 0; k <= FVI_ELEMENT_SHAPE; k++)
            slope[i][k] = 0;
    value[0] = ln_c;
    slope[0][0] = 1;
    switch (kind) {
    case FVI_ELEMENT_MAXWELL2:
        value[0] += 2 * (u[0] + u[1]) * u[2];
        slope[0][1] = slope[0][2] = 2 * u[2];
        slope[0][3] = 2 * (u[0] + u[1]);
        value[1] = u[0] + u[1];
        slope[1][1] = slope[1][2] = 1;
        value[2] = ln_c + 2 * u[0] * u[2];
        slope[2][0] = 1;
        slope[2][1] = 2 * u[2];
        slope[2][3] = 2 * u[0];
        value[3] = u[0];
        slope[3][1] = 1;
        break;
    case FVI_ELEMENT_DISTRIBUTED:
        value[1] = u[0];
        slope[1][1] = 1;
        value[2] = u[0] + u[1];
        slope[2][1] = slope[2][2] = 1;
        break;
    default:
        public_numbers(kind, u, value, slope);
    }
}
