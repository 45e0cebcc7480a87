/* src/memory/history_direct.c -- The sum as it stands.                  [H 12] */
#include <fvi/coefficients.h>
#include <fvi/error.h>
#include "history_kinds.h"

#include <stdlib.h>
#include <string.h>

struct fvi_history_direct {
    size_t d, steps, k; /* k terms have come in */
    double *weights;    /* w_n at [steps - n], so that both factors */
    double *history;    /* ascend; component i of term k at [i (steps+1)+k] */
    double *rates;      /* d w_n / d nu, as the weights, or NULL */
};

size_t fvi_history_direct_bytes(size_t d, size_t steps)
{
    if (steps >= SIZE_MAX / sizeof(double) / 3 / d - 1)
        return SIZE_MAX;
    return sizeof(fvi_history_direct) + (d + 1) * (steps + 1) * sizeof(double);
}

/* w_n at [steps - n] */
static void reverse(size_t steps, double *weights)
{
    for (size_t i = 0, j = steps; i < j; i++, j--) {
        double swap = weights[i];
        weights[i] = weights[j];
        weights[j] = swap;
    }
}

fvi_history_direct *fvi_history_direct_of(size_t d, size_t steps, double *weights)
{
    fvi_history_direct *m = malloc(sizeof *m);
    double *history = malloc((steps + 1) * d * sizeof *history);
    if (!m || !weights || !history) {
        free(m);
        free(weights);
        free(history);
        return NULL;
    }
    *m = (fvi_history_direct){
        .d = d, .steps = steps, .weights = weights, .history = history
    };
    reverse(steps, weights);
    return m;
}

fvi_history_direct *fvi_history_direct_alloc(double nu, int by_order, size_t d, size_t steps)
{
    const size_t count = steps + 1;
    double *weights = malloc(count * sizeof *weights);
    if (weights)
        fvi_gl_weights(nu, count, weights);
    fvi_history_direct *m = fvi_history_direct_of(d, steps, weights);
    if (!m || !by_order)
        return m;
    m->rates = malloc(count * sizeof *m->rates);
    if (!m->rates) {
        fvi_history_direct_free(m);
        return NULL;
    }
    fvi_gl_weights_by_order(nu, count, m->rates);
    reverse(steps, m->rates);
    return m;
}

/* n numbers again, or NULL; nothing of nothing. */
static double *duplicate(const double *from, size_t n, int *all)
{
    double *to = from ? malloc(n * sizeof *to) : NULL;
    if (to)
        memcpy(to, from, n * sizeof *to);
    *all &= !from == !to;
    return to;
}

fvi_history_direct *fvi_history_direct_copy(const fvi_history_direct *from)
{
    int all = 1;
    const size_t count = from->steps + 1;
    fvi_history_direct *m = malloc(sizeof *m);
    if (!m)
        return NULL;
    *m = *from;
    m->weights = duplicate(from->weights, count, &all);
    m->history = duplicate(from->history, count * from->d, &all);
    m->rates = duplicate(from->rates, count, &all);
    if (all)
        return m;
    fvi_history_direct_free(m);
    return NULL;
}

void fvi_history_direct_free(fvi_history_direct *m)
{
    if (!m)
        return;
    free(m->weights);
    free(m->history);
    free(m->rates);
    free(m);
}

/* The terms so far, coordinate by coordinate: the room behind them depends on N. */
int fvi_history_direct_archive(fvi_history_direct *m, size_t k, fvi_archive *v)
{
    int status = FVI_SUCCESS;
    m->k = k;
    for (size_t i = 0; !status && i < m->d; i++)
        status = v->serialize(v, m->history + i * (m->steps + 1),
                          k * sizeof *m->history, 0);
    return status;
}

/* sum_{j < n} a[j] b[j]: partial sum l takes every eighth product. */
FVI_VECTORS static double dot(size_t n, const double *restrict a,
                              const double *restrict b)
{
    double sum[8] = { 0 };
    size_t j = 0;
    //> dot
    for (; j + 8 <= n; j += 8) {
#pragma GCC unroll 8
        for (size_t l = 0; l < 8; l++)
            sum[l] += a[j + l] * b[j + l];
    }
    //< dot
    for (; j < n; j++)
        sum[0] += a[j] * b[j];
    return ((sum[0] + sum[4]) + (sum[2] + sum[6]))
           + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

//> direct
void fvi_history_direct_push(fvi_history_direct *m, const double *term, double *H)
{
    for (size_t i = 0; i < m->d; i++) {
        double *history = m->history + i * (m->steps + 1);
        history[m->k] = term[i];
        H[i] = dot(m->k + 1, m->weights + (m->steps - m->k), history);
    }
    m->k++;
}
//< direct

/* The same sums with other weights, of the terms that are in. */
void fvi_history_direct_push_by_order(fvi_history_direct *m, const double *term, double *H,
                          double *rate)
{
    fvi_history_direct_push(m, term, H);
    for (size_t i = 0; i < m->d; i++)
        rate[i] = dot(m->k, m->rates + (m->steps + 1 - m->k),
                      m->history + i * (m->steps + 1));
}

void fvi_history_direct_ahead(const fvi_history_direct *m, double *sum)
{
    for (size_t i = 0; i < m->d; i++)
        sum[i] += dot(m->k, m->weights + (m->steps - m->k),
                      m->history + i * (m->steps + 1));
}
