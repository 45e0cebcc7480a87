/* src/memory/damping_laws.c -- Damping by its symbol: weights.        [H 26] */
#include <fvi/damping_laws.h>

#include <fvi/coefficients.h>
#include "kernel_terms.h"
#include "system/fail.h"
#include "system/larger.h"

#include <complex.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- what a law is ---- */

static int check_term(const fvi_kernel_term *t)
{
    if (t->kind != FVI_KERNEL_POWER && t->kind != FVI_KERNEL_ZENER
        && t->kind != FVI_KERNEL_MAXWELL && t->kind != FVI_KERNEL_DISTRIBUTED)
        FVI_FAIL("unknown law of damping", FVI_EINVAL);
    if (!(isfinite(t->rho) && t->rho >= 0))
        FVI_FAIL("rho of a law must be finite and not negative", FVI_EDOM);
    if (t->kind != FVI_KERNEL_MAXWELL && !(t->alpha >= 0 && t->alpha <= 1))
        FVI_FAIL("alpha of a law must be in [0, 1]", FVI_EDOM);
    if ((t->kind == FVI_KERNEL_ZENER || t->kind == FVI_KERNEL_MAXWELL)
        && !(isfinite(t->time) && t->time >= 0))
        FVI_FAIL("the time of a law must be finite and not negative", FVI_EDOM);
    if (t->kind == FVI_KERNEL_DISTRIBUTED && !(t->end > t->alpha && t->end <= 1))
        FVI_FAIL("the end of a range of orders must be in (alpha, 1]",
                 FVI_EDOM);
    return FVI_SUCCESS;
}

int fvi_kernel_check(const fvi_kernel *law)
{
    if (!law || (law->count && !law->term))
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (law->count == 0)
        FVI_FAIL("a law has at least one term", FVI_EINVAL);
    for (size_t i = 0; i < law->count; i++) {
        int status = check_term(&law->term[i]);
        if (status)
            return status;
    }
    return FVI_SUCCESS;
}

static double growth_of(const fvi_kernel_term *t)
{
    const double last = t->kind == FVI_KERNEL_DISTRIBUTED ? t->end
                        : t->kind == FVI_KERNEL_MAXWELL   ? 0.5
                                                       : t->alpha;
    return t->kind == FVI_KERNEL_POWER || t->kind == FVI_KERNEL_DISTRIBUTED
                   || t->time == 0
               ? 2 * last
               : 0;
}

double fvi_kernel_growth(const fvi_kernel *law)
{
    double most = 0;
    for (size_t i = 0; i < law->count; i++)
        most = larger(most, growth_of(&law->term[i]));
    return most;
}

/* e^{2 a ln s}, whose angle is 2 a times that of s: exact where that is none. */
static double complex power_at(double a, double modulus, double angle)
{
    const double size = pow(modulus, 2 * a);
    return size * cos(2 * a * angle) + I * size * sin(2 * a * angle);
}

/* The integral of e^{2 a L}, L = ln s, over a range of orders, and its derivative by L. */
static double complex range_at(const fvi_kernel_term *t, double modulus,
                               double angle, double complex *slope)
{
    const double middle = (t->alpha + t->end) / 2, width = t->end - t->alpha;
    const double complex L = log(modulus) + I * angle,
                         q = power_at(middle, modulus, angle);
    if (L == 0) {
        *slope = 2 * middle * width;
        return width;
    }
    const double complex ratio = csinh(width * L) / L;
    *slope = q * (2 * middle * ratio + (width * ccosh(width * L) - ratio) / L);
    return q * ratio;
}

//> symbol
static double complex symbol_at(const fvi_kernel_term *t, double modulus,
                                double angle, double complex *slope)
{
    if (t->kind == FVI_KERNEL_DISTRIBUTED)
        return range_at(t, modulus, angle, slope);
    const double a = t->kind == FVI_KERNEL_MAXWELL ? 0.5 : t->alpha,
                 time = t->kind == FVI_KERNEL_POWER ? 0 : t->time;
    const double complex q = power_at(a, modulus, angle), part = 1 + time * q;
    *slope = 2 * a * q / (part * part); /* s C'(s) */
    return q / part;
}
//< symbol

static double complex sum_at(const fvi_kernel *law, double modulus, double angle,
                             double complex *slope)
{
    double complex C = 0;
    *slope = 0;
    for (size_t i = 0; i < law->count; i++) {
        double complex one;
        C += law->term[i].rho
             * symbol_at(&law->term[i], modulus, angle, &one);
        *slope += law->term[i].rho * one;
    }
    return C;
}

double complex fvi_kernel_at(const fvi_kernel *law, double complex s,
                          double complex *slope)
{
    return sum_at(law, cabs(s), carg(s), slope);
}

double fvi_kernel_symbol(const fvi_kernel *law, double s)
{
    double complex slope;
    return creal(sum_at(law, s, 0, &slope));
}

