/* src/command_shared/fvi_run_warn.h -- Warn of runs that go on all the same. */
#ifndef FVI_RUN_WARN_H
#define FVI_RUN_WARN_H

#include "options/fvi_option_list.h"

#include <fvi/trajectory.h>
#include <fvi/warnings.h>

/* fvi_run_warn -- Warn on standard error, before the first step, of a memory that is not read, of a run without a
 * solution as h goes to 0, and of a run that must grow without bound because its step is too long. The run goes on all
 * the same. The warning of the step is also written to `text`, which has room for FVI_WARNING_ROOM bytes, for the head.
 * Return 0, or 1 after a message if there is no memory for the check. */
int fvi_run_warn(const fvi_options *o, const fvi_run *r, size_t size,
                  char *text);

/* fvi_run_warn_of_memory -- Warn on standard error of a --memory or a --tolerance that the run does not read. A
 * tolerance that was not typed is no wish, so there is no warning of it. Return 0, or 1 after a message if there is no
 * memory for the check. */
int fvi_run_warn_of_memory(const fvi_options *o, const fvi_run *r);

/* fvi_run_check_inertia -- Call after each step. Check whether the inertia is singular, and write the warning to
 * `text`, which has room for FVI_WARNING_ROOM bytes. A check costs as much as a part of a step, so not every step is
 * checked. Return 1 if there is a warning, 0 if not or if there is no watch, -1 without memory.
 * fvi_run_inertia_of_rows -- Call fvi_warning_of_inertia_in_rows for the rows that a search has found. `text` has room
 * for FVI_WARNING_ROOM bytes. Return as above; 0 without a Lagrangian. */
typedef struct {
    fvi_inertia_watch *watch;
    size_t steps;
} fvi_run_inertia;
int fvi_run_check_inertia(fvi_run_inertia *w, const fvi_stepper *s, char *text);
int fvi_run_inertia_of_rows(const fvi_options *o, const fvi_system *system, size_t rows,
                            const double *x, const double *p, char *text);

#endif
