/* src/fvi/lobatto.h -- Methods of high order: variational integrators on Lobatto nodes, in two forms.     [H 17]
 *
 * A step has s stages, s = 2, ..., 8, at the times t_k + c_i h. Both forms use Lobatto IIIC convolution quadrature
 * for the damping. Form M is variational in the inertia: without damping it is symplectic. Form D treats the inertia
 * as one more damping: if U is quadratic and convex, every step is stable. */
#ifndef FVI_LOBATTO_H
#define FVI_LOBATTO_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_lobatto_m2 to fvi_lobatto_m8, form M -- Galerkin variational integrators on s = 2, ..., 8 Lobatto nodes.
 *                                                                                                    [(17.8)]
 *
 * The path of a step is a polynomial with the values X_1 = x_k, X_2, ..., X_s = x_{k+1} at the nodes t_k + c_i h.
 * With K = D^T B D, B = diag(b), and
 *
 *     S_i = h b_i (grad U(X_i) + rho Y_i - F(t_k + c_i h)),
 *     Y = h^(-beta) sum_{n=0}^{k} W_n (v_{k-n} - [beta > 0] p_0/m),
 *     v_k = D X / h,   beta = 2 alpha - 1,
 *
 * the step solves  p_k [i = 1] + (m/h) (K X)_i = S_i  for i = 1, ..., s - 1, and then computes
 * p_{k+1} = p_k - (S_1 + ... + S_s).
 *
 * What it takes. Any system in R^d, any alpha in [0, 1], any past. Y is the derivative for Caputo's past; every other
 * past adds a force that is known beforehand (19.3), and it acts by its exact impulses (19.5). kappa is not used. With
 * a law the sum (26.12) replaces rho Y, and the body was held before t = 0. F may jump at nodes t_k, but not inside a
 * step. So F is evaluated inside the step at its ends: at t_k + 8u max(t_k, h) for stage 1 and at t_{k+1} - 8u t_{k+1}
 * for stage s, u = 2^-53. These times are on the right sides of every jump within 4u t_k of the node.
 *
 * Limits of alpha. alpha = 0 is a spring rho from x_0. alpha = 1 is a mass: m + rho, with F and U scaled by
 * m / (m + rho).
 *
 * Order, measured, at a fixed t > 0 at which F does not jump, for beta != 0 and |beta| < 1:
 *
 *     x: min(2s - 2, s + 2 - 2 alpha)      p: min(2s - 2, s + 1 - 2 alpha)
 *
 * For Riemann-Liouville with x0 != 0, x has the order of p. For alpha = 0, 1/2, 1 and for rho = 0 both orders are
 * 2s - 2. For a law read its fvi_kernel_growth for 2 alpha. As alpha goes to 1, the order of x goes to s and the order
 * of p to s - 1. Over all t the orders are lower (19.9). For example, s = 4 and alpha = 0.3 give the orders 5.4 and
 * 4.4. p_k is the momentum of the scheme, uncorrected; see fvi_lobatto_correct_momenta.
 *
 * Stability. For rho = 0 and U = m w^2 x^2 / 2 a step is stable if h w < 2, 2 sqrt(2), 3.1127 for s = 2, 3, 4 (17.15),
 * and it is symplectic: the method adds no friction. With damping fvi_stability_lobatto (stability.h) says which steps
 * are stable.
 *
 * Memory. run->memory is FVI_HISTORY_DIRECT, FVI_HISTORY_MODES, or FVI_HISTORY_AUTO, which is DIRECT up to 64 steps.
 * For rho = 0 and for alpha = 0, 1/2, 1 no history is kept. With run->tolerance = t the weights that the modes replace
 * cause an impulse error of at most t m max|v| over the whole run (v - v0 for v where beta > 0). To reach this, the
 * history has the tolerance t / max(1, T rho h^(-beta) / m) with T = h steps (T^(-beta) for h^(-beta) where beta < 0),
 * but never less than 1e-14. A t below 1e-14 is refused (FVI_ETOL). (17.21) For a law see form D.
 *
 * Cost of a step. s - 1 gradients. If s > 2 and U is not quadratic: three or four times s - 2 gradients more, with
 * Hessians, and the factorisation of a matrix with (s - 2) d rows and s - 2 times the diagonals of a Hessian (for
 * quadratic U it is factorised once in the run). The history costs O(Q s) for each damped coordinate, Q about 90.
 *
 *     fvi_run run = fvi_run_default(&system, x0, p0, 0.1, 100);
 *     run.alpha = 0.3;
 *     status = fvi_stepper_start(&fvi_lobatto_m4, &run, &stepper, &error);
 *
 * Errors as fvi_stepper_start and fvi_stepper_step. */
