/* src/command_shared/fvi_run_start.h -- Why a run could not begin, in the words of its options. */
#ifndef FVI_RUN_START_H
#define FVI_RUN_START_H

#include "options/fvi_option_list.h"

#include <fvi/trajectory.h>

/* fvi_complain_of_start -- why a run of this command could not begin, on standard error: with the option
 * that the error's field is about, or by its code. Returns an exit code. */
int fvi_complain_of_start(const fvi_options *o, const fvi_error *error, const char *command);

/* fvi_reason_of_code -- why a run could not begin if the library named no field: with the option that its
 * code speaks of before it. */
const char *fvi_reason_of_code(const fvi_options *o, int status);

/* fvi_reason_of_start -- why a run, or its observer, could not begin, of which only the status came back: both
 * are started once more. A field of the error is an option; NULL if nothing more is known. */
void fvi_reason_of_start(const fvi_options *o, const fvi_run *r, int status, fvi_error *error);

#endif
