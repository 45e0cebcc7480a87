/* src/input/fvi_refuse.h -- Describe what is wrong with the command line.
 *
 * A function that can refuse returns 0, or a code of fvi/error.h. In the second case it has filled in the error, whose
 * field is the name of the option. */
#ifndef FVI_REFUSE_H
#define FVI_REFUSE_H

#include <fvi/parse.h>

#include <math.h>

enum { FVI_COMPLAINT = FVI_ERROR_ROOM + 80 /* enough bytes for a complaint */ };

/* fvi_refuse_option -- Refuse the word `given`, which is no option in `names`. If a name is near, the error proposes
 * it, for example alpha for "--apha=1". Return a code of fvi/error.h. */
int fvi_refuse_option(fvi_error *error, const char *given,
                      const char *const *names);

/* fvi_complaint -- Write the complaint, for example "--alpha: '1.5' is outside [0, 1]", in one line without a newline
 * at the end. Some errors have a second line, with a caret below the place of the error if "fvi: " is printed in front
 * of the first line. Return the exit code: 2, or 1 if there was no memory. */
int fvi_complaint(const fvi_error *error, char text[FVI_COMPLAINT]);

#endif
