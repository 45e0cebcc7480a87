/* src/options/fvi_mechanism_options.h -- Read Lagrangians, dampers, constraints and events from the command line.
 *
 * Functions that take an error return 0, or a code of fvi/error.h with the error filled in. */
#ifndef FVI_MECHANISM_OPTIONS_H
#define FVI_MECHANISM_OPTIONS_H

#include "fvi_option_list.h"

/* fvi_is_listed -- Return nonzero for an option that may be given several times, each time with another value. */
int fvi_is_listed(option_index i);

/* fvi_list_option -- Add a value to the list of option i, and to the text of all its values, which the head shows. */
int fvi_list_option(fvi_options *o, option_index i, const char *value,
                    fvi_error *c);

/* fvi_dampers_typed -- Return the texts of --damper. */
const fvi_option_values *fvi_dampers_typed(const fvi_options *o);

/* fvi_wants_stable -- Return nonzero if fvi-stable is the method for this problem, unless another one is named.
 * fvi_leaves_steps -- Return nonzero if an error or an event is asked for, so that fvi-adaptive is the method
 * instead. */
int fvi_wants_stable(const fvi_options *o);
int fvi_leaves_steps(const fvi_options *o);

/* fvi_check_mechanism_words -- Refuse options that do not go together with a mechanism. */
int fvi_check_mechanism_words(const fvi_options *o, fvi_error *c);

/* fvi_mechanism_dimension -- Return the largest index of a coordinate in the texts of the mechanism, or 0. */
size_t fvi_mechanism_dimension(const fvi_options *o);

/* fvi_potential_in_time -- Return nonzero if the potential is no expression in x, but one in x and t. In that case o->d
 * is set, and the potential becomes a part of a Lagrangian. */
int fvi_potential_in_time(fvi_options *o, size_t d);

/* fvi_problem_mechanism -- Make o->mechanism. Call it when the masses and the law are known. rho is moved into the
 * dampers of the mechanism. */
int fvi_problem_mechanism(fvi_options *o, fvi_error *c);

/* fvi_problem_events -- Make o->events. Call it when the masses are known.
 * fvi_check_events -- Refuse a method without events, and columns that are not known in a run with events. */
int fvi_problem_events(fvi_options *o, fvi_error *c);
int fvi_check_events(const fvi_options *o, fvi_error *c);

/* fvi_problem_velocity -- Compute o->p0 from --v0. Call it when the mechanism is known. */
int fvi_problem_velocity(fvi_options *o, fvi_error *c);

#endif
