/* src/stages/stage_solver.c -- Solve the equation of all stages of a structure.     [H 27] */
#include "stage_solver.h"

#include "lobatto_eigenvalues.h"
#include "stage_dense.h"
#include "system/dense.h"
#include "system/fail.h"
#include "system/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct fvi_stage_solver {
    const fvi_matrices *matrices;
    const fvi_lobatto_rule *rule;
    /* number of eigenvalues; number of real ones: 1 for an odd s, where the real one comes first, else 0 */
    size_t s, d, pairs, real;
    double h;
    fvi_lobatto_pair pair[FVI_STAGES / 2];
    void *of_real, *factors; /* factors for the real eigenvalue; factors for all other eigenvalues together */
    /* at stage i: h w_i of each complex pair, first the real parts, then the imaginary parts */
    double in[FVI_STAGES][FVI_STAGES];
    double re[FVI_STAGES / 2][FVI_STAGES], im[FVI_STAGES / 2][FVI_STAGES]; /* v of each complex pair */
    double *inverse; /* the inverse of stage_dense.h; NULL if there are factors */
    double room[];   /* workspace: 2 d numbers for each pair; with an inverse s d numbers, rounded up */
};

/* Return w^T W v, the value of the function W of A^{-1} at an eigenvalue. */
static double complex value_at(const fvi_stage_solver *o, size_t l, const double *W)
{
    const double complex *v = o->pair[l].v;
    double complex sum = 0;
    for (size_t i = 0; i < o->s; i++)
        for (size_t c = 0; c < o->s; c++)
            sum += o->rule->b[i] * v[o->s - 1 - i] * W[i * o->s + c] * v[c];
    return sum;
}

//> factors
/* Write the factors of M, the C_j and K in Z of pair l to c. Return their number. */
static size_t numbers_of(const fvi_stage_solver *o, size_t l, const double *const *W, double complex *c)
{
    const size_t count = o->matrices->damper_count > 0 ? o->matrices->damper_count : 1;
    const double complex lambda = o->pair[l].lambda;
    c[0] = lambda;
    for (size_t j = 0; j < count; j++)
        c[1 + j] = W[j] ? o->h * value_at(o, l, W[j]) : 0;
    c[count + 1] = o->h * o->h / lambda;
    return count + 2;
}
//< factors

static int factorise_real(fvi_stage_solver *o, const double *const *W, double complex *c)
{
    const fvi_matrices *m = o->matrices;
    const size_t count = numbers_of(o, 0, W, c);
    double *re = (double *)c; /* the real parts are written to the same memory, one after another */
    for (size_t j = 0; j < count; j++)
        re[j] = creal(c[j]);
    return m->factorise(o->d, re[0], re + 1, re[count - 1], m->params, &o->of_real);
}

/* Factorise Z of all pairs. */
static int factorise_pairs(fvi_stage_solver *o, const double *const *W)
{
    const fvi_matrices *m = o->matrices;
    double complex *c = calloc(o->pairs * (m->damper_count + 3), sizeof *c), *next = c;
    if (!c)
        return FVI_ENOMEM;
    int status = o->real ? factorise_real(o, W, c) : FVI_SUCCESS;
    for (size_t l = o->real; l < o->pairs; l++)
        next += numbers_of(o, l, W, next);
    if (!status && o->pairs > o->real)
        status = m->factorise_complex(o->d, o->pairs - o->real, (double *)c, m->params, &o->factors);
    free(c);
    return status;
}

/* Store the vectors w and v in the order in which the loops over all pairs read them. */
static void list_vectors(fvi_stage_solver *o)
{
    const size_t count = o->pairs - o->real;
    for (size_t l = 0; l < count; l++) {
        const double complex *v = o->pair[o->real + l].v;
        for (size_t i = 0; i < o->s; i++) {
            const double complex w = o->h * o->rule->b[i] * v[o->s - 1 - i];
            o->in[i][l] = creal(w);
            o->in[i][count + l] = cimag(w);
            o->re[l][i] = creal(v[i]);
            o->im[l][i] = cimag(v[i]);
        }
    }
}

int fvi_stage_solver_alloc(const fvi_matrices *matrices, size_t d, size_t s, double h,
                           const double *const *W, fvi_stage_solver_kind kind, fvi_stage_solver **solver)
{
    const int is_dense = kind == FVI_STAGE_AUTO && d <= FVI_STAGE_DENSE / s;
    const size_t room = is_dense ? fvi_dense_rows(s * d) : (s + 1) * d;
    fvi_stage_solver *o = calloc(1, sizeof *o + room * sizeof *o->room);
    int status = o ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status) {
        o->matrices = matrices;
        o->rule = fvi_lobatto(s);
        o->s = s;
        o->d = d;
        o->h = h;
        o->pairs = is_dense ? 0 : fvi_lobatto_eigenvalues(s, o->pair);
        o->real = o->pairs > 0 && cimag(o->pair[0].lambda) == 0;
        list_vectors(o);
    }
    if (!status && is_dense)
        status = fvi_stage_dense(matrices, d, s, h, W, &o->inverse);
    else if (!status)
        status = factorise_pairs(o, W);
    if (status)
        fvi_stage_solver_free(o);
    else
        *solver = o;
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the factors of the stages", FVI_ENOMEM);
    return status;
}

