/* tests/bench/peers/collocation.c -- Solve one linear equation for all times at once. [H 18]
 *
 * If 4 alpha is an integer and F is 0 or constant, x'' is smooth in sqrt(t). So it is written as a sum of
 * Chebyshev polynomials T_k(2 sqrt(t/T) - 1), k < N, and the equation holds at N nodes,
 *
 *     m x'' + rho (J^{2-beta} x'' + [beta < 1] v0 t^{1-beta} / Gamma(2-beta))
 *           + c (x0 + t v0 + J^2 x'') = F,    beta = 2 alpha.
 *
 * A force that ends is the difference of two forces that do not end, so no jump remains. (M. Zayernouri, G. E.
 * Karniadakis, SIAM J. Sci. Comput. 36 (2014), collocate by powers of t^{1/2}; N. Hale, S. Olver, SIAM J. Sci.
 * Comput. 40 (2018).) The integrals of the polynomials over [0, 1] belong to the method and are kept from one run
 * to the next. */
#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "peers.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LOST = 4,
    KEPT = 64
}; /* J^2 adds t^2 = s^4 to a degree in s = sqrt(t) */

/* The numbers for N polynomials and one gamma: node[i]; J[i * N + k] = J^gamma T_k at node i; T[i * N + k] =
 * T_k at node i; X[l * N + k]: coefficient l of J^2 T_k. */
typedef struct {
    size_t N;
    double gamma, *node, *J, *J2, *T, *X;
} table;

static void chebyshev(size_t N, double s, double *T)
{
    const double z = 2 * s - 1;
    for (size_t k = 0; k < N; k++)
        T[k] = k < 2 ? (k ? z : 1) : 2 * z * T[k - 1] - T[k - 2];
}

/* Compute J^gamma T_k at s^2 = t. The variable y with (1 - y^2)^2 t removes the root. */
static void integrals(const gsl_integration_glfixed_table *gauss, size_t N,
                      double gamma, double s, double *work, double *J)
{
    memset(J, 0, N * sizeof *J);
    for (size_t g = 0; g < gauss->n; g++) {
        double y, weight;
        gsl_integration_glfixed_point(0, 1, g, &y, &weight, gauss);
        const double u = 1 - y * y;
        weight *= 4 * u * pow(y, 2 * gamma - 1) * pow(2 - y * y, gamma - 1)
                  * pow(s, 2 * gamma) / tgamma(gamma);
        chebyshev(N, s * u, work);
        for (size_t k = 0; k < N; k++)
            J[k] += weight * work[k];
    }
}

static int fill(table *t, size_t N, double gamma)
{
    const size_t M = N + LOST;
    gsl_integration_glfixed_table *gauss =
        gsl_integration_glfixed_table_alloc(256); /* GSL has these nodes to 1e-16 */
    double *block = malloc((N + 4 * N * N + M * N + 2 * M) * sizeof *block);
    if (!gauss || !block)
        return FVI_ENOMEM;
    *t = (table){ N, gamma, block, block + N, NULL, NULL, NULL };
    t->J2 = t->J + N * N;
    t->T = t->J2 + N * N;
    t->X = t->T + 2 * N * N;
    double *work = t->X + M * N, *row = work + M;
    for (size_t i = 0; i < N; i++) {
        t->node[i] = (1 - cos(M_PI * ((double)i + 0.5) / (double)N)) / 2;
        chebyshev(N, t->node[i], t->T + i * N);
        integrals(gauss, N, gamma, t->node[i], work, t->J + i * N);
        integrals(gauss, N, 2, t->node[i], work, t->J2 + i * N);
    }
    memset(t->X, 0, M * N * sizeof *t->X);
    for (size_t i = 0; i < M; i++) { /* from values at M nodes to coefficients */
        const double angle = M_PI * ((double)i + 0.5) / (double)M;
        integrals(gauss, N, 2, (1 - cos(angle)) / 2, work, row);
        for (size_t l = 0; l < M; l++)
            for (size_t k = 0; k < N; k++)
                t->X[l * N + k] += (l ? 2.0 : 1.0) / (double)M * row[k]
                                   * cos((double)l * (M_PI - angle));
    }
    gsl_integration_glfixed_table_free(gauss);
    return FVI_SUCCESS;
}

static const table *table_of(size_t N, double gamma)
{
    static table all[KEPT];
    for (int i = 0; i < KEPT; i++) {
        if (!all[i].N)
            return fill(&all[i], N, gamma) ? NULL : &all[i];
        if (all[i].N == N && all[i].gamma == gamma)
            return &all[i];
    }
    return NULL;
}

