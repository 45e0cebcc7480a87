/* src/stages/lobatto_weights.c -- Convolution quadrature on Lobatto nodes. [H 17] */
#include "lobatto_weights.h"
#include "variable_rule.h" /* fvi_four */

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"
#include "system/larger.h"
#include "system/lu.h"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_math.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- power series of s x s matrices, up to z^3 ---- */

enum { TERMS = FVI_LAGS + 1, HALF = FVI_STAGES / 2, ENTRIES = TERMS * FVI_STAGES * FVI_STAGES };

/* A power series. Entry (i, j) of the coefficient of z^n is at [n][i][j]. */
typedef struct {
    double w[TERMS][FVI_STAGES][FVI_STAGES];
} series;

/* Compute out = p x + q y. The entries beyond row s or column s are 0, so all entries can be summed side by side. */
FVI_VECTORS static void combine_series(double p, const series *x, double q, const series *y, series *out)
{
    const double *of_x = x->w[0][0], *of_y = y->w[0][0];
    double *to = out->w[0][0];
#pragma omp simd
    for (size_t i = 0; i < ENTRIES; i++)
        to[i] = p * of_x[i] + q * of_y[i];
}

#define FOUR(x) (*(fvi_four *)(x))

/* Compute out += sign x_l y_n for matrices of two series, with s <= 4 `fours`. The compiler knows `fours`. */
static inline __attribute__((always_inline)) void
add_rows(size_t s, size_t fours, double sign, const series *x, size_t l, const series *y, size_t n,
         double out[FVI_STAGES][FVI_STAGES])
{
    for (size_t i = 0; i < s; i++) {
        fvi_four sum[2] = { FOUR(out[i]), FOUR(out[i] + 4) };
        for (size_t k = 0; k < s; k++) {
            const double factor = sign * x->w[l][i][k];
            const double *row = y->w[n][k];
            sum[0] += factor * *(const fvi_four *)row;
            if (fours > 1)
                sum[1] += factor * *(const fvi_four *)(row + 4);
        }
        FOUR(out[i]) = sum[0];
        FOUR(out[i] + 4) = sum[1];
    }
}

static inline __attribute__((always_inline)) void
add_product(size_t s, double sign, const series *x, size_t l, const series *y, size_t n,
            double out[FVI_STAGES][FVI_STAGES])
{
    if (s > 4)
        add_rows(s, 2, sign, x, l, y, n, out);
    else
        add_rows(s, 1, sign, x, l, y, n, out);
}

FVI_VECTORS static series times_series(size_t s, const series *x, const series *y)
{
    series out = { 0 };
    for (size_t n = 0; n < TERMS; n++)
        for (size_t l = 0; l <= n; l++)
            add_product(s, 1, x, l, y, n - l, out.w[n]);
    return out;
}

static series identity(size_t s)
{
    series one = { 0 };
    for (size_t i = 0; i < s; i++)
        one.w[0][i][i] = 1;
    return one;
}

/* Compute the inverse series: y_0 = x_0^(-1), y_n = -y_0 (x_1 y_{n-1} + ... + x_n y_0). */
static series invert(size_t s, const series *x)
{
    series y = { 0 }, work = *x;
    size_t order[FVI_STAGES];
    gsl_permutation permutation = { s, order };
    gsl_matrix_view from =
        gsl_matrix_view_array_with_tda(work.w[0][0], s, s, FVI_STAGES);
    gsl_matrix_view to =
        gsl_matrix_view_array_with_tda(y.w[0][0], s, s, FVI_STAGES);
    fvi_lu_factorise(&from.matrix, &permutation);
    gsl_linalg_LU_invert(&from.matrix, &permutation, &to.matrix);
    for (size_t n = 1; n < TERMS; n++) {
        series sum = { 0 };
        for (size_t l = 1; l <= n; l++)
            add_product(s, 1, x, l, &y, n - l, sum.w[0]);
        add_product(s, -1, &y, 0, &sum, 0, y.w[n]);
    }
    return y;
}

