/* src/stages/lobatto_kernel.c -- Weights and modes of a damping law on Lobatto nodes.          [H 26] */
#include "lobatto_kernel.h"
#include "lobatto_general.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"
#include "system/larger.h"
#include "system/lu.h"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

enum { MATRICES_PER_CHECK = 8 }; /* a division asks the interrupter after every eighth matrix */

/* Return 1 if the term is a fraction without nodes. Its weights are computed by a division of power series.
 * The pole of such a term lies near the cut or off it, or its weight on the cut changes sign. A Maxwell
 * element has a node at its pole. */
static int is_divided(const fvi_kernel_simple *t)
{
    const int turns = t->alpha > 0.5 && 2 * (t->alpha - t->below) < 1;
    return t->rho > 0 && t->time > 0 && !fvi_kernel_is_relaxation(t)
           && (t->below > 0.45 || (t->below < t->alpha && turns));
}

/* Return 1 if the term has nodes on its cut. */
static int has_nodes_on_cut(const fvi_kernel_simple *t)
{
    return fvi_kernel_has_cut(t) && !is_divided(t);
}

/* Return 1 if the weights of the term come from Cauchy's integral, and its modes from the cut. */
static int has_contour(const fvi_kernel_term *t)
{
    return fvi_kernel_is_general(t) && t->rho > 0;
}

int fvi_lobatto_kernel_prepare(size_t s, const fvi_kernel *law, double h,
                               fvi_lobatto_kernel *ready)
{
    *ready = (fvi_lobatto_kernel){
        .law = law, .h = h, .strip = 1, .has_nodes = 1
    };
    int status = FVI_SUCCESS;
    for (size_t i = 0; i < law->count && !status; i++) {
        double strip = 1;
        if (has_contour(&law->term[i]))
            status = fvi_lobatto_general_strip(s, &law->term[i], h, &strip);
        ready->strip = smaller(ready->strip, strip);
    }
    if (status)
        return status;
    if (ready->strip == 0)
        FVI_FAIL("stages take a law whose tail is a sum of decaying modes; "
                 "fvi, fvi-bdf2 and fvi-stable take this one",
                 FVI_EUNSUP);
    status = fvi_kernel_flatten(law, &ready->term, &ready->terms);
    for (size_t i = 0; !status && i < ready->terms; i++)
        ready->has_nodes &= !is_divided(&ready->term[i]);
    return status;
}

void fvi_lobatto_kernel_free(fvi_lobatto_kernel *ready)
{
    free(ready->term);
    ready->term = NULL;
}

/* ---- nodes ---- */

/* Return h Im C(-mu/h + i0) / pi of one term. */
static double density_on_cut(const fvi_kernel_simple *t, double h, double ln_mu)
{
    return fvi_kernel_on_the_cut(t, t->rho * h / M_PI, ln_mu - log(h));
}

/* Sum the nodes below ln mu = first, so that one node can replace them. above = 0 takes the terms of order up to 1,
 * above = 1 the terms of a higher order, which have the other sign on the cut. */
static void tail_of(const fvi_lobatto_kernel *r, int above, double first,
                    double step, double *S0, double *S1)
{
    *S0 = *S1 = 0;
    for (size_t i = 0; i < r->terms; i++)
        if (has_nodes_on_cut(&r->term[i]) && (r->term[i].alpha > 0.5) == above)
            fvi_kernel_tail(&r->term[i], r->term[i].rho * r->h / M_PI,
                            log(r->h), first, step, 0, S0, S1);
}

/* Add the nodes of the cut: (17.10), with one set of nodes for all terms. */
static void add_nodes_of_cut(size_t s, const fvi_lobatto_kernel *r, double N, double tolerance, fvi_kernel_modes *nodes)
{
    double least = 1, most = -1, width = 1;
    for (size_t i = 0; i < r->terms; i++) {
        const fvi_kernel_simple *t = &r->term[i];
        if (!has_nodes_on_cut(t))
            continue;
        least = smaller(least, 2 * t->alpha - 1);
        most = larger(most, 2 * t->alpha - 1);
        if (t->time > 0) /* there are poles on the next sheet beyond the cut */
            width = smaller(width, 0.9 * fmin(1, 1 / t->below - 2));
    }
    if (most < least)
        return;
    const fvi_lobatto_span span =
        fvi_lobatto_span_of(s, least, most, N, tolerance, width);
    const double first = span.first, step = span.step;
    for (int above = least > 0; above <= (most > 0); above++) {
        double S0, S1;
        tail_of(r, above, first, step, &S0, &S1);
        fvi_kernel_modes_add(nodes, S1 / S0, step * S0);
    }
    const size_t count = 1 + (size_t)ceil((span.last - first) / step);
    for (size_t j = 0; j < count; j++) {
        const double ln_mu = first + (double)j * step;
        double weight = 0;
        for (size_t i = 0; i < r->terms; i++)
            if (has_nodes_on_cut(&r->term[i]))
                weight += step * density_on_cut(&r->term[i], r->h, ln_mu);
        fvi_kernel_modes_add(nodes, exp(ln_mu), weight);
    }
}

