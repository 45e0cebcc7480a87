/* src/options/fvi_options.h -- What the command line of build/fvi says. */
#ifndef FVI_OPTIONS_H
#define FVI_OPTIONS_H

#include "fvi_values.h"

/* fvi_options_parse -- understand argv, or say what is wrong with it.
 *
 *   argc, argv  as main has them; getopt_long may permute nothing: it stops at
 *               the first word that is no option
 *   o           output; free it with fvi_options_free if 0 is returned
 *   error       output if the words are refused, its field the option
 *
 * Prints nothing. Returns 0; else a code of fvi/error.h. On error nothing is left to free, and o->command is the one that was meant, or
 * FVI_COMMAND_HELP. */
int fvi_options_parse(int argc, char **argv, fvi_options *o, fvi_error *error);

/* fvi_command_of_word -- the command of this word, as it is written; "help" if it is none. */
const char *fvi_command_of_word(const char *word);

/* fvi_command_name -- its word: "run", or "--version". */
const char *fvi_command_name(fvi_command command);

#endif
