/* src/parameter_derivatives/potential_derivatives.h -- Hess U at the stages, and the derivatives by the parameters of
 * U. [H 23]
 *
 * Internal, for all methods. A method without stages has one stage, S_k. The position of coordinate j at stage i stands
 * at X[i * d + j]. */
#ifndef FVI_POTENTIAL_DERIVATIVES_H
#define FVI_POTENTIAL_DERIVATIVES_H

#include <fvi/sensitivity.h>

/* fvi_potential_evaluate_hessians -- write Hess U at the stages X to G, in the form of the potential, `size` numbers
 * each; nothing if size is 0. Returns what the Hessian returns. */
int fvi_potential_evaluate_hessians(const fvi_system *system, size_t stages,
                                    const double *X, size_t size, double *G);

/* fvi_potential_accumulate_parameters -- add the derivatives of J by the parameters of U, if they are wanted: -h sum_i
 * b_i d_theta grad U(X_i) . Lambda_i. (23.6)
 *
 *   b       the weights of the stages; NULL: one stage with the weight 1
 *   Lambda  the multiplier of coordinate j at stage i stands at [j * stride + i]
 *   column  room for d numbers
 *
 * Returns what the sensitivity returns. */
int fvi_potential_accumulate_parameters(const fvi_sensitivities *want,
                                        const fvi_system *system, size_t stages,
                                        double h, const double *b, const double *X,
                                        const double *Lambda, size_t stride,
                                        double *column);

#endif