extern const fvi_method fvi_lobatto_m2, fvi_lobatto_m3, fvi_lobatto_m4;
extern const fvi_method fvi_lobatto_m5, fvi_lobatto_m6, fvi_lobatto_m7, fvi_lobatto_m8;

/* fvi_lobatto_d2 to fvi_lobatto_d8, form D -- The same quadrature for the inertia, as one more damping of order 1.
 *                                                                                            [(17.24), (17.25)]
 *
 * A step has s stages V of the velocity, and two steps share none of them:
 *
 *     m (DD V)_k + rho Y + grad U(X) = F at all s stages of step k,
 *     V = DD X,   Y = DD^beta (V - [beta > 0] p_0/m),   DD = Delta / h,
 *     x_{k+1} = X_s,   p_{k+1} = m V_s.
 *
 * With a law, C(DD) (X - x_0) of (26.12) replaces rho Y, whatever its orders. Nothing is subtracted there, because the
 * body was held.
 *
 * What it takes. Systems, pasts and forces as form M; matrices (structures.h), too, with complex factors (27.14): s/2
 * of them, and one real factor where s is odd, are made when the run starts, and a step solves once with each. With
 * matrices a law that grows faster than s acts on V - v_0, and its answer to v_0 is added exactly (26.20), as with a
 * mechanism. fvi_adjoint (adjoint.h) takes such runs, too.
 *
 * Memory and tolerance as form M. A law has modes, and so takes FVI_HISTORY_MODES, unless it has a fraction with a pole
 * on its cut or near it: a FVI_KERNEL_ZENER with 2 alpha > 0.9 other than 1, or a FVI_KERNEL_MAXWELL2 with 2
 * (alpha - end) > 0.9 or 2 alpha > 1 > 2 end. FVI_HISTORY_AUTO sums the weights of such a law directly. A DAVIDSON, a
 * HAVRILIAK or a SYMBOL needs modes for its weights. So the start refuses it, with every kind of memory, if its values
 * on the cut do not give the weights; for example a DAVIDSON with 2 alpha = 0.96. With 2 alpha = 1 a DAVIDSON is a
 * Maxwell element, and is taken.
 *
 * Order at a fixed t > 0 at which F does not jump. If U is quadratic and F is a polynomial of degree < s between its
 * jumps at nodes, both orders are 2s - 2, whatever alpha. Otherwise they are
 *
 *     x: min(2s - 2, s + 4 - 2 alpha)      p: min(2s - 2, s + 3 - 2 alpha)                            [(17.27)]
 *
 * (proved for quadratic U, measured for other U). This holds for Caputo's past, and for a held body with alpha <= 1/2.
 * Measured for the other pasts: a held body with alpha > 1/2 has at most s + 2 - 2 alpha (as a law 2s - 2 for quadratic
 * U, and 3 to 5 for other U with p_0 != 0); Riemann-Liouville with alpha < 1/2 and x0 != 0 has s + 1 - 2 alpha. Over
 * all t the orders are as low as those of form M.
 *
 * Stability. For quadratic convex U and 0 < alpha < 1 every step is stable. If also F = 0, the past is Caputo's or
 * held, and alpha <= 1/2 or p_0 = 0, the energy p^2/2m + U is never above its initial value (17.26), (17.28). Without
 * damping the form is not symplectic: it loses half the squares of the jumps of V.
 *
 * Cost of a step. s gradients. If U is not quadratic: three or four times s gradients, with Hessians, and the
 * factorisation of a matrix with s d rows and s times the diagonals of a Hessian. History as form M.
 *
 * Errors as fvi_stepper_start and fvi_stepper_step. FVI_ESING if the matrix of a step is singular; FVI_EUNSUP for
 * FVI_HISTORY_MODES with a law that has no modes, for a law whose values on the cut do not give its weights, and for
 * matrices without complex factors or without a product with M (fvi_matrices.inertia). */
