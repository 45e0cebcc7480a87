/* src/memory/history_tiled.c -- Compute the histories of many coordinates in blocks of 32 steps.      [H 28] */
#include "history_tiled.h"
#include "history_kinds.h"

#include "system/archive_pieces.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- eight rows of a product, with vectors of 2, 4 or 8 doubles ---- */

typedef void product(size_t columns, size_t n, const double *table,
                     const double *in, const double *lose, double *out);

#define LANES 2
#define PRODUCT product_2
#define TARGET
#include "history_tiled_product.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define LANES 4
#define PRODUCT product_4
#define TARGET __attribute__((target("avx2")))
#include "history_tiled_product.h"

#define LANES 8
#define PRODUCT product_8
#define TARGET __attribute__((target("avx512f")))
#include "history_tiled_product.h"

/* Return NULL if this machine has no vectors of this width. */
static product *product_of(size_t lanes)
{
    switch (lanes) {
    case 8:
        return __builtin_cpu_supports("avx512f") ? product_8 : NULL;
    case 4:
        return __builtin_cpu_supports("avx2") ? product_4 : NULL;
    default:
        return lanes == 2 ? product_2 : NULL;
    }
}
#else
static product *product_of(size_t lanes)
{
    return lanes == 2 ? product_2 : NULL;
}
#endif

/* ---- the engine ---- */

enum {
    THREADS_FROM = 10000,           /* number of coordinates from which threads are used, if compiled with -fopenmp */
    AHEAD = 4,                      /* the rows of a tile are prefetched so many tiles ahead */
    AREA = FVI_EIGHT * FVI_TILE,    /* numbers in eight rows of a tile */
    SQUARE = FVI_EIGHT * FVI_EIGHT, /* numbers in a table of weights between two eights */
    FARTHEST = 2 * FVI_SLABS - 1    /* largest distance between two eights, in eights */
};

typedef struct {
    fvi_history_head head;
    size_t Q, tiles;
    product *times;
    double *w;               /* w_1, ..., w_63 at their lags */
    double *lags;            /* w_{8 D + r - j} for D = 7, ..., 1: (28.3) */
    double *far;             /* c_q e^{-s_q r}, r = 0, ..., 31, in eights of r: (28.1) */
    double *decay;           /* e^{-s_q (31 - j)} in eights of modes: (28.2) */
    double *lose;            /* 1 - e^{-32 s_q} */
    double *z;               /* Q modes of each coordinate, tile by tile */
    double *slab[FVI_SLABS]; /* eight rows for each tile: the terms so far, and the sums of the terms to come */
    _Alignas(64) double numbers[];
} tiled_engine;

/* Number of doubles in the tables, and in the state. */
static size_t count_table_numbers(size_t Q)
{
    return 2 * FVI_WINDOW + FARTHEST * SQUARE + 2 * FVI_WINDOW * Q + Q;
}

static size_t count_state_numbers(size_t d, size_t Q)
{
    return (d + FVI_TILE - 1) / FVI_TILE * FVI_TILE * (Q + FVI_WINDOW);
}

size_t fvi_history_tiled_bytes(size_t d, size_t Q)
{
    if (d > SIZE_MAX / sizeof(double) / 4 / (Q + FVI_WINDOW))
        return SIZE_MAX;
    return fvi_history_piece(sizeof(tiled_engine), count_table_numbers(Q) + count_state_numbers(d, Q));
}

static void set_array_pointers(fvi_history_head *head)
{
    tiled_engine *t = (tiled_engine *)head;
    t->w = t->numbers;
    t->lags = t->w + 2 * FVI_WINDOW;
    t->far = t->lags + FARTHEST * SQUARE;
    t->decay = t->far + FVI_WINDOW * t->Q;
    t->lose = t->decay + FVI_WINDOW * t->Q;
    t->z = t->lose + t->Q;
    for (size_t s = 0; s < FVI_SLABS; s++)
        t->slab[s] = t->z + t->tiles * (FVI_TILE * t->Q + s * AREA);
}

/* Return (1 - p)^n, with 0^0 = 1. */
static double power(double p, size_t n)
{
    return n == 0 ? 1 : exp((double)n * log1p(-p));
}

