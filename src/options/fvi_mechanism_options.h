/* src/options/fvi_mechanism_options.h -- Lagrangians, dampers and constraints of the command line. */
#ifndef FVI_MECHANISM_OPTIONS_H
#define FVI_MECHANISM_OPTIONS_H

#include "fvi_option_list.h"

/* fvi_is_listed -- is it an option whose values are a list, one each time that it is given? */
int fvi_is_listed(option_index i);

/* fvi_list_option -- one more of them. */
int fvi_list_option(fvi_options *o, option_index i, const char *value,
                    fvi_error *c);

/* fvi_dampers_typed -- the texts of --damper. */
const fvi_option_values *fvi_dampers_typed(const fvi_options *o);

/* fvi_wants_stable -- is fvi-stable the method, unless another is named?
 * fvi_leaves_steps -- but is an error, or an event, asked for, so that fvi-adaptive is? */
int fvi_wants_stable(const fvi_options *o);
int fvi_leaves_steps(const fvi_options *o);

/* fvi_check_mechanism_words -- refuse what goes with no mechanism. */
int fvi_check_mechanism_words(const fvi_options *o, fvi_error *c);

/* fvi_mechanism_dimension -- the largest index in its texts, or 0. */
size_t fvi_mechanism_dimension(const fvi_options *o);

/* fvi_potential_in_time -- is the potential, which is no expression in x, one in x and t? Then o->d is
 * known, and the potential goes into a Lagrangian. */
int fvi_potential_in_time(fvi_options *o, size_t d);

/* fvi_problem_mechanism -- o->mechanism, when masses and the law are known; rho goes into its dampers. */
int fvi_problem_mechanism(fvi_options *o, fvi_error *c);

/* fvi_problem_events -- o->events, when the masses are known.
 * fvi_check_events -- refuse a method that has none, and columns that know nothing of them. */
int fvi_problem_events(fvi_options *o, fvi_error *c);
int fvi_check_events(const fvi_options *o, fvi_error *c);

/* fvi_problem_velocity -- p0 of --v0, when the mechanism is known. */
int fvi_problem_velocity(fvi_options *o, fvi_error *c);

#endif
