/* src/kernel/kernel_modes.c -- Compute one set of modes for all terms of a law.      [H 26]
 *
 * The weights of a law are a sum of decaying modes, sum_q c_q exp(-n s_q). All terms with a cut share the same rates
 * s_q, which are the nodes of a quadrature along the cut, (26.6). Each pole has modes of its own. */
#include "kernel_classes.h"
#include "kernel_ready.h"

#include "memory/history_kinds.h"
#include "system/larger.h"

#include <math.h>
#include <stdlib.h>

static int is_whole(double x)
{
    return x == floor(x);
}

int fvi_kernel_has_cut(const fvi_kernel_simple *t)
{
    return t->rho > 0
           && !(is_whole(2 * t->alpha)
                && (t->time == 0 || is_whole(2 * t->below)));
}

/* Return the width of the strip around the cut in which the symbol is analytic as a function of ln s, in radians. A
 * fraction has poles where 1 + time s^{2 below} = 0, on the next sheet beyond the cut. The strip ends a tenth before
 * them. A power has no poles. */
static double strip_width(const fvi_kernel_simple *t)
{
    return t->time == 0 ? M_PI_2
                        : 0.9 * fmin(M_PI_2, M_PI * (0.5 / t->below - 1));
}

/* ---- modes of the cut ---- */

/* Return Im C(-r + i0) of all terms with a cut. */
static double imaginary_part_on_cut(const fvi_kernel_ready *r, double ln_radius)
{
    double sum = 0;
    for (size_t i = 0; i < r->law->count; i++)
        if (fvi_kernel_is_on_cut(&r->law->term[i]))
            sum += cimag(fvi_kernel_term_at(&r->law->term[i], exp(ln_radius), M_PI));
    for (size_t i = 0; i < r->terms; i++)
        if (fvi_kernel_has_cut(&r->term[i]))
            sum += fvi_kernel_on_the_cut(&r->term[i], r->term[i].rho,
                                         ln_radius);
    return sum;
}

/* A longer tail is not summed term by term. */
#define MOST_TAIL_TERMS 1e5

/* Sum the tail of a Zener element of very small order, with n = 0. It has millions of terms that hardly differ from one
 * to the next. S0 is the integral of the terms by the formula of Euler and Maclaurin: the integral of Im C is an angle,
 * and two corrections follow. The third correction is below (2 alpha step)^4 / 720 of the sum. S1 has the factor mu, so
 * it is summed term by term until mu is below exp(-45) of its first value, which is below all digits. */
static void add_slow_tail(const fvi_kernel_simple *t, double factor, double ln_h, double first,
                          double step, double *S0, double *S1)
{
    const double order = 2 * t->alpha;
    const double complex power = cexp(order * (first - ln_h) + I * order * M_PI),
                         denominator = 1 + t->time * power;
    *S0 += factor
           * (carg(denominator) / (order * t->time * step) - cimag(power / denominator) / 2
              + step * order * cimag(power / (denominator * denominator)) / 12);
    for (double ln_mu = first - step; ln_mu > first - 45; ln_mu -= step)
        *S1 += fvi_kernel_on_the_cut(t, factor, ln_mu - ln_h) * exp(ln_mu);
}

/* Return 1 if fvi_kernel_tail would sum a Zener element over more than MOST_TAIL_TERMS terms, until time s^{2 below} is
 * below 1e-17. */
static int has_slow_tail(const fvi_kernel_simple *t, double ln_h, double first, double step, double n)
{
    return n == 0 && t->time > 0 && t->below == t->alpha
           && log(t->time * 1e17) + 2 * t->below * (first - ln_h) > 2 * t->below * step * MOST_TAIL_TERMS;
}

void fvi_kernel_tail(const fvi_kernel_simple *t, double factor, double ln_h,
                     double first, double step, double n, double *S0,
                     double *S1)
{
    if (has_slow_tail(t, ln_h, first, step, n)) {
        add_slow_tail(t, factor, ln_h, first, step, S0, S1);
        return;
    }
    const double order = 2 * t->alpha;
    double ln_mu = first,
           term = fvi_kernel_on_the_cut(t, factor, ln_mu - ln_h) * exp(n * ln_mu);
    if (t->time > 0) /* sum until the fraction is a power to all digits */
        while (t->time * exp(2 * t->below * (ln_mu - ln_h)) > 1e-17 && term != 0) {
            ln_mu -= step;
            term = fvi_kernel_on_the_cut(t, factor, ln_mu - ln_h) * exp(n * ln_mu);
            *S0 += term;
            *S1 += term * exp(ln_mu);
        }
    *S0 += term / expm1((n + order) * step); /* the geometric series behind the last term */
    *S1 += term * exp(ln_mu) / expm1((n + 1 + order) * step);
}

/* Return N, or a larger N if the poles of a fraction, |s| = time^(-1/2 below), are not 20 times above 1/(N h). Below
 * 1/N the nodes are doubly exponential, and there the strip in which the fraction is analytic shrinks. */