/* Return the largest sum of |x| over a row, all coefficients together. */
static double norm(size_t s, const series *x)
{
    double largest = 0;
    for (size_t i = 0; i < s; i++) {
        double sum = 0;
        for (size_t n = 0; n < TERMS; n++)
            for (size_t j = 0; j < s; j++)
                sum += fabs(x->w[n][i][j]);
        largest = larger(largest, sum);
    }
    return largest;
}

//> root
/* Compute sqrt(x) by the iteration of Denman and Beavers: y converges to sqrt(x) and z to 1/sqrt(x), quadratically. */
static series root(size_t s, series *x)
{
    series y = *x, z = identity(s), change;
    for (int i = 0; i < 20; i++) {
        series inverse_y = invert(s, &y), inverse_z = invert(s, &z);
        combine_series(-0.5, &y, 0.5, &inverse_z, &change);
        combine_series(0.5, &y, 0.5, &inverse_z, &y);
        combine_series(0.5, &z, 0.5, &inverse_y, &z);
        if (norm(s, &change) <= 4 * GSL_DBL_EPSILON * norm(s, &y))
            break;
    }
    return y;
}
//< root

/* Return Delta(z). */
static series delta(size_t s)
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    series x = { 0 };
    for (size_t i = 0; i < s; i++)
        memcpy(x.w[0][i], rule->D[i], s * sizeof(double));
    x.w[0][0][0] += 1 / rule->b[0];     /* (17.3) */
    x.w[1][0][s - 1] = -1 / rule->b[0]; /* (17.5) */
    return x;
}

/* A deep root: Delta^(1/2^k) = 1 + E, so ln Delta = 2^k ln(1 + E). power[j] = E^j for j = 0, ..., BLOCK. */
enum { BLOCK = 6 };
typedef struct {
    series power[BLOCK + 1], logarithm;
    int k;
} deep_root;

//> near
/* Take square roots of Delta until E is small. Then compute the powers of E and the series of the logarithm. */
static deep_root make_root(size_t s)
{
    const series one = identity(s);
    series x = delta(s), E;
    deep_root r = { .k = 0 };
    for (; combine_series(1, &x, -1, &one, &E), norm(s, &E) > 0.25; r.k++)
        x = root(s, &x);
    r.power[0] = one;
    for (int j = 1; j <= BLOCK; j++)
        r.power[j] = times_series(s, &r.power[j - 1], &E);
    x = E;
    for (int j = 1; j <= 40; j++) {
        combine_series(1, &r.logarithm, ldexp(j % 2 ? 1. : -1., r.k) / j, &x,
                &r.logarithm);
        x = times_series(s, &x, &E);
    }
    return r;
}

/* Return the deep root of s stages, which is the same for all orders. It is made once in a process and kept by the
 * first thread. A thread that comes while the first one writes uses its own copy. */
static const deep_root *root_of(size_t s, deep_root *own)
{
    static deep_root kept[FVI_STAGES + 1];
    static atomic_int state[FVI_STAGES + 1];
    enum { NONE, WRITTEN, READY };
    if (atomic_load(&state[s]) == READY)
        return &kept[s];
    *own = make_root(s);
    int none = NONE;
    if (atomic_compare_exchange_strong(&state[s], &none, WRITTEN)) {
        kept[s] = *own;
        atomic_store(&state[s], READY);
    }
    return own;
}

/* Compute c_0 + c_1 E + ... + c_{BLOCK-1} E^(BLOCK-1). */
FVI_VECTORS static series add_powers(const deep_root *r, const double *c)
{
    series sum;
    double *to = sum.w[0][0];
    const double *power = r->power[0].w[0][0];
#pragma omp simd
    for (size_t i = 0; i < ENTRIES; i++)
        to[i] = c[0] * power[i];
    for (size_t l = 1; l < BLOCK; l++) {
        power = r->power[l].w[0][0];
#pragma omp simd
        for (size_t i = 0; i < ENTRIES; i++)
            to[i] += c[l] * power[i];
    }
    return sum;
}

