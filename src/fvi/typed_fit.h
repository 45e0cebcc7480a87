/* src/fvi/typed_fit.h -- Parsers for the sensors and the parameters of a fit.                             [H 24] */
#ifndef FVI_TYPED_FIT_H
#define FVI_TYPED_FIT_H

#include "identification.h"
#include "parse.h"
#include "parse_words.h"
#include "records.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

enum { FVI_SENSOR_ROOM = 64 }; /* characters for the name of a sensor, with the terminating zero */

/* fvi_parse_sensor -- Parse the quantity that a sensor shows: "x2", "v1", or with a name "drift=x2-x1".
 *
 *   field       the field of the error
 *   d           number of coordinates
 *   parameters  names and values that the expression may use; kept, so they must outlive the expression. NULL: no
 *               parameters
 *   name        output, FVI_SENSOR_ROOM characters: the name, or the expression if it has no name
 *   shows       output, for fvi_measured.shows (records.h); free it with fvi_expression_free
 *
 *     char name[FVI_SENSOR_ROOM];
 *     fvi_expression *shows;
 *     status = fvi_parse_sensor("sensor", "drift=x2-x1", 2, NULL, name, &shows, &error);
 *
 * Returns as the parsers of parse.h. */
int fvi_parse_sensor(const char *field, const char *text, size_t d,
                     fvi_user_parameters *parameters, char name[FVI_SENSOR_ROOM],
                     fvi_expression **shows, fvi_error *error);

/* fvi_free_parameter_names -- the objects whose parameters can have a name. All pointers belong to the caller.
 *
 *   run         its system, law and dampers are read
 *   columns, column  number of measured columns, and their names; column NULL: one column without a name
 *   constants, constant  number of constants of the potential, and their names
 *   parameters  the parameters with which law, dampers and constraints were parsed; NULL if they were not parsed. A
 *               constant of the potential with the name of one of these parameters is this parameter
 *   has_ground  nonzero if a ground is part of the run's force */
typedef struct {
    const fvi_run *run;
    size_t columns;
    const char *const *column;
    size_t constants;
    const char *const *constant;
    const fvi_user_parameters *parameters;
    int has_ground;
} fvi_free_parameter_names;

/* fvi_parse_free_parameter -- Find the parameter with this name (records.h).
 *
 *     alpha  rho  mass  x0  p0          of all coordinates; x0_2 of the second coordinate, and so on
 *     offset  drift                     of all columns; offset.NAME of the column NAME
 *     d1.rho  d1.zener2.alpha           of run->law; NAME.rho of the damper NAME
 *     c  g  k                           constants of the potential
 *
 *   field  the field of the error
 *   which  output
 *
 * The function refuses a number that cannot change alone, because the run has already used it: masses of a system with
 * a Lagrangian, masses in the force of a ground, and masses, starts and constants in a constraint.
 *
 * Returns as the parsers of parse.h. */
int fvi_parse_free_parameter(const char *field, const char *text,
                             const fvi_free_parameter_names *names, fvi_free_parameter *which,
                             fvi_error *error);

/* fvi_free_parameters_of_laws -- Write the names of the first `most` numbers of the law and the dampers of a run to
 * text, with commas between them. These are the parameters of a fit for which the user names none.
 *
 *   size, text  room for `size` characters
 *
 * Returns text; or the constant text "alpha,rho" if there are no such numbers. */
const char *fvi_free_parameters_of_laws(const fvi_run *run, size_t most, size_t size, char *text);

/* fvi_check_force_of_fit -- Check a typed force as fvi_check_force does (parse.h), for the steps of a fit: in steps of
 * fit->h, or of the shortest time between two rows, if a whole number of these ends at the last row. The steps of a fit
 * are as long, or parts of such steps.
 *
 *   fit    the question, with its rows; its method is checked, and its run is not
 *   field, text, force  as fvi_check_force
 *
 * Returns as fvi_check_force. */
int fvi_check_force_of_fit(const fvi_estimation *fit, const char *field, const char *text,
                           const fvi_typed_force *force, fvi_error *error);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
