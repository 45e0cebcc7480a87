/* tests/bench/peers/radau.c -- Radau IIA methods. [H 18]
 *
 * They solve x' = v and
 *
 *     m v' + rho D^{2 alpha} x + grad U(x) = F,
 *
 * with the damping by convolution quadrature with the same method: on uniform steps, and on steps that grow from
 * t = 0 and from a declared jump of F on. With alpha = 1/2 they are the methods for ordinary differential
 * equations. One mass is solved by Newton's method, more masses by the fixed-point iteration, if it contracts.
 * The publications are in the head of radau_memory.h. */
#include "radau_step.h"
#include "system/larger.h"

#include <stdlib.h>
#include <string.h>

/* ---- steps ---- */

/* Write the rows from t to t + h by the polynomial of V. r is the next row. Return the next row after them. */
static size_t write_rows(const radau_solver *o, double t, double h, size_t r,
                         double *rows)
{
    const double T = o->p->T, slack = 1e-12 * T;
    for (; r <= ROWS && T * (double)r / ROWS <= t + h + slack; r++) {
        const double z = smaller(1, (T * (double)r / ROWS - t) / h);
        for (size_t a = 0; a < o->d; a++) {
            const double *p = o->powers + a * (S + 1);
            double sum = 0;
            for (int n = o->s; n >= 1; n--)
                sum = z * (sum + p[n] / (n + 1));
            rows[r * o->d + a] = o->x[a] + h * z * (o->v[a] + sum);
        }
    }
    return r;
}

/* V - v = sum_n powers_n z^n. Extrapolate D for the next step. */
static void interpolate(radau_solver *o)
{
    for (size_t a = 0; a < o->d; a++)
        for (int n = 1; n <= o->s; n++) {
            double sum = 0;
            for (int j = 0; j < o->s; j++)
                sum += o->m->l[j][n] * o->D[(size_t)j * o->d + a];
            o->powers[a * (S + 1) + (size_t)n] = sum;
        }
}

static void extrapolate(radau_solver *o, double ratio)
{
    const double most = ratio > 3 ? 0 : 1; /* the extrapolation would be too far: begin with D = 0 */
    for (size_t a = 0; a < o->d; a++)
        for (int i = 0; i < o->s; i++) {
            const double z = 1 + ratio * o->m->c[i],
                         *p = o->powers + a * (S + 1);
            double sum = 0, one = 0;
            for (int n = o->s; n >= 1; n--) {
                sum = z * (sum + p[n]);
                one += p[n];
            }
            o->D[(size_t)i * o->d + a] = most * (sum - one);
        }
}

static int take_step(radau_solver *o, double t, size_t k, size_t *row,
                     double *rows)
{
    const size_t d = o->d, last = (size_t)(o->s - 1) * d;
    const double h = o->mesh[k].h;
    memset(o->H, 0, (size_t)o->s * d * sizeof *o->H);
    if (o->memory) {
        double least = h;
        for (size_t l = k + 1; l <= k + 4 && l < o->steps; l++)
            least = smaller(least, o->mesh[l].h);
        radau_memory_step(o->memory, h, least, o->mesh[k].on_lattice);
        radau_memory_history(o->memory, o->H);
    }
    int status = radau_solve(o, t, h);
    if (status)
        return status;
    interpolate(o);
    *row = write_rows(o, t, h, *row, rows);
    for (size_t i = 0; i < (size_t)o->s * d && o->memory; i++)
        o->V[i] = o->D[i] + (o->beta < 0 ? o->v[i % d] : 0);
    if (o->memory)
        radau_memory_push(o->memory, o->V);
    for (size_t a = 0; a < d; a++) {
        double sum = 0;
        for (int j = 0; j < o->s; j++)
            sum += o->m->A[o->s - 1][j] * o->D[(size_t)j * d + a];
        o->x[a] += h * (o->v[a] + sum);
        o->v[a] += o->D[last + a];
    }
    if (k + 1 < o->steps)
        extrapolate(o, o->mesh[k + 1].h / h);
    return FVI_SUCCESS;
}

/* Allocate one block for all numbers. */
static int allocate(radau_solver *o, size_t most)
{
    const size_t d = o->d, n = (size_t)o->s * d;
    o->x = calloc(3 * d + 5 * n + d * (S + 1), sizeof *o->x);
    o->mesh = malloc(most * sizeof *o->mesh);
    o->kind = calloc(d, sizeof *o->kind);
    if (!o->x || !o->mesh || !o->kind)
        return FVI_ENOMEM;
    o->v = o->x + d;
    o->room = o->v + d;
    o->H = o->room + d;
    o->X = o->H + n;
    o->D = o->X + n;
    o->G = o->D + n;
    o->V = o->G + n;
    o->powers = o->V + n;
    return FVI_SUCCESS;
}

