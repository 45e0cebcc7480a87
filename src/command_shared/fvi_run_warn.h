/* src/command_shared/fvi_run_warn.h -- What is said of a run that goes on all the same. */
#ifndef FVI_RUN_WARN_H
#define FVI_RUN_WARN_H

#include "options/fvi_option_list.h"

#include <fvi/trajectory.h>
#include <fvi/warnings.h>

/* fvi_run_warn -- on standard error, before a run that has no limit, or must blow up; it goes on
 * all the same. What is said of the step is left in text, for the head: room for
 * FVI_WARNING_ROOM. Returns 0, or 1 after a complaint, where there is no memory to find out. */
int fvi_run_warn(const fvi_options *o, const fvi_run *r, size_t size,
                  char *text);

/* fvi_run_check_inertia -- after each step: is it singular, whose text has FVI_WARNING_ROOM? Each check costs as much as
 * a part of a step, so not all steps are followed by one. Returns 1 if so, -1 without memory. Without a watch 0.
 * fvi_run_inertia_of_rows -- fvi_warning_of_inertia_in_rows of so many rows that a search has found, for a text of
 * FVI_WARNING_ROOM; 0 without a Lagrangian, -1 without memory. */
typedef struct {
    fvi_inertia_watch *watch;
    size_t steps;
} fvi_run_inertia;
int fvi_run_check_inertia(fvi_run_inertia *w, const fvi_stepper *s, char *text);
int fvi_run_inertia_of_rows(const fvi_options *o, const fvi_system *system, size_t rows,
                            const double *x, const double *p, char *text);

#endif
