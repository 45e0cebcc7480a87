/* src/stages/lobatto_history.c -- Compute the history of a fractional derivative on Lobatto nodes.    [H 17] */
#include "lobatto_history.h"

#include "lobatto_kernel.h"
#include "memory/history_kinds.h" /* fvi_check_count */
#include "system/archive_pieces.h"
#include "system/fail.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A beta for the checks of a law, which has none. It stands for any beta that needs a history. */
#define BETA_OF_LAW (-0.5)

enum { LANES = FVI_MODE_LANES, MOST_DIRECT_STEPS = 64 /* largest number of steps that AUTO sums directly */ };

/* H_k = sum_n W_n v_{k-n} is summed in two parts. The last `lags` velocities stand in a ring, and their W_n are stored.
 * All earlier velocities are in the modes z, because for larger n (lobatto_weights.h)
 *
 *     W_n = sum_j q_j (1 - p_j)^(n-1) a_j a~_j^T */
struct fvi_lobatto_history {
    size_t s, d;       /* number of stages, number of coordinates */
    size_t steps, k;   /* largest number of v that may be pushed, and number of v so far */
    size_t lags;       /* number of W_n that are stored, without W_0 */
    size_t Q;          /* number of modes, rounded up to a multiple of LANES */
    double *q, *p, *a; /* of each mode; a has s rows of Q numbers. q includes the factor (1 - p)^FVI_LAGS */
    double *z;         /* Q modes for each coordinate */
    double *W;         /* W_0 row by row, and W_1, ..., W_lags column by column */
    double *past;      /* a ring of the last `lags` v of each coordinate */
    int by_order;      /* nonzero if there are derivatives by beta: */
    double *q_rate, *W_rate; /* the derivatives of q and of W by beta */
};

/* Return n, rounded up to a multiple of LANES. */
static size_t round_up_to_lanes(size_t n)
{
    return (n + LANES - 1) / LANES * LANES;
}

/* Return nonzero if the sums, or with by_order their derivatives by beta, need a history. For beta = 0 and beta = -1
 * the sums need none, but their derivatives do. */
static int has_history(double beta, int by_order)
{
    return by_order || (beta != 0 && beta != -1);
}

/* Return 1 if all W_n are stored, and 0 if modes represent most of them. */
static int is_direct(double beta, size_t steps, fvi_history_kind kind, int by_order)
{
    const int has_few_steps = kind == FVI_HISTORY_AUTO && steps <= MOST_DIRECT_STEPS;
    return (has_few_steps || kind == FVI_HISTORY_DIRECT) && has_history(beta, by_order);
}

static int check_arguments(size_t s, double beta, size_t d, size_t steps,
                           fvi_history_kind kind, int by_order, double tolerance)
{
    if (!fvi_lobatto(s))
        FVI_FAIL("the stages must be 2 to 8", FVI_EINVAL);
    if (d == 0 || kind < FVI_HISTORY_AUTO || kind > FVI_HISTORY_MODES)
        FVI_FAIL("d must be at least 1 and the kind known", FVI_EINVAL);
    if (!(beta >= -1 && beta <= 1))
        FVI_FAIL("beta must be in [-1, 1]", FVI_EDOM);
    if (!(tolerance >= 0 && tolerance < 1))
        FVI_FAIL("tolerance must be in [0, 1)", FVI_EDOM);
    const int direct = is_direct(beta, steps, kind, by_order);
    const size_t most_numbers = SIZE_MAX / sizeof(double) / 1024; /* 1024 > the numbers for each step and coordinate */
    if (d > most_numbers || (direct && steps > most_numbers / d))
        FVI_FAIL("steps and d must be addressable", FVI_EINVAL);
    if (!direct && has_history(beta, by_order) && tolerance > 0
        && tolerance < 1e-14)
        FVI_FAIL("no tolerance below 1e-14", FVI_ETOL);
    return FVI_SUCCESS;
}

