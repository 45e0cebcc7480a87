/* src/estimation/identification_warnings.c -- Warn about the answer of a fit. [H 24] */
#include "identification_examine.h"

#include <fvi/error.h>
#include "system/larger.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define LARGE_CORRELATION 0.9 /* a correlation above this gives a warning */

int fvi_estimate_warning_of_pair(const fvi_estimate *fitted, size_t i, size_t j,
                            const char *name_i, const char *name_j, size_t size,
                            char *text)
{
    const double correlation = fitted->correlation[i][j];
    if (!(fabs(correlation) > LARGE_CORRELATION))
        return 0;
    snprintf(text, size,
             "these data can hardly tell %s and %s apart (correlation %.3f)",
             name_i, name_j, correlation);
    return 1;
}

int fvi_estimate_warning_of_unseen(const fvi_estimation *fit, const fvi_estimate *fitted,
                                   const fvi_examination *examined, size_t which,
                                   const char *const *names, size_t size, char *text)
{
    static const char *const words[] = { "an offset of %.2g sigma", "a drift by %.2g sigma" };
    const size_t column = examined->unseen_column[which];
    char of_column[40] = "";
    size_t most = 0;
    for (size_t j = 0; j < fit->parameters; j++)
        if (fabs(examined->swayed[which][j]) > fabs(examined->swayed[which][most]))
            most = j;
    const double by = fabs(examined->swayed[which][most]);
    if (!(by > fitted->quantile))
        return 0;
    snprintf(text, size, words[which], examined->unseen[which]);
    const size_t end = strlen(text);
    if (fvi_estimation_columns(fit) > 1)
        snprintf(of_column, sizeof of_column, " of column %zu", column + 1);
    snprintf(text + end, size - end,
             "%s would not be seen in the residuals and moves %s by %.2g sd: fit %s, too, or be sure "
             "that there is none",
             of_column, names[most], by, which ? "drift" : "offset");
    return 1;
}

/* Add the names of the parameters of which the data exclude no value. */
static void add_open(const fvi_estimation *fit, const fvi_examination *e,
                     const char *const *names, size_t size, char *text)
{
    for (size_t j = 0, any = 0; j < fit->parameters; j++)
        if (fvi_estimation_is_open(fit, e, j)) {
            const size_t end = strlen(text);
            snprintf(text + end, size - end, "%s%s", any ? ", " : "", names[j]);
            any = 1;
        }
}

static const char *const plain_texts[] = {
    "no motion is seen: a constant explains the data as well",
    NULL, /* the text contains a number, see below */
    "the residuals have a mean: the sensor has an offset, or the force or the rest is another one; "
    "fit offset, too",
    "the residuals have a slope: the sensor drifts, or the force or the law is another one; fit "
    "offset and drift, too",
    "the residuals have a smooth pattern: the model, its past or its force is not that of the data",
    NULL,
    "on the way along an interval the fit became better: try more starts"
};

int fvi_estimate_flag_text(const fvi_estimation *fit, const fvi_estimate *fitted,
                           const fvi_examination *examined, unsigned flag,
                           const char *const *names, size_t size, char *text)
{
    const char *plain = NULL;
    if (!(examined->flags & flag))
        return 0;
    for (size_t i = 0; i < sizeof plain_texts / sizeof *plain_texts; i++)
        if (flag == 1u << i)
            plain = plain_texts[i];
    if (plain)
        snprintf(text, size, "%s", plain);
    else if (flag == FVI_FLAG_NEIGHBOURS)
        snprintf(text, size,
                 "neighbouring residuals are alike (correlation %.2f): the model, its past or its "
                 "force is not that of the data, or their noise is not independent",
                 fitted->neighbours);
    else if (flag == FVI_FLAG_VALLEYS)
        snprintf(text, size,
                 "another minimum is nearly as good (chi2 %.6g, and %.6g here): the intervals are "
                 "those of one of two valleys",
                 examined->chi2, fitted->chi2);
    else if (flag == FVI_FLAG_STEP)
        snprintf(text, size,
                 "half the step moved the estimates by %.2g sd: take a method of higher order",
                 fitted->bias);
    else if (flag == FVI_FLAG_BIASED)
        snprintf(text, size, "the step is too long by far: half of it moved the estimates by %.2g sd",
                 fitted->bias);
    else {
        snprintf(text, size, "the data exclude no value of ");
        add_open(fit, examined, names, size, text);
    }
    return 1;
}