/* Add the nodes of the general terms. Return FVI_SUCCESS, or the code of fvi_lobatto_general_modes. */
static int add_nodes_of_general(size_t s, const fvi_lobatto_kernel *r, double N, double tolerance,
                                fvi_kernel_modes *nodes)
{
    const size_t before = nodes->count;
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < r->law->count; i++)
        if (has_contour(&r->law->term[i]))
            status = fvi_lobatto_general_modes(s, &r->law->term[i], r->h, N, tolerance, r->strip, nodes);
    for (size_t j = before; j < nodes->count; j++) {
        nodes->weight[j] *= r->h;
        nodes->rate[j] *= r->h;
    }
    return status;
}

int fvi_lobatto_kernel_nodes(size_t s, const fvi_lobatto_kernel *ready, double N, double tolerance, int is_few,
                             fvi_kernel_modes *nodes)
{
    *nodes = (fvi_kernel_modes){ 0 };
    add_nodes_of_cut(s, ready, N, tolerance, nodes);
    if (is_few)
        nodes->count = fvi_lobatto_gauss(nodes->count, N, tolerance, nodes->weight, nodes->rate);
    const int status = add_nodes_of_general(s, ready, N, tolerance, nodes);
    double springs = 0;
    for (size_t i = 0; i < ready->terms; i++) {
        const fvi_kernel_simple *t = &ready->term[i];
        if (t->rho > 0 && t->alpha == 0)
            springs += t->rho / (1 + t->time);
        if (fvi_kernel_is_relaxation(t)) /* the residue of rho / (1 + T s) = (rho/T) / (s + 1/T) */
            fvi_kernel_modes_add(nodes, ready->h / t->time, t->rho * ready->h / t->time);
    }
    if (springs > 0) /* a spring acts on the sum of all velocities */
        fvi_kernel_modes_add(nodes, 0, springs * ready->h);
    return status ? status : fvi_kernel_modes_check(nodes);
}

/* ---- weights ---- */

/* Compute out = (Delta(z)/h) N(z) for a power series N, with the two coefficients of Delta (17.5). */
static void differentiate(size_t s, double h, size_t n, const double *N,
                          double *out)
{
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    const size_t s2 = s * s;
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < s; i++)
            for (size_t j = 0; j < s; j++) {
                double sum = i == 0 ? N[k * s2 + j] / rule->b[0] : 0;
                for (size_t l = 0; l < s; l++)
                    sum += rule->D[i][l] * N[k * s2 + l * s + j];
                if (i == 0 && k > 0)
                    sum -= N[(k - 1) * s2 + (s - 1) * s + j] / rule->b[0];
                out[k * s2 + i * s + j] = sum / h;
            }
}

/* Compute sum -= x y for s x s matrices. */
static inline void subtract_product(size_t s, const double *x, const double *y,
                                    double *restrict sum)
{
    for (size_t i = 0; i < s; i++)
        for (size_t l = 0; l < s; l++)
            for (size_t j = 0; j < s; j++)
                sum[i * s + j] -= x[i * s + l] * y[l * s + j];
}

/* Compute V -= Q_1 N_{k-1} + ... + Q_k N_0. The case s = 4 is separate, so that the compiler knows s. */
FVI_VECTORS static void subtract_products(size_t s, size_t k, const double *Q,
                                          const double *N, double *V)
{
    const size_t s2 = s * s;
    for (size_t j = 1; j <= k; j++) {
        const double *x = Q + j * s2, *y = N + (k - j) * s2;
        if (s == 4)
            subtract_product(4, x, y, V);
        else
            subtract_product(s, x, y, V);
    }
}

//> division
/* Solve V (1 + T Q) = N for the power series V, one matrix after the other. V overwrites N. Return FVI_SUCCESS or the
 * code of the interrupter. */
