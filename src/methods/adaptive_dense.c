/* src/methods/adaptive_dense.c -- Between the ends of a step.        [Chapter 22] */
#include "adaptive.h"

#include <fvi/error.h>

#include "memory/memory_kinds.h" /* FVI_VECTORS */

/* What the recurrences multiply by: no row has to wait for a quotient. */
#define UP(n) ((2.0 * (n) + 1) / ((n) + 1))
#define DOWN(n) ((n) / ((n) + 1.0))
#define HALF(n) (1 / (4.0 * (n) + 2))
#define EACH(f)                                                                \
    {                                                                          \
        f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7), f(8), f(9)             \
    }
static const double up[FVI_LANES + 2] = EACH(UP), down[] = EACH(DOWN),
                                   half[] = EACH(HALF);

/* The integrals I_0, ..., I_s of the Legendre polynomials P_n(2 u - 1) from 0 to four
 * numbers, which come one by one: a vector just written in parts is slow to read. */
//> legendre
FVI_VECTORS static void integrate(size_t s, double a, double b, double c,
                                  double d, fvi_four *I)
{
    fvi_four P[FVI_LANES + 2];
    const fvi_four theta = { a, b, c, d }, x = 2 * theta - 1;
    P[0] = (fvi_four){ 1, 1, 1, 1 };
    P[1] = x;
    I[0] = theta;
    for (size_t n = 1; n <= s; n++) {
        P[n + 1] = up[n] * x * P[n] - down[n] * P[n - 1];
        I[n] = half[n] * (P[n + 1] - P[n - 1]);
    }
}
//< legendre

void fvi_adaptive_shape(size_t s, double theta, double *R, double *Q)
{
    fvi_four I[FVI_LANES + 1];
    integrate(s, theta, theta, theta, theta, I);
    for (size_t n = 0; n < s; n++)
        R[n] = I[n][0];
    if (!Q)
        return;
    Q[0] = theta * theta / 2;
    for (size_t n = 1; n < s; n++)
        Q[n] = half[n] * (I[n + 1][0] - I[n - 1][0]);
}

void fvi_adaptive_shapes(size_t s, const double *theta, fvi_square *R)
{
    fvi_four I[FVI_LANES + 1];
    for (size_t i = 0; i < s; i += 4) {
        integrate(s - 1, theta[i], theta[i + 1], theta[i + 2], theta[i + 3], I);
        for (size_t n = 0; n < s; n++)
            *(fvi_four *)&R->column[n][i] = I[n];
    }
}

//> dense
/* x and p at a time within the last step: x'' integrated twice, once.       (22.18) */
int fvi_adaptive_dense(const fvi_stepper *s, double t, double *x, double *p)
{
    const fvi_adaptive_run *o = s->own;
    const double h = s->t - o->t0, theta = (t - o->t0) / h;
    double R[FVI_LANES], Q[FVI_LANES];
    if (!(h > 0 && theta >= 0 && theta <= 1))
        return FVI_EDOM;
    fvi_adaptive_shape(o->rule->s, theta, R, Q);
    for (size_t j = 0; j < o->d; j++) {
        const double *bend = o->bend0 + j * FVI_LANES;
        double fall = theta * o->v0[j], v = o->v0[j], G = 0, slope = 0;
        for (size_t n = 0; x && n < o->rule->s; n++)
            fall += Q[n] * bend[n];
        for (size_t n = 0; p && n < o->rule->s; n++)
            v += R[n] * bend[n];
        if (fvi_singular_is(o, o->t0) && t > 0)
            fvi_singular_at(&o->singular, j, t, &G, &slope, NULL);
        if (x)
            x[j] = o->y0[j] + h * fall + G;
        if (p)
            p[j] = s->run.system->mass[j] * (v + slope);
    }
    return FVI_SUCCESS;
}
//< dense
