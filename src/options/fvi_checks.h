/* src/options/fvi_checks.h -- What is asked for is done or refused: words that do not go together.
 *
 * Each check returns 0, or a code of fvi/error.h with the error written. */
#ifndef FVI_CHECKS_H
#define FVI_CHECKS_H

#include "fvi_option_list.h"

/* fvi_check_method -- does o->method take the alpha, the laws, the system, kappa and the memory? */
int fvi_check_method(const fvi_options *o, fvi_error *c);

/* fvi_is_oscillator -- is it one mass that alpha or a law damps? It has an exact solution of its own
 * (exact_solution.h); all else that of many masses (exact_motion.h). */
int fvi_is_oscillator(const fvi_options *o);

/* fvi_check_exact -- has the library an exact solution of it?
 * fvi_check_exact_motion -- the part of it that is asked of many masses, and of one whose accelerations and forces are
 * asked for. */
int fvi_check_exact(const fvi_options *o, fvi_error *c);
int fvi_check_exact_motion(const fvi_options *o, fvi_error *c);

/* fvi_check_solution -- has the problem a solution? One that has none is for `run` with the paper's
 * method alone, and not with --error, as there is nothing to be near to. (19.2) It writes
 * o->no_solution. */
int fvi_check_solution(fvi_options *o, fvi_error *c);

/* fvi_check_impulses -- does the method take the impulses of the force? At alpha = 1 the momentum of a
 * method with stages is not the one that is hit. (17.17) */
int fvi_check_impulses(const fvi_options *o, fvi_error *c);

#endif