static double longest_lag(const fvi_kernel_ready *r, double N)
{
    for (size_t i = 0; i < r->terms; i++) {
        const fvi_kernel_simple *t = &r->term[i];
        if (fvi_kernel_has_cut(t) && t->time > 0)
            N = larger(N, 20 * pow(t->time, 0.5 / t->below) / r->h);
    }
    return N;
}

/* Limit of N: a pole at so low a rate would need up to a thousand nodes. */
#define LARGEST_LAG 1e90

/* Return 1 if `time` is so short that C(delta(z)/h) of BDF2 has further poles, at |z| = 2.4 for the largest orders.
 * They are on no cut, and their powers have not decayed within the window. */
static int is_too_short_for_bdf2(const fvi_kernel_ready *r, double time)
{
    return r->kind == FVI_DELTA_BDF2 && 4 * r->h > time;
}

/* Return 1 if the term is general, and its kind has modes of its own. */
static int has_own_modes(const fvi_kernel_term *t)
{
    return t->rho > 0 && fvi_kernel_is_general(t) && !fvi_kernel_is_on_cut(t);
}

/* Write to *has whether all terms with modes of their own have some, and are not too short for BDF2. */
static int own_modes_exist(const fvi_kernel_ready *r, int *has)
{
    *has = 1;
    for (size_t i = 0; *has && i < r->law->count; i++) {
        const fvi_kernel_term *t = &r->law->term[i];
        fvi_kernel_modes m = { 0 };
        if (!has_own_modes(t))
            continue;
        const int status =
            is_too_short_for_bdf2(r, t->time)
                ? FVI_EUNSUP
                : fvi_kernel_modes_of(t, 1 / (FVI_LONGEST * r->h), 1 / r->h, FVI_LEAST_TOLERANCE, 1, &m);
        free(m.rate);
        if (status && status != FVI_EUNSUP)
            return status;
        *has = !status;
    }
    return FVI_SUCCESS;
}

/* Return 1 if all simple terms have modes: no pole is near the cut or beside it, and none has too low a rate. */
static int fractions_have_modes(const fvi_kernel_ready *r)
{
    for (size_t i = 0; i < r->terms; i++) {
        const fvi_kernel_simple *t = &r->term[i];
        if (t->rho == 0 || t->time == 0)
            continue;
        if ((t->below > 0.45 && !fvi_kernel_is_relaxation(t))
            || (fvi_kernel_has_cut(t) && longest_lag(r, 1) > LARGEST_LAG))
            return 0;
        if (fvi_kernel_has_cut(t) && t->below > 0.4
            && is_too_short_for_bdf2(r, pow(t->time, 0.5 / t->below)))
            return 0;
        if (fvi_kernel_is_relaxation(t) && is_too_short_for_bdf2(r, t->time))
            return 0;
    }
    return 1;
}

int fvi_kernel_ready_has_modes(const fvi_kernel_ready *r, int *has)
{
    const int status = own_modes_exist(r, has);
    *has = !status && *has && r->strip > 0 && fractions_have_modes(r);
    return status;
}

/* Return the exponent with which Im C(-rate + i0) of a term on the cut falls for small rates. Return 0.99, or 1.9 for
 * increments, if there is no cut or the exponent is outside (0, 1.99). */
static double order_on_cut(const fvi_kernel_ready *r, const fvi_kernel_term *t)
{
    const double order = /* from two rates near the smallest double */
        log2(cimag(fvi_kernel_term_at(t, 0x1p-399, M_PI))
             / cimag(fvi_kernel_term_at(t, 0x1p-400, M_PI)));
    return order > 0 && order < 1.99 ? order : r->increments ? 1.9 : 0.99;
}

/* The terms of a law that have a cut, together. */
typedef struct {
    int exists;             /* 0 if no term has a cut */
    double lowest, highest; /* the least and the greatest order of these terms */
    double strip;           /* width of the strip in which all of them are analytic, in radians (strip_width) */
} law_cut;

static law_cut find_cut(const fvi_kernel_ready *r)
{
    law_cut cut = { 0, 2, 0, M_PI_2 };
    for (size_t i = 0; i < r->terms; i++)
        if (fvi_kernel_has_cut(&r->term[i])) {
            cut.exists = 1;
            cut.lowest = smaller(cut.lowest, 2 * r->term[i].alpha);
            cut.highest = larger(cut.highest, 2 * r->term[i].alpha);
            cut.strip = smaller(cut.strip, strip_width(&r->term[i]));
        }
    for (size_t i = 0; i < r->law->count; i++)
        if (fvi_kernel_is_on_cut(&r->law->term[i])) {
            const double order = order_on_cut(r, &r->law->term[i]);
            cut.exists = 1;
            cut.lowest = smaller(cut.lowest, order);
            /* the growth of the term is not used here */
            cut.highest = larger(cut.highest, r->increments ? 1.9 : order);
            cut.strip = smaller(cut.strip, r->strip * M_PI_2);
        }
    return cut;
}

