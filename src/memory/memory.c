/* src/memory/memory.c -- The history of a fractional derivative.       [H 12] */
#include <fvi/memory.h>

#include "history_tiled.h"
#include "history_kinds.h"
#include "history_parts.h"
#include "system/fail.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Up to here the direct sum is the faster one, or loses some microseconds, on the machine of
 * figures/memory/memory_bench.tsv. */
enum { FEW_STEPS = 256 };

struct fvi_history {
    double order;   /* of the weights: beta, or beta - 1 on increments */
    fvi_node_range nodes; /* of a compressed memory */
    int on_increments;
    fvi_history_kind kind; /* never AUTO */
    size_t d, steps, k;   /* k terms have come in */
    double *last;         /* d numbers: the last term, if order is 0 or 1 */
    int by_order;            /* dH/d beta is wanted, too */
    fvi_history_direct *direct;   /* one of last, direct and exponentials is not NULL */
    fvi_history_modes *exponentials;
};

static int is_local(double order)
{
    return order == 0 || order == 1;
}

/* (12.2). The difference is exact. */
static double order_of(double beta)
{
    return beta < 1 ? beta : beta - 1;
}

fvi_history_kind fvi_history_choose(double beta, size_t steps)
{
    return steps <= FEW_STEPS || is_local(order_of(beta))
               ? FVI_HISTORY_DIRECT
               : FVI_HISTORY_MODES;
}

/* H needs the last term alone. */
static int needs_no_past(const fvi_history *m)
{
    return is_local(m->order) && !m->by_order;
}

/* All that is known before anything is allocated, and the bytes that this will be. */
static int plan(double beta, int by_order, size_t d, size_t steps,
                fvi_history_kind kind, double tolerance, fvi_history *m,
                size_t *bytes)
{
    if (kind != FVI_HISTORY_AUTO && kind != FVI_HISTORY_DIRECT
        && kind != FVI_HISTORY_MODES)
        FVI_FAIL("unknown kind of memory", FVI_EINVAL);
    if (d == 0 || d > SIZE_MAX / 8 / sizeof(double))
        FVI_FAIL("d must be at least 1 and addressable", FVI_EINVAL);
    if (!(beta >= 0 && beta <= 2))
        FVI_FAIL("beta must be in [0, 2]", FVI_EDOM);
    if (!(tolerance >= 0 && tolerance < 1))
        FVI_FAIL("tolerance must be in [0, 1)", FVI_EDOM);
    *m = (fvi_history){ .order = order_of(beta),
                       .on_increments = beta >= 1,
                       .by_order = by_order,
                       .d = d,
                       .steps = steps };
    m->kind = kind != FVI_HISTORY_AUTO ? kind
              : by_order ? fvi_history_choose(0.5, steps) /* no beta is local */
                      : fvi_history_choose(beta, steps);
    if (needs_no_past(m)) {
        *bytes = d * sizeof(double);
    } else if (m->kind == FVI_HISTORY_DIRECT) {
        *bytes = fvi_history_direct_bytes(d, steps);
    } else {
        if (steps > FVI_LONGEST)
            FVI_FAIL("the compressed memory reaches back 10^9 steps at most",
                     FVI_EINVAL);
        if (tolerance != 0 && tolerance < FVI_LEAST_TOLERANCE)
            FVI_FAIL("the compressed memory keeps tolerances from 1e-14 on",
                     FVI_ETOL);
        m->nodes = fvi_history_modes_plan(
            m->order, steps, fvi_history_modes_delta(steps, tolerance));
        *bytes = fvi_history_modes_bytes(&m->nodes, by_order, d);
    }
    if (*bytes > SIZE_MAX - sizeof *m)
        FVI_FAIL("so many steps cannot be addressed", FVI_EINVAL);
    *bytes += sizeof *m;
    return FVI_SUCCESS;
}

size_t fvi_history_bytes(double beta, size_t d, size_t steps,
                        fvi_history_kind kind, double tolerance)
{
    fvi_history m;
    size_t bytes;
    return plan(beta, 0, d, steps, kind, tolerance, &m, &bytes) ? 0 : bytes;
}

static int alloc_kind(fvi_history *m)
{
    if (needs_no_past(m)) {
        m->last = calloc(m->d, sizeof *m->last);
        return m->last != NULL;
    }
    if (m->kind == FVI_HISTORY_DIRECT)
        return (m->direct =
                    fvi_history_direct_alloc(m->order, m->by_order, m->d, m->steps))
               != NULL;
    m->exponentials =
        fvi_history_modes_alloc(&m->nodes, m->order, m->by_order, m->d, m->steps);
    return m->exponentials != NULL;
}

static int alloc(double beta, int by_order, size_t d, size_t steps,
                 fvi_history_kind kind, double tolerance, fvi_history **memory)
{
    if (!memory)
        FVI_FAIL("memory is a null pointer", FVI_EFAULT);
    fvi_history m;
    size_t bytes;
    int status = plan(beta, by_order, d, steps, kind, tolerance, &m, &bytes);
    if (status)
        return status;
    fvi_history *out = malloc(sizeof *out);
    if (out)
        *out = m;
    if (!out || !alloc_kind(out)) {
        fvi_history_free(out);
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    }
    *memory = out;
    return FVI_SUCCESS;
}

int fvi_history_alloc(double beta, size_t d, size_t steps, fvi_history_kind kind,
                     double tolerance, fvi_history **memory)
{
    return alloc(beta, 0, d, steps, kind, tolerance, memory);
}

int fvi_history_alloc_by_order(double beta, size_t d, size_t steps,
                          fvi_history_kind kind, double tolerance,
                          fvi_history **memory)
{
    return alloc(beta, 1, d, steps, kind, tolerance, memory);
}

