/* src/kernel/damping_laws.c -- Compute the convolution quadrature weights of a damping law.        [H 26] */
#include <fvi/damping_laws.h>

#include <fvi/coefficients.h>
#include "kernel_general.h"
#include "memory/history_kinds.h"
#include "system/fail.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- simple terms ---- */

/* Number of Gauss-Legendre nodes for a range of orders. n nodes integrate e^{x a} over the range with the error (e
 * |x| / 4 n)^{2 n}, where x is twice the range times the logarithm of lag / h. With 64 nodes this is
 * 1e-16 for |x| up to 70. */
enum { ORDERS = 64 };

/* Replace a term with 2 alpha <= 2^-53 by a spring. There s^{2 alpha} is 1 within 9e-14 for every double s, and a
 * history of increments would need infinitely many nodes for s^{2 alpha - 1}. */
static void round_to_spring(fvi_kernel_simple *t)
{
    if (2 * t->alpha <= 0x1p-53)
        t->alpha = t->below = 0;
}

int fvi_kernel_flatten(const fvi_kernel *law, fvi_kernel_simple **terms, size_t *count)
{
    gsl_integration_glfixed_table *gauss = NULL;
    fvi_kernel_simple *t = malloc(law->count * ORDERS * sizeof *t);
    size_t n = 0;
    if (!t)
        FVI_FAIL("no memory for the law", FVI_ENOMEM);
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *from = &law->term[i];
        if (fvi_kernel_is_general(from))
            continue;
        if (fvi_kernel_is_fraction(from, &t[n])) {
            n++;
            continue;
        }
        fvi_quiet();
        if (!gauss)
            gauss = gsl_integration_glfixed_table_alloc(ORDERS);
        fvi_loud();
        if (!gauss) {
            free(t);
            FVI_FAIL("no memory for the law", FVI_ENOMEM);
        }
        for (size_t j = 0; j < ORDERS; j++) {
            double a, weight;
            gsl_integration_glfixed_point(from->alpha, from->end, j, &a,
                                          &weight, gauss);
            t[n++] = (fvi_kernel_simple){ from->rho * weight, a, 0, a };
        }
    }
    if (gauss)
        gsl_integration_glfixed_table_free(gauss);
    for (size_t i = 0; i < n; i++)
        round_to_spring(&t[i]);
    *terms = t;
    *count = n;
    return FVI_SUCCESS;
}

/* ---- power series ---- */

/* Compute the coefficients of (1 - z)^nu for -1 <= nu < 0. They are all positive. */
static void negative_power(double nu, size_t count, double *w)
{
    w[0] = 1;
    for (size_t n = 1; n < count; n++)
        w[n] = w[n - 1] * ((double)n - 1 - nu) / (double)n;
}

/* Compute the coefficients of (delta(z)/h)^{2 alpha} (1 - z)^{-increments}. */
static void power(double alpha, fvi_delta kind, double h, int increments,
                  size_t count, double *w)
{
    const double nu = 2 * alpha - increments;
    if (nu < 0)
        negative_power(nu, count, w);
    else
        fvi_gl_weights(nu, count, w);
    if (kind == FVI_DELTA_BDF2)
        fvi_multiply_by_bdf2_factor(2 * alpha, count, w);
    const double scale = pow(h, -2 * alpha);
    for (size_t n = 0; n < count; n++)
        w[n] *= scale;
}

/* Divide power series: W = top / (1 + T q), one coefficient after the other. On entry W holds `top`. If top = q, as in
 * a Zener element, all summands have one sign, so nothing cancels (26.5). */
//> division
static void divide(double T, size_t count, const double *q, double *W)
{
    size_t last = count;
    while (last > 1 && q[last - 1] == 0) /* for alpha = 1/2 only two or three coefficients are not zero */
        last--;
    for (size_t n = 0; n < count; n++) {
        double sum = 0;
        for (size_t j = 1; j < last && j <= n; j++)
            sum += q[j] * W[n - j];
        W[n] = (W[n] - T * sum) / (1 + T * q[0]);
    }
}
//< division

void fvi_kernel_series(const fvi_kernel_simple *t, fvi_delta kind, double h,
                    int increments, size_t count, double *room, double *w)
{
    double *W = room + count, sum = 0;
    if (!(t->time > 0)) {
        power(t->alpha, kind, h, increments, count, room);
        for (size_t n = 0; n < count; n++)
            w[n] += t->rho * room[n];
        return;
    }
    const int rises = increments && 2 * (t->alpha - t->below) > 1;
    power(t->below, kind, h, 0, count, room);
    if (t->below == t->alpha)
        memcpy(W, room, count * sizeof *W);
    else
        power(t->alpha, kind, h, rises, count, W);
    divide(t->time, count, room, W);
    for (size_t n = 0; n < count; n++) {
        sum += W[n];
        w[n] += t->rho * (increments && !rises ? sum : W[n]);
    }
}

int fvi_kernel_check_weights(const fvi_kernel *law, fvi_delta kind, double h)
{
    int status = fvi_kernel_check_terms(law);
    if (status)
        return status;
    if (kind != FVI_DELTA_EULER && kind != FVI_DELTA_BDF2)
        FVI_FAIL("a law has weights of Euler and of BDF2", FVI_EINVAL);
    if (!(isfinite(h) && h > 0))
        FVI_FAIL("h must be finite and positive", FVI_EDOM);
    return FVI_SUCCESS;
}

int fvi_kernel_weights(const fvi_kernel *law, fvi_delta kind, double h,
                    size_t count, double *w)
{
    int status = fvi_kernel_check_weights(law, kind, h);
    if (status)
        return status;
    if (!w)
        FVI_FAIL("w is a null pointer", FVI_EFAULT);
    if (count == 0 || count > (size_t)-1 / 4 / sizeof *w)
        FVI_FAIL("count must be at least 1 and addressable", FVI_EINVAL);
    fvi_kernel_simple *term;
    size_t terms;
    status = fvi_kernel_flatten(law, &term, &terms);
    if (status)
        return status;
    double *room = malloc(2 * count * sizeof *room);
    if (!room) {
        free(term);
        FVI_FAIL("no memory for the weights", FVI_ENOMEM);
    }
    memset(w, 0, count * sizeof *w);
    for (size_t i = 0; i < terms; i++)
        fvi_kernel_series(&term[i], kind, h, 0, count, room, w);
    free(room);
    free(term);
    return fvi_kernel_general_weights(law, kind, h, 0, count, w);
}
