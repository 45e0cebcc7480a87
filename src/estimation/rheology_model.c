/* src/estimation/rheology_model.c -- Compute what a test measures of a law.       [H 24] */
#include "rheology_model.h"

#include "kernel/laplace_parabola.h"
#include <fvi/error.h>
#include "system/dot.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- at which s ---- */

/* Times from t to FVI_PARABOLA_SPAN t share a parabola, in the order in which they stand. */
static void fill_parabolas(fvi_rheology *o)
{
    const fvi_material_data *d = o->data;
    fvi_parabola parabola = { 0 };
    double begin = INFINITY;
    for (size_t i = 0; i < d->n; i++) {
        const double t = d->at[i];
        if (!(t >= begin && t <= FVI_PARABOLA_SPAN * begin)) {
            fvi_parabola_make(begin = t, &parabola);
            memcpy(o->s + o->nodes, parabola.s, sizeof parabola.s);
            o->nodes += FVI_PARABOLA_NODES;
        }
        o->first[i] = o->nodes - FVI_PARABOLA_NODES;
        for (size_t j = 0; j < FVI_PARABOLA_NODES; j++)
            o->weight[i * FVI_PARABOLA_NODES + j] =
                d->load * parabola.weight[j] * cexp(parabola.s[j] * t) / parabola.s[j];
    }
}

static void fill_data(fvi_rheology *o)
{
    const fvi_material_data *d = o->data;
    const int both = d->test == FVI_MATERIAL_MODULI;
    for (size_t i = 0; i < d->n; i++) {
        const double size = both ? hypot(d->first[i], d->second[i]) : fabs(d->first[i]);
        o->unit[i] = d->unit ? d->unit[i] : size;
        o->y[i] = d->first[i] / o->unit[i];
        if (!both)
            continue;
        o->unit[d->n + i] = d->second_unit ? d->second_unit[i] : o->unit[i];
        o->y[d->n + i] = d->second[i] / o->unit[d->n + i];
        o->s[i] = I * d->at[i];
    }
    if (both)
        o->nodes = d->n;
    else
        fill_parabolas(o);
}

/* Set the box of the starts: orders from 0.02 to 0.48, exponents from 0.1 to 0.98, and times from a tenth of the data's
 * shortest to ten times their longest. Set the wider bounds of the search. */
static void fill_box(fvi_rheology *o)
{
    const fvi_material_data *d = o->data;
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < d->n; i++) {
        const double time = d->test == FVI_MATERIAL_MODULI ? -log(d->at[i]) : log(d->at[i]);
        low = smaller(low, time);
        high = larger(high, time);
    }
    low -= log(10);
    high += log(10);
    for (size_t n = 0; n < o->elements; n++) {
        fvi_kernel_range ranges[FVI_ELEMENT_SHAPE];
        const size_t count = fvi_element_shape(d->kind[n], ranges);
        o->at[n] = o->shapes;
        for (size_t k = 0; k < count; k++, o->shapes++) {
            const int is_order = ranges[k] == FVI_RANGE_ORDER, is_size = ranges[k] == FVI_RANGE_SIZE;
            const size_t j = o->shapes;
            o->begin[j] = is_order ? 0.02 : is_size ? low : 0.1;
            o->end[j] = is_order ? 0.48 : is_size ? high : 0.98;
            o->low[j] = is_size ? low - 9 : 1e-4;
            o->high[j] = is_order ? 0.49999 : is_size ? high + 9 : fvi_element_most(d->kind[n], k + 1);
            o->scale[j] = is_size ? 1 : 0.1;
        }
    }
    o->at[o->elements] = o->shapes;
}

