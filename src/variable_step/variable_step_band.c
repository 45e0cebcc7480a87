/* src/variable_step/variable_step_band.c -- Newton's correction for a Hessian with few diagonals. [H 22] */
#include "variable_step_band.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */

#include <stdint.h>
#include <stdlib.h>

enum {
    PAIRS = 4
}; /* eigenvalues side by side; with 6 stages the last one is idle */

/* Four complex numbers. They take as much room as the stages of a coordinate. */
typedef struct __attribute__((may_alias)) {
    fvi_four re, im;
} quad;

struct fvi_variable_step_band {
    size_t s, d, diagonals;
    quad lambda, power, inverse; /* lambda, lambda^beta, 1 / lambda */
    quad in[FVI_LANES];          /* w: maps stages to eigenvectors */
    double re[PAIRS][FVI_LANES], im[PAIRS][FVI_LANES]; /* 2 v: maps them back */
    quad *factor; /* of column j: 1 / D_j, then the entries below the diagonal */
    quad group[];  /* m lambda + damping_coeff lambda^beta of each group, and then the factors */
};

static inline quad multiply_quads(quad a, quad b)
{
    return (quad){ a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re };
}

/* Return 1 / z, or NaN if z is 0. A power of two is divided out of z, which changes no digit. Otherwise the square of a
 * damping of 1e160 would be infinite and the inverse 0, as if there were no damping. */
typedef long long bits __attribute__((vector_size(32), aligned(8), may_alias));
static inline __attribute__((always_inline)) quad inverse_of(quad z)
{
    const bits re = *(const bits *)&z.re & 0x7fffffffffffffff,
               im = *(const bits *)&z.im & 0x7fffffffffffffff;
    const bits power = (bits)((fvi_four)re + (fvi_four)im) & 0x7ff0000000000000;
    const fvi_four scale = 1 / (fvi_four)power;
    z = (quad){ scale * z.re, scale * z.im };
    const fvi_four size = z.re * z.re + z.im * z.im;
    return (quad){ scale * (z.re / size), scale * (-z.im / size) };
}

/* ---- one matrix for each eigenvalue ---- */

/* Factorise the complex symmetric matrices as L D L^T. */
//> factorise
FVI_VECTORS static void factorise(fvi_variable_step_band *o, const size_t *group_of,
                                  double hh, const double *H)
{
    const size_t n = o->diagonals;
    const quad scale = { hh * o->inverse.re, hh * o->inverse.im };
    for (size_t j = 0; j < o->d; j++) {
        quad *column = &o->factor[j * n];
        for (size_t k = 0; k < n && j + k < o->d; k++) {
            column[k].re = scale.re * H[j * n + k];
            column[k].im = scale.im * H[j * n + k];
        }
        column[0].re += o->group[group_of[j]].re;
        column[0].im += o->group[group_of[j]].im;
    }
    for (size_t j = 0; j < o->d; j++) {
        quad *column = &o->factor[j * n];
        const quad D = column[0] = inverse_of(column[0]);
        for (size_t k = 1; k < n && j + k < o->d; k++) {
            const quad below = multiply_quads(column[k], D);
            for (size_t l = k; l < n && j + l < o->d; l++) {
                const quad fill = multiply_quads(below, column[l]);
                quad *a = &o->factor[(j + k) * n + l - k];
                a->re -= fill.re;
                a->im -= fill.im;
            }
            column[k] = below;
        }
    }
}
//< factorise

/* ---- solutions ---- */

/* Map stages to eigenvectors, and substitute forwards by L. e_j replaces r_j. */
//> forwards
static inline __attribute__((always_inline)) void
substitute_forwards(const fvi_variable_step_band *o, double *r)
{
    const size_t n = o->diagonals;
    quad *e = (quad *)r;
    for (size_t j = 0; j < o->d; j++, r += FVI_LANES) {
        quad sum = { { 0 }, { 0 } };
        for (size_t i = 0; i < o->s; i++) {
            sum.re += o->in[i].re * r[i];
            sum.im += o->in[i].im * r[i];
        }
        for (size_t k = 1; k < n && k <= j; k++) {
            const quad more = multiply_quads(o->factor[(j - k) * n + k], e[j - k]);
            sum.re -= more.re;
            sum.im -= more.im;
        }
        e[j] = sum;
    }
}
//< forwards

/* Substitute backwards by D and L^T. */
static inline __attribute__((always_inline)) void
substitute_backwards(const fvi_variable_step_band *o, double *r)
{
    const size_t n = o->diagonals;
    quad *e = (quad *)r;
    for (size_t j = o->d; j-- > 0;) {
        quad sum = multiply_quads(o->factor[j * n], e[j]);
        for (size_t k = 1; k < n && j + k < o->d; k++) {
            const quad more = multiply_quads(o->factor[j * n + k], e[j + k]);
            sum.re -= more.re;
            sum.im -= more.im;
        }
        e[j] = sum;
    }
}

