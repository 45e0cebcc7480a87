/* tests/convergence/series.h -- Duffing's motion from any past, as a series in two powers of
 * t: a reference from the equation, which no integrator of the library has touched. */
#ifndef SERIES_H
#define SERIES_H

#include <fvi/fvi.h>
#include "system/larger.h"

#include <math.h>
#include <string.h>

/* x'' + c x + g x^3 + rho D^{2 alpha}(x - zeta) = A cos(w t), m = 1. */
typedef struct {
    fvi_initial_history past;
    double alpha, rho, x0, v0, c, g, A, w;
} duffing;

/* x = sum of c_ij t^(i + j gamma), gamma = 2 - 2 alpha, as I^2 D^{2 alpha} = I^gamma sends
 * t^e to Gamma(e + 1) / Gamma(e + 1 + gamma) t^(e + gamma). Exponents up to ROWS: what is
 * left out is below (t / t_0)^ROWS, if the series converges to t_0. */
enum { ROWS = 72, COLS = 360 };

typedef double table[ROWS][COLS];

typedef struct {
    double gamma;
    table c;
} series;

/* How many entries of row i have an exponent below `most`. */
static inline int columns(int i, double gamma, double most)
{
    return (int)larger(0, smaller(COLS, (most - i) / gamma));
}

/* Row i of the product of two series, from their rows up to i. */
static inline void row_of_product(int i, double gamma, table a, table b,
                                  table product)
{
    const int most = columns(i, gamma, ROWS);
    memset(product[i], 0, sizeof product[i]);
    for (int l = 0; l <= i; l++)
        for (int j = 0; j < most; j++)
            for (int k = 0; k < most - j; k++)
                product[i][j + k] += a[l][j] * b[i - l][k];
}

/* Does the memory act on t^(i + j gamma)? Held: not on the 1; Caputo: nor on the t, if
 * 2 alpha > 1; Riemann-Liouville: on all. */
static inline int is_in_history(const duffing *q, int i, int j)
{
    if (j > 0 || q->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
        return 1;
    return i > (q->past == FVI_INITIAL_HISTORY_CAPUTO && q->alpha > 0.5 ? 1 : 0);
}

/* Row i of c x + g x^3, from the rows of x up to i. */
static inline void row_of_gradient(const duffing *q, int i, table x,
                                   table gradient)
{
    static table square, cube;
    const double gamma = 2 - 2 * q->alpha;
    if (q->g != 0) {
        row_of_product(i, gamma, x, x, square);
        row_of_product(i, gamma, square, x, cube);
    }
    for (int j = 0; j < columns(i, gamma, ROWS); j++)
        gradient[i][j] = q->c * x[i][j] + (q->g != 0 ? q->g * cube[i][j] : 0);
}

/* All rows, one after the other: each coefficient from smaller exponents. */
static inline void expand(const duffing *q, series *x)
{
    static table gradient;
    const double gamma = 2 - 2 * q->alpha;
    x->gamma = gamma;
    memset(x->c, 0, sizeof x->c);
    x->c[0][0] = q->x0;
    x->c[1][0] = q->v0;
    double force = q->A; /* A cos(w t) = sum of these times t^i / i! */
    for (int i = 0; i < ROWS; i++) {
        double *row = x->c[i];
        for (int j = 0; j < columns(i, gamma, ROWS); j++) {
            const double e = i + j * gamma, before = e - gamma;
            if (i >= 2)
                row[j] -= gradient[i - 2][j] / (e * (e - 1));
            if (i >= 2 && i % 2 == 0 && j == 0) {
                row[0] += force / tgamma(e + 1);
                force *= -q->w * q->w;
            }
            if (j > 0 && is_in_history(q, i, j - 1))
                row[j] -=
                    q->rho * row[j - 1] * (tgamma(before + 1) / tgamma(e + 1));
        }
        row_of_gradient(q, i, x->c, gradient);
    }
}

/* x and x' at t >= 0, without terms whose t^e is below exp(-60). */
static inline void at(const series *x, double t, double *where, double *speed)
{
    const double s = pow(t, x->gamma),
                 most = t < 1 ? smaller(ROWS, 3 - 60 / log(t)) : ROWS;
    double v = 0;
    *where = 0;
    for (int i = (int)most; i-- > 0;) {
        double row_of_x = 0, row_of_v = 0;
        for (int j = columns(i, x->gamma, most); j-- > 0;) {
            row_of_x = row_of_x * s + x->c[i][j];
            row_of_v = row_of_v * s + (i + j * x->gamma) * x->c[i][j];
        }
        *where = *where * t + row_of_x;
        v = v * t + row_of_v; /* of t x' */
    }
    *speed = t > 0 ? v / t : x->c[1][0];
    if (t == 0)
        *where = x->c[0][0];
}

#endif
