/* tests/convergence/any_mesh.h -- Form D on a mesh that is given, one coordinate, any number of
 * stages: the integrated form of (22.14), straight from its definition, and slow. */
#ifndef ANY_MESH_H
#define ANY_MESH_H

#include <fvi/fvi.h>
#include "harness/ulp.h"

#include <math.h>
#include <string.h>

enum { MOST_STAGES = 8, MOST_RATES = 4096 };

typedef double block[MOST_STAGES][MOST_STAGES];

typedef struct {
    size_t s;
    double c[MOST_STAGES];
    block inverse, A; /* A^{-1}, and A, whose last row is b */
} stages;

/* Gauss and Jordan, with exchanges. */
static inline void invert(size_t s, block M, block back)
{
    block a;
    memcpy(a, M, sizeof a);
    memset(back, 0, sizeof(block));
    for (size_t i = 0; i < s; i++)
        back[i][i] = 1;
    for (size_t k = 0; k < s; k++) {
        size_t top = k;
        for (size_t i = k + 1; i < s; i++)
            top = fabs(a[i][k]) > fabs(a[top][k]) ? i : top;
        for (size_t l = 0; l < s; l++) {
            const double swap_a = a[k][l], swap_b = back[k][l];
            a[k][l] = a[top][l], a[top][l] = swap_a;
            back[k][l] = back[top][l], back[top][l] = swap_b;
        }
        const double pivot = a[k][k];
        for (size_t l = 0; l < s; l++)
            a[k][l] /= pivot, back[k][l] /= pivot;
        for (size_t i = 0; i < s; i++) {
            const double factor = i == k ? 0 : a[i][k];
            for (size_t l = 0; l < s; l++)
                a[i][l] -= factor * a[k][l], back[i][l] -= factor * back[k][l];
        }
    }
}

/* (17.3): the slopes of Lagrange's polynomials at the nodes, and the penalty 1/b_1 = s (s - 1). */
static inline stages stages_of(size_t s)
{
    stages of = { .s = s };
    double weight[MOST_STAGES];
    for (size_t i = 0; i < s; i++)
        of.c[i] = fvi_lobatto_abscissa(s, i);
    for (size_t i = 0; i < s; i++) {
        weight[i] = 1;
        for (size_t j = 0; j < s; j++)
            weight[i] /= i == j ? 1 : of.c[i] - of.c[j];
    }
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++) {
            if (i == j)
                continue;
            of.inverse[i][j] = weight[j] / weight[i] / (of.c[i] - of.c[j]);
            of.inverse[i][i] -= of.inverse[i][j];
        }
    of.inverse[0][0] += (double)(s * (s - 1));
    invert(s, of.inverse, of.A);
    return of;
}

/* x'' + r D^{2 alpha} x + g(x) = f(t), Caputo's past, and eta in the place of the memory's errors. */
typedef struct {
    double alpha, r, x0, v0;
    double (*g)(double x, const void *of);
    double (*f)(double t, const void *of);
    const void *of;
    double (*eta)(double t);
} body;

/* The memory DD^{-theta} u as modes w' = -sigma w + u at equal distances of ln sigma. */
typedef struct {
    double theta, w[MOST_RATES], sigma[MOST_RATES], weight[MOST_RATES];
    size_t count;
} past_modes;

static inline void begin_past(past_modes *of, double theta)
{
    const double L = 0.3, low = -38 / (1 - theta), high = 38 / theta;
    of->theta = theta;
    of->count = 0;
    for (double u = low; u <= high; u += L) {
        ck_assert_uint_lt(of->count, MOST_RATES);
        of->sigma[of->count] = exp(u);
        of->weight[of->count] = sin(M_PI * theta) / M_PI * L * exp((1 - theta) * u);
        of->w[of->count++] = 0;
    }
}

/* The present part of a step of length h, and the history; with `took` the stages of u of the step that was
 * taken, the modes move instead. */
static inline void read_past(past_modes *of, const stages *rule, double h, block present,
                             double *history, const double *took)
{
    const size_t s = rule->s;
    for (size_t q = 0; q < of->count; q++) {
        block M, N;
        memcpy(M, rule->inverse, sizeof M);
        for (size_t i = 0; i < s; i++)
            M[i][i] += h * of->sigma[q];
        invert(s, M, N);
        double w = 0;
        for (size_t i = 0; i < s; i++) {
            const double a = N[i][0] * (double)(s * (s - 1));
            if (took) {
                w += h * N[s - 1][i] * took[i];
                w += i + 1 == s ? a * of->w[q] : 0;
            } else {
                history[i] += of->weight[q] * a * of->w[q];
                for (size_t l = 0; l < s; l++)
                    present[i][l] += of->weight[q] * h * N[i][l];
            }
        }
        if (took)
            of->w[q] = w;
    }
}

