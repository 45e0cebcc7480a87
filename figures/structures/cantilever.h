/* figures/structures/cantilever.h -- A beam, clamped at one end, by n equal elements.         [H 27]
 *
 * Length, bending stiffness and mass per length are 1. Each node has two unknowns, the deflection w and the
 * slope times the length of an element; the clamped node has no unknowns. Between two nodes the deflection is a
 * cubic polynomial, and the matrices of an element are integrals of the four cubic shape functions, (27.6). */
#ifndef CANTILEVER_H
#define CANTILEVER_H

#include <fvi/structures.h>
#include <stdlib.h>
#include <string.h>

//> element
/* int w''^2 = k^T bending k / l^3 and int w^2 = l k^T inertia k / 420, k = (w_1, s_1, w_2, s_2) */
static const double bending[4][4] = {
    { 12, 6, -12, 6 }, { 6, 4, -6, 2 }, { -12, -6, 12, -6 }, { 6, 2, -6, 4 }
};
static const double inertia[4][4] = { { 156, 22, 54, -13 },
                                      { 22, 4, 13, -3 },
                                      { 54, 13, 156, -22 },
                                      { -13, -3, -22, 4 } };
//< element

//> assemble
/* Assemble A, the sum of an element's matrix times `factor` over n elements in a row, clamped at the left end.
 * Returns the code of fvi_sparse_assemble. */
static inline int cantilever_sum(int n, const double element[4][4],
                                 double factor, fvi_sparse *A)
{
    fvi_triplet *list = malloc(16 * (size_t)n * sizeof *list);
    size_t count = 0;
    for (int e = 0; list && e < n; e++)
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++) {
                const int row = 2 * e + i - 2, column = 2 * e + j - 2;
                if (row >= 0 && column >= 0) /* the clamped node has no unknowns */
                    list[count++] =
                        (fvi_triplet){ row, column, factor * element[i][j] };
            }
    int status = fvi_sparse_assemble(2 * (size_t)n, count, list, A);
    free(list);
    return status;
}

/* Assemble M, K and C = tau K of n elements. There are 2 n unknowns, and the tip's deflection is number 2 n - 2. */
static inline int cantilever(int n, double tau, fvi_sparse *M, fvi_sparse *K,
                             fvi_sparse *C)
{
    const double l = 1 / (double)n, stiff = 1 / (l * l * l);
    int status = cantilever_sum(n, inertia, l / 420, M);
    if (!status)
        status = cantilever_sum(n, bending, stiff, K);
    if (!status)
        status = cantilever_sum(n, bending, tau * stiff, C);
    return status;
}
//< assemble

/* The same beam with the products K x and C z computed element by element. The assembled matrix would subtract
 * forces that are n^2 times as large as their difference, and so lose digits. */
typedef struct {
    int n;
    double tau;
    const fvi_matrices *assembled; /* for the factorisations */
} beam;

//> product
/* y += a K x. The forces of an element depend on two differences alone: how far its ends have moved apart beyond
 * their mean slope, and how much the slopes differ. The code computes these differences first. */
static inline void beam_add(const beam *b, double a, const double *x, double *y)
{
    const double l = 1 / (double)b->n, stiff = a / (l * l * l);
    double w = 0, s = 0; /* deflection and slope at the left end of the element; 0 at the clamped node */
    for (int e = 0; e < b->n; e++) {
        const double *right = x + 2 * e,
                     shear = stiff * (w - right[0] + (s + right[1]) / 2),
                     bend = stiff * (s - right[1]);
        if (e > 0) {
            y[2 * e - 2] += 12 * shear;
            y[2 * e - 1] += 6 * shear + bend;
        }
        y[2 * e] -= 12 * shear;
        y[2 * e + 1] += 6 * shear - bend;
        w = right[0];
        s = right[1];
    }
}
//< product

static inline int beam_stiffness(size_t d, const double *x, const void *params,
                                 double *y)
{
    memset(y, 0, d * sizeof *y);
    beam_add(params, 1, x, y);
    return 0;
}

static inline int beam_select_history(size_t d, const double *x, const double *from,
                                      const void *params, double *z)
{
    (void)params;
    for (size_t i = 0; i < d; i++)
        z[i] = x[i] - from[i];
    return 0;
}

static inline int beam_apply_damping(size_t d, double a, const double *z,
                                     const void *params, double *p)
{
    const beam *b = params;
    (void)d;
    beam_add(b, -a * b->tau, z, p);
    return 0;
}

static inline int beam_factorise(size_t d, double m, const double *c, double k,
                                 const void *params, void **factors)
{
    const fvi_matrices *from = ((const beam *)params)->assembled;
    return from->factorise(d, m, c, k, from->params, factors);
}

/* Return the beam as matrices for a system. b must outlive the result. */
static inline fvi_matrices beam_matrices(const beam *b)
{
    return (fvi_matrices){ .damping = { .history_size = 2 * (size_t)b->n,
                                        .select_history = beam_select_history,
                                        .apply_damping = beam_apply_damping,
                                        .params = b },
                           .stiffness = beam_stiffness,
                           .factorise = beam_factorise,
                           .solve = b->assembled->solve,
                           .free_factors = b->assembled->free_factors,
                           .params = b };
}

#endif
