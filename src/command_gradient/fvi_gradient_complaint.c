/* src/command_gradient/fvi_gradient_complaint.c -- Say why there is no gradient. */
#include "fvi_gradient_complaint.h"

#include "command_shared/fvi_run_start.h"
#include "output/fvi_complain.h"

#include <stdio.h>

static struct {
    int code;
    char text[FVI_ERROR_ROOM];
} noted;

static fvi_error_handler *before;

static void store_reason(const char *reason, const char *file, int line, int code)
{
    (void)file;
    (void)line;
    noted.code = code;
    snprintf(noted.text, sizeof noted.text, "%s", reason);
}

void fvi_gradient_note_reasons(int on)
{
    if (on) {
        noted.code = FVI_SUCCESS;
        before = fvi_set_error_handler(store_reason);
    } else
        fvi_set_error_handler(before);
}

/* Repeat the run without derivatives. If it overflows or a step cannot be solved, there is no last row to
 * differentiate. The energy of the last row may also overflow; it is checked for a potential only. *reached is the step
 * that failed, or 0 if the run did not start. *failure may describe the failure. Return FVI_SUCCESS or the code of the
 * failure. */
static int repeat_run(fvi_gradient_request *r, size_t *reached, fvi_error *failure)
{
    fvi_stepper *s;
    r->run.failure = failure;
    int failed = fvi_stepper_start(r->o.method, &r->run, &s, NULL);
    *reached = 0;
    if (failed)
        return failed;
    while (s->k < r->o.steps && !(failed = fvi_stepper_step(s)))
        ;
    *reached = s->k + (s->k < r->o.steps);
    double value;
    if (!failed && r->of == 2 && !r->system.mechanism)
        failed = fvi_energy(&r->system, s->x, s->p, &value);
    fvi_stepper_free(s);
    return failed;
}

int fvi_gradient_complain(fvi_gradient_request *r, int status)
{
    size_t step;
    fvi_error failure = { 0 };
    if (status == FVI_ENOMEM)
        return fvi_complain("not enough memory");
    const int failed = repeat_run(r, &step, &failure);
    if (failed && step > 0)
        return failed == failure.code ? fvi_stopped_by(step, &failure) : fvi_stopped_at(step, failed);
    if (failed) {
        fvi_error error;
        fvi_reason_of_start(&r->o, &r->run, failed, &error);
        return error.field ? fvi_complain_of(&error) : fvi_complain(fvi_reason_of_code(&r->o, &error));
    }
    if (status == FVI_EOVRFLW)
        return fvi_stopped_at(r->o.steps, status);
    return fvi_complain(noted.code == status ? noted.text : fvi_code_in_words(status));
}
