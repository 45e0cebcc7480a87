/* src/reference/exact_window.c -- Use one contour for many times.              [H 11] */
#include "exact_window.h"

#include "exact_vectors.h"
#include "kernel/kernel_terms.h"
#include "memory/history_kinds.h" /* for FVI_VECTORS */
#include "system/fail.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MU = 3;     /* the hyperbola crosses the real axis left of this */
static const double PHI = 1.35; /* largest phi, so that the hyperbola keeps its distance from the cut */
static const double GONE = -90; /* e^GONE counts as 0 */

/* Logarithms that are added to that of the tolerance: EDGES for the error of the rule, (11.17); CUT for how far below
 * the tolerance the contour is cut off. */
static const double EDGES = 5, CUT = 2;

/* ---- where the contour goes ---- */

/* (11.11): return phi of the hyperbola through z. The sum is that of the distances to its foci. */
static double hyperbola_through(double complex z)
{
    const double x = creal(z) / MU, y = cimag(z) / MU;
    return asin(2 * (1 - x) / (hypot(x, y) + hypot(x - 2, y)));
}

/* Return the middle of the widest part of (0, PHI) without a pole, and half its width in *room. k poles leave a part of
 * at least PHI / (k + 1). */
static double find_gap_between_poles(fvi_window *w, double *room)
{
    const size_t poles = w->S->poles;
    double phi[FVI_POLES], edge[FVI_POLES + 2] = { 0 }, middle = 0;
    for (size_t i = 0; i < poles; i++) {
        phi[i] = hyperbola_through(w->S->pole[i].s * w->unit);
        size_t j = i + 1; /* sorted by insertion */
        for (; j > 1 && edge[j - 1] > phi[i]; j--)
            edge[j] = edge[j - 1];
        edge[j] = GSL_MIN_DBL(GSL_MAX_DBL(phi[i], 0), PHI);
    }
    edge[poles + 1] = PHI;
    *room = 0;
    for (size_t j = 0; j <= poles; j++)
        if (edge[j + 1] - edge[j] > 2 * *room) {
            *room = (edge[j + 1] - edge[j]) / 2;
            middle = edge[j] + *room;
        }
    w->all_passed = 1;
    for (size_t i = 0; i < poles; i++) {
        w->passed[i] = phi[i] < middle;
        w->all_passed = w->all_passed && w->passed[i];
    }
    return middle;
}

/* ---- exponentials on the nodes ---- */

FVI_VECTORS static void scale(size_t n, double by, const fvi_parts *a)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        store_pair(a, i, scaled(by, pair_at(a, i)));
}

/* Compute e^{a z}, or e^{a z} - 1 if `less` is 1, for the first n nodes. */
static void exponentials_at_nodes(const fvi_window *w, size_t n, double a, int less,
                                  const fvi_parts *to)
{
    size_t here = n;
    while (here > 0 && a * w->z.re[here - 1] < GONE)
        here--;
    memcpy(to->re, w->z.re, here * sizeof *to->re);
    memcpy(to->im, w->z.im, here * sizeof *to->im);
    scale(here, a, to);
    (less ? fvi_vector_expm1 : fvi_vector_exp)(here, to->re, to->im);
    for (size_t i = here; i < n; i++)
        store_pair(to, i, (pair){ -less, 0 });
}

/* ---- the nodes ---- */

/* Compute z and h / pi dz/du from e^u. */
FVI_VECTORS static void find_nodes(size_t n, double h, double sine,
                                   double cosine, const double *restrict eu,
                                   double *restrict z_re,
                                   double *restrict z_im,
                                   double *restrict dz_re,
                                   double *restrict dz_im)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        const double ch = (eu[i] + 1 / eu[i]) / 2, sh = (eu[i] - 1 / eu[i]) / 2;
        z_re[i] = MU * (1 - sine * ch);
        z_im[i] = MU * (cosine * sh);
        dz_re[i] = -h / M_PI * MU * (sine * sh);
        dz_im[i] = h / M_PI * MU * (cosine * ch);
    }
}