/* Compute Delta(z)^beta by the binomial series of (1 + E)^beta and k squarings. The series has 42 terms; the error is
 * below 4^-41. The method of Paterson and Stockmeyer sums blocks of six terms and joins the seven blocks by Horner's
 * rule in E^6, so it needs six products. The derivative by beta, if wanted, is ln Delta times the result. */
static series power_of_delta(size_t s, double beta, series *rate)
{
    enum { BLOCKS = 7 };
    if (beta == 0 && !rate)
        return identity(s);
    deep_root own;
    const deep_root *r = root_of(s, &own);
    double c[BLOCKS * BLOCK] = { 1 };
    for (int j = 1; j < BLOCKS * BLOCK; j++)
        c[j] = c[j - 1] * (beta - (j - 1)) / j;
    series sum = add_powers(r, c + (BLOCKS - 1) * BLOCK);
    for (int i = BLOCKS - 2; i >= 0; i--) {
        const series block = add_powers(r, c + i * BLOCK);
        sum = times_series(s, &sum, &r->power[BLOCK]);
        combine_series(1, &sum, 1, &block, &sum);
    }
    for (int k = r->k; k > 0; k--)
        sum = times_series(s, &sum, &sum);
    if (rate)
        *rate = times_series(s, &r->logarithm, &sum);
    return sum;
}
//< near

//> fraction
/* Compute (Delta/h)^(2 alpha - 1) (1 + T (Delta/h)^(2 below))^(-1). All factors commute. */
void fvi_lobatto_near(size_t s, const fvi_kernel_simple *t, double h, double *W)
{
    const series one = identity(s);
    series top = power_of_delta(s, 2 * t->alpha - 1, NULL), bottom = delta(s), part;
    combine_series(pow(h, 1 - 2 * t->alpha), &top, 0, &one, &top);
    if (t->time > 0) {
        part = t->below == t->alpha ? top : power_of_delta(s, 2 * t->below - 1, NULL);
        if (t->below != t->alpha)
            combine_series(pow(h, 1 - 2 * t->below), &part, 0, &one, &part);
        bottom = times_series(s, &bottom, &part);
        combine_series(t->time / h, &bottom, 1, &one, &bottom);
        bottom = invert(s, &bottom);
        top = times_series(s, &top, &bottom);
    }
    for (size_t n = 0; n < TERMS; n++)
        for (size_t i = 0; i < s; i++)
            for (size_t j = 0; j < s; j++)
                *W++ += t->rho * top.w[n][i][j];
}
//< fraction

/* ---- the weights ---- */

#define TOLERANCE 1e-16 /* error of the sum over nodes in the stored weights */

enum { PIECE = 32 }; /* number of modes whose entries are gathered at a time */

/* Compute sum[i] += q_j a_j[i] back_j for `count` modes and the four rows i = 0, ..., 3 of `row`. The compiler knows
 * `fours`, the number of columns divided by four. */
static inline __attribute__((always_inline)) void
add_modes(size_t fours, size_t count, const double *q, const double *const *row,
          double back[PIECE][FVI_STAGES], double sum[HALF][FVI_STAGES])
{
    fvi_four part[HALF][2];
#pragma GCC unroll 4
    for (size_t i = 0; i < HALF; i++) {
        part[i][0] = FOUR(sum[i]);
        part[i][1] = FOUR(sum[i] + 4);
    }
    for (size_t j = 0; j < count; j++) {
        const fvi_four low = *(const fvi_four *)back[j], high = *(const fvi_four *)(back[j] + 4);
#pragma GCC unroll 4
        for (size_t i = 0; i < HALF; i++) {
            const double x = q[j] * row[i][j];
            part[i][0] += x * low;
            if (fours > 1)
                part[i][1] += x * high;
        }
    }
#pragma GCC unroll 4
    for (size_t i = 0; i < HALF; i++) {
        FOUR(sum[i]) = part[i][0];
        FOUR(sum[i] + 4) = part[i][1];
    }
}

