/* src/fvi/solve.h -- Where is the body at these times?                 [H 18, 22]
 *
 *     const fvi_problem problem = { .system = system, .x0 = x0, .p0 = p0, .T = 20, .alpha = 0.3 };
 *     const fvi_accuracy to_nine_digits = { .tolerance = 1e-9 };
 *     status = fvi_solve(&problem, NULL, &to_nine_digits, &outputs, NULL, &error);
 *
 * One call, whatever the method. With a tolerance the library finds the steps; without one the caller
 * gives them. What is left out of a struct is zero, and zero means the usual: no options need be
 * set. */
#ifndef FVI_SOLVE_H
#define FVI_SOLVE_H

#include "error.h"
#include "observer.h"
#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_problem -- what moves, and how it begins.
 *
 *   system   masses, dampings, potential, force (system.h)
 *   x0, p0   the start, d finite numbers each
 *   T        the end of the motion, finite, > 0
 *   alpha    the damping is of order 2 alpha, 0 <= alpha <= 1; so 0 is a spring, and 1/2 a dashpot
 *   law      NULL, or a law of damping instead of alpha (damping_laws.h)
 *   past     what the body did before t = 0 (past.h); zeroed: it was held at x0
 *   events, event_count  NULL and 0, or what is watched, and ends the motion or changes its momentum (events.h)
 *
 * All that it points to must outlive the call. */
typedef struct {
    fvi_system system;
    const double *x0, *p0;
    double T;
    double alpha;
    const fvi_kernel *law;
    fvi_initial_history past;
    const struct fvi_event *events;
    size_t event_count;
} fvi_problem;

/* fvi_solve_options -- how it is solved; NULL or a zeroed one is the usual way.
 *
 *   method   NULL: with events, or a tolerance, that of fvi_method_for_error; without one fvi_fractional
 *   h        the step, > 0, without a tolerance; not read with one
 *   kappa    NULL: 1/2; or, of methods with a kappa: the potential is taken at
 *            kappa x_k + (1 - kappa) x_{k+1}
 *   longest  no step is longer; 0: no limit. A force without a bound that swings, or has a pulse, in
 *            less than this time is seen so
 *   step_error  of fvi_variable_step without a tolerance, as fvi_run has it
 *   history, history_tolerance  as memory and tolerance of fvi_run (trajectory.h) */
typedef struct {
    const fvi_method *method;
    double h;
    const double *kappa;
    double longest, step_error;
    fvi_history_kind history;
    double history_tolerance;
} fvi_solve_options;

/* fvi_accuracy -- how exact it shall be.
 *
 *   tolerance   what max |x - x(t)| may be at the outputs, by an estimate, > 0; 0: not asked for
 *   most_steps  no run of more steps is made; 0: 2^24 with a tolerance, as fvi_run without */
typedef struct {
    double tolerance;
    size_t most_steps;
} fvi_accuracy;

/* fvi_outputs -- where it shall be known.
 *
 *   rows    how many times, >= 1
 *   t       the times, increasing, 0 <= t <= T; NULL: evenly from 0 to T, or, without a tolerance, at
 *           each step, k h
 *   x, p    rows d numbers, component i of row k at [k d + i]; NULL: not wanted
 *   energy  rows numbers, or NULL
 *   row     NULL, or called for each row in order, with its x and p; what it returns but 0 ends the
 *           call, which returns it
 *   params  handed to row, to observed and to between
 *   observed, wanted  NULL, or called behind row with what an observer of the run knows (observer.h), of
 *           which `wanted` says what: velocities, accelerations, forces, work. With a tolerance the
 *           run that was found is made again for it
 *   between  NULL, or called with the same at each step that is no row, in the order of the times: what is
 *           largest may stand between two rows. It needs observed
 *   event   NULL, or called for each event with x there and p behind it, before the rows that are not earlier;
 *           what it returns but 0 ends the call. Where an event ends the motion there are no rows behind it */
typedef struct {
    size_t rows;
    const double *t;
    double *x, *p, *energy;
    int (*row)(size_t k, double t, const double *x, const double *p,
               void *params);
    void *params;
    int (*observed)(size_t k, const fvi_observation *now, void *params);
    unsigned wanted;
    int (*between)(const fvi_observation *now, void *params);
    int (*event)(const fvi_event_time *at, const double *x, const double *p, void *params);
} fvi_outputs;

/* fvi_report -- what was done.
 *
 *   method    which method it was
 *   other     where the tolerance was not reached: a method of higher order that takes the problem,
 *             NULL if there is none
 *   steps, rejected  of the run whose rows are given out; trials that were given up
 *   h         its step; of a method that chooses its steps the longest
 *   error     the estimate of max |x - x(t)|, with a tolerance; infinite if there is none
 *   stages, form  of fvi_variable_step, as fvi_step_statistics has them
 *   rows, events  how many there are: fewer rows than asked for where an event has ended the motion
 *   step_error    of fvi_variable_step with a tolerance: that of a step of the run whose rows are given out
 *   agreed, agreed_until, events_differ  for FVI_ETOL with events: how many of them the last two runs have in
 *             common, the time of the last of these, and nonzero if the runs differ behind it
 *   until     for FVI_ETOL: up to this time the tolerance is reached, by an estimate; 0 if that is less than a twentieth
 *             of T, or all of it, where two runs agree but do not come nearer to each other as they should */
