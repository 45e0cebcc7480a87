/* src/fvi/columns.h -- Columns of a table as they are typed, and what becomes of them over a run.
 *
 *     t, x, drift=x2-x1, floor=a2+ag, loop=d1.force      columns
 *     max(drift), at(absmax(drift)), rms(a2+ag)          reductions
 *
 * The names that stand in the expressions are those of an observer (observer.h):
 *
 *     t  x p v a F energy work balance ag  NAME.force NAME.impulse NAME.work
 *     multiplier1 ... of constraints, reaction3 of a coordinate x3 that is prescribed
 *     event1.count, event1.last of the first event: how often it has happened, and when the last time, 0 before
 *
 * with a number in more dimensions, x1 ... xd, and NAME.force1 ... where a damper acts on each
 * coordinate. F is what acts, a ground's part of it included; ag is the acceleration of the ground,
 * work that of all dampers. A name alone, x or d1.force, is a column for each number.
 *
 *     fvi_typed_columns *c;
 *     const fvi_column_source source = { .d = 2 };
 *     if (fvi_typed_columns_start(&source, &c, &error) == FVI_SUCCESS
 *         && fvi_parse_columns("t,drift=x2-x1", NULL, c, &error) == FVI_SUCCESS)
 *         status = fvi_observer_start(s, fvi_typed_columns_wanted(c), &o, &error);
 *     ... fvi_typed_columns_values(c, &now, row); */
#ifndef FVI_COLUMNS_H
#define FVI_COLUMNS_H

#include "dampers.h"
#include "observer.h"
#include "parse.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

typedef struct fvi_typed_columns fvi_typed_columns;

/* fvi_column_source -- of what the columns are.
 *
 *   d           coordinates
 *   is_numbered  x1 although d = 1
 *   mechanism   NULL: one damper d1 that acts on each coordinate; else its dampers
 *   is_structure  nonzero: a damper by a matrix acts on each coordinate, too
 *   ground      NULL, or its acceleration, a force of one number: ag
 *   events      how many events are watched
 *   shown, shown_count  which coordinates a name alone stands for, from 0; NULL: all
 *
 * It is kept, not copied. */
typedef struct {
    size_t d;
    int is_numbered;
    const fvi_mechanism *mechanism;
    int is_structure;
    const fvi_force *ground;
    const size_t *shown;
    size_t shown_count;
    size_t events;
} fvi_column_source;

/* fvi_typed_columns_start -- none yet; free them with fvi_typed_columns_free. FVI_ENOMEM. */
int fvi_typed_columns_start(const fvi_column_source *source,
                            fvi_typed_columns **columns, fvi_error *error);
void fvi_typed_columns_free(fvi_typed_columns *columns);

/* fvi_parse_columns -- one or more, parted by commas, behind those that are there. NAME=EXPRESSION gives
 * a name, which the expressions behind may use.
 *
 *   parameters  NULL, or names with values that may stand in expressions too
 *
 * As the parsers (parse.h): the field is "columns". A name that is none is said with the nearest
 * one; refused is one that stands twice, or is already a quantity's, a function's or a
 * parameter's. */
int fvi_parse_columns(const char *text, fvi_user_parameters *parameters,
                      fvi_typed_columns *columns, fvi_error *error);

/* fvi_parse_reductions -- one or more of [NAME=]WHAT(EXPRESSION), the field is "reduce":
 *
 *     min max absmax    the least, the largest, the largest without its sign
 *     mean rms          over time, by the trapezoidal rule
 *     first last        the first, the last
 *     peak              absmax, refined by the parabola through three steps
 *     at(WHAT(...))     the time of it, of all but mean and rms
 *
 * The names of columns may stand in the expressions. */
int fvi_parse_reductions(const char *text, fvi_user_parameters *parameters,
                         fvi_typed_columns *columns, fvi_error *error);

/* fvi_typed_columns_wanted -- what an observer has to know for them.
 * fvi_typed_columns_count -- how many numbers a row has.
 * fvi_typed_column_name -- the name of one, from 0.
 * fvi_typed_columns_values -- a row of an observation; fvi_typed_columns_count numbers. Returns what the
 * ground returned; a number may be not finite.
 * fvi_reductions_count, fvi_reduction_name -- the same of reductions. */
unsigned fvi_typed_columns_wanted(const fvi_typed_columns *columns);
size_t fvi_typed_columns_count(const fvi_typed_columns *columns);
const char *fvi_typed_column_name(const fvi_typed_columns *columns, size_t i);
int fvi_typed_columns_values(fvi_typed_columns *columns,
                             const fvi_observation *now, double *row);
size_t fvi_reductions_count(const fvi_typed_columns *columns);
const char *fvi_reduction_name(const fvi_typed_columns *columns, size_t i);

/* fvi_reductions_add -- one more step at the time t, after fvi_typed_columns_values has read it, in the order
 * of time, the first at t = 0. FVI_EOVRFLW if a number is not finite.
 * fvi_reductions_values -- of all steps so far; fvi_reductions_count numbers.
 * fvi_reductions_archive -- what steps changed, as fvi_stepper_archive. */
int fvi_reductions_add(fvi_typed_columns *columns, double t);
void fvi_reductions_values(const fvi_typed_columns *columns, double *values);
int fvi_reductions_archive(fvi_typed_columns *columns, fvi_archive *archive);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