extern const fvi_method fvi_lobatto_d2, fvi_lobatto_d3, fvi_lobatto_d4,
    fvi_lobatto_d5, fvi_lobatto_d6, fvi_lobatto_d7, fvi_lobatto_d8;

/* fvi_lobatto_correct_momenta -- Correct the momenta of a finished run of form M.                       [(17.14)]
 *
 *     p_k += rho c_{s,beta} h^(s - beta) x^(s)(t_k),    0 < k < N
 *
 * This removes the leading error of p_k, which depends on the motion near t_k alone. The function takes the derivative
 * x^(s) from a central difference of x. So it leaves the rows without neighbours on both sides as they are: one row at
 * each end for s = 2, two rows at each end for s = 3 and 4. It changes nothing for alpha = 0, 1/2, 1, and nothing for
 * s = 2 with alpha < 1/2, where the leading error is another one. No order is gained for Riemann-Liouville with
 * x0 != 0, nor across a jump of F.
 *
 *   method  fvi_lobatto_m2, fvi_lobatto_m3 or fvi_lobatto_m4
 *   run     the run that made x and p; system, h, steps and alpha are read
 *   x       (steps + 1) d positions, rows k = 0, ..., N
 *   p       momenta in the same layout, corrected in place
 *
 *     if (every_row_is_stored)
 *         status = fvi_lobatto_correct_momenta(&fvi_lobatto_m4, &run, x, p);
 *
 * Cost O(N d). Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; what fvi_system_check returns; FVI_EINVAL for
 * another method or no steps; FVI_EDOM if alpha is not in [0, 1], or h not finite and positive; FVI_EUNSUP for a run
 * with a law: p is then untouched. FVI_EOVRFLW if a momentum is not finite: p then holds the corrected numbers. */
int fvi_lobatto_correct_momenta(const fvi_method *method, const fvi_run *run,
                        const double *x, double *p);

/* fvi_lobatto_within -- Compute x at a time within the last step, by the polynomial of its stages.       [(17.1)]
 *
 *   s  a stepper of a method with stages, after at least one step; it is not changed
 *   t  t_{k-1} <= t <= t_k = s->t
 *   x  output, d numbers
 *
 *     while (s->t < t && !(status = fvi_stepper_step(s)))
 *         ;
 *     if (!status && s->k > 0)
 *         status = fvi_lobatto_within(s, t, x);
 *
 * The polynomial is the path of the method itself: it has degree s - 1 and goes through X_1, ..., X_s. At t_k it gives
 * s->x to the bit. Its order is s at a fixed t > 0 where F does not jump, or the order of x_k if that is less. In
 * form D the path begins at X_1, which differs from x_{k-1} by an error of this order. The function also works for
 * systems with a mechanism (dampers.h) or with matrices (structures.h).
 * Cost O(s (s + d)), with matrices O(s^3 + s d).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EUNSUP for a method without stages; FVI_EDOM at k = 0, or
 * if t is not in the last step. No handler is called. */
int fvi_lobatto_within(const fvi_stepper *s, double t, double *x);

/* fvi_lobatto_momentum_within -- Compute p at a time within the last step, from the velocity x' of the same path:
 * p = M x', or p = L_v(x, x', t) with a Lagrangian.
 *
 *   s, t  as above
 *   p     output, d numbers
 *
 * Order: s - 1 at a fixed t > 0, one less than x. At t_k the result is not s->p, which has a higher order.
 * Cost O(s (s^2 + d)), with matrices O(s^4 + s d), and one product with M or one L_v.
 * Returns as fvi_lobatto_within; FVI_ENOMEM; what a Lagrangian or a product with M returned. */
int fvi_lobatto_momentum_within(const fvi_stepper *s, double t, double *p);

/* fvi_lobatto_abscissa -- Return c_i, i = 0, ..., s - 1: stage i stands at t_k + c_i h. The first is 0, the last 1.
 * Returns 0 if s is not in 2, ..., 8 or if i >= s. For example, fvi_lobatto_abscissa(3, 1) is 0.5. */
double fvi_lobatto_abscissa(size_t s, size_t i);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
