/* src/stages/variable_rule.c -- The constants of the Lobatto rules for variable steps.  [H 22] */
#include "variable_rule.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include <fvi/error.h>

#include <math.h>
#include <string.h>

#include "variable_rule_ref.h"

const fvi_variable_rule *fvi_variable(size_t s)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].s == s)
            return &rules[i];
    return NULL;
}

double fvi_variable_spacing(void)
{
    return FVI_SPACING;
}

void fvi_variable_powers(const fvi_variable_rule *rule, double beta, double *re,
                         double *im)
{
    for (size_t n = 0; n < rule->s / 2; n++) {
        const double size = exp(beta * rule->log_modulus[n]);
        re[n] = size * cos(beta * rule->angle[n]);
        im[n] = size * sin(beta * rule->angle[n]);
    }
}

//> present
FVI_VECTORS static void projectors(const fvi_variable_rule *rule,
                                   const double *power_re,
                                   const double *power_im, fvi_square *W)
{
    const size_t s = rule->s;
    for (size_t n = 0; n < s / 2; n++) {
        const double re = 2 * power_re[n], im = 2 * power_im[n];
        const fvi_four *v = (const fvi_four *)rule->re[n],
                       *w = (const fvi_four *)rule->im[n];
        for (size_t l = 0; l < s; l++) {
            const double vr = rule->b[l] * rule->re[n][s - 1 - l],
                         vi = rule->b[l] * rule->im[n][s - 1 - l],
                         x = re * vr - im * vi, y = re * vi + im * vr;
            fvi_four *column = (fvi_four *)W->column[l]; /* (22.2) */
            column[0] += x * v[0] - y * w[0];
            column[1] += x * v[1] - y * w[1];
        }
    }
}

void fvi_variable_function(const fvi_variable_rule *rule, const double *re,
                           const double *im, fvi_square *W)
{
    memset(W, 0, sizeof *W);
    projectors(rule, re, im, W);
}

void fvi_variable_present(const fvi_variable_rule *rule, double beta,
                          fvi_square *W)
{
    double power_re[FVI_LANES / 2], power_im[FVI_LANES / 2];
    fvi_variable_powers(rule, beta, power_re, power_im);
    fvi_variable_function(rule, power_re, power_im, W);
    for (size_t l = 0; beta == 0 && l < rule->s; l++) /* A^0 = 1 without rounding errors */
        for (size_t i = 0; i < rule->s; i++)
            W->column[l][i] = i == l;
}
//< present

void fvi_variable_present_by_order(const fvi_variable_rule *rule, double beta,
                               fvi_square *W)
{
    double power_re[FVI_LANES / 2], power_im[FVI_LANES / 2];
    fvi_variable_powers(rule, beta, power_re, power_im);
    for (size_t n = 0; n < rule->s / 2; n++) { /* multiply lambda^beta by ln lambda */
        const double re = power_re[n], im = power_im[n],
                     ln = rule->log_modulus[n], angle = rule->angle[n];
        power_re[n] = re * ln - im * angle;
        power_im[n] = re * angle + im * ln;
    }
    fvi_variable_function(rule, power_re, power_im, W);
}

size_t fvi_variable_apart(size_t every)
{
    return every == 1 ? 3 : 2;
}

void fvi_variable_spread(size_t every, const double *sum, double *c)
{
    for (size_t l = 0; l < FVI_ENDS; l++) {
        c[l] = 0;
        for (size_t n = 0; n < FVI_ENDS; n++)
            c[l] += ends[every - 1][l][n] * sum[n];
    }
}

void fvi_variable_ends(size_t every, double nu, double *c)
{
    const double L = FVI_SPACING * (double)every;
    double sum[FVI_ENDS]; /* sum_m r^{-m (nu + n)} */
    for (size_t n = 0; n < FVI_ENDS; n++)
        sum[n] = 1 / expm1(L * (nu + (double)n));
    fvi_variable_spread(every, sum, c);
}

/* A function that is compiled for several widths must be static, because otherwise the library would export it. */
FVI_VECTORS static void multiply_square(size_t s, const fvi_square *M, const double *in,
                                        double *out)
{
    fvi_four low = { 0 }, high = { 0 };
    for (size_t l = 0; l < s; l++) {
        const fvi_four *column = (const fvi_four *)M->column[l];
        low += column[0] * in[l];
        high += column[1] * in[l];
    }
    ((fvi_four *)out)[0] = low;
    ((fvi_four *)out)[1] = high;
}

void fvi_square_apply(size_t s, const fvi_square *M, const double *in,
                      double *out)
{
    multiply_square(s, M, in, out);
}

static void exchange(double *x, double *y, size_t n, size_t stride)
{
    for (size_t i = 0; i < n * stride; i += stride) {
        const double kept = x[i];
        x[i] = y[i];
        y[i] = kept;
    }
}

/* Invert by elimination. The code eliminates columns as if they were rows, which is correct because the inverse of the
 * transpose is the transpose of the inverse. */
FVI_VECTORS static int invert(size_t s, fvi_square *square)
{
    double(*M)[FVI_LANES] = square->column;
    size_t from[FVI_LANES];
    for (size_t k = 0; k < s; k++) {
        size_t p = k;
        for (size_t r = k + 1; r < s; r++)
            if (fabs(M[r][k]) > fabs(M[p][k]))
                p = r;
        if (!(fabs(M[p][k]) > 0))
            return FVI_ESING;
        from[k] = p;
        if (p != k)
            exchange(M[k], M[p], FVI_LANES, 1);
        /* M[k][k] is written last, because a vector load would have to wait for a single number */
        const double pivot = 1 / M[k][k];
        fvi_four *row = (fvi_four *)M[k];
        const fvi_four low = row[0] *= pivot, high = row[1] *= pivot;
        M[k][k] = pivot;
        for (size_t r = 0; r < s; r++) {
            if (r == k)
                continue;
            const double factor = M[r][k];
            row = (fvi_four *)M[r];
            row[0] -= factor * low;
            row[1] -= factor * high;
            M[r][k] = -factor * pivot;
        }
    }
    for (size_t k = s; k-- > 0;)
        if (from[k] != k)
            exchange(&M[0][k], &M[0][from[k]], s, FVI_LANES);
    return FVI_SUCCESS;
}

int fvi_square_invert(size_t s, fvi_square *M)
{
    return invert(s, M);
}
