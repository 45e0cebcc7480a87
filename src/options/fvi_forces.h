/* src/options/fvi_forces.h -- Forces that are typed, or stand in a file. */
#ifndef FVI_FORCES_H
#define FVI_FORCES_H

#include "fvi_user_parameters.h"

typedef struct fvi_forces fvi_forces;

/* fvi_forces_parse -- a sum of forces, parted by " + ": step:A,T, cosine:A,W,
 * impulse:J,T, file:NAME (columns t, F, linear in between) and expressions in t.
 *
 *   d     how many masses there are
 *   lets  the parameters, which must outlive the forces
 *   last  the time up to which a file must reach
 *   f     output; free it with fvi_forces_free
 *
 * Returns 0; 2 if a word, or the file, is refused; 1 if there is no memory. */
int fvi_forces_parse(const char *text, size_t d, fvi_user_parameters *lets, double last,
                     fvi_forces **f, fvi_complaint c);

/* fvi_forces_force -- the same on every mass. f must outlive it. */
fvi_force fvi_forces_force(const fvi_forces *f);

/* fvi_forces_by_parameter -- the derivative at t by parameter number j of the lets. */
double fvi_forces_by_parameter(const fvi_forces *f, size_t j, double t);

/* fvi_forces_jump -- the number i, from 0, of the times at which the force jumps, as far as
 * it is known: the ends of its steps, and its impulses. NaN if there are not so many. */
double fvi_forces_jump(const fvi_forces *f, size_t i);

/* fvi_forces_free -- give everything back. NULL is allowed. */
void fvi_forces_free(fvi_forces *f);

#endif
