/* src/system/error.c -- What a function says when it could not do it. */
#include <fvi/version.h>
#include "system/fail.h"

#include <gsl/gsl_errno.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- what was wrong ---- */

/* What was typed may be long, and what is wrong with it stands at the end: the middle
 * gives way. */
static void leave_out_the_middle(char *text, size_t length, const char *format,
                                 va_list arguments)
{
    const size_t end = FVI_ERROR_ROOM / 2; /* so much of the end, its '\0' included */
    char *whole = malloc(length + 1);
    if (whole) {
        vsnprintf(whole, length + 1, format, arguments);
        memcpy(text + FVI_ERROR_ROOM - end - 3, "...", 3);
        memcpy(text + FVI_ERROR_ROOM - end, whole + length + 1 - end, end);
    }
    free(whole);
}

int fvi_fail(fvi_error *error, int code, const char *field, double value,
             const char *format, ...)
{
    if (!error)
        return code;
    error->code = code;
    error->field = field;
    error->value = value;
    error->index = 0;
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length =
        vsnprintf(error->text, sizeof error->text, format, arguments);
    if (length > 0 && (size_t)length >= sizeof error->text)
        leave_out_the_middle(error->text, (size_t)length, format, again);
    va_end(again);
    va_end(arguments);
    for (char *t = error->text; *t; t++) /* one line, whatever was typed */
        if ((unsigned char)*t < ' ')
            *t = '?';
    return code;
}

/* ---- the handler ---- */

static _Atomic(fvi_error_handler *) handler;

fvi_error_handler *fvi_set_error_handler(fvi_error_handler *next)
{
    return atomic_exchange(&handler, next);
}

int fvi_tell_handler(const char *reason, const char *file, int line, int code)
{
    fvi_error_handler *now = handler; /* another thread may set the next one */
    if (now)
        now(reason, file, line, code);
    return code;
}

/* ---- an end from without ---- */

static _Atomic(fvi_interrupter *) interrupter;

fvi_interrupter *fvi_set_interrupter(fvi_interrupter *next)
{
    return atomic_exchange(&interrupter, next);
}

int fvi_interrupted(void)
{
    fvi_interrupter *now =
        atomic_load_explicit(&interrupter, memory_order_relaxed);
    return now ? now() : FVI_SUCCESS;
}

/* ---- GSL's handler ---- */

static atomic_flag busy =
    ATOMIC_FLAG_INIT;               /* a lock that is held for no time */
static size_t quiet;                /* pairs that are open */
static gsl_error_handler_t *of_gsl; /* what GSL had before the first */

void fvi_quiet(void)
{
    while (atomic_flag_test_and_set(&busy)) {
    }
    if (quiet++ == 0)
        of_gsl = gsl_set_error_handler_off();
    atomic_flag_clear(&busy);
}

void fvi_loud(void)
{
    while (atomic_flag_test_and_set(&busy)) {
    }
    if (--quiet == 0)
        gsl_set_error_handler(of_gsl);
    atomic_flag_clear(&busy);
}

/* ---- words ---- */

const char *fvi_error_name(int code)
{
    switch (code) {
    case FVI_SUCCESS:
        return "success";
    case FVI_EDOM:
        return "a number is out of its range";
    case FVI_EFAULT:
        return "a null pointer";
    case FVI_EINVAL:
        return "a length, a count or a name that cannot be";
    case FVI_ENOMEM:
        return "no memory";
    case FVI_EBADFUNC:
        return "a function of the caller gave what is not finite";
    case FVI_ERUNAWAY:
        return "the end is not reached with the most steps that a run may take";
    case FVI_EMAXITER:
        return "the iteration did not converge";
    case FVI_ETOL:
        return "the accuracy that was asked for cannot be had";
    case FVI_EOVRFLW:
        return "a value stopped being finite";
    case FVI_ELOSS:
        return "not a digit of the result would be right";
    case FVI_EROUND:
        return "rounding hides what was asked for";
    case FVI_ESING:
        return "the equation has no unique solution";
    case FVI_EUNSUP:
        return "the method has no such thing";
    default:
        return "an error of the caller's own functions";
    }
}

int fvi_is_own_code(int code)
{
    return strcmp(fvi_error_name(code), fvi_error_name(-1)) == 0;
}

const char *fvi_version(void)
{
    return FVI_VERSION;
}