/* Map eigenvectors back to stages. */
static inline __attribute__((always_inline)) void
stages_of_pairs(const fvi_variable_step_band *o, double *r)
{
    for (size_t j = 0; j < o->d; j++, r += FVI_LANES) {
        fvi_four low = { 0 }, high = { 0 };
        for (size_t n = 0; n < o->s / 2; n++) {
            const fvi_four *re = (const fvi_four *)o->re[n],
                           *im = (const fvi_four *)o->im[n];
            low += re[0] * r[n] - im[0] * r[PAIRS + n];
            high += re[1] * r[n] - im[1] * r[PAIRS + n];
        }
        ((fvi_four *)r)[0] = low;
        ((fvi_four *)r)[1] = high;
    }
}

void fvi_variable_step_band_group(fvi_variable_step_band *o, size_t group, double m,
                            double damping_coeff)
{
    o->group[group] = (quad){ m * o->lambda.re + damping_coeff * o->power.re,
                            m * o->lambda.im + damping_coeff * o->power.im };
}

void fvi_variable_step_band_factorise(fvi_variable_step_band *o, const size_t *group_of,
                                 double hh, const double *H)
{
    factorise(o, group_of, hh, H);
}

/* Do all three if the coordinates are not coupled, with s a constant. */
static inline __attribute__((always_inline)) void
one_by_one(const size_t s, const fvi_variable_step_band *o, double *r)
{
    for (size_t j = 0; j < o->d; j++, r += FVI_LANES) {
        quad e = { { 0 }, { 0 } };
#pragma GCC unroll 8
        for (size_t i = 0; i < s; i++) {
            e.re += o->in[i].re * r[i];
            e.im += o->in[i].im * r[i];
        }
        e = multiply_quads(o->factor[j], e);
        fvi_four low = { 0 }, high = { 0 };
#pragma GCC unroll 4
        for (size_t n = 0; n < s / 2; n++) {
            const fvi_four *re = (const fvi_four *)o->re[n],
                           *im = (const fvi_four *)o->im[n];
            low += re[0] * e.re[n] - im[0] * e.im[n];
            high += re[1] * e.re[n] - im[1] * e.im[n];
        }
        ((fvi_four *)r)[0] = low;
        ((fvi_four *)r)[1] = high;
    }
}

FVI_VECTORS static void solve(const fvi_variable_step_band *o, double *r)
{
    if (o->diagonals == 1 && o->s == 8) {
        one_by_one(8, o, r);
    } else if (o->diagonals == 1) {
        one_by_one(6, o, r);
    } else {
        substitute_forwards(o, r);
        substitute_backwards(o, r);
        stages_of_pairs(o, r);
    }
}

void fvi_variable_step_band_solve(fvi_variable_step_band *o, double *r)
{
    solve(o, r);
}

/* ---- memory ---- */

fvi_variable_step_band *fvi_variable_step_band_alloc(const fvi_variable_rule *rule,
                                           double beta, size_t d, size_t groups,
                                           size_t diagonals)
{
    if (d > SIZE_MAX / sizeof(quad) / (diagonals + 2))
        return NULL;
    fvi_variable_step_band *o =
        malloc(sizeof *o + (groups + d * diagonals) * sizeof *o->group);
    if (!o)
        return NULL;
    *o = (fvi_variable_step_band){ .s = rule->s, .d = d, .diagonals = diagonals };
    o->factor = o->group + groups;
    double power_re[PAIRS], power_im[PAIRS];
    fvi_variable_powers(rule, beta, power_re, power_im);
    for (size_t n = 0; n < PAIRS; n++) {
        const int idle = n >= rule->s / 2;
        const double re = idle ? 1 : rule->lambda_re[n],
                     im = idle ? 0 : rule->lambda_im[n],
                     size = re * re + im * im;
        o->lambda.re[n] = re;
        o->lambda.im[n] = im;
        o->power.re[n] = idle ? 1 : power_re[n];
        o->power.im[n] = idle ? 0 : power_im[n];
        o->inverse.re[n] = idle ? 0 : re / size;
        o->inverse.im[n] = idle ? 0 : -im / size;
        for (size_t i = 0; i < rule->s && !idle; i++) {
            o->in[i].re[n] = rule->b[i] * rule->re[n][rule->s - 1 - i];
            o->in[i].im[n] = rule->b[i] * rule->im[n][rule->s - 1 - i];
            o->re[n][i] = 2 * rule->re[n][i];
            o->im[n][i] = 2 * rule->im[n][i];
        }
    }
    return o;
}

void fvi_variable_step_band_free(fvi_variable_step_band *o)
{
    free(o);
}
