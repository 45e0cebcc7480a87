/* src/command_gradient/fvi_gradient.h -- The command `fvi gradient`. */
#ifndef FVI_COMMAND_GRADIENT_H
#define FVI_COMMAND_GRADIENT_H

/* fvi_command_gradient -- `fvi gradient`: derivatives of a last row. The words are those of main. Prints its table where
 * --output says, and returns the exit code: 0; 1 after it has said on standard error what could not be done; 2 if the
 * words are refused. */
int fvi_command_gradient(int argc, char **argv);

#endif
