/* src/options/fvi_problem.h -- From the words of the command line to a system. */
#ifndef FVI_PROBLEM_H
#define FVI_PROBLEM_H

#include "fvi_option_list.h"

/* Each interprets its part of o->text, presets filled in, in this order: how many masses
 * there are, and what is between them; what each has, x0, p0, mass, rho; and, when the
 * grid is known, the force. Returns 0, or a code of fvi/error.h with the
 * error written. What was made so far is freed by fvi_options_free
 * (fvi_values.h). */
int fvi_problem_potential(fvi_options *o, fvi_error *c);
int fvi_problem_lists(fvi_options *o, fvi_error *c);
int fvi_problem_force(fvi_options *o, fvi_error *c);
int fvi_problem_ground(fvi_options *o, fvi_error *c);

/* fvi_problem_unknowns -- the unknowns of the table, when it is known how many there are. */
int fvi_problem_unknowns(fvi_options *o, fvi_error *c);

/* fvi_options_system -- the system that the words describe. It points into o. */
fvi_system fvi_options_system(const fvi_options *o);

/* fvi_options_run -- the run of that system. It points into o and the system. */
fvi_run fvi_options_run(const fvi_options *o, const fvi_system *system);

#endif