/* Compute the number Q of modes and the number of stored W_n. The arguments have been checked. */
static void choose_sizes(size_t s, double beta, size_t steps, fvi_history_kind kind,
                         int by_order, double tolerance_used, size_t *Q, size_t *lags)
{
    const int direct = is_direct(beta, steps, kind, by_order);
    const double N = (double)steps + 1;
    *lags = direct ? steps : FVI_LAGS;
    *Q = 0;
    if (!direct && by_order)
        *Q = round_up_to_lanes(fvi_lobatto_nodes(s, beta, N, tolerance_used, 1, NULL, NULL, NULL, NULL, 0));
    else if (!direct)
        *Q = round_up_to_lanes(fvi_lobatto_few_nodes(s, beta, N, tolerance_used, NULL, NULL, NULL, 0));
}

/* Return the tolerance, or the default for 0. */
static double effective_tolerance(double tolerance)
{
    return tolerance >= 1e-14 ? tolerance : 1e-13;
}

double fvi_lobatto_history_bytes(size_t s, double beta, size_t d, size_t steps,
                                 fvi_history_kind kind, double tolerance)
{
    size_t Q, lags;
    if (check_arguments(s, beta, d, steps, kind, 0, tolerance))
        return 0;
    choose_sizes(s, beta, steps, kind, 0, effective_tolerance(tolerance), &Q, &lags);
    /* `ring` numbers for W_1, ..., W_lags and the last v; the other numbers for q, p, a, z and W_0 */
    const double ring = (double)lags * (double)(s * (s + d)),
                 rest = (double)(2 + s + d) * (double)Q + (double)(s * s);
    return sizeof(double) * LANES * ceil((ring + rest) / LANES) + sizeof(fvi_lobatto_history);
}

/* Return how many numbers all arrays of a history have together, rounded up. */
static size_t count_numbers(const fvi_lobatto_history *m)
{
    const size_t derivatives = m->by_order ? 1 : 0;
    return round_up_to_lanes((2 + m->s + m->d + derivatives) * m->Q
                  + (1 + derivatives) * (m->lags + 1) * m->s * m->s + m->lags * m->s * m->d);
}

/* Allocate a history of these sizes with all numbers zero. Return NULL if memory is short. The modes begin at a cache
 * line, because the loops read eight modes at once. */
static fvi_lobatto_history *make_history(fvi_lobatto_history sizes)
{
    fvi_lobatto_history *m = malloc(sizeof *m);
    const size_t bytes = count_numbers(&sizes) * sizeof(double);
    double *block = aligned_alloc(LANES * sizeof *block, bytes);
    if (!m || !block) {
        free(m);
        free(block);
        return NULL;
    }
    memset(block, 0, bytes);
    *m = sizes;
    m->q = block;
    m->p = m->q + m->Q;
    m->a = m->p + m->Q;
    m->z = m->a + m->s * m->Q;
    m->W = m->z + m->d * m->Q;
    m->past = m->W + (m->lags + 1) * m->s * m->s;
    m->q_rate = m->past + m->lags * m->s * m->d;
    m->W_rate = m->q_rate + m->Q;
    return m;
}

static void swap(double *x, double *y)
{
    const double kept = *x;
    *x = *y;
    *y = kept;
}

/* Transpose W_1, ..., W_lags, so that all rows of a sum are computed side by side. */
static void transpose_near_weights(fvi_lobatto_history *m)
{
    const size_t s = m->s;
    for (size_t n = 1; n <= m->lags; n++)
        for (size_t i = 0; i < s; i++)
            for (size_t j = 0; j < i; j++) {
                swap(&m->W[(n * s + i) * s + j], &m->W[(n * s + j) * s + i]);
                if (m->by_order)
                    swap(&m->W_rate[(n * s + i) * s + j], &m->W_rate[(n * s + j) * s + i]);
            }
}

