/* src/stages/variable_table.c -- Compute a(mu) for many modes.                 [H 22] */
#include "variable_table.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

//> row
/* Compute sum_{k < n} c_k m^k for eight numbers m. */
static inline __attribute__((always_inline)) void
polynomial(size_t n, const double *c, const fvi_four *m, fvi_four *sum)
{
    sum[0] = sum[1] = (fvi_four){ 0 } + c[n - 1];
#pragma GCC unroll 8
    for (size_t k = n - 1; k-- > 0;) {
        sum[0] = sum[0] * m[0] + c[k];
        sum[1] = sum[1] * m[1] + c[k];
    }
}

static inline __attribute__((always_inline)) void
quotients(const size_t s, const fvi_variable_rule *rule, size_t n,
          const double *restrict mu, double *restrict p, double *restrict a)
{
    //> quotients
    for (size_t q = 0; q < n; q += FVI_LANES) {
        const fvi_four *m = (const fvi_four *)(mu + q);
        fvi_four by[2], sum[2] = { { 0 }, { 0 } };
        polynomial(s + 1, rule->det, m, by);
        by[0] = 1 / by[0]; /* one division serves all stages */
        by[1] = 1 / by[1];
        for (size_t i = 0; i < s; i++) {
            fvi_four *at = (fvi_four *)(a + i * n + q), top[2];
            polynomial(s, rule->numerator[i], m, top);
            at[0] = top[0] *= by[0];
            at[1] = top[1] *= by[1];
            sum[0] += rule->b[i] * top[0];
            sum[1] += rule->b[i] * top[1];
        }
        ((fvi_four *)(p + q))[0] = m[0] * sum[0];
        ((fvi_four *)(p + q))[1] = m[1] * sum[1];
    }
    //< quotients
}

FVI_VECTORS static void make_row(const fvi_variable_rule *rule, size_t n,
                                 const double *restrict mu, double *restrict p,
                                 double *restrict a)
{
    if (rule->s == 8)
        quotients(8, rule, n, mu, p, a);
    else
        quotients(6, rule, n, mu, p, a);
}
//< row

void fvi_mode_row_make(const fvi_variable_rule *rule, size_t n,
                       const double *mu, double *p, double *a)
{
    make_row(rule, n, mu, p, a);
}

/* Allocate a table, with its numbers behind it in the same block. Return NULL if memory is short. */
static fvi_mode_row *make_table(const fvi_variable_rule *rule, size_t every)
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
    fvi_mode_row *mine = make_table(rule, every);
    if (!mine || atomic_compare_exchange_strong(place, &table, mine))
        return mine;
    free(mine); /* another thread was faster, and `table` is its table now */
    return table;
}
