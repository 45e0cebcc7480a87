/* src/estimation/rheology.c -- Fit laws of damping to the measurements of a laboratory. [H 24] */
#include <fvi/rheology.h>

#include "rheology_search.h"
#include "kernel/kernel_terms.h"
#include "kernel/laplace_parabola.h"
#include "system/dot.h"
#include "system/fail.h"

#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SAME 1e-6 /* of the least sum: starts within that agree, or within 1e-20 of the sum of squares of the data */
enum { ENOUGH = 3, MOST_STARTS = 10000 };

/* ---- a curve ---- */

static int check_curve(fvi_material_test test, const fvi_kernel *kernel, double load, size_t n,
                       const double *at, const double *first, const double *second,
                       fvi_error *error)
{
    if (!kernel || !at || !first || (test == FVI_MATERIAL_MODULI && !second))
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "a pointer of the curve is NULL");
    if (!isfinite(load))
        return fvi_fail(error, FVI_EDOM, "load", load, "must be finite");
    for (size_t i = 0; i < n; i++)
        if (!(at[i] > 0) || !isfinite(at[i]))
            return fvi_fail(error, FVI_EDOM, "at", at[i], "must be finite and above 0");
    return FVI_SUCCESS;
}

int fvi_material_curve(fvi_material_test test, const fvi_kernel *kernel, double load, size_t n,
                       const double *at, double *first, double *second, fvi_error *error)
{
    int status = check_curve(test, kernel, load, n, at, first, second, error);
    fvi_parabola p = { 0 };
    double complex C[FVI_PARABOLA_NODES];
    double begin = INFINITY;
    for (size_t i = 0; !status && i < n; i++) {
        if (test == FVI_MATERIAL_MODULI) {
            status = fvi_kernel_moduli(kernel, at[i], &first[i], &second[i]);
            continue;
        }
        if (!(at[i] >= begin && at[i] <= FVI_PARABOLA_SPAN * begin)) {
            fvi_parabola_make(begin = at[i], &p);
            for (size_t j = 0; j < FVI_PARABOLA_NODES; j++)
                C[j] = fvi_kernel_at(kernel, p.s[j], NULL);
        }
        first[i] = 0;
        for (size_t j = 0; j < FVI_PARABOLA_NODES; j++)
            first[i] += creal(load * p.weight[j] * cexp(p.s[j] * at[i]) / p.s[j]
                              * (test == FVI_MATERIAL_CREEP ? 1 / C[j] : C[j]));
    }
    return status;
}

/* ---- what can be asked ---- */

static int check_numbers(const fvi_material_data *d, fvi_error *error)
{
    const double *const units[] = { d->unit, d->second_unit };
    for (size_t i = 0; i < d->n; i++) {
        const int both = d->test == FVI_MATERIAL_MODULI;
        if (!(d->at[i] > 0) || !isfinite(d->at[i]))
            return fvi_fail(error, FVI_EDOM, "at", d->at[i], "must be finite and above 0");
        if (!isfinite(d->first[i]))
            return fvi_fail(error, FVI_EDOM, "data", d->first[i], "must be finite");
        if (both && !isfinite(d->second[i]))
            return fvi_fail(error, FVI_EDOM, "data", d->second[i], "must be finite");
        if (!d->unit && d->first[i] == 0 && (!both || d->second[i] == 0))
            return fvi_fail(error, FVI_EDOM, "data", 0, "a datum of 0 has no relative error");
        for (size_t k = 0; k < 2; k++)
            if (units[k] && !(units[k][i] > 0 && isfinite(units[k][i])))
                return fvi_fail(error, FVI_EDOM, "unit", units[k][i], "must be finite and above 0");
    }
    return FVI_SUCCESS;
}

static int check(const fvi_material_data *d, const fvi_material *answer, fvi_error *error)
{
    if (!d || !answer || !d->at || !d->first || !d->kind
        || (d->test == FVI_MATERIAL_MODULI && !d->second))
        return fvi_fail(error, FVI_EFAULT, NULL, NAN, "a pointer of the data is NULL");
    if (d->elements == 0 || d->elements > FVI_MATERIAL_ELEMENTS)
        return fvi_fail(error, FVI_EINVAL, "law", (double)d->elements, "1 to %d elements", FVI_MATERIAL_ELEMENTS);
    if (d->starts < 2 || d->starts > MOST_STARTS)
        return fvi_fail(error, FVI_EINVAL, "starts", (double)d->starts, "2 to %d starts", MOST_STARTS);
    if (!(d->sigma >= 0) || !isfinite(d->sigma))
        return fvi_fail(error, FVI_EDOM, "sigma", d->sigma, "must be finite and not negative");
    if (d->load == 0 || !isfinite(d->load))
        return fvi_fail(error, FVI_EDOM, "load", d->load, "must be finite and not 0");
    size_t numbers = d->elements;
    for (size_t n = 0; n < d->elements; n++) {
        fvi_kernel_range ranges[FVI_ELEMENT_SHAPE];
        if ((unsigned)d->kind[n] >= fvi_kernel_word_count)
            return fvi_fail(error, FVI_EINVAL, "law", (double)d->kind[n], "no such element");
        if (d->kind[n] == FVI_ELEMENT_VISCOUS && d->test == FVI_MATERIAL_RELAXATION)
            return fvi_refuse(error, "law", "'viscous' relaxes at once: no datum of relaxation knows it");
        numbers += fvi_element_shape(d->kind[n], ranges);
    }
    if ((d->test == FVI_MATERIAL_MODULI ? 2 : 1) * d->n <= numbers)
        return fvi_fail(error, FVI_EINVAL, "data", (double)d->n,
                        "%zu rows are not enough for %zu numbers", d->n, numbers);
    return check_numbers(d, error);
}

