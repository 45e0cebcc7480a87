/* src/frequency/pole_boxes.h -- Find poles that no undamped mode leads to.       [H 30] */
#ifndef FVI_POLE_BOXES_H
#define FVI_POLE_BOXES_H

#include "pole_search.h"
#include "winding.h"

/* Poles, each once, and room for more. Each candidate has room for its shape. */
typedef struct {
    size_t count, room;
    uint64_t seed; /* of the next start */
    fvi_pole_candidate *candidate;
} fvi_pole_list;

/* fvi_poles_in_box -- Find the poles of a box in which det Z has n zeros, and which are not yet in the list.  [(30.8)]
 *
 * If poles are missing, Newton's method starts in the middle of the box. Then the box is cut, and both halves are
 * searched. The list may remain incomplete.
 * Return FVI_SUCCESS, FVI_ENOMEM or the number of the interrupter. */
int fvi_poles_in_box(fvi_response *response, const fvi_log_box *box, size_t n, fvi_pole_list *list);

#endif
