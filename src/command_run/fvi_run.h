/* src/command_run/fvi_run.h -- Run the command `fvi run`, with a given step or to a wanted error.
 *
 * A command prints its table to o->output and returns an exit code: 0, or 1 after a message on standard error. */
#ifndef FVI_RUN_H
#define FVI_RUN_H

#include <fvi/events.h>
#include "output/fvi_table.h"

/* fvi_command_run -- Run `fvi run`: o->steps steps of length o->h. */
int fvi_command_run(const fvi_options *o, const fvi_system *system);

/* fvi_command_error -- Run `fvi run --error`: fvi_solve finds steps with which the error of x is small enough. If there
 * are no such steps, no table is printed. */
int fvi_command_error(const fvi_options *o, const fvi_system *system);

/* fvi_run_room -- Return an array for the rows that are kept, to be freed by the caller. NULL if the run surely needs
 * more memory than the machine has. */
double *fvi_run_room(const fvi_table *t);

/* fvi_run_print_events -- Print the n events after the rows, with the texts of their options. Without --event nothing
 * is printed. */
void fvi_run_print_events(const fvi_table *t, size_t n, const fvi_event_time *at);

/* fvi_snapshot -- Write a line with the number, x and p of each unknown of s to the file o->snapshot, if that is set.
 * The file is complete or does not appear. Return 0, or 1 after a message. */
int fvi_snapshot(const fvi_options *o, const fvi_stepper *s);

/* fvi_variable_step_head -- Print the choices of a method that chooses its steps in the head: a line with the form and
 * the number of stages, and a line with the number of steps unless that is 0. */
void fvi_variable_step_head(FILE *out, const fvi_options *o, int stages,
                            char form, size_t steps);

#endif
