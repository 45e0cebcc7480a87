/* src/run/run_check.h -- Check a run before a method starts it. */
#ifndef FVI_RUN_CHECK_H
#define FVI_RUN_CHECK_H

#include <fvi/error.h>
#include <fvi/trajectory.h>

/* fvi_run_check -- check everything that fvi_stepper_start refuses before the method starts. *error gets the field, the
 * value and the index. Returns the codes of fvi_stepper_start. */
int fvi_run_check(const fvi_method *method, const fvi_run *run,
                  fvi_error *error);

#endif
