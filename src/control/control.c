/* src/control/control.c -- Find the least force that takes a run from a start to a given end. [H 25]
 *
 * The unknown is u, an additional force at each node. Each iteration makes one run with the force F + u, and 2 d
 * adjoint runs, which give the derivatives of the end of the run by u. Linear equations of size 2 d (25.4) then give
 * the next u. While u changes by much, the step towards the next u is halved until the merit function (25.5) falls.
 * Once u changes by little, Anderson's mixing of the last iterations speeds up the convergence. */
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
#define NEAR 0.1 /* The iteration mixes (mix) once the relative change of u is below this number. */

/* One problem and the state of its iteration. rows = (N + 1) d is the size of u. */
typedef struct {
    const fvi_method *method;
    fvi_system system; /* the system of the run, with the force F + u */
    fvi_force given;   /* F, the force of the caller's system */
    fvi_run run;
    size_t d, rows, ends; /* 2 d: so many numbers are prescribed at t_N */
    const double *wanted_x, *wanted_p;
    const double *driving;   /* the u that force_with_control adds to F; not owned */
    double *x, *p;           /* the trajectory of the last run */
    double *trial, *next;    /* a trial u of the line search; the u to which the iteration leads */
    double *a;               /* the derivatives of x_N and p_N by the force: 2 d rows of `rows` numbers */
    double *gram, *nu, *gap; /* the unknowns of (25.3): 2 d by 2 d, 2 d, 2 d numbers */
    double *r, *g;           /* next - u and next, of the iteration before */
    double *dr, *dg;         /* the last DEPTH changes of r and of g; rings */
    size_t known;            /* how many changes have been stored so far */
    double *block;           /* the memory of all arrays above but those of the caller; owned */
} problem;

/* F(t) + u_k, where k is the node nearest to t. The force of the run: `params` is the problem. */
static int force_with_control(double t, size_t d, void *params, double *F)
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

/* ---- the run with u, and the distance of its end from the prescribed end ---- */

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

/* The merit function (25.5). `price` must exceed the largest |nu_i|. */
static double merit(const problem *o, const double *u, double price)
{
    double miss = 0;
    for (size_t i = 0; i < o->ends; i++)
        miss += fabs(o->gap[i]);
    return cost_of(o, u) + price * miss;
}

/* ---- the conditions ---- */

/* An objective J that is one number of the end: x_N,i for params = i < d, and p_N,i for params = d + i. */
static int end_number_slopes(size_t k, size_t d, const double *x, const double *p,
                             void *params, double *Jx, double *Jp)
{
    const size_t i = *(const size_t *)params;
    (void)k, (void)x;
    if (p)
        (i < d ? Jx : Jp)[i % d] = 1;
    return FVI_SUCCESS;
}

//> adjoint-runs
/* a_i = d(x_N, p_N)_i / dF: one adjoint run for each of the 2 d numbers of the end. */
static int adjoint_runs(problem *o)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < o->ends && !status; i++) {
        const fvi_objective end = { .slopes = end_number_slopes, .params = &i };
        const fvi_sensitivities by = { .force = o->a + i * o->rows };
        status = fvi_adjoint(o->method, &o->run, o->x, o->p + o->rows - o->d,
                             &end, &by);
    }
    return status;
}
//< adjoint-runs

/* Replace b by A^-1 b. A is n by n and is overwritten. Returns nonzero if A is not positive definite. */
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
/* Compute the least u' with gap + a (u' - u) = 0 into `next`. (25.4)
 *
 *     u' = -a^T nu / h,    (a a^T / h) nu = gap - a u */
static int find_least_control(problem *o, const double *u)
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

/* The largest |next_j - u_j| divided by the largest |next_j|. */
static double relative_change(const problem *o, const double *u)
{
    double far = 0, size = 0;
    for (size_t j = 0; j < o->rows; j++) {
        far = larger(far, fabs(o->next[j] - u[j]));
        size = larger(size, fabs(o->next[j]));
    }
    return far > 0 ? far / fmax(size, GSL_DBL_MIN) : 0;
}

//> go
/* Move u towards next. The step is halved until the merit function (25.5) falls; its slope along next - u is at most
 * -h |next - u|^2. If a run fails, the trial u was too far away, and the step is halved, too. */
static int search_along_change(problem *o, double *u, double *price)
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
/* Store the changes of next and of r = next - u since the iteration before, and keep both as the last ones. */
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

/* Anderson's mixing: replace next by next - sum_i gamma_i dg_i, where the gamma_i make |r - sum_i gamma_i dr_i| least.
 * The first stored change is left out, because no iteration was before it. */
static void mix_iterates(problem *o, const double *u)
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
        A[i * n + i] *= 1 + 1e-10; /* the changes may be nearly dependent */
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
            status = find_least_control(o, u);
        if (status)
            return status;
        found->iterations++;
        found->change = relative_change(o, u);
        if (found->change < 1e-12) {
            memcpy(u, o->next, o->rows * sizeof *u);
            return run_with(o, u);
        }
        if (found->change < NEAR && found->change < 2 * before) {
            mix_iterates(o, u);
            memcpy(u, o->next, o->rows * sizeof *u);
            status = run_with(o, u);
        } else {
            o->known = 0;
            status = search_along_change(o, u, &price);
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
    o.system.force.value = force_with_control; /* its impulses stay */
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