static void add_modes_of_cut(const fvi_kernel_ready *r, double N, double delta, fvi_kernel_modes *m)
{
    const law_cut cut = find_cut(r);
    if (!cut.exists)
        return;
    N = longest_lag(r, N);
    const fvi_node_range nodes =
        fvi_node_range_of(cut.lowest - r->increments, cut.lowest + (1 - r->increments),
                          cut.highest - r->increments, N, delta, cut.strip / M_PI_2);
    const int is_bdf2 = r->kind == FVI_DELTA_BDF2;
    for (size_t q = 0; q < nodes.Q; q++) { /* (26.6) */
        const double t = nodes.left + (double)q * nodes.step, ln_s = t - exp(-t),
                     node = exp(ln_s) / N; /* the rate s_q; delta(e^node) is -expm1(node), for BDF2 times `half` */
        const double half = (3 - exp(node)) / 2;
        if (is_bdf2 && half <= 0)
            break; /* the remaining terms are below 3^(-33), which is below all rounding errors */
        const double slope = node > 0 ? expm1(node) / node : 1;
        const double ln_radius = /* of -delta(e^node)/h */
            ln_s - log(N) + log(slope * (is_bdf2 ? half : 1) / r->h);
        const double weight = -nodes.step / M_PI * (1 + exp(-t))
                              * imaginary_part_on_cut(r, ln_radius);
        fvi_kernel_modes_add(m, node, weight * (r->increments ? -1 / slope : node));
    }
}

/* ---- modes of the poles ---- */

/* Add the modes of a Maxwell element, rho s / (1 + T s). Its weights are powers of one number for Euler. For BDF2 they
 * are powers of two numbers, the inverse poles of C(delta(z)/h) at z = 2 -+ root. */
static void add_modes_of_relaxation(const fvi_kernel_ready *r, const fvi_kernel_simple *t, fvi_kernel_modes *m)
{
    const double h = r->h, T = t->time, rho = t->rho;
    if (r->kind == FVI_DELTA_EULER) { /* (26.7) */
        fvi_kernel_modes_add(m, log1p(h / T), r->increments ? rho / (h + T) : -rho / T * h / (h + T));
        return;
    }
    const double x = 2 * h / T, root = sqrt(1 - x);
    const double z[] = { 2 - root, 2 + root }, sign[] = { 1, -1 };
    for (size_t i = 0; i < 2; i++)
        fvi_kernel_modes_add(m, i == 0 ? log1p(x / (1 + root)) : log(z[1]), /* ln z_i; 2 - root is near 1 */
                             sign[i] * rho / (T * root * z[i]) * (r->increments ? (3 - z[i]) / 2 : -h / T));
}

/* Add the modes of a term of a kind with modes of its own. A rate of the symbol becomes the rate s of a mode by
 * delta(e^s)/h = -rate. (26.17) */
static int add_modes_of_general_term(const fvi_kernel_ready *r, const fvi_kernel_term *t, double N, double delta,
                                     fvi_kernel_modes *m)
{
    const double h = r->h;
    const size_t before = m->count;
    const int status = fvi_kernel_modes_of(t, 1 / (N * h), 1 / h, delta, 1, m);
    for (size_t j = before; !status && j < m->count; j++) {
        const double x = h * m->rate[j];
        const int is_bdf2 = r->kind == FVI_DELTA_BDF2;
        const double root = is_bdf2 ? sqrt(1 - 2 * x) : 1,
                     grown = is_bdf2 ? 2 * x / (1 + root) : x, /* e^s - 1 */
                     share = m->weight[j] * x / (root * (1 + grown));
        m->rate[j] = log1p(grown);
        m->weight[j] = r->increments ? share / grown : -share;
    }
    return status;
}

int fvi_kernel_ready_modes(const fvi_kernel_ready *r, double N, double delta, fvi_kernel_modes *m)
{
    double spring = 0; /* the stiffness of all springs, which is C(0) */
    *m = (fvi_kernel_modes){ 0 };
    add_modes_of_cut(r, N, delta, m);
    int status = fvi_kernel_modes_check(m);
    for (size_t i = 0; !status && i < r->law->count; i++) {
        const fvi_kernel_term *t = &r->law->term[i];
        if (fvi_kernel_is_on_cut(t))
            spring += creal(fvi_kernel_term_at(t, 0x1p-900, 0));
        else if (has_own_modes(t))
            status = add_modes_of_general_term(r, t, N, delta, m);
    }
    for (size_t i = 0; i < r->terms; i++) {
        const fvi_kernel_simple *t = &r->term[i];
        if (fvi_kernel_is_relaxation(t))
            add_modes_of_relaxation(r, t, m);
        if (t->alpha == 0)
            spring += t->rho / (1 + t->time);
    }
    if (spring > 0 && r->increments) /* a spring acts on the sum of all increments: a mode that does not decay */
        fvi_kernel_modes_add(m, 0, spring);
    return status ? status : fvi_kernel_modes_check(m);
}
