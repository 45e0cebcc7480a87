/* src/frequency/dynamic_stiffness.c -- Compute Z(s) = s^2 M + K + sum_j C_j(s) B_j, its factors and products. [H 30] */
#include "dynamic_stiffness.h"

#include "matrices/sparse.h"
#include "kernel/kernel_terms.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the pattern of the sum ---- */

/* Find the union of the patterns of all terms. */
static int find_union(fvi_response *r)
{
    const fvi_sparse **matrix = malloc(r->terms * sizeof *matrix);
    if (!matrix)
        return FVI_ENOMEM;
    for (size_t l = 0; l < r->terms; l++)
        matrix[l] = r->term[l].matrix;
    const int status = fvi_sparse_union(r->d, r->terms, matrix, &r->place, &r->start, &r->row);
    free(matrix);
    return status;
}

/* A small matrix, or one with less than three quarters of zeros, has dense factors. */
int fvi_stiffness_find_pattern(fvi_response *r)
{
    const size_t d = r->d;
    const int status = find_union(r);
    if (status)
        return status;
    const size_t entries = (size_t)r->start[d];
    r->is_dense = d <= FVI_ALWAYS_DENSE || 4 * entries > d * d;
    r->Z = malloc((2 * entries + (r->is_dense ? d * d : 0)) * sizeof *r->Z);
    if (!r->Z)
        return FVI_ENOMEM;
    r->slope = r->Z + entries;
    r->full = r->slope + entries;
    return fvi_complex_factors_alloc(d, r->is_dense ? NULL : r->start,
                                     r->is_dense ? NULL : r->row, &r->factors);
}

/* ---- at one s ---- */

//> stiffness
void fvi_stiffness_at(fvi_response *r, double complex s, double e)
{
    const size_t entries = (size_t)r->start[r->d];
    if (r->is_evaluated && r->s == s && r->e == e)
        return;
    memset(r->Z, 0, 2 * entries * sizeof *r->Z);
    const int *place = r->place;
    for (size_t l = 0; l < r->terms; l++) {
        const fvi_stiffness_term *t = &r->term[l];
        double complex factor = l == 0 ? s * s : 1, slope = l == 0 ? 2 * s : 0;
        if (t->kernel) {
            factor = e * fvi_kernel_at(t->kernel, s, &slope);
            slope *= e / s; /* fvi_kernel_at gives s times the derivative */
        }
        const int count = t->matrix->start[r->d];
        for (int i = 0; i < count; i++, place++) {
            r->Z[*place] += factor * t->matrix->entry[i];
            r->slope[*place] += slope * t->matrix->entry[i];
        }
    }
    r->s = s;
    r->e = e;
    r->is_evaluated = 1;
    r->is_factorised = 0;
}
//< stiffness

double complex fvi_stiffness_factor(const fvi_response *r, size_t l, double complex s)
{
    return l == 0 ? s * s : l == 1 ? 1 : fvi_kernel_at(r->term[l].kernel, s, NULL);
}

/* hypot does not lose numbers whose squares are below the smallest double. */
double fvi_stiffness_add_product(const fvi_sparse *A, double complex factor, const double complex *v,
                                 double complex *y)
{
    double size = 0;
    for (size_t j = 0; j < A->n; j++) {
        double complex sum = 0;
        for (int e = A->start[j]; e < A->start[j + 1]; e++)
            sum += A->entry[e] * v[A->row[e]];
        y[j] += factor * sum;
        size = hypot(size, cabs(factor * sum));
    }
    return size;
}

double fvi_stiffness_norm(const fvi_response *r, double complex s)
{
    double sum = cabs(s) * cabs(s) * r->term[0].norm + r->term[1].norm;
    for (size_t l = 2; l < r->terms; l++)
        sum += cabs(fvi_kernel_at(r->term[l].kernel, s, NULL)) * r->term[l].norm;
    return sum;
}

/* Return the entries of the sum, as a full matrix if the factors are dense. Z is symmetric, so columns are rows. */
static const double complex *expand_matrix(fvi_response *r)
{
    if (!r->is_dense)
        return r->Z;
    memset(r->full, 0, r->d * r->d * sizeof *r->full);
    for (size_t j = 0; j < r->d; j++)
        for (int e = r->start[j]; e < r->start[j + 1]; e++)
            r->full[j * r->d + (size_t)r->row[e]] = r->Z[e];
    return r->full;
}

int fvi_stiffness_factorise(fvi_response *r, double complex s, double e)
{
    fvi_stiffness_at(r, s, e);
    if (r->is_factorised)
        return FVI_SUCCESS;
    int status = fvi_interrupted(); /* factors of many unknowns take long */
    if (!status)
        status = fvi_complex_factors_of(r->factors, expand_matrix(r));
    r->is_factorised = !status;
    return status;
}

void fvi_stiffness_multiply(const fvi_response *r, const double complex *A,
                            const double complex *x, double complex *y)
{
    for (size_t j = 0; j < r->d; j++) { /* column j is row j, because A is symmetric */
        double complex sum = 0;
        for (int e = r->start[j]; e < r->start[j + 1]; e++)
            sum += A[e] * x[r->row[e]];
        y[j] = sum;
    }
}
