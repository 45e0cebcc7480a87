/* src/stages/stage_dense.c -- Invert the equation of all stages of a small structure.     [H 27] */
#include "stage_dense.h"

#include "system/damping_matrix.h"
#include "system/dense.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The data on the way to the inverse. All matrices are stored row by row. */
typedef struct {
    const fvi_matrices *matrices;
    size_t d, s, count;     /* number of dampers */
    double h;
    const double *const *W; /* the matrix W_j of each damper, or NULL */
    double *M, *K, *C;      /* d x d numbers each; one C for each damper */
    /* d numbers (M_pp + h^2 K_pp)^(-1/2), which bring the rows of stiff and of light bodies to one size */
    double *scale;
    double *unit, *column;  /* d numbers each */
    double *E;              /* the matrix of the equation, s d x s d numbers; stage i of unknown p is row i d + p */
} equation;

static void write_column(const equation *e, size_t q, double *matrix)
{
    for (size_t p = 0; p < e->d; p++)
        matrix[p * e->d + q] = e->column[p];
}

/* Read column q of C_j. */
static int read_damping(const equation *e, size_t j, size_t q)
{
    const fvi_damping_matrix *C = e->matrices->damper_count > 0 ? e->matrices->damper + j : &e->matrices->damping;
    for (size_t p = 0; p < e->d; p++)
        e->column[p] = 0;
    const int status = fvi_damping_multiply(C, e->d, 1, e->unit, e->column);
    write_column(e, q, e->C + j * e->d * e->d);
    return status;
}

/* Read M, K and all C_j, column by column, with the functions of the structure. */
static int read_matrices(const equation *e)
{
    const fvi_matrices *m = e->matrices;
    int status = FVI_SUCCESS;
    for (size_t q = 0; !status && q < e->d; q++) {
        e->unit[q] = 1;
        status = m->inertia(e->d, e->unit, m->params, e->column);
        write_column(e, q, e->M);
        if (!status)
            status = m->stiffness(e->d, e->unit, m->params, e->column);
        write_column(e, q, e->K);
        for (size_t j = 0; !status && j < e->count; j++)
            if (e->W[j])
                status = read_damping(e, j, q);
        e->unit[q] = 0;
        e->scale[q] = 1 / sqrt(e->M[q * e->d + q] + e->h * e->h * e->K[q * e->d + q]);
    }
    return status;
}

/* Write block (i, l) of A^(-1) (x) M + h sum_j W_j (x) C_j + h^2 A (x) K, without the scales. */
static void write_block(const equation *e, double inertia, double stiffness, size_t i, size_t l)
{
    const size_t d = e->d, n = e->s * d;
    double *block = e->E + i * d * n + l * d;
    for (size_t p = 0; p < d; p++, block += n)
        for (size_t q = 0; q < d; q++)
            block[q] = inertia * e->M[p * d + q] + stiffness * e->K[p * d + q];
    for (size_t j = 0; j < e->count; j++) {
        const double *C = e->C + j * d * d, damping = e->W[j] ? e->h * e->W[j][i * e->s + l] : 0;
        block = e->E + i * d * n + l * d;
        for (size_t p = 0; e->W[j] && p < d; p++, block += n)
            for (size_t q = 0; q < d; q++)
                block[q] += damping * C[p * d + q];
    }
}

/* Scale the equation, invert it, and remove the scales. Write h times the inverse to G, column by column. */
static int invert_equation(const equation *e, double *G)
{
    const fvi_lobatto_rule *rule = fvi_lobatto(e->s);
    const size_t d = e->d, n = e->s * d, rows = fvi_dense_rows(n);
    double A[FVI_STAGES][FVI_STAGES], scale[FVI_STAGE_DENSE];
    size_t order[FVI_STAGE_DENSE];
    fvi_lobatto_table(rule, e->s, A);
    for (size_t i = 0; i < e->s; i++) {
        memcpy(scale + i * d, e->scale, d * sizeof *scale);
        for (size_t l = 0; l < e->s; l++)
            write_block(e, rule->D[i][l] + (i + l == 0 ? 1 / rule->b[0] : 0), /* (17.3) */
                        e->h * e->h * A[i][l], i, l);
    }
    for (size_t row = 0; row < n; row++)
        for (size_t column = 0; column < n; column++)
            e->E[row * n + column] *= scale[row] * scale[column];
    const int status = fvi_dense_invert(n, e->E, order);
    for (size_t row = 0; row < n; row++)
        for (size_t column = 0; column < n; column++)
            G[column * rows + row] = e->h * scale[row] * scale[column] * e->E[row * n + column];
    return status;
}

int fvi_stage_dense(const fvi_matrices *matrices, size_t d, size_t s, double h, const double *const *W, double **G)
{
    equation e = { .matrices = matrices, .d = d, .s = s, .h = h, .W = W };
    e.count = matrices->damper_count > 0 ? matrices->damper_count : 1;
    const size_t n = s * d, rows = fvi_dense_rows(n);
    double *numbers = calloc((2 + e.count) * d * d + 3 * d + n * n, sizeof *numbers),
           *inverse = calloc(rows * n, sizeof *inverse);
    int status = numbers && inverse ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status) {
        e.M = numbers;
        e.K = e.M + d * d;
        e.C = e.K + d * d;
        e.scale = e.C + e.count * d * d;
        e.unit = e.scale + d;
        e.column = e.unit + d;
        e.E = e.column + d;
        status = read_matrices(&e);
    }
    if (!status)
        status = invert_equation(&e, inverse);
    free(numbers);
    if (status)
        free(inverse);
    else
        *G = inverse;
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the equation of the stages", FVI_ENOMEM);
    return status;
}