int fvi_rheology_alloc(const fvi_material_data *d, fvi_rheology *o)
{
    const int both = d->test == FVI_MATERIAL_MODULI;
    const size_t n = d->n, nodes = both ? n : n * FVI_PARABOLA_NODES;
    *o = (fvi_rheology){ .data = d, .rows = both ? 2 * n : n, .elements = d->elements };
    fill_box(o);
    const size_t shapes = o->shapes, columns = o->rows * (o->elements + shapes),
                 complexes = nodes * (3 + 1 + o->elements + FVI_ELEMENT_SHAPE * o->elements);
    o->block = malloc(complexes * sizeof(double complex)
                      + (columns + 4 * o->rows) * sizeof(double) + n * sizeof(size_t));
    if (!o->block)
        return FVI_ENOMEM;
    o->s = o->block;
    o->log_s = o->s + nodes;
    o->weight = o->log_s + nodes;
    o->value = o->weight + nodes;
    o->phi = o->value + nodes;
    o->unit = (double *)(o->phi + nodes * (1 + FVI_ELEMENT_SHAPE) * o->elements);
    o->y = o->unit + o->rows;
    o->r = o->y + o->rows;
    o->trial = o->r + o->rows;
    o->columns = o->trial + o->rows;
    o->first = (size_t *)(o->columns + columns);
    fill_data(o);
    for (size_t i = 0; i < o->nodes; i++)
        o->log_s[i] = clog(o->s[i]);
    return FVI_SUCCESS;
}

void fvi_rheology_free(fvi_rheology *o)
{
    free(o->block);
}

/* ---- columns ---- */

/* Return the array of the shape of element n at all nodes (k = 0), or of its derivative by its number k - 1. */
static double complex *shape_of(const fvi_rheology *o, size_t n, size_t k)
{
    return o->phi + (n * (1 + FVI_ELEMENT_SHAPE) + k) * o->nodes;
}

static void fill_shapes(fvi_rheology *o, const double *u)
{
    for (size_t n = 0; n < o->elements; n++)
        for (size_t i = 0; i < o->nodes; i++) {
            double complex d[FVI_ELEMENT_SHAPE] = { 0 };
            fvi_element_at(o->data->kind[n], o->s[i], o->log_s[i], u + o->at[n], shape_of(o, n, 0) + i, d);
            for (size_t k = 0; k < FVI_ELEMENT_SHAPE; k++)
                shape_of(o, n, 1 + k)[i] = d[k];
        }
}

/* Compute what the test measures of a function of s, divided by the units and multiplied by `factor`. */
static void weigh_function(const fvi_rheology *o, const double complex *F, double factor, double *out)
{
    const size_t n = o->data->n;
    for (size_t i = 0; i < n; i++) {
        if (o->data->test == FVI_MATERIAL_MODULI) {
            out[i] = factor * creal(F[i]) / o->unit[i];
            out[n + i] = factor * cimag(F[i]) / o->unit[n + i];
            continue;
        }
        const double complex *w = o->weight + i * FVI_PARABOLA_NODES, *at = F + o->first[i];
        double sum = 0;
        for (size_t j = 0; j < FVI_PARABOLA_NODES; j++)
            sum += creal(w[j]) * creal(at[j]) - cimag(w[j]) * cimag(at[j]);
        out[i] = factor * sum / o->unit[i];
    }
}

double *fvi_rheology_column(const fvi_rheology *o, size_t j)
{
    return o->columns + j * o->rows;
}

/* Fill in the columns of the amplitudes and, if with_slopes, those of the numbers u for amplitudes 1. */
static void fill_columns(fvi_rheology *o, const double *u, int with_slopes)
{
    fill_shapes(o, u);
    for (size_t n = 0; n < o->elements; n++) {
        weigh_function(o, shape_of(o, n, 0), 1, fvi_rheology_column(o, n));
        for (size_t j = o->at[n]; with_slopes && j < o->at[n + 1]; j++)
            weigh_function(o, shape_of(o, n, 1 + j - o->at[n]), 1, fvi_rheology_column(o, o->elements + j));
    }
}

/* ---- amplitudes ---- */

