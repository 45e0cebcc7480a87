/* src/fvi/warnings.h -- What to know before a run is believed.   [H 14, 19]
 *
 * These are no errors: the run can be made, and its numbers are those of the method. But
 * the numbers are not those of a motion. Each function says so in a line of English,
 * without a full stop; the program prints the line, Python hands it to warnings.warn.
 * A function returns 1 with a text, 0 where it has nothing to say, and -1, with a text that
 * says so, where there is no memory to find out: the program and Python then refuse the run.
 * What a fit has to say stands in identification.h. */
#ifndef FVI_WARNINGS_H
#define FVI_WARNINGS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

enum { FVI_WARNING_ROOM = 400 }; /* characters for a text, with its end */

/* fvi_warning_of_initial_history -- 1 if no motion starts like this run: Riemann-Liouville
 * with a damped x0 != 0 and alpha > 1/2; else 0; -1 without memory.          [(19.2)]
 *
 *   run   of a system that fvi_stepper_start takes
 *   text  output, a constant text, or NULL for 0
 *
 * The method fvi runs it all the same; the others refuse it. Cost O(d), one product by C. */
int fvi_warning_of_initial_history(const fvi_run *run, const char **text);

/* fvi_warning_of_step -- 1 if a mode of the run grows from step to step, and the text then;
 * else 0, and the text is empty; -1 without memory.                  [(14.3), (14.4)]
 *
 *   method, run  as for fvi_stepper_start; the load is that of small motions about x0
 *   size, text   output, room for FVI_WARNING_ROOM characters
 *
 * The text has the load of fvi_stability_number, and where it is known the step below which
 * no mode grows. 0, too, where a load is not known, fails, or would cost d^3 operations:
 * methods with stages and more than 256 masses. Cost: one load; some sixty if it is above 1. */
int fvi_warning_of_step(const fvi_method *method, const fvi_run *run,
                        size_t size, char *text);

/* fvi_watch -- for runs that get stiffer on their way; owned by the caller. */
typedef struct {
    double stiffest; /* so far, see fvi_stability_along_run */
    size_t next; /* the step of the next check; no check where it is SIZE_MAX */
} fvi_watch;

/* fvi_watch_begin -- before the first step. Nothing will be checked if U is quadratic,
 * or the load does not depend on U, or is not known, or would cost d^3 operations.
 *
 *   method, run  as for fvi_stepper_start
 *   is_unstable  nonzero if fvi_warning_of_step has warned: nothing will be checked */
fvi_watch fvi_watch_begin(const fvi_method *method, const fvi_run *run,
                          int is_unstable);

/* fvi_warning_along -- 1 and a text, once in a run, where small motions about the place of
 * the run grow with such a step; else 0, and the text is untouched; -1 without memory. [(14.6)]
 *
 *   watch        of this run
 *   method, run  as above; x0 is not read
 *   k, x         after step k the d positions x
 *   size, text   as above
 *
 * Call it after each step, k = 1, 2, ...: it checks after the first eight and after every
 * eighth. Cost: a comparison; a check costs what fvi_stability_along_run does. */
int fvi_warning_along(fvi_watch *watch, const fvi_method *method,
                      const fvi_run *run, size_t k, const double *x,
                      size_t size, char *text);

/* fvi_inertia_watch_begin -- for runs of a Lagrangian whose L_vv may become singular, as that of v^4 does at
 * v = 0, and that of polar coordinates at the pole.                                          [H 29]
 *
 *   system  as for fvi_stepper_start; kept
 *   watch   output, give it back with fvi_inertia_watch_free; NULL where there is no Lagrangian
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM. */
typedef struct fvi_inertia_watch fvi_inertia_watch;
int fvi_inertia_watch_begin(const fvi_system *system, fvi_inertia_watch **watch);
void fvi_inertia_watch_free(fvi_inertia_watch *watch);

/* fvi_warning_of_inertia -- 1 and a text, once in a run, where a pivot of L_vv is below 1e-6 of the largest
 * inertia of its coordinates so far, at this time or between the last check and this one, along the straight
 * line; or where L_v(x, v) = p cannot be solved. Else 0, and the text is untouched; -1 without memory.
 *
 *   watch       of this run, or NULL: 0
 *   t, x, p     a time, and d positions and momenta there; times increase
 *   size, text  as above
 *
 * A body that was thrown up has v = 0 for a moment, and for L = v^4/12 the velocity is then as (t - t1)^(1/3):
 * no method has its order there. Cost: two to four evaluations of L_vv, some forty more where a velocity changes
 * its sign.
 *
 *     fvi_inertia_watch *watch;
 *     fvi_inertia_watch_begin(&system, &watch);
 *     if (fvi_warning_of_inertia(watch, s->t, s->x, s->p, sizeof text, text) > 0) puts(text); */
int fvi_warning_of_inertia(fvi_inertia_watch *watch, double t, const double *x, const double *p,
                           size_t size, char *text);

/* fvi_warning_of_inertia_in_rows -- the same of a run that is over, at its rows, as far as they are finite.
 *
 *   t, x, p  rows numbers; rows d numbers each, component i of row k at [k d + i] */
int fvi_warning_of_inertia_in_rows(const fvi_system *system, size_t rows, const double *t,
                                   const double *x, const double *p, size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
