/* src/output/fvi_complain.h -- What the program says when something cannot be done. */
#ifndef FVI_COMPLAIN_H
#define FVI_COMPLAIN_H

#include <fvi/error.h>

#include <stddef.h>

/* What went wrong, as a line on standard error; each returns 1. */
int fvi_complain(const char *what);
int fvi_complain_of(const fvi_error *error); /* with its field, if it names one */
int fvi_cannot_write(
    const char *name); /* as errno says; NULL: standard output */
int fvi_stopped_at(size_t step, int status); /* a code of fvi/error.h */

/* fvi_warn -- what the reader must know, as a line on standard error; the command goes on. */
void fvi_warn(const char *what);

/* fvi_refused -- bad use: the complaint as a line on standard error, and a line that points
 * to the help of that command, or of all if it is "help" or "--version". A caret below the complaint stands
 * at the beginning of the second. Returns the exit code. */
int fvi_refused(const fvi_error *error, const char *command);

/* fvi_code_in_words -- what fvi_error_name says, and the number of a code that a function of
 * the user's own returned, with his words for it; good until the next call. */
const char *fvi_code_in_words(int status);

/* fvi_reason -- such a code, in the words of a user. */
const char *fvi_reason(int status);

#endif
