/* tests/exact_solution/exact_rows.h -- What the tests of all rows at once share. [H 11] */
#ifndef EXACT_ROWS_H
#define EXACT_ROWS_H

#include "exact_problems.h"
#include "system/larger.h"
#include "system/seeded.h"

#include <stdlib.h>

enum { MAX_POINTS = 64 };

static inline double chance(uint64_t *seed)
{
    return fvi_seeded_uniform(seed, 0, 1);
}

static inline double between(uint64_t *seed, double low, double high)
{
    return low * pow(high / low, chance(seed));
}

/* Rows against fvi_exact_at, whose own error is TOL: at most LOOKED_AT of them, the early ones
 * all, and the last. */
static inline void ck_assert_rows(const fvi_linear_oscillator *p, double h, size_t n,
                                  double tolerance, const char *what)
{
    double *x = malloc((n + 1) * sizeof *x), *v = malloc((n + 1) * sizeof *v);
    double t[MAX_POINTS], want_x[MAX_POINTS], want_v[MAX_POINTS], X = 0, V = 0;
    size_t row[MAX_POINTS], count = 0;
    ck_assert(x && v);
    for (size_t k = 0; k <= n && count < MAX_POINTS; count++) {
        row[count] = k;
        t[count] = (double)k * h;
        k = k < 24 ? k + 1 : k == n ? n + 1 : k + k / 4 < n ? k + k / 4 : n;
    }
    ck_assert_int_eq(fvi_exact_at(p, count, t, want_x, want_v,
                                  NULL), FVI_SUCCESS);
    ck_assert_int_eq(fvi_exact_grid(p, h, n, tolerance, x, v,
                                    NULL), FVI_SUCCESS);
    for (size_t k = 0; k <= n; k++) {
        X = larger(X, fabs(x[k]));
        V = larger(V, fabs(v[k]));
    }
    for (double now = (double)n * h; now > 1e-8 * (double)n * h; now /= 1.3) {
        double x_now, v_now; /* between the rows, and before the first */
        solve(p, now, &x_now, &v_now);
        X = larger(X, fabs(x_now));
        V = larger(V, fabs(v_now));
    }
    for (size_t i = 0; i < count; i++) {
        const size_t k = row[i];
        if (tolerance > 1e-12 && X > 0)
            seen(fabs(x[k] - want_x[i]) / (tolerance * X), "of the tolerance");
        if (tolerance == 0 && X > 0)
            seen(fabs(x[k] - want_x[i]) / X, "at tolerance 0");
        ck_assert_near(x[k], want_x[i], (tolerance + 2 * TOL) * X,
                       "%s: x, row %zu of %zu", what, k, n);
        ck_assert_near(v[k], want_v[i],
                       (tolerance + 2 * TOL) * (V + (k ? X / t[i] : 0)),
                       "%s: x', row %zu of %zu", what, k, n);
    }
    free(x);
    free(v);
}

#endif
