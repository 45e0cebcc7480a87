/* src/memory/kernel_impulses.c -- The impulses of a start with a velocity, by any kernel.
 *                                                                             [H 26] */
#include "kernel_impulses.h"

#include "kernel_terms.h"
#include "system/fail.h"

#include <stdlib.h>

/* Laplace's integral is taken along the parabola s = mu (1 + i v)^2, by the midpoint rule in v
 * with 2 NODES points, of which one half are the conjugates of the others. A parabola serves all
 * times from t to SPAN t. With mu SPAN t = REACH the largest factor e^{s t} is e^REACH, so that
 * few digits cancel, and e^{s t} falls below 1e-17 where the nodes end. */
enum { NODES = 50, SPAN = 4, REACH = 3, EXACT = 64 };
static const double spacing = 0.15;

/* Kernels like a fraction with 2 alpha > 1 have poles off the cut: one and its conjugate. */
enum { MOST_POLES = 16 };

struct fvi_impulses_of_kernel {
    const fvi_kernel *law;
    double h;
    size_t first, count, k;        /* the parabola is that of k from `first` on; the last k */
    size_t poles;                  /* all of the law, but it is the rule that knows which are left
                                    * of the parabola */
    double complex pole[MOST_POLES], residue[MOST_POLES]; /* of C(s)/s^2 */
    double complex s[NODES + MOST_POLES], weight[NODES + MOST_POLES][2],
        step[NODES + MOST_POLES], power[NODES + MOST_POLES]; /* e^{s h}, e^{s k h} */
};

/* int_0^1 u e^{zu} du to w[1], int_0^1 (1 - u) e^{zu} du to w[0]. */
static void moments(double complex z, double complex w[2])
{
    if (cabs(z) > 0.5) {
        const double complex e = cexp(z);
        w[0] = (e - 1 - z) / (z * z);
        w[1] = (e * (z - 1) + 1) / (z * z);
        return;
    }
    double complex term = 1; /* z^n / n! */
    w[0] = w[1] = 0;
    for (int n = 0; n < 16; n++, term *= z / n) {
        w[0] += term / ((n + 1) * (n + 2));
        w[1] += term / (n + 2);
    }
}

/* The same of step 0 as an inverse transform at t = h: q is infinite at 0, and its integrals
 * are not. */
static void first_moments(double complex z, double complex w[2])
{
    w[1] = 1 / z - 1 / (z * z);
    w[0] = 1 / z - w[1];
}

/* ---- poles ---- */

static int find_poles(fvi_impulses_of_kernel *o)
{
    fvi_kernel_simple *term;
    size_t count;
    const int status = fvi_kernel_flatten(o->law, &term, &count);
    if (status)
        return status;
    for (size_t i = 0; i < count && o->poles < MOST_POLES; i++) {
        const fvi_kernel_simple *t = term + i;
        if (!(2 * t->below > 1 && t->time > 0 && t->rho > 0))
            continue;
        const double complex s =
            pow(t->time, -0.5 / t->below) * cexp(I * M_PI / (2 * t->below));
        o->pole[o->poles] = s; /* there time s^{2 below} = -1 */
        o->residue[o->poles++] =
            -t->rho * cpow(s, 2 * t->alpha + 1) / (2 * t->below) / (s * s);
    }
    free(term);
    return FVI_SUCCESS;
}

/* Is s to the right of the parabola? Then the integral along it does not know the pole. */
static int is_outside(double complex s, double mu)
{
    return creal(csqrt(s / mu)) > 1;
}

/* A parabola that passes no pole closely: of three the one that is farthest from them. */
static double choose_parabola(const fvi_impulses_of_kernel *o, double least)
{
    static const double part[] = { 1, 1.25, 1.5 };
    double best = least, farthest = -1;
    for (size_t l = 0; l < sizeof part / sizeof *part; l++) {
        double distance = 1e300;
        for (size_t i = 0; i < o->poles; i++) {
            const double complex root = csqrt(o->pole[i] / (least * part[l]));
            distance = fmin(distance, fabs(creal(root) - 1)); /* |Im v| */
        }
        if (distance > farthest) {
            farthest = distance;
            best = least * part[l];
        }
    }
    return best;
}

/* ---- the rule ---- */

/* The nodes for steps k >= first, and their weights. Those of step 0 are inverted at t = h. */
static void make_rule(fvi_impulses_of_kernel *o, size_t first)
{
    const double t = (first > 0 ? (double)first : 1) * o->h,
                 mu = choose_parabola(o, REACH / (SPAN * t));
    o->first = first;
    o->count = 0;
    for (int j = 0; j < NODES; j++) {
        const double complex v = 1 + I * (j + 0.5) * spacing, s = mu * v * v;
        o->s[o->count] = s;
        o->weight[o->count++][0] = 2 * mu / M_PI * spacing * v
                                   * fvi_kernel_at(o->law, s, NULL) / (s * s);
    }
    for (size_t i = 0; i < o->poles; i++)
        if (is_outside(o->pole[i], mu)) {
            o->s[o->count] = o->pole[i];
            o->weight[o->count++][0] = 2 * o->residue[i];
        }
    for (size_t j = 0; j < o->count; j++) {
        double complex w[2];
        (first > 0 ? moments : first_moments)(o->s[j] * o->h, w);
        o->weight[j][1] = o->weight[j][0] * w[1];
        o->weight[j][0] *= w[0];
        o->step[j] = cexp(o->s[j] * o->h);
    }
}

/* The powers at k: from the last k, or, so that they depend on k alone, from the last multiple
 * of EXACT. */
static void set_powers(fvi_impulses_of_kernel *o, size_t k, int is_next)
{
    size_t from = k - k % EXACT;
    if (from < o->first)
        from = o->first;
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

void fvi_impulses_of_kernel_at(fvi_impulses_of_kernel *o, size_t k, double impulse[2])
{
    const size_t first = first_of(k);
    const int is_new = o->count == 0 || first != o->first;
    if (is_new)
        make_rule(o, first);
    if (is_new || k != o->k)
        set_powers(o, k > 0 ? k : 1, !is_new && k == o->k + 1);
    o->k = k;
    impulse[0] = impulse[1] = 0;
    for (size_t j = 0; j < o->count; j++)
        for (int end = 0; end < 2; end++)
            impulse[end] += o->h * creal(o->weight[j][end] * o->power[j]);
}

/* ---- one of them ---- */

int fvi_impulses_of_kernel_alloc(const fvi_kernel *law, double h,
                                 fvi_impulses_of_kernel **impulses)
{
    fvi_impulses_of_kernel *o = calloc(1, sizeof *o);
    if (!o)
        FVI_FAIL("no memory for the impulses of a law", FVI_ENOMEM);
    o->law = law;
    o->h = h;
    const int status = find_poles(o);
    if (status)
        free(o);
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