/* Add at most PIECE modes, from mode `from` on. If there are fewer than 8 stages, the last row is repeated. */
FVI_VECTORS static void add_piece(size_t s, size_t Q, size_t from, const double *q, const double *a,
                                  double sum[FVI_STAGES][FVI_STAGES])
{
    const size_t count = Q - from < PIECE ? Q - from : PIECE;
    double back[PIECE][FVI_STAGES] = { { 0 } };
    const double *row[FVI_STAGES];
    for (size_t i = 0; i < FVI_STAGES; i++)
        row[i] = a + (i < s ? i : s - 1) * Q + from;
    for (size_t j = 0; j < count; j++)
        for (size_t l = 0; l < s; l++)
            back[j][l] = row[s - 1 - l][j];
    if (s <= HALF) {
        add_modes(1, count, q + from, row, back, sum);
        return;
    }
    add_modes(2, count, q + from, row, back, sum);
    add_modes(2, count, q + from, row + HALF, back, sum + HALF);
}

/* Compute W_n = sum_j q_j r_j^(n-1) a_j a~_j^T. Here q includes the powers of r. */
void fvi_lobatto_sum(size_t s, size_t Q, const double *q, const double *a,
                     double *W)
{
    const double *b = fvi_lobatto(s)->b;
    double sum[FVI_STAGES][FVI_STAGES] = { { 0 } };
    for (size_t from = 0; from < Q; from += PIECE)
        add_piece(s, Q, from, q, a, sum);
    for (size_t i = 0; i < s; i++)
        for (size_t l = 0; l < s; l++)
            W[i * s + l] = b[l] * sum[i][l];
}

/* Write matrix k. It comes from the series if k < TERMS, else from the modes. */
static void copy_or_sum(size_t s, size_t k, const series *first, size_t Q,
                        const double *q, const double *a, double *W)
{
    for (size_t i = 0; k < TERMS && i < s; i++)
        memcpy(W + i * s, first->w[k][i], s * sizeof *W);
    if (k >= TERMS)
        fvi_lobatto_sum(s, Q, q, a, W);
}

int fvi_lobatto_weights(size_t s, double beta, size_t n, double *W, double *rate)
{
    if (!W)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!fvi_lobatto(s))
        FVI_FAIL("the stages must be 2 to 8", FVI_EINVAL);
    if (n == 0 || n > SIZE_MAX / sizeof(double) / (s * s))
        FVI_FAIL("n must be at least 1 and addressable", FVI_EINVAL);
    if (!(beta >= -1 && beta <= 1))
        FVI_FAIL("beta must be in [-1, 1]", FVI_EDOM);
    const int by_order = rate != NULL;
    size_t Q = 0;
    if (n > TERMS) /* the series gives all matrices up to TERMS */
        Q = fvi_lobatto_nodes(s, beta, (double)n, TOLERANCE, by_order, NULL, NULL,
                              NULL, NULL, 0);
    double *q = calloc((3 + s) * Q + 1, sizeof *q);
    if (!q)
        FVI_FAIL("no memory for the nodes", FVI_ENOMEM);
    double *p = q + Q, *r = p + Q, *a = r + Q;
    if (Q > 0)
        fvi_lobatto_nodes(s, beta, (double)n, TOLERANCE, by_order, q, r, p, a, Q);
    series slope;
    const series first = power_of_delta(s, beta, by_order ? &slope : NULL);
    for (size_t k = 0; k < n; k++) {
        for (size_t j = 0; k >= 2 && j < Q; j++) {
            q[j] -= p[j] * q[j]; /* q_j r_j^(k-1) */
            r[j] -= p[j] * r[j];
        }
        copy_or_sum(s, k, &first, Q, q, a, W + k * s * s);
        if (by_order)
            copy_or_sum(s, k, &slope, Q, r, a, rate + k * s * s);
    }
    free(q);
    return FVI_SUCCESS;
}
