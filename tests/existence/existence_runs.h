/* tests/existence/existence_runs.h -- Forces and iterations, for the tests of H 15. */
#ifndef EXISTENCE_RUNS_H
#define EXISTENCE_RUNS_H

#include <fvi/error.h>
#include <fvi/paper/existence.h>
#include "harness/ulp.h"

enum { MANY = 1000 };

static inline double linear(double x, double v, const void *W)
{
    (void)v;
    return -*(const double *)W * x;
}
static inline double both(double x, double v, const void *p)
{
    (void)p;
    return -2 * x - v / 2;
}
static inline double pendulum(double x, double v, const void *p)
{
    (void)v, (void)p;
    return -sin(x);
}
static inline double hard(double x, double v, const void *p)
{
    (void)v, (void)p;
    return -x - x * x * x;
}

static const double ONE = 1;

static inline void picard(const fvi_picard_problem *p, double h, size_t N,
                          const double *v, double *next)
{
    static double x[MANY + 1];
    ck_assert_int_eq(fvi_picard(p, h, N, v, x, next), FVI_SUCCESS);
}

/* n iterations that begin with v = v0; ends with the last v and its x. */
static inline void iterate(const fvi_picard_problem *p, double h, size_t N,
                           size_t n, double *x, double *v)
{
    static double next[MANY + 1];
    for (size_t k = 0; k <= N; k++)
        v[k] = p->v0;
    for (size_t i = 0; i < n; i++) {
        ck_assert_int_eq(fvi_picard(p, h, N, v, x, next), FVI_SUCCESS);
        memcpy(v, next, (N + 1) * sizeof *v);
    }
    ck_assert_int_eq(fvi_picard(p, h, N, v, x, next), FVI_SUCCESS);
}

/* max |a_k - b_k| e^(-lambda t_k). */
static inline double distance(size_t N, double h, double lambda,
                              const double *a, const double *b)
{
    double most = 0;
    for (size_t k = 0; k <= N; k++)
        most = larger(most, fabs(a[k] - b[k]) * exp(-lambda * h * (double)k));
    return most;
}

#endif
