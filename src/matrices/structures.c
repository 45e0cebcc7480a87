/* src/matrices/structures.c -- Systems of sparse matrices.             [Chapter 27] */
#include "factors.h"

#include "system/fail.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* r columns of d rows each, from start[l] to start[l + 1] - 1, as in fvi_sparse. */
typedef struct {
    size_t r;
    int *start, *row;
    double *entry; /* NULL: ones */
} columns;

/* What the damping remembers. (27.4) */
typedef enum {
    NOTHING, /* there is no damping */
    ALL,     /* x itself */
    SOME,    /* the x_i that C touches: B picks them out */
    FEW      /* B^T x, C = B B^T */
} remembering;

struct fvi_structure {
    const fvi_sparse *M, *K, *C;
    double *mass, *damping; /* the diagonals, one block */
    remembering kind;
    columns B;
    fvi_factors *by_mass; /* for energies */
    fvi_matrices matrices;
};

enum { SMALL = 512 /* unknowns whose C may be taken apart densely */ };

/* ---- what a run asks for ---- */

static int stiffness(size_t d, const double *x, const void *params, double *y)
{
    const fvi_structure *s = params;
    (void)d;
    fvi_sparse_product(s->K, x, y);
    return FVI_SUCCESS;
}

//> remember
/* z = B^T x - from, and below p -= a S z: S is B, or the columns of C that are not zero.
 * (27.4) */
static int remember(size_t d, const double *x, const double *from,
                    const void *params, double *z)
{
    const fvi_structure *s = params;
    const columns *B = &s->B;
    for (size_t i = 0; s->kind == ALL && i < d; i++)
        z[i] = x[i] - from[i];
    for (size_t l = 0; l < B->r; l++) {
        double sum = 0;
        for (int e = B->start[l]; e < B->start[l + 1]; e++)
            sum += (s->kind == FEW ? B->entry[e] : 1) * x[B->row[e]];
        z[l] = sum - from[l];
    }
    return FVI_SUCCESS;
}

static int damp(size_t d, double a, const double *z, const void *params,
                double *p)
{
    const fvi_structure *s = params;
    const columns *B = &s->B;
    const fvi_sparse *C = s->C;
    for (size_t j = 0; s->kind == ALL && j < d; j++) { /* rows are columns */
        double sum = 0;
        for (int e = C->start[j]; e < C->start[j + 1]; e++)
            sum += C->entry[e] * z[C->row[e]];
        p[j] -= a * sum;
    }
    for (size_t l = 0; l < B->r; l++) {
        const int j = s->kind == SOME ? B->row[B->start[l]] : (int)l;
        const int *start = s->kind == SOME ? C->start : B->start;
        const int *row = s->kind == SOME ? C->row : B->row;
        const double *entry = s->kind == SOME ? C->entry : B->entry;
        for (int e = start[j]; e < start[j + 1]; e++)
            p[row[e]] -= a * entry[e] * z[l];
    }
    return FVI_SUCCESS;
}
//< remember

static int factorise(size_t d, double m, double c, double k, const void *params,
                     void **factors)
{
    const fvi_structure *s = params;
    const fvi_sparse *const terms[3] = { s->M, s->C, s->K };
    const double a[3] = { m, c, k };
    fvi_sparse A;
    fvi_factors *f;
    (void)d;
    int status = fvi_sparse_add(terms, a, &A);
    if (!status)
        status = fvi_factors_alloc(fvi_way_of(&A), &A, &f);
    if (!status)
        *factors = f;
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the factors", FVI_ENOMEM);
    return status;
}

static int solve(size_t d, void *factors, double *r)
{
    (void)d;
    return fvi_factors_solve(factors, r);
}

static void forget(void *factors)
{
    fvi_factors_free(factors);
}

/* Two numbers at a time are asked of the factors, by runs in any threads: no room is
 * kept. */
static int energy(size_t d, const double *x, const double *p,
                  const void *params, double *E)
{
    const fvi_structure *s = params;
    double *y = malloc(2 * d * sizeof *y), *v = y + d, sum = 0;
    if (!y)
        return FVI_ENOMEM;
    fvi_sparse_product(s->K, x, y);
    memcpy(v, p, d * sizeof *v);
    int status = fvi_factors_solve(s->by_mass, v);
    for (size_t i = 0; i < d; i++)
        sum += p[i] * v[i] + x[i] * y[i];
    free(y);
    if (!status)
        *E = sum / 2;
    return status;
}

/* ---- which numbers the damping remembers ---- */

static int room(size_t r, size_t count, columns *B)
{
    *B = (columns){ .r = r,
                    .start = calloc(r + 1, sizeof *B->start),
                    .row = malloc((count + 1) * sizeof *B->row),
                    .entry = malloc((count + 1) * sizeof *B->entry) };
    return B->start && B->row && B->entry ? FVI_SUCCESS : FVI_ENOMEM;
}

