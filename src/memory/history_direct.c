/* src/memory/history_direct.c -- Compute the history by the direct sum of all terms.                  [H 12] */
#include <fvi/coefficients.h>
#include <fvi/error.h>
#include "history_kinds.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
    fvi_history_head head;
    size_t steps;
    int depends_on_steps; /* nonzero if the last digits of the weights depend on steps */
    double *weights;      /* w_n at [steps - n], so that the addresses of both factors of a product ascend */
    double *history;      /* coordinate i of term k at [i * (steps + 1) + k] */
    double *rates;        /* dw_n/dnu, ordered as the weights; only if the engine was made by_order */
    _Alignas(64) double numbers[];
} direct_engine;

static size_t bytes_of(size_t d, size_t steps, int by_order)
{
    if (steps >= SIZE_MAX / sizeof(double) / 3 / d - 1)
        return SIZE_MAX;
    return fvi_history_piece(sizeof(direct_engine), (d + 1 + (by_order != 0)) * (steps + 1));
}

size_t fvi_history_direct_bytes(size_t d, size_t steps)
{
    return bytes_of(d, steps, 0);
}

/* Reverse the weights, so that w_n stands at [steps - n]. */
static void reverse(size_t steps, double *weights)
{
    for (size_t i = 0, j = steps; i < j; i++, j--) {
        double swap = weights[i];
        weights[i] = weights[j];
        weights[j] = swap;
    }
}

static void set_array_pointers(fvi_history_head *head)
{
    direct_engine *m = (direct_engine *)head;
    m->weights = m->numbers;
    m->history = m->weights + m->steps + 1;
    m->rates = m->history + head->d * (m->steps + 1);
}

static const fvi_history_engine engine;

static direct_engine *make_engine(size_t d, size_t steps, int by_order)
{
    direct_engine *m = fvi_history_make((fvi_history_head){
        .is = &engine, .bytes = bytes_of(d, steps, by_order), .d = d });
    if (!m)
        return NULL;
    m->steps = steps;
    set_array_pointers(&m->head);
    return m;
}

fvi_history_head *fvi_history_direct_of(size_t d, size_t steps, const double *weights,
                                        int depend_on_steps)
{
    direct_engine *m = make_engine(d, steps, 0);
    if (!m)
        return NULL;
    m->depends_on_steps = depend_on_steps;
    for (size_t n = 0; n <= steps; n++)
        m->weights[steps - n] = weights[n];
    return &m->head;
}

fvi_history_head *fvi_history_direct_alloc(double nu, int by_order, size_t d, size_t steps)
{
    direct_engine *m = make_engine(d, steps, by_order);
    if (!m)
        return NULL;
    fvi_gl_weights(nu, steps + 1, m->weights);
    reverse(steps, m->weights);
    if (by_order) {
        fvi_gl_weights_by_order(nu, steps + 1, m->rates);
        reverse(steps, m->rates);
    }
    return &m->head;
}

/* Archive the terms so far, coordinate by coordinate, because the room behind them depends on the number of steps. If
 * the weights depend on it, too, archive the weights of the run so far: they must be the same when the run goes on. */
static int archive(fvi_history_head *head, fvi_archive *v)
{
    direct_engine *m = (direct_engine *)head;
    int status = FVI_SUCCESS;
    if (m->depends_on_steps)
        status = v->serialize(v, m->weights + (m->steps + 1 - head->k),
                              head->k * sizeof *m->weights, 1);
    for (size_t i = 0; !status && i < head->d; i++)
        status = v->serialize(v, m->history + i * (m->steps + 1),
                          head->k * sizeof *m->history, 0);
    return status;
}

/* Return sum_{j < n} a[j] b[j]. Partial sum l takes every eighth product, from the l-th one on. */
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
static void push(fvi_history_head *head, const double *term, double *H)
{
    direct_engine *m = (direct_engine *)head;
    const size_t k = head->k;
    for (size_t i = 0; i < head->d; i++) {
        double *history = m->history + i * (m->steps + 1);
        history[k] = term[i];
        H[i] = dot(k + 1, m->weights + (m->steps - k), history);
    }
}
//< direct

/* Compute the same sums with the derivatives of the weights. The derivative of w_0 = 1 is 0, so the
 * newest term adds nothing. */
static void push_by_order(fvi_history_head *head, const double *term, double *H,
                          double *rate)
{
    direct_engine *m = (direct_engine *)head;
    const size_t k = head->k;
    push(head, term, H);
    for (size_t i = 0; i < head->d; i++)
        rate[i] = dot(k + 1, m->rates + (m->steps - k), m->history + i * (m->steps + 1));
}

static void ahead(const fvi_history_head *head, double *sum)
{
    const direct_engine *m = (const direct_engine *)head;
    for (size_t i = 0; i < head->d; i++)
        sum[i] += dot(head->k, m->weights + (m->steps - head->k),
                      m->history + i * (m->steps + 1));
}

static const fvi_history_engine engine = { .place = set_array_pointers,
                                           .push = push,
                                           .push_by_order = push_by_order,
                                           .ahead = ahead,
                                           .archive = archive };
