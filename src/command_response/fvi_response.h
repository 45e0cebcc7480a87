/* src/command_response/fvi_response.h -- The commands `fvi response` and `fvi poles`. */
#ifndef FVI_COMMAND_RESPONSE_H
#define FVI_COMMAND_RESPONSE_H

/* fvi_command_response -- `fvi response`: linear motions by frequency.
 * fvi_command_poles -- `fvi poles`: how linear motions swing and decay.
 *
 * The words are those of main. Each prints its table where -o says, and returns the exit code: 0; 1 after it has
 * said on standard error what could not be done; 2 if the words are refused. */
int fvi_command_response(int argc, char **argv);
int fvi_command_poles(int argc, char **argv);

#endif