void fvi_rheology_products(const fvi_rheology *o, size_t first, size_t P, double A[][FVI_LAW_MOST])
{
    for (size_t i = 0; i < P; i++)
        for (size_t j = 0; j <= i; j++)
            A[i][j] = A[j][i] = fvi_dot(o->rows, fvi_rheology_column(o, first + i), fvi_rheology_column(o, first + j));
}

int fvi_rheology_solve(size_t P, double least, double A[][FVI_LAW_MOST], double *b)
{
    for (size_t i = 0; i < P; i++) {
        for (size_t j = 0; j <= i; j++) {
            double sum = A[i][j];
            for (size_t k = 0; k < j; k++)
                sum -= A[i][k] * A[j][k];
            if (i == j && !(sum > least * A[i][i]))
                return 0;
            A[i][j] = i == j ? sqrt(sum) : sum / A[j][j];
        }
        for (size_t k = 0; k < i; k++)
            b[i] -= A[i][k] * b[k];
        b[i] /= A[i][i];
    }
    for (size_t i = P; i-- > 0;) {
        for (size_t k = i + 1; k < P; k++)
            b[i] -= A[k][i] * b[k];
        b[i] /= A[i][i];
    }
    return 1;
}

/* Solve the normal equations of the columns in `set`. Return 0 if the columns are dependent. */
static int solve_set(size_t E, unsigned set, double A[][FVI_MATERIAL_ELEMENTS], const double *b, double *c)
{
    double part[FVI_LAW_MOST][FVI_LAW_MOST], x[FVI_MATERIAL_ELEMENTS];
    size_t in[FVI_MATERIAL_ELEMENTS] = { 0 }, m = 0;
    for (size_t n = 0; n < E; n++)
        if (set >> n & 1)
            in[m++] = n;
    for (size_t i = 0; i < m; i++) {
        x[i] = b[in[i]];
        for (size_t j = 0; j <= i; j++)
            part[i][j] = A[in[i]][in[j]];
    }
    memset(c, 0, E * sizeof *c);
    if (!fvi_rheology_solve(m, 1e-13, part, x))
        return 0;
    for (size_t i = 0; i < m; i++)
        c[in[i]] = x[i];
    return 1;
}

/* Find the amplitudes of the least squares that are not negative. If the solution for all elements is not negative, it
 * is taken; else the best of the solutions for a part of the elements. */
static void solve_amplitudes(const fvi_rheology *o, double *c)
{
    const size_t E = o->elements;
    double A[FVI_MATERIAL_ELEMENTS][FVI_MATERIAL_ELEMENTS], b[FVI_MATERIAL_ELEMENTS],
        best = 0, part[FVI_MATERIAL_ELEMENTS];
    const unsigned all = (1u << E) - 1;
    for (size_t i = 0; i < E; i++) {
        b[i] = fvi_dot(o->rows, fvi_rheology_column(o, i), o->y);
        c[i] = 0;
        for (size_t j = 0; j <= i; j++)
            A[i][j] = A[j][i] = fvi_dot(o->rows, fvi_rheology_column(o, i), fvi_rheology_column(o, j));
    }
    for (unsigned set = all; set > 0; set--) {
        int possible = solve_set(E, set, A, b, part);
        for (size_t i = 0; i < E; i++)
            possible &= part[i] >= 0;
        const double less = possible ? fvi_dot(E, part, b) : 0; /* decrease of the sum of squares */
        if (less <= best)
            continue;
        best = less;
        memcpy(c, part, E * sizeof *c);
        if (set == all)
            return;
    }
}

