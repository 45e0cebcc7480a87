/* src/estimation/rheology_answer.c -- Compute what the data say of a law: estimates, deviations, intervals, flags.
 * [H 24] */
#include "rheology_search.h"

#include "system/larger.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define DEPENDENT 1e-6   /* least singular value of the Jacobian with columns of length 1 */
/* An order, an exponent or the logarithm of a time that is nearer to its bound is said to be at the bound. */
#define AT_A_BOUND 1e-3
#define FARTHEST 40      /* longest way of the logarithm of a number */
enum { OUTWARD = 40, INWARD = 40 };

/* ---- numbers by their names ---- */

/* Number i of element n of the law, as a function of z: the logarithm of a size, or an order or an exponent as it
 * is. */
typedef struct {
    const fvi_rheology *model;
    size_t n, i;
} number;

static double number_of(const void *params, const double *z, double *slope)
{
    const number *v = params;
    const fvi_rheology *m = v->model;
    const size_t E = m->elements;
    fvi_kernel_range ranges[FVI_ELEMENT_SHAPE];
    const fvi_element kind = m->data->kind[v->n];
    const size_t count = fvi_element_shape(kind, ranges);
    double value[FVI_ELEMENT_NUMBERS], by[FVI_ELEMENT_NUMBERS][1 + FVI_ELEMENT_SHAPE];
    fvi_element_public(kind, z[v->n], z + E + m->at[v->n], value, by);
    if (slope) {
        memset(slope, 0, (E + m->shapes) * sizeof *slope);
        slope[v->n] = by[v->i][0];
        for (size_t k = 0; k < count; k++)
            slope[E + m->at[v->n] + k] = by[v->i][1 + k];
    }
    return value[v->i];
}

/* Return the largest value of a number that is an order or an exponent; INFINITY if it is a size. */
static double most_of(const number *v)
{
    return fvi_element_most(v->model->data->kind[v->n], v->i);
}

static int is_size(const number *v)
{
    return most_of(v) == INFINITY;
}

static double bound(const number *v, double value)
{
    return is_size(v) ? exp(value) : value;
}

/* ---- standard deviations ---- */

/* Compute J^T J at z with columns of length 1. Rows and columns of unused numbers are those of the unit matrix. */
static void metric(const fvi_rheology *o, const int *is_used, double A[][FVI_LAW_MOST], double *length)
{
    const size_t P = o->elements + o->shapes;
    fvi_rheology_products(o, 0, P, A);
    for (size_t i = 0; i < P; i++)
        length[i] = is_used[i] && A[i][i] > 0 ? sqrt(A[i][i]) : 1;
    for (size_t i = 0; i < P; i++)
        for (size_t j = 0; j < P; j++)
            A[i][j] = !is_used[i] || !is_used[j] ? i == j : A[i][j] / (length[i] * length[j]);
}

/* Return sqrt(g^T A^-1 g) for the slope g of a number; NaN if A has no inverse. */
static double deviation(size_t P, double A[][FVI_LAW_MOST], const double *length, const double *g)
{
    double copy[FVI_LAW_MOST][FVI_LAW_MOST], b[FVI_LAW_MOST], sum = 0;
    memcpy(copy, A, sizeof copy);
    for (size_t i = 0; i < P; i++)
        b[i] = g[i] / length[i];
    if (!fvi_rheology_solve(P, 0, copy, b))
        return NAN;
    for (size_t i = 0; i < P; i++)
        sum += g[i] / length[i] * b[i];
    return sqrt(sum);
}

/* Return nonzero if the least eigenvalue of A is below DEPENDENT^2, which is so if A minus that multiple of the unit
 * matrix is not positive definite. */
static int is_singular(size_t P, double A[][FVI_LAW_MOST])
{
    double copy[FVI_LAW_MOST][FVI_LAW_MOST], b[FVI_LAW_MOST] = { 0 };
    memcpy(copy, A, sizeof copy);
    for (size_t i = 0; i < P; i++)
        copy[i][i] -= DEPENDENT * DEPENDENT;
    return !fvi_rheology_solve(P, 0, copy, b);
}

/* ---- profiles ---- */

typedef struct {
    fvi_rheology *model;
    number v;
    double value, least, sigma, reach; /* value, sum of squares and sigma of the fit; the quantile */
    double z[FVI_LAW_MOST];            /* last place of the other numbers */
} profile;

