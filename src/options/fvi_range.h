/* src/options/fvi_range.h -- Read lists of numbers, and compute evenly spaced numbers in the digits that a user would
 * type. */
#ifndef FVI_RANGE_H
#define FVI_RANGE_H

#include "input/fvi_refuse.h"

#include <stddef.h>

/* `count` numbers: those of `list` or, if that is NULL, from `from` to `to`, with a constant difference or, if log is
 * nonzero, a constant factor. */
typedef struct {
    int log;
    double from, to;
    size_t count;
    double *list;
} fvi_range;

/* fvi_word_range -- Read "A:B:N[:log]", "V1,V2,..." or "@file" from `range`. Free the list with free, also after an
 * error. Return 0, or a code of fvi/error.h with the error filled in.
 *
 *   field  name of the option
 *   shape  what the whole text of the option should be, for the complaint
 *   text   the whole text of the option
 *   low    the numbers of a list are above it */
int fvi_word_range(const char *field, const char *shape, const char *text,
                   const char *range, double low, fvi_range *a, fvi_error *c);

/* fvi_range_value -- Return number i. The two ends of a range are exact. A value between them is the decimal number of
 * fewest digits within the rounding error of its formula, if there is one with at most 12 digits: 20:160:4:log has 40
 * and 80, 0:1:11 has 0.3. */
double fvi_range_value(const fvi_range *a, size_t i);

#endif
