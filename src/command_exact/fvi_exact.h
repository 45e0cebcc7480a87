/* src/command_exact/fvi_exact.h -- Run the command `fvi exact`. */
#ifndef FVI_COMMAND_EXACT_H
#define FVI_COMMAND_EXACT_H

#include "options/fvi_option_list.h"

/* fvi_command_exact -- Run `fvi exact`: print the table of the exact solution. The momentum is p = m v.
 * fvi_command_exact_motion -- Do the same for several masses, for one mass whose potential is an expression, for
 * dampers, and where accelerations or forces of dampers are asked for.
 * Both return an exit code: 0, or 1 after a message on standard error. */
int fvi_command_exact(const fvi_options *o, const fvi_system *system);
int fvi_command_exact_motion(const fvi_options *o, const fvi_system *system);

#endif
