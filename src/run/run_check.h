/* src/run/run_check.h -- Is it a run that a method takes? */
#ifndef FVI_RUN_CHECK_H
#define FVI_RUN_CHECK_H

#include <fvi/error.h>
#include <fvi/trajectory.h>

/* fvi_run_check -- all that fvi_stepper_start refuses before it begins, with field, value and
 * index. Returns as that does. */
int fvi_run_check(const fvi_method *method, const fvi_run *run,
                  fvi_error *error);

#endif
