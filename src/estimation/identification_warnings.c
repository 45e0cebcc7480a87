/* src/estimation/identification_warnings.c -- What to know before a fit is believed. [H 24] */
#include <fvi/error.h>
#include <fvi/identification.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ALIKE 0.9 /* a correlation above this is worth a word */
#define MOVED                                                                  \
    0.02 /* as are estimates that half the step moved by more of their sd */

int fvi_estimate_warning_of_pair(const fvi_estimate *fitted, size_t i, size_t j,
                            const char *name_i, const char *name_j, size_t size,
                            char *text)
{
    const double correlation = fitted->correlation[i][j];
    if (!(fabs(correlation) > ALIKE))
        return 0;
    snprintf(text, size,
             "these data can hardly tell %s and %s apart (correlation %.3f)",
             name_i, name_j, correlation);
    return 1;
}

int fvi_estimate_warning_of_model(const fvi_estimation *fit, const fvi_estimate *fitted,
                             size_t size, char *text)
{
    if (!(fabs(fitted->neighbours) > 5 / sqrt((double)fit->n)))
        return 0;
    snprintf(text, size,
             "neighbouring residuals are alike (correlation %.2f): the model, "
             "its past or its force is not that of the data, or their noise is "
             "not independent",
             fitted->neighbours);
    return 1;
}

int fvi_estimate_warning_of_step(const fvi_estimation *fit, const fvi_estimate *fitted,
                            size_t size, char *text)
{
    if (fit->h != 0 || fitted->bias <= MOVED)
        return 0;
    snprintf(text, size,
             "half the step moved the estimates by %.2g sd: take a method of "
             "higher order",
             fitted->bias);
    return 1;
}

const char *fvi_estimate_warning_of_initial_history(const fvi_estimation *fit,
                                    const fvi_estimate *fitted)
{
    fvi_system system = *fit->run->system;
    fvi_run run = *fit->run;
    double x0 = *run.x0, damping = *system.damping;
    for (size_t j = 0; j < fit->parameters; j++) {
        const double estimate = fitted->estimate[j];
        if (fit->which[j] == FVI_FREE_PARAMETER_ALPHA)
            run.alpha = estimate;
        else if (fit->which[j] == FVI_FREE_PARAMETER_RHO)
            damping = estimate;
        else if (fit->which[j] == FVI_FREE_PARAMETER_X0)
            x0 = estimate;
    }
    system.damping = &damping;
    run.system = &system;
    run.x0 = &x0;
    const char *text; /* one mass takes no memory to find out */
    fvi_warning_of_initial_history(&run, &text);
    return text;
}

/* Without a force m x'' and all else may be multiplied by one number. */
static int is_mass_free(const fvi_estimation *fit)
{
    const fvi_force *force = &fit->run->system->force;
    int fits_mass = 0;
    for (size_t j = 0; j < fit->parameters; j++)
        fits_mass |= fit->which[j] == FVI_FREE_PARAMETER_MASS;
    return fits_mass && !force->value && force->impulse_count == 0;
}

/* The steps that a method of equal steps would take to the last time: of the length asked for,
 * or of the shortest gap between the times. */
static double equal_steps_needed(const fvi_estimation *fit)
{
    const double *t = fit->t, T = t[fit->n - 1];
    double gap = fit->h > 0 ? fit->h : T;
    for (size_t i = 1; i < fit->n && fit->h == 0; i++)
        gap = smaller(gap, t[i] - t[i - 1]);
    return fit->method->dense ? 0 : T / gap;
}

static void add_equal_steps(const fvi_estimation *fit, size_t size, char *text)
{
    const double needed = equal_steps_needed(fit);
    const size_t end = strlen(text);
    if (needed > FVI_FIT_MOST_EQUAL_STEPS)
        snprintf(text + end, size - end,
                 "; to t = %.10g %s take %.3g equal steps, and a fit makes %d; "
                 "fvi-adaptive chooses its own",
                 fit->t[fit->n - 1],
                 fit->h > 0 ? "steps of that length"
                            : "steps as short as the gaps of the data",
                 needed, FVI_FIT_MOST_EQUAL_STEPS);
}

int fvi_estimate_reason(int status, const fvi_estimation *fit, const fvi_estimate *fitted,
                   const char *names, const char *dashes, size_t size,
                   char *text)
{
    if (status == FVI_EMAXITER)
        snprintf(text, size,
                 "%zu of %zu starts agree on the best fit, which is not enough "
                 "to believe it; try more %sstarts, or begin nearer",
                 fitted->agree, fit->starts, dashes);
    else if (status == FVI_ETOL)
        snprintf(text, size,
                 "chi2 = %.6g, where about %g is expected (probability %.1g): "
                 "the model, its past, its force or %ssigma is not that of the "
                 "data",
                 fitted->chi2, (double)(fit->n - fit->parameters),
                 fitted->probability, dashes);
    else if (status == FVI_ESING)
        snprintf(text, size, "these data do not determine %s%s%s", names,
                 fit->parameters > 1 ? " together" : "",
                 is_mass_free(fit)
                     ? "; without a force mass, rho, c, g and p0 are known but "
                       "for a common factor"
                     : "");
    else if (status == FVI_ERUNAWAY)
        snprintf(text, size,
                 "three motions took more than %zu steps, and the last came to "
                 "t = %.10g, where the data go to t = %.10g; %s N allows N",
                 fit->run->most_steps > 0 ? fit->run->most_steps
                                          : (size_t)FVI_FIT_MOST_STEPS,
                 fitted->reached, fit->t[fit->n - 1],
                 *dashes ? "--most-steps" : "most_steps");
    else if (status == FVI_EBADFUNC)
        snprintf(text, size, "no start gives a motion that can be computed");
    else
        return 0;
    if (status != FVI_ERUNAWAY)
        add_equal_steps(fit, size, text);
    return 1;
}
