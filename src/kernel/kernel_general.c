/* src/kernel/kernel_general.c -- Compute weights and modes of a general term from the values of its symbol.  [H 26] */
#include "kernel_classes.h"

#include "system/fail.h"
#include "system/larger.h"

#include <gsl/gsl_fft_complex.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

int fvi_kernel_is_fraction(const fvi_kernel_term *t, fvi_kernel_simple *fraction)
{
    const fvi_kernel_class *of = fvi_kernel_classes[t->kind];
    return of->fraction && of->fraction(t, fraction);
}

int fvi_kernel_is_general(const fvi_kernel_term *t)
{
    fvi_kernel_simple fraction;
    return t->kind != FVI_KERNEL_DISTRIBUTED && !fvi_kernel_is_fraction(t, &fraction);
}

int fvi_kernel_is_on_cut(const fvi_kernel_term *t)
{
    return t->rho > 0 && !fvi_kernel_classes[t->kind]->modes && fvi_kernel_is_general(t);
}

int fvi_kernel_has_general(const fvi_kernel *law)
{
    for (size_t i = 0; i < law->count; i++)
        if (fvi_kernel_is_general(&law->term[i]) && law->term[i].rho > 0)
            return 1;
    return 0;
}

const char *fvi_kernel_singularity(const fvi_kernel *law)
{
    int pole = 0, branch_point = 0;
    for (size_t i = 0; i < law->count; i++) {
        const fvi_kernel_term *t = &law->term[i];
        const int is_pole = !fvi_kernel_is_general(t) /* (s / (1 + T s))^n has a pole for a whole n */
                            || (t->kind == FVI_KERNEL_DAVIDSON && 2 * t->alpha == floor(2 * t->alpha));
        pole |= t->rho > 0 && t->time > 0 && is_pole;
        branch_point |= t->rho > 0 && t->time > 0 && !is_pole;
        if (t->kind == FVI_KERNEL_SYMBOL)
            pole = branch_point = 1;
    }
    return !branch_point ? "a pole" : !pole ? "a branch point" : "a pole or a branch point";
}

/* ---- weights ---- */

/* Return C(delta(z)/h), divided by 1 - z if increments = 1. */
static double complex symbol_of_generating_point(const fvi_kernel_term *t, fvi_delta kind,
                                                 double h, int increments, double complex z)
{
    double complex s = (1 - z) / h;
    if (kind == FVI_DELTA_BDF2)
        s *= (3 - z) / 2;
    const double complex C = fvi_kernel_term_at(t, cabs(s), carg(s));
    return increments ? C / (1 - z) : C;
}

//> cauchy
/* Compute the coefficients by Cauchy's integral with M points z = r e^(2 pi i j / M), where r^M = 1e-14. The aliasing
 * error is below 1e-14, and rounding errors grow by r^-count <= 10^(14/8) at most. */
static int add_coefficients(const fvi_kernel_term *t, fvi_delta kind, double h,
                      int increments, size_t count, double *w)
{
    size_t M = 16;
    while (M < 8 * count)
        M *= 2;
    double *f = malloc(2 * M * sizeof *f);
    if (!f)
        FVI_FAIL("no memory for the weights", FVI_ENOMEM);
    const double ln_r = log(1e-14) / (double)M, turn = 2 * M_PI / (double)M;
    for (size_t j = 0; j <= M / 2; j++) {
        const double complex z =
                                 exp(ln_r)
                                 * (cos(turn * (double)j)
                                    + I * sin(turn * (double)j)),
                             C = symbol_of_generating_point(t, kind, h, increments, z);
        f[2 * j] = creal(C);
        f[2 * j + 1] = cimag(C);
        f[2 * ((M - j) % M)] = creal(C);
        f[2 * ((M - j) % M) + 1] = j == 0 ? 0 : -cimag(C);
    }
    gsl_fft_complex_radix2_forward(f, 1, M);
    for (size_t n = 0; n < count; n++)
        w[n] += f[2 * n] / (double)M * exp(-ln_r * (double)n);
    free(f);
    return FVI_SUCCESS;
}
//< cauchy

int fvi_kernel_general_weights(const fvi_kernel *law, fvi_delta kind, double h,
                               int increments, size_t count, double *w)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < law->count; i++)
        if (fvi_kernel_is_general(&law->term[i]) && law->term[i].rho > 0)
            status = add_coefficients(&law->term[i], kind, h, increments,
                                       count, w);
    return status;
}

