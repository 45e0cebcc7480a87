/* src/fvi/damping_laws.h -- Damping by its symbol.                  [H 26]
 *
 *     m x'' + grad U(x) + rho C(D) x = F(t),     C(s) a sum of terms:
 *
 * a spring-pot, rho D^{2 alpha} x, is the symbol s^{2 alpha}; what polymers, rubber and
 * dampers are fitted by are sums of such, of fractions of such, or a whole range. Every
 * law here is causal, linear and passive, and a convolution quadrature of it is the
 * power series C(delta(z)/h): weights that stand where those of H 4 stood. */
#ifndef FVI_DAMPING_LAWS_H
#define FVI_DAMPING_LAWS_H

#include "convolution_quadrature.h"
#include "expression.h"
#include "memory.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/* The symbols of a term, but for its factor rho.                    [(26.1)]
 *
 *   POWER        s^{2 alpha}
 *   ZENER        s^{2 alpha} / (1 + time s^{2 alpha})
 *   MAXWELL      s / (1 + time s)
 *   DISTRIBUTED  int_alpha^end s^{2 a} da
 *   MAXWELL2     s^{2 alpha} / (1 + time s^{2 (alpha - end)}): two springpots in series,
 *                rho s^{2 alpha} and (rho / time) s^{2 end}. Where the two have names they are rho1 = rho,
 *                alpha1 = alpha, rho2 = rho / time and alpha2 = end. A ZENER has end = 0
 *   DAVIDSON     (s / (1 + time s))^{2 alpha}, Cole and Davidson's
 *   SYMBOL       any function of s: a term of this kind is the first member of a
 *                fvi_kernel_function, and stands alone in its law */
typedef enum {
    FVI_KERNEL_POWER,
    FVI_KERNEL_ZENER,
    FVI_KERNEL_MAXWELL,
    FVI_KERNEL_DISTRIBUTED,
    FVI_KERNEL_MAXWELL2,
    FVI_KERNEL_DAVIDSON,
    FVI_KERNEL_SYMBOL
} fvi_kernel_kind;

/* fvi_kernel_term -- one term; what its kind does not name is not read.
 *
 *   rho         finite, >= 0
 *   alpha       0 <= alpha <= 1
 *   time        finite, >= 0; with 0 a ZENER is a POWER, a MAXWELL a dashpot. Of a ZENER
 *               it is a time to the power 2 alpha, of a MAXWELL2 to 2 (alpha - end)
 *   end         alpha < end <= 1; of a MAXWELL2 0 <= end <= alpha */
typedef struct {
    fvi_kernel_kind kind;
    double rho, alpha, time, end;
} fvi_kernel_term;

/* fvi_kernel -- a sum of terms; they belong to the caller. */
typedef struct {
    size_t count;
    const fvi_kernel_term *term;
} fvi_kernel;

/* fvi_kernel_check -- is it a law?
 * Returns FVI_SUCCESS; FVI_EFAULT if law, or the terms of a law that has some, or the
 * function of a SYMBOL, is NULL; FVI_EINVAL for no terms, an unknown kind, and a SYMBOL that
 * is not alone; FVI_EDOM for a number out of range, and for a function that is
 * seen not to be as fvi_kernel_function asks. */
int fvi_kernel_check(const fvi_kernel *law);

/* fvi_kernel_function -- a law by a function of the caller's.
 *
 *     static void symbol(double re, double im, void *params, double *C_re, double *C_im);
 *     const fvi_kernel_function f = { { FVI_KERNEL_SYMBOL, 1, 0, 0, 0 }, symbol, &params };
 *     const fvi_kernel law = fvi_kernel_of_function(&f);
 *
 *   term    its rho is a factor; the other numbers are not read
 *   value   C(s) at s = re + i im, by the principal logarithm: im = 0 with re < 0 is the
 *           upper side of the cut. Analytic but for s <= 0, real for s > 0, finite at i omega,
 *           and growing no faster than s^2. A pole beside the cut is refused if |arg s| < 165 degrees there,
 *           10^-6 < |s| < 10^6, and if it is not a thousandth of C around it. Whether
 *           the law takes energy, with an imaginary part that is not negative at i omega, is not asked
 *   params  handed on to value
 *
 * Its weights come from Cauchy's integral, and its modes from the values on the cut if 512
 * weights say that they are all: a pole of C on the cut has none. */
typedef struct {
    fvi_kernel_term term;
    void (*value)(double re, double im, void *params, double *C_re,
                  double *C_im);
    void *params;
} fvi_kernel_function;

