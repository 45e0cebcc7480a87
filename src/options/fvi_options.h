/* src/options/fvi_options.h -- Parse the command line of build/fvi. */
#ifndef FVI_OPTIONS_H
#define FVI_OPTIONS_H

#include "fvi_values.h"

/* fvi_options_parse -- Interpret argv, or say what is wrong with it.
 *
 *   argc, argv  the arguments of main; they are not permuted: parsing stops at the first word that is no option
 *   o           output; free it with fvi_options_free if 0 is returned
 *   error       output if the command line is refused; its field is the option
 *
 * Nothing is printed. Return 0, or a code of fvi/error.h. After an error nothing is left to free, and o->command is the
 * command that was meant, or FVI_COMMAND_HELP. */
int fvi_options_parse(int argc, char **argv, fvi_options *o, fvi_error *error);

/* fvi_command_of_word -- Return the command that this word names, as it is written in the manual; "help" if there is
 * none. */
const char *fvi_command_of_word(const char *word);

/* fvi_command_name -- Return the word of the command: "run", or "--version". */
const char *fvi_command_name(fvi_command command);

#endif