int fvi_kernel_moduli(const fvi_kernel *law, double omega, double *storage,
                   double *loss)
{
    int status = fvi_kernel_check(law);
    if (status)
        return status;
    if (!storage || !loss)
        FVI_FAIL("null pointer", FVI_EFAULT);
    if (!(isfinite(omega) && omega > 0))
        FVI_FAIL("omega must be finite and positive", FVI_EDOM);
    double complex slope;
    const double complex C = sum_at(law, omega, M_PI_2, &slope);
    if (!isfinite(creal(C)) || !isfinite(cimag(C)))
        FVI_FAIL("a modulus is not finite", FVI_EOVRFLW);
    *storage = creal(C);
    *loss = cimag(C);
    return FVI_SUCCESS;
}

/* ---- powers and fractions of powers ---- */

/* Gauss and Legendre's nodes for a range of orders: n of them integrate e^{x a} over it
 * to (e |x| / 4 n)^{2 n}, x twice the range times the logarithm of a lag over h: to 1e-16
 * for |x| up to 70. */
enum { ORDERS = 64 };

int fvi_kernel_flatten(const fvi_kernel *law, fvi_kernel_simple **terms, size_t *count)
{
    gsl_integration_glfixed_table *gauss = NULL;
    fvi_kernel_simple *t = malloc(law->count * ORDERS * sizeof *t);
    size_t n = 0;
    if (!t)
        FVI_FAIL("no memory for the law", FVI_ENOMEM);
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *from = &law->term[i];
        if (from->kind != FVI_KERNEL_DISTRIBUTED) {
            const int fraction = from->kind != FVI_KERNEL_POWER;
            t[n++] = (fvi_kernel_simple){
                from->rho, from->kind == FVI_KERNEL_MAXWELL ? 0.5 : from->alpha,
                fraction ? from->time : 0
            };
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
            t[n++] = (fvi_kernel_simple){ from->rho * weight, a, 0 };
        }
    }
    if (gauss)
        gsl_integration_glfixed_table_free(gauss);
    *terms = t;
    *count = n;
    return FVI_SUCCESS;
}

/* ---- power series ---- */

/* (1 - z)^nu for -1 <= nu < 0, whose coefficients are positive. */
static void negative_power(double nu, size_t count, double *w)
{
    w[0] = 1;
    for (size_t n = 1; n < count; n++)
        w[n] = w[n - 1] * ((double)n - 1 - nu) / (double)n;
}

/* w becomes w ((3 - z)/2)^beta, from its end, so that what is still needed stands. */
static void times_bdf2(double beta, size_t count, double *w)
{
    double g[FVI_BDF2_TAPS];
    const size_t taps = fvi_cq_bdf2_factor(beta, g);
    for (size_t n = count; n-- > 0;) {
        double sum = 0;
        for (size_t j = 0; j < taps && j <= n; j++)
            sum += g[j] * w[n - j];
        w[n] = sum;
    }
}

/* (delta(z)/h)^{2 alpha} (1 - z)^{-increments} */
static void power(double alpha, fvi_delta kind, double h, int increments,
                  size_t count, double *w)
{
    const double nu = 2 * alpha - increments;
    if (nu < 0)
        negative_power(nu, count, w);
    else
        fvi_gl_weights(nu, count, w);
    if (kind == FVI_DELTA_BDF2)
        times_bdf2(2 * alpha, count, w);
    const double scale = pow(h, -2 * alpha);
    for (size_t n = 0; n < count; n++)
        w[n] *= scale;
}

/* W (1 + T q) = q, one coefficient after the other. In a law's fraction all that is
 * added has one sign (26.5). */
//> division
static void divide(double T, size_t count, const double *q, double *W)
{
    size_t last = count;
    while (last > 1 && q[last - 1] == 0) /* alpha = 1/2: two or three */
        last--;
    for (size_t n = 0; n < count; n++) {
        double sum = 0;
        for (size_t j = 1; j < last && j <= n; j++)
            sum += q[j] * W[n - j];
        W[n] = (q[n] - T * sum) / (1 + T * q[0]);
    }
}
//< division

void fvi_kernel_series(const fvi_kernel_simple *t, fvi_delta kind, double h,
                    int increments, size_t count, double *room, double *w)
{
    const int fraction = t->time > 0;
    power(t->alpha, kind, h, fraction ? 0 : increments, count, room);
    if (!fraction) {
        for (size_t n = 0; n < count; n++)
            w[n] += t->rho * room[n];
        return;
    }
    double *W = room + count, sum = 0;
    divide(t->time, count, room, W);
    for (size_t n = 0; n < count; n++) {
        sum += W[n];
        w[n] += t->rho * (increments ? sum : W[n]);
    }
}

int fvi_kernel_check_weights(const fvi_kernel *law, fvi_delta kind, double h)
{
    int status = fvi_kernel_check(law);
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
    return FVI_SUCCESS;
}
