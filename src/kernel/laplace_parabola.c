/* src/kernel/laplace_parabola.c -- Invert a Laplace transform by an integral along a parabola.    [H 26] */
#include "laplace_parabola.h"

#include <gsl/gsl_math.h>
#include <math.h>

enum { TAIL = 3 };
static const double spacing = 0.12;

void fvi_parabola_make(double t, fvi_parabola *p)
{
    p->mu = TAIL / (FVI_PARABOLA_SPAN * t);
    for (int j = 0; j < FVI_PARABOLA_NODES; j++) {
        const double complex v = 1 + I * (j + 0.5) * spacing;
        p->s[j] = p->mu * v * v;
        p->weight[j] = 2 * p->mu / M_PI * spacing * v; /* the factor 2 includes the conjugate node */
    }
}

/* The pole is at s = mu (1 + i v)^2. The function 1/(1 + e^{2 pi i v/spacing}) has its poles at the nodes, so Cauchy's
 * theorem gives the part 1/(1 + e^{-2 pi i v/spacing}). */
double complex fvi_parabola_left_out(const fvi_parabola *p, double complex s,
                                     double complex *slope)
{
    const double complex root = csqrt(s / p->mu), v = -I * (root - 1);
    const double complex part =
        cimag(v) > 10 ? 0 : 1 / (1 + cexp(-2 * M_PI * I * v / spacing));
    if (slope)
        *slope = (1 - part) * M_PI / spacing * root;
    return part;
}
