/* src/command_shared/fvi_run_search.h -- Make a run to a wanted error, with its typed columns and its events. */
#ifndef FVI_RUN_SEARCH_H
#define FVI_RUN_SEARCH_H

#include "options/fvi_option_list.h"

#include <fvi/solve.h>

/* fvi_run_search -- Compute the rows k = 0, ..., steps of r by this method, with an error of x of at most o->error.
 *
 *   x, p    outputs, d numbers for each row
 *   typed   output, the typed columns of each row, or NULL. It is written only if the columns need more than x and p
 *   found   output, the report of fvi_solve
 *   events  the events are added to it, unless it is NULL; the caller frees events->at
 *
 * An event may have ended the run. Then there are found->rows rows, and the place of the next row holds the state at
 * the event, unless the event is at the last row. Return what fvi_solve returns. The reductions then contain each step
 * of the run that was found. */
typedef struct {
    size_t count, room;
    fvi_event_time *at;
} fvi_run_events;
int fvi_run_search(const fvi_options *o, const fvi_method *method,
                   const fvi_run *r, double *x, double *p, double *typed,
                   fvi_report *found, fvi_run_events *events);

#endif
