/* src/command_shared/fvi_run_start.c -- Say why a run could not begin, with the names of its options. */
#include "fvi_run_start.h"

#include "output/fvi_complain.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Return the option that sets this field of the library. */
static const char *option_of(const fvi_options *o, const char *field)
{
    static const char *const options[][2] = {
        { "law", "damping" },  { "past", "derivative" },       { "impulses", "force" },
        { "events", "event" }, { "step_error", "step-error" }, { "matrices", "system" }
    };
    if (strcmp(field, "T") == 0)
        return o->text[TIME] ? "time" : "h";
    if (strcmp(field, "damper") == 0 && !o->text[DAMPER])
        return o->text[DAMPING] ? "damping" : "alpha";
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (strcmp(field, options[i][0]) == 0)
            return options[i][1];
    return field;
}

/* Replace the field of the error by its option, and the number of an event by its text. */
static void name_option(const fvi_options *o, fvi_error *error)
{
    char text[sizeof error->text];
    if (!error->field)
        return;
    const int is_event = o->events && strcmp(error->field, "events") == 0;
    const char *reason = is_event ? strstr(error->text, ": ") : NULL;
    error->field = option_of(o, error->field);
    if (!reason)
        return;
    snprintf(text, sizeof text, "%s", reason);
    fvi_fail(error, error->code, error->field, error->value, "'%s'%s",
             fvi_typed_event_name(o->events, error->index), text);
}

void fvi_reason_of_start(const fvi_options *o, const fvi_run *r, int status, fvi_error *error)
{
    fvi_stepper *s = NULL;
    fvi_run run = *r;
    run.failure = error;
    *error = (fvi_error){ 0 };
    int again = fvi_stepper_start(o->method, &run, &s, error);
    while (!again && status == FVI_EBADFUNC && s->k < r->steps)
        again = fvi_stepper_step(s);
    fvi_stepper_free(s);
    if (again != status)
        fvi_fail(error, status, NULL, NAN, "%s", fvi_error_name(status));
    else if (status == FVI_EBADFUNC)
        error->field = NULL; /* a step has failed, and no option is refused */
    name_option(o, error);
}

/* The parser has checked the ranges. So without a field the codes have few causes. FVI_EINVAL: there are too many steps
 * for a compressed memory. FVI_EDOM: m / h is not finite. FVI_EUNSUP: fvi-adaptive does not take the start, or the
 * stages do not take the law. The text of FVI_EBADFUNC says what is not finite. */
const char *fvi_reason_of_code(const fvi_options *o, const fvi_error *error)
{
    static char of_law[sizeof error->text + 16];
    const int status = error->code;
    snprintf(of_law, sizeof of_law, "--damping: %s", error->text);
    return status == FVI_ENOMEM ? "not enough memory"
           : status == FVI_ESING
               ? "--system: the matrix of a step is not positive definite: K is "
                 "negative somewhere, and h too long for it"
           : status == FVI_EINVAL
               ? "--steps: the compressed memory reaches back 10^9 steps at most"
           : status == FVI_EUNSUP && o->text[DAMPING] && o->method->dense
               ? of_law
           : status == FVI_EUNSUP && o->text[DAMPING]
               ? "--damping: the tail of this law is no sum of decaying modes; "
                 "fvi, fvi-bdf2 and fvi-stable take it"
           : status == FVI_EUNSUP
               ? "no step is short enough for a velocity that jumps: alpha is too "
                 "near to 1"
           : status == FVI_EDOM     ? "--h: mass / h is not a finite number"
           : status == FVI_EBADFUNC ? error->text
                                    : fvi_code_in_words(status);
}

int fvi_complain_of_start(const fvi_options *o, const fvi_error *error, const char *command)
{
    fvi_error named = *error;
    name_option(o, &named);
    return named.field                                       ? fvi_refused(&named, command)
           : named.code == FVI_ESING && !o->directory ? fvi_stopped_at(1, named.code)
                                                      : fvi_complain(fvi_reason_of_code(o, &named));
}
