/* src/program/fvi_fit.h -- The command `fvi fit`, which has words of its own. */
#ifndef FVI_FIT_H
#define FVI_FIT_H

#include "fvi_commands.h"
#include "words/fvi_options.h"

/* fvi_is_fit -- is it `fvi fit ...`, or `fvi help fit`? */
int fvi_is_fit(int argc, char **argv);

/* fvi_command_fit -- do it. Its own words are read here, those that it shares with
 * `fvi run` by fvi_options_parse. Returns the exit code: 0; 1 if the data have no answer
 * that can be believed, 2 for bad use, after it has said which. */
int fvi_command_fit(int argc, char **argv);

#endif
