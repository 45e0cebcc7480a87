/* src/fvi/records.h -- What a laboratory records, and what may be asked of it.   [H 24]
 *
 * A **record** is one test of a body: increasing times, and what each sensor showed then. A sensor
 * may show a coordinate, a velocity, or an expression of them, such as x2 - x1. Several records of
 * one body may differ in the start and in the force. */
#ifndef FVI_RECORDS_H
#define FVI_RECORDS_H

#include "expression.h"
#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

enum { FVI_MEASURED_MOST = 8 }; /* columns of a record */

/* fvi_measured -- one column of a record: what one sensor showed.
 *
 *   x      n numbers, finite
 *   sigma  standard deviation of each, finite; 0: unknown. Known of all columns, or of none
 *   shows  what the sensor shows, an expression of x1, ..., xd, v1, ..., vd, t, as
 *          fvi_expression_parse_state makes it with velocities; NULL: x of the first coordinate
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

/* fvi_record -- one test.
 *
 *   n, t      n times, increasing, from t[0] >= 0 on, finite, in any spacing
 *   measured  as many columns as all records of a fit have, in the same order
 *   x0, p0    NULL: those of the run; else d numbers each, its own start
 *   force     NULL: that of the system; else its own */
typedef struct {
    size_t n;
    const double *t;
    const fvi_measured *measured;
    const double *x0, *p0;
    const fvi_force *force;
} fvi_record;

/* fvi_free_parameter -- what a fit may look for.
 *
 *   ALPHA          the order of run->alpha
 *   RHO, MASS, X0, P0  of each coordinate, all alike
 *   OFFSET, DRIFT  of each sensor, which shows offset + drift t more; 0 where not fitted
 *   LAW + 4 i + f  field f of term i of run->law: 0 rho, 1 alpha, 2 time, 3 end. Of two
 *                  springpots in series (MAXWELL2) the fields are the numbers rho1, alpha1, rho2,
 *                  alpha2 of the two, in the order 0, 1, 2, 3
 *   CONSTANT + i   number i of the constants of the potential
 *   + i EACH       of coordinate i alone, from 1; of column i alone; of the law of damper i
 *
 * For example, X0 + 2 EACH is the start of the second coordinate, and LAW + 1 + 3 EACH the order of
 * the first term of the third damper. A start that a record has of its own is not fitted. */
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
