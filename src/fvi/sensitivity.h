/* src/fvi/sensitivity.h -- The objective of a run, and the places for its derivatives.                   [H 23]
 *
 * An **objective** J is a number that depends on the rows of a run, for example x at the end. fvi_adjoint (adjoint.h)
 * computes its derivatives. fvi_sensitivities has a place for each derivative. The other structs tell how a potential,
 * a Lagrangian and a mechanism depend on their parameters. */
#ifndef FVI_SENSITIVITY_H
#define FVI_SENSITIVITY_H

#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_parameter_gradient -- the derivatives of grad U by the parameters of U.
 *
 *   count   number of parameters theta_0, ..., theta_{count-1}
 *   column  writes the d numbers d^2U / dx_i dtheta_j at x to S. It gets the params of the potential, and returns as
 *           the functions of a potential do (system.h). May be NULL if count is 0
 *
 * For example, U = c x^2 / 2 with theta_0 = c has the column S = x. */
typedef struct {
    size_t count;
    int (*column)(size_t j, size_t d, const double *x, void *params, double *S);
} fvi_parameter_gradient;

/* fvi_parameter_gradient_of -- Return the parameter gradient of a ready-made potential (system.h). Its parameters are
 * in the order of the params: c (harmonic), c and g (Duffing), g (pendulum), c and g (chain). Return a count of 0 for
 * every other potential, and for a zeroed one. Nothing is checked. */
fvi_parameter_gradient fvi_parameter_gradient_of(const fvi_potential *potential);

/* fvi_mechanism_columns -- the derivatives of a mechanism's forces, elongations and constraints by its parameters
 * theta_0, ..., theta_{count-1}.
 *
 *   force       adds dF/dtheta_j of the forces that depend on velocity (fvi_state_force) at (x, v, t) to F, d numbers
 *   elongation  writes, for damper e at (x, t), the derivative by theta_j of g to *g, of its gradient to the d numbers
 *               G, and of its derivative by t to *gt
 *   constraint  writes the derivatives by theta_j of c, C and c_t, in the layout of fvi_constraints (lagrangian.h)
 *   params      handed to the functions, owned by the caller, may be NULL
 *
 * The function of a part that the mechanism does not have may be NULL. The functions return as those of a potential
 * do. */
typedef struct {
    size_t count;
    int (*force)(size_t j, double t, size_t d, const double *x, const double *v, void *params, double *F);
    int (*elongation)(size_t j, size_t e, double t, size_t d, const double *x, void *params, double *g,
                      double *G, double *gt);
    int (*constraint)(size_t j, double t, size_t d, const double *x, void *params, double *c, double *C,
                      double *ct);
    void *params;
} fvi_mechanism_columns;

/* fvi_objective -- an objective, given by its derivatives.
 *
 *   slopes  is called once for each k = N, N - 1, ..., 0, in this order. It adds dJ/dx_k to the d zeros Jx. For k = N
 *           it also adds dJ/dp_N to the d zeros Jp. x is x_k. p is p_N for k = N, and NULL for all other k. Jp is NULL
 *           for k < N, unless has_momenta is set. Returns as the functions of a potential do (system.h)
 *   params  handed to slopes, owned by the caller, may be NULL
 *   has_momenta  nonzero: J depends on every p_k, and slopes adds dJ/dp_k to the d zeros Jp for each k. This needs one
 *           more history
 *
 * For example, J = x_N of a system with d = 1 has slopes that add 1 to Jx[0] for k = N and nothing for all other k. */
typedef struct {
    int (*slopes)(size_t k, size_t d, const double *x, const double *p,
                  void *params, double *Jx, double *Jp);
    void *params;
    int has_momenta;
} fvi_objective;

/* fvi_lagrangian_column -- a function that adds the derivatives of L_x and L_v by parameter j, from 0, at (x, v, t) to
 * Sx and Sv, d zeros each. It gets the params of the Lagrangian, and returns as the functions of a potential do. */
typedef int fvi_lagrangian_column(size_t j, double t, size_t d, const double *x, const double *v,
                                  void *params, double *Sx, double *Sv);

/* fvi_sensitivities -- the places for the derivatives of an objective. The arrays belong to the caller. A derivative is
 * not computed if its array is NULL.
 *
 * Outputs:
 *
 *   x0, p0         derivatives by x0 and p0, d numbers each
 *   mass, damping  derivatives by each mass and each damping, d numbers each. For a system with matrices one number
 *                  each: the derivative by a factor of M, and of C, at the value 1 of the factor
 *   alpha          derivative by alpha, one number for all dampings together; not for a run with a law
 *   terms, orders, times, ends  derivatives by rho, alpha, time and end of each term of run->law, law->count numbers
 *                  each; 0 if the kind of the term has no such number. For several dampers: of the terms of all laws,
 *                  one damper after another
 *   force          derivatives by the force, component i at t_k at [k * d + i], (N + 1) d numbers. For a method with s
 *                  stages: at all times t_k + c_i h in one row, ((s - 1) N + 1) d numbers; at the end of a step both
 *                  limits of F change together
 *   parameters     derivatives by the parameters of the potential or of the Lagrangian, sensitivity.count numbers. So
 *                  with a zeroed `sensitivity` nothing is written. For a system with matrices one number: the
 *                  derivative by a factor of K at 1
 *   names          derivatives by the parameters of the mechanism's forces, elongations and constraints, columns->count
 *                  numbers. NaN in two cases, because the changed run has no solution: the parameter changes a
 *                  constraint, and x0 or p0 would have to follow; or it stretches a damper with the past
 *                  RIEMANN_LIOUVILLE and an order above 1 at x0
 *
 * Inputs:
 *
 *   sensitivity    how the potential depends on its parameters, for a ready-made potential
 *                  fvi_parameter_gradient_of(&system.potential); not read for a system with matrices
 *   lagrangian     how a Lagrangian depends on its parameters; it replaces sensitivity.column
 *   columns        how the rest of the mechanism depends on its parameters */
typedef struct {
    double *x0, *p0, *mass, *damping, *alpha, *terms, *orders, *times, *ends,
        *force, *parameters;
    fvi_parameter_gradient sensitivity;
    fvi_lagrangian_column *lagrangian;
    double *names;
    const fvi_mechanism_columns *columns;
} fvi_sensitivities;

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
