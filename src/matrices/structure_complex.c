/* src/matrices/structure_complex.c -- Solve equations with m M + sum_j c_j C_j + k K for complex factors.  [H 27] */
#include "structure.h"

#include "complex_factors.h"
#include "system/fail.h"
#include "system/larger.h"
#include "system/vectors.h"

#include <stdlib.h>
#include <string.h>

enum { LANES = FVI_COMPLEX_SUMS };

/* ---- bands ---- */

/* A complex number of each of four bands. The bands are eliminated side by side, because in one band each row waits for
 * the row before. */
typedef double four __attribute__((vector_size(LANES * sizeof(double)), aligned(8), may_alias));
typedef struct {
    four re, im;
} complex_lanes;

#define NUMBER complex_lanes

static inline void subtract_product(complex_lanes *to, const complex_lanes *a, const complex_lanes *b)
{
    const four re = a->re * b->re - a->im * b->im, im = a->re * b->im + a->im * b->re;
    to->re -= re;
    to->im -= im;
}

static inline void multiply(complex_lanes *to, const complex_lanes *a, const complex_lanes *b)
{
    const four re = a->re * b->re - a->im * b->im, im = a->re * b->im + a->im * b->re;
    to->re = re;
    to->im = im;
}

/* The real part is positive, and this form squares no number that could overflow. */
static inline void invert(complex_lanes *to, const complex_lanes *a)
{
    const four slope = a->im / a->re, size = a->re + a->im * slope;
    to->re = 1 / size;
    to->im = -slope / size;
}

static inline int is_positive(const complex_lanes *a)
{
    return a->re[0] > 0 && a->re[1] > 0 && a->re[2] > 0 && a->re[3] > 0;
}

#include "band_elimination.h"

FVI_VECTORS static int factorise_lanes(size_t n, size_t w, complex_lanes *band)
{
    return factorise_band(n, w, band);
}

FVI_VECTORS static void solve_lanes(size_t n, size_t w, const complex_lanes *band, complex_lanes *r)
{
    solve_band(n, w, band, r);
}

/* ---- sparse matrices ---- */

/* The factors of the bands, or of each sum by UMFPACK, which needs the pattern and the entries during a solution. */
typedef struct {
    size_t n, w, count;          /* number of equations */
    complex_lanes *band, *lanes; /* lanes: workspace for n right-hand sides; NULL without bands */
    int *start, *row;
    double complex *entry, *right;
    fvi_complex_factors *factors[LANES];
} complex_solver;

/* The matrices that exist. Factor l of sum i is factor[i * every + place[l]], a real and an imaginary part. */
typedef struct {
    size_t count, every, *place;
    const fvi_sparse **matrix;
    const double *factor;
} complex_terms;

static void free_complex_factors(void *factors)
{
    complex_solver *c = factors;
    if (!c)
        return;
    for (size_t i = 0; i < LANES; i++)
        fvi_complex_factors_free(c->factors[i]);
    free(c->start);
    free(c->row);
    free(c->entry);
    free(c->right);
    free(c->band);
    free(c);
}

static const double *factor_of(const complex_terms *terms, size_t sum, size_t l)
{
    return terms->factor + 2 * (sum * terms->every + terms->place[l]);
}

/* Eliminate the bands without computing a pattern, because that would take most of the time of a short run of
 * fvi-adaptive. Unused lanes repeat the last sum. */
static int eliminate_bands(const complex_terms *terms, complex_solver *c)
{
    const size_t row = c->w + 1;
    c->band = calloc(c->n * (row + 1), sizeof *c->band);
    if (!c->band)
        return FVI_ENOMEM;
    c->lanes = c->band + c->n * row;
    for (size_t l = 0; l < terms->count; l++) {
        const fvi_sparse *A = terms->matrix[l];
        complex_lanes a;
        for (size_t i = 0; i < LANES; i++) {
            const double *factor = factor_of(terms, i < c->count ? i : c->count - 1, l);
            a.re[i] = factor[0];
            a.im[i] = factor[1];
        }
        for (size_t j = 0; j < c->n; j++)
            for (int e = A->start[j]; e < A->start[j + 1]; e++) {
                const size_t i = (size_t)A->row[e];
                if (i < j)
                    continue;
                complex_lanes *to = &c->band[i * row + c->w + j - i];
                to->re += a.re * A->entry[e];
                to->im += a.im * A->entry[e];
            }
    }
    return factorise_lanes(c->n, c->w, c->band);
}

