/* src/command_fit/fvi_fit.h -- Run the command `fvi fit`. */
#ifndef FVI_COMMAND_FIT_H
#define FVI_COMMAND_FIT_H

/* fvi_command_fit -- Run `fvi fit`: find parameters from a table. argc and argv are those of main. Return an exit code:
 * 0; 1 if the data have no answer that can be believed, or after another message; 2 if an option is refused. */
int fvi_command_fit(int argc, char **argv);

#endif
