/* src/frequency/pole_count.c -- Count the poles of a system.               [H 30] */
#include "pole_count.h"

#include "kernel/kernel_classes.h"
#include "pole_search.h"
#include "winding.h"

#include <gsl/gsl_math.h>
#include <stdint.h>

/* ---- the theorem ---- */

//> theorem
/* Return where the symbol of a term lies at s = -r + i0, for all r > 0. */
static fvi_kernel_side side_of_term(const fvi_kernel_term *t)
{
    const fvi_kernel_class *of = fvi_kernel_classes[t->kind];
    fvi_kernel_simple f;
    return t->rho == 0                      ? FVI_SIDE_ON_THE_LINE
           : fvi_kernel_is_fraction(t, &f) ? fvi_fraction_side(&f)
           : of->side                      ? of->side(t)
                                           : FVI_SIDE_ANYWHERE;
}

/* A negative term needs a term above the line in the same law. */
int fvi_poles_by_theorem(const fvi_response *r, double least_lambda)
{
    int all = 0, fits = least_lambda > 0;
    for (size_t l = 2; l < r->terms; l++) {
        int sides = 0;
        for (size_t i = 0; i < r->term[l].kernel->count; i++)
            sides |= (int)side_of_term(&r->term[l].kernel->term[i]);
        fits = fits && !(sides & FVI_SIDE_ANYWHERE)
               && (!(sides & FVI_SIDE_NEGATIVE) || (sides & FVI_SIDE_ABOVE));
        all |= sides;
    }
    return fits && (!(all & FVI_SIDE_BELOW) || all == FVI_SIDE_BELOW);
}
//< theorem

/* ---- the argument principle ---- */

double fvi_poles_phase(const void *params, double u, double v)
{
    fvi_response *r = (fvi_response *)params;
    const double complex s = exp(u) * (cos(v) + I * sin(v));
    return fvi_stiffness_factorise(r, s, 1) ? GSL_NAN : fvi_complex_factors_phase(r->factors);
}

/* The phases of d pivots may turn together, so the step is short. */
double fvi_poles_step(const fvi_response *r)
{
    return 0.5 / (double)r->d;
}

/* Return nonzero if the symbol has poles off the cut. A fraction has the denominator 1 + T s^b. This is zero where
 * b |arg s| = pi, so it has zeros off the cut for b > 1 alone. */
static int has_own_poles(const fvi_kernel *kernel)
{
    for (size_t i = 0; i < kernel->count; i++) {
        const fvi_kernel_term *t = &kernel->term[i];
        fvi_kernel_simple fraction;
        if (t->rho > 0 && fvi_kernel_is_fraction(t, &fraction) && fraction.time > 0 && 2 * fraction.below > 1)
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
    const fvi_log_box all = { { low, high }, { 1.5, FVI_NEARLY_REAL } };
    const int count = fvi_winding(fvi_poles_phase, r, fvi_poles_step(r), &all);
    return count < 0 ? SIZE_MAX : (size_t)count;
}
