/* src/variable_step/variable_step_kernel.c -- Any law of damping in a run with variable steps. [H 26]
 *
 * Let k(s) = C(s)/s. The present part of a step is k(A^{-1}/h), computed by the eigenvalues of A^{-1}. The past is a
 * sum over modes. A term with growth up to 1 has
 *
 *     k(s) = sum_q w_q / (s + sigma_q)
 *
 * and the state y = sigma w, (22.6). A term that grows faster, which we call rising, has
 *
 *     k(s) = sum_q w_q s / (s + sigma_q)
 *
 * and the state z, (22.7). The rates are those of a ladder, as fine as the poles beside the cut need it, and those of
 * single poles, which are on no ladder. (26.18) */
#include "variable_step.h"

#include "kernel/kernel_classes.h"
#include "system/dot.h"
#include "system/fail.h"
#include "system/larger.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct fvi_variable_step_kernel {
    const fvi_kernel *law;
    size_t terms;
    fvi_kernel_simple term[]; /* the terms of the law that are fractions of powers */
};

static int is_rising(const fvi_kernel_simple *t)
{
    return 2 * (t->time > 0 ? t->alpha - t->below : t->alpha) > 1;
}

/* Return C(s)/s in place of C(s), which grows like s^2 and may overflow at the shortest steps. */
static fvi_kernel_simple divide_by_s(const fvi_kernel_simple *t)
{
    return (fvi_kernel_simple){ t->rho, t->alpha - 0.5, t->time, t->time > 0 ? t->below : 0 };
}

/* ---- modes ---- */

/* Every term with a cut is on a ladder of modes. A relaxation and a spring are single poles, and other terms without a
 * cut have no past. In the lists of modes the weights of rising terms are divided by their rates, because they would
 * overflow. */
enum { MOST_MODES = 6000 };

/* Return Im C(-sigma + i0) / pi of the rising or of the other terms, with u = ln sigma. */
static double density(const fvi_variable_step_kernel *k, int rising, double u)
{
    double sum = 0;
    for (size_t i = 0; i < k->terms; i++)
        if (fvi_kernel_has_cut(&k->term[i]) && is_rising(&k->term[i]) == rising)
            sum += fvi_kernel_on_the_cut(&k->term[i], k->term[i].rho, u);
    return sum / M_PI;
}

/* Return this density divided by sigma. If the density overflows, compute the quotient from C(s)/s. */
static double density_over_rate(const fvi_variable_step_kernel *k, int rising, double u, double rate)
{
    const double whole = density(k, rising, u);
    double sum = 0;
    if (isfinite(whole))
        return whole / rate;
    for (size_t i = 0; i < k->terms; i++) {
        const fvi_kernel_simple t = divide_by_s(&k->term[i]);
        if (fvi_kernel_has_cut(&k->term[i]) && is_rising(&k->term[i]) == rising)
            sum -= fvi_kernel_on_the_cut(&t, t.rho, u); /* s = -sigma there */
    }
    return sum / M_PI;
}

/* Return the distance of the nearest pole from the cut in ln sigma, less a tenth; 0 if a pole lies not beside the cut
 * but before it. *any: nonzero if a term has a ladder at all. */
static double strip_width(const fvi_variable_step_kernel *k, int rising, int *any)
{
    double width = M_PI_2;
    *any = 0;
    for (size_t i = 0; i < k->terms; i++) {
        const fvi_kernel_simple *t = &k->term[i];
        if (!fvi_kernel_has_cut(t) || is_rising(t) != rising)
            continue;
        *any = 1;
        if (t->time > 0)
            width = smaller(width, fmax(0, 0.9 * M_PI * (0.5 / t->below - 1)));
    }
    return width;
}

/* Return the rate of the fastest mode: mu is 1e6 in the shortest step. It is infinite if that step is too short. */
static double fastest_rate(const fvi_variable_step_state *o)
{
    return 1e6 / o->least;
}

/* Add the modes from mu = 1e6 in the shortest step down to sigma T = 1e-8. One more mode stands for all rates below,
 * with the same two moments. */
