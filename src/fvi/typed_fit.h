/* src/fvi/typed_fit.h -- Sensors and parameters of a fit, as they are typed.   [H 24] */
#ifndef FVI_TYPED_FIT_H
#define FVI_TYPED_FIT_H

#include "parse_words.h"
#include "records.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

enum { FVI_SENSOR_ROOM = 64 }; /* for the name of a sensor, with its end */

/* fvi_parse_sensor -- what a column shows, as it is typed: "x2", "v1", or with a name "drift=x2-x1".
 *
 *   d           coordinates
 *   parameters  of the expression, kept; NULL if there are none
 *   name        output, FVI_SENSOR_ROOM letters: the name, or the expression itself
 *   shows       output; free it with fvi_expression_free
 *
 * As the parsers (parse.h), with the field given. */
int fvi_parse_sensor(const char *field, const char *text, size_t d,
                     fvi_user_parameters *parameters, char name[FVI_SENSOR_ROOM],
                     fvi_expression **shows, fvi_error *error);

/* fvi_free_parameter_names -- what the names of parameters speak of.
 *
 *   run        its system, law and dampers
 *   column     `columns` names of what is measured, or NULL for one column
 *   constant   `constants` names of the constants of the potential
 *   parameters  with which law, dampers and constraints were parsed; NULL if they were not. If a constant of the
 *               potential has the name of one of them, it is this one.
 *   has_ground  is a ground part of the run's force? */
typedef struct {
    const fvi_run *run;
    size_t columns;
    const char *const *column;
    size_t constants;
    const char *const *constant;
    const fvi_user_parameters *parameters;
    int has_ground;
} fvi_free_parameter_names;

/* fvi_parse_free_parameter -- which parameter has this name?
 *
 *     alpha  rho  mass  x0  p0          x0_2 of the second coordinate, and so on
 *     offset  drift                     offset.NAME of the column with this name
 *     d1.rho  d1.zener2.alpha           of run->law, or of the damper NAME: NAME.rho
 *     c  g  k                           of the constants
 *
 * Refused, too, is a number of which the run keeps what was made of it: the masses of a Lagrangian, masses that a
 * ground pulls, and masses, starts and constants that a constraint knows.
 *
 * As the parsers (parse.h); `field` is that of the error. */
int fvi_parse_free_parameter(const char *field, const char *text,
                             const fvi_free_parameter_names *names, fvi_free_parameter *which,
                             fvi_error *error);

/* fvi_free_parameters_of_laws -- the names of the first `most` numbers of the law and the dampers of
 * a run, with commas between, written to text, or "alpha,rho" where it has none: what a fit looks
 * for if nothing is said. */
const char *fvi_free_parameters_of_laws(const fvi_run *run, size_t most, size_t size, char *text);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
