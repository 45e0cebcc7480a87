/* src/fvi/fvi.h -- The whole library, and fvi_fractional, its first integrator.           [H 9]
 *
 * This header includes all other headers, except those that only the paper needs (fvi/paper).
 *
 *     #include <fvi/fvi.h>
 *
 *     const double mass = 1, damping = 0.5, stiffness = 1, x0 = 1, p0 = 0;
 *     const fvi_system system = { .d = 1, .mass = &mass, .damping = &damping,
 *                                 .potential = fvi_potential_harmonic(&stiffness) };
 *     fvi_run run = fvi_run_default(&system, &x0, &p0, 0.1, 200);
 *     fvi_stepper *s;
 *     if (fvi_stepper_start(&fvi_fractional, &run, &s, NULL) == FVI_SUCCESS) {
 *         while (s->k < run.steps && fvi_stepper_step(s) == FVI_SUCCESS)
 *             printf("%g %g\n", s->t, s->x[0]);
 *         fvi_stepper_free(s);
 *     } */
#ifndef FVI_H
#define FVI_H

/* What moves, and what acts on it */
#include "system.h"
#include "expression.h"
#include "lagrangian.h"
#include "dampers.h"
#include "structures.h"

/* The memory: laws of damping, the past before t = 0, and the sums over the past */
#include "damping_laws.h"
#include "past.h"
#include "memory.h"
#include "coefficients.h"
#include "convolution_quadrature.h"

/* The motion: to a tolerance, or step by step, by one of these methods */
#include "solve.h"
#include "trajectory.h"
#include "archive.h"
#include "methods.h"
#include "discrete_mechanics.h"
#include "convolution_quadrature_methods.h"
#include "lobatto.h"
#include "variable_steps.h"
#include "batch.h"

/* What a run gives besides x and p */
#include "observer.h"
#include "events.h"
#include "warnings.h"

/* Derivatives, and what they serve for */
#include "adjoint.h"
#include "sensitivity.h"
#include "control.h"
#include "records.h"
#include "identification.h"
#include "rheology.h"

/* The longest stable step, and bounds of the error */
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

/* Error codes, and the version of the library */
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
 * in R^d with diagonal m and rho, any potential, any kappa and alpha in [0, 1]; or with matrices for m, rho and the
 * Hessian of U (structures.h). L_d is the discrete Lagrangian (discrete_mechanics.h), and Delta_-^alpha Delta_-^alpha
 * x_k is h^(-2 alpha) times the sum over the past with the weights of Grünwald and Letnikov of the order 2 alpha.
 * run->past says on what the memory acts (9.6).
 *
 * A step computes with momenta: this is the same equation, with smaller rounding errors. The step first solves
 * p_k = -D1 L_d(x_k, x_k + dx) for dx. Then it computes
 *
 *     x_{k+1} = x_k + dx,
 *     p_{k+1} = p_k - h grad U - h rho Delta_-^alpha Delta_-^alpha x_{k+1}
 *               + h F(t_{k+1}).
 *
 * p_k is the matched momentum of H 8 for every k <= N.
 *
 * Order 1. Exceptions: for a held body with alpha > 1/2 p has only the order 2 - 2 alpha near t = 0 (19.11). A run with
 * RIEMANN_LIOUVILLE and x0 != 0 has only the order 1 - 2 alpha if alpha < 1/2, and none if alpha > 1/2 (9.5). For
 * rho = 0, kappa = 1/2 and F(0) = 0 the order is 2 (9.8).
 * Stability: steps must be short enough (fvi_stability_longest_step). At alpha = 1 and rho > m no step is short
 * enough.
 * Cost of a step: that of fvi_stepper_step, and of fvi_history_push for the damped coordinates. A run with rho = 0
 * keeps no history. */
extern const fvi_method fvi_fractional;

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
