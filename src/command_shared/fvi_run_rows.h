/* src/command_shared/fvi_run_rows.h -- Print the rows of a run, with the columns that an observer provides. */
#ifndef FVI_RUN_ROWS_H
#define FVI_RUN_ROWS_H

#include "output/fvi_table.h"

#include <fvi/observer.h>

/* fvi_run_observe -- Make t->observer at the start of a run, or again at a new start, if a column or a reduction needs
 * it. Free it with fvi_observer_free.
 * fvi_run_step -- Make one step, and observe it.
 * Both return what fvi_observer_start and fvi_observer_step return. */
int fvi_run_observe(fvi_table *t, const fvi_stepper *s, fvi_error *error);
int fvi_run_step(fvi_table *t, fvi_stepper *s);

/* fvi_run_row -- Take row k, which the run has reached or just passed. With reductions nothing is done. Return what
 * fvi_table_take, fvi_observer_read and fvi_stepper_advance_to return, or FVI_ENOMEM. */
int fvi_run_row(fvi_table *t, fvi_stepper *s, size_t k);

/* fvi_run_state_row -- Take row k of a state without a stepper. x and p must be enough for the columns: see
 * fvi_options_needs_stepper. */
int fvi_run_state_row(fvi_table *t, size_t k, const double *x, const double *p);

/* fvi_run_observed_row -- Take row k from x, p, a, force and impulse of the observation `given`. The other members that
 * the columns need are computed here. */
int fvi_run_observed_row(fvi_table *t, size_t k, const fvi_observation *given);

/* fvi_run_found_row -- Take row k of the rows that fvi_run_search has found. */
int fvi_run_found_row(fvi_table *t, size_t k, const double *x, const double *p,
                      const double *typed);

/* fvi_run_reduce -- Add an observation to the reductions. Return what fvi_typed_columns_values and fvi_reductions_add
 * return.
 * fvi_run_reductions -- Print the reductions of a run that is over, if any are asked for. FVI_EOVRFLW if one of them is
 * not finite. */
int fvi_run_reduce(const fvi_options *o, const fvi_observation *now);
int fvi_run_reductions(fvi_table *t);

#endif
