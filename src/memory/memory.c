/* src/memory/memory.c -- Compute the history of a fractional derivative, by the engine that suits it.       [H 12] */
#include <fvi/memory.h>

#include "history_kinds.h"
#include "history_parts.h"
#include "system/archive_pieces.h"
#include "system/fail.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Up to this number of steps the direct sum is faster, or slower by a few microseconds only, on the machine of
 * figures/memory/memory_bench.tsv. */
enum { FEW_STEPS = 256 };

struct fvi_history {
    double order;         /* order of the weights: beta, or beta - 1 on increments */
    fvi_node_range nodes; /* nodes of a compressed memory */
    int on_increments;
    fvi_history_kind kind; /* never FVI_HISTORY_AUTO */
    size_t steps;
    int by_order;             /* nonzero if dH/dbeta is wanted, too */
    fvi_history_head *engine; /* computes the sum; owned */
};

/* ---- engines ---- */

size_t fvi_history_piece(size_t bytes, size_t n)
{
    return n > (SIZE_MAX - bytes) / sizeof(double) - 64
               ? SIZE_MAX
               : (bytes + n * sizeof(double) + 63) / 64 * 64;
}

void *fvi_history_make(fvi_history_head of)
{
    fvi_history_head *m = of.bytes == SIZE_MAX ? NULL : aligned_alloc(64, of.bytes);
    if (!m)
        return NULL;
    memset(m, 0, of.bytes);
    *m = of;
    return m;
}

static fvi_history_head *copy_engine(const fvi_history_head *from)
{
    fvi_history_head *m = aligned_alloc(64, from->bytes);
    if (!m)
        return NULL;
    memcpy(m, from, from->bytes);
    m->is->place(m);
    return m;
}

/* An engine for the weights 1 (order 0) or 1 and -1 (order 1). It stores the last term only. */
typedef struct {
    fvi_history_head head;
    int subtracts;
    double *last;
    _Alignas(64) double numbers[];
} local_engine;

static void set_local_pointers(fvi_history_head *head)
{
    local_engine *m = (local_engine *)head;
    m->last = m->numbers;
}

static void push_local(fvi_history_head *head, const double *term, double *H)
{
    local_engine *m = (local_engine *)head;
    for (size_t i = 0; i < head->d; i++) {
        double new = term[i];
        H[i] = m->subtracts ? new - m->last[i] : new;
        m->last[i] = new;
    }
}

static void local_ahead(const fvi_history_head *head, double *sum)
{
    const local_engine *m = (const local_engine *)head;
    for (size_t i = 0; m->subtracts && i < head->d; i++)
        sum[i] -= m->last[i];
}

static int archive_local(fvi_history_head *head, fvi_archive *v)
{
    return v->serialize(v, ((local_engine *)head)->last, head->d * sizeof(double), 0);
}

static fvi_history_head *local_alloc(double order, size_t d)
{
    static const fvi_history_engine engine = { .place = set_local_pointers,
                                               .push = push_local,
                                               .ahead = local_ahead,
                                               .archive = archive_local };
    local_engine *m = fvi_history_make((fvi_history_head){
        .is = &engine, .bytes = fvi_history_piece(sizeof *m, d), .d = d });
    if (!m)
        return NULL;
    m->subtracts = order == 1;
    set_local_pointers(&m->head);
    return &m->head;
}

/* ---- choice of the engine ---- */

static int is_local(double order)
{
    return order == 0 || order == 1;
}

/* Return the order of the weights, (12.2). The difference has no rounding error. */
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

/* Return 1 if H needs at most the last term. */
static int needs_no_past(const fvi_history *m)
{
    return is_local(m->order) && !m->by_order;
}