const char *fvi_estimate_warning_of_initial_history(const fvi_estimation *fit,
                                    const fvi_estimate *fitted)
{
    fvi_estimation_model m;
    const char *text = NULL;
    if (!fvi_estimation_model_init(&m, fit, NULL)) {
        for (size_t j = 0; j < fit->parameters; j++)
            fvi_estimation_model_set(&m, j, fitted->estimate[j]);
        fvi_warning_of_initial_history(&m.run, &text);
    }
    fvi_estimation_model_clear(&m);
    return text;
}

/* Return nonzero if a mass is fitted and no force acts. Then m x'' and all other terms may be multiplied by the same
 * number. */
static int is_mass_free(const fvi_estimation *fit)
{
    const fvi_force *force = &fit->run->system->force;
    int fits_mass = 0;
    for (size_t j = 0; j < fit->parameters; j++)
        fits_mass |= fvi_free_parameter_base(fit->which[j]) == FVI_FREE_PARAMETER_MASS;
    return fits_mass && !force->value && force->impulse_count == 0;
}

double fvi_estimation_equal_steps(const fvi_estimation *fit)
{
    double most = 0;
    for (size_t r = 0; r < fvi_estimation_records(fit); r++) {
        const fvi_record record = fvi_estimation_record(fit, r);
        const double *t = record.t, T = t[record.n - 1];
        double gap = fit->h > 0 ? fit->h : T;
        for (size_t i = 1; i < record.n && fit->h == 0; i++)
            gap = smaller(gap, t[i] - t[i - 1]);
        most = T > 0 ? larger(most, T / gap) : most;
    }
    return most;
}

static void add_equal_steps(const fvi_estimation *fit, size_t size, char *text)
{
    const double needed = fit->method->dense ? 0 : fvi_estimation_equal_steps(fit);
    const size_t end = strlen(text);
    if (needed > FVI_FIT_MOST_EQUAL_STEPS)
        snprintf(text + end, size - end,
                 "; to t = %.10g steps as short as the gaps of the data take %.3g equal steps, and a fit makes %d; "
                 "fvi-adaptive chooses its own",
                 fvi_estimation_last_time(fit), needed, FVI_FIT_MOST_EQUAL_STEPS);
}

/* Make the motion with the given values, and say why a step fails, if a function is not finite. Return its code. */
static int explain_motion(const fvi_estimation *fit, fvi_error *error)
{
    fvi_estimation_model m;
    double *motion = calloc(fvi_estimation_rows(fit), sizeof *motion);
    int status = motion ? fvi_estimation_model_init(&m, fit, motion) : FVI_ENOMEM;
    m.run.failure = error;
    if (!status) {
        fvi_estimation_model_set_step(&m, fvi_estimation_first_step(fit));
        status = fvi_estimation_model_run(&m);
    }
    if (motion)
        fvi_estimation_model_clear(&m);
    free(motion);
    return status == error->code ? status : FVI_SUCCESS;
}

/* Say that no start gives a motion, and why the run with the given values does not start or ends. */
static void write_why_no_start_moves(const fvi_estimation *fit, size_t size, char *text)
{
    fvi_run run = *fit->run;
    fvi_stepper *s = NULL;
    fvi_error error = { 0 };
    run.steps = 1;
    run.h = fvi_estimation_last_time(fit);
    int status = fvi_stepper_start(fit->method, &run, &s, &error);
    fvi_stepper_free(s);
    if (!status)
        status = explain_motion(fit, &error);
    snprintf(text, size, "no start gives a motion that can be computed%s%s", status && *error.text ? ": " : "",
             status ? error.text : "");
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
                 fitted->chi2, (double)(fvi_estimation_rows(fit) - fit->parameters),
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
                 fitted->reached, fvi_estimation_last_time(fit),
                 *dashes ? "--most-steps" : "most_steps");
    else if (status == FVI_EBADFUNC)
        write_why_no_start_moves(fit, size, text);
    else
        return 0;
    if (status != FVI_ERUNAWAY)
        add_equal_steps(fit, size, text);
    return 1;
}
