/* src/program/fvi_commands.h -- The commands of build/fvi, and how they fail.
 *
 * A command prints its table where o->output says, and returns the exit code:
 * 0, or 1 after it has said on standard error what could not be done. */
#ifndef FVI_COMMANDS_H
#define FVI_COMMANDS_H

#include "words/fvi_option_list.h"

/* fvi_command_run -- `fvi run`: o->steps steps of o->h. */
int fvi_command_run(const fvi_options *o, const fvi_system *system);

/* fvi_command_error -- `fvi run --error`: with the longest step that fvi_step_search
 * finds good enough; prints nothing where there is none. */
int fvi_command_error(const fvi_options *o, const fvi_system *system);

/* fvi_command_sweep -- `fvi sweep`: a grid of runs, by several processes, one row each.
 * The words are those of main; 2 if they are refused. */
int fvi_command_sweep(int argc, char **argv);

/* fvi_command_fit -- `fvi fit`: parameters from a table. The words are those of main; 1 if
 * the data have no answer that can be believed, 2 if the words are refused. */
int fvi_command_fit(int argc, char **argv);

/* fvi_command_gradient -- `fvi gradient`: derivatives of a last row. Likewise. */
int fvi_command_gradient(int argc, char **argv);

/* What went wrong, as a line on standard error; each returns 1. */
int fvi_complain(const char *what);
int fvi_cannot_write(
    const char *name); /* as errno says; NULL: standard output */
int fvi_stopped_at(size_t step, int status); /* a code of fvi/error.h */

/* fvi_refused -- bad use: the complaint as a line on standard error, and a line that points
 * to the help. A caret below the complaint stands at the beginning of the second. */
void fvi_refused(const char *complaint, const char *help);

/* fvi_reason -- such a code, in the words of a user. */
const char *fvi_reason(int status);

#endif
