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

/* fvi_complain_of_start -- why a run could not begin, on standard error; returns 1. */
int fvi_complain_of_start(const fvi_options *o, int status);

/* fvi_run_warn -- on standard error, before a run that has no limit, or must blow up; it goes on
 * all the same. What is said of the step is left in text, for the head: room for
 * FVI_WARNING_ROOM. Returns 0, or 1 after a complaint, where there is no memory to find out. */
int fvi_run_warn(const fvi_options *o, const fvi_run *r, size_t size,
                  char *text);

/* fvi_run_head -- that text in the head of a table, if it is one, under a name that no other
 * warning has: what is read as JSON keeps one of two. */
void fvi_run_head(FILE *out, const fvi_options *o, const char *unstable);

/* fvi_run_row -- take row k, which the run has reached or just passed. Returns what
 * fvi_table_take and fvi_stepper_advance_to return, or FVI_ENOMEM. */
int fvi_run_row(const fvi_table *t, fvi_stepper *s, size_t k);

/* fvi_snapshot -- a line for each unknown of s, number, x and p, into o->snapshot, complete or
 * not at all, if there is such a name. Returns 0, or 1 after it has said what is wrong. */
int fvi_snapshot(const fvi_options *o, const fvi_stepper *s);

/* fvi_run_search -- the rows k = 0, ..., steps of r by this method, right to o->error; x and p
 * have room for them. Returns what fvi_solve returns. */
int fvi_run_search(const fvi_options *o, const fvi_method *method,
                   const fvi_run *r, double *x, double *p, fvi_report *found);

/* fvi_variable_step_head -- two lines of the head: what a method that chooses its steps has
 * chosen; how many of them, if not 0. */
void fvi_variable_step_head(FILE *out, const fvi_options *o, int stages,
                            char form, size_t steps);

#endif
