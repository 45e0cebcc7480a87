/* src/command_response/fvi_response.h -- Run the commands `fvi response` and `fvi poles`. */
#ifndef FVI_COMMAND_RESPONSE_H
#define FVI_COMMAND_RESPONSE_H

/* fvi_command_response -- Run `fvi response`: print the frequency response of a linear motion.
 * fvi_command_poles -- Run `fvi poles`: print the frequencies and the decay of a linear motion.
 *
 * argc and argv are those of main. The table goes to the output. Each returns an exit code: 0; 1 after a message; 2 if
 * an option is refused. */
int fvi_command_response(int argc, char **argv);
int fvi_command_poles(int argc, char **argv);

#endif