/* Check the arguments, fill in *m, and compute the number of bytes. Nothing is allocated here. */
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
                       .steps = steps };
    m->kind = kind != FVI_HISTORY_AUTO ? kind
              /* the derivative by the order needs all terms for every beta */
              : by_order ? fvi_history_choose(0.5, steps)
                      : fvi_history_choose(beta, steps);
    if (needs_no_past(m)) {
        *bytes = fvi_history_piece(sizeof(local_engine), d);
    } else if (m->kind == FVI_HISTORY_DIRECT) {
        *bytes = fvi_history_direct_bytes(d, steps);
    } else {
        if (steps > FVI_LONGEST)
            FVI_FAIL("the compressed memory reaches back 10^9 steps at most", FVI_EINVAL);
        if (tolerance != 0 && tolerance < FVI_LEAST_TOLERANCE)
            FVI_FAIL("the compressed memory keeps tolerances from 1e-14 on", FVI_ETOL);
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

static fvi_history_head *alloc_engine(const fvi_history *m, size_t d)
{
    if (needs_no_past(m))
        return local_alloc(m->order, d);
    return m->kind == FVI_HISTORY_DIRECT
               ? fvi_history_direct_alloc(m->order, m->by_order, d, m->steps)
               : fvi_history_modes_alloc(&m->nodes, m->order, m->by_order, d, m->steps);
}

/* Make a history of an engine, and take over its ownership. */
static int make_history(fvi_history of, fvi_history_head *engine, fvi_history **memory)
{
    fvi_history *m = engine ? malloc(sizeof *m) : NULL;
    if (!m) {
        free(engine);
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    }
    *m = of;
    m->engine = engine;
    *memory = m;
    return FVI_SUCCESS;
}

static int alloc(double beta, int by_order, size_t d, size_t steps,
                 fvi_history_kind kind, double tolerance, fvi_history **memory)
{
    if (!memory)
        FVI_FAIL("memory is a null pointer", FVI_EFAULT);
    fvi_history m;
    size_t bytes;
    int status = plan(beta, by_order, d, steps, kind, tolerance, &m, &bytes);
    return status ? status : make_history(m, alloc_engine(&m, d), memory);
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

int fvi_history_of_engine(int increments, size_t steps, fvi_history_head *engine,
                          fvi_history **memory)
{
    return make_history((fvi_history){ .order = NAN, .on_increments = increments, .steps = steps },
                        engine, memory);
}

int fvi_history_copy(const fvi_history *from, fvi_history **to)
{
    if (!from || !to)
        FVI_FAIL("null pointer", FVI_EFAULT);
    return make_history(*from, copy_engine(from->engine), to);
}

int fvi_history_archive(fvi_history *m, fvi_archive *v)
{
    if (!m || !v)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const int status = FVI_SERIALIZE(v, FVI_CONSTANT(m->order), FVI_CONSTANT(m->kind), FVI_STATE(m->engine->k));
    if (status)
        return status;
    if (m->engine->k > m->steps + 1)
        FVI_FAIL("more terms than there is room for", FVI_EINVAL);
    return m->engine->is->archive(m->engine, v);
}

void fvi_history_free(fvi_history *m)
{
    if (m)
        free(m->engine);
    free(m);
}

//> push
int fvi_history_push(fvi_history *m, const double *x, const double *dx, double *H)
{
    if (!m || !x || !dx || !H)
        FVI_FAIL("null pointer", FVI_EFAULT);
    fvi_history_head *e = m->engine;
    if (e->k > m->steps)
        FVI_FAIL("more terms than were announced", FVI_EINVAL);
    fvi_history_take(e, m->on_increments ? dx : x, H); /* (12.2) */
    return FVI_SUCCESS;
}
//< push

int fvi_history_sums_increments(const fvi_history *m)
{
    return m->on_increments;
}

size_t fvi_history_terms(const fvi_history *m)
{
    return m->engine->k;
}

int fvi_history_takes_parts(const fvi_history *m)
{
#if defined(_OPENMP)
    return (void)m, 0;
#else
    return m->engine->is->push_part != NULL;
#endif
}

int fvi_history_push_part(fvi_history *m, size_t first, size_t count,
                         const double *x, const double *dx, double *H)
{
    fvi_history_head *e = m->engine;
    if (e->k > m->steps)
        FVI_FAIL("more terms than were announced", FVI_EINVAL);
    e->is->push_part(e, first, count, m->on_increments ? dx : x, H);
    e->k += first + count == e->d;
    return FVI_SUCCESS;
}

int fvi_history_push_by_order(fvi_history *m, const double *x, const double *dx,
                         double *H, double *rate)
{
    if (!m || !x || !dx || !H || !rate)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!m->by_order)
        FVI_FAIL("this memory was not made for its rate", FVI_EUNSUP);
    fvi_history_head *e = m->engine;
    if (e->k > m->steps)
        FVI_FAIL("more terms than were announced", FVI_EINVAL);
    /* the derivatives by beta and by beta - 1 are the same */
    e->is->push_by_order(e, m->on_increments ? dx : x, H, rate);
    e->k++;
    return FVI_SUCCESS;
}

//> ahead
int fvi_history_ahead(const fvi_history *m, const double *x, double *ahead)
{
    if (!m || !x || !ahead)
        FVI_FAIL("null pointer", FVI_EFAULT);
    const fvi_history_head *e = m->engine;
    if (e->k > m->steps)
        FVI_FAIL("more terms than were announced", FVI_EINVAL);
    for (size_t i = 0; i < e->d; i++)
        ahead[i] = m->on_increments ? 0 : x[i]; /* w_0 x_{k+1} with x_{k+1} = x_k; the increment of such a step is 0 */
    e->is->ahead(e, ahead);
    return FVI_SUCCESS;
}
//< ahead
