/* src/methods/stability_number.c -- The stability numbers of the methods.       [H 13, 14 and 17] */
#include "stability_number.h"
#include "damping.h"
#include "kernel/kernel_terms.h"
#include "shifted_kernel.h"
#include "system/fail.h"

#include <fvi/stability.h>
#include "stability/stability_share.h"

#include <math.h>
#include <stdlib.h>

/* Return the factor of the damping at z = -1: C(s/h) for a law, and 1 for a power, because the formula of the caller
 * contains (s/h)^{2 alpha}. For a law alpha is 0 (fvi_run_normal). delta(-1) is s = 2 for Euler, and s = 4 for BDF2. */
static double symbol_of_law(const fvi_run *run, double s)
{
    return run->law ? fvi_kernel_symbol(run->law, s / run->h) : 1;
}

/* The contribution of a damper to the load of a method, at z = -1, where delta(z) is `s`. */
typedef double of_kernel(const fvi_run_damper *damper, double s);

/* Return (1 - 2 theta) E(s) at s = 2/h. For a single power E is its symbol. */
static double shifted_symbol(const fvi_run_damper *damper, double s)
{
    const double mean = 1 - damper->growth;
    if (fvi_shifted_is_itself(damper->law))
        return mean * fvi_run_damper_symbol(damper, s);
    double complex slope;
    const double complex C = fvi_kernel_at(damper->law, s, &slope);
    return mean * creal(mean * C + slope);
}

static double no_damping(const fvi_run_damper *damper, double s)
{
    (void)damper, (void)s;
    return 0;
}

/* Compute the load of a run with several dampers. */
static int find_number_of_dampers(const fvi_run *run, of_kernel *part, double s, double *load)
{
    const size_t count = run->system->mechanism->damper_count;
    double *damper = calloc(count + 1, sizeof *damper);
    if (!damper)
        FVI_FAIL("no memory for the load", FVI_ENOMEM);
    for (size_t j = 0; j < count; j++) {
        const fvi_run_damper of = fvi_run_damper_of(run, j);
        damper[j] = run->h * run->h * part(&of, s / run->h);
    }
    const int status = fvi_stability_of_dampers(damper, run, load);
    free(damper);
    return status;
}

static int has_dampers(const fvi_run *run)
{
    return run->system && run->system->mechanism;
}

int fvi_stability_number_backward(const fvi_run *run, double *load)
{
    if (has_dampers(run))
        return find_number_of_dampers(run, fvi_run_damper_symbol, 2, load);
    return fvi_stability_share(symbol_of_law(run, 2), run, load);
}

int fvi_stability_number_shifted(const fvi_run *run, double *load)
{
    if (has_dampers(run))
        return find_number_of_dampers(run, shifted_symbol, 2, load);
    const fvi_run_damper of = fvi_run_damper_of(run, 0);
    double largest;
    const double share =
        of.law ? shifted_symbol(&of, 2 / run->h) : 1 - of.growth;
    int status = fvi_stability_share(share, run, &largest);
    if (!status)
        *load = fmax(0, largest); /* for alpha > 1/2 the damping stabilises */
    return status;
}

int fvi_stability_number_bdf2(const fvi_run *run, double *load)
{
    if (has_dampers(run))
        return find_number_of_dampers(run, fvi_run_damper_symbol, 4, load);
    return fvi_stability_share(pow(4, run->alpha) * symbol_of_law(run, 4), run, load);
}

int fvi_stability_number_none(const fvi_run *run, double *load)
{
    fvi_run half = *run; /* the method does not use kappa */
    half.kappa = 0.5;
    if (has_dampers(run))
        return find_number_of_dampers(&half, no_damping, 2, load);
    return fvi_stability_share(0, &half, load);
}
