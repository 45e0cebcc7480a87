/* tests/lobatto/driven_duffing.h -- A Duffing oscillator that is driven along x = t^8, for tests of H 17. */
#ifndef DRIVEN_DUFFING_H
#define DRIVEN_DUFFING_H

#include "lobatto_runs.h"

typedef struct {
    size_t count;
    double errors[12]; /* at h, h/2, h/4, ... */
} errors;

typedef struct {
    double alpha, rho;
} driving;

static inline int drive(double t, size_t d, void *params, double *F)
{
    const driving *a = params;
    const double b = 2 * a->alpha, q = pow(t, 8),
                 D = tgamma(9) / tgamma(9 - b) * pow(t, 8 - b);
    for (size_t i = 0; i < d; i++)
        F[i] = 56 * pow(t, 6) + (1 + q * q) * q + a->rho * D;
    return 0;
}

static inline fvi_system driven_duffing(const driving *a)
{
    static const double one = 1, cg[] = { 1, 1 };
    return (fvi_system){ 1,
                         &one,
                         &a->rho,
                         fvi_potential_duffing(cg),
                         { .value = drive, .params = (void *)a },
                         NULL, NULL };
}

/* The largest errors of a run of N steps; want_x, want_p: room for N + 1 numbers. */
static inline void compare_driven(size_t N, double h, const double *x, const double *p, double *want_x,
                                  double *want_p, errors *ex, errors *ep)
{
    for (size_t k = 0; k <= N; k++) {
        want_x[k] = pow((double)k * h, 8);
        want_p[k] = 8 * pow((double)k * h, 7);
    }
    ex->errors[ex->count++] = farthest(0, N + 1, x, want_x);
    ep->errors[ep->count++] = farthest(0, N + 1, p, want_p);
}

#endif
