/* src/stages/variable_loops.c -- The two loops over the modes of variable steps.        [H 22] */
#include "variable_loops.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */

/* Both loops are written for a constant s, so that the compiler unrolls the loops over the stages. Partial sum l takes
 * every fourth mode, from the l-th one on, on every machine. So no digit depends on the width of the vectors. */
#define AT(x, q) (*(const fvi_four *)((x) + (q)))

/* Write the sums of four vectors of four numbers to H. */
static inline __attribute__((always_inline)) void sum_lanes(const fvi_four *x,
                                                            double *H)
{
    const fvi_four a = x[0], b = x[1], c = x[2], d = x[3];
    *(fvi_four *)H = ((fvi_four){ a[0], b[0], c[0], d[0] }
                      + (fvi_four){ a[2], b[2], c[2], d[2] })
                     + ((fvi_four){ a[1], b[1], c[1], d[1] }
                        + (fvi_four){ a[3], b[3], c[3], d[3] });
}

//> history
static inline __attribute__((always_inline)) void
gather(const size_t s, size_t Q, const double *restrict weight,
       const double *restrict y, const fvi_mode_row *row, double *restrict H)
{
    fvi_four sum[FVI_LANES];
#pragma GCC unroll 8
    for (size_t i = 0; i < s; i++)
        sum[i] = (fvi_four){ 0 };
    for (size_t q = 0; q < Q; q += 4) {
        const fvi_four part = AT(weight, q) * AT(y, q); /* (22.10) */
#pragma GCC unroll 8
        for (size_t i = 0; i < s; i++)
            sum[i] += AT(row->a + i * row->stride, q) * part;
    }
#pragma GCC unroll 8
    for (size_t i = s; i < FVI_LANES; i++)
        sum[i] = (fvi_four){ 0 };
#pragma GCC unroll 2
    for (size_t i = 0; i < FVI_LANES; i += 4)
        sum_lanes(sum + i, H + i);
}
//< history

FVI_VECTORS static void gather_six(size_t Q, const double *restrict weight,
                                   const double *restrict y,
                                   const fvi_mode_row *row, double *restrict H)
{
    gather(6, Q, weight, y, row, H);
}

FVI_VECTORS static void gather_eight(size_t Q, const double *restrict weight,
                                     const double *restrict y,
                                     const fvi_mode_row *row,
                                     double *restrict H)
{
    gather(8, Q, weight, y, row, H);
}

void fvi_loop_gather(size_t s, size_t Q, const double *weight, const double *y,
                     const fvi_mode_row *row, double *H)
{
    (s == 8 ? gather_eight : gather_six)(Q, weight, y, row, H);
}

//> advance
static inline __attribute__((always_inline)) void
advance(const size_t s, size_t n, const fvi_mode_row *row,
        const fvi_last_step *last, double *restrict y)
{
    for (size_t q = 0; q < n; q += 4) {
        fvi_four sum = { 0 }, *z = (fvi_four *)(y + q);
#pragma GCC unroll 8
        for (size_t i = 0; i < s; i++)
            sum += AT(row->a + i * row->stride, q) * last->u[i];
        *z += (AT(row->mu, q) * sum + last->ds) /* (22.6), (22.7) */
              - AT(row->p, q) * *z;
    }
}
//< advance

FVI_VECTORS static void advance_modes(size_t s, size_t n, const fvi_mode_row *row,
                                      const fvi_last_step *last, double *restrict y)
{
    if (s == 8)
        advance(8, n, row, last, y);
    else
        advance(6, n, row, last, y);
}

void fvi_loop_advance(size_t s, size_t n, const fvi_mode_row *row,
                      const fvi_last_step *last, double *y)
{
    advance_modes(s, n, row, last, y);
}
