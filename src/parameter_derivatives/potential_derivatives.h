/* src/parameter_derivatives/potential_derivatives.h -- Hess U and grad U by its parameters, stage by stage. [H 23]
 *
 * Internal: of all methods; those without stages have one, S_k. Stage i of coordinate j of the
 * positions stands at X[i * d + j]. */
#ifndef FVI_POTENTIAL_DERIVATIVES_H
#define FVI_POTENTIAL_DERIVATIVES_H

#include <fvi/sensitivity.h>

/* fvi_potential_evaluate_hessians -- Hess U of the stages X, as a potential writes it, `size`
 * numbers each, to G; nothing if size is 0. Returns what the Hessian does. */
int fvi_potential_evaluate_hessians(const fvi_system *system, size_t stages,
                                    const double *X, size_t size, double *G);

/* fvi_potential_accumulate_parameters -- the derivatives by the parameters of U, if they are
 * wanted: -h sum_i b_i d_theta grad U(X_i) . Lambda_i.                      (23.6)
 *
 *   b       NULL: 1 of one stage
 *   Lambda  that of coordinate j at stage i at [j * stride + i]
 *   column  room for d numbers
 *
 * Returns what the sensitivity does. */
int fvi_potential_accumulate_parameters(const fvi_sensitivities *want,
                                        const fvi_system *system, size_t stages,
                                        double h, const double *b, const double *X,
                                        const double *Lambda, size_t stride,
                                        double *column);

#endif