/* Compute the start: x, v, and the coordinates that are alike. */
static int begin(radau_solver *o, double *rows)
{
    const fvi_system *system = &o->p->system;
    for (size_t a = 0; a < o->d; a++) {
        o->x[a] = rows[a] = o->p->x0[a];
        o->v[a] = o->p->p0[a] / system->mass[a];
        if (a > 0)
            o->kind[a] = o->kind[a - 1]
                         + (system->mass[a] != system->mass[a - 1]
                            || system->damping[a] != system->damping[a - 1]);
    }
    o->kinds = o->kind[o->d - 1] + 1;
    if (o->d == 1 && system->potential.quadratic
        && system->potential.quadratic(system->potential.params))
        return system->potential.hessian(1, o->x, system->potential.params,
                                         &o->curvature);
    return FVI_SUCCESS;
}

static int run(const task *of, int s, int grade, double *rows)
{
    const problem *p = of->p;
    const double L = radau_memory_spacing(of->tolerance), T = p->T,
                 tolerance = larger(of->tolerance, 1e-16),
                 power = p->past == FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE
                             ? 1 / (1 - 2 * p->alpha)
                             : 0.4;
    double longest = T / (double)of->N;
    radau_solver *o = calloc(1, sizeof *o);
    if (!o)
        return FVI_ENOMEM;
    *o = (radau_solver){
        .p = p, .m = radau_method(s), .d = p->system.d, .s = s
    };
    o->beta = 2 * p->alpha - 1;
    o->stop = larger(1e-15, tolerance / 10);
    const size_t most = grade ? 2 * of->N + 4000 : of->N;
    int status = allocate(o, most);
    if (!status)
        status = begin(o, rows);
    if (!status) {
        double least = longest, t = 0;
        size_t row = 1;
        if (grade)
            least = smaller(longest, 0.1 * pow(tolerance, power));
        o->steps = grade ? radau_graded(p, least, &longest, L, most, o->mesh)
                         : radau_uniform(p, of->N, o->mesh);
        for (size_t k = 0; k < o->steps; k++)
            least = smaller(least, o->mesh[k].h);
        radau_power(o->m, o->beta, o->W);
        for (int i = 0; i < s * s; i++)
            o->A[i] = o->m->A[i / s][i % s];
        if (o->beta != 0)
            o->memory = radau_memory_alloc(o->m, o->beta, o->d, longest, least,
                                           T, tolerance);
        if (o->beta != 0 && !o->memory)
            status = FVI_ENOMEM;
        for (size_t k = 0; k < o->steps && !status; k++) {
            status = take_step(o, t, k, &row, rows);
            t += o->mesh[k].h;
        }
        if (!status && row <= ROWS)
            status = FVI_EMAXITER;
    }
    radau_memory_free(o->memory);
    for (int k = 0; k < o->kept; k++)
        free(o->factors[k].K);
    free(o->x);
    free(o->mesh);
    free(o->kind);
    free(o);
    return status;
}

static int any(const problem *p)
{
    (void)p;
    return 1;
}

#define WHY "many digits a step, from stages and modes as ours"
#define RADAU(stages, grade, word)                                             \
    static int run_##stages##_##grade(const task *t, double *rows)             \
    {                                                                          \
        return run(t, stages, grade, rows);                                    \
    }                                                                          \
    const peer peer_radau##stages##_##grade = {                                \
        "Radau IIA " #stages word,                                             \
        grade ? "Guo, Lopez-Fernandez 2025" : "Banjai, Lopez-Fernandez 2019",  \
        grade ? WHY ", with steps fixed beforehand: it estimates no error"     \
              : WHY ", on steps of one length",                                \
        1,                                                                     \
        20,                                                                    \
        grade,                                                                 \
        any,                                                                   \
        run_##stages##_##grade                                                 \
    };
RADAU(2, 0, "")
RADAU(3, 0, "")
RADAU(5, 0, "")
RADAU(7, 0, "")
RADAU(3, 1, ", graded")
RADAU(5, 1, ", graded")
RADAU(7, 1, ", graded")