/* (24.11): return the root of the increase of chi^2 if the number has this value. */
static double excess(profile *p, double value)
{
    const double sum = fvi_rheology_descend(p->model, number_of, &p->v, value, p->z);
    return sum < INFINITY ? sqrt(fmax(0, sum - p->least)) / p->sigma : INFINITY;
}

/* Go outward from the fit by steps in proportion to the tangent's interval. Then find the end of the interval by regula
 * falsi. */
static double find_edge(profile *p, const double *z, double step)
{
    const size_t P = p->model->elements + p->model->shapes;
    const int order = !is_size(&p->v);
    const double most = most_of(&p->v);
    double inside = p->value, low = 0, outside = inside, high = 0;
    memcpy(p->z, z, P * sizeof *z);
    for (int i = 0; i < OUTWARD; i++, step *= 1.5) {
        double there = inside + step;
        if (order)
            there = fmin(fmax(there, 1e-4), most);
        if (fabs(there - p->value) > FARTHEST)
            return step < 0 ? -INFINITY : INFINITY;
        high = excess(p, there);
        outside = there;
        if (high >= p->reach)
            break;
        if (order && (there <= 1e-4 || there >= most))
            return step < 0 ? 0 : most;
        inside = there;
        low = high;
    }
    if (!(high >= p->reach))
        return step < 0 ? (order ? 0 : -INFINITY) : most;
    for (int i = 0; i < INWARD; i++) {
        const double share = (p->reach - low) / (fmin(high, 3 * p->reach) - low),
                     middle = inside + fmin(fmax(share, 0.05), 0.95) * (outside - inside),
                     there = excess(p, middle);
        if (fabs(there - p->reach) < 1e-4 * p->reach)
            return middle;
        if (there > p->reach) {
            outside = middle;
            high = there;
        } else {
            inside = middle;
            low = there;
        }
    }
    return inside;
}

/* Find the interval of number v. Data that the law repeats to the last digit leave no noise, and then the interval is
 * the estimate alone. sd is the standard deviation of ln v, or of v if it is an order or an exponent. */
static void interval(fvi_rheology *o, const number *v, const double *z, double least,
                     double sd, fvi_material *a, size_t j)
{
    if (a->sigma == 0) {
        a->lower[j] = a->upper[j] = a->estimate[j];
        return;
    }
    profile p = { .model = o,
                  .v = *v,
                  .value = number_of(v, z, NULL),
                  .least = least,
                  .sigma = a->sigma,
                  .reach = a->quantile };
    const double step = fmin(a->quantile * sd, is_size(v) ? 1 : 0.1);
    a->lower[j] = bound(v, find_edge(&p, z, -step));
    a->upper[j] = bound(v, find_edge(&p, z, step));
    if (a->lower[j] <= 0 || a->upper[j] >= most_of(v))
        a->flags |= FVI_MATERIAL_OPEN;
}

/* ---- the whole ---- */

/* Return the correlation of neighbours among n residuals in a row. */
static double neighbours_of(size_t n, const double *r)
{
    double pairs = 0, squares = 0;
    for (size_t i = 0; i < n; i++) {
        squares += r[i] * r[i];
        pairs += i > 0 ? r[i] * r[i - 1] : 0;
    }
    return squares > 0 ? pairs / squares : 0;
}

static void statistics(const fvi_rheology *m, size_t used, double sum, const double *r,
                       fvi_material *a)
{
    const fvi_material_data *d = m->data;
    const double freedom = (double)(m->rows - used);
    const int known = d->sigma > 0;
    a->sigma = known ? d->sigma : sqrt(sum / freedom);
    a->chi2 = known ? sum / (d->sigma * d->sigma) : freedom;
    a->probability = known ? fmin(gsl_cdf_chisq_P(a->chi2, freedom),
                                  gsl_cdf_chisq_Q(a->chi2, freedom))
                           : 1;
    a->quantile =
        known ? gsl_cdf_ugaussian_Pinv(0.975) : gsl_cdf_tdist_Pinv(0.975, freedom);
    a->neighbours = neighbours_of(d->n, r);
    if (d->test == FVI_MATERIAL_MODULI)
        a->neighbours = larger(a->neighbours, neighbours_of(d->n, r + d->n));
}