/* Take out of the columns of u their part along the columns with amplitudes, (24.18). */
static void project_out_amplitudes(fvi_rheology *o, const double *c)
{
    for (size_t n = 0; n < o->elements; n++) { /* make the columns of the amplitudes orthonormal */
        double *q = fvi_rheology_column(o, n);
        for (int twice = 0; twice < 2; twice++)
            for (size_t k = 0; k < n; k++) {
                const double along = c[k] > 0 ? fvi_dot(o->rows, fvi_rheology_column(o, k), q) : 0;
                for (size_t i = 0; i < o->rows; i++)
                    q[i] -= along * fvi_rheology_column(o, k)[i];
            }
        const double length = sqrt(fvi_dot(o->rows, q, q));
        for (size_t i = 0; i < o->rows && length > 0; i++)
            q[i] /= length;
        for (size_t j = 0; j < o->shapes && c[n] > 0; j++) {
            double *v = fvi_rheology_column(o, o->elements + j);
            const double along = fvi_dot(o->rows, q, v);
            for (size_t i = 0; i < o->rows; i++)
                v[i] -= along * q[i];
        }
    }
}

//> project
/* (24.18): for given u find the amplitudes by linear least squares. The columns of u become the part of the slopes by u
 * that no change of the amplitudes can imitate. */
double fvi_rheology_project(fvi_rheology *o, const double *u, double *c, double *r, int with_slopes)
{
    fill_columns(o, u, with_slopes);
    solve_amplitudes(o, c);
    for (size_t i = 0; i < o->rows; i++) {
        r[i] = -o->y[i];
        for (size_t n = 0; n < o->elements; n++)
            r[i] += c[n] * fvi_rheology_column(o, n)[i];
    }
    for (size_t n = 0; n < o->elements && with_slopes; n++)
        for (size_t j = o->at[n]; j < o->at[n + 1]; j++)
            for (size_t i = 0; i < o->rows; i++)
                fvi_rheology_column(o, o->elements + j)[i] *= c[n];
    if (with_slopes)
        project_out_amplitudes(o, c);
    return fvi_dot(o->rows, r, r);
}
//< project

/* ---- all numbers together ---- */

/* Measure 1/C and its slopes by ln c and u, which are -phi/C^2. */
static void creep_columns(fvi_rheology *o, const double *c, double *r, int with_slopes)
{
    for (size_t i = 0; i < o->nodes; i++) {
        double complex C = 0;
        for (size_t n = 0; n < o->elements; n++)
            C += c[n] * shape_of(o, n, 0)[i];
        o->value[i] = 1 / C;
    }
    weigh_function(o, o->value, 1, r);
    for (size_t n = 0; with_slopes && n < o->elements; n++)
        for (size_t k = 0; k <= o->at[n + 1] - o->at[n]; k++) {
            double complex *slope = shape_of(o, n, k);
            for (size_t i = 0; i < o->nodes; i++)
                slope[i] *= -o->value[i] * o->value[i];
            weigh_function(o, slope, c[n],
                           fvi_rheology_column(o, k == 0 ? n : o->elements + o->at[n] + k - 1));
        }
}

double fvi_rheology_residuals(fvi_rheology *o, const double *z, double *r, int with_slopes)
{
    const size_t E = o->elements;
    const double *u = z + E;
    double c[FVI_MATERIAL_ELEMENTS];
    for (size_t n = 0; n < E; n++)
        c[n] = exp(z[n]);
    if (o->data->test == FVI_MATERIAL_CREEP) {
        fill_shapes(o, u);
        creep_columns(o, c, r, with_slopes);
    } else {
        fill_columns(o, u, with_slopes);
        memset(r, 0, o->rows * sizeof *r);
        for (size_t n = 0; n < E; n++) {
            for (size_t i = 0; i < o->rows; i++)
                r[i] += fvi_rheology_column(o, n)[i] *= c[n];
            for (size_t j = E + o->at[n]; with_slopes && j < E + o->at[n + 1]; j++)
                for (size_t i = 0; i < o->rows; i++)
                    fvi_rheology_column(o, j)[i] *= c[n];
        }
    }
    for (size_t i = 0; i < o->rows; i++)
        r[i] -= o->y[i];
    return fvi_dot(o->rows, r, r);
}