/* Write w^T h load of `count` pairs to r: for each unknown first the real parts, then the imaginary parts. The compiler
 * knows `count`. */
static inline __attribute__((always_inline)) void
project_load(size_t count, const fvi_stage_solver *o, const double *restrict load, double *restrict r)
{
    const size_t d = o->d;
    for (size_t j = 0; j < d; j++) {
        double sum[FVI_STAGES] = { 0 };
        for (size_t i = 0; i < o->s; i++)
#pragma omp simd
            for (size_t l = 0; l < 2 * count; l++)
                sum[l] += o->in[i][l] * load[i * d + j];
        for (size_t l = 0; l < 2 * count; l++)
            r[2 * count * j + l] = sum[l];
    }
}

/* Add v z and its conjugate to delta for all pairs; r holds z. */
static inline __attribute__((always_inline)) void
add_pair_solutions(size_t count, const fvi_stage_solver *o, const double *restrict r, double *restrict delta)
{
    const size_t d = o->d;
    for (size_t j = 0; j < d; j++) {
        double sum[FVI_STAGES] = { 0 };
        for (size_t i = 0; o->real && i < o->s; i++)
            sum[i] = delta[i * d + j];
        for (size_t l = 0; l < count; l++) {
            const double re = r[2 * count * j + l], im = r[2 * count * j + count + l];
#pragma omp simd
            for (size_t i = 0; i < FVI_STAGES; i++)
                sum[i] += 2 * (o->re[l][i] * re - o->im[l][i] * im);
        }
        for (size_t i = 0; i < o->s; i++)
            delta[i * d + j] = sum[i];
    }
}

FVI_VECTORS static void collect_load(const fvi_stage_solver *o, const double *load, double *r)
{
    if (o->pairs - o->real == FVI_STAGES / 2)
        project_load(FVI_STAGES / 2, o, load, r);
    else
        project_load(o->pairs - o->real, o, load, r);
}

FVI_VECTORS static void spread_pairs(const fvi_stage_solver *o, const double *r, double *delta)
{
    if (o->pairs - o->real == FVI_STAGES / 2)
        add_pair_solutions(FVI_STAGES / 2, o, r, delta);
    else
        add_pair_solutions(o->pairs - o->real, o, r, delta);
}

/* Write the contribution of the real pair to delta. */
static int add_real(fvi_stage_solver *o, const double *load, double *delta)
{
    const double complex *v = o->pair[0].v;
    const size_t d = o->d;
    double *r = o->room;
    memset(r, 0, d * sizeof *r);
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < d; j++)
            r[j] += o->h * o->rule->b[i] * creal(v[o->s - 1 - i]) * load[i * d + j];
    const int status = o->matrices->solve(d, o->of_real, r);
    for (size_t i = 0; i < o->s; i++)
        for (size_t j = 0; j < d; j++)
            delta[i * d + j] = creal(v[i]) * r[j];
    return status;
}

//> pairs
/* Compute delta = sum over the pairs of v Z^{-1} w^T h load, plus the conjugates. (27.14) */
static int solve_pairs(fvi_stage_solver *o, const double *load, double *delta)
{
    const size_t complex_pairs = o->pairs - o->real;
    int status = o->real ? add_real(o, load, delta) : FVI_SUCCESS;
    collect_load(o, load, o->room);
    if (!status && complex_pairs > 0)
        status = o->matrices->solve_complex(o->d, complex_pairs, o->factors, o->room);
    if (!status)
        spread_pairs(o, o->room, delta);
    return status;
}
//< pairs

int fvi_stage_solver_solve(fvi_stage_solver *o, const double *load, double *delta)
{
    const size_t n = o->s * o->d;
    if (!o->inverse)
        return solve_pairs(o, load, delta);
    fvi_dense_multiply(fvi_dense_rows(n), n, o->inverse, load, o->room);
    memcpy(delta, o->room, n * sizeof *delta);
    return FVI_SUCCESS;
}

int fvi_stage_solver_filter(fvi_stage_solver *o, const double *load, double *size)
{
    const double factor = o->h * cabs(o->pair[0].lambda);
    for (size_t j = 0; j < o->d; j++) {
        o->room[2 * j] = factor * load[j];
        o->room[2 * j + 1] = 0;
    }
    const int status = o->matrices->solve_complex(o->d, 1, o->factors, o->room);
    for (size_t j = 0; !status && j < o->d; j++)
        size[j] = hypot(o->room[2 * j], o->room[2 * j + 1]);
    return status;
}

void fvi_stage_solver_free(fvi_stage_solver *o)
{
    if (o && o->of_real)
        o->matrices->free_factors(o->of_real);
    if (o && o->factors)
        o->matrices->free_complex_factors(o->factors);
    if (o)
        free(o->inverse);
    free(o);
}