static void prepare_nodes(fvi_window *w, double phi, double h)
{
    const fvi_inverse *S = w->S;
    double complex unused;
    for (size_t i = 0; i < w->count; i++) {
        w->scratch.re[i] = ((double)i + 0.5) * h;
        w->scratch.im[i] = 0;
    }
    fvi_vector_exp(w->count, w->scratch.re, w->scratch.im);
    find_nodes(w->count, h, sin(phi), cos(phi), w->scratch.re, w->z.re,
               w->z.im, w->weight.re, w->weight.im);
    for (size_t i = 0; i < w->count && S->p.law; i++) {
        const double complex C = fvi_kernel_at(
            S->p.law, (w->z.re[i] + I * w->z.im[i]) / w->unit, &unused);
        store_pair(&w->power, i, (pair){ creal(C), cimag(C) });
    }
    if (S->p.law)
        return;
    memcpy(w->power.re, w->z.re, w->count * sizeof *w->z.re);
    memcpy(w->power.im, w->z.im, w->count * sizeof *w->z.im);
    fvi_vector_log(w->count, w->power.re, w->power.im);
    scale(w->count, S->beta, &w->power);
    fvi_vector_exp(w->count, w->power.re, w->power.im);
}

/* Compute e^{z j h} for the rows of a block: rows j to 2 j - 1 from the rows below, by multiplication with e^{z j h}.
 * Its square replaces e^{z j h}. */
FVI_VECTORS static void step_rows(size_t n, size_t j, double *restrict re,
                                  double *restrict im, double *restrict steps)
{
    for (size_t i = 0; i < n; i++) {
        double *r = steps + 2 * FVI_BLOCK * i, *q = r + FVI_BLOCK;
        const double a = re[i], b = im[i];
#pragma omp simd
        for (size_t l = 0; l < j; l++) {
            r[l + j] = r[l] * a - q[l] * b;
            q[l + j] = r[l] * b + q[l] * a;
        }
        re[i] = a * a - b * b;
        im[i] = 2 * a * b;
    }
}

/* Compute e^{z j h} for the rows of a block. It needs e^{z j h} for j = 1, 2, 4, ...: squares of squares would
 * accumulate errors, so only every second one of these is a square, and the others are exponentials. */
static void prepare_steps(fvi_window *w, double h)
{
    for (size_t i = 0; i < w->count; i++) {
        w->steps[2 * FVI_BLOCK * i] = 1;
        w->steps[2 * FVI_BLOCK * i + FVI_BLOCK] = 0;
    }
    for (size_t j = 1; j < FVI_BLOCK; j *= 4) {
        exponentials_at_nodes(w, w->count, fmin((double)j * h / w->unit, 1), 0,
                              &w->scratch); /* no row is later than the unit */
        step_rows(w->count, j, w->scratch.re, w->scratch.im, w->steps);
        step_rows(w->count, 2 * j, w->scratch.re, w->scratch.im, w->steps);
    }
}

/* ---- the weights of a problem on the nodes ---- */

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

/* Compute x and v, the factors of a source at the nodes. */
static void weigh_source(fvi_window *w, const fvi_exact_source *source)
{
    const fvi_linear_oscillator *p = &w->S->p;
    const double t = w->unit,
                 F = p->forcing ? source->sign * p->A / p->m * t * t : 0;
    const int cosine = p->forcing == FVI_FORCING_COSINE;
    transform(w, F, cosine, cosine ? p->w * t : 0, &w->scratch);
    if (source->lasts > 0) { /* (11.19) */
        exponentials_at_nodes(w, w->count, source->lasts / t, 1, &w->x);
        multiply(w->count, &w->x, &w->scratch);
    }
    weigh_nodes(w, source->start * p->x0, source->start * p->v0 * t, &w->scratch);
}

/* ---- a window ---- */

static int prepare_memory(fvi_window *w, fvi_error *error)
{
    fvi_parts *parts[] = { &w->z,       &w->weight, &w->power,
                           &w->scratch, &w->x,      &w->v };
    const size_t arrays = sizeof parts / sizeof *parts, n = w->count;
    double *next = malloc(n * (2 * arrays + 2 * FVI_BLOCK) * sizeof *next);
    w->memory = next;
    if (!next)
        return fvi_fail(error, FVI_ENOMEM, NULL, NAN, "no memory for a contour");
    for (size_t i = 0; i < arrays; i++) {
        *parts[i] = (fvi_parts){ next, next + n };
        next += 2 * n;
    }
    w->steps = next;
    return FVI_SUCCESS;
}