//> ladder
static int add_ladder(const fvi_variable_step_state *o, const fvi_variable_step_kernel *k, int rising,
                      fvi_kernel_modes *l)
{
    int any;
    const double width = strip_width(k, rising, &any), step = 2 * M_PI * width / 36,
                 last = log(fastest_rate(o)), first = log(1e-8 / o->T);
    if (any && !isfinite(last))
        FVI_FAIL("the run is too short: the fastest decay rate of its memory would be above 1.8e308", FVI_EDOM);
    if (any && !((last - first) / step < MOST_MODES - 2))
        return FVI_EUNSUP; /* poles are too near to the cut, or off it */
    double u = last, S0 = 0, S1 = 0;
    for (; any && u > first; u -= step)
        fvi_kernel_modes_add(l, exp(u),
                             step * (rising ? density_over_rate(k, rising, u, exp(u)) : density(k, rising, u)));
    for (size_t i = 0; i < k->terms; i++) {
        const fvi_kernel_simple *t = &k->term[i];
        if (fvi_kernel_has_cut(t) && is_rising(t) == rising)
            fvi_kernel_tail(t, step * t->rho / M_PI, 0, u + step, step,
                            rising ? -1 : 0, &S0, &S1);
    }
    if (any && S0 != 0)
        fvi_kernel_modes_add(l, S1 / S0, S0);
    return FVI_SUCCESS;
}
//< ladder

/* Add the single poles, and all springs as one mode of the rate 0. */
static void add_poles(const fvi_variable_step_kernel *k, fvi_kernel_modes *l)
{
    double springs = 0;
    for (size_t i = 0; i < k->terms; i++) {
        const fvi_kernel_simple *t = &k->term[i];
        if (fvi_kernel_is_relaxation(t))
            fvi_kernel_modes_add(l, 1 / t->time, t->rho / t->time);
        if (t->alpha == 0)
            springs += t->rho / (1 + t->time);
    }
    if (springs != 0)
        fvi_kernel_modes_add(l, 0, springs);
}

/* Return nonzero if the modes of a term on the cut are complete. They stand in the list from mode `first` on. k itself
 * may contain a dashpot, so the test compares the change of k from s to 2 s, at all time scales of the run. */
static int modes_reproduce_kernel(const fvi_kernel_term *t, const fvi_kernel_modes *m, size_t first,
                                  double slowest, double fastest)
{
    for (double s = slowest; s < fastest; s *= 2) {
        const double change = creal(fvi_kernel_term_at(t, s, 0)) / s
                              - creal(fvi_kernel_term_at(t, 2 * s, 0)) / (2 * s),
                     size = creal(fvi_kernel_term_at(t, s, 0)) / s;
        double sum = 0;
        for (size_t j = first; j < m->count; j++)
            sum += m->weight[j]
                   * (1 / (s + m->rate[j]) - 1 / (2 * s + m->rate[j]));
        if (!(fabs(sum - change) <= 1e-11 * fabs(size)))
            return 0;
    }
    return 1;
}

/* Add the modes of one general term. Try the widest strip first. */
static int add_general_term(const fvi_variable_step_state *o, const fvi_kernel_term *t, fvi_kernel_modes *l)
{
    if (!isfinite(fastest_rate(o)))
        FVI_FAIL("the run is too short: the fastest decay rate of its memory would be above 1.8e308", FVI_EDOM);
    const size_t before = l->count;
    for (double width = 1; width > 0.1; width /= 2) {
        const int status = fvi_kernel_modes_of(t, 1e-2 / o->T, fastest_rate(o), 1e-15, width, l);
        if (status && status != FVI_EUNSUP)
            return status;
        if (!status
            && (!fvi_kernel_is_on_cut(t) || modes_reproduce_kernel(t, l, before, 1 / o->T, 1e-6 / o->least)))
            return FVI_SUCCESS;
        l->count = before;
    }
    return FVI_EUNSUP;
}

static int add_general(const fvi_variable_step_state *o, const fvi_kernel *law, fvi_kernel_modes *l)
{
    int status = FVI_SUCCESS;
    for (size_t i = 0; !status && i < law->count; i++)
        if (fvi_kernel_is_general(&law->term[i]) && law->term[i].rho > 0)
            status = add_general_term(o, &law->term[i], l);
    return status;
}

/* A rate of a short run, times the density there, may be above the largest double. */
static int check_modes(const fvi_kernel_modes *l)
{
    for (size_t q = 0; q < l->count; q++)
        if (!isfinite(l->rate[q]) || !isfinite(l->weight[q]))
            FVI_FAIL("the run is too short: the weights of its memory, times their decay rates, would be above 1.8e308",
                     FVI_EDOM);
    return fvi_kernel_modes_check(l);
}

/* Allocate the modes of one group for `count` numbers; none if the list is empty. */
static int make_modes(const fvi_variable_step_state *o, int rising, size_t count, fvi_kernel_modes *l,
                      fvi_modes **modes)
{
    const double standstill = 1e-16 / o->T;
    const int status = check_modes(l);
    for (size_t q = 0; q < l->count; q++) {
        l->rate[q] = larger(l->rate[q], standstill);
        l->weight[q] /= rising ? -1 : l->rate[q];
    }
    return status || l->count == 0
               ? status
               : fvi_modes_of_rates(o->rule, rising, count, o->T, l->count, l->rate, l->weight, modes);
}