/* Write the entries of sum i. `place` has the positions of the entries of all matrices, as fvi_sparse_union gives
 * them. */
static void add_entries(const complex_terms *terms, size_t i, const int *place, complex_solver *c)
{
    memset(c->entry, 0, (size_t)c->start[c->n] * sizeof *c->entry);
    for (size_t l = 0; l < terms->count; l++) {
        const double *factor = factor_of(terms, i, l);
        for (int e = 0; e < terms->matrix[l]->start[c->n]; e++)
            c->entry[*place++] += (factor[0] + I * factor[1]) * terms->matrix[l]->entry[e];
    }
}

/* Factorise all sums with one pattern. */
static int factorise_sparse(const complex_terms *terms, complex_solver *c)
{
    int *place, status = fvi_sparse_union(c->n, terms->count, terms->matrix, &place, &c->start, &c->row);
    if (!status) {
        c->entry = malloc(((size_t)c->start[c->n] + 1) * sizeof *c->entry);
        c->right = malloc(c->n * sizeof *c->right);
    }
    if (!c->entry || !c->right)
        status = FVI_ENOMEM;
    for (size_t i = 0; !status && i < c->count; i++) {
        add_entries(terms, i, place, c);
        status = fvi_complex_factors_alloc(c->n, c->start, c->row, &c->factors[i]);
        if (!status)
            status = fvi_complex_factors_of(c->factors[i], c->entry);
    }
    free(place);
    return status;
}

/* List the matrices that exist among M, C or the C_j, and K. */
static void list_terms(const fvi_structure *s, complex_terms *terms)
{
    for (size_t l = 0; l < terms->every; l++) {
        const fvi_sparse *matrix = fvi_structure_term(s, l);
        if (!matrix)
            continue;
        terms->place[terms->count] = l;
        terms->matrix[terms->count++] = matrix;
    }
}

/* ---- functions of fvi_matrices ---- */

static int factorise(size_t d, size_t count, const double *factor, const void *params, void **factors)
{
    const fvi_structure *s = params;
    complex_terms terms = { .every = fvi_structure_term_count(s), .factor = factor };
    terms.place = malloc(terms.every * sizeof *terms.place);
    terms.matrix = malloc(terms.every * sizeof *terms.matrix);
    complex_solver *c = calloc(1, sizeof *c);
    int status = terms.place && terms.matrix && c ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status) {
        c->n = d;
        c->count = count;
        list_terms(s, &terms);
        for (size_t l = 0; l < terms.count; l++)
            c->w = larger_count(c->w, fvi_sparse_half_band(terms.matrix[l]));
        status = fvi_choose_factorisation_of_band(c->w) != FVI_BY_CHOLMOD ? eliminate_bands(&terms, c)
                                                                          : factorise_sparse(&terms, c);
    }
    free(terms.place);
    free(terms.matrix);
    if (status)
        free_complex_factors(c);
    else
        *factors = c;
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the factors", FVI_ENOMEM);
    return status;
}

static int solve_sparse(size_t count, complex_solver *c, double *r)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < count; i++) {
        for (size_t j = 0; j < c->n; j++)
            c->right[j] = r[2 * j * count + i] + I * r[(2 * j + 1) * count + i];
        status = fvi_complex_factors_solve(c->factors[i], c->right);
        for (size_t j = 0; j < c->n; j++) {
            r[2 * j * count + i] = creal(c->right[j]);
            r[(2 * j + 1) * count + i] = cimag(c->right[j]);
        }
    }
    return status;
}

static int solve(size_t d, size_t count, void *factors, double *r)
{
    complex_solver *c = factors;
    if (!c->band)
        return solve_sparse(count, c, r);
    if (count == LANES) {
        solve_lanes(d, c->w, c->band, (complex_lanes *)r);
        return FVI_SUCCESS;
    }
    double *lanes = (double *)c->lanes; /* the content of the unused lanes does not matter */
    for (size_t j = 0; j < 2 * d; j++)
        memcpy(lanes + j * LANES, r + j * count, count * sizeof *r);
    solve_lanes(d, c->w, c->band, c->lanes);
    for (size_t j = 0; j < 2 * d; j++)
        memcpy(r + j * count, lanes + j * LANES, count * sizeof *r);
    return FVI_SUCCESS;
}

void fvi_structure_add_complex(fvi_structure *s)
{
    s->matrices.factorise_complex = factorise;
    s->matrices.solve_complex = solve;
    s->matrices.free_complex_factors = free_complex_factors;
}
