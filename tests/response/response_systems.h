/* tests/response/response_systems.h -- Linear systems for the tests of H 30. */
#ifndef RESPONSE_SYSTEMS_H
#define RESPONSE_SYSTEMS_H

#include <complex.h>
#include <fvi/fvi.h>
#include <stdlib.h>
#include <string.h>

#include "harness/seen.h"
#include "harness/ulp.h"
#include "system/seeded.h"

enum { MOST = 12, DAMPERS = 3 };

/* Masses in a row on springs between them, the first to the ground, and dampers by rows. */
typedef struct {
    size_t d, dampers;
    double mass[MOST], none[MOST], K[MOST * MOST], row[DAMPERS][MOST];
    fvi_kernel_term term[DAMPERS][2];
    fvi_kernel kernel[DAMPERS];
    fvi_damper damper[DAMPERS];
    fvi_mechanism mechanism;
    fvi_system system;
} linear_system;

/* U = x^T K x / 2 */
static inline int value(size_t d, const double *x, void *params, double *sum)
{
    const double *K = params;
    *sum = 0;
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            *sum += x[i] * K[i * d + j] * x[j] / 2;
    return 0;
}

static inline int gradient(size_t d, const double *x, void *params, double *g)
{
    const double *K = params;
    for (size_t i = 0; i < d; i++) {
        g[i] = 0;
        for (size_t j = 0; j < d; j++)
            g[i] += K[i * d + j] * x[j];
    }
    return 0;
}

static inline int hessian(size_t d, const double *x, void *params, double *H)
{
    (void)x;
    memcpy(H, params, d * d * sizeof *H);
    return 0;
}

/* The system points into itself, so it stays where it is. */
static inline void point_into(linear_system *s)
{
    for (size_t j = 0; j < s->dampers; j++) {
        s->kernel[j].term = s->term[j];
        s->damper[j] = (fvi_damper){ .of = fvi_elongation_row(s->row[j]),
                                     .kernel = &s->kernel[j] };
    }
    s->mechanism = (fvi_mechanism){ .damper_count = s->dampers, .damper = s->damper };
    s->system = (fvi_system){ .d = s->d, .mass = s->mass, .damping = s->none,
                              .potential = { .value = value,
                                             .gradient = gradient,
                                             .hessian = hessian,
                                             .params = s->K },
                              .mechanism = &s->mechanism };
}

static inline void springs(linear_system *s, const double *k)
{
    memset(s->K, 0, sizeof s->K);
    for (size_t i = 0; i < s->d; i++) {
        s->K[i * s->d + i] += k[i];
        if (i == 0)
            continue;
        s->K[(i - 1) * s->d + i - 1] += k[i];
        s->K[(i - 1) * s->d + i] -= k[i];
        s->K[i * s->d + i - 1] -= k[i];
    }
}

/* The three systems of verify/response/response.py. */
static inline void make_system(int which, linear_system *s)
{
    static const linear_system all[] = {
        { .d = 5, .dampers = 3, .mass = { 1, 1, 1, 1, 1 },
          .row = { { 1 }, { 0, -1, 1 }, { 0, 0, 0, -1, 1 } },
          .term = { { { FVI_KERNEL_POWER, 5, 0.3125, 0, 0 } },
                    { { FVI_KERNEL_POWER, 5, 0.3125, 0, 0 } },
                    { { FVI_KERNEL_POWER, 0.5, 0.5, 0, 0 } } },
          .kernel = { { .count = 1 }, { .count = 1 }, { .count = 1 } } },
        { .d = 3, .dampers = 2, .mass = { 1, 2, 0.5 },
          .row = { { -1, 1 }, { 0, -1, 1 } },
          .term = { { { FVI_KERNEL_ZENER, 1, 0.375, 0.5, 0 },
                      { FVI_KERNEL_DAVIDSON, 0.5, 0.3125, 0.75, 0 } },
                    { { FVI_KERNEL_MAXWELL2, 0.75, 0.4375, 0.5, 0.125 },
                      { FVI_KERNEL_DISTRIBUTED, 0.5, 0.0625, 0, 0.375 } } },
          .kernel = { { .count = 2 }, { .count = 2 } } },
        { .d = 2, .dampers = 2, .mass = { 1, 1 },
          .row = { { 1 }, { -1, 1 } },
          .term = { { { FVI_KERNEL_POWER, 0.5, 0.8125, 0, 0 } },
                    { { FVI_KERNEL_POWER, 0.25, 0.625, 0, 0 } } },
          .kernel = { { .count = 1 }, { .count = 1 } } },
    };
    static const double k[][5] = { { 100, 100, 100, 100, 100 }, { 4, 3, 2 },
                                   { 2, 3 } };
    *s = all[which];
    springs(s, k[which]);
    point_into(s);
}

static inline fvi_response *response_of(const fvi_linear_motion *motion)
{
    fvi_response *response = NULL;
    fvi_error error;
    if (fvi_response_alloc(motion, &response, &error))
        ck_abort_msg("%s: %s", error.field ? error.field : "", error.text);
    return response;
}

/* Frobenius's norms of Z(s) by its summands and of its inverse. */
static inline double norm_of_inverse(fvi_response *r, const double s[2])
{
    const size_t d = fvi_response_dimension(r);
    double sum = 0;
    for (size_t j = 0; j < d; j++) {
        double complex x[MOST] = { 0 };
        x[j] = 1;
        OK(fvi_response_solve(r, s, (double *)x, (double *)x, NULL));
        for (size_t i = 0; i < d; i++)
            sum += creal(x[i] * conj(x[i]));
    }
    return sqrt(sum);
}

/* A number in (0, 1) */
static inline double chance(uint64_t *seed)
{
    return fvi_seeded_uniform(seed, 0, 1) + 0x1p-54;
}

/* ---- poles ---- */

static inline fvi_poles poles_of(fvi_response *r, size_t count)
{
    fvi_poles poles;
    fvi_error error;
    if (fvi_poles_find(r, count, &poles, &error))
        ck_abort_msg("%s: %s", error.field ? error.field : "", error.text);
    return poles;
}

static inline double complex pole(const fvi_poles *p, size_t k)
{
    return p->pole[2 * k] + I * p->pole[2 * k + 1];
}

static inline double complex shape(const fvi_poles *p, size_t k, size_t i)
{
    const double *v = p->shape + 2 * (k * p->d + i);
    return v[0] + I * v[1];
}

#endif