/* Multiply q by (1 - p)^FVI_LAGS, because the modes begin at lag FVI_LAGS + 1. */
static void skip_near_lags(fvi_lobatto_history *m)
{
    for (size_t j = 0; j < m->Q; j++)
        for (size_t l = 0; l < FVI_LAGS; l++) {
            m->q[j] -= m->p[j] * m->q[j];
            if (m->by_order)
                m->q_rate[j] -= m->p[j] * m->q_rate[j];
        }
}

int fvi_lobatto_history_alloc(size_t s, double beta, size_t d, size_t steps,
                              fvi_history_kind kind, int by_order, double tolerance,
                              fvi_lobatto_history **memory)
{
    if (!memory)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = check_arguments(s, beta, d, steps, kind, by_order, tolerance);
    if (status)
        return status;
    const double tolerance_used = effective_tolerance(tolerance), N = (double)steps + 1;
    size_t Q, lags;
    choose_sizes(s, beta, steps, kind, by_order, tolerance_used, &Q, &lags);
    fvi_lobatto_history *m = make_history((fvi_lobatto_history){
        .s = s, .d = d, .steps = steps, .lags = lags, .Q = Q, .by_order = by_order });
    if (!m)
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    status = fvi_lobatto_weights(s, beta, lags + 1, m->W, by_order ? m->W_rate : NULL);
    if (status) {
        fvi_lobatto_history_free(m);
        return status;
    }
    transpose_near_weights(m);
    if (Q > 0 && by_order)
        fvi_lobatto_nodes(s, beta, N, tolerance_used, 1, m->q, m->q_rate, m->p, m->a, Q);
    else if (Q > 0)
        fvi_lobatto_few_nodes(s, beta, N, tolerance_used, m->q, m->p, m->a, Q);
    skip_near_lags(m);
    *memory = m;
    return FVI_SUCCESS;
}

/* Allocate a history for a law that has been prepared. */
static int allocate_for_law(size_t s, const fvi_lobatto_kernel *ready, size_t d, size_t steps,
                            fvi_history_kind kind, double tolerance,
                            fvi_lobatto_history **memory)
{
    if (!ready->has_nodes && kind == FVI_HISTORY_AUTO)
        kind = FVI_HISTORY_DIRECT;
    int status = check_arguments(s, BETA_OF_LAW, d, steps, kind, 0, tolerance);
    if (status)
        return status;
    if (!ready->has_nodes && kind == FVI_HISTORY_MODES)
        FVI_FAIL("there are no modes for this law", FVI_EUNSUP);
    const double N = (double)steps + 1, tolerance_used = effective_tolerance(tolerance);
    const int direct = is_direct(BETA_OF_LAW, steps, kind, 0);
    fvi_kernel_modes nodes = { 0 };
    if (!direct)
        status = fvi_lobatto_kernel_nodes(s, ready, N, tolerance_used, 1, &nodes);
    if (status)
        free(nodes.rate);
    if (status == FVI_EUNSUP)
        FVI_FAIL("there are no modes for this law", FVI_EUNSUP);
    if (status)
        return status;
    fvi_lobatto_history *m =
        make_history((fvi_lobatto_history){ .s = s,
                                            .d = d,
                                            .steps = steps,
                                            .lags = direct && steps > FVI_LAGS ? steps : FVI_LAGS,
                                            .Q = round_up_to_lanes(nodes.count) });
    if (m && nodes.count > 0) {
        memcpy(m->q, nodes.weight, nodes.count * sizeof *m->q);
        memcpy(m->p, nodes.rate, nodes.count * sizeof *m->p);
        fvi_lobatto_solve_nodes(s, nodes.count, m->p, m->a, m->Q);
    }
    free(nodes.rate);
    if (!m)
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    skip_near_lags(m);
    status = fvi_lobatto_kernel_weights(s, ready, m->lags + 1, m->W);
    if (status) {
        fvi_lobatto_history_free(m);
        return status;
    }
    transpose_near_weights(m);
    *memory = m;
    return FVI_SUCCESS;
}

