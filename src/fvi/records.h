/* src/fvi/records.h -- Records of measurements, and the parameters that a fit can find from them.          [H 24]
 *
 * A **record** is one test of a body: increasing times, and the values that each sensor showed at these times. A sensor
 * may show a coordinate, a velocity, or an expression of them, such as x2 - x1. Several records of one body may differ
 * in the start and in the force. */
#ifndef FVI_RECORDS_H
#define FVI_RECORDS_H

#include "expression.h"
#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

enum { FVI_MEASURED_MOST = 8 }; /* the largest number of columns of a record */

/* fvi_measured -- one column of a record: the values of one sensor. All pointers belong to the caller.
 *
 *   x      n numbers, finite
 *   sigma  standard deviation of each value, finite, in the unit of x; 0: unknown. It is known for all columns or for
 *          none
 *   shows  the quantity that the sensor shows: an expression of x1, ..., xd, v1, ..., vd, t, made by
 *          fvi_expression_parse_state with velocities; NULL: x of the first coordinate
 *
 *     fvi_expression *drift;
 *     const fvi_symbols names = { "x", 2, NULL, 0 };
 *     fvi_expression_parse_state("x2-x1", &names, 1, NULL, &drift, NULL);
 *     fvi_measured column = { x, 0.01, drift }; */
typedef struct {
    const double *x;
    double sigma;
    const fvi_expression *shows;
} fvi_measured;

/* fvi_record -- one test. All pointers belong to the caller.
 *
 *   n, t      number of times; the times: finite, increasing, t[0] >= 0, in any spacing
 *   measured  the columns; all records of a fit have the same number of columns, in the same order
 *   x0, p0    the start of this record, d numbers each; NULL: the start of the run
 *   force     the force of this record; NULL: the force of the system */
typedef struct {
    size_t n;
    const double *t;
    const fvi_measured *measured;
    const double *x0, *p0;
    const fvi_force *force;
} fvi_record;

/* fvi_free_parameter -- a parameter that a fit can find, or a run can be differentiated by.
 *
 *   ALPHA              run->alpha
 *   RHO, MASS, X0, P0  the rho, mass, initial position or initial momentum of all coordinates, with one common value
 *   OFFSET, DRIFT      the error of all sensors: a sensor shows offset + drift t more than the motion. Both are 0 where
 *                      they are not fitted
 *   LAW + 4 i + f      field f of term i of run->law: 0 rho, 1 alpha, 2 time, 3 end. For two springpots in series
 *                      (MAXWELL2) the fields 0, 1, 2, 3 are rho1, alpha1, rho2, alpha2
 *   CONSTANT + i       number i of the constants of the potential
 *   + i EACH           added to one of these, i from 1: coordinate i alone, column i alone, or the law of damper i
 *
 * For example, X0 + 2 EACH is the initial position of the second coordinate, and LAW + 1 + 3 EACH is alpha of the first
 * term of the third damper. If a record has its own start, the start is not fitted to this record. */
typedef enum {
    FVI_FREE_PARAMETER_ALPHA,
    FVI_FREE_PARAMETER_RHO,
    FVI_FREE_PARAMETER_MASS,
    FVI_FREE_PARAMETER_X0,
    FVI_FREE_PARAMETER_P0,
    FVI_FREE_PARAMETER_OFFSET,
    FVI_FREE_PARAMETER_DRIFT,
    FVI_FREE_PARAMETER_LAW,
    FVI_FREE_PARAMETER_CONSTANT = FVI_FREE_PARAMETER_LAW + 4 * 64,
    FVI_FREE_PARAMETER_EACH = 4096
} fvi_free_parameter;

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
