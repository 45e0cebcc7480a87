/* src/stages/lobatto_general.c -- Weights and modes of a general term on Lobatto nodes.            [H 26] */
#include "lobatto_general.h"

#include "memory/history_kinds.h" /* FVI_VECTORS */
#include "system/fail.h"
#include "system/larger.h"
#include "system/lu.h"

#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Return ln |det A^{-1}| / s, which is the mean of the logarithms of the eigenvalues. */
static double mean_log_eigenvalue(const fvi_lobatto_rule *rule, size_t s)
{
    double m[FVI_STAGES * FVI_STAGES], sum = 0;
    size_t order[FVI_STAGES];
    gsl_permutation permutation = { s, order };
    for (size_t i = 0; i < s; i++)
        memcpy(m + i * s, rule->D[i], s * sizeof *m);
    m[0] += 1 / rule->b[0];
    gsl_matrix_view M = gsl_matrix_view_array(m, s, s);
    fvi_lu_factorise(&M.matrix, &permutation);
    for (size_t i = 0; i < s; i++)
        sum += log(fabs(m[i * s + i]));
    return sum / (double)s;
}

/* Exchange the row that has the largest pivot in column k, from row k on, with row k of M and of G. */
static void bring_pivot(size_t s, size_t k, double complex *M, double complex *G)
{
    size_t pivot = k;
    for (size_t i = k + 1; i < s; i++)
        if (cabs(M[i * s + k]) > cabs(M[pivot * s + k]))
            pivot = i;
    for (size_t j = 0; pivot != k && j < s; j++) {
        const double complex of_M = M[k * s + j], of_G = G[k * s + j];
        M[k * s + j] = M[pivot * s + j];
        M[pivot * s + j] = of_M;
        G[k * s + j] = G[pivot * s + j];
        G[pivot * s + j] = of_G;
    }
}

/* Compute G = (lambda - A^{-1})^{-1}, row by row, by Gauss-Jordan elimination. GSL's function for complex matrices
 * allocates memory, and it ends the process if memory is short. */
static void resolvent(const fvi_lobatto_rule *rule, size_t s,
                      double complex lambda, double complex *G)
{
    double complex M[FVI_STAGES * FVI_STAGES];
    for (size_t i = 0; i < s; i++)
        for (size_t j = 0; j < s; j++) {
            M[i * s + j] = (i == j ? lambda : 0) - rule->D[i][j];
            G[i * s + j] = i == j;
        }
    M[0] -= 1 / rule->b[0];
    for (size_t k = 0; k < s; k++) {
        bring_pivot(s, k, M, G);
        const double complex scale = 1 / M[k * s + k];
        for (size_t j = 0; j < s; j++) {
            M[k * s + j] *= scale;
            G[k * s + j] *= scale;
        }
        for (size_t i = 0; i < s; i++) {
            const double complex factor = M[i * s + k];
            for (size_t j = 0; i != k && j < s; j++) {
                M[i * s + j] -= factor * M[k * s + j];
                G[i * s + j] -= factor * G[k * s + j];
            }
        }
    }
}

/* Add twice the real part of the powers of z in factor (lambda - Delta(z))^{-1}: W_0 += factor G, and W_n += factor
 * (-1)^n g^(n-1) (G e_1)(e_s^T G) / b_1 with g = e_s^T G e_1 / b_1. */
static void add_point(size_t s, double b, double complex factor,
                      const double complex *G, size_t count, double *W)
{
    const double complex *row = G + (s - 1) * s, g = row[0] / b;
    double complex power = -2 * factor / b;
    for (size_t i = 0; i < s * s; i++)
        W[i] += creal(2 * factor * G[i]);
    for (size_t n = 1; n < count; n++, power *= -g)
        for (size_t i = 0; i < s; i++)
            for (size_t j = 0; j < s; j++)
                W[(n * s + i) * s + j] += creal(power * G[i * s] * row[j]);
}

