/* src/fvi/columns.h -- Columns of a table from a typed text, and their extremes and means over a run.
 *
 *     t, x, drift=x2-x1, floor=a2+ag, loop=d1.force      columns
 *     max(drift), at(absmax(drift)), rms(a2+ag)          reductions
 *
 * A **column** is an expression, evaluated in each row. A **reduction** is one number that is made of an expression
 * over all steps of a run. The expressions contain the names of what an observer gives (observer.h):
 *
 *     t  x p v a F energy work balance ag  NAME.force NAME.impulse NAME.work
 *     multiplier1 ... of the constraints, reaction3 of the coordinate x3 if it is imposed
 *     event1.count, event1.last of the first event: how often it has happened, not counting that a body lifts off,
 *     and the time of the last, 0 before
 *     event1.force of the first event, if it is a contact: how strongly it pushes
 *
 * In more dimensions a name carries a number, x1 ... xd, and NAME.force1 ... where a damper acts on each coordinate. F
 * is the force that acts, including the part of the ground; ag is the acceleration of the ground; work is the work of
 * all dampers. A vector's name alone, x or d1.force, stands for one column for each number of the vector.
 *
 *     fvi_typed_columns *c;
 *     const fvi_column_source source = { .d = 2 };
 *     if (fvi_typed_columns_start(&source, &c, &error) == FVI_SUCCESS
 *         && fvi_parse_columns("t,drift=x2-x1", NULL, c, &error) == FVI_SUCCESS)
 *         status = fvi_observer_start(s, fvi_typed_columns_wanted(c), &o, &error);
 *
 * and after each fvi_observer_read(o, s, s->t, &now)
 *
 *     status = fvi_typed_columns_values(c, &now, row);   // fvi_typed_columns_count(c) numbers */
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

/* fvi_column_source -- the run that the columns are about. It is not copied, so it must outlive the columns.
 *
 *   d             number of coordinates
 *   is_numbered   nonzero: the coordinate is called x1 also where d = 1
 *   mechanism     NULL: there is one damper, d1, which acts on each coordinate. Else the dampers and constraints of the
 *                 system
 *   is_structure  nonzero: a damper of the mechanism with a matrix acts on each coordinate, too
 *   ground        NULL; or the acceleration of the ground, ag, as a force of one number
 *   shown, shown_count  the coordinates, from 0, that a name alone stands for; NULL: all
 *   events        the number of events that are watched */
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

/* fvi_typed_columns_start -- make an empty list of columns and reductions.
 *
 *   source   see above
 *   columns  output; free it with fvi_typed_columns_free, which allows NULL
 *   error    output or NULL
 *
 * Returns FVI_SUCCESS; FVI_EINVAL if a damper has the name of an event, such as "event1"; FVI_ENOMEM. On error *columns
 * is untouched. */
int fvi_typed_columns_start(const fvi_column_source *source,
                            fvi_typed_columns **columns, fvi_error *error);
void fvi_typed_columns_free(fvi_typed_columns *columns);

/* fvi_parse_columns -- append one or more columns, separated by commas. NAME=EXPRESSION names a column, and the
 * expressions after it may use the name.
 *
 *   text        "t,x,drift=x2-x1"
 *   parameters  NULL, or names with values that may stand in the expressions, too
 *   columns     made by fvi_typed_columns_start
 *   error       output or NULL
 *
 * Returns as every parser (parse.h), with the field "columns". The error of an unknown name contains the nearest known
 * name. A name is refused if it is given twice, or if it is already a quantity, a function or a parameter. On error the
 * columns before the wrong one are kept. */
int fvi_parse_columns(const char *text, fvi_user_parameters *parameters,
                      fvi_typed_columns *columns, fvi_error *error);

/* fvi_parse_reductions -- append one or more reductions [NAME=]WHAT(EXPRESSION), separated by commas:
 *
 *     min max absmax    the least value, the largest, the largest absolute value
 *     mean rms          the mean and the root of the mean square over time, by the trapezoidal rule
 *     first last        the first value, the last
 *     peak              absmax, refined by the parabola through three steps
 *     at(WHAT(...))     the time of a value, for every WHAT but mean and rms
 *
 *     fvi_parse_reductions("max(drift),at(absmax(x2-x1))", NULL, c, &error);
 *
 * The expressions may contain the names of columns. Arguments and results as fvi_parse_columns, with the field
 * "reduce". */
int fvi_parse_reductions(const char *text, fvi_user_parameters *parameters,
                         fvi_typed_columns *columns, fvi_error *error);

/* fvi_typed_columns_wanted -- return what an observer must give for these columns and reductions: the sum of
 * some FVI_OBSERVE_... (observer.h).
 * fvi_typed_columns_count -- return the number of columns.
 * fvi_typed_column_name -- return the name of column i, from 0; it belongs to the columns.
 * fvi_typed_columns_values -- write the columns of one observation into row, fvi_typed_columns_count numbers. A number
 * that is not finite is no error. Returns FVI_SUCCESS, or what the ground returned.
 * fvi_reductions_count, fvi_reduction_name -- the same for reductions. */
unsigned fvi_typed_columns_wanted(const fvi_typed_columns *columns);
size_t fvi_typed_columns_count(const fvi_typed_columns *columns);
const char *fvi_typed_column_name(const fvi_typed_columns *columns, size_t i);
int fvi_typed_columns_values(fvi_typed_columns *columns,
                             const fvi_observation *now, double *row);
size_t fvi_reductions_count(const fvi_typed_columns *columns);
const char *fvi_reduction_name(const fvi_typed_columns *columns, size_t i);

/* fvi_reductions_add -- take one more step into all reductions. Call it after fvi_typed_columns_values of this step, in
 * the order of time, from t = 0 on; a step that is not later than the one before is left out. Returns FVI_SUCCESS;
 * FVI_EOVRFLW if a number is not finite.
 * fvi_reductions_values -- write the reductions of all steps so far: fvi_reductions_count numbers.
 * fvi_reductions_archive -- show an archive what the steps have changed, as fvi_stepper_archive (trajectory.h). Returns
 * FVI_SUCCESS, or what the archive returned. */
int fvi_reductions_add(fvi_typed_columns *columns, double t);
void fvi_reductions_values(const fvi_typed_columns *columns, double *values);
int fvi_reductions_archive(fvi_typed_columns *columns, fvi_archive *archive);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
