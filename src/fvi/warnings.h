/* src/fvi/warnings.h -- Warnings: reasons to doubt the numbers of a run.                        [H 12, 14, 19]
 *
 * A warning is no error: the run can be made, and its numbers are those of the method. But they are not the numbers of
 * a motion, or something that the caller asked for has no effect on them. The text of a warning is one line of English
 * without a full stop. The program prints it, and Python hands it to warnings.warn.
 *
 * Each function returns 1 and a text if there is a warning; 0 if there is none; and -1 and a text if there is no memory
 * to find out. After -1 the program and Python refuse the run. The warnings of a fit are in identification.h.
 *
 *     char text[FVI_WARNING_ROOM];
 *     if (fvi_warning_of_step(&fvi_fractional, &run, sizeof text, text))
 *         fprintf(stderr, "warning: %s\n", text); */
#ifndef FVI_WARNINGS_H
#define FVI_WARNINGS_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

enum { FVI_WARNING_ROOM = 400 }; /* characters for a text, with the terminating zero */

/* fvi_warning_of_initial_history -- Warn if no motion starts like this run: the past is RIEMANN_LIOUVILLE, alpha > 1/2,
 * and a damped coordinate has x0 != 0.                                                                        [(19.2)]
 *
 *   run   a run that fvi_stepper_start takes
 *   text  output: a constant text; NULL if there is no warning
 *
 * fvi_fractional makes such a run; the other methods refuse it. Cost O(d); with matrices one product with C. */
int fvi_warning_of_initial_history(const fvi_run *run, const char **text);

/* fvi_warning_of_step -- Warn if a mode of the run grows from step to step.                     [(14.3), (14.4)]
 *
 *   method, run  as for fvi_stepper_start; the load (stability.h) is that of small motions about x0
 *   size, text   output, room for FVI_WARNING_ROOM characters; empty if there is no warning
 *
 * The text has the load, and the step below which no mode grows if that step is known. The function gives no warning if
 * the load is not known, if its computation fails, or if it would cost d^3 operations (methods with stages and more
 * than 256 masses). Cost: one load; some sixty loads if it is above 1. */
int fvi_warning_of_step(const fvi_method *method, const fvi_run *run,
                        size_t size, char *text);

/* fvi_warning_of_memory -- Warn if the caller asks for a memory or a tolerance that the run does not read.    [H 12]
 *
 *   method, run  as for fvi_stepper_start
 *   size, text   as above
 *
 * A method without a memory, for example fvi_lagrange_dalembert, does not read run->memory. FVI_HISTORY_MODES is then a
 * warning. FVI_HISTORY_DIRECT is none, because nothing is left out of the sum. A run->tolerance other than 0 is a
 * warning in four cases: the method has no memory; it chooses its steps, as fvi_variable_step does; run->memory is
 * FVI_HISTORY_DIRECT; or no law of the run has decaying modes, so FVI_HISTORY_AUTO sums directly.
 *
 *     run.tolerance = 1e-6;
 *     fvi_warning_of_memory(&fvi_variable_step, &run, sizeof text, text);
 *     // "tolerance 1e-06 has no effect: fvi-adaptive keeps its memory to the error of its steps"
 *
 * Cost: some comparisons. With a tolerance, FVI_HISTORY_AUTO and a law it costs as much as fvi_method_has_modes. */
int fvi_warning_of_memory(const fvi_method *method, const fvi_run *run, size_t size, char *text);

/* fvi_watch -- the state of a watch over a run that may become stiffer on its way; owned by the caller. */
typedef struct {
    double stiffest; /* the largest stiffness so far, see fvi_stability_along_run */
    size_t next; /* the step of the next check; no check where it is SIZE_MAX */
} fvi_watch;

/* fvi_watch_begin -- Return a watch, before the first step of a run. It checks nothing if U is quadratic, if the load
 * does not depend on U, if the load is not known, or if it would cost d^3 operations.
 *
 *   method, run  as for fvi_stepper_start
 *   is_unstable  nonzero if fvi_warning_of_step has warned: the watch checks nothing */
fvi_watch fvi_watch_begin(const fvi_method *method, const fvi_run *run,
                          int is_unstable);

/* fvi_warning_along -- Warn, at most once in a run, if small motions about the present place of the run grow with its
 * step.                                                                                                 [(14.6)]
 *
 *   watch        the watch of this run
 *   method, run  as above; x0 is not read
 *   k, x         the number of the step, and the d positions after step k
 *   size, text   output, room for FVI_WARNING_ROOM characters; untouched if there is no warning
 *
 *     fvi_watch watch = fvi_watch_begin(method, &run, 0);
 *     while (s->k < run.steps && fvi_stepper_step(s) == FVI_SUCCESS)
 *         if (fvi_warning_along(&watch, method, &run, s->k, s->x, sizeof text, text))
 *             fprintf(stderr, "warning: %s\n", text);
 *
 * Call the function after each step. It checks after the first eight steps and then after every eighth. Cost: one
 * comparison; a check costs as much as fvi_stability_along_run. */
int fvi_warning_along(fvi_watch *watch, const fvi_method *method,
                      const fvi_run *run, size_t k, const double *x,
                      size_t size, char *text);

/* fvi_inertia_watch_begin -- Start a watch over a run of a Lagrangian, for the case that L_vv becomes singular. For
 * example, L_vv of v^4 is singular at v = 0, and L_vv of polar coordinates at the pole. [H 29]
 *
 *   system  as for fvi_stepper_start; must outlive the watch
 *   watch   output; free it with fvi_inertia_watch_free. NULL if the system has no Lagrangian
 *
 * Returns FVI_SUCCESS or FVI_ENOMEM.
 *
 * fvi_inertia_watch_free -- Free the watch. NULL is allowed. */
typedef struct fvi_inertia_watch fvi_inertia_watch;
int fvi_inertia_watch_begin(const fvi_system *system, fvi_inertia_watch **watch);
void fvi_inertia_watch_free(fvi_inertia_watch *watch);

/* fvi_warning_of_inertia -- Warn, at most once in a run, if L_vv is nearly singular: a pivot of L_vv is below 1e-6 of
 * the largest inertia of its coordinates so far. The function checks the present row, and the straight line from the
 * last row to this one. It also warns if L_v(x, v) = p cannot be solved.
 *
 *   watch       the watch of this run; NULL: no warning
 *   t, x, p     a time, and d positions and momenta at this time; times increase from call to call
 *   size, text  output, room for FVI_WARNING_ROOM characters; untouched if there is no warning
 *
 *     fvi_inertia_watch *watch;
 *     fvi_inertia_watch_begin(&system, &watch);
 *     if (fvi_warning_of_inertia(watch, s->t, s->x, s->p, sizeof text, text) > 0) puts(text);
 *
 * For example, a body that was thrown up has v = 0 at a time t1. For L = v^4/12 its velocity is there like
 * (t - t1)^(1/3), and no method has its order. Cost: two to four evaluations of L_vv; some forty more if a velocity
 * changes its sign. */
int fvi_warning_of_inertia(fvi_inertia_watch *watch, double t, const double *x, const double *p,
                           size_t size, char *text);

/* fvi_warning_of_inertia_in_rows -- Check all rows of a finished run in the same way, up to the first row that is not
 * finite.
 *
 *   rows, t     number of rows, and their times
 *   x, p        rows * d numbers each, component i of row k at [k * d + i]
 *   size, text  as above */
int fvi_warning_of_inertia_in_rows(const fvi_system *system, size_t rows, const double *t,
                                   const double *x, const double *p, size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
