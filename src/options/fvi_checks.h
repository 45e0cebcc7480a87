/* src/options/fvi_checks.h -- Check that the options go together, because what is asked for is done or refused.
 *
 * Each check returns 0, or a code of fvi/error.h with the error filled in. */
#ifndef FVI_CHECKS_H
#define FVI_CHECKS_H

#include "fvi_option_list.h"

/* fvi_check_method -- Check that o->method takes the alpha, the law, the system, kappa and the kind of memory. */
int fvi_check_method(const fvi_options *o, fvi_error *c);

/* fvi_is_oscillator -- Return nonzero for a single mass that alpha or a law damps. It has an exact solution of its own
 * (exact_solution.h). For everything else the solution of several masses is used (exact_motion.h). */
int fvi_is_oscillator(const fvi_options *o);

/* fvi_check_exact -- Check that the library has an exact solution of the problem.
 * fvi_check_exact_motion -- Check the part of it that concerns several masses, and a single mass whose accelerations
 * and forces are asked for. */
int fvi_check_exact(const fvi_options *o, fvi_error *c);
int fvi_check_exact_motion(const fvi_options *o, fvi_error *c);

/* fvi_check_solution -- Check that the problem has a solution [(19.2)], and write o->no_solution. A problem without a
 * solution is allowed only for `run` with the paper's method. It is refused with --error, because there is no solution
 * to which a run could be near. */
int fvi_check_solution(fvi_options *o, fvi_error *c);

/* fvi_check_impulses -- Check that the method takes the impulses of the force. At alpha = 1 the damping acts as an
 * added mass. The momentum of a method with stages does not contain this mass, so an impulse changes another momentum.
 * [(17.17)] */
int fvi_check_impulses(const fvi_options *o, fvi_error *c);

/* fvi_check_forces -- Check --force and --ground as fvi_check_force does, in the steps of a run; at t = 0 alone if
 * steps = 0. [(13.12)] */
int fvi_check_forces(const fvi_options *o, size_t steps, fvi_error *c);

#endif