/* The unknowns that C touches, one for each column of B. */
static int pick(const fvi_sparse *C, columns *B)
{
    size_t r = 0;
    for (size_t j = 0; j < C->n; j++)
        r += C->start[j + 1] > C->start[j];
    if (room(r, r, B))
        return FVI_ENOMEM;
    for (size_t j = 0, l = 0; j < C->n; j++)
        if (C->start[j + 1] > C->start[j])
            B->row[l++] = (int)j;
    for (size_t l = 0; l <= r; l++)
        B->start[l] = (int)l;
    return FVI_SUCCESS;
}

static int is_zero(size_t n, const double *D, double noise)
{
    for (size_t i = 0; i < n; i++)
        if (fabs(D[i]) > noise)
            return 0;
    return 1;
}

//> rank
/* C = B B^T by Cholesky's elimination, always of the largest diagonal entry that is left,
 * until nothing is: D is C between the unknowns that it touches, and B's columns come into
 * `out`, of r rows each. A diagonal entry that has become negative beyond rounding is
 * that of a C which is negative somewhere. Returns the rank, or -1. */
static int take_apart(size_t r, double *D, double *out)
{
    double largest = 0;
    for (size_t i = 0; i < r; i++)
        largest = fmax(largest, D[i * r + i]);
    const double noise = (double)r * 8 * DBL_EPSILON * largest;
    for (size_t rank = 0;; rank++, out += r) {
        size_t pivot = 0;
        for (size_t i = 0; i < r; i++) {
            if (D[i * r + i] < -noise)
                return -1;
            if (D[i * r + i] > D[pivot * r + pivot])
                pivot = i;
        }
        const double top = D[pivot * r + pivot];
        if (!(top > noise) || rank == r)
            return is_zero(r * r, D, noise) ? (int)rank : -1;
        for (size_t i = 0; i < r; i++)
            out[i] = D[i * r + pivot] / sqrt(top);
        for (size_t i = 0; i < r; i++)
            for (size_t j = 0; j < r && out[i] != 0; j++)
                D[i * r + j] -= out[i] * out[j];
    }
}
//< rank

/* B's dense columns of r rows, of the unknowns in `from`, without their zeros. */
static int keep_columns(size_t rank, const columns *from, const double *dense,
                        columns *B)
{
    const size_t r = from->r;
    if (room(rank, rank * r, B))
        return FVI_ENOMEM;
    for (size_t l = 0; l < rank; l++) {
        int e = B->start[l];
        for (size_t i = 0; i < r; i++)
            if (dense[l * r + i] != 0) {
                B->row[e] = from->row[i];
                B->entry[e++] = dense[l * r + i];
            }
        B->start[l + 1] = e;
    }
    return FVI_SUCCESS;
}

static void drop(columns *B)
{
    free(B->start);
    free(B->row);
    free(B->entry);
    *B = (columns){ 0 };
}

/* A small C: is it negative, and is its rank low enough that B^T x pays? */
static int look_for_few(fvi_structure *s)
{
    const size_t r = s->B.r;
    double *D = calloc(2 * r * r, sizeof *D);
    if (!D)
        return FVI_ENOMEM;
    for (size_t l = 0; l < r; l++)
        for (size_t i = 0; i < r; i++)
            D[l * r + i] = fvi_sparse_entry(s->C, (size_t)s->B.row[i],
                                            (size_t)s->B.row[l]);
    const int rank = take_apart(r, D, D + r * r);
    int status = rank < 0 ? FVI_EDOM : FVI_SUCCESS;
    if (rank >= 0 && 2 * (size_t)rank <= r) {
        columns B;
        status = keep_columns((size_t)rank, &s->B, D + r * r, &B);
        if (status)
            drop(&B);
        else {
            drop(&s->B);
            s->B = B;
            s->kind = FEW;
        }
    }
    free(D);
    return status;
}

/* A large C is not negative if C and a thousandth of a millionth of its diagonal are
 * positive definite. */
static int look_at_all(const fvi_structure *s)
{
    double largest = 0, least = 0;
    for (size_t i = 0; i < s->C->n; i++) {
        largest = fmax(largest, s->damping[i] / s->mass[i]);
        least = fmin(least, s->damping[i]);
    }
    if (least < 0)
        return FVI_EDOM;
    const fvi_sparse *const terms[3] = { s->M, s->C, NULL };
    const double a[3] = { 1e-9 * largest, 1, 0 };
    fvi_sparse A;
    fvi_factors *f;
    int status = fvi_sparse_add(terms, a, &A);
    if (status)
        return status;
    const fvi_way way = fvi_way_of(&A);
    if (way == FVI_BY_GRADIENTS) { /* which tell nothing before they are used */
        fvi_sparse_free(&A);
        return FVI_SUCCESS;
    }
    status = fvi_factors_alloc(way, &A, &f);
    if (!status)
        fvi_factors_free(f);
    return status == FVI_ESING ? FVI_EDOM : status;
}

