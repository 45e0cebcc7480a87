/* src/program/fvi_run.h -- What the two ways of `fvi run` share: by a given step, and to a
 * wanted error; and the commands that make runs. */
#ifndef FVI_RUN_H
#define FVI_RUN_H

#include <fvi/solve.h>
#include <fvi/variable_steps.h>
#include <fvi/warnings.h>
#include "fvi_commands.h"
#include "output/fvi_table.h"

/* fvi_run_room -- room for the rows that are kept; NULL if what is surely asked for is more
 * than the machine has. */
double *fvi_run_room(const fvi_table *t);

/* fvi_complain_of_start -- why a run of this command could not begin, on standard error: with the option
 * that the error's field is about, or by its code. Returns an exit code. */
int fvi_complain_of_start(const fvi_options *o, const fvi_error *error, const char *command);

/* fvi_reason_of_code -- why a run could not begin if the library named no field: with the option that its
 * code speaks of before it. */
const char *fvi_reason_of_code(const fvi_options *o, int status);

/* fvi_reason_of_start -- why a run, or its observer, could not begin, of which only the status came back: both
 * are started once more. A field of the error is an option; NULL if nothing more is known. */
void fvi_reason_of_start(const fvi_options *o, const fvi_run *r, int status, fvi_error *error);

/* fvi_run_warn -- on standard error, before a run that has no limit, or must blow up; it goes on
 * all the same. What is said of the step is left in text, for the head: room for
 * FVI_WARNING_ROOM. Returns 0, or 1 after a complaint, where there is no memory to find out. */
int fvi_run_warn(const fvi_options *o, const fvi_run *r, size_t size,
                  char *text);

/* fvi_run_look_at_inertia -- after each step: is it singular, whose text has FVI_WARNING_ROOM? Each look costs as much as
 * a part of a step, so not all steps are followed by one. Returns 1 if so, -1 without memory. Without a watch 0.
 * fvi_run_inertia_of_rows -- fvi_warning_of_inertia_in_rows of so many rows that a search has found, for a text of
 * FVI_WARNING_ROOM; 0 without a Lagrangian, -1 without memory. */
typedef struct {
    fvi_inertia_watch *watch;
    size_t steps;
} fvi_run_inertia;
int fvi_run_look_at_inertia(fvi_run_inertia *w, const fvi_stepper *s, char *text);
int fvi_run_inertia_of_rows(const fvi_options *o, const fvi_system *system, size_t rows,
                            const double *x, const double *p, char *text);

/* fvi_run_observe -- at the start of a run, or again: t->observer, if a column or a reduction needs
 * one; free it with fvi_observer_free. fvi_run_step -- one step, with what is observed of it.
 * Both return as fvi_observer_start and fvi_observer_step. */
int fvi_run_observe(fvi_table *t, const fvi_stepper *s, fvi_error *error);
int fvi_run_step(fvi_table *t, fvi_stepper *s);

/* fvi_run_row -- take row k, which the run has reached or just passed; nothing with reductions. Returns
 * what fvi_table_take, fvi_observer_read and fvi_stepper_advance_to return, or FVI_ENOMEM. */
int fvi_run_row(fvi_table *t, fvi_stepper *s, size_t k);

/* fvi_run_state_row -- the same of a state that no stepper has, where x and p are enough
 * (fvi_options_needs_stepper). */
int fvi_run_state_row(fvi_table *t, size_t k, const double *x, const double *p);

/* fvi_run_observed_row -- the same, of x, p, a, force and impulse of an observation that somebody else has made. */
int fvi_run_observed_row(fvi_table *t, size_t k, const fvi_observation *given);

/* fvi_run_found_row -- row k of what fvi_run_search has found. */
int fvi_run_found_row(fvi_table *t, size_t k, const double *x, const double *p,
                      const double *typed);

/* fvi_run_reduced -- the reductions of a run that is over, t->width numbers.
 * fvi_run_reductions -- they are printed, if any are asked for. FVI_EOVRFLW if one is not finite. */
void fvi_run_reduced(const fvi_table *t, double *row);
int fvi_run_reductions(fvi_table *t);

/* fvi_run_print_events -- n events behind the rows, in the words of the options; nothing without --event. */
void fvi_run_print_events(const fvi_table *t, size_t n, const fvi_event_time *at);

/* fvi_snapshot -- a line for each unknown of s, number, x and p, into o->snapshot, complete or
 * not at all, if there is such a name. Returns 0, or 1 after it has said what is wrong. */
int fvi_snapshot(const fvi_options *o, const fvi_stepper *s);

/* fvi_run_search -- the rows k = 0, ..., steps of r by this method, right to o->error; x and p
 * have room for them, and typed, or NULL, for the typed columns of each row, which are filled in if
 * x and p are not enough for them. Returns what fvi_solve returns; reductions have then seen
 * each step of the run that was found. The events of it are added to `events`, unless that is NULL; free
 * events->at. An event may have ended the run: found->rows rows are there, and in the place of the next one stands
 * the event, unless that is at the last row. */
typedef struct {
    size_t count, room;
    fvi_event_time *at;
} fvi_run_events;
int fvi_run_search(const fvi_options *o, const fvi_method *method,
                   const fvi_run *r, double *x, double *p, double *typed,
                   fvi_report *found, fvi_run_events *events);

/* fvi_variable_step_head -- two lines of the head: what a method that chooses its steps has
 * chosen; how many of them, if not 0. */
void fvi_variable_step_head(FILE *out, const fvi_options *o, int stages,
                            char form, size_t steps);

#endif
