/* src/command_sweep/fvi_sweep.h -- The command `fvi sweep`. */
#ifndef FVI_COMMAND_SWEEP_H
#define FVI_COMMAND_SWEEP_H

/* fvi_command_sweep -- `fvi sweep`: a grid of runs, by several processes, one row each.
 * The words are those of main. Prints its table where -o says, and returns the exit code: 0; 1 after it has
 * said on standard error what could not be done; 2 if the words are refused. */
int fvi_command_sweep(int argc, char **argv);

#endif
