/* src/command_fit/fvi_fit_material.h -- `fvi fit --moduli`, `--creep`, `--relaxation`. */
#ifndef FVI_FIT_MATERIAL_H
#define FVI_FIT_MATERIAL_H

#include <fvi/error.h>

/* fvi_fit_is_material -- does one of the three words stand there? */
int fvi_fit_is_material(int argc, char **argv);

/* fvi_fit_material -- the law of a material from its tables, as fvi_command_fit. */
int fvi_fit_material(int argc, char **argv);

/* fvi_fit_starts -- the text of --starts of any fit, 20 where there is none, as a number from 2 to `most`. Returns as
 * fvi_options_parse. */
int fvi_fit_starts(const char **text, size_t most, size_t *starts, fvi_error *c);

/* fvi_fit_tell_unwritten -- the files that were asked for, NULL where one was not, are not written, for the answer is not
 * believed: a line on standard error, if there is one. Returns 1. */
int fvi_fit_tell_unwritten(const char *output, const char *curve);

#endif
