/* src/fvi/error.h -- Error codes, error texts, and how a program stops a long call.
 *
 * A function of the library returns 0, or one of the codes below. Its header says which codes and why. The codes are
 * GSL's numbers, so that gsl_strerror knows them, too. The library prints nothing and ends no process.
 *
 * Callbacks. If a callback of the caller's returns a number other than 0, the function of the library returns the same
 * number (system.h). Choose a negative number, because no code of the library is negative. A callback returns no text,
 * because the library would have to keep a text for each thread. But a callback can keep a text in its params. The
 * program gets the text of a code from fvi_user_error of the user's shared object, and Python raises again what the
 * callback raised.
 *
 * Handlers. Only a program can decide whether an error is a reason to abort. So no error handler is set until the
 * program sets one. GSL's handler, whose default aborts, is never called: the library switches it off around each
 * call of GSL's that may fail, and on again. A callback may run while GSL's handler is off. While a function of the
 * library runs, neither another thread nor a callback should set GSL's handler, because the library sets the handler
 * from before again. */
#ifndef FVI_ERROR_H
#define FVI_ERROR_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

enum {
    FVI_SUCCESS = 0,
    FVI_EDOM = 1,      /* a number is out of its range */
    FVI_EFAULT = 3,    /* a null pointer */
    FVI_EINVAL = 4,    /* a length, a count or a name that is not possible */
    FVI_ENOMEM = 8,    /* no memory */
    FVI_EBADFUNC = 9,  /* a function of the caller gave a value that is not finite */
    FVI_ERUNAWAY = 10, /* a run has not reached its end after the most steps it may take */
    FVI_EMAXITER = 11, /* an iteration did not converge */
    FVI_ETOL = 14,     /* the accuracy that was asked for cannot be reached */
    FVI_EOVRFLW = 16,  /* a value stopped being finite */
    FVI_ELOSS = 17,    /* no digit of the result would be right */
    FVI_EROUND = 18,   /* rounding errors hide the result */
    FVI_ESING = 21,    /* an equation has no unique solution */
    FVI_EUNSUP = 23    /* the method, or the system, does not have what was asked for */
};

/* fvi_error_name -- return the meaning of a code as a static text, for any number. */
const char *fvi_error_name(int code);

/* fvi_is_own_code -- return nonzero if the code is none of those above: a function of the caller's has returned it. */
int fvi_is_own_code(int code);

/* fvi_error -- what was wrong, in words. A function that takes a pointer to one as its last argument fills it in when
 * it fails. NULL is allowed there. After success it is untouched.
 *
 *   code   the code that the function returned
 *   field  the name of what was refused, "x0" or "damping"; NULL if it is no single thing. It is a static text, or a
 *          text that the caller gave
 *   value  the number that was refused; NaN if it is not a number
 *   index  if one of several was refused, which one, from 0: a coordinate, a row, or a byte of a text
 *   text   one line without '\n' at its end; or two lines, the second with a caret below the wrong place in the first.
 *          It does not begin with the field
 *
 *     fvi_error error;
 *     if (fvi_parse_damping("zener:1,2,3", NULL, &damping, &error))
 *         fprintf(stderr, "%s: %s\n", error.field, error.text); */
enum { FVI_ERROR_ROOM = 400 };
typedef struct {
    int code;
    const char *field;
    double value;
    size_t index;
    char text[FVI_ERROR_ROOM];
} fvi_error;

/* fvi_fail -- fill in an error, with a text as printf makes it, and return the code. For functions of the caller's that
 * want to fail as the library does.
 *
 *   error   output, or NULL
 *   code, field, value  as in fvi_error; field may be NULL. The index becomes 0
 *
 *     return fvi_fail(error, FVI_EDOM, "h", h, "the step is %g; it must be positive", h);
 *
 * The middle of a text that is too long becomes "...", and control characters become '?'. */
__attribute__((format(printf, 5, 6))) int
fvi_fail(fvi_error *error, int code, const char *field, double value,
         const char *format, ...);

/* fvi_refuse -- fvi_fail for a text that is refused: the code is FVI_EINVAL, and the value is NaN. For example
 *
 *     return fvi_refuse(error, "damping", "'%s' is no law", text); */
#define fvi_refuse(error, field, ...) \
    fvi_fail(error, FVI_EINVAL, field, __builtin_nan(""), __VA_ARGS__)

/* fvi_no_memory -- fvi_fail where there is no memory: the code is FVI_ENOMEM, and the value is NaN. */
#define fvi_no_memory(error, field) \
    fvi_fail(error, FVI_ENOMEM, field, __builtin_nan(""), "not enough memory")

/* fvi_error_handler -- a function that is called where an error arises, before its code is returned.
 *
 *   reason      what is wrong
 *   file, line  where in the library
 *   code        the code
 *
 * It may end the process, or return. It is not called for what a callback returned, nor for an error that comes out of
 * a step (trajectory.h) or of a search (solve.h), because such an error is no mistake of the caller. */
typedef void fvi_error_handler(const char *reason, const char *file, int line,
                               int code);

/* fvi_set_error_handler -- set the handler of all threads, at any time; NULL: none. It is called in the thread in which
 * the error arises, so perhaps in several threads at once. Returns the handler from before; NULL at first. */
fvi_error_handler *fvi_set_error_handler(fvi_error_handler *handler);

/* fvi_interrupter -- a function that is asked again and again during a long call, so that a program can stop the call,
 * for example at Ctrl-C.
 *
 * It returns 0 to go on. Any other number ends the call, and the call returns this number, as it does with the number
 * of a callback; so choose a negative one. A search or a fit makes many runs: return the number until the search has
 * returned. The library does not measure time. If the function does more than look at a flag, it should look at a clock
 * first. It is asked
 *
 *   - before every 64th step of a run; before every step if d, times the number of stages, is 32 or more, or if the
 *     method chooses its steps;
 *   - before every 64th step of an adjoint run;
 *   - before each time of fvi_exact_at, and about every sixteen times of fvi_exact_grid;
 *   - before each factorisation of a response or of a search for poles, and every eight matrices of the table of a
 *     law. */
typedef int fvi_interrupter(void);

/* fvi_set_interrupter -- set the interrupter of all threads, at any time; NULL: none. It is called in the thread that
 * computes, so perhaps in several threads at once. Returns the interrupter from before; NULL at first.
 *
 *     static volatile sig_atomic_t stop;
 *     static int is_stopped(void) { return stop ? -1 : 0; }
 *     fvi_set_interrupter(is_stopped); */
fvi_interrupter *fvi_set_interrupter(fvi_interrupter *interrupter);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
