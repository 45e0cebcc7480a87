/* src/fvi/fvi.h -- Fractional variational integrators.           [H 9]
 *
 * With it comes the rest of the library, but for what only the paper needs: that is in
 * fvi/paper. */
#ifndef FVI_H
#define FVI_H

/* What moves, and what acts on it */
#include "system.h"
#include "expression.h"
#include "lagrangian.h"
#include "dampers.h"
#include "structures.h"

/* Histories: kernels of damping, what was before t = 0, and the sums over the past */
#include "damping_laws.h"
#include "past.h"
#include "memory.h"
#include "coefficients.h"
#include "convolution_quadrature.h"

/* Its motion: to a tolerance, or step by step, by one of these methods */
#include "solve.h"
#include "trajectory.h"
#include "archive.h"
#include "methods.h"
#include "discrete_mechanics.h"
#include "convolution_quadrature_methods.h"
#include "lobatto.h"
#include "variable_steps.h"
#include "batch.h"

/* What a run tells besides x and p */
#include "observer.h"
#include "events.h"
#include "warnings.h"

/* Derivatives, and what they are for */
#include "adjoint.h"
#include "sensitivity.h"
#include "control.h"
#include "records.h"
#include "identification.h"
#include "rheology.h"

/* How long a step may be, and what the error is */
#include "stability.h"
#include "convolution_quadrature_stability.h"
#include "convergence.h"

/* Linear systems: exact motions, responses, poles */
#include "exact_solution.h"
#include "exact_motion.h"
#include "spring_bound.h"
#include "response.h"

/* Texts and files */
#include "formulas.h"
#include "parse.h"
#include "parse_words.h"
#include "columns.h"
#include "directory.h"
#include "typed_fit.h"
#include "format_double.h"

/* Codes, and which library this is */
#include "error.h"
#include "version.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_fractional -- Algorithm 3, the fractional variational integrator. [(9.4)]
 *
 *     D1 L_d(x_k, x_{k+1}) + D2 L_d(x_{k-1}, x_k)
 *         - h rho Delta_-^alpha Delta_-^alpha x_k + h F(t_k) = 0,
 *     p_0 = -D1 L_d(x_0, x_1),
 *
 * in R^d with diagonal m and rho, any potential, any kappa and alpha in [0, 1]; or with
 * matrices for m, rho and the Hessian of U (structures.h).
 * Done in momentum form, which is the same equation with less rounding:
 * p_k = -D1 L_d(x_k, x_k + dx) gives dx, then
 *
 *     x_{k+1} = x_k + dx,
 *     p_{k+1} = p_k - h grad U - h rho Delta_-^alpha Delta_-^alpha x_{k+1}
 *               + h F(t_{k+1}).
 *
 * p_k is the matched momentum of H 8 for every k <= N. Order 1; in p near
 * t = 0 only 2 - 2 alpha for a held body with alpha > 1/2 (19.11);
 * for Riemann-Liouville runs with x0 != 0 only 1 - 2 alpha if alpha < 1/2, and
 * none if alpha > 1/2 (9.5); order 2 for rho = 0, kappa = 1/2, F(0) = 0 (9.8).
 * run->past says on what the memory acts (9.6).
 * Steps must be short enough (fvi_stability_longest_step); at alpha = 1 and rho >= m none is.
 * Cost of a step: as fvi_stepper_step says, and fvi_history_push for the damped
 * coordinates. rho = 0 has no memory at all. */
extern const fvi_method fvi_fractional;

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
