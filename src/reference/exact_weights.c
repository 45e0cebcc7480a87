/* src/reference/exact_weights.c -- Compute the weights of a problem on the nodes of a contour. [H 11] */
#include "exact_window.h"
#include "memory/history_kinds.h" /* for FVI_VECTORS */

#include <gsl/gsl_math.h>

/* Divide the weight of the rule by t^2 Q(z/t) / m = z^2 + C + D. The numbers are scaled by the largest of 1, C and R,
 * so that squares stay in range. D replaces z^beta. */
FVI_VECTORS static void divide_by_Q(const fvi_window *w)
{
    const double C = w->C, R = w->R, by = 1 / GSL_MAX_DBL(1, GSL_MAX_DBL(C, R));
#pragma omp simd
    for (size_t i = 0; i < w->count; i++) {
        const pair z = pair_at(&w->z, i), zz = product(z, z),
                   D = scaled(R, pair_at(&w->power, i)),
                   Q = { zz.re + C + D.re, zz.im + D.im },
                   q = product(pair_at(&w->weight, i), reciprocal(scaled(by, Q)));
        store_pair(&w->power, i, D);
        store_pair(&w->weight, i, scaled(by, q));
    }
}

/* Compute F times 1/z, or F times z / (z^2 + wt^2) for a cosine. */
FVI_VECTORS static void transform(const fvi_window *w, double F, int cosine,
                                  double wt, const fvi_parts *f)
{
#pragma omp simd
    for (size_t i = 0; i < w->count; i++) {
        const pair z = pair_at(&w->z, i), zz = product(z, z),
                   of_cosine = { zz.re + wt * wt, zz.im };
        store_pair(f, i,
                   scaled(F,
                          cosine ? product(z, reciprocal(of_cosine)) : reciprocal(z)));
    }
}

FVI_VECTORS static void multiply(size_t n, const fvi_parts *by,
                                 const fvi_parts *f)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        store_pair(f, i, product(pair_at(by, i), pair_at(f, i)));
}

/* Compute x and v, as add_integral of exact_inverse.c does, but without e^z. */
FVI_VECTORS static void weigh_nodes(const fvi_window *w, double x0, double v0,
                                    const fvi_parts *f)
{
    const double k0 = w->S->keeps_x0, k1 = w->S->keeps_v0, C = w->C,
                 by_t = 1 / w->unit;
#pragma omp simd
    for (size_t i = 0; i < w->count; i++) {
        const pair z = pair_at(&w->z, i), D = pair_at(&w->power, i), by_z = reciprocal(z),
                   q = pair_at(&w->weight, i), F = pair_at(f, i), Dz = product(D, by_z),
                   pushed = sum(z, scaled(k1, Dz)),
                   x = sum(scaled(x0, sum(z, scaled(k0, Dz))),
                           scaled(v0, product(pushed, by_z))),
                   held = { C + (1 - k0) * D.re, (1 - k0) * D.im },
                   v = sum(scaled(v0, pushed), scaled(-x0, held));
        store_pair(&w->x, i, product(q, sum(x, F)));
        store_pair(&w->v, i, scaled(by_t, product(q, sum(v, product(z, F)))));
    }
}

void fvi_window_weigh(fvi_window *w, const fvi_exact_source *source)
{
    const fvi_linear_oscillator *p = &w->S->p;
    const double t = w->unit,
                 F = p->forcing ? source->sign * p->A / p->m * t * t : 0;
    const int cosine = p->forcing == FVI_FORCING_COSINE;
    transform(w, F, cosine, cosine ? p->w * t : 0, &w->scratch);
    if (source->lasts > 0) { /* (11.19) */
        fvi_window_exp(w, w->count, source->lasts / t, 1, &w->x);
        multiply(w->count, &w->x, &w->scratch);
    }
    weigh_nodes(w, source->start * p->x0, source->start * p->v0 * t, &w->scratch);
}

void fvi_window_divide(fvi_window *w)
{
    divide_by_Q(w);
}
