/* src/command_run/fvi_run.h -- The command `fvi run`: by a given step, and to a wanted error.
 *
 * A command prints its table where o->output says, and returns the exit code: 0, or 1 after it has said on
 * standard error what could not be done. */
#ifndef FVI_RUN_H
#define FVI_RUN_H

#include <fvi/events.h>
#include "output/fvi_table.h"

/* fvi_command_run -- `fvi run`: o->steps steps of o->h. */
int fvi_command_run(const fvi_options *o, const fvi_system *system);

/* fvi_command_error -- `fvi run --error`: with the longest step that fvi_step_search
 * finds good enough; prints nothing where there is none. */
int fvi_command_error(const fvi_options *o, const fvi_system *system);

/* fvi_run_room -- room for the rows that are kept; NULL if what is surely asked for is more
 * than the machine has. */
double *fvi_run_room(const fvi_table *t);

/* fvi_run_print_events -- n events behind the rows, in the words of the options; nothing without --event. */
void fvi_run_print_events(const fvi_table *t, size_t n, const fvi_event_time *at);

/* fvi_snapshot -- a line for each unknown of s, number, x and p, into o->snapshot, complete or
 * not at all, if there is such a name. Returns 0, or 1 after it has said what is wrong. */
int fvi_snapshot(const fvi_options *o, const fvi_stepper *s);

/* fvi_variable_step_head -- two lines of the head: what a method that chooses its steps has
 * chosen; how many of them, if not 0. */
void fvi_variable_step_head(FILE *out, const fvi_options *o, int stages,
                            char form, size_t steps);

#endif
