/* src/options/fvi_problem.h -- Build the system from the options. */
#ifndef FVI_PROBLEM_H
#define FVI_PROBLEM_H

#include "fvi_option_list.h"

/* Each function interprets its part of o->text, with presets filled in. Call them in this order: potential, which also
 * finds the number of masses; lists, which reads x0, p0, mass and rho; when the grid is known, force; ground. Each
 * returns 0, or a code of fvi/error.h with the error filled in. fvi_options_free (fvi_values.h) frees what was made so
 * far. */
int fvi_problem_potential(fvi_options *o, fvi_error *c);
int fvi_problem_lists(fvi_options *o, fvi_error *c);
int fvi_problem_force(fvi_options *o, fvi_error *c);
int fvi_problem_ground(fvi_options *o, fvi_error *c);

/* fvi_problem_unknowns -- Read the unknowns that the table shows. Call it when their number is known. */
int fvi_problem_unknowns(fvi_options *o, fvi_error *c);

/* fvi_options_system -- Return the system that the options describe. It points into o. */
fvi_system fvi_options_system(const fvi_options *o);

/* fvi_options_run -- Return the run of that system. It points into o and to the system. */
fvi_run fvi_options_run(const fvi_options *o, const fvi_system *system);

#endif
