/* src/kernel/kernel_impulses.c -- The impulses of a start with a velocity, by any kernel.
 *                                                                             [H 26] */
#include "kernel_impulses.h"

#include "kernel_impulses_state.h"
#include "kernel_terms.h"
#include "system/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* int_0^1 u e^{zu} du to w[1], int_0^1 (1 - u) e^{zu} du to w[0]; and their derivatives. */
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

/* The same of step 0 as an inverse transform at t = h: q is infinite at 0, and its integrals
 * are not. */
static void first_moments(double complex z, double complex w[2], double complex slope[2])
{
    w[1] = 1 / z - 1 / (z * z);
    w[0] = 1 / (z * z);
    slope[1] = -w[0] + 2 * w[0] / z;
    slope[0] = -2 * w[0] / z;
}

/* ---- poles ---- */

/* Does rho s^{2 alpha} / (1 + time s^{2 below}) have a pole off the cut? There
 * time s^{2 below} = -1. */
static int add_pole(const fvi_kernel_simple *t, fvi_impulses_of_kernel *o)
{
    if (!(2 * t->below > 1 && t->time > 0 && t->rho > 0) || o->poles == MOST_POLES)
        return 0;
    const double complex s =
        pow(t->time, -0.5 / t->below) * cexp(I * M_PI / (2 * t->below));
    o->pole[o->poles++] =
        (pole){ .s = s,
                .residue = -t->rho * cpow(s, 2 * t->alpha + 1) / (2 * t->below),
                .part = 1 };
    return 1;
}

static int find_poles(const fvi_kernel *law, fvi_impulses_of_kernel *o)
{
    fvi_kernel_simple *term;
    size_t count;
    const int status = fvi_kernel_flatten(law, &term, &count);
    for (size_t i = 0; !status && i < count; i++)
        add_pole(term + i, o);
    if (!status)
        free(term);
    return status;
}

/* Of a fraction by its order or time: the logarithm of the residue, 2 alpha + 1 times ln s less
 * ln(2 alpha), is differentiated, and so is the pole. */
static void find_pole_of_slope(const fvi_kernel_term *term, fvi_slope_by by,
                               fvi_impulses_of_kernel *o)
{
    const double a = term->alpha;
    const fvi_kernel_simple fraction = { 1, a, term->time, a };
    if (term->kind != FVI_KERNEL_ZENER || by == FVI_SLOPE_BY_END || !add_pole(&fraction, o))
        return;
    pole *p = o->pole;
    const double complex ln = clog(p->s);
    p->moves = by == FVI_SLOPE_BY_ORDER ? -ln / a : -1 / (2 * a * term->time);
    p->part = (2 * a + 1) * p->moves
              + (by == FVI_SLOPE_BY_ORDER ? 2 * ln - 1 / a : 0);
}

/* ---- the rule ---- */

/* One node of step k: G(s) = e^{s k h} w(s h) / s^2 of both ends; of step 0 with e^{s h}, and the
 * weights of step 0. */
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

/* The nodes for steps k >= first. */
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
        pole both = o->pole[i]; /* and its conjugate */
        double complex slope;
        both.residue *= 2 * fvi_parabola_left_out(&rule, both.s, &slope);
        both.part += both.moves * slope;
        add_node(o, &both);
    }
}

/* The powers at k: from the last k, or, so that they depend on k alone, from the last multiple
 * of EXACT. */
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

/* The first step of the parabola of step k: 0, 1, 4, 16, ... */
static size_t first_of(size_t k)
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
    const size_t first = first_of(k);
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
    const double steps = k > 0 ? (double)k : 1; /* only of poles that move */
    for (size_t j = NODES; j < o->count; j++)
        for (int end = 0; end < 2; end++)
            impulse[end] += o->h * steps * creal(o->line[j][end] * o->power[j]);
}

/* ---- one of them ---- */

static int make(fvi_symbol_function *symbol, const void *of, double h,
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
    const int status = make(symbol, term, h, impulses);
    if (!status)
        find_pole_of_slope(term, by, *impulses);
    return status;
}

static double complex symbol_of_kernel(const void *law, double complex s)
{
    return fvi_kernel_at(law, s, NULL);
}

int fvi_impulses_of_kernel_alloc(const fvi_kernel *law, double h,
                                 fvi_impulses_of_kernel **impulses)
{
    fvi_impulses_of_kernel *o = NULL;
    int status = make(symbol_of_kernel, law, h, &o);
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