/* ---- preparation ---- */

int fvi_variable_step_prepare_kernel(const fvi_kernel *law,
                                     fvi_variable_step_kernel **kernel)
{
    fvi_kernel_simple *term;
    size_t terms;
    int status = fvi_kernel_flatten(law, &term, &terms);
    if (status)
        return status;
    fvi_variable_step_kernel *k =
        malloc(sizeof *k + terms * sizeof *k->term);
    if (k) {
        *k = (fvi_variable_step_kernel){ .law = law, .terms = terms };
        memcpy(k->term, term, terms * sizeof *term);
    }
    free(term);
    if (!k)
        FVI_FAIL("no memory for the law", FVI_ENOMEM);
    *kernel = k;
    return FVI_SUCCESS;
}

fvi_variable_step_kernel *
fvi_variable_step_copy_kernel(const fvi_variable_step_kernel *from)
{
    const size_t bytes = sizeof *from + from->terms * sizeof *from->term;
    fvi_variable_step_kernel *k = malloc(bytes);
    return k ? memcpy(k, from, bytes) : NULL;
}

int fvi_variable_step_begin_kernel(const fvi_variable_step_state *o, const fvi_variable_step_kernel *k, size_t count,
                                   fvi_modes **modes, fvi_modes **rising)
{
    fvi_kernel_modes slow = { 0 }, fast = { 0 };
    int status = add_ladder(o, k, 0, &slow);
    add_poles(k, &slow);
    if (!status)
        status = add_general(o, k->law, &slow);
    if (!status)
        status = add_ladder(o, k, 1, &fast);
    const int none = status == FVI_EUNSUP;
    if (!status)
        status = make_modes(o, 0, count, &slow, modes);
    if (!status)
        status = make_modes(o, 1, count, &fast, rising);
    free(slow.rate);
    free(fast.rate);
    if (none)
        FVI_FAIL("law: a pole or a branch point of this law is too near to its cut, or off it, for modes of variable "
                 "steps; fvi-bdf2 and fvi-stable take it", FVI_EUNSUP);
    return status;
}

/* ---- the present part ---- */

/* Above this modulus s^2 may overflow, so C(s)/s is computed directly. */
static const double MOST_MODULUS = 1e150;

/* Return k at modulus e^(i angle), of the rising terms or of the other terms. */
static double complex evaluate_group(const fvi_variable_step_kernel *k, int rising,
                                     double modulus, double angle)
{
    const int is_over_s = rising && modulus > MOST_MODULUS;
    double complex C = 0;
    for (size_t i = 0; i < k->terms; i++) {
        const fvi_kernel_simple t = is_over_s ? divide_by_s(&k->term[i]) : k->term[i];
        if (k->term[i].rho > 0 && is_rising(&k->term[i]) == rising)
            C += fvi_kernel_simple_at(&t, modulus, angle);
    }
    for (size_t i = 0; !rising && i < k->law->count; i++)
        if (fvi_kernel_is_general(&k->law->term[i]))
            C += fvi_kernel_term_at(&k->law->term[i], modulus, angle);
    return is_over_s ? C : C / (modulus * (cos(angle) + I * sin(angle)));
}

void fvi_variable_step_present_kernel(const fvi_variable_rule *rule, const fvi_variable_step_kernel *k, double h,
                                      double beta, fvi_square *W0, double *W1)
{
    const double scale = pow(h, beta), ones[FVI_LANES] = { 1, 1, 1, 1,
                                                           1, 1, 1, 1 };
    double re[2][FVI_LANES / 2], im[2][FVI_LANES / 2];
    for (size_t n = 0; n < rule->s / 2; n++) {
        const double modulus = exp(rule->log_modulus[n]) / h;
        const double complex slow =
            scale * evaluate_group(k, 0, modulus, rule->angle[n]);
        const double complex all =
            slow + scale * evaluate_group(k, 1, modulus, rule->angle[n]);
        re[0][n] = creal(slow);
        im[0][n] = cimag(slow);
        re[1][n] = creal(all);
        im[1][n] = cimag(all);
    }
    fvi_variable_function(rule, re[0], im[0], W0);
    fvi_square_apply(rule->s, W0, ones, W1);
    fvi_variable_function(rule, re[1], im[1], W0);
}

double fvi_memory_leakage(const fvi_variable_rule *rule, const fvi_square *W0)
{
    double W_last[FVI_LANES];
    fvi_square_apply(rule->s, W0, rule->last, W_last);
    return fabs(fvi_dot(rule->s, rule->b, W_last));
}