/* fvi_kernel_of_function -- the law that the function is; it belongs to the caller. */
fvi_kernel fvi_kernel_of_function(const fvi_kernel_function *function);

/* fvi_kernel_of_expression -- rho C(s), C an expression of the one variable "s", which must
 * outlive it. fvi_kernel_check refuses one with abs, which is not analytic. */
fvi_kernel_function fvi_kernel_of_expression(const fvi_expression *e,
                                             double rho);

/* fvi_kernel_moduli -- C(i omega): what an experiment at one frequency sees.  [(26.2)]
 *
 *   omega          finite, > 0
 *   storage, loss  outputs: Re C, a stiffness, and Im C >= 0; loss / storage is the
 *                  tangent of the loss angle, loss / omega the viscosity
 *
 * Accuracy: some units of roundoff of the sum of the moduli of the terms. Returns
 * FVI_SUCCESS; FVI_EFAULT, FVI_EINVAL, FVI_EDOM as fvi_kernel_check, and for omega;
 * FVI_EOVRFLW if a modulus is not finite. On error storage and loss are untouched. */
int fvi_kernel_moduli(const fvi_kernel *law, double omega, double *storage,
                   double *loss);

/* fvi_kernel_symbol -- C(s) of s > 0, where it is real. Of a law that has passed
 * fvi_kernel_check; nothing is checked. */
double fvi_kernel_symbol(const fvi_kernel *law, double s);

/* fvi_kernel_growth -- the largest nu with which |C(s)| grows like |s|^nu at infinity, but
 * for a logarithm: 2 alpha of a POWER, 0 of a MAXWELL, a ZENER or a DAVIDSON with a time, 2 end of
 * a DISTRIBUTED and of a MAXWELL2 with a time. The law has passed fvi_kernel_check. */
double fvi_kernel_growth(const fvi_kernel *law);

/* fvi_kernel_takes_caputo -- nonzero if no order of the law is above 1: Caputo's past is then
 * that of a body that was held. The law has passed fvi_kernel_check. */
int fvi_kernel_takes_caputo(const fvi_kernel *law);

/* fvi_kernel_weights -- w_n of sum_n w_n z^n = C(delta(z)/h).             [(26.3)]
 *
 *   law    as above
 *   kind   FVI_DELTA_EULER or FVI_DELTA_BDF2
 *   h      step, finite, > 0. It IS included here
 *   count  number of weights, count >= 1
 *   w      output, length count, owned by the caller
 *
 * Accuracy: relative to the largest weight, 60 u for each term (no proof; seen 3). Not so
 * for a ZENER with 2 alpha > 1, or a MAXWELL2 with 2 (alpha - end) > 1: it rings, and keeps roundings for as long as it does (seen
 * 1800 u in 1500 weights, alpha = 0.985).
 * Cost: O(count), and O(count^2) for a ZENER with alpha other than 1/2 and a MAXWELL2; a
 * DAVIDSON and a SYMBOL take 8 count values of their symbol and O(count ln count), and their
 * weights are right relative to the largest alone.
 * Returns FVI_SUCCESS; what fvi_kernel_check returns; FVI_EFAULT if w is NULL; FVI_EINVAL
 * if count == 0 or kind is another; FVI_EDOM for h; FVI_ENOMEM. On error w is
 * untouched. */
int fvi_kernel_weights(const fvi_kernel *law, fvi_delta kind, double h,
                    size_t count, double *w);

/* fvi_kernel_history -- the sums of a law as a memory (memory.h).          [(26.4)]
 *
 *     sum_{n=0}^{k} w_n x_{k-n} = *first H_k,     H_k as fvi_history_push gives it
 *
 *   law, kind, h   as fvi_kernel_weights
 *   d, steps       as fvi_history_alloc
 *   how            DIRECT, with all weights; EXPONENTIALS, the last 32 terms and one set
 *                  of decaying modes for all terms of the law; AUTO: DIRECT up to 256
 *                  steps and where there are no modes (26.6)
 *   tolerance      as fvi_history_alloc
 *   first          output, w_0: it is taken out, so that x_k stands in H_k with 1
 *   memory         output; free it with fvi_history_free
 *
 * As there, increments are summed where the law grows faster than s: *first is then
 * the factor of x_k - x_{k-1}.
 * Returns FVI_SUCCESS; what fvi_kernel_weights and fvi_history_alloc return; FVI_EUNSUP for
 * EXPONENTIALS where there are no modes. On error *first and *memory are untouched. */
int fvi_kernel_history(const fvi_kernel *law, fvi_delta kind, double h, size_t d,
                   size_t steps, fvi_history_kind how, double tolerance,
                   double *first, fvi_history **memory);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
