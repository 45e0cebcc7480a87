/* src/program/fvi_gradient.h -- The command `fvi gradient`, which has words of its own. */
#ifndef FVI_GRADIENT_H
#define FVI_GRADIENT_H

/* fvi_is_gradient -- is it `fvi gradient ...`, or `fvi help gradient`? */
int fvi_is_gradient(int argc, char **argv);

/* fvi_command_gradient -- do it. Its own words are read here, those that it shares with
 * `fvi run` by fvi_options_parse. Returns the exit code: 0; 1 if it could not be done, 2
 * for bad use, after it has said which. */
int fvi_command_gradient(int argc, char **argv);

#endif
