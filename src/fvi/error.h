/* src/fvi/error.h -- What a function says when it could not do it.
 *
 * A function returns 0, or one of these codes; its header says which and why. What a
 * callback of the caller's returned comes back as it is (system.h): best a negative
 * number, which no code is. It is a number alone, for a text would have to be kept for
 * each thread and freed by somebody: whoever wrote the callback can keep one in its
 * params. The program asks the user's own fvi_user_error for the words of a code;
 * Python raises again what the callback raised. The library prints nothing and ends no process. It could
 * be called from Python, or from one of many threads: whether an error is a reason to
 * abort is for the program to decide, so there is no handler until the program sets
 * one, and that of GSL, whose default aborts, is never called: around what may fail in
 * GSL it is switched off, and on again. A callback may be called while it is off. While
 * a function of the library runs, neither another thread nor a callback should set GSL's
 * handler: the one from before comes back. The codes are GSL's numbers, so that
 * gsl_strerror knows them too. */
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
    FVI_EINVAL = 4,    /* a length, a count or a name that cannot be */
    FVI_ENOMEM = 8,    /* no memory */
    FVI_EBADFUNC = 9,  /* a function of the caller gave what is not finite */
    FVI_ERUNAWAY = 10, /* a run is not at its end after the most steps it may take */
    FVI_EMAXITER = 11, /* an iteration did not come to its end */
    FVI_ETOL = 14,     /* the accuracy that was asked for cannot be had */
    FVI_EOVRFLW = 16,  /* a value stopped being finite */
    FVI_ELOSS = 17,    /* not a digit of the result would be right */
    FVI_EROUND = 18,   /* rounding hides what was asked for */
    FVI_ESING = 21,    /* an equation has no unique solution */
    FVI_EUNSUP = 23    /* the method has no such thing */
};

/* fvi_error_name -- a code in words: a constant text, for any number. */
const char *fvi_error_name(int code);

/* fvi_is_own_code -- nonzero for a code of the caller's own functions, none of these. */
int fvi_is_own_code(int code);

/* fvi_error -- what was wrong, in the words of the field. A function that takes one as its last
 * argument fills it in where it fails; NULL is allowed there. After success it is untouched.
 *
 *   code   as the function returned it
 *   field  what was refused, "x0" or "damping"; NULL if it is no single thing. It is a constant, or
 *          a text that the caller gave
 *   value  the number that was refused; NaN if it is no number
 *   index  of several the one that was refused: a coordinate, a row, or a byte of a text; from 0
 *   text   a line without its end; or two, the second with a caret below the place in the first
 *          that is meant. It does not begin with the field
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

/* fvi_fail -- fill in an error, as printf would, and return its code; the index is 0. NULL is
 * allowed for error and field. Of a text that is too long the middle becomes "...", and
 * control characters become '?'. It is for functions of the caller's that fail in the same way. */
__attribute__((format(printf, 5, 6))) int
fvi_fail(fvi_error *error, int code, const char *field, double value,
         const char *format, ...);

/* fvi_refuse -- fvi_fail for a text that cannot be: the code is FVI_EINVAL, and there is no value (NaN). For example
 *
 *     return fvi_refuse(error, "damping", "'%s' is no law", text); */
#define fvi_refuse(error, field, ...) \
    fvi_fail(error, FVI_EINVAL, field, __builtin_nan(""), __VA_ARGS__)

/* fvi_no_memory -- fvi_fail where there is no memory: the code is FVI_ENOMEM, and there is no value. */
#define fvi_no_memory(error, field) \
    fvi_fail(error, FVI_ENOMEM, field, __builtin_nan(""), "not enough memory")

/* fvi_error_handler -- called, if one is set, where an error arises, before its code
 * is returned: what is wrong, in which file and line, and the code. It may end the
 * process, or return. Not called for what a callback returned, nor for what comes out
 * of a step (trajectory.h) or of a search (step_search.h): that is no mistake. */
typedef void fvi_error_handler(const char *reason, const char *file, int line,
                               int code);

/* fvi_set_error_handler -- for all threads, at any time; it is then called in the
 * thread in which an error arises, by several at once perhaps. Returns the one before;
 * at first there is none, NULL. */
fvi_error_handler *fvi_set_error_handler(fvi_error_handler *handler);

/* fvi_interrupter -- asked, if one is set, while a run goes on: before every 64th step, or
 * before each if the dimension is above 31 or the method chooses its steps; and before each
 * time of fvi_exact_at, or sixteen of fvi_exact_grid; before each factorisation of a response or a pole, and eight matrices of
 * a law's table. 0: go on. Any other number ends the call,
 * which returns it as it does what a callback returned; so take a negative one. Searches and fits make many runs: let it
 * say so again until they have returned. It is for programs that have to stop a call from
 * without, at Ctrl-C say, and asks for the time itself if it is to do more than look at a flag. */
typedef int fvi_interrupter(void);

/* fvi_set_interrupter -- for all threads, at any time; it is then called in the thread that
 * computes, by several at once perhaps. Returns the one before; at first NULL. */
fvi_interrupter *fvi_set_interrupter(fvi_interrupter *interrupter);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
