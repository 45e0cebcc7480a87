/* src/methods/adaptive_dense.c -- Between the ends of a step.        [Chapter 22] */
#include "adaptive.h"

#include <fvi/error.h>

#include <string.h>

void fvi_adaptive_shape(size_t s, double theta, double *R, double *Q)
{
    double P[FVI_LANES + 3],
        I[FVI_LANES + 2]; /* Legendre, and their integrals */
    const double x = 2 * theta - 1;
    P[0] = 1;
    P[1] = x;
    for (size_t n = 1; n < s + 2; n++)
        P[n + 1] = ((double)(2 * n + 1) * x * P[n] - (double)n * P[n - 1])
                   / (double)(n + 1);
    I[0] = theta;
    for (size_t n = 1; n <= s; n++)
        I[n] = (P[n + 1] - P[n - 1]) / (double)(4 * n + 2);
    memcpy(R, I, s * sizeof *R);
    if (!Q)
        return;
    Q[0] = theta * theta / 2;
    for (size_t n = 1; n < s; n++)
        Q[n] = (I[n + 1] - I[n - 1]) / (double)(4 * n + 2);
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
        for (size_t n = 0; n < o->rule->s; n++) {
            fall += Q[n] * bend[n];
            v += R[n] * bend[n];
        }
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
