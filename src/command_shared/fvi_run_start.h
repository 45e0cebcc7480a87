/* src/command_shared/fvi_run_start.h -- Say why a run could not begin, with the names of its options. */
#ifndef FVI_RUN_START_H
#define FVI_RUN_START_H

#include "options/fvi_option_list.h"

#include <fvi/trajectory.h>

/* fvi_complain_of_start -- Print on standard error why a run of this command could not begin. The message names the
 * option that sets the error's field; without a field it follows from the code. Return an exit code. */
int fvi_complain_of_start(const fvi_options *o, const fvi_error *error, const char *command);

/* fvi_reason_of_code -- Return why a run could not begin if the library named no field, from the code of the error and,
 * for a law that fvi-adaptive does not take, from its text. The reason begins with the option to which it refers, if it
 * refers to one. It is valid until the next call. */
const char *fvi_reason_of_code(const fvi_options *o, const fvi_error *error);

/* fvi_reason_of_start -- Find out why a run could not begin, given only the status. To find out, it is started once
 * more; and for FVI_EBADFUNC the steps are repeated up to the one that failed. The field of the error is the name of an
 * option, or NULL if nothing more is known, the run began, or a step failed. */
void fvi_reason_of_start(const fvi_options *o, const fvi_run *r, int status, fvi_error *error);

#endif
