/* src/fvi/solve.h -- The motion of a body at given times, by one call.                          [H 18, 22]
 *
 *     const fvi_problem problem = { .system = system, .x0 = x0, .p0 = p0, .T = 20, .alpha = 0.3 };
 *     const fvi_accuracy to_nine_digits = { .tolerance = 1e-9 };
 *     status = fvi_solve(&problem, NULL, &to_nine_digits, &outputs, NULL, &error);
 *
 * The call is the same for every method. With a tolerance the library finds the steps; without a tolerance the caller
 * gives them. A member that an initialiser leaves out is zero, and zero means the usual choice. So no option needs to
 * be set. */
#ifndef FVI_SOLVE_H
#define FVI_SOLVE_H

#include "error.h"
#include "observer.h"
#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_problem -- a system and its start. Everything to which the struct points must outlive the call.
 *
 *   system   masses, dampings, potential, force (system.h)
 *   x0, p0   initial position and momentum, d finite numbers each
 *   T        the end of the motion, finite, > 0
 *   alpha    the damping has the order 2 alpha, 0 <= alpha <= 1: 0 is a spring, 1/2 a dashpot
 *   law      NULL; or a law of damping, which replaces alpha (damping_laws.h)
 *   past     what the body did before t = 0 (past.h); zeroed: it was held at x0
 *   events, event_count  the events to watch for, which may end the motion or change its momentum (events.h), and their
 *            number; NULL and 0: none */
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

/* fvi_solve_options -- the method and its options. NULL or a zeroed struct means the usual choice for each.
 *
 *   method   the method. NULL: with events or with a tolerance the method of fvi_method_for_error, else fvi_fractional
 *   h        the step, > 0, of a run without a tolerance; not read with a tolerance. fvi_variable_step needs no h,
 *            because it chooses its steps
 *   kappa    for methods with a kappa: the potential is taken at kappa x_k + (1 - kappa) x_{k+1}. NULL: 1/2
 *   longest  no step is longer; 0: no limit. Set it to the length of a swing or a pulse of a force without a bound
 *            (system.h), so that no step passes over it
 *   step_error  for fvi_variable_step without a tolerance: as in fvi_run (trajectory.h)
 *   history, history_tolerance  as memory and tolerance of fvi_run */
typedef struct {
    const fvi_method *method;
    double h;
    const double *kappa;
    double longest, step_error;
    fvi_history_kind history;
    double history_tolerance;
} fvi_solve_options;

/* fvi_accuracy -- the accuracy that the caller asks for.
 *
 *   tolerance   the largest allowed max |x - x(t)| at the outputs, by an estimate, in the unit of x, > 0; 0: the caller
 *               gives the steps
 *   most_steps  with a tolerance no run takes more steps; 0: 2^24. Without a tolerance it is read for fvi_variable_step
 *               only, as in fvi_run (trajectory.h), because all other methods take T / h steps */
typedef struct {
    double tolerance;
    size_t most_steps;
} fvi_accuracy;

/* fvi_outputs -- the times at which the motion is wanted, and the places for the results. The arrays belong to the
 * caller.
 *
 *   rows    number of times, >= 1
 *   t       the times, increasing, 0 <= t <= T. NULL: equidistant times from 0 to T, rows >= 2. Without a tolerance
 *           and with an h they are the times k h of all steps, so rows must be T / h + 1
 *   x, p    outputs, rows * d numbers each, component i of row k at [k * d + i]; NULL: not wanted
 *   energy  output, rows numbers; NULL: not wanted
 *   row     NULL; or a function that is called for each row, in order, with its x and p. If it returns another number
 *           than 0, the call ends and returns this number
 *   params  handed to row, observed, between and event
 *   observed, wanted  NULL; or a function that is called after row with an observation of the run (observer.h).
 *           `wanted` has the bits of its quantities: velocities, accelerations, forces, work. With a tolerance the run
 *           that was found is repeated for it
 *   between  NULL; or a function that is called with an observation at the end of each step that is no row, in the
 *           order of time. For example, it can find a maximum between two rows. It needs observed
 *   event   NULL; or a function that is called for each event, with x at the event and p right after it. The rows at
 *           the same time or later come after this call. If it returns another number than 0, fvi_solve ends and
 *           returns this number. After an event that ends the motion there are no rows */
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

/* fvi_report -- how fvi_solve found the motion. "The run" is the run whose rows are the outputs.
 *
 *   method    the method
 *   other     if the tolerance was not reached: a method of higher order that takes the problem, or NULL if there is
 *             none
 *   steps, rejected  number of steps of the run, and of rejected trial steps
 *   h         the step of the run; for a method that chooses its steps the longest step
 *   error     with a tolerance: the estimate of max |x - x(t)|; infinite if there is none
 *   stages, form  for fvi_variable_step: as in fvi_step_statistics (variable_steps.h)
 *   rows, events  number of rows and of events. There are fewer rows than asked for if an event ended the motion
 *   step_error    for fvi_variable_step with a tolerance: the step_error of the run
 *   agreed, agreed_until, events_differ  for FVI_ETOL with events: the number of events that the last two runs have in
 *             common; the time of the last of them; nonzero if the runs differ after that time
 *   until     for FVI_ETOL: the tolerance is reached up to this time, by an estimate. 0 if this time is less than a
 *             twentieth of T. Also 0 if two runs agree up to T, but the difference between runs does not fall with the
 *             step as the order of the method demands */
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