/* ---- many starts ---- */

/* Write a Latin hypercube of K starts: in each coordinate, each of the K cells contains one start. */
static void hypercube(const fvi_rheology *m, size_t K, double *starts, gsl_rng *random)
{
    const size_t P = m->shapes + m->elements;
    for (size_t j = 0; j < P; j++) {
        for (size_t k = 0; k < K; k++)
            starts[k * P + j] = (double)k;
        for (size_t k = K; k-- > 1;) { /* shuffle the cells */
            const size_t other = gsl_rng_uniform_int(random, k + 1);
            const double here = starts[k * P + j];
            starts[k * P + j] = starts[other * P + j];
            starts[other * P + j] = here;
        }
        for (size_t k = 0; k < K; k++) {
            const double share = (starts[k * P + j] + gsl_rng_uniform(random)) / (double)K;
            starts[k * P + j] =
                j < m->shapes ? m->begin[j] + share * (m->end[j] - m->begin[j]) : share;
        }
    }
}

/* Search from the starts until three of them agree on the least sum. Return that sum. */
static double try_starts(fvi_rheology *o, const double *starts, double *z, fvi_material *a)
{
    const size_t P = o->shapes + o->elements;
    double best = INFINITY;
    const double data = fvi_dot(o->rows, o->y, o->y);
    for (a->starts = a->agree = 0; a->starts < o->data->starts && a->agree < ENOUGH; a->starts++) {
        double there[FVI_LAW_MOST];
        const double *start = starts + a->starts * P,
                     sum = fvi_rheology_search(o, start, start + o->shapes, there),
                     near = SAME * best + 1e-20 * data;
        if (!(sum < INFINITY))
            continue;
        if (!(best < INFINITY) || sum < best - near)
            a->agree = 1;
        else
            a->agree += sum <= best + near;
        if (sum < best) {
            best = sum;
            memcpy(z, there, P * sizeof *z);
        }
    }
    return best;
}

/* Sort elements of the same kind by their times, or by their orders if they have no time, because the data do not know
 * which is which. */
static void sort_elements(const fvi_rheology *m, double *z)
{
    const size_t E = m->elements;
    for (size_t pass = 0; pass < E; pass++)
        for (size_t n = 0; n + 1 < E; n++)
            for (size_t l = n + 1; l < E; l++) {
                fvi_kernel_range ranges[FVI_ELEMENT_SHAPE];
                const size_t count = fvi_element_shape(m->data->kind[n], ranges);
                double *a = z + E + m->at[n], *b = z + E + m->at[l];
                size_t by = 0;
                while (by < count && ranges[by] != FVI_RANGE_SIZE)
                    by++;
                by = by < count ? by : 0;
                if (m->data->kind[l] != m->data->kind[n] || count == 0 || a[by] <= b[by])
                    continue;
                double keep = z[n];
                z[n] = z[l];
                z[l] = keep;
                for (size_t k = 0; k < count; k++) {
                    keep = a[k];
                    a[k] = b[k];
                    b[k] = keep;
                }
            }
}

/* ---- the whole ---- */

static int fit(fvi_rheology *o, double *curve, fvi_material *answer, fvi_error *error)
{
    const fvi_material_data *d = o->data;
    const size_t P = o->shapes + o->elements;
    double z[FVI_LAW_MOST];
    fvi_quiet();
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    fvi_loud();
    double *starts = malloc(d->starts * P * sizeof *starts);
    *answer = (fvi_material){ .numbers = 0 };
    double sum = INFINITY;
    if (random && starts) {
        hypercube(o, d->starts, starts, random);
        sum = try_starts(o, starts, z, answer);
    }
    const int memory = random && starts;
    if (random)
        gsl_rng_free(random);
    free(starts);
    if (!memory)
        return fvi_no_memory(error, NULL);
    if (!(sum < INFINITY))
        return fvi_fail(error, FVI_EBADFUNC, NULL, NAN, "no start gives a law that is finite");
    sort_elements(o, z);
    fvi_rheology_answer(o, z, sum, answer);
    if (!curve)
        return FVI_SUCCESS;
    return fvi_material_curve(d->test, &(fvi_kernel){ d->elements, answer->term }, d->load, d->n,
                              d->at, curve, curve + d->n, error);
}

int fvi_material_fit(const fvi_material_data *data, double *curve, fvi_material *material,
                     fvi_error *error)
{
    fvi_rheology o;
    int status = check(data, material, error);
    if (status)
        return status;
    if (fvi_rheology_alloc(data, &o))
        status = fvi_no_memory(error, NULL);
    else
        status = fit(&o, curve, material, error);
    fvi_rheology_free(&o);
    return status;
}