static int look_at_damping(fvi_structure *s)
{
    const int any = s->C && s->C->start[s->C->n] > 0;
    if (!any)
        return FVI_SUCCESS;
    int status = pick(s->C, &s->B);
    if (status)
        return status;
    s->kind = SOME;
    status = s->B.r <= SMALL ? look_for_few(s) : look_at_all(s);
    if (s->kind == SOME && s->B.r == s->C->n) {
        drop(&s->B);
        s->kind = ALL;
    }
    s->matrices.remembered = s->kind == ALL ? s->C->n : s->B.r;
    return status;
}

/* ---- a structure ---- */

static int look_at_mass(fvi_structure *s)
{
    const size_t d = s->M->n;
    for (size_t i = 0; i < d; i++) {
        s->mass[i] = fvi_sparse_entry(s->M, i, i);
        s->damping[i] = s->C ? fvi_sparse_entry(s->C, i, i) : 0;
        if (!(s->mass[i] > 0))
            return FVI_EDOM;
    }
    void *factors;
    int status = factorise(d, 1, 0, 0, s, &factors);
    if (!status)
        s->by_mass = factors;
    return status;
}

/* Returns a code, and says of which matrix. */
static int look(fvi_structure *s, char *fault)
{
    const struct {
        const fvi_sparse *matrix;
        char name;
    } all[] = { { s->M, 'M' }, { s->K, 'K' }, { s->C, 'C' } };
    int status = FVI_SUCCESS, place;
    for (int l = 0; !status && l < 3; l++) {
        *fault = all[l].name;
        if (all[l].matrix && all[l].matrix->n != s->M->n)
            return FVI_EINVAL;
        if (all[l].matrix)
            status = fvi_sparse_is_symmetric(all[l].matrix, &place);
    }
    if (!status) {
        *fault = 'M';
        status = look_at_mass(s);
    }
    if (!status) {
        *fault = 'C';
        status = look_at_damping(s);
    }
    if (!status)
        *fault = 0;
    return status;
}

int fvi_structure_alloc(const fvi_sparse *M, const fvi_sparse *K,
                        const fvi_sparse *C, fvi_structure **structure,
                        char *fault)
{
    char nowhere;
    if (!fault)
        fault = &nowhere;
    *fault = 0;
    if (!M || !K || !structure)
        FVI_FAIL("null pointer", FVI_EFAULT);
    fvi_structure *s = calloc(1, sizeof *s);
    double *block = malloc(2 * M->n * sizeof *block);
    if (!s || !block) {
        free(s);
        free(block);
        FVI_FAIL("no memory for the structure", FVI_ENOMEM);
    }
    *s = (fvi_structure){
        .M = M, .K = K, .C = C, .mass = block, .damping = block + M->n
    };
    s->matrices = (fvi_matrices){ .remember = remember,
                                  .damp = damp,
                                  .stiffness = stiffness,
                                  .factorise = factorise,
                                  .solve = solve,
                                  .forget = forget,
                                  .energy = energy,
                                  .params = s };
    const int status = look(s, fault);
    if (status) {
        fvi_structure_free(s);
        FVI_FAIL(status == FVI_EINVAL  ? "matrices of different sizes"
                 : status == FVI_ESING ? "M is not positive definite"
                 : status == FVI_EDOM ? "a matrix is not symmetric, or negative"
                                      : "no memory for the structure",
                 status);
    }
    *structure = s;
    return FVI_SUCCESS;
}

fvi_system fvi_structure_system(const fvi_structure *s)
{
    return (fvi_system){ .d = s->M->n,
                         .mass = s->mass,
                         .damping = s->damping,
                         .matrices = &s->matrices };
}

const char *fvi_structure_solver(const fvi_structure *s, double m, double c,
                                 double k)
{
    static const char *const names[] = { "diagonal", "band", "CHOLMOD",
                                         "conjugate gradients" };
    const fvi_sparse *const terms[3] = { s->M, s->C, s->K };
    const double a[3] = { m, c, k };
    fvi_sparse A;
    if (fvi_sparse_add(terms, a, &A))
        return "";
    const fvi_way way = fvi_way_of(&A);
    fvi_sparse_free(&A);
    return names[way];
}

void fvi_structure_free(fvi_structure *s)
{
    if (!s)
        return;
    fvi_factors_free(s->by_mass);
    drop(&s->B);
    free(s->mass);
    free(s);
}