/* fvi_method_for_error -- Return the method that reaches a tolerance in the least time, according to measurements.
 *
 *   run        as for fvi_stepper_start; the end of the motion is h times steps
 *   tolerance  of x, > 0
 *
 * It is fvi_variable_step, except for some matrices and laws without events. For matrices it is fvi_cq2_midpoint if
 * fvi_variable_step_takes_structure (variable_steps.h) returns 0. For a law that fvi_variable_step refuses it is
 * fvi_lobatto_m4 for a tolerance below 1e-5 of max |x0| (of 1 if x0 = 0), if that method takes the run, and else
 * fvi_cq_bdf2.
 *
 * For example, take a Duffing spring for 20 units of time. With zener:1,0.6,0.5, which fvi_variable_step does not take,
 * fvi_cq_bdf2 needs 7 ms and fvi_lobatto_m4 140 ms for the tolerance 1e-3, and 293 ms and 152 ms for 1e-6. With
 * zener:1,0.3,0.5 fvi_variable_step needs 0.5 ms and fvi_cq_bdf2 22 ms for 1e-6.
 *
 * Cost: the start of a run, if the run has a law. The method may still refuse the run for another reason, which
 * fvi_stepper_start reports. */
const fvi_method *fvi_method_for_error(const fvi_run *run, double tolerance);

/* fvi_solve -- Compute the motion at the times of the outputs.
 *
 *   options, accuracy  NULL: the usual choice. Without a tolerance options->h is needed, except for fvi_variable_step
 *   report, error      outputs, or NULL. The report is filled in after success and after FVI_ETOL
 *
 * Estimate of the error. With a tolerance fvi_variable_step runs twice, on meshes that cannot coincide, and takes the
 * difference of the two runs for the error of the first (H 22). Other methods halve their step until the observed order
 * is the order of the method (H 18). Both are estimates, not bounds. An effect that all runs miss does not show, such
 * as a pulse of a force without bounds that is shorter than their steps. The tolerance says nothing about the error of
 * p.
 *
 * Events. With events and a tolerance the two runs must have the same events. The estimate is then at least the
 * difference of x at each event, and at least the largest speed of x times the difference of the two times of an event.
 * So the time of an event is right to tolerance / speed. A lift-off is an exception, because an error of its time moves
 * the body by the square of this error only. A body comes to rest after an impact from which it would rise no higher
 * than the tolerance. For example, let a ball fall with g = 1 from the height 1 onto z = x with e = 1/2. Hop n is 4^-n
 * high, so with the tolerance 1e-6 the ball rests at the tenth impact, because 4^-10 = 0.95e-6. One difference between
 * the two runs is allowed: an event very near the end, within tolerance / speed and within a thousandth of T, may be
 * missing in one of them. If the runs differ in other events for all steps, the function returns FVI_ETOL. This happens
 * if z only touches 0, or if the motion is chaotic.
 *
 * Times. fvi_variable_step has outputs at any time. So have methods with stages if `observed` is NULL, by the path of
 * their stages (lobatto.h); between two steps x then has the order s, and p the order s - 1. All other methods, and
 * methods with stages if `observed` is set, know positions at the ends of steps only. Without a tolerance each t must
 * be a multiple of h, up to rounding. With a tolerance the times must have a common step, at most 2^20 of which fit in
 * T. If they have none, methods with stages reach the tolerance at the times themselves: the step is halved until two
 * runs agree there, and the error is their difference.
 *
 * Memory. Without a tolerance O(d) and the history of the method: rows are stored in the outputs only. With a tolerance
 * three times the memory of x at all rows, and at 128 rows at least.
 *
 * Returns FVI_SUCCESS; FVI_EFAULT, FVI_EINVAL, FVI_EDOM or FVI_EUNSUP for an argument that is wrong, or that the method
 * does not take, with its field ("x0", "T", "t", ...), number and index in *error; FVI_ETOL if the tolerance cannot be
 * reached, or not in most_steps; FVI_ERUNAWAY after most_steps without a tolerance; FVI_ENOMEM; FVI_EMAXITER, FVI_ESING
 * or FVI_EOVRFLW of a step, whose number is error->index; or what a callback returned. After an error in a
 * step or in a row the rows before it are valid. After any other error the outputs are untouched. */
int fvi_solve(const fvi_problem *problem, const fvi_solve_options *options,
              const fvi_accuracy *accuracy, const fvi_outputs *outputs,
              fvi_report *report, fvi_error *error);

/* fvi_common_steps -- Return the smallest number of equal steps from 0 to T that end at each of `count` times, up to
 * rounding; 0 if there is none up to 2^20. For example, the times 0.5 and 0.75 with T = 1 have 4 steps. Cost O(count)
 * for each number of steps that is tried. */
size_t fvi_common_steps(size_t count, const double *t, double T);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