typedef struct {
    const body *q;
    const stages *rule;
    int rises, has_memory; /* 2 alpha > 1; and not 1 */
    double t, h, x, pushed; /* pushed: the integral of f - g - r eta, so far */
    block present;
    double history[MOST_STAGES], u[MOST_STAGES], F[MOST_STAGES];
} mesh_step;

static inline void apply(size_t s, const double (*M)[MOST_STAGES], const double *v, double *out)
{
    for (size_t i = 0; i < s; i++) {
        out[i] = 0;
        for (size_t l = 0; l < s; l++)
            out[i] += M[i][l] * v[l];
    }
}

/* By how much V misses the equation of the step; X, u and F are those of V. */
static inline void mesh_residual(mesh_step *o, const double *V, double *X, double *residual)
{
    const body *q = o->q;
    const size_t s = o->rule->s;
    double moved[MOST_STAGES], memory[MOST_STAGES], pushed[MOST_STAGES];
    apply(s, o->rule->A, V, moved);
    for (size_t i = 0; i < s; i++) {
        const double now = o->t + o->rule->c[i] * o->h;
        X[i] = o->x + o->h * moved[i];
        o->u[i] = o->rises ? V[i] - q->v0 : X[i] - q->x0;
        o->F[i] = q->f(now, q->of) - q->g(X[i], q->of) - (q->eta ? q->r * q->eta(now) : 0);
    }
    apply(s, (const double (*)[MOST_STAGES])o->present, o->u, memory);
    apply(s, o->rule->A, o->F, pushed);
    for (size_t i = 0; i < s; i++)
        residual[i] = q->v0 + o->pushed + o->h * pushed[i]
                      - q->r * (o->has_memory ? o->history[i] + memory[i] : o->u[i]) - V[i];
}

/* Newton's matrix, with the slope of g at the start of the step: its inverse. */
static inline void mesh_matrix(const mesh_step *o, block back)
{
    const stages *rule = o->rule;
    const size_t s = rule->s;
    const double by = 1e-5, slope = (o->q->g(o->x + by, o->q->of) - o->q->g(o->x - by, o->q->of)) / (2 * by);
    block M = { { 0 } };
    for (size_t i = 0; i < s; i++)
        for (size_t l = 0; l < s; l++) {
            double damped = o->rises ? o->present[i][l] : o->has_memory ? 0 : o->h * rule->A[i][l], bent = 0;
            for (size_t j = 0; j < s; j++) {
                damped += o->rises || !o->has_memory ? 0 : o->present[i][j] * o->h * rule->A[j][l];
                bent += o->h * rule->A[i][j] * o->h * rule->A[j][l];
            }
            M[i][l] = (i == l) + o->q->r * damped + slope * bent;
        }
    invert(s, M, back);
}

/* The stages X and V of n steps, s numbers each, step by step. For alpha = 1/2 the memory is x - x0. */
static inline void run_on_mesh(const body *q, size_t s, size_t n, const double *h, double *X, double *V)
{
    static past_modes past;
    const stages rule = stages_of(s);
    mesh_step o = { .q = q, .rule = &rule, .rises = q->alpha > 0.5, .has_memory = q->alpha != 0.5, .x = q->x0 };
    if (o.has_memory)
        begin_past(&past, o.rises ? 2 - 2 * q->alpha : 1 - 2 * q->alpha);
    for (size_t k = 0; k < n; k++, X += s, V += s) {
        block back;
        double missed[MOST_STAGES], move[MOST_STAGES], change = 1, size = 1;
        o.h = h[k];
        memset(o.present, 0, sizeof o.present);
        memset(o.history, 0, sizeof o.history);
        if (o.has_memory)
            read_past(&past, &rule, o.h, o.present, o.history, NULL);
        mesh_matrix(&o, back);
        for (size_t i = 0; i < s; i++)
            V[i] = k ? V[-1] : q->v0;
        for (int again = 0; again < 200 && change > 4e-16 * size; again++) {
            mesh_residual(&o, V, X, missed);
            apply(s, (const double (*)[MOST_STAGES])back, missed, move);
            change = 0;
            for (size_t i = 0; i < s; i++) {
                V[i] += move[i];
                change = larger(change, fabs(move[i]));
                size = larger(size, fabs(V[i]));
            }
        }
        ck_assert_double_le(change, 1e-14 * size);
        mesh_residual(&o, V, X, missed);
        if (o.has_memory)
            read_past(&past, &rule, o.h, NULL, NULL, o.u);
        for (size_t l = 0; l < s; l++)
            o.pushed += o.h * rule.A[s - 1][l] * o.F[l];
        o.x = X[s - 1];
        o.t += o.h;
    }
}

/* t_k = T (k/N)^grade. */
static inline void graded(double T, size_t N, double grade, double *h)
{
    for (size_t k = 0; k < N; k++)
        h[k] = T * (pow((double)(k + 1) / (double)N, grade) - pow((double)k / (double)N, grade));
}

#endif
