/* src/input/fvi_refuse.h -- What is wrong with what was typed. What can refuse returns 0, or a
 * code of fvi/error.h after it has filled in the error, whose field is the option. */
#ifndef FVI_REFUSE_H
#define FVI_REFUSE_H

#include <fvi/parse.h>

#include <math.h>

enum { FVI_COMPLAINT = FVI_ERROR_ROOM + 80 /* bytes that are enough */ };

/* Refuse an option that is none of these, "--apha=1" of "alpha": with the nearest one, if
 * one is near. */
int fvi_refuse_option(fvi_error *error, const char *given,
                      const char *const *names);

/* fvi_complaint -- "--alpha: '1.5' is outside [0, 1]": one line without the newline; or two, with a
 * caret below the place, when "fvi: " stands before. Returns the exit code, 2, or 1 if memory was
 * short. */
int fvi_complaint(const fvi_error *error, char text[FVI_COMPLAINT]);

#endif
