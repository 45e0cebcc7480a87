/* src/command_response/fvi_linear.c -- Open the linear motion for `fvi response` and `fvi poles`. */
#include "fvi_linear.h"
#include "output/fvi_complain.h"
#include "output/fvi_format.h"

#include <stdlib.h>
#include <string.h>

/* No time passes in these commands. The short time keeps a force from being read. */
static char at_zero[] = "--x0=0", one_step[] = "--steps=1",
            no_time[] = "--h=1e-300";
char *const fvi_linear_presets[] = { at_zero, one_step, no_time, NULL };

/* Return nonzero if the motion is linear everywhere. */
static int is_quadratic(const fvi_system *s)
{
    const fvi_potential *u = &s->potential;
    return !u->value || (u->quadratic && u->quadratic(u->params));
}

int fvi_linear_open(fvi_linear_request *r)
{
    fvi_error error;
    r->system = fvi_options_system(&r->o);
    const fvi_linear_motion motion = {
        .system = &r->system,
        .alpha = r->o.alpha,
        .law = r->o.text[DAMPING] ? &r->o.damping.law : NULL,
        .at = r->o.x0,
        .along = r->along
    };
    const int status = fvi_response_alloc(&motion, &r->response, &error);
    if (status)
        return status == FVI_ENOMEM || !*error.text ? fvi_complain(fvi_code_in_words(status))
                                                    : fvi_complain_of(&error);
    const int warned = fvi_response_warning_of_place(&r->system, r->o.x0, &r->warning);
    if (warned < 0)
        return fvi_complain(r->warning);
    if (warned)
        fvi_warn(r->warning);
    return 0;
}

void fvi_linear_head(FILE *out, const fvi_linear_request *r,
                     const char *const *names)
{
    const char *name, *value;
    fvi_format_begin(out, r->o.format);
    for (size_t n = 0; names[n]; n++)
        for (size_t i = 0; fvi_options_describe(&r->o, i, &name, &value); i++)
            if (strcmp(name, names[n]) == 0 && strcmp(name, "x0") != 0)
                fvi_format_parameter(out, r->o.format, name, value);
    if (r->response && !is_quadratic(&r->system))
        fvi_format_parameter(out, r->o.format, "linear at x0",
                             r->o.text[X0]);
    if (r->warning)
        fvi_format_parameter(out, r->o.format, "warning", r->warning);
}

void fvi_linear_free(fvi_linear_request *r)
{
    fvi_response_free(r->response);
    free(r->along);
    fvi_options_free(&r->o);
}
