/* src/kernel/kernel_impulses.c -- Compute the impulses of any kernel after a start with a velocity.    [H 26] */
#include "kernel_impulses.h"

#include "kernel_general.h"
#include "kernel_impulses_state.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Compute w[0] = int_0^1 (1 - u) e^{zu} du, w[1] = int_0^1 u e^{zu} du, and their derivatives by z. */
static void moments(double complex z, double complex w[2], double complex slope[2])
{
    if (cabs(z) > 0.5) {
        const double complex e = cexp(z);
        w[0] = (e - 1 - z) / (z * z);
        w[1] = (e * (z - 1) + 1) / (z * z);
        slope[0] = (e - 1) / (z * z) - 2 * w[0] / z;
        slope[1] = e / z - 2 * w[1] / z;
        return;
    }
    double complex term = 1; /* z^n / n! */
    w[0] = w[1] = slope[0] = slope[1] = 0;
    for (int n = 0; n < 16; n++, term *= z / n) {
        w[0] += term / ((n + 1) * (n + 2));
        w[1] += term / (n + 2);
        slope[0] += term / ((n + 2) * (n + 3));
        slope[1] += term / (n + 3);
    }
}

/* Compute the same integrals for step 0 as an inverse transform at t = h. There q is infinite at t = 0, but its
 * integrals are finite. */
static void first_moments(double complex z, double complex w[2], double complex slope[2])
{
    w[1] = 1 / z - 1 / (z * z);
    w[0] = 1 / (z * z);
    slope[1] = -w[0] + 2 * w[0] / z;
    slope[0] = -2 * w[0] / z;
}

/* ---- poles ---- */

static int has_pole(const fvi_kernel_simple *t)
{
    return 2 * t->below > 1 && t->time > 0 && t->rho > 0;
}

/* Add the pole of rho s^{2 alpha} / (1 + time s^{2 below}) off the cut, where time s^{2 below} = -1. */
static void add_pole(const fvi_kernel_simple *t, fvi_impulses_of_kernel *o)
{
    const double complex s =
        pow(t->time, -0.5 / t->below) * cexp(I * M_PI / (2 * t->below));
    o->pole[o->poles++] =
        (pole){ .s = s,
                .residue = -t->rho * cpow(s, 2 * t->alpha + 1) / (2 * t->below),
                .part = 1 };
}

static int find_poles(const fvi_kernel *law, fvi_impulses_of_kernel *o)
{
    fvi_kernel_simple *term;
    size_t count, poles = 0;
    const int status = fvi_kernel_flatten(law, &term, &count);
    if (status)
        return status;
    for (size_t i = 0; i < count; i++)
        poles += (size_t)has_pole(term + i);
    for (size_t i = 0; i < count && poles <= MOST_POLES; i++)
        if (has_pole(term + i))
            add_pole(term + i, o);
    free(term);
    if (poles > MOST_POLES)
        FVI_FAIL("a law may have 64 terms with poles off the cut at most", FVI_EUNSUP);
    return FVI_SUCCESS;
}

/* Find the pole of the derivative of a Zener element or of two springpots in series. The logarithm of the residue is
 * (2 alpha + 1) ln s - ln(2 below) + a constant, and the pole is at ln s = (i pi - ln time) / (2 below). Both are
 * differentiated. The order below is alpha or alpha - end. */
static int find_pole_of_slope(const fvi_kernel_term *term, fvi_slope_by by,
                              fvi_impulses_of_kernel *o)
{
    fvi_kernel_simple t;
    if (!fvi_kernel_is_fraction(term, &t) || !has_pole(&t))
        return FVI_SUCCESS;
    if (term->kind != FVI_KERNEL_ZENER && term->kind != FVI_KERNEL_MAXWELL2)
        FVI_FAIL("the derivatives of this law have a pole off the cut, which is not known", FVI_EUNSUP);
    add_pole(&t, o);
    pole *p = o->pole;
    const double complex ln = clog(p->s);
    p->moves = by == FVI_SLOPE_BY_TIME    ? -1 / (2 * t.below * t.time)
               : by == FVI_SLOPE_BY_ORDER ? -ln / t.below
                                          : ln / t.below;
    p->part = (2 * t.alpha + 1) * p->moves
              + (by == FVI_SLOPE_BY_ORDER ? 2 * ln - 1 / t.below : by == FVI_SLOPE_BY_END ? 1 / t.below : 0);
    return FVI_SUCCESS;
}

/* ---- the rule ---- */

/* Add a node with the factors G(s) = w(s h) / s^2 of the impulses; the factor e^{s k h} of step k is added later. Step
 * 0 has the factor e^{s h} and the moments of first_moments. */
static void add_node(fvi_impulses_of_kernel *o, const pole *p)
{
    const size_t j = o->count++;
    const double complex z = p->s * o->h;
    double complex w[MOST_IMPULSES] = { 0 }, slope[2] = { 0 };
    o->s[j] = p->s;
    o->step[j] = cexp(z);
    if (o->at_stages) {
        fvi_stage_moments(o, z, w);
        for (size_t i = 0; i < o->n; i++)
            o->weight[j][i] = p->residue / (p->s * p->s) * w[i];
        return;
    }
    (o->first > 0 ? moments : first_moments)(z, w, slope);
    for (int end = 0; end < 2; end++) {
        const double complex G = p->residue / (p->s * p->s);
        o->weight[j][end] =
            G * ((p->part - 2 * p->moves) * w[end] + p->moves * z * slope[end]);
        o->line[j][end] = G * p->moves * z * w[end];
    }
}

