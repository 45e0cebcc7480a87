/* src/system/error.c -- The error handler, the interrupter, and the texts of the error codes. */
#include <fvi/version.h>
#include "system/fail.h"

#include <gsl/gsl_errno.h>
#include <stdatomic.h>
#include <string.h>

/* ---- error handler ---- */

static _Atomic(fvi_error_handler *) handler;

fvi_error_handler *fvi_set_error_handler(fvi_error_handler *next)
{
    return atomic_exchange(&handler, next);
}

int fvi_tell_handler(const char *reason, const char *file, int line, int code)
{
    fvi_error_handler *now = handler; /* a copy, because another thread may set another handler at any time */
    if (now)
        now(reason, file, line, code);
    return code;
}

/* ---- interrupter ---- */

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

/* ---- error handler of GSL ---- */

static atomic_flag busy =
    ATOMIC_FLAG_INIT;               /* a spin lock, held for a few instructions only */
static size_t quiet;                /* number of open pairs of fvi_quiet and fvi_loud */
static gsl_error_handler_t *of_gsl; /* GSL's handler before the first open pair */

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

/* ---- texts of the codes ---- */

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
        return "a length, a count or a name is not possible";
    case FVI_ENOMEM:
        return "no memory";
    case FVI_EBADFUNC:
        return "a function of the caller gave a value that is not finite";
    case FVI_ERUNAWAY:
        return "the run has not reached its end after the most steps that it may take";
    case FVI_EMAXITER:
        return "the iteration did not converge";
    case FVI_ETOL:
        return "the accuracy that was asked for cannot be reached";
    case FVI_EOVRFLW:
        return "a value stopped being finite";
    case FVI_ELOSS:
        return "no digit of the result would be right";
    case FVI_EROUND:
        return "rounding errors hide the result";
    case FVI_ESING:
        return "the equation has no unique solution";
    case FVI_EUNSUP:
        return "the method or the system does not have what was asked for";
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