//> contour
/* The contour is an ellipse in the plane of ln lambda. It encloses the logarithms of the eigenvalues of A^{-1}, which
 * lie within 1.3 i of a point of the real axis, and it stays away from the cut at pi i. 128 points leave an error of
 * 1e-14. (26.16) */
void fvi_lobatto_contour(size_t s, const fvi_kernel_term *t, double h,
                         size_t count, double *W)
{
    enum { POINTS = 128 };
    static const double along = 1.6, across = 2.2;
    const fvi_lobatto_rule *rule = fvi_lobatto(s);
    const double at = mean_log_eigenvalue(rule, s), step = 2 * M_PI / POINTS;
    double complex G[FVI_STAGES * FVI_STAGES];
    for (int j = 0; j < POINTS / 2; j++) {
        const double turn = (j + 0.5) * step;
        const double u = at + along * cos(turn), v = across * sin(turn);
        const double complex lambda = exp(u) * (cos(v) + I * sin(v)),
                             slope = -along * sin(turn)
                                     + I * across * cos(turn),
                             C = fvi_kernel_term_at(t, exp(u) / h, v);
        resolvent(rule, s, lambda, G);
        add_point(s, rule->b[0], h * C * slope * step / (2 * M_PI * I), G, count,
                  W);
    }
}
//< contour

int fvi_lobatto_general_modes(size_t s, const fvi_kernel_term *t, double h,
                              double N, double tolerance, double strip,
                              fvi_kernel_modes *modes)
{
    const fvi_lobatto_span span =
        fvi_lobatto_span_of(s, -1, 1, N, tolerance, 1);
    return fvi_kernel_modes_of(t, 1 / (N * h), exp(span.last) / h,
                               fmax(tolerance, 1e-16), strip, modes);
}

/* Write to *left the largest difference between the modes and Cauchy's integral at the lag FVI_LAGS + 1, relative to
 * W_0; infinity if there are no modes. Return FVI_SUCCESS or FVI_ENOMEM. */
static int compare_modes(size_t s, const fvi_kernel_term *t, double h,
                         double strip, double *left)
{
    enum { COUNT = FVI_LAGS + 2 };
    double W[COUNT * FVI_STAGES * FVI_STAGES] = { 0 }, most = 0, worst = 0,
           a[FVI_STAGES], M[FVI_STAGES * FVI_STAGES];
    fvi_kernel_modes m = { 0 };
    const int status = fvi_lobatto_general_modes(s, t, h, COUNT, 1e-15, strip, &m);
    *left = GSL_POSINF;
    if (status) {
        free(m.rate);
        return status == FVI_EUNSUP ? FVI_SUCCESS : status;
    }
    fvi_lobatto_contour(s, t, h, COUNT, W);
    for (size_t i = 0; i < s * s; i++)
        most = larger(most, fabs(W[i]));
    for (size_t j = 0; j < m.count; j++) {
        double p = h * m.rate[j];
        fvi_lobatto_solve_nodes(s, 1, &p, a, 1);
        for (size_t n = FVI_LAGS + 1; n < COUNT; n++) {
            const double q =
                h * m.weight[j] * pow(1 - p, (double)n - 1);
            fvi_lobatto_sum(s, 1, &q, a, M);
            for (size_t i = 0; i < s * s; i++)
                W[n * s * s + i] -= M[i];
        }
    }
    free(m.rate);
    for (size_t i = (FVI_LAGS + 1) * s * s; i < COUNT * s * s; i++)
        worst = isnan(W[i]) ? GSL_POSINF : larger(worst, fabs(W[i]));
    *left = worst / most;
    return FVI_SUCCESS;
}

int fvi_lobatto_general_strip(size_t s, const fvi_kernel_term *t, double h, double *strip)
{
    double least = 1e-10, left;
    *strip = 0;
    for (double width = 1; width > 0.1; width /= 2) {
        const int status = compare_modes(s, t, h, width, &left);
        if (status)
            return status;
        if (left < least) {
            *strip = width;
            least = left / 4; /* a narrower strip needs more nodes, so it must be four times better */
        }
    }
    return FVI_SUCCESS;
}
