/* src/command_fit/fvi_fit.h -- The command `fvi fit`. */
#ifndef FVI_COMMAND_FIT_H
#define FVI_COMMAND_FIT_H

/* fvi_command_fit -- `fvi fit`: parameters from a table. The words are those of main; 1 if
 * the data have no answer that can be believed, 2 if the words are refused. */
int fvi_command_fit(int argc, char **argv);

#endif
