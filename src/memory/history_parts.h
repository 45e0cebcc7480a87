/* src/memory/history_parts.h -- Push a term in parts, and ask a history about its state. [H 28]
 *
 * This header is internal. Some steps take a few coordinates through the whole step before they go on to the next
 * coordinates. */
#ifndef FVI_HISTORY_PARTS_H
#define FVI_HISTORY_PARTS_H

#include <fvi/memory.h>

/* fvi_history_takes_parts -- Return nonzero if fvi_history_push_part may be called: the engine works in tiles of
 * coordinates, and the tiles are not shared among threads. */
int fvi_history_takes_parts(const fvi_history *m);

/* fvi_history_sums_increments -- Return nonzero if a push reads dx, and 0 if it reads x. */
int fvi_history_sums_increments(const fvi_history *m);

/* fvi_history_terms -- Return the number of terms so far. */
size_t fvi_history_terms(const fvi_history *m);

/* fvi_history_push_part -- Push `count` coordinates of a term, from coordinate `first` on.
 *
 *   first     a multiple of 16, where the part before ended; 0 at the start of a term
 *   count     a multiple of 16; the last part ends at d instead
 *   x, dx, H  the `count` numbers of this part; H may be x or dx
 *
 * All parts together are one fvi_history_push, with the same digits. Return FVI_SUCCESS, or FVI_EINVAL
 * after steps + 1 terms. */
int fvi_history_push_part(fvi_history *m, size_t first, size_t count,
                         const double *x, const double *dx, double *H);

#endif