/* Return t^2 Q(z/t) / m for z > 0, divided by its value at z = 1. A law counts as no damping. */
static double relative_symbol(const fvi_inverse *S, double t, double z)
{
    const fvi_linear_oscillator *p = &S->p;
    const double C = p->c / p->m * t * t,
                 R = p->law ? 0 : p->rho / p->m * pow(t, 2 - S->beta);
    return (z * z + C + R * pow(z, S->beta)) / (1 + C + R);
}

double fvi_window_growth(const fvi_inverse *S, double from, double to)
{
    const double z = to / from;
    return relative_symbol(S, to, z);
}

int fvi_window_open(const fvi_inverse *S, double first, double last, double h,
                    double tolerance, double grows, fvi_window *w,
                    fvi_error *error)
{
    const fvi_linear_oscillator *p = &S->p;
    const double wanted = -log(tolerance);
    double room;
    *w = (fvi_window){ .S = S, .unit = last, .folds = wanted + CUT };
    const double phi = find_gap_between_poles(w, &room);
    if (S->closed && w->all_passed)
        return FVI_SUCCESS;
    w->C = p->c / p->m * last * last;
    w->R = p->rho / p->m * (p->law ? last * last : pow(last, 2 - S->beta));
    const double edge = MU * (1 - sin(phi + room)),
                 excess = log(grows / relative_symbol(S, last, edge)),
                 step = 2 * M_PI * room / (wanted + EDGES + excess),
                 end = acosh((1 + last / first * w->folds / MU) / sin(phi));
    w->count = (size_t)ceil(end / step);
    const int status = prepare_memory(w, error);
    if (status)
        return status;
    prepare_nodes(w, phi, step);
    prepare_steps(w, h);
    divide_by_Q(w);
    return FVI_SUCCESS;
}

void fvi_window_close(fvi_window *w)
{
    free(w->memory);
}

/* ---- the rows ---- */

//> block
/* Set sums[j] to the imaginary part of the sum of c e e^{z j h} over the nodes. The small terms are added first. */
FVI_VECTORS static void
block_rows(size_t n, const double *restrict c_re, const double *restrict c_im,
           const double *restrict e_re, const double *restrict e_im,
           const double *restrict steps, double *restrict sums)
{
    double s[FVI_BLOCK] = { 0 };
    for (size_t i = n; i-- > 0;) {
        const double *r = steps + 2 * FVI_BLOCK * i, *q = r + FVI_BLOCK;
        const double re = c_re[i] * e_re[i] - c_im[i] * e_im[i],
                     im = c_re[i] * e_im[i] + c_im[i] * e_re[i];
#pragma omp simd
        for (size_t j = 0; j < FVI_BLOCK; j++)
            s[j] += re * q[j] + im * r[j];
    }
    for (size_t j = 0; j < FVI_BLOCK; j++)
        sums[j] = s[j];
}
//< block

static void add_to(double *x, size_t rows, size_t n, const fvi_window *w,
                   const fvi_parts *weight)
{
    double sums[FVI_BLOCK];
    if (!x)
        return;
    block_rows(n, weight->re, weight->im, w->scratch.re, w->scratch.im,
               w->steps, sums);
    for (size_t j = 0; j < rows; j++)
        x[j] += sums[j];
}

void fvi_window_add(fvi_window *w, const fvi_exact_source *source, double h,
                    size_t rows, double *x, double *v)
{
    size_t n = w->count;
    weigh_source(w, source);
    for (size_t k = 0; k < rows && n > 0 && !fvi_interrupted();
         k += FVI_BLOCK) {
        const double t = (source->t + (double)k * h) / w->unit;
        const size_t these = GSL_MIN(rows - k, FVI_BLOCK);
        while (n > 0 && w->z.re[n - 1] * t < -w->folds)
            n--;
        exponentials_at_nodes(w, n, t, 0, &w->scratch);
        add_to(x ? x + k : NULL, these, n, w, &w->x);
        add_to(v ? v + k : NULL, these, n, w, &w->v);
    }
}
