/* src/options/fvi_grid.h -- Find the times of the rows from --h, --steps and --time. */
#ifndef FVI_GRID_H
#define FVI_GRID_H

#include "fvi_option_list.h"

/* fvi_options_grid -- Find o->h, o->steps and o->time, so that the rows are at t_k = k h, from --h, from --time, or
 * from both. */
int fvi_options_grid(fvi_options *o, fvi_error *c);

/* fvi_options_refuse_jumps -- With --error, refuse a force or an acceleration of the ground that jumps between two
 * rows. `which` is the option that set it.
 * Both return 0, or a code of fvi/error.h with the error filled in. */
int fvi_options_refuse_jumps(const fvi_options *o, option_index which,
                             const fvi_typed_force *force, fvi_error *c);

#endif
