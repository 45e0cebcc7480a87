/* src/command_fit/fvi_fit_material.h -- Run `fvi fit --moduli`, `--creep` and `--relaxation`. */
#ifndef FVI_FIT_MATERIAL_H
#define FVI_FIT_MATERIAL_H

#include <fvi/error.h>

#include <stdio.h>

/* fvi_fit_is_material -- Return nonzero if one of the three options is among the words. */
int fvi_fit_is_material(int argc, char **argv);

/* fvi_fit_material -- Find the law of a material from its tables. Arguments and return values are those of
 * fvi_command_fit. */
int fvi_fit_material(int argc, char **argv);

/* fvi_fit_starts -- Read --starts of any fit as a number from 2 to `most`. If *text is NULL, it becomes "20". Return 0,
 * or a code of fvi/error.h with the error filled in. */
int fvi_fit_starts(const char **text, size_t most, size_t *starts, fvi_error *c);

/* fvi_fit_note -- Print a warning about the answer of any fit to standard error and, unless `out` is NULL, to the
 * table. There it is "# kind = text". */
void fvi_fit_note(FILE *out, const char *kind, const char *text);

/* fvi_fit_tell_unwritten -- Print on standard error that the files `output` and `curve` are not written because the
 * answer is not believed. A name is NULL if no such file was asked for; without both nothing is printed. Return 1. */
int fvi_fit_tell_unwritten(const char *output, const char *curve);

#endif
