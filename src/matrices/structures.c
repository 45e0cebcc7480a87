/* src/matrices/structures.c -- Systems with sparse matrices M, K and C.             [H 27] */
#include "structure.h"

#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- functions of fvi_matrices ---- */

static int stiffness(size_t d, const double *x, const void *params, double *y)
{
    const fvi_structure *s = params;
    (void)d;
    fvi_sparse_multiply(s->K, x, y);
    return FVI_SUCCESS;
}

static int inertia(size_t d, const double *x, const void *params, double *y)
{
    const fvi_structure *s = params;
    (void)d;
    fvi_sparse_multiply(s->M, x, y);
    return FVI_SUCCESS;
}

/* Compute A = m M + sum_j c_j C_j + k K. c = NULL stands for zeros. The matrices and the factors are in one block. */
static int add_matrices(const fvi_structure *s, double m, const double *c, double k, fvi_sparse *A)
{
    const size_t count = fvi_structure_term_count(s);
    const fvi_sparse **term = malloc(count * (sizeof *term + sizeof(double)));
    if (!term)
        return FVI_ENOMEM;
    double *factor = (double *)(term + count);
    for (size_t l = 0; l < count; l++) {
        term[l] = fvi_structure_term(s, l);
        factor[l] = l == 0 ? m : l == count - 1 ? k : c ? c[l - 1] : 0;
    }
    const int status = fvi_sparse_add(count, term, factor, A);
    free(term);
    return status;
}

static int factorise(size_t d, double m, const double *c, double k, const void *params, void **factors)
{
    fvi_sparse A;
    fvi_factors *f = NULL;
    (void)d;
    int status = add_matrices(params, m, c, k, &A);
    if (!status)
        status = fvi_factors_alloc(fvi_choose_factorisation(&A), &A, &f);
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

static void free_factors(void *factors)
{
    fvi_factors_free(factors);
}

/* The factors contain their workspace, so only one thread at a time may call this function. */
static int energy(size_t d, const double *x, const double *p,
                  const void *params, double *E)
{
    const fvi_structure *s = params;
    double *y = malloc(2 * d * sizeof *y), sum = 0;
    if (!y)
        return FVI_ENOMEM;
    double *v = y + d;
    fvi_sparse_multiply(s->K, x, y);
    memcpy(v, p, d * sizeof *v);
    int status = fvi_factors_solve(s->by_mass, v);
    for (size_t i = 0; i < d; i++)
        sum += p[i] * v[i] + x[i] * y[i];
    free(y);
    if (!status)
        *E = sum / 2;
    return status;
}

/* ---- allocation ---- */

static int check_mass(fvi_structure *s)
{
    const size_t d = s->M->n;
    for (size_t i = 0; i < d; i++) {
        s->mass[i] = fvi_sparse_entry(s->M, i, i);
        s->damping[i] = s->C ? fvi_sparse_entry(s->C, i, i) : 0;
        if (!(s->mass[i] > 0))
            return FVI_EDOM;
    }
    void *factors = NULL;
    int status = factorise(d, 1, NULL, 0, s, &factors);
    if (!status)
        s->by_mass = factors;
    return status;
}

/* Return a code, and write the name of the matrix that caused it to *fault. */
static int check_matrices(fvi_structure *s, char *fault)
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
        status = check_mass(s);
    }
    if (!status) {
        *fault = 'C';
        status = fvi_history_space_find(s->M, s->C, &s->B);
        s->matrices.damping = fvi_structure_damping_functions(&s->B);
    }
    if (!status)
        *fault = 0;
    return status;
}

/* Allocate the parts that do not depend on the dampers. */
static int make_structure(const fvi_sparse *M, const fvi_sparse *K, fvi_structure **structure)
{
    fvi_structure *s = calloc(1, sizeof *s);
    double *block = malloc(2 * M->n * sizeof *block);
    if (!s || !block) {
        free(s);
        free(block);
        FVI_FAIL("no memory for the structure", FVI_ENOMEM);
    }
    *s = (fvi_structure){
        .M = M, .K = K, .mass = block, .damping = block + M->n
    };
    s->matrices = (fvi_matrices){ .stiffness = stiffness,
                                  .inertia = inertia,
                                  .factorise = factorise,
                                  .solve = solve,
                                  .free_factors = free_factors,
                                  .energy = energy,
                                  .params = s,
                                  .M = M,
                                  .K = K };
    fvi_structure_add_complex(s);
    *structure = s;
    return FVI_SUCCESS;
}

int fvi_structure_alloc(const fvi_sparse *M, const fvi_sparse *K,
                        const fvi_sparse *C, fvi_structure **structure,
                        char *fault)
{
    char nowhere;
    fvi_structure *s = NULL;
    if (!fault)
        fault = &nowhere;
    *fault = 0;
    if (!M || !K || !structure)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = make_structure(M, K, &s);
    if (status)
        return status;
    s->C = s->matrices.C = C;
    status = check_matrices(s, fault);
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

int fvi_structure_alloc_dampers(const fvi_sparse *M, const fvi_sparse *K, size_t count,
                                const fvi_damper *damper, fvi_structure **structure,
                                fvi_error *error)
{
    char fault;
    fvi_structure *s = NULL;
    if (!M || !K || !damper || !structure)
        return fvi_fail(error, FVI_EFAULT, "structure", NAN, "null pointer");
    if (count == 0)
        return fvi_fail(error, FVI_EINVAL, "damper", 0, "a list of no dampers");
    int status = fvi_structure_alloc(M, K, NULL, &s, &fault);
    if (status)
        return fvi_fail(error, status, fault == 'K' ? "K" : "M", NAN, "%s",
                        status == FVI_EINVAL   ? "not of the size of M"
                        : status == FVI_ENOMEM ? "no memory for it"
                        : fault == 'K'         ? "not symmetric"
                                               : "not symmetric and positive definite");
    status = fvi_structure_add_dampers(s, count, damper, error);
    if (status)
        fvi_structure_free(s);
    else
        *structure = s;
    return status;
}

/* ---- use of a structure ---- */

fvi_system fvi_structure_system(const fvi_structure *s)
{
    return (fvi_system){ .d = s->M->n,
                         .mass = s->mass,
                         .damping = s->damping,
                         .matrices = &s->matrices,
                         .mechanism = s->space ? &s->mechanism : NULL };
}

/* The factors have no simple ratio, so that no entry cancels, for example if M is 1 and K is -1. */
static int sum_pattern(const fvi_structure *s, double m, double c, double k, fvi_sparse *A)
{
    const size_t count = fvi_structure_term_count(s);
    double *each = malloc(count * sizeof *each);
    if (!each)
        return FVI_ENOMEM;
    for (size_t j = 0; j < count; j++)
        each[j] = c * sqrt(2 + (double)j / 7);
    const int status = add_matrices(s, m, each, k * sqrt(3), A);
    free(each);
    return status;
}

const char *fvi_structure_solver_name(const fvi_structure *s, double m, double c,
                                 double k)
{
    static const char *const names[] = { "diagonal", "band", "CHOLMOD" };
    fvi_sparse A;
    if (sum_pattern(s, m, c, k, &A))
        return "";
    const fvi_factorisation factorisation = fvi_choose_factorisation(&A);
    fvi_sparse_free(&A);
    return names[factorisation];
}

void fvi_structure_free(fvi_structure *s)
{
    if (!s)
        return;
    fvi_structure_free_dampers(s);
    fvi_factors_free(s->by_mass);
    fvi_history_space_free(&s->B);
    free(s->mass);
    free(s);
}
