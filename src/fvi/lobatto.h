/* src/fvi/lobatto.h -- Variational integrators on Lobatto nodes.     [H 17] */
#ifndef FVI_LOBATTO_H
#define FVI_LOBATTO_H

#include "trajectory.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* fvi_lobatto_m2 to 8, form M -- Galerkin variational integrators on s = 2, ..., 8
 * Lobatto nodes, with Lobatto IIIC convolution quadrature for the damping. [(17.8)]
 *
 * The path of a step is a polynomial with the values X_1 = x_k, X_2, ..., X_s =
 * x_{k+1} at the nodes t_k + c_i h. With K = D^T B D, B = diag(b), and
 *
 *     S_i = h b_i (grad U(X_i) + rho Y_i - F(t_k + c_i h)),
 *     Y = h^(-beta) sum_{n=0}^{k} W_n (v_{k-n} - [beta > 0] p_0/m),
 *     v_k = D X / h,   beta = 2 alpha - 1,
 *
 * the step solves  p_k [i = 1] + (m/h) (K X)_i = S_i  for i = 1, ..., s - 1, and
 * then p_{k+1} = p_k - (S_1 + ... + S_s).
 *
 * Or the law of the run, (26.12), for rho Y, with the body held; see form D for its memory.
 * Any system in R^d, any alpha in [0, 1], any past: Y is Caputo's, what another past
 * adds to it is a force that is known beforehand (19.3) and acts by its exact
 * impulses (19.5). kappa is not used. F may jump at nodes t_k, not
 * inside a step: at stage 1 it is asked for t_k + 8u max(t_k, h), at stage s for
 * t_{k+1} - 8u t_{k+1}, u = 2^-53, which are on the right sides of any jump that
 * is within 4u t_k of the node.
 *
 * Order, measured, at a fixed t > 0 at which F does not jump, for beta != 0 and
 * |beta| < 1; over all t it is lower (19.9):
 *
 *     x: min(2s - 2, s + 2 - 2 alpha)      p: min(2s - 2, s + 1 - 2 alpha)
 *
 * (x as p for Riemann-Liouville with x0 != 0)
 * and 2s - 2 for alpha = 0, 1/2, 1 and for rho = 0; of a law with its fvi_kernel_growth for
 * 2 alpha. p_k is the momentum of the
 * scheme, uncorrected; see fvi_lobatto_correct_momenta. alpha = 0 is a spring rho from
 * x_0, alpha = 1 a mass: m + rho with F and U scaled by m / (m + rho). As alpha
 * goes to 1 the order of x goes to s and that of p to s - 1.
 * Stable for rho = 0 and U = m w^2 x^2 / 2 if h w < 2, 2 sqrt(2), 3.1127 for s = 2, 3, 4
 * (17.15); no friction is added: then the step is symplectic.
 * With damping: fvi_stability_lobatto (stability.h) says which steps are stable.
 *
 * Memory: DIRECT, EXPONENTIALS, or AUTO (DIRECT up to 64 steps).
 * run->tolerance t: the impulse of what compression leaves out, over the whole run,
 * is at most t m max|v| (v - v0 where beta > 0); the memory is asked for
 * t / max(1, T rho h^(-beta) / m), or with T^(-beta) where beta < 0, T = h steps, but
 * never for less than 1e-14; a t below that is refused (FVI_ETOL). (17.21)
 * rho = 0, alpha = 0, 1/2, 1: no history is kept.
 * Cost of a step: s - 1 gradients; s > 2 and nonlinear U: three or four times
 * s - 2 more, with Hessians, and the factors of an (s - 2) d matrix with s - 2 times
 * the diagonals of a Hessian (once a run for quadratic U); the history O(Q s) for each
 * damped coordinate, Q about 90. Errors as fvi_stepper_start and fvi_stepper_step. */
extern const fvi_method fvi_lobatto_m2, fvi_lobatto_m3, fvi_lobatto_m4;
extern const fvi_method fvi_lobatto_m5, fvi_lobatto_m6, fvi_lobatto_m7, fvi_lobatto_m8;