/* Compute the nodes for the steps k >= first. */
static void make_rule(fvi_impulses_of_kernel *o, size_t first)
{
    fvi_parabola rule;
    fvi_parabola_make((first > 0 ? (double)first : 1) * o->h, &rule);
    o->first = first;
    o->count = 0;
    for (int j = 0; j < NODES; j++)
        add_node(o, &(pole){ .s = rule.s[j],
                             .residue = rule.weight[j] * o->symbol(o->of, rule.s[j]),
                             .part = 1 });
    for (size_t i = 0; i < o->poles; i++) {
        pole both = o->pole[i]; /* the pole and its conjugate */
        double complex slope;
        both.residue *= 2 * fvi_parabola_left_out(&rule, both.s, &slope);
        both.part += both.moves * slope;
        add_node(o, &both);
    }
}

size_t fvi_inverse_nodes(const fvi_impulses_of_kernel *o, double t, double complex *s, double complex *weight)
{
    fvi_parabola rule;
    fvi_parabola_make(t, &rule);
    for (size_t j = 0; j < NODES; j++) {
        s[j] = rule.s[j];
        weight[j] = rule.weight[j] * o->symbol(o->of, rule.s[j]);
    }
    for (size_t i = 0; i < o->poles; i++) {
        s[NODES + i] = o->pole[i].s;
        weight[NODES + i] = 2 * o->pole[i].residue * fvi_parabola_left_out(&rule, o->pole[i].s, NULL);
    }
    return NODES + o->poles;
}

/* Compute the powers e^{s k h}. If k is the last k plus 1, one product is enough. Otherwise the products begin at the
 * last multiple of EXACT, so that the powers depend on k only. */
static void set_powers(fvi_impulses_of_kernel *o, size_t k, int is_next)
{
    const size_t exact = k - k % EXACT, from = exact > o->first ? exact : o->first;
    is_next = is_next && k != from;
    for (size_t j = 0; j < o->count; j++) {
        if (!is_next)
            o->power[j] = cexp(o->s[j] * ((double)from * o->h));
        for (size_t l = is_next ? k - 1 : from; l < k; l++)
            o->power[j] *= o->step[j];
    }
}

/* Return the first step of the parabola that serves step k: 0, 1, 4, 16, ... */
static size_t first_step_of_parabola(size_t k)
{
    size_t first = k > 0;
    while (first > 0 && first <= k / SPAN)
        first *= SPAN;
    return first;
}

void fvi_impulses_of_kernel_at(fvi_impulses_of_kernel *o, size_t k, double *impulse)
{
    if (k == 0 && o->at_stages) {
        memcpy(impulse, o->start, o->n * sizeof *impulse);
        return;
    }
    const size_t first = first_step_of_parabola(k);
    const int is_new = o->count == 0 || first != o->first;
    if (is_new)
        make_rule(o, first);
    if (is_new || k != o->k)
        set_powers(o, k > 0 ? k : 1, !is_new && k == o->k + 1);
    o->k = k;
    for (size_t i = 0; i < o->n; i++)
        impulse[i] = 0;
    for (size_t j = 0; j < o->count; j++)
        for (size_t i = 0; i < o->n; i++)
            impulse[i] += o->h * creal(o->weight[j][i] * o->power[j]);
    if (o->at_stages)
        return;
    const double steps = k > 0 ? (double)k : 1; /* only poles that move have this term */
    for (size_t j = NODES; j < o->count; j++)
        for (int end = 0; end < 2; end++)
            impulse[end] += o->h * steps * creal(o->line[j][end] * o->power[j]);
}

/* ---- allocation ---- */

static int make_impulses(fvi_symbol_function *symbol, const void *of, double h,
                         fvi_impulses_of_kernel **impulses)
{
    fvi_impulses_of_kernel *o = calloc(1, sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the impulses of a law", FVI_ENOMEM);
    o->symbol = symbol;
    o->of = of;
    o->h = h;
    o->n = 2;
    *impulses = o;
    return FVI_SUCCESS;
}

int fvi_impulses_of_slope_alloc(fvi_symbol_function *symbol, const fvi_kernel_term *term,
                                fvi_slope_by by, double h,
                                fvi_impulses_of_kernel **impulses)
{
    const int status = make_impulses(symbol, term, h, impulses);
    return status ? status : find_pole_of_slope(term, by, *impulses);
}

static double complex symbol_of_kernel(const void *law, double complex s)
{
    return fvi_kernel_at(law, s, NULL);
}

int fvi_impulses_of_kernel_alloc(const fvi_kernel *law, double h,
                                 fvi_impulses_of_kernel **impulses)
{
    fvi_impulses_of_kernel *o = NULL;
    int status = make_impulses(symbol_of_kernel, law, h, &o);
    if (!status)
        status = find_poles(law, o);
    if (status)
        fvi_impulses_of_kernel_free(o);
    else
        *impulses = o;
    return status;
}

int fvi_impulses_of_kernel_copy(const fvi_impulses_of_kernel *from,
                                fvi_impulses_of_kernel **to)
{
    *to = malloc(sizeof **to);
    if (!*to)
        FVI_FAIL("no memory for the impulses of a law", FVI_ENOMEM);
    **to = *from;
    return FVI_SUCCESS;
}

void fvi_impulses_of_kernel_free(fvi_impulses_of_kernel *o)
{
    free(o);
}
