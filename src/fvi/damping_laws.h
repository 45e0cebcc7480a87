/* src/fvi/damping_laws.h -- Laws of damping: sums of powers, fractions and ranges, each by its symbol C(s).    [H 26]
 *
 *     m x'' + grad U(x) + rho C(D) x = F(t)
 *
 * A springpot, rho D^{2 alpha} x, has the symbol s^{2 alpha}. Polymers, rubber and dampers are described by sums of
 * such powers, by fractions of powers, or by an integral over a range of orders. Every law here is causal and linear.
 * All kinds except SYMBOL are also passive: they take energy and give none. In the equation rho is the damping of a
 * coordinate (system.h), and C is the sum of the terms. The weights of a law are the coefficients of the power
 * series of C(delta(z)/h) (convolution_quadrature.h). They take the place of the weights of the order 2 alpha
 * (coefficients.h).
 *
 *     const fvi_kernel_term terms[] = { { .kind = FVI_KERNEL_ZENER, .rho = 1, .alpha = 0.3, .time = 2 },
 *                                       { .kind = FVI_KERNEL_POWER, .rho = 0.1, .alpha = 0.5 } };
 *     const fvi_kernel law = { 2, terms };
 *     run.law = &law;   // C(s) = s^0.6/(1 + 2 s^0.6) + 0.1 s */
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

/* fvi_kernel_kind -- the symbol of a term, without its factor rho.                    [(26.1)]
 *
 *   POWER        s^{2 alpha}
 *   ZENER        s^{2 alpha} / (1 + time s^{2 alpha})
 *   MAXWELL      s / (1 + time s)
 *   DISTRIBUTED  int_alpha^end s^{2 a} da
 *   MAXWELL2     s^{2 alpha} / (1 + time s^{2 (alpha - end)}): two springpots in series, rho s^{2 alpha} and
 *                (rho / time) s^{2 end}. In texts the two have the names rho1 = rho, alpha1 = alpha, rho2 = rho / time
 *                and alpha2 = end. A ZENER is the case end = 0
 *   DAVIDSON     (s / (1 + time s))^{2 alpha}, of Cole and Davidson
 *   HAVRILIAK    s^{2 alpha} / (1 + time s^{2 alpha})^end, of Havriliak and Negami. A ZENER is the case end = 1
 *   SYMBOL       any function of s: the first member of a fvi_kernel_function. Such a term stands alone in its law */
typedef enum {
    FVI_KERNEL_POWER,
    FVI_KERNEL_ZENER,
    FVI_KERNEL_MAXWELL,
    FVI_KERNEL_DISTRIBUTED,
    FVI_KERNEL_MAXWELL2,
    FVI_KERNEL_DAVIDSON,
    FVI_KERNEL_SYMBOL,
    FVI_KERNEL_HAVRILIAK
} fvi_kernel_kind;

/* fvi_kernel_term -- one term of a law. A number that the symbol of its kind does not contain is not read.
 *
 *   rho         finite, >= 0
 *   alpha       0 <= alpha <= 1, and 2 alpha <= 1 for a HAVRILIAK
 *   time        finite, >= 0; with time = 0 a ZENER is a POWER, and a MAXWELL is a dashpot. The unit is that of a time
 *               to the power 2 alpha for ZENER and HAVRILIAK, to the power 2 (alpha - end) for a MAXWELL2, and of a
 *               time for MAXWELL and DAVIDSON
 *   end         alpha < end <= 1 for a DISTRIBUTED, 0 <= end <= alpha for a MAXWELL2, 0 < end <= 1 for a HAVRILIAK */
typedef struct {
    fvi_kernel_kind kind;
    double rho, alpha, time, end;
} fvi_kernel_term;

/* fvi_kernel -- a law: the sum of its terms. The terms belong to the caller. */
typedef struct {
    size_t count;
    const fvi_kernel_term *term;
} fvi_kernel;

/* fvi_formula -- one word with its numbers, as a user types it, and its formula.
 *
 *   form     "zener:R,A,T"
 *   formula  "R s^{2A}/(1 + T s^{2A})"; may contain '\n'
 *
 * fvi_law_formulas -- the words of all laws, in the order in which the parser knows them; the last form is NULL.
 * fvi_element_words -- the words alone, "spring" and so on, in the order of fvi_element (rheology.h), ended by NULL. A
 * SYMBOL is none of them. */
