/* src/stages/stage_solver.c -- The equation of all stages of a structure.     [H 27] */
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
    size_t s, d, pairs;
    double h;
    fvi_lobatto_pair pair[FVI_STAGES / 2];
    void *factors[FVI_STAGES / 2];
    double *inverse; /* of stage_dense.h; or NULL, and there are factors */
    double room[];   /* 4 d; with an inverse s d, rounded up */
};

static int is_real(const fvi_lobatto_pair *pair)
{
    return cimag(pair->lambda) == 0;
}

/* w^T W v: what W, a function of A^{-1}, is at an eigenvalue. */
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
/* Z of pair l; c has room for its numbers before M, the C_j and K. */
static int factorise_pair(fvi_stage_solver *o, size_t l, const double *const *W,
                          double complex *c)
{
    const fvi_matrices *m = o->matrices;
    const size_t count = m->damper_count > 0 ? m->damper_count : 1;
    const double complex lambda = o->pair[l].lambda;
    c[0] = lambda;
    for (size_t j = 0; j < count; j++)
        c[1 + j] = W[j] ? o->h * value_at(o, l, W[j]) : 0;
    c[count + 1] = o->h * o->h / lambda;
    if (!is_real(&o->pair[l]))
        return m->factorise_complex(o->d, (double *)c, m->params, &o->factors[l]);
    double *re = (double *)c; /* the real parts, one after another */
    for (size_t j = 0; j < count + 2; j++)
        re[j] = creal(c[j]);
    return m->damper_count > 0
               ? m->factorise_dampers(o->d, re[0], re + 1, re[count + 1], m->params,
                                      &o->factors[l])
               : m->factorise(o->d, re[0], re[1], re[2], m->params, &o->factors[l]);
}
//< factors

int fvi_stage_solver_alloc(const fvi_matrices *matrices, size_t d, size_t s, double h,
                           const double *const *W, fvi_stage_way way, fvi_stage_solver **solver)
{
    const int is_dense = way == FVI_STAGE_AUTO && d <= FVI_STAGE_DENSE / s;
    const size_t room = is_dense ? fvi_dense_rows(s * d) : 4 * d;
    fvi_stage_solver *o = calloc(1, sizeof *o + room * sizeof *o->room);
    double complex *c = calloc(matrices->damper_count + 3, sizeof *c);
    int status = o && c ? FVI_SUCCESS : FVI_ENOMEM;
    if (!status) {
        o->matrices = matrices;
        o->rule = fvi_lobatto(s);
        o->s = s;
        o->d = d;
        o->h = h;
        o->pairs = is_dense ? 0 : fvi_lobatto_eigenvalues(s, o->pair);
    }
    if (!status && is_dense)
        status = fvi_stage_dense(matrices, d, s, h, W, &o->inverse);
    for (size_t l = 0; !status && l < o->pairs; l++)
        status = factorise_pair(o, l, W, c);
    free(c);
    if (status)
        fvi_stage_solver_free(o);
    else
        *solver = o;
    if (status == FVI_ENOMEM)
        FVI_FAIL("no memory for the factors of the stages", FVI_ENOMEM);
    return status;
}

/* re += a x and im += b x, d numbers each. */
FVI_VECTORS static void add_both(size_t d, double a, double b, const double *restrict x, double *restrict re,
                                 double *restrict im)
{
#pragma omp simd
    for (size_t j = 0; j < d; j++) {
        re[j] += a * x[j];
        im[j] += b * x[j];
    }
}

/* to += 2 Re (a + i b) (re + i im) */
FVI_VECTORS static void add_twice_the_real_part(size_t d, double a, double b, const double *restrict re,
                                                const double *restrict im, double *restrict to)
{
#pragma omp simd
    for (size_t j = 0; j < d; j++)
        to[j] += 2 * (a * re[j] - b * im[j]);
}

/* Z^{-1} w^T h load of pair l: re and im, or re alone. */
static int solve_pair(fvi_stage_solver *o, size_t l, const double *load, double *re, double *im)
{
    const size_t d = o->d;
    memset(re, 0, 2 * d * sizeof *re);
    for (size_t i = 0; i < o->s; i++) {
        const double complex w = o->h * o->rule->b[i] * o->pair[l].v[o->s - 1 - i];
        add_both(d, creal(w), cimag(w), load + i * d, re, im);
    }
    if (is_real(&o->pair[l]))
        return o->matrices->solve(d, o->factors[l], re);
    for (size_t j = 0; j < d; j++) {
        o->room[2 * j] = re[j];
        o->room[2 * j + 1] = im[j];
    }
    const int status = o->matrices->solve_complex(d, o->factors[l], o->room);
    for (size_t j = 0; j < d; j++) {
        re[j] = o->room[2 * j];
        im[j] = o->room[2 * j + 1];
    }
    return status;
}

//> one-pair
/* What pair l gives to delta: v Z^{-1} w^T h load, and its conjugate, too. (27.14) */
static int add_pair(fvi_stage_solver *o, size_t l, const double *load, double *delta)
{
    const fvi_lobatto_pair *pair = &o->pair[l];
    const size_t d = o->d;
    double *re = o->room + 2 * d, *im = re + d;
    const int status = solve_pair(o, l, load, re, im), is_alone = is_real(pair);
    for (size_t i = 0; !status && i < o->s; i++)
        if (is_alone)
            add_both(d, creal(pair->v[i]), 0, re, delta + i * d, im);
        else
            add_twice_the_real_part(d, creal(pair->v[i]), cimag(pair->v[i]), re, im, delta + i * d);
    return status;
}
//< one-pair

int fvi_stage_solver_solve(fvi_stage_solver *o, const double *load, double *delta)
{
    int status = FVI_SUCCESS;
    const size_t n = o->s * o->d;
    if (o->inverse) {
        fvi_dense_multiply(fvi_dense_rows(n), n, o->inverse, load, o->room);
        memcpy(delta, o->room, n * sizeof *delta);
        return FVI_SUCCESS;
    }
    memset(delta, 0, n * sizeof *delta);
    for (size_t l = 0; !status && l < o->pairs; l++)
        status = add_pair(o, l, load, delta);
    return status;
}

int fvi_stage_solver_filter(fvi_stage_solver *o, const double *load, double *size)
{
    const double factor = o->h * cabs(o->pair[0].lambda);
    for (size_t j = 0; j < o->d; j++) {
        o->room[2 * j] = factor * load[j];
        o->room[2 * j + 1] = 0;
    }
    const int status = o->matrices->solve_complex(o->d, o->factors[0], o->room);
    for (size_t j = 0; !status && j < o->d; j++)
        size[j] = hypot(o->room[2 * j], o->room[2 * j + 1]);
    return status;
}

void fvi_stage_solver_free(fvi_stage_solver *o)
{
    for (size_t l = 0; o && l < o->pairs; l++)
        if (o->factors[l] && is_real(&o->pair[l]))
            o->matrices->forget(o->factors[l]);
        else if (o->factors[l])
            o->matrices->forget_complex(o->factors[l]);
    if (o)
        free(o->inverse);
    free(o);
}
