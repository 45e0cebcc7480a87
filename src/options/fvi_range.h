/* src/options/fvi_range.h -- Evenly spaced numbers, as they are typed. */
#ifndef FVI_RANGE_H
#define FVI_RANGE_H

#include "input/fvi_refuse.h"

#include <stddef.h>

/* count numbers from `from` to `to`, with a constant difference or, if log, a constant factor. */
typedef struct {
    int log;
    double from, to;
    size_t count;
} fvi_range;

/* fvi_word_range -- "A:B:N[:log]".
 *
 *   shape  what the whole text of the option should be, for the complaint */
int fvi_word_range(const char *field, const char *shape, const char *text,
                   const char *range, fvi_range *a, fvi_error *c);

/* fvi_range_value -- number i. Both ends are met exactly. A value between them is the
 * decimal number of fewest digits, at most 12, within the roundings of its formula, if there
 * is one: 20:160:4:log has 40 and 80, 0:1:11 has 0.3. */
double fvi_range_value(const fvi_range *a, size_t i);

#endif