/* Return the table of the weights between two eights at distance D. The table of distance D - 1 follows it. */
static double *table_of_distance(const tiled_engine *t, size_t D)
{
    return t->lags + (FARTHEST - D) * SQUARE;
}

//> tables
/* Fill the tables. The weights from lag 33 on are computed from the modes, so that the sums over lags and the modes use
 * the same weights. */
static void fill_tables(tiled_engine *t, const double *p, const double *c)
{
    for (size_t q = 0; q < t->Q; q++) {
        double *decay = t->decay + (q / FVI_EIGHT * FVI_WINDOW) * FVI_EIGHT;
        for (size_t r = 0; r < FVI_WINDOW; r++) {
            const double left = power(p[q], r);
            double *far = t->far + (r / FVI_EIGHT * t->Q + q) * FVI_EIGHT;
            far[r % FVI_EIGHT] = c[q] * left;
            decay[(FVI_WINDOW - 1 - r) * FVI_EIGHT + q % FVI_EIGHT] = left;
            if (FVI_TAIL + r < 2 * FVI_WINDOW)
                t->w[FVI_TAIL + r] += c[q] * left;
        }
        t->lose[q] = p[q] < 1 ? -expm1(FVI_WINDOW * log1p(-p[q])) : 1;
    }
    for (size_t D = FARTHEST; D > 0; D--)
        for (size_t j = 0; j < FVI_EIGHT; j++)
            for (size_t r = 0; r < FVI_EIGHT; r++)
                table_of_distance(t, D)[j * FVI_EIGHT + r] = t->w[D * FVI_EIGHT + r - j];
}
//< tables

static const fvi_history_engine engine;

fvi_history_head *fvi_history_tiled_alloc(size_t d, size_t Q, const double *p,
                                          const double *c, const double *w)
{
    tiled_engine *t = fvi_history_make((fvi_history_head){
        .is = &engine, .bytes = fvi_history_tiled_bytes(d, Q), .d = d });
    if (!t)
        return NULL;
    t->Q = Q;
    t->tiles = (d + FVI_TILE - 1) / FVI_TILE;
    set_array_pointers(&t->head);
    for (size_t lanes = 8; !fvi_history_tiled_width(&t->head, lanes); lanes /= 2)
        ;
    memcpy(t->w + 1, w + 1, FVI_WINDOW * sizeof *w);
    fill_tables(t, p, c);
    return &t->head;
}

int fvi_history_tiled_width(fvi_history_head *head, size_t lanes)
{
    tiled_engine *t = (tiled_engine *)head;
    product *times = product_of(lanes);
    if (times)
        t->times = times;
    return times != NULL;
}

/* The weights and decay rates must be the same when a run goes on, so they are archived as constants. */
static int archive(fvi_history_head *head, fvi_archive *v)
{
    tiled_engine *t = (tiled_engine *)head;
    return FVI_SERIALIZE(v, FVI_CONSTANT(t->Q), FVI_CONSTANTS(t->w, 2 * FVI_WINDOW), FVI_CONSTANTS(t->lose, t->Q),
                         FVI_STATES(t->z, count_state_numbers(head->d, t->Q)));
}

/* ---- sums ---- */

static size_t columns(const tiled_engine *t, size_t tile)
{
    const size_t rest = t->head.d - tile * FVI_TILE;
    return rest < FVI_TILE ? rest : FVI_TILE;
}

/* Add to the eight rows of `to` the contribution of several consecutive eights of terms. The first of them is D eights
 * before `to`. */
static void add_earlier_eights(const tiled_engine *t, size_t count, size_t eights, size_t D,
                               const double *terms, double *to)
{
    static const double none[FVI_EIGHT] = { 0 };
    t->times(count, eights * FVI_EIGHT, table_of_distance(t, D), terms, none, to);
}

/* Prefetch `count` numbers of a later tile. */
static void prefetch_numbers(const double *from, size_t count)
{
    for (size_t i = 0; i < count; i += 8)
        __builtin_prefetch(from + i);
}

//> block
/* Finish a block of 32 terms. Compute the contribution of these terms and of the modes to the next 32 sums, then update
 * the modes. The sums take the places of the terms. */
