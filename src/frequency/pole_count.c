/* src/frequency/pole_count.c -- Count the poles of a system.               [H 30] */
#include "pole_count.h"

#include "winding.h"

#include <gsl/gsl_math.h>
#include <stdint.h>

/* ---- the theorem ---- */

/* Where the symbol of a term lies at s = -r + i0, for all r > 0. */
typedef enum {
    ON_THE_LINE = 0, /* real and not negative */
    ABOVE = 1,       /* above the real line */
    BELOW = 2,
    ABOVE_OR_ON = 4, /* above for some r, real and not negative for the others */
    NEGATIVE = 8,    /* real, and negative for some r */
    ANYWHERE = 16    /* not known */
} side;

//> sides
static side side_of_power(double order)
{
    return order == 0 || order == 2 ? ON_THE_LINE
           : order < 1              ? ABOVE
           : order > 1              ? BELOW
                                    : NEGATIVE;
}

static side side_of_term(const fvi_kernel_term *t)
{
    const double order = 2 * t->alpha;
    if (t->rho == 0)
        return ON_THE_LINE;
    switch (t->kind) {
    case FVI_KERNEL_POWER:
        return side_of_power(order);
    case FVI_KERNEL_ZENER: /* q / (1 + T q) is above the line if q is */
    case FVI_KERNEL_MAXWELL2:
        return t->time == 0 || order <= 1 ? side_of_power(order) : ANYWHERE;
    case FVI_KERNEL_DAVIDSON: /* for r > 1 / T it is real and positive */
        return t->time == 0 ? side_of_power(order)
               : order < 1  ? ABOVE_OR_ON
               : order == 1 ? NEGATIVE
                            : ANYWHERE;
    case FVI_KERNEL_MAXWELL:
        return NEGATIVE;
    case FVI_KERNEL_DISTRIBUTED:
        return t->end <= 0.5 ? ABOVE : t->alpha >= 0.5 ? BELOW : ANYWHERE;
    case FVI_KERNEL_SYMBOL:
        break;
    }
    return ANYWHERE;
}

/* A negative term needs a term above the line in the same law. */
int fvi_poles_by_theorem(const fvi_response *r, double least_lambda)
{
    int all = 0, fits = least_lambda > 0;
    for (size_t l = 2; l < r->terms; l++) {
        int sides = 0;
        for (size_t i = 0; i < r->term[l].kernel->count; i++)
            sides |= (int)side_of_term(&r->term[l].kernel->term[i]);
        fits = fits && !(sides & ANYWHERE)
               && (!(sides & NEGATIVE) || (sides & ABOVE));
        all |= sides;
    }
    return fits && (!(all & BELOW) || all == BELOW);
}
//< sides

/* ---- the argument principle ---- */

static double phase(const void *params, double u, double v)
{
    fvi_response *r = (fvi_response *)params;
    const double complex s = exp(u) * (cos(v) + I * sin(v));
    return fvi_stiffness_factorise(r, s, 1) ? GSL_NAN : fvi_stiffness_phase(r);
}

/* Return nonzero if the symbol has poles off the cut. A fraction has the denominator 1 + T s^b. This is zero where
 * b |arg s| = pi, so it has zeros off the cut for b > 1 alone. */
static int has_own_poles(const fvi_kernel *kernel)
{
    for (size_t i = 0; i < kernel->count; i++) {
        const fvi_kernel_term *t = &kernel->term[i];
        const double b = t->kind == FVI_KERNEL_ZENER      ? 2 * t->alpha
                         : t->kind == FVI_KERNEL_MAXWELL2 ? 2 * (t->alpha - t->end)
                                                          : 0;
        if (t->rho > 0 && t->time > 0 && b > 1)
            return 1;
    }
    return 0;
}

size_t fvi_poles_counted(fvi_response *r, double low, double high)
{
    if (r->d > FVI_ALWAYS_DENSE)
        return SIZE_MAX;
    for (size_t l = 2; l < r->terms; l++)
        if (has_own_poles(r->term[l].kernel))
            return SIZE_MAX;
    /* The phases of d pivots may turn together, so the step is short. Known blind spot: two real poles
     * that are nearly equal lie 0.0016 beside the box, turn the phase by a whole turn within one step,
     * and may be counted as two poles of the box. */
    const fvi_log_box all = { { low, high }, { 1.5, 3.14 } };
    const int count = fvi_winding(phase, r, 0.5 / (double)r->d, &all);
    return count < 0 ? SIZE_MAX : (size_t)count;
}