typedef struct {
    const fvi_method *method, *other;
    size_t steps, rejected;
    double h, error;
    int stages;
    char form;
    size_t rows, events, agreed;
    double step_error, agreed_until;
    int events_differ;
    double until;
} fvi_report;

/* fvi_method_for_error -- the method that reaches a tolerance in the least time, as far as measurements tell.
 *
 *   run        as for fvi_stepper_start; h times steps is its time
 *   tolerance  of x, > 0
 *
 * It is fvi_variable_step with events and wherever that takes the problem. Else it is fvi_cq2_midpoint for
 * matrices, and for a law fvi_lobatto_m4 below 1e-5 of max |x0|, or fvi_cq_bdf2. For example, for zener:1,0.6,0.5 on a
 * Duffing spring, which fvi_variable_step does not take, 20 units of time cost 7 ms by fvi_cq_bdf2 and 140 ms by fvi_lobatto_m4
 * with 1e-3, and 293 and 152 ms with 1e-6; and for zener:1,0.3,0.5, which it takes, 0.5 ms by fvi_variable_step
 * and 22 ms by fvi_cq_bdf2 with 1e-6. Cost: the start of a run, for a law. Whether the method refuses the run for
 * another reason is for fvi_stepper_start to say. */
const fvi_method *fvi_method_for_error(const fvi_run *run, double tolerance);

/* fvi_solve -- the motion at the times of the outputs.
 *
 *   options, accuracy  NULL: the usual; then options->h is needed
 *   report, error      outputs, or NULL. The report is filled in on success and for FVI_ETOL
 *
 * With a tolerance fvi_variable_step runs twice on meshes that cannot coincide and takes their
 * difference for the error of the first (H 22); other methods halve their step until the order that
 * they show is theirs (H 18). It is an estimate, no bound: what all runs pass over alike is not seen,
 * such as a pulse of a force without bounds that is shorter than their steps. The error of p is
 * another matter.
 *
 * With events and a tolerance the two runs must have the same events. The error is then also no smaller than the
 * difference of x at each event, nor than the largest speed of x times the difference of the two times. So
 * the time of an event is right to tolerance / speed, unless the body lifts off there, because an error of the time of a
 * lift-off moves the body by its square only. A body is at rest after an impact from which it would rise no
 * higher than the tolerance. For example, for a ball that falls with g = 1 from the height 1 onto z = x with e = 1/2,
 * hop n is 4^-n high; so with the tolerance 1e-6 it is at rest after the tenth, as 4^-10 = 0.95e-6. An event within
 * tolerance / speed of the end, and within a thousandth of T, may stand in one of the runs only. Where runs of any steps
 * differ in their events, as where z only touches 0, or where a motion is chaotic, FVI_ETOL says so.
 *
 * fvi_variable_step gives out any time. So do methods with stages, by the path of their stages
 * (lobatto.h), if `observed` is NULL: between two steps x is then of the order of the stages s, and p of s - 1. Else
 * positions are known at the steps alone: without a tolerance each t is a multiple of h, but for roundings; with
 * one the times have a common step, of which T has at most 2^20. If they have none, a tolerance by stages is held at the
 * times themselves: the step is halved until two runs agree there, and the error is their difference.
 *
 * Without a tolerance no row is kept but in the outputs: memory O(d) and that of the method's history.
 * With one, three times that of x at 128 times at least.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT, FVI_EINVAL, FVI_EDOM, FVI_EUNSUP for what is wrong with an argument
 * or unknown to the method, with its field ("x0", "T", "t", ...), number and index in *error;
 * FVI_ETOL if the tolerance cannot be had; FVI_ERUNAWAY after most_steps; FVI_ENOMEM;
 * FVI_EMAXITER, FVI_ESING, FVI_EOVRFLW of a step, whose number is the index; what a callback returned.
 * Of a failed step the rows before it stand; else the outputs are untouched on error. */
int fvi_solve(const fvi_problem *problem, const fvi_solve_options *options,
              const fvi_accuracy *accuracy, const fvi_outputs *outputs,
              fvi_report *report, fvi_error *error);

/* fvi_common_steps -- the fewest steps of one length from 0 to T that end at each of `count` times, but for roundings; 0 if
 * there are none up to 2^20. For example, 0.5 and 0.75 with T = 1 have 4. Cost O(count), 2^20 times at most. */
size_t fvi_common_steps(size_t count, const double *t, double T);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