static void open_block(tiled_engine *t, size_t tile)
{
    static const double none[FVI_EIGHT] = { 0 };
    const size_t count = columns(t, tile);
    double terms[FVI_SLABS * AREA], *z = t->z + tile * FVI_TILE * t->Q;
    for (size_t s = 0; s < FVI_SLABS; s++) {
        double *slab = t->slab[s] + tile * AREA;
        memcpy(terms + s * AREA, slab, AREA * sizeof *slab);
        memset(slab, 0, AREA * sizeof *slab);
    }
    for (size_t g = 0; g < FVI_SLABS; g++) { /* (28.1) */
        double *to = t->slab[g] + tile * AREA;
        t->times(count, t->Q, t->far + g * FVI_EIGHT * t->Q, z, none, to);
        add_earlier_eights(t, count, FVI_SLABS, FVI_SLABS + g, terms, to);
    }
    for (size_t q = 0; q < t->Q; q += FVI_EIGHT) { /* (28.2) */
        if (tile + 1 < t->tiles)
            prefetch_numbers(z + (t->Q + q) * FVI_TILE, AREA);
        t->times(count, FVI_WINDOW, t->decay + q * FVI_WINDOW, terms,
                 t->lose + q, z + q * FVI_TILE);
    }
}
//< block

//> eight
/* After every eighth term, add the contribution of the terms of this block to the next eight sums. */
static void open_eight(tiled_engine *t, size_t tile, size_t g)
{
    for (size_t s = 0; s < g; s++)
        add_earlier_eights(t, columns(t, tile), 1, g - s, t->slab[s] + tile * AREA,
                           t->slab[g] + tile * AREA);
}
//< eight

/* Compute row r of the sums: the terms of this eight so far, the oldest first, then the row that open_block and
 * open_eight have filled. */
FVI_VECTORS static void next_row(size_t r, const double *restrict w,
                                 const double *restrict rows,
                                 double *restrict sum)
{
    for (size_t i = 0; i < FVI_TILE; i++)
        sum[i] = 0;
    for (size_t j = 0; j < r; j++) {
#pragma GCC unroll 16
        for (size_t i = 0; i < FVI_TILE; i++)
            sum[i] += w[r - j] * rows[j * FVI_TILE + i];
    }
#pragma GCC unroll 16
    for (size_t i = 0; i < FVI_TILE; i++)
        sum[i] += rows[r * FVI_TILE + i];
}

//> push
static void push_part(fvi_history_head *head, size_t first, size_t count,
                      const double *term, double *H)
{
    tiled_engine *t = (tiled_engine *)head;
    const size_t k = head->k, r = k % FVI_EIGHT, g = k / FVI_EIGHT % FVI_SLABS;
    const size_t next = (k + 1) / FVI_EIGHT % FVI_SLABS;
#pragma omp parallel for schedule(static) if (count >= THREADS_FROM)
    for (size_t i = 0; i < count; i += FVI_TILE) {
        const size_t tile = (first + i) / FVI_TILE;
        double sum[FVI_TILE], *rows = t->slab[g] + tile * AREA;
        if (tile + AHEAD < t->tiles)
            prefetch_numbers(rows + AHEAD * AREA, (r + 1) * FVI_TILE);
        next_row(r, t->w, rows, sum);
        for (size_t j = 0; j < columns(t, tile); j++) {
            const double new = term[i + j];
            H[i + j] = new + sum[j];
            rows[r * FVI_TILE + j] = new;
        }
        if (r + 1 == FVI_EIGHT && next == 0)
            open_block(t, tile);
        else if (r + 1 == FVI_EIGHT)
            open_eight(t, tile, next);
    }
}
//< push

static void push(fvi_history_head *head, const double *term, double *H)
{
    push_part(head, 0, head->d, term, H);
}

static void ahead(const fvi_history_head *head, double *sum)
{
    const tiled_engine *t = (const tiled_engine *)head;
    const size_t r = head->k % FVI_EIGHT, g = head->k / FVI_EIGHT % FVI_SLABS;
    for (size_t tile = 0; tile < t->tiles; tile++) {
        double row[FVI_TILE];
        next_row(r, t->w, t->slab[g] + tile * AREA, row);
        for (size_t i = 0; i < columns(t, tile); i++)
            sum[tile * FVI_TILE + i] += row[i];
    }
}

static const fvi_history_engine engine = { .place = set_array_pointers,
                                           .push = push,
                                           .push_part = push_part,
                                           .ahead = ahead,
                                           .archive = archive };