FVI_VECTORS static void subtract(size_t n, double f, const double *restrict a,
                                 double *restrict b)
{
#pragma omp simd
    for (size_t k = 0; k < n; k++)
        b[k] -= f * a[k];
}

/* Solve by Gauss's elimination with exchanges of rows. Each row of width N + 2 has two right sides. */
static void eliminate(size_t N, double *A)
{
    const size_t W = N + 2;
    for (size_t k = 0; k < N; k++) {
        size_t best = k;
        for (size_t i = k + 1; i < N; i++)
            if (fabs(A[i * W + k]) > fabs(A[best * W + k]))
                best = i;
        for (size_t j = k; j < W && best != k; j++) {
            const double t = A[k * W + j];
            A[k * W + j] = A[best * W + j];
            A[best * W + j] = t;
        }
        for (size_t i = k + 1; i < N; i++)
            subtract(W - k, A[i * W + k] / A[k * W + k], A + k * W + k,
                     A + i * W + k);
    }
    for (size_t k = N; k-- > 0;)
        for (size_t c = N; c < W; c++) {
            A[k * W + c] /= A[k * W + k];
            for (size_t i = 0; i < k; i++)
                A[i * W + c] -= A[i * W + k] * A[k * W + c];
        }
}

/* Return sum a_l T_l at s, by Clenshaw's recurrence. */
static double value(size_t M, const double *a, double s)
{
    const double z = 2 * (2 * s - 1);
    double b = 0, before = 0;
    for (size_t l = M; l-- > 1;) {
        const double next = a[l] + z * b - before;
        before = b;
        b = next;
    }
    return a[0] + z / 2 * b - before;
}

static int run(const task *of, double *rows)
{
    const problem *p = of->p;
    const fvi_linear_oscillator *l = p->linear;
    const size_t N = of->N, W = N + 2, M = N + LOST;
    const double T = p->T, beta = 2 * l->alpha, size = pow(T, 2 - beta);
    const table *t = table_of(N, 2 - beta);
    double *A = malloc((N * W + 2 * M) * sizeof *A), *a[2];
    if (!t || !A)
        return FVI_ENOMEM;
    a[0] = A + N * W; /* the solution without the force; then that of the force alone */
    a[1] = a[0] + M;
    for (size_t i = 0; i < N; i++) {
        const double now = T * t->node[i] * t->node[i];
        for (size_t k = 0; k < N; k++)
            A[i * W + k] = l->m * t->T[i * N + k]
                           + l->rho * size * t->J[i * N + k]
                           + l->c * T * T * t->J2[i * N + k];
        A[i * W + N] = -l->c * (l->x0 + l->v0 * now)
                       - (beta <= 1 ? l->rho * l->v0 * pow(now, 1 - beta)
                                          / tgamma(2 - beta)
                                    : 0);
        A[i * W + N + 1] = l->forcing == FVI_FORCING_STEP ? l->A : 0;
    }
    eliminate(N, A);
    for (int c = 0; c < 2; c++)
        for (size_t i = 0; i < M; i++) {
            a[c][i] = 0;
            for (size_t k = 0; k < N; k++)
                a[c][i] += T * T * t->X[i * N + k] * A[k * W + N + (size_t)c];
        }
    const int forced = l->forcing == FVI_FORCING_STEP;
    for (size_t k = 0; k <= ROWS; k++) {
        const double now = T * (double)k / ROWS;
        rows[k] = l->x0 + l->v0 * now;
        if (l->x0 != 0 || l->v0 != 0)
            rows[k] += value(M, a[0], sqrt(now / T));
        if (forced)
            rows[k] += value(M, a[1], sqrt(now / T));
        if (forced && now > l->T)
            rows[k] -= value(M, a[1], sqrt((now - l->T) / T));
    }
    free(A);
    return FVI_SUCCESS;
}

static int takes(const problem *p)
{
    const double quarters = 4 * p->alpha;
    return p->linear && p->past == FVI_INITIAL_HISTORY_CAPUTO && quarters == rint(quarters)
           && p->linear->forcing != FVI_FORCING_COSINE;
}

const peer peer_collocation = {
    "Chebyshev in sqrt(t)",
    "Hale, Olver 2018",
    "a linear motion whose powers are known beforehand is one "
    "sum of polynomials, and no step is taken",
    0,
    20,
    1,
    takes,
    run
};
