/* src/memory.c -- The history of a fractional derivative.       [Chapter 12] */
#include "memory.h"

#include "coefficients.h"

#include <gsl/gsl_errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct fvi_memory {
    double order; /* of the weights: beta, or beta - 1 on increments */
    int on_increments;
    size_t d, steps, k; /* k terms have come in */
    double *weights;    /* w_n at [steps - n]: both factors of the sum ascend */
    double *history;    /* component i of term k at [i * (steps + 1) + k] */
    double *last;       /* d numbers: the last term, where order is 0 or 1 */
};

static int is_local(double order)
{
    return order == 0 || order == 1;
}

int fvi_memory_alloc(double beta, size_t d, size_t steps, fvi_memory_kind kind,
                     double tolerance, fvi_memory **memory)
{
    if (!memory)
        GSL_ERROR("memory is a null pointer", GSL_EFAULT);
    if (kind > FVI_MEMORY_EXPONENTIALS)
        GSL_ERROR("unknown kind of memory", GSL_EINVAL);
    if (d == 0 || steps >= SIZE_MAX / sizeof(double) / d - 1)
        GSL_ERROR("d must be at least 1 and steps addressable", GSL_EINVAL);
    if (!(beta >= 0 && beta <= 2))
        GSL_ERROR("beta must be in [0, 2]", GSL_EDOM);
    if (!(tolerance >= 0))
        GSL_ERROR("tolerance must not be negative", GSL_EDOM);

    fvi_memory m = { .order = beta < 1 ? beta : beta - 1,
                     .on_increments = beta >= 1,
                     .d = d,
                     .steps = steps };
    if (is_local(m.order)) {
        m.last = calloc(d, sizeof *m.last);
    } else {
        m.weights = malloc((steps + 1) * sizeof *m.weights);
        m.history = malloc((steps + 1) * d * sizeof *m.history);
    }
    fvi_memory *out = malloc(sizeof *out);
    if (!out || !(m.last || (m.weights && m.history))) {
        free(m.last);
        free(m.weights);
        free(m.history);
        free(out);
        GSL_ERROR("no memory for the history", GSL_ENOMEM);
    }
    if (m.weights) {
        fvi_coefficients(m.order, steps + 1, m.weights);
        for (size_t i = 0, j = steps; i < j; i++, j--) {
            double swap = m.weights[i];
            m.weights[i] = m.weights[j];
            m.weights[j] = swap;
        }
    }
    *out = m;
    *memory = out;
    return GSL_SUCCESS;
}

void fvi_memory_free(fvi_memory *m)
{
    if (!m)
        return;
    free(m->last);
    free(m->weights);
    free(m->history);
    free(m);
}

//> dot
/* sum_{j < n} a[j] b[j]. The pragma allows the partial sums of vector code. */
static double dot(size_t n, const double *restrict a, const double *restrict b)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (size_t j = 0; j < n; j++)
        sum += a[j] * b[j];
    return sum;
}
//< dot

int fvi_memory_push(fvi_memory *m, const double *x, const double *dx, double *H)
{
    if (!m || !x || !dx || !H)
        GSL_ERROR("null pointer", GSL_EFAULT);
    if (m->k > m->steps)
        GSL_ERROR("more terms than were announced", GSL_EINVAL);
    const double *term = m->on_increments ? dx : x;
    for (size_t i = 0; i < m->d; i++) {
        double new = term[i];
        if (m->last) { /* weights 1, or 1 and -1 */
            H[i] = m->order == 0 ? new : new - m->last[i];
            m->last[i] = new;
        } else {
            double *history = m->history + i * (m->steps + 1);
            history[m->k] = new;
            H[i] = dot(m->k + 1, m->weights + (m->steps - m->k), history);
        }
    }
    m->k++;
    return GSL_SUCCESS;
}
