/* src/memory/variable_table.c -- a(mu) of many modes.                 [Chapter 22] */
#include "variable_table.h"

#include "memory_kinds.h" /* FVI_VECTORS */

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

//> row
FVI_VECTORS static void make_row(const fvi_variable_rule *rule, size_t n,
                                 const double *restrict mu, double *restrict p,
                                 double *restrict a)
{
    const size_t s = rule->s;
    for (size_t q = 0; q < n; q += FVI_LANES) {
        const double *m = mu + q;
        double det[FVI_LANES], sum[FVI_LANES] = { 0 };
        for (size_t l = 0; l < FVI_LANES; l++)
            det[l] = m[l] + rule->det[s - 1];
        for (size_t k = s - 1; k-- > 0;)
            for (size_t l = 0; l < FVI_LANES; l++)
                det[l] = det[l] * m[l] + rule->det[k];
        for (size_t i = 0; i < s; i++) {
            double top[FVI_LANES];
            for (size_t l = 0; l < FVI_LANES; l++)
                top[l] = rule->numerator[i][s - 1];
            for (size_t k = s - 1; k-- > 0;)
                for (size_t l = 0; l < FVI_LANES; l++)
                    top[l] = top[l] * m[l] + rule->numerator[i][k];
            for (size_t l = 0; l < FVI_LANES; l++) {
                a[i * n + q + l] = top[l] / det[l];
                sum[l] += rule->b[i] * a[i * n + q + l];
            }
        }
        for (size_t l = 0; l < FVI_LANES; l++)
            p[q + l] = m[l] * sum[l];
    }
}
//< row

void fvi_mode_row_make(const fvi_variable_rule *rule, size_t n,
                       const double *mu, double *p, double *a)
{
    make_row(rule, n, mu, p, a);
}

/* A table, its numbers behind it in the same block; NULL: no memory. */
static fvi_mode_row *make(const fvi_variable_rule *rule, size_t every)
{
    const size_t n = FVI_POINTS;
    fvi_mode_row *row =
        malloc(sizeof *row + (2 + rule->s) * n * sizeof(double));
    if (!row)
        return NULL;
    double *mu = (double *)(row + 1), *p = mu + n, *a = p + n;
    for (size_t i = 0; i < n; i++) {
        const size_t part = n / every, j = i % part * every + i / part;
        mu[i] = exp(fvi_variable_spacing() * ((double)j + FVI_FIRST));
    }
    fvi_mode_row_make(rule, n, mu, p, a);
    *row = (fvi_mode_row){ .mu = mu, .p = p, .a = a, .stride = n };
    return row;
}

const fvi_mode_row *fvi_mode_table(const fvi_variable_rule *rule, size_t every)
{
    static _Atomic(fvi_mode_row *) tables[2][FVI_LANES + 1];
    _Atomic(fvi_mode_row *) *place = &tables[every - 1][rule->s];
    fvi_mode_row *table = atomic_load(place);
    if (table)
        return table;
    fvi_mode_row *mine = make(rule, every);
    if (!mine || atomic_compare_exchange_strong(place, &table, mine))
        return mine;
    free(mine); /* another thread was faster: table is its now */
    return table;
}
