/* src/command_shared/fvi_run_rows.h -- The rows of a run, with what an observer tells of it. */
#ifndef FVI_RUN_ROWS_H
#define FVI_RUN_ROWS_H

#include "output/fvi_table.h"

#include <fvi/observer.h>

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

#endif