static int divide(size_t s, double T, size_t n, double *Q, double *N)
{
    const size_t s2 = s * s;
    double first[FVI_STAGES * FVI_STAGES], column[FVI_STAGES];
    size_t order[FVI_STAGES];
    gsl_permutation permutation = { s, order };
    for (size_t i = 0; i < n * s2; i++)
        Q[i] *= T;
    for (size_t i = 0; i < s2; i++)
        first[i] = Q[i] + (i % (s + 1) == 0);
    gsl_matrix_view matrix = gsl_matrix_view_array(first, s, s);
    fvi_lu_factorise(&matrix.matrix, &permutation);
    int status = FVI_SUCCESS;
    for (size_t k = 0; k < n && !status; k++) {
        double *V = N + k * s2;
        status = k % MATRICES_PER_CHECK == MATRICES_PER_CHECK - 1 ? fvi_interrupted() : FVI_SUCCESS;
        subtract_products(s, k, Q, N, V);
        for (size_t j = 0; j < s; j++) {
            gsl_vector_view x = gsl_vector_view_array(column, s);
            for (size_t i = 0; i < s; i++)
                column[i] = V[i * s + j];
            gsl_linalg_LU_svx(&matrix.matrix, &permutation, &x.vector);
            for (size_t i = 0; i < s; i++)
                V[i * s + j] = column[i];
        }
    }
    return status;
}
//< division

/* Compute (Delta/h)^(2 alpha - 1). */
static int power(size_t s, double alpha, double h, size_t n, double *N)
{
    const int status = fvi_lobatto_weights(s, 2 * alpha - 1, n, N, NULL);
    for (size_t i = 0; !status && i < n * s * s; i++)
        N[i] *= pow(h, 1 - 2 * alpha);
    return status;
}

/* Add the matrices of a fraction without nodes to W, from W_{FVI_LAGS + 1} on. */
static int add_divided(size_t s, const fvi_kernel_simple *t, double h, size_t n,
                       double *W)
{
    const size_t s2 = s * s;
    double *N = malloc(2 * n * s2 * sizeof *N);
    if (!N)
        FVI_FAIL("no memory for the weights", FVI_ENOMEM);
    double *Q = N + n * s2;
    int status = power(s, t->below, h, n, N);
    if (!status)
        differentiate(s, h, n, N, Q);
    if (!status && t->below != t->alpha)
        status = power(s, t->alpha, h, n, N);
    if (!status)
        status = divide(s, t->time, n, Q, N);
    for (size_t i = (FVI_LAGS + 1) * s2; !status && i < n * s2; i++)
        W[i] += t->rho * N[i];
    free(N);
    return status;
}

int fvi_lobatto_kernel_weights(size_t s, const fvi_lobatto_kernel *ready, size_t n,
                            double *W)
{
    fvi_kernel_modes nodes = { 0 };
    int status = FVI_SUCCESS;
    if (n > FVI_LAGS + 1) /* nodes are needed only for lags above FVI_LAGS */
        status = fvi_lobatto_kernel_nodes(s, ready, (double)n, 1e-16, 0, &nodes);
    const size_t Q = nodes.count;
    double *q = nodes.weight, *p = nodes.rate, *a = status ? NULL : malloc((s * Q + 1) * sizeof *a);
    if (!a) {
        free(nodes.rate);
        return status ? status : fvi_tell_handler("no memory for the nodes", __FILE__, __LINE__, FVI_ENOMEM);
    }
    fvi_lobatto_solve_nodes(s, Q, p, a, Q);
    memset(W, 0, (FVI_LAGS + 1) * s * s * sizeof *W);
    for (size_t k = 2; k < n; k++) {
        for (size_t j = 0; j < Q; j++)
            q[j] -= p[j] * q[j]; /* q_j r_j^(k-1) */
        if (k > FVI_LAGS)
            fvi_lobatto_sum(s, Q, q, a, W + k * s * s);
    }
    free(nodes.rate);
    free(a);
    for (size_t i = 0; i < ready->law->count; i++)
        if (has_contour(&ready->law->term[i]))
            fvi_lobatto_contour(s, &ready->law->term[i], ready->h, FVI_LAGS + 1,
                                W);
    for (size_t i = 0; !status && i < ready->terms; i++) {
        const fvi_kernel_simple *t = &ready->term[i];
        if (t->rho > 0)
            fvi_lobatto_near(s, t, ready->h, W);
        if (is_divided(t) && n > FVI_LAGS + 1)
            status = add_divided(s, t, ready->h, n, W);
    }
    return status;
}
