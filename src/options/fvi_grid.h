/* src/options/fvi_grid.h -- Where the rows are: --h, --steps, --time. */
#ifndef FVI_GRID_H
#define FVI_GRID_H

#include "fvi_option_list.h"

/* fvi_options_grid -- o->h, o->steps and o->time of t_k = k h: by --h, or by --time, or by both. */
int fvi_options_grid(fvi_options *o, fvi_error *c);

/* fvi_options_refuse_jumps -- with --error, a force or a ground that jumps between two rows. */
int fvi_options_refuse_jumps(const fvi_options *o, option_index which,
                             const fvi_typed_force *force, fvi_error *c);

#endif