static void raise_flags(const fvi_rheology *m, const double *z, fvi_material *a)
{
    const double size = largest_abs(m->rows, m->y);
    if (a->agree < 2)
        a->flags |= FVI_MATERIAL_STARTS;
    if (a->sigma > 1e-6 * size && a->neighbours > 3 / sqrt((double)m->data->n) + 0.1)
        a->flags |= FVI_MATERIAL_NEIGHBOURS;
    if (a->probability < 1e-6)
        a->flags |= FVI_MATERIAL_CHI2;
    for (size_t j = 0; j < m->shapes; j++) {
        const double u = z[m->elements + j];
        if (u - m->low[j] < AT_A_BOUND || m->high[j] - u < AT_A_BOUND)
            a->flags |= FVI_MATERIAL_BOUND;
    }
    a->grave = a->flags
               & (FVI_MATERIAL_STARTS | FVI_MATERIAL_SINGULAR | FVI_MATERIAL_NEIGHBOURS
                  | FVI_MATERIAL_CHI2);
}

/* Say that the data do not determine number v, because its element has the amplitude 0, or because other numbers make
 * up for it. The estimate is one of many. */
static void set_undetermined(const number *v, fvi_material *a, size_t j)
{
    a->sd[j] = INFINITY;
    a->lower[j] = 0;
    a->upper[j] = most_of(v);
}

void fvi_rheology_answer(fvi_rheology *o, const double *z, double sum, fvi_material *a)
{
    const size_t E = o->elements, P = E + o->shapes;
    double A[FVI_LAW_MOST][FVI_LAW_MOST], length[FVI_LAW_MOST], g[FVI_LAW_MOST];
    int is_used[FVI_LAW_MOST];
    size_t used = 0;
    for (size_t n = 0; n < E; n++) {
        is_used[n] = z[n] > -INFINITY;
        a->flags |= is_used[n] ? 0 : FVI_MATERIAL_ZERO;
        for (size_t j = o->at[n]; j < o->at[n + 1]; j++)
            is_used[E + j] = is_used[n];
        used += is_used[n] ? 1 + o->at[n + 1] - o->at[n] : 0;
    }
    fvi_rheology_residuals(o, z, o->r, 1);
    statistics(o, used, sum, o->r, a);
    metric(o, is_used, A, length);
    if (is_singular(P, A))
        a->flags |= FVI_MATERIAL_SINGULAR;
    for (size_t n = 0; n < E; n++) {
        const size_t first = a->numbers;
        for (size_t i = 0; fvi_element_number(o->data->kind[n], i, NULL); i++) {
            const number v = { o, n, i };
            const size_t j = a->numbers++;
            a->estimate[j] = bound(&v, number_of(&v, z, g));
            if (!is_used[n] || a->flags & FVI_MATERIAL_SINGULAR) {
                if (!is_used[n] && i == 0)
                    a->estimate[j] = 0;
                set_undetermined(&v, a, j);
                continue;
            }
            const double sd = a->sigma * deviation(P, A, length, g);
            a->sd[j] = sd * (is_size(&v) ? a->estimate[j] : 1);
            interval(o, &v, z, sum, sd, a, j);
        }
        a->term[n] = fvi_element_term(o->data->kind[n], a->estimate + first);
    }
    raise_flags(o, z, a);
}

/* ---- words ---- */

int fvi_material_flag_text(const fvi_material_data *data, const fvi_material *material,
                           unsigned flag, size_t size, char *text)
{
    if (!(material->flags & flag))
        return 0;
    switch (flag) {
    case FVI_MATERIAL_STARTS:
        snprintf(text, size, "%zu of %zu starts agree on the best fit, which is not enough to "
                             "believe it; try more starts",
                 material->agree, material->starts);
        break;
    case FVI_MATERIAL_SINGULAR:
        snprintf(text, size, "these data do not determine all numbers of the law");
        break;
    case FVI_MATERIAL_NEIGHBOURS:
        snprintf(text, size,
                 "neighbouring residuals are alike (correlation %.2f): it is another law",
                 material->neighbours);
        break;
    case FVI_MATERIAL_CHI2:
        snprintf(text, size, "chi2 = %.6g has a probability of %.1g: the law or sigma is another",
                 material->chi2, material->probability);
        break;
    case FVI_MATERIAL_ZERO:
        snprintf(text, size, "not needed:");
        for (size_t n = 0; n < data->elements; n++) {
            const size_t end = strlen(text);
            if (!(material->term[n].rho > 0))
                snprintf(text + end, size - end, " %s%zu", fvi_element_words[data->kind[n]],
                         n + 1);
        }
        break;
    case FVI_MATERIAL_BOUND:
        snprintf(text, size, "an order, an exponent or a time is at the end of the range that is searched");
        break;
    default:
        snprintf(text, size, "the data set no end to an interval");
    }
    return 1;
}
