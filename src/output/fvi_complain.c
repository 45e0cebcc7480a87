/* src/output/fvi_complain.c -- Print error messages and warnings of the program. */
#include "fvi_complain.h"
#include "fvi_output.h"
#include "input/fvi_refuse.h"
#include "input/fvi_shared.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

int fvi_complain(const char *what)
{
    fprintf(stderr, "fvi: %s\n", what);
    return 1;
}

void fvi_warn(const char *what)
{
    fvi_progress_clear();
    fprintf(stderr, "fvi: warning: %s\n", what);
}

int fvi_complain_of(const fvi_error *error)
{
    char complaint[FVI_COMPLAINT];
    fvi_complaint(error, complaint);
    return fvi_complain(complaint);
}

int fvi_refused(const fvi_error *error, const char *command)
{
    char complaint[FVI_COMPLAINT];
    const int code = fvi_complaint(error, complaint);
    const int all = strcmp(command, "help") == 0 || *command == '-';
    fprintf(stderr, "fvi: %s%sTry 'fvi %s%s--help'.\n", complaint,
            strchr(complaint, '\n') ? "  " : "\n", all ? "" : command,
            all ? "" : " ");
    return code;
}

int fvi_cannot_write(const char *name)
{
    const int why = errno;
    fvi_progress_clear();
    fprintf(stderr, "fvi: cannot write %s: %s\n",
            name && strcmp(name, "-") != 0 ? name : "standard output", strerror(why));
    return 1;
}

const char *fvi_code_in_words(int status)
{
    static char own[300];
    const char *words = fvi_error_name(status);
    if (!fvi_is_own_code(status))
        return words;
    const char *more = fvi_shared_error(status);
    snprintf(own, sizeof own, "%s, code %d%s%s", words, status,
             more ? ": " : "", more ? more : "");
    for (char *c = own; *c; c++) /* keep the message a single line, whatever the user's function wrote */
        *c = iscntrl((unsigned char)*c) ? '?' : *c;
    return own;
}

const char *fvi_reason(int status)
{
    return status == FVI_EMAXITER  ? "Newton's method did not converge"
           : status == FVI_ESING   ? "the equation of the step is singular"
           : status == FVI_EOVRFLW ? "a value is no longer finite"
           : status == FVI_EDOM    ? "a number is out of range"
           : status == FVI_ELOSS   ? "a phase of so many swings is not known"
                                   : fvi_code_in_words(status);
}

static int print_step(size_t step, const char *reason)
{
    fvi_progress_clear();
    fprintf(stderr, "fvi: step %zu: %s\n", step, reason);
    return 1;
}

int fvi_stopped_at(size_t step, int status)
{
    return print_step(step, fvi_reason(status));
}

int fvi_stopped_by(size_t step, const fvi_error *failure)
{
    return print_step(step, failure->text);
}
