/* src/fvi/sensitivity.h -- What is differentiated, and by what.                          [H 23]
 *
 * An objective J is a number made of a run. fvi_sensitivities has a place for each of its derivatives, and
 * names how potentials, Lagrangians and mechanisms depend on their parameters. */
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

/* fvi_objective -- J by its slopes.
 *
 *   slopes  is asked once for each k = N, N - 1, ..., 0, in this order, and adds
 *           dJ/dx_k to Jx, d zeros; for k = N it also adds dJ/dp_N to Jp, d zeros.
 *           x is x_k, and p is p_N for k = N; for the other k, p is NULL, and so is Jp but
 *           where all momenta are meant. Returns as the functions of a potential do (system.h)
 *   params  handed to it, owned by the caller, may be NULL
 *   has_momenta  nonzero: J depends on every p_k. slopes adds dJ/dp_k to Jp, d zeros, for each
 *           k. That costs a memory more */
typedef struct {
    int (*slopes)(size_t k, size_t d, const double *x, const double *p,
                  void *params, double *Jx, double *Jp);
    void *params;
    int has_momenta;
} fvi_objective;

/* fvi_lagrangian_column -- the derivatives of L_x and L_v by parameter j, from 0, at (x, v, t): added to
 * Sx and Sv, d zeros each. params are those of the Lagrangian. Returns as its functions do. */
typedef int fvi_lagrangian_column(size_t j, double t, size_t d, const double *x, const double *v,
                                  void *params, double *Sx, double *Sv);

/* fvi_sensitivities -- where the derivatives go; what is NULL is not wanted. Of a system with
 * matrices mass, damping and parameters are one number each: by a factor of M, of C and of
 * K, at 1; the sensitivity is not read.
 *
 *   x0, p0         by x0 and p0, d numbers each
 *   mass, damping  by each mass and each damping, d numbers each
 *   alpha          by alpha, one number, all dampings together; there is none of a law
 *   terms, orders, times, ends  by rho, alpha, time and end of each term of run->law,
 *                  law->count numbers each; 0 where its kind has no such number. Of several
 *                  dampers those of the terms of all their laws, one damper behind another
 *   force          by the force: component i at t_k at [k * d + i], (N + 1) d numbers;
 *                  of a method with s stages at all their times t_k + c_i h in one row,
 *                  ((s - 1) N + 1) d numbers. Where a step ends and the next begins,
 *                  both limits of F change together
 *   sensitivity    of the potential
 *   parameters     by its parameters, sensitivity.count numbers; NULL if count is 0
 *   lagrangian     of a mechanism with a Lagrangian, instead of sensitivity.column: see below
 *   names          by the numbers of its forces of velocity, elongations and constraints, columns->count
 *                  of them; NaN by one of a constraint that x0 or p0 would have to follow, and by one that would
 *                  stretch a damper of the past rl above the order 1 at x0: such runs have no solution */
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