/* ---- modes ---- */

enum { MOST_MODES = 6000 /* a term with more modes counts as a term without modes */ };

/* Make room for twice as many modes. */
static void grow_list(fvi_kernel_modes *m)
{
    const size_t room = m->room > 0 ? 2 * m->room : 64;
    double *block = malloc(2 * room * sizeof *block);
    if (!block) {
        m->is_incomplete = 1;
        return;
    }
    for (size_t j = 0; j < m->count; j++) {
        block[j] = m->rate[j];
        block[room + j] = m->weight[j];
    }
    free(m->rate);
    m->rate = block;
    m->weight = block + room;
    m->room = room;
}

void fvi_kernel_modes_add(fvi_kernel_modes *m, double rate, double weight)
{
    if (m->count == m->room)
        grow_list(m);
    if (m->count == m->room)
        return;
    m->rate[m->count] = rate;
    m->weight[m->count++] = weight;
}

int fvi_kernel_modes_check(const fvi_kernel_modes *m)
{
    if (m->is_incomplete)
        FVI_FAIL("no memory for the modes", FVI_ENOMEM);
    return FVI_SUCCESS;
}

/* Compute the modes of (s/(1 + T s))^{2 alpha}, whose cut is (-1/T, 0). The substitution s = -e^u/(1 + T e^u) moves
 * both ends of the cut to infinity. All nodes beyond e^u = 1e17/T have the rate 1/T, so their weights form one
 * geometric sum. */
int fvi_davidson_modes(const fvi_kernel_term *t, double slowest, double delta, fvi_kernel_modes *m)
{
    const double T = t->time, L = -log(delta), step = M_PI * M_PI / (L + 3),
                 order = 2 * t->alpha, last = -log(T) + 39,
                 sine = t->rho * step / M_PI * sin(M_PI * order);
    if (order >= 0.95 || order < 0.02)
        return FVI_EUNSUP;
    const double first = log(slowest) - L / order;
    if ((last - first) / step > MOST_MODES - 2)
        return FVI_EUNSUP;
    for (double u = last; u > first; u -= step) {
        const double q = T * exp(u), rate = exp(u) / (1 + q);
        double weight = sine * exp(order * u) / (1 + q);
        if (u == last)
            weight /= -expm1(-(1 - order) * step);
        fvi_kernel_modes_add(m, rate, weight);
    }
    return FVI_SUCCESS;
}

/* Compute the modes from the symbol on the cut: the weights are Im C(-rate + i0) / pi times the step in ln rate. The
 * loop ends when a slower mode no longer contributes. */
static int symbol_modes(const fvi_kernel_term *t, double slowest,
                        double fastest, double delta, double strip,
                        fvi_kernel_modes *m)
{
    const double step = strip * M_PI * M_PI / (3 - log(delta)),
                 spring = creal(fvi_kernel_term_at(t, 0x1p-900, 0));
    const size_t before = m->count;
    double most = 0;
    for (double u = log(fastest); u > -600; u -= step) {
        const double rate = exp(u),
                     weight = step / M_PI
                              * cimag(fvi_kernel_term_at(t, rate, M_PI));
        if (!isfinite(weight))
            return FVI_EUNSUP;
        most = larger(most, rate < slowest ? fabs(weight) : 0);
        if (rate < slowest && fabs(weight) <= delta / 100 * most)
            break;
        if (m->count - before == MOST_MODES - 1)
            return FVI_EUNSUP;
        if (weight != 0)
            fvi_kernel_modes_add(m, rate, weight);
    }
    if (spring > 0)
        fvi_kernel_modes_add(m, 0, spring);
    return FVI_SUCCESS;
}

int fvi_kernel_modes_of(const fvi_kernel_term *t, double slowest,
                        double fastest, double delta, double strip,
                        fvi_kernel_modes *modes)
{
    const int status =
        fvi_kernel_classes[t->kind]->modes
            ? fvi_kernel_classes[t->kind]->modes(t, slowest, delta, modes)
            : symbol_modes(t, slowest, fastest, delta, strip, modes);
    return status ? status : fvi_kernel_modes_check(modes);
}
