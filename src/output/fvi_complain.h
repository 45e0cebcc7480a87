/* src/output/fvi_complain.h -- Print error messages and warnings of the program. */
#ifndef FVI_COMPLAIN_H
#define FVI_COMPLAIN_H

#include <fvi/error.h>

#include <stddef.h>

/* Each of these functions prints a line on standard error that says what went wrong, and returns 1. */
int fvi_complain(const char *what);
int fvi_complain_of(const fvi_error *error); /* names the field, if there is one */
int fvi_cannot_write(
    const char *name); /* adds the reason in errno; NULL: standard output */
int fvi_stopped_at(size_t step, int status); /* status: a code of fvi/error.h */
int fvi_stopped_by(size_t step, const fvi_error *failure); /* failure: that of a run, with the reason as its text */

/* fvi_warn -- Print a warning as a line on standard error. The command goes on. */
void fvi_warn(const char *what);

/* fvi_refused -- Refuse what the user typed. Print the complaint on standard error and point to the help of the
 * command, or to the help of the whole program if `command` is "help" or begins with "-", as "--version" does. The
 * pointer stands in a line of its own, or behind the caret if the complaint has one. Return the exit code. */
int fvi_refused(const fvi_error *error, const char *command);

/* fvi_code_in_words -- Return the text of fvi_error_name. If a function of the user returned the code, add its number
 * and the user's words for it. The text is valid until the next call. */
const char *fvi_code_in_words(int status);

/* fvi_reason -- Return a text for the code that a user of the program understands. Valid until the next call. */
const char *fvi_reason(int status);

#endif
