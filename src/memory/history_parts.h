/* src/memory/history_parts.h -- A push in parts, and what else a step asks of a history. [H 28]
 *
 * Internal: for steps that take some coordinates through everything before the next ones. */
#ifndef FVI_HISTORY_PARTS_H
#define FVI_HISTORY_PARTS_H

#include <fvi/memory.h>

/* fvi_history_takes_parts -- nonzero if fvi_history_push_part may be called: many coordinates
 * that go by blocks, and are not shared among threads. */
int fvi_history_takes_parts(const fvi_history *m);

/* fvi_history_sums_increments -- does a push read dx, and not x? */
int fvi_history_sums_increments(const fvi_history *m);

/* fvi_history_terms -- how many terms have come in. */
size_t fvi_history_terms(const fvi_history *m);

/* fvi_history_push_part -- fvi_history_push of `count` coordinates from `first` on.
 *
 *   first      a multiple of 16, where the part before ended; 0 after a whole push
 *   count      a multiple of 16, but for the last part, which ends at d
 *   x, dx, H   `count` numbers each, those of this part; H may be x or dx
 *
 * When the last part is in, one push is done, with the digits of fvi_history_push. Returns
 * FVI_SUCCESS, or FVI_EINVAL if there are more terms than were announced. */
int fvi_history_push_part(fvi_history *m, size_t first, size_t count,
                         const double *x, const double *dx, double *H);

#endif
