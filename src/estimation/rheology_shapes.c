/* src/estimation/rheology_shapes.c -- Write the elements of a law with characteristic times. [H 24]
 *
 * In rho and time the numbers of an element are correlated, because the size of s^{2 alpha} is that at s = 1, wherever
 * the data are. An amplitude and a characteristic time are not correlated. */
#include "rheology_model.h"

#include <math.h>

size_t fvi_element_shape(fvi_element kind, const char **kinds)
{
    static const char *const of[] = { "", "", "a", "at", "t", "aat", "at", "aa" };
    static const size_t count[] = { 0, 0, 1, 2, 1, 3, 2, 2 };
    *kinds = of[kind];
    return count[kind];
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
    default:
        range_at(L, u[0], u[1], phi, d);
    }
}
//< shapes

int fvi_element_is_order(fvi_element kind, size_t i)
{
    size_t field = 0;
    fvi_element_number(kind, i, &field);
    return field % 2 == 1; /* alpha and end */
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
    case FVI_ELEMENT_POWER:
        value[1] = u[0];
        slope[1][1] = 1;
        break;
    case FVI_ELEMENT_ZENER: /* c = rho / time, t = time^{1/2a} */
    case FVI_ELEMENT_DAVIDSON: /* c = rho / time^{2a} */
        value[0] += 2 * u[0] * u[1];
        slope[0][1] = 2 * u[1];
        slope[0][2] = 2 * u[0];
        value[1] = u[0];
        slope[1][1] = 1;
        value[2] = kind == FVI_ELEMENT_ZENER ? 2 * u[0] * u[1] : u[1];
        slope[2][1] = kind == FVI_ELEMENT_ZENER ? 2 * u[1] : 0;
        slope[2][2] = kind == FVI_ELEMENT_ZENER ? 2 * u[0] : 1;
        break;
    case FVI_ELEMENT_MAXWELL:
        value[0] += u[0];
        slope[0][1] = 1;
        value[1] = u[0];
        slope[1][1] = 1;
        break;
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
        break;
    }
}