typedef struct {
    const char *form, *formula;
} fvi_formula;
extern const fvi_formula fvi_law_formulas[];
extern const char *const fvi_element_words[];

/* fvi_kernel_check -- check that the terms are a law of damping.
 *
 *     if (fvi_kernel_check(&law) != FVI_SUCCESS)
 *         puts("no law of damping");
 *
 * Returns FVI_SUCCESS; FVI_EFAULT if law is NULL, if the terms of a law that has some are NULL, or if the function of a
 * SYMBOL is NULL; FVI_EINVAL for no terms, an unknown kind, and a SYMBOL that is not alone; FVI_EDOM for a number out
 * of range, and for a SYMBOL in which the check finds a fault (fvi_kernel_function). Cost O(count), and for a SYMBOL
 * 3000 values of its function. */
int fvi_kernel_check(const fvi_kernel *law);

/* fvi_kernel_function -- a law by a function of the caller's.
 *
 *     void symbol(double re, double im, void *params, double *C_re, double *C_im);
 *     const fvi_kernel_function f = { { FVI_KERNEL_SYMBOL, 1, 0, 0, 0 }, symbol, &params };
 *     const fvi_kernel law = fvi_kernel_of_function(&f);
 *
 *   term    its kind is FVI_KERNEL_SYMBOL and its rho is a factor; the other numbers are not read
 *   value   writes C(s) at s = re + i im. Use the principal logarithm: im = 0 with re < 0 is the upper side of the cut.
 *           C must be analytic except for s <= 0, real for s > 0, finite at i omega, and must not grow faster than s^2
 *   params  handed to value, owned by the caller
 *
 * fvi_kernel_check looks for poles beside the cut with |arg s| < 165 degrees and 10^-6 < |s| < 10^6, and refuses the
 * law if it sees one. It does not see a pole that is weaker than a thousandth of C around it. It does not ask whether
 * the law is passive, that is, whether the imaginary part of C is not negative at i omega.
 *
 * The weights come from Cauchy's integral. The modes come from the values of C on the cut, and are used only if they
 * reproduce 512 weights. A law with a pole on the cut has no modes. */
typedef struct {
    fvi_kernel_term term;
    void (*value)(double re, double im, void *params, double *C_re,
                  double *C_im);
    void *params;
} fvi_kernel_function;

/* fvi_kernel_of_function -- return the law that consists of this function. It points to the function, which belongs to
 * the caller and must outlive the law. */
fvi_kernel fvi_kernel_of_function(const fvi_kernel_function *function);

/* fvi_kernel_of_expression -- return the law rho C(s), where C is an expression of the one variable "s".
 *
 *   e    the expression (expression.h); must outlive the law
 *   rho  the factor, finite, >= 0
 *
 *     const fvi_symbols names = { "s", 1, NULL, 0 };
 *     fvi_expression_parse("s^0.6/(1 + s^0.6)", &names, NULL, &e, NULL);
 *     const fvi_kernel_function f = fvi_kernel_of_expression(e, 0.2);
 *
 * fvi_kernel_check refuses an expression with abs, sign, min or max, because these are not analytic. */
fvi_kernel_function fvi_kernel_of_expression(const fvi_expression *e,
                                             double rho);

/* fvi_kernel_moduli -- compute C(i omega), the storage and the loss modulus that an experiment at one frequency
 * measures.                                                                  [(26.2)]
 *
 *   omega          the angular frequency, finite, > 0
 *   storage, loss  outputs, one number each: Re C, a stiffness, and Im C, >= 0 for a passive law. loss / storage is the
 *                  tangent of the loss angle, and loss / omega is the viscosity
 *
 *     double storage, loss;
 *     fvi_kernel_moduli(&dashpot, 10, &storage, &loss);   // a dashpot with rho = 2: 0 and 20, to rounding
 *
 * Accuracy: some units of roundoff of the sum of the moduli of the terms. Cost O(count).
 * Returns FVI_SUCCESS; what fvi_kernel_check returns; FVI_EFAULT if storage or loss is NULL; FVI_EDOM for omega;
 * FVI_EOVRFLW if a modulus is not finite. On error storage and loss are untouched. */
int fvi_kernel_moduli(const fvi_kernel *law, double omega, double *storage,
                   double *loss);

/* fvi_kernel_symbol -- return C(s) at s > 0, where it is real. The law must have passed fvi_kernel_check; nothing is
 * checked. */
