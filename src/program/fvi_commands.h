/* src/program/fvi_commands.h -- The commands of build/fvi, and how they fail.
 *
 * A command prints its table where o->output says, and returns the exit code:
 * 0, or 1 after it has said on standard error what could not be done. */
#ifndef FVI_COMMANDS_H
#define FVI_COMMANDS_H

#include "options/fvi_option_list.h"

/* fvi_command_run -- `fvi run`: o->steps steps of o->h. */
int fvi_command_run(const fvi_options *o, const fvi_system *system);

/* fvi_command_error -- `fvi run --error`: with the longest step that fvi_step_search
 * finds good enough; prints nothing where there is none. */
int fvi_command_error(const fvi_options *o, const fvi_system *system);

/* fvi_command_exact_motion -- `fvi exact` of several masses, or with dampers. */
int fvi_command_exact_motion(const fvi_options *o, const fvi_system *system);

/* fvi_command_sweep -- `fvi sweep`: a grid of runs, by several processes, one row each.
 * The words are those of main; 2 if they are refused. */
int fvi_command_sweep(int argc, char **argv);

/* fvi_command_fit -- `fvi fit`: parameters from a table. The words are those of main; 1 if
 * the data have no answer that can be believed, 2 if the words are refused. */
int fvi_command_fit(int argc, char **argv);

/* fvi_command_gradient -- `fvi gradient`: derivatives of a last row. Likewise. */
int fvi_command_gradient(int argc, char **argv);

/* fvi_command_response -- `fvi response`: linear motions by frequency. Likewise. */
int fvi_command_response(int argc, char **argv);

/* fvi_command_poles -- `fvi poles`: how linear motions swing and decay. Likewise. */
int fvi_command_poles(int argc, char **argv);

#endif
