/* src/command_shared/fvi_run_search.h -- A run to a wanted error, with its typed columns and its events. */
#ifndef FVI_RUN_SEARCH_H
#define FVI_RUN_SEARCH_H

#include "options/fvi_option_list.h"

#include <fvi/solve.h>

/* fvi_run_search -- the rows k = 0, ..., steps of r by this method, right to o->error; x and p
 * have room for them, and typed, or NULL, for the typed columns of each row, which are filled in if
 * x and p are not enough for them. Returns what fvi_solve returns; reductions have then seen
 * each step of the run that was found. The events of it are added to `events`, unless that is NULL; free
 * events->at. An event may have ended the run: found->rows rows are there, and in the place of the next one stands
 * the event, unless that is at the last row. */
typedef struct {
    size_t count, room;
    fvi_event_time *at;
} fvi_run_events;
int fvi_run_search(const fvi_options *o, const fvi_method *method,
                   const fvi_run *r, double *x, double *p, double *typed,
                   fvi_report *found, fvi_run_events *events);

#endif
