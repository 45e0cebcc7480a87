/* src/stages/lobatto_modes.c -- Advance a history on Lobatto nodes by one step.  [H 17] */
#include "lobatto_weights.h"
#include "variable_rule.h" /* fvi_four */

#include "memory/history_kinds.h" /* FVI_VECTORS */

/* ---- near lags ---- */

/* Do the work of add_near. s is a constant that the compiler knows, except in the default case. */
static inline __attribute__((always_inline)) void
add_columns(size_t s, size_t lags, size_t k, const double *W, const double *past, double *sum)
{
    double total[FVI_STAGES];
    size_t at = k % lags;
    for (size_t i = 0; i < s; i++)
        total[i] = sum[i];
    for (size_t n = 1; n <= lags && n <= k; n++) {
        at = (at > 0 ? at : lags) - 1; /* the position of k - n in the ring */
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

/* This function is separate, because clang 14 gives the versions of add_near names that other files cannot find. */
void fvi_lobatto_add_near(size_t s, size_t lags, size_t k, const double *W, const double *past, double *sum)
{
    add_near(s, lags, k, W, past, sum);
}

/* ---- modes ---- */

enum { LANES = FVI_MODE_LANES, HALVES = LANES / 4 };

enum { MOST_UNROLLED_STAGES = 4 }; /* largest number of stages with a loop of its own */

#define FOUR(x) (*(const fvi_four *)(x))

/* Advance all modes, z += a~.v - p z, and add H += sum_j q_j a_j z_j. s is a constant that the compiler knows. The
 * order of the partial sums makes the digits independent of the width of the vectors. */
static inline __attribute__((always_inline)) void
advance_rows(size_t s, size_t Q, const double *restrict q, const double *restrict p,
             const double *restrict a, const double *u, double *restrict z, double *H)
{
    fvi_four sum[MOST_UNROLLED_STAGES][HALVES] = { { { 0 } } };
    for (size_t j = 0; j < Q; j += LANES) {
#pragma GCC unroll 2
        for (size_t l = 0; l < HALVES; l++) {
            const size_t at = j + 4 * l;
            //> modes
            const fvi_four old = FOUR(z + at);
            fvi_four in = u[0] * FOUR(a + at) + u[1] * FOUR(a + Q + at);
            if (s == 3)
                in += u[2] * FOUR(a + 2 * Q + at);
            if (s == 4)
                in += u[2] * FOUR(a + 2 * Q + at) + u[3] * FOUR(a + 3 * Q + at);
            const fvi_four new = old + (in - FOUR(p + at) * old), /* (17.12) */
                           y = FOUR(q + at) * new;
#pragma GCC unroll 4
            for (size_t i = 0; i < s; i++)
                sum[i][l] += FOUR(a + i * Q + at) * y;
            //< modes
            *(fvi_four *)(z + at) = new;
        }
    }
    for (size_t i = 0; i < s; i++)
        for (size_t l = 0; l < LANES; l++)
            H[i] += sum[i][l / 4][l % 4];
}

FVI_VECTORS static void advance_few(size_t s, size_t Q, const double *q, const double *p,
                                    const double *a, const double *u, double *z, double *H)
{
    switch (s) {
    case 2:
        advance_rows(2, Q, q, p, a, u, z, H);
        break;
    case 3:
        advance_rows(3, Q, q, p, a, u, z, H);
        break;
    default:
        advance_rows(4, Q, q, p, a, u, z, H);
    }
}

/* Do the same for 5 to 8 stages, in a loop over 8 stages. */
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

/* Compute H += sum_j q_j a_j z_j without changing the modes. `rows` is a constant that the compiler knows. For 5, 6 or
 * 7 stages it is 8, and the last row is repeated. */
static inline __attribute__((always_inline)) void
read_rows(size_t rows, size_t s, size_t Q, const double *restrict q, const double *restrict a,
          const double *restrict z, double *H)
{
    double part[FVI_STAGES][LANES];
    for (size_t l = 0; l < HALVES; l++) {
        fvi_four sum[FVI_STAGES] = { { 0 } };
        for (size_t at = 4 * l; at < Q; at += LANES) {
            const fvi_four y = FOUR(q + at) * FOUR(z + at);
#pragma GCC unroll 8
            for (size_t i = 0; i < rows; i++)
                sum[i] += FOUR(a + (i < s ? i : s - 1) * Q + at) * y;
        }
        for (size_t i = 0; i < s; i++)
            *(fvi_four *)(part[i] + 4 * l) = sum[i];
    }
    for (size_t i = 0; i < s; i++)
        for (size_t l = 0; l < LANES; l++)
            H[i] += part[i][l];
}

FVI_VECTORS static void read_modes(size_t s, size_t Q, const double *q, const double *a,
                                   const double *z, double *H)
{
    switch (s) {
    case 2:
        read_rows(2, 2, Q, q, a, z, H);
        break;
    case 3:
        read_rows(3, 3, Q, q, a, z, H);
        break;
    case 4:
        read_rows(4, 4, Q, q, a, z, H);
        break;
    default:
        read_rows(FVI_STAGES, s, Q, q, a, z, H);
    }
}

/* These functions are separate for the same reason as fvi_lobatto_add_near. */
void fvi_lobatto_advance(size_t s, size_t Q, const double *q, const double *p,
                         const double *a, const double *u, double *z, double *H)
{
    (s > MOST_UNROLLED_STAGES ? advance_many : advance_few)(s, Q, q, p, a, u, z, H);
}

void fvi_lobatto_read_modes(size_t s, size_t Q, const double *q, const double *a, const double *z,
                            double *H)
{
    read_modes(s, Q, q, a, z, H);
}
