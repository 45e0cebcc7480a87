/* src/control/control.c -- From here to there with the least force.  [H 25] */
#include <fvi/control.h>
#include "run/whole_run.h"

#include <fvi/adjoint.h>
#include "system/arrays.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/system_check.h"
#include "system/larger.h"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ITERATIONS = 200, HALVES = 40, DEPTH = 6 };
#define NEAR 0.1 /* a change of u from which on iterations are mixed */

/* One problem, and where its iteration is. rows = (N + 1) d. */
typedef struct {
    const fvi_method *method;
    fvi_system system; /* with the force F + u */
    fvi_force given;   /* F */
    fvi_run run;
    size_t d, rows, ends; /* 2 d numbers are given at the end */
    const double *wanted_x, *wanted_p;
    const double *driving;   /* the u that the force adds */
    double *x, *p;           /* the run with it */
    double *trial, *next;    /* u between, and where the iteration leads */
    double *a;               /* d(x_N, p_N)/dF, one behind the other */
    double *gram, *nu, *gap; /* (25.3): 2 d square, 2 d, 2 d */
    double *r, *g;           /* next - u, and next, of the iteration before */
    double *dr, *dg;         /* their last DEPTH changes, rings */
    size_t known;            /* how many there were */
    double *block;           /* all of these; owned */
} problem;

/* F(t) + u_k at the node nearest to t. */
static int driven(double t, size_t d, void *params, double *F)
{
    const problem *o = params;
    const size_t k = (size_t)(t / o->run.h + 0.5);
    for (size_t i = 0; i < d; i++)
        F[i] = 0;
    int status =
        o->given.value ? o->given.value(t, d, o->given.params, F) : FVI_SUCCESS;
    for (size_t i = 0; i < d; i++)
        F[i] += o->driving[k * d + i];
    return status;
}

static int allocate(problem *o)
{
    const size_t n = o->ends;
    const double room = (double)o->rows * (double)(6 + 2 * DEPTH + n)
                        + (double)n * (double)(n + 2);
    if (room > (double)(SIZE_MAX / sizeof(double) / 2))
        FVI_FAIL("so many steps cannot be addressed", FVI_EINVAL);
    o->block = FVI_ARRAYS({ &o->x, o->rows }, { &o->p, o->rows }, { &o->trial, o->rows }, { &o->next, o->rows },
                          { &o->a, n * o->rows }, { &o->gram, n * n }, { &o->nu, n }, { &o->gap, n },
                          { &o->r, o->rows }, { &o->g, o->rows }, { &o->dr, DEPTH * o->rows },
                          { &o->dg, DEPTH * o->rows });
    if (!o->block)
        FVI_FAIL("no memory for the control", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* ---- the run with u, and how far from its aim it ends ---- */

static int run_with(problem *o, const double *u)
{
    const size_t last = o->rows - o->d;
    o->driving = u;
    int status = fvi_trajectory(o->method, &o->run, o->x, o->p, NULL);
    for (size_t i = 0; i < o->d; i++) {
        o->gap[i] = o->x[last + i] - o->wanted_x[i];
        o->gap[o->d + i] = o->p[last + i] - o->wanted_p[i];
    }
    return status;
}

static double cost_of(const problem *o, const double *u)
{
    return o->run.h / 2 * fvi_dot(o->rows, u, u);
}

/* (25.5), with prices above all nu. */
static double merit(const problem *o, const double *u, double price)
{
    double miss = 0;
    for (size_t i = 0; i < o->ends; i++)
        miss += fabs(o->gap[i]);
    return cost_of(o, u) + price * miss;
}

/* ---- the conditions ---- */

/* J = x_N,i or p_N,i: params is i, or d + i. */
static int one_end(size_t k, size_t d, const double *x, const double *p,
                   void *params, double *Jx, double *Jp)
{
    const size_t i = *(const size_t *)params;
    (void)k, (void)x;
    if (p)
        (i < d ? Jx : Jp)[i % d] = 1;
    return FVI_SUCCESS;
}

//> adjoint-runs
/* a_i = d(x_N, p_N)_i / dF: an adjoint run for each. */
static int adjoint_runs(problem *o)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < o->ends && !status; i++) {
        const fvi_objective end = { .slopes = one_end, .params = &i };
        const fvi_sensitivities by = { .force = o->a + i * o->rows };
        status = fvi_adjoint(o->method, &o->run, o->x, o->p + o->rows - o->d,
                             &end, &by);
    }
    return status;
}
//< adjoint-runs