double fvi_kernel_symbol(const fvi_kernel *law, double s);

/* fvi_kernel_growth -- return the largest nu for which |C(s)| grows like |s|^nu at infinity, up to a logarithm.
 *
 *   POWER        2 alpha
 *   DISTRIBUTED  2 end
 *   with time > 0: 0 for a ZENER, a MAXWELL or a DAVIDSON, 2 end for a MAXWELL2, 2 alpha (1 - end) for a HAVRILIAK
 *
 * A law "grows faster than s" if this number is above 1. The law must have passed fvi_kernel_check. */
double fvi_kernel_growth(const fvi_kernel *law);

/* fvi_kernel_takes_caputo -- return nonzero if no order of the law is above 1. The past CAPUTO is then the same as
 * HELD. The law must have passed fvi_kernel_check. */
int fvi_kernel_takes_caputo(const fvi_kernel *law);

/* fvi_kernel_weights -- compute the weights w_n of                                       [(26.3)]
 *
 *     sum_n w_n z^n = C(delta(z)/h),     n = 0, ..., count - 1.
 *
 *   law    see above
 *   kind   FVI_DELTA_EULER or FVI_DELTA_BDF2
 *   h      step, finite, > 0. It IS included here: the force is sum_n w_n x_{k-n}
 *   count  number of weights, count >= 1
 *   w      output, `count` numbers, owned by the caller
 *
 *     double w[3];
 *     fvi_kernel_weights(&dashpot, FVI_DELTA_EULER, 0.1, 3, w);   // a dashpot with rho = 1: 10, -10, 0
 *
 * Accuracy: relative to the largest weight, 60 u for each term, u = 2^-53 (no proof; seen 3 u). A ZENER with
 * 2 alpha > 1, and a MAXWELL2 with 2 (alpha - end) > 1, are worse: their weights oscillate, and rounding errors last as
 * long as the oscillation does (seen 1800 u in 1500 weights, alpha = 0.985).
 * Cost: O(count); O(count^2) for a ZENER with alpha other than 1/2, and for a MAXWELL2. A DAVIDSON, a HAVRILIAK and a
 * SYMBOL take about 8 count values of their symbol and O(count ln count). Only their large weights are right to many
 * digits, because the error is relative to the largest weight.
 * Returns FVI_SUCCESS; what fvi_kernel_check returns, but poles are not looked for; FVI_EFAULT if w is NULL; FVI_EINVAL
 * if count == 0 or kind is another; FVI_EDOM for h; FVI_ENOMEM. On error w is untouched, but of no use after
 * FVI_ENOMEM. */
int fvi_kernel_weights(const fvi_kernel *law, fvi_delta kind, double h,
                    size_t count, double *w);

/* fvi_kernel_history -- make a memory (memory.h) that sums up the past with the weights of a law.          [(26.4)]
 *
 *     sum_{n=0}^{k} w_n x_{k-n} = *first H_k,     H_k as fvi_history_push gives it
 *
 *   law, kind, h   as for fvi_kernel_weights
 *   d, steps       as for fvi_history_alloc
 *   how            FVI_HISTORY_DIRECT: with all weights. FVI_HISTORY_MODES: the last 32 terms as they are, and one set
 *                  of decaying modes for all terms of the law together. FVI_HISTORY_AUTO: DIRECT up to 256 steps, and
 *                  where there are no modes (26.6); else MODES
 *   tolerance      as for fvi_history_alloc
 *   first          output, w_0. The memory divides all weights by w_0, so that x_k stands in H_k with the factor 1
 *   memory         output; free it with fvi_history_free
 *
 * If the law grows faster than s, the memory sums up increments, and *first is the factor of x_k - x_{k-1}.
 *
 *     fvi_kernel_history(&law, FVI_DELTA_EULER, h, 1, 1000, FVI_HISTORY_AUTO, 0, &first, &memory);
 *     fvi_history_push(memory, &x, &dx, &H);
 *     force = first * H;
 *
 * Returns FVI_SUCCESS; what fvi_kernel_weights and fvi_history_alloc return; FVI_EUNSUP for MODES where there are no
 * modes. On error *first and *memory are untouched. */
int fvi_kernel_history(const fvi_kernel *law, fvi_delta kind, double h, size_t d,
                   size_t steps, fvi_history_kind how, double tolerance,
                   double *first, fvi_history **memory);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