int fvi_history_of_weights(int increments, size_t d, size_t steps, double *weights,
                  fvi_history_modes *e, fvi_history **memory)
{
    fvi_history *m = malloc(sizeof *m);
    fvi_history_direct *direct = weights ? fvi_history_direct_of(d, steps, weights) : NULL;
    if (!m || !direct == !e) {
        free(m);
        fvi_history_direct_free(direct);
        fvi_history_modes_free(e);
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    }
    *m = (fvi_history){ .order = NAN,
                       .on_increments = increments,
                       .d = d,
                       .steps = steps,
                       .direct = direct,
                       .exponentials = e };
    *memory = m;
    return FVI_SUCCESS;
}

int fvi_history_copy(const fvi_history *from, fvi_history **to)
{
    if (!from || !to)
        FVI_FAIL("null pointer", FVI_EFAULT);
    fvi_history *m = malloc(sizeof *m);
    if (!m)
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    *m = *from;
    m->last = from->last ? malloc(m->d * sizeof *m->last) : NULL;
    if (m->last)
        memcpy(m->last, from->last, m->d * sizeof *m->last);
    m->direct = from->direct ? fvi_history_direct_copy(from->direct) : NULL;
    m->exponentials =
        from->exponentials ? fvi_history_modes_copy(from->exponentials) : NULL;
    const int all = !from->last == !m->last && !from->direct == !m->direct
                    && !from->exponentials == !m->exponentials;
    if (!all) {
        fvi_history_free(m);
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    }
    *to = m;
    return FVI_SUCCESS;
}

int fvi_history_archive(fvi_history *m, fvi_archive *v)
{
    if (!m || !v)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = v->serialize(v, &m->order, sizeof m->order, 1);
    if (!status)
        status = v->serialize(v, &m->kind, sizeof m->kind, 1);
    if (!status)
        status = v->serialize(v, &m->k, sizeof m->k, 0);
    if (status)
        return status;
    if (m->k > m->steps + 1)
        FVI_FAIL("more terms than there is room for", FVI_EINVAL);
    if (m->last)
        status = v->serialize(v, m->last, m->d * sizeof *m->last, 0);
    if (!status && m->direct)
        status = fvi_history_direct_archive(m->direct, m->k, v);
    return status || !m->exponentials
               ? status
               : fvi_history_modes_archive(m->exponentials, m->k, v);
}

void fvi_history_free(fvi_history *m)
{
    if (!m)
        return;
    free(m->last);
    fvi_history_direct_free(m->direct);
    fvi_history_modes_free(m->exponentials);
    free(m);
}

static void push_local(fvi_history *m, const double *term, double *H)
{
    for (size_t i = 0; i < m->d; i++) { /* weights 1, or 1 and -1 */
        double new = term[i];
        H[i] = m->order == 0 ? new : new - m->last[i];
        m->last[i] = new;
    }
}

//> push
int fvi_history_push(fvi_history *m, const double *x, const double *dx, double *H)
{
    if (!m || !x || !dx || !H)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (m->k > m->steps)
        FVI_FAIL("more terms than were announced", FVI_EINVAL);
    const double *term = m->on_increments ? dx : x; /* (12.2) */
    if (m->exponentials)
        fvi_history_modes_push(m->exponentials, term, H);
    else if (m->last)
        push_local(m, term, H);
    else
        fvi_history_direct_push(m->direct, term, H);
    m->k++;
    return FVI_SUCCESS;
}
//< push

int fvi_history_sums_increments(const fvi_history *m)
{
    return m->on_increments;
}

size_t fvi_history_terms(const fvi_history *m)
{
    return m->k;
}

int fvi_history_takes_parts(const fvi_history *m)
{
#if defined(_OPENMP)
    return (void)m, 0;
#else
    return m->exponentials && fvi_history_modes_tiles(m->exponentials);
#endif
}

int fvi_history_push_part(fvi_history *m, size_t first, size_t count,
                         const double *x, const double *dx, double *H)
{
    if (m->k > m->steps)
        FVI_FAIL("more terms than were announced", FVI_EINVAL);
    fvi_history_tiled_push_part(fvi_history_modes_tiles(m->exponentials), first, count,
                        m->on_increments ? dx : x, H);
    m->k += first + count == m->d;
    return FVI_SUCCESS;
}

int fvi_history_push_by_order(fvi_history *m, const double *x, const double *dx,
                         double *H, double *rate)
{
    if (!m || !x || !dx || !H || !rate)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!m->by_order)
        FVI_FAIL("this memory was not made for its rate", FVI_EUNSUP);
    if (m->k > m->steps)
        FVI_FAIL("more terms than were announced", FVI_EINVAL);
    const double *term = m->on_increments ? dx : x; /* d beta = d(beta - 1) */
    if (m->exponentials)
        fvi_history_modes_push_by_order(m->exponentials, term, H, rate);
    else
        fvi_history_direct_push_by_order(m->direct, term, H, rate);
    m->k++;
    return FVI_SUCCESS;
}

//> ahead
int fvi_history_ahead(const fvi_history *m, const double *x, double *ahead)
{
    if (!m || !x || !ahead)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (m->k > m->steps)
        FVI_FAIL("more terms than were announced", FVI_EINVAL);
    for (size_t i = 0; i < m->d; i++) {
        ahead[i] = m->on_increments ? 0 : x[i]; /* w_0 x_{k+1}, no increment */
        if (m->last)
            ahead[i] -= m->order == 0 ? 0 : m->last[i];
    }
    if (m->direct)
        fvi_history_direct_ahead(m->direct, ahead);
    if (m->exponentials)
        fvi_history_modes_ahead(m->exponentials, ahead);
    return FVI_SUCCESS;
}
//< ahead