/* fvi_lobatto_d2 to 8d, form D -- the same with the inertia as one more damping, of order
 * 1, of the same kind: s stages V of the velocity, of which none is shared by two
 * steps,                                                           [(17.24), (17.25)]
 *
 *     m (DD V)_k + rho Y + grad U(X) = F at all s stages of step k,
 *     V = DD X,   Y = DD^beta (V - [beta > 0] p_0/m),   DD = Delta / h,
 *     x_{k+1} = X_s,   p_{k+1} = m V_s:
 *
 * or C(DD) (X - x_0) of a law (26.12), whatever its orders; nothing is subtracted there, as
 * the body was held. For EXPONENTIALS a law must have modes, which a fraction with 2 alpha
 * > 0.9 but for 1 has not (FVI_EUNSUP; AUTO sums its weights as they stand).
 *
 * Lobatto IIIC, with its own quadrature for the damping. Systems, pasts, forces, memory,
 * tolerance and errors as above, and FVI_ESING if the matrix of a step is singular.
 *
 * Order at a fixed t > 0 at which F does not jump: 2s - 2 in x and p for quadratic U and
 * polynomial F of degree < s between its jumps at nodes, whatever alpha; else
 *
 *     x: min(2s - 2, s + 4 - 2 alpha)      p: min(2s - 2, s + 3 - 2 alpha)   [(17.27)]
 *
 * (proved for quadratic U, measured else); over all t as low as above. That is for Caputo's
 * past, and held with alpha <= 1/2; held with alpha > 1/2 has s + 2 - 2 alpha at most (as a
 * law 2s - 2 for quadratic U, else 3 to 5 for p_0 != 0; measured), and Riemann-Liouville with alpha < 1/2, x0 != 0, s + 1 - 2 alpha (measured).
 * For quadratic convex U, 0 < alpha < 1, every step is stable; with F = 0, and
 * alpha <= 1/2 or p_0 = 0, p^2/2m + U is never above its start (17.26), (17.28). Without
 * damping it is not symplectic: it loses half the squares of the jumps of V.
 * Cost of a step: s gradients; nonlinear U: three or four times s, with Hessians, and
 * factors of an s d matrix with s times the diagonals of a Hessian; history as above.
 *
 * Form D takes matrices (structures.h), by their complex factors (27.14): s/2 of them, and one real where s
 * is odd, are made when the run starts, and a step solves once with each. A law that grows faster than s acts
 * on V - v_0 there, and what it makes of v_0 is added exactly (26.20), as with a mechanism. FVI_EUNSUP if
 * the matrices have no complex factors or no inertia. No adjoint. */
extern const fvi_method fvi_lobatto_d2, fvi_lobatto_d3, fvi_lobatto_d4,
    fvi_lobatto_d5, fvi_lobatto_d6, fvi_lobatto_d7, fvi_lobatto_d8;

/* fvi_lobatto_correct_momenta -- better momenta of a finished run.     [(17.14)]
 *
 *     p_k += rho c_{s,beta} h^(s - beta) x^(s)(t_k),    0 < k < N
 *
 * takes away the leading error of p_k, which is local. The derivative is a
 * central difference of x; rows without neighbours on both sides (one at each
 * end for s = 2, else two) are left as they are. Nothing is done for alpha = 0,
 * 1/2, 1, nor for s = 2 and alpha < 1/2, where the leading error is another one.
 * No order is gained for Riemann-Liouville with x0 != 0.
 *
 *   method  fvi_lobatto_m2, 3 or 4, no other
 *   run     as it was run
 *   x       (steps + 1) d positions, rows k = 0, ..., N
 *   p       as x: momenta, corrected in place
 *
 * Not across a jump of F. Cost O(N d). Returns FVI_SUCCESS; FVI_EFAULT if a
 * pointer is NULL; what fvi_system_check returns; FVI_EINVAL for another method
 * or no steps; FVI_EDOM if alpha is not in [0, 1], or h not finite and positive.
 * On error p is untouched. */
int fvi_lobatto_correct_momenta(const fvi_method *method, const fvi_run *run,
                        const double *x, double *p);

/* fvi_lobatto_within -- x within the last step, by the polynomial of its stages.            [(17.1)]
 *
 *   s  a stepper of a method with stages whose last step has just been made; reads, changes nothing
 *   t  t_{k-1} <= t <= t_k = s->t
 *   x  output, d numbers
 *
 *     while (s->t < t && !(status = fvi_stepper_step(s)))
 *         ;
 *     if (!status && s->k > 0)
 *         status = fvi_lobatto_within(s, t, x);
 *
 * It is the path that the method itself has: of degree s - 1 through X_1, ..., X_s. At t_k it is s->x to the
 * bit. Order: s at a fixed t > 0 where F does not jump, or what x_k has if that is less; in form D the path
 * begins at X_1, which differs from x_{k-1} by as much. With a
 * mechanism (dampers.h) or matrices (structures.h) as well. Cost O(s (s + d)), with matrices O(s^3 + s d).
 * Returns FVI_SUCCESS; FVI_EFAULT if a pointer is NULL; FVI_EUNSUP of another method; FVI_EDOM at k = 0, or if t is
 * not in the last step. */
int fvi_lobatto_within(const fvi_stepper *s, double t, double *x);

/* fvi_lobatto_momentum_within -- p within the last step: that of the velocity of this path, p = M x', or L_v.
 *
 *   s, t  as above
 *   p     output, d numbers
 *
 * Order: s - 1 at a fixed t > 0, one less than x. At t_k it is not s->p, which is of a higher order. Cost as above, s times
 * for each stage. Returns as above; FVI_ENOMEM; what a Lagrangian or a product with M returned. */
int fvi_lobatto_momentum_within(const fvi_stepper *s, double t, double *p);

/* fvi_lobatto_abscissa -- c_i, i = 0, ..., s - 1: stage i stands at t_k + c_i h; 0 where s is not 2 to 8,
 * or i is beyond. */
double fvi_lobatto_abscissa(size_t s, size_t i);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