int fvi_lobatto_history_of_kernel(size_t s, const fvi_kernel *law, double h, size_t d,
                                  size_t steps, fvi_history_kind kind,
                                  double tolerance, fvi_lobatto_history **memory)
{
    fvi_lobatto_kernel ready;
    int status = fvi_lobatto_kernel_prepare(s, law, h, &ready);
    if (status)
        return status;
    status = allocate_for_law(s, &ready, d, steps, kind, tolerance, memory);
    fvi_lobatto_kernel_free(&ready);
    return status;
}

int fvi_lobatto_history_copy(const fvi_lobatto_history *from,
                             fvi_lobatto_history **to)
{
    fvi_lobatto_history *m = make_history(*from);
    if (!m)
        FVI_FAIL("no memory for the history", FVI_ENOMEM);
    memcpy(m->q, from->q, count_numbers(m) * sizeof *m->q);
    *to = m;
    return FVI_SUCCESS;
}

/* The number of stored lags and the nodes may depend on the number of steps. They are archived as
 * constants, which must be equal. */
int fvi_lobatto_history_archive(fvi_lobatto_history *m, size_t k, fvi_archive *v)
{
    int status = FVI_SERIALIZE(v, FVI_CONSTANT(m->lags), FVI_CONSTANT(m->Q), FVI_CONSTANTS(m->q, (2 + m->s) * m->Q),
                               FVI_STATE(m->k));
    if (!status)
        status = fvi_check_count(m->k, k);
    return status ? status
                  : FVI_SERIALIZE(v, FVI_STATES(m->z, m->d * m->Q), FVI_STATES(m->past, m->lags * m->s * m->d));
}

void fvi_lobatto_history_free(fvi_lobatto_history *m)
{
    if (!m)
        return;
    free(m->q);
    free(m);
}

const double *fvi_lobatto_history_w0(const fvi_lobatto_history *m)
{
    return m->W;
}

const double *fvi_lobatto_history_w0_by_order(const fvi_lobatto_history *m)
{
    return m->W_rate;
}

//> push
int fvi_lobatto_history_push(fvi_lobatto_history *m, const double *v, double *H, double *Hdot)
{
    if (!m || !v || !H)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (Hdot && !m->by_order)
        FVI_FAIL("this memory has no rates", FVI_EUNSUP);
    if (m->k >= m->steps)
        FVI_FAIL("the memory is full", FVI_EINVAL);
    const size_t s = m->s, k = ++m->k, lags = m->lags;
    const double *b = fvi_lobatto(s)->b;
    for (size_t i = 0; i < m->d; i++, v += s, H += s) { /* for each coordinate */
        double *past = m->past + i * lags * s, *z = m->z + i * m->Q,
               *slot = past + (k - 1) % lags * s, u[FVI_STAGES] = { 0 },
               sum[FVI_STAGES] = { 0 };
        /* v_{k-1-lags} leaves the ring and enters the modes as u, its stages backwards, each times its weight. v_{k-1}
         * takes its place in the ring. */
        for (size_t l = 0; l < s; l++) {
            u[s - 1 - l] = b[l] * slot[l];
            slot[l] = v[l];
        }
        fvi_lobatto_add_near(s, lags, k, m->W, past, sum);
        if (m->Q > 0)
            fvi_lobatto_advance(s, m->Q, m->q, m->p, m->a, u, z, sum);
        memcpy(H, sum, s * sizeof *H);
        if (!Hdot)
            continue;
        memset(sum, 0, sizeof sum);
        fvi_lobatto_add_near(s, lags, k, m->W_rate, past, sum);
        fvi_lobatto_read_modes(s, m->Q, m->q_rate, m->a, z, sum);
        memcpy(Hdot + i * s, sum, s * sizeof *H);
    }
    return FVI_SUCCESS;
}
//< push