/* b becomes A^-1 b; A is n by n, and lost. Nonzero if it is not positive definite. */
static int solve(size_t n, double *A, double *b)
{
    gsl_matrix_view matrix = gsl_matrix_view_array(A, n, n);
    gsl_vector_view vector = gsl_vector_view_array(b, n);
    fvi_quiet();
    int status = gsl_linalg_cholesky_decomp1(&matrix.matrix);
    fvi_loud();
    if (!status)
        gsl_linalg_cholesky_svx(&matrix.matrix, &vector.vector);
    return status;
}

//> least
/* (25.4): the least u' with gap + a (u' - u) = 0: u' = -a^T nu / h, and
 * (a a^T / h) nu = gap - a u. */
static int least(problem *o, const double *u)
{
    const size_t n = o->ends;
    for (size_t i = 0; i < n; i++) {
        const double *a = o->a + i * o->rows;
        o->nu[i] = o->gap[i] - fvi_dot(o->rows, a, u);
        for (size_t j = 0; j <= i; j++)
            o->gram[i * n + j] = o->gram[j * n + i] =
                fvi_dot(o->rows, a, o->a + j * o->rows) / o->run.h;
    }
    if (solve(n, o->gram, o->nu))
        return FVI_ESING;
    for (size_t j = 0; j < o->rows; j++) {
        o->next[j] = 0;
        for (size_t i = 0; i < n; i++)
            o->next[j] -= o->a[i * o->rows + j] * o->nu[i] / o->run.h;
    }
    return FVI_SUCCESS;
}
//< least

/* ---- the iteration ---- */

/* The largest |next - u|, relative to the largest |next|. */
static double change_of(const problem *o, const double *u)
{
    double far = 0, size = 0;
    for (size_t j = 0; j < o->rows; j++) {
        far = larger(far, fabs(o->next[j] - u[j]));
        size = larger(size, fabs(o->next[j]));
    }
    return far > 0 ? far / fmax(size, GSL_DBL_MIN) : 0;
}

//> go
/* u moves towards next, by half as much as long as (25.5) does not fall: its slope is
 * -h |next - u|^2 or steeper. A run that ends in an error is too far away. */
static int go(problem *o, double *u, double *price)
{
    double slope = 0;
    *price = larger(*price, 1.5 * largest_abs(o->ends, o->nu));
    const double before = merit(o, u, *price);
    for (size_t j = 0; j < o->rows; j++)
        slope -= o->run.h * gsl_pow_2(o->next[j] - u[j]);
    double share = 1;
    for (int i = 0; i < HALVES; i++, share /= 2) {
        for (size_t j = 0; j < o->rows; j++)
            o->trial[j] = u[j] + share * (o->next[j] - u[j]);
        int status = run_with(o, o->trial);
        const double room = 16 * GSL_DBL_EPSILON * before;
        if (!status
            && merit(o, o->trial, *price)
                   <= before + 1e-4 * share * slope + room) {
            memcpy(u, o->trial, o->rows * sizeof *u);
            return FVI_SUCCESS;
        }
    }
    return FVI_EMAXITER;
}
//< go

//> mix
/* The changes of next and of r = next - u since the iteration before; both are kept. */
static void store_control(problem *o, const double *u)
{
    const size_t at = o->known++ % DEPTH * o->rows;
    for (size_t j = 0; j < o->rows; j++) {
        const double r = o->next[j] - u[j];
        o->dr[at + j] = r - o->r[j];
        o->dg[at + j] = o->next[j] - o->g[j];
        o->r[j] = r;
        o->g[j] = o->next[j];
    }
}

