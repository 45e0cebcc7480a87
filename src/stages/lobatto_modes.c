/* src/stages/lobatto_modes.c -- The near lags and the modes of a memory on Lobatto nodes, a step on.
 *                                                               [H 17] */
#include "lobatto_weights.h"
#include "variable_rule.h" /* fvi_four */

#include "memory/history_kinds.h" /* FVI_VECTORS */

/* ---- near lags ---- */

/* add_near, where s is a number that the compiler knows. */
static inline __attribute__((always_inline)) void
add_columns(size_t s, size_t lags, size_t k, const double *W, const double *past, double *sum)
{
    double total[FVI_STAGES];
    size_t at = k % lags;
    for (size_t i = 0; i < s; i++)
        total[i] = sum[i];
    for (size_t n = 1; n <= lags && n <= k; n++) {
        at = (at > 0 ? at : lags) - 1; /* k - n, in the ring */
        const double *column = W + n * s * s, *v = past + at * s;
        for (size_t j = 0; j < s; j++, column += s)
#pragma omp simd
            for (size_t i = 0; i < s; i++)
                total[i] += column[i] * v[j];
    }
    for (size_t i = 0; i < s; i++)
        sum[i] = total[i];
}

FVI_VECTORS static void add_near(size_t s, size_t lags, size_t k, const double *W, const double *past,
                                 double *sum)
{
    switch (s) {
    case 2:
        add_columns(2, lags, k, W, past, sum);
        break;
    case 3:
        add_columns(3, lags, k, W, past, sum);
        break;
    case 4:
        add_columns(4, lags, k, W, past, sum);
        break;
    case 8:
        add_columns(8, lags, k, W, past, sum);
        break;
    default:
        add_columns(s, lags, k, W, past, sum);
    }
}

/* A function of its own, because clang 14 gives clones a name that no other file finds. */
void fvi_lobatto_add_near(size_t s, size_t lags, size_t k, const double *W, const double *past, double *sum)
{
    add_near(s, lags, k, W, past, sum);
}

/* ---- modes ---- */

enum { LANES = FVI_MODE_LANES, HALVES = LANES / 4 };

enum { FEW = 4 }; /* stages, for which there is a loop of their own */

#define FOUR(x) (*(const fvi_four *)(x))

/* All modes one step on: z += a~.v - p z, and H += sum_j q_j a_j z_j. Written for
 * s = 4; a rule of fewer stages repeats its last row with u = 0. The partial sums
 * make the digits independent of the width of the vectors. */
FVI_VECTORS static void advance_few(size_t s, size_t Q,
                                    const double *restrict q,
                                    const double *restrict p,
                                    const double *restrict a, const double *u,
                                    double *restrict z, double *H)
{
    const double *a1 = a + Q, *a2 = a + (s > 2 ? 2 : 1) * Q, *a3 = a + (s - 1) * Q;
    fvi_four sum[FEW][HALVES] = { { { 0 } } };
    for (size_t j = 0; j < Q; j += LANES) {
#pragma GCC unroll 2
        for (size_t l = 0; l < HALVES; l++) {
            const size_t at = j + 4 * l;
            //> modes
            const fvi_four x0 = FOUR(a + at), x1 = FOUR(a1 + at), x2 = FOUR(a2 + at),
                           x3 = FOUR(a3 + at), old = FOUR(z + at),
                           new = old + ((u[0] * x0 + u[1] * x1) + (u[2] * x2 + u[3] * x3)
                                        - FOUR(p + at) * old), /* (17.12) */
                           y = FOUR(q + at) * new;
            sum[0][l] += x0 * y;
            sum[1][l] += x1 * y;
            sum[2][l] += x2 * y;
            sum[3][l] += x3 * y;
            //< modes
            *(fvi_four *)(z + at) = new;
        }
    }
    for (size_t i = 0; i < s; i++)
        for (size_t l = 0; l < LANES; l++)
            H[i] += sum[i][l / 4][l % 4];
}

/* The same for s = 8, and 5, 6, 7 in its place. */
FVI_VECTORS static void advance_many(size_t s, size_t Q,
                                     const double *restrict q,
                                     const double *restrict p,
                                     const double *restrict a, const double *u,
                                     double *restrict z, double *H)
{
    const double *row[FVI_STAGES];
    double sum[FVI_STAGES][LANES] = { { 0 } };
    for (size_t i = 0; i < FVI_STAGES; i++)
        row[i] = a + (i < s ? i : s - 1) * Q;
    for (size_t j = 0; j < Q; j += LANES) {
        double in[LANES], y[LANES];
#pragma GCC unroll 8
        for (size_t l = 0; l < LANES; l++)
            in[l] = -p[j + l] * z[j + l];
#pragma GCC unroll 8
        for (size_t i = 0; i < FVI_STAGES; i++)
#pragma GCC unroll 8
            for (size_t l = 0; l < LANES; l++)
                in[l] += u[i] * row[i][j + l];
#pragma GCC unroll 8
        for (size_t l = 0; l < LANES; l++) {
            z[j + l] += in[l];
            y[l] = q[j + l] * z[j + l];
        }
#pragma GCC unroll 8
        for (size_t i = 0; i < FVI_STAGES; i++)
#pragma GCC unroll 8
            for (size_t l = 0; l < LANES; l++)
                sum[i][l] += row[i][j + l] * y[l];
    }
    for (size_t i = 0; i < s; i++)
        for (size_t l = 0; l < LANES; l++)
            H[i] += sum[i][l];
}

void fvi_lobatto_advance(size_t s, size_t Q, const double *q, const double *p,
                         const double *a, const double *u, double *z, double *H)
{
    (s > FEW ? advance_many : advance_few)(s, Q, q, p, a, u, z, H);
}
