/* src/command_exact/fvi_exact.h -- The command `fvi exact`. */
#ifndef FVI_COMMAND_EXACT_H
#define FVI_COMMAND_EXACT_H

#include "options/fvi_option_list.h"

/* fvi_command_exact -- `fvi exact`: the table of the exact solution; p = m v.
 * fvi_command_exact_motion -- of several masses, or with dampers. */
int fvi_command_exact(const fvi_options *o, const fvi_system *system);
int fvi_command_exact_motion(const fvi_options *o, const fvi_system *system);

#endif
