/* src/fvi/sensitivity.h -- How a potential, and a mechanism, depend on their parameters. [H 23] */
#ifndef FVI_SENSITIVITY_H
#define FVI_SENSITIVITY_H

#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_parameter_gradient -- the derivatives of grad U by numbers on which U depends.
 *
 *   count   how many such numbers theta_0, ..., theta_{count-1} there are
 *   column  writes the d numbers d^2U / dx_i dtheta_j at x to S, and returns as the
 *           functions of a potential do (system.h); it is handed the params of the
 *           potential. May be NULL if count is 0 */
typedef struct {
    size_t count;
    int (*column)(size_t j, size_t d, const double *x, void *params, double *S);
} fvi_parameter_gradient;

/* fvi_parameter_gradient_of -- that of a potential which is ready to use (system.h), its
 * parameters in the order of its params: c; c, g; g; c, g. A count of 0 for every other
 * potential, and for none. Nothing is checked. */
fvi_parameter_gradient fvi_parameter_gradient_of(const fvi_potential *potential);

/* fvi_mechanism_columns -- how forces of velocity, elongations and constraints depend on numbers theta_0, ...,
 * theta_{count-1}.
 *
 *   force       adds dF/dtheta_j at (x, v, t) to F, d numbers
 *   elongation  writes the derivatives by theta_j of g of damper e at (x, t), of its gradient, d numbers, and of
 *               its derivative by t, to g, G and gt
 *   constraint  writes those of c, of C and of c_t, as fvi_constraints has them
 *   params      handed to them, owned by the caller, may be NULL
 *
 * What the mechanism does not have may be NULL. They return as the functions of a potential do. */
typedef struct {
    size_t count;
    int (*force)(size_t j, double t, size_t d, const double *x, const double *v, void *params, double *F);
    int (*elongation)(size_t j, size_t e, double t, size_t d, const double *x, void *params, double *g,
                      double *G, double *gt);
    int (*constraint)(size_t j, double t, size_t d, const double *x, void *params, double *c, double *C,
                      double *ct);
    void *params;
} fvi_mechanism_columns;

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
