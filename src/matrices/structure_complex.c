/* src/matrices/structure_complex.c -- Equations with m M + sum_j c_j C_j + k K, m, c, k complex.
 *                                                                     [H 27] */
#include "structure.h"

#include "complex_factors.h"
#include "system/fail.h"

#include <stdlib.h>
#include <string.h>

/* A product; C's own asks for NaNs. */
static inline double complex times(double complex a, double complex b)
{
    return creal(a) * creal(b) - cimag(a) * cimag(b)
           + I * (creal(a) * cimag(b) + cimag(a) * creal(b));
}

#define NUMBER double complex
#define TIMES(a, b) times(a, b)
#define IS_POSITIVE(a) (creal(a) > 0)
#include "band_elimination.h"

/* Of a band, or of UMFPACK, for which pattern and entries must stay. */
typedef struct {
    size_t n, w;
    int *start, *row;
    double complex *entry, *band;
    fvi_complex_factors *factors;
} complex_solver;

static void forget(void *factors)
{
    complex_solver *c = factors;
    if (!c)
        return;
    fvi_complex_factors_free(c->factors);
    free(c->start);
    free(c->row);
    free(c->entry);
    free(c->band);
    free(c);
}

/* The entries of the sum; factor l is factor[2 l] + i factor[2 l + 1]. */
static int sum(size_t count, const fvi_sparse *const *A, const double *factor,
               complex_solver *c)
{
    size_t entries = 0;
    for (size_t l = 0; l < count; l++)
        entries += (size_t)A[l]->start[c->n];
    int **place = malloc(count * sizeof *place), *room = malloc((entries + 1) * sizeof *room),
        *next = room, status = place && room ? FVI_SUCCESS : FVI_ENOMEM;
    for (size_t l = 0; !status && l < count; next += A[l++]->start[c->n])
        place[l] = next;
    if (!status)
        status = fvi_sparse_union(count, A, place, &c->start, &c->row);
    if (!status)
        c->entry = calloc((size_t)c->start[c->n] + 1, sizeof *c->entry);
    if (!c->entry)
        status = FVI_ENOMEM;
    for (size_t l = 0; !status && l < count; l++)
        for (int e = 0; e < A[l]->start[c->n]; e++)
            c->entry[place[l][e]] +=
                (factor[2 * l] + I * factor[2 * l + 1]) * A[l]->entry[e];
    free(place);
    free(room);
    return status;
}

/* The sum as a band: no pattern is looked for, as most of a short run of fvi-adaptive would be that. */
static int eliminate_band(size_t count, const fvi_sparse *const *A, const double *factor, complex_solver *c)
{
    const size_t row = c->w + 1;
    c->band = calloc(c->n * row, sizeof *c->band);
    if (!c->band)
        return FVI_ENOMEM;
    for (size_t l = 0; l < count; l++) {
        const double complex a = factor[2 * l] + I * factor[2 * l + 1];
        for (size_t j = 0; j < c->n; j++)
            for (int e = A[l]->start[j]; e < A[l]->start[j + 1]; e++) {
                const size_t i = (size_t)A[l]->row[e];
                if (i >= j)
                    c->band[i * row + c->w + j - i] += a * A[l]->entry[e];
            }
    }
    return factorise_band(c->n, c->w, c->band);
}

static size_t wider(size_t w, size_t other)
{
    return w > other ? w : other;
}

/* The matrices that are there, as they stand in the sum. */
static int factorise_terms(size_t count, const fvi_sparse *const *terms,
                           const double *factor, complex_solver *c)
{
    for (size_t l = 0; l < count; l++)
        c->w = wider(c->w, fvi_sparse_half_band(terms[l]));
    if (fvi_way_of_band(c->w) != FVI_BY_CHOLMOD)
        return eliminate_band(count, terms, factor, c);
    int status = sum(count, terms, factor, c);
    if (!status)
        status = fvi_complex_factors_alloc(c->n, c->start, c->row, &c->factors);
    return status ? status : fvi_complex_factors_of(c->factors, c->entry);
}

/* M, C or the C_j, K that are there, and their factors. Returns how many. */
static size_t list_terms(const fvi_structure *s, const double *factor,
                         const fvi_sparse **terms, double *kept)
{
    const size_t last = fvi_structure_dampings(s) + 1;
    size_t count = 0;
    for (size_t l = 0; l <= last; l++) {
        const fvi_sparse *term = l == 0      ? s->M
                                 : l == last ? s->K
                                 : s->space  ? fvi_structure_damping(s, l - 1)
                                             : s->C;
        if (!term)
            continue;
        memcpy(kept + 2 * count, factor + 2 * l, 2 * sizeof *kept);
        terms[count++] = term;
    }
    return count;
}

static int factorise(size_t d, const double *factor, const void *params, void **factors)
{
    const fvi_structure *s = params;
    const size_t most = fvi_structure_dampings(s) + 2;
    const fvi_sparse **terms = malloc(most * sizeof *terms);
    double *kept = malloc(2 * most * sizeof *kept);
    complex_solver *c = calloc(1, sizeof *c);
    int status = terms && kept && c ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status) {
        c->n = d;
        const size_t count = list_terms(s, factor, terms, kept);
        status = factorise_terms(count, terms, kept, c);
    }
    free(terms);
    free(kept);
    if (status)
        forget(c);
    else
        *factors = c;
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the factors", FVI_ENOMEM);
    return status;
}

static int solve(size_t d, void *factors, double *r)
{
    complex_solver *c = factors;
    double complex *x = (double complex *)r;
    if (c->factors)
        return fvi_complex_factors_solve(c->factors, x);
    solve_band(d, c->w, c->band, x);
    return FVI_SUCCESS;
}

void fvi_structure_add_complex(fvi_structure *s)
{
    s->matrices.factorise_complex = factorise;
    s->matrices.solve_complex = solve;
    s->matrices.forget_complex = forget;
}
