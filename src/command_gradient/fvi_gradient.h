/* src/command_gradient/fvi_gradient.h -- Run the command `fvi gradient`. */
#ifndef FVI_COMMAND_GRADIENT_H
#define FVI_COMMAND_GRADIENT_H

/* fvi_command_gradient -- Run `fvi gradient`: compute derivatives of a number of the last row. argc and argv are those
 * of main. The table goes to the output. Return an exit code: 0; 1 after a message; 2 if an option is refused. */
int fvi_command_gradient(int argc, char **argv);

#endif
