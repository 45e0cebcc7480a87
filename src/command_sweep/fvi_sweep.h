/* src/command_sweep/fvi_sweep.h -- Run the command `fvi sweep`. */
#ifndef FVI_COMMAND_SWEEP_H
#define FVI_COMMAND_SWEEP_H

/* fvi_command_sweep -- Run `fvi sweep`: make a grid of runs with several processes, a row for each run. argc and argv
 * are those of main. The table goes to the output. Return an exit code: 0; 1 after a message; 2 if an option is
 * refused. */
int fvi_command_sweep(int argc, char **argv);

#endif