/* Anderson's mixture: next becomes next - sum_i gamma_i dg_i, with the gamma for which
 * r - sum_i gamma_i dr_i is least. The first change is from nowhere, and left out. */
static void mix(problem *o, const double *u)
{
    store_control(o, u);
    const size_t R = o->rows, last = o->known - 1,
                 n = last < DEPTH ? last : DEPTH;
    double A[DEPTH * DEPTH], gamma[DEPTH];
    if (n == 0)
        return;
    for (size_t i = 0; i < n; i++) {
        const double *dr = o->dr + (last - i) % DEPTH * R;
        gamma[i] = fvi_dot(R, dr, o->r);
        for (size_t l = 0; l <= i; l++)
            A[i * n + l] = A[l * n + i] =
                fvi_dot(R, dr, o->dr + (last - l) % DEPTH * R);
        A[i * n + i] *= 1 + 1e-10; /* they may be nearly dependent */
    }
    if (solve(n, A, gamma))
        return;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < R; j++)
            o->next[j] -= gamma[i] * o->dg[(last - i) % DEPTH * R + j];
}
//< mix

static int iterate(problem *o, double *u, fvi_control_result *found)
{
    double price = 0, before = GSL_POSINF;
    int status = run_with(o, u);
    while (!status && found->iterations < ITERATIONS) {
        status = adjoint_runs(o);
        if (!status)
            status = least(o, u);
        if (status)
            return status;
        found->iterations++;
        found->change = change_of(o, u);
        if (found->change < 1e-12) {
            memcpy(u, o->next, o->rows * sizeof *u);
            return run_with(o, u);
        }
        if (found->change < NEAR && found->change < 2 * before) {
            mix(o, u);
            memcpy(u, o->next, o->rows * sizeof *u);
            status = run_with(o, u);
        } else {
            o->known = 0;
            status = go(o, u, &price);
        }
        before = found->change;
    }
    return status ? status : FVI_EMAXITER;
}

static int check(const fvi_method *method, const fvi_run *run, const double *x,
                 const double *p, const double *u, const fvi_control_result *found)
{
    if (!method || !run || !x || !p || !u || !found)
        FVI_FAIL("null pointer", FVI_EFAULT);
    int status = fvi_system_require(run->system);
    if (status)
        return status;
    if (run->steps < 2)
        FVI_FAIL("a control has at least two steps", FVI_EINVAL);
    if (!fvi_all_finite(run->system->d, x)
        || !fvi_all_finite(run->system->d, p))
        FVI_FAIL("the end must be finite", FVI_EDOM);
    return FVI_SUCCESS;
}

int fvi_control_solve(const fvi_method *method, const fvi_run *run, const double *x,
                const double *p, double *u, fvi_control_result *found)
{
    int status = check(method, run, x, p, u, found);
    if (status)
        return status;
    problem o = { .method = method,
                  .system = *run->system,
                  .given = run->system->force,
                  .run = *run,
                  .d = run->system->d,
                  .rows = (run->steps + 1) * run->system->d,
                  .ends = 2 * run->system->d,
                  .wanted_x = x,
                  .wanted_p = p };
    o.system.force.value = driven; /* its impulses stay */
    o.system.force.bound = NULL;
    o.system.force.params = &o;
    o.run.system = &o.system;
    *found = (fvi_control_result){ .iterations = 0 };
    status = allocate(&o);
    if (!status)
        status = iterate(&o, u, found);
    if (!status || status == FVI_EMAXITER) {
        found->cost = cost_of(&o, u);
        found->miss = largest_abs(o.ends, o.gap);
        if (!isfinite(found->cost + found->miss) || !fvi_all_finite(o.rows, u))
            status = FVI_EOVRFLW;
    }
    free(o.block);
    return status;
}
