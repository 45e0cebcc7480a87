/* src/fvi/expression.h -- Potentials and forces as they are typed.     [H 9]
 *
 *     const char *const k[] = { "k" };
 *     const fvi_symbols names = { "x", 1, k, 1 };
 *     double value = 3;
 *     fvi_expression *e;
 *     if (fvi_expression_parse("k*x^4/4 - x^2/2", &names, &value, &e, NULL) == 0)
 *         system.potential = fvi_potential_expression(e);
 *
 * An expression is made of numbers, names, + - * / ^ (or **) and parentheses, pi, and
 * the functions
 *
 *     sin cos tan sinh cosh tanh atan exp   everywhere
 *     asin acos                             on [-1, 1], with derivatives inside
 *     sqrt                                  on [0, inf), with derivatives for u > 0
 *     log                                   on (0, inf)
 *     abs sign                              everywhere; at 0 their derivatives are 0
 *     min(u, v) max(u, v)                   everywhere; where u = v their derivatives are the
 *                                           mean of those of u and v
 *
 * and NaN elsewhere. u^v with a constant whole v is for every u (u != 0 where v < 0),
 * else for u > 0. -x^2 is -(x^2), and 2^3^2 is 2^(3^2). Nothing may be left out: 2*x, not
 * 2x.
 *
 * Derivatives are exact: no differences, and no formula is rewritten. Each node of the
 * expression carries, with its value u, the derivatives u_i, u_j and u_ij by two of the
 * names, and a function f passes on
 *
 *     f(u),   f' u_i,   f' u_j,   f'' u_i u_j + f' u_ij,
 *
 * so what is lost are the roundings of these, as in the value. */
#ifndef FVI_EXPRESSION_H
#define FVI_EXPRESSION_H

#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

typedef struct fvi_expression fvi_expression;

/* fvi_symbols -- what an expression may speak of, besides pi and the functions.
 *
 *   variable    a letter or more, "x". The coordinates are x1, ..., x<d>; with d = 1
 *               also x alone
 *   d           how many, 0 if there are none; `variable` is then not read
 *   parameter   the names of the parameters: letters, digits, _, no digit in front */
typedef struct {
    const char *variable;
    size_t d;
    const char *const *parameter;
    size_t parameters;
} fvi_symbols;

/* fvi_misprint -- what is wrong with a text, and at which of its bytes, from 0. The
 * reason is a constant text. */
typedef struct {
    size_t at;
    const char *reason;
} fvi_misprint;

/* fvi_symbol_is_free -- nonzero if a parameter may have this name: it is made as fvi_symbols
 * says, and is no function, not pi, and no coordinate. */
int fvi_symbol_is_free(const char *name, const char *variable);

/* fvi_expression_parse -- understand a text.
 *
 *   text    as above; spaces do not matter
 *   names   not kept
 *   values  of the parameters, in the order of their names. Kept, not copied: they may
 *           change while no run goes on, and must outlive the expression
 *   e       output; free it with fvi_expression_free
 *   wrong   output if the text is refused; NULL if nobody asks
 *
 * Cost O(length) for one coordinate. For more, the sum is taken apart into its terms,
 * and a factor that is constant goes to each; which coordinates meet in a term says
 * where the Hessian is zero.
 * Returns FVI_SUCCESS; FVI_EFAULT if text, names or e is NULL; FVI_EINVAL if the text is
 * none that is understood, is nested 100 deep, or has a term of more than 1024 operations;
 * FVI_ENOMEM. On error *e is untouched. No call of the error handler: a misprint is the
 * user's. */
int fvi_expression_parse(const char *text, const fvi_symbols *names,
                         const double *values, fvi_expression **e,
                         fvi_misprint *wrong);

/* fvi_expression_parse_state -- the same of a text that also speaks of the time, and of velocities.
 *
 *   names       its d coordinates, as above
 *   velocities  nonzero: also v1, ..., v<d>, with d = 1 also v alone
 *
 * The expression is one of d + 1, or 2 d + 1, variables in one array: x1, ..., xd, then v1, ..., vd,
 * then t. A parameter of one of these names is not seen. */
int fvi_expression_parse_state(const char *text, const fvi_symbols *names,
                               int velocities, const double *values,
                               fvi_expression **e, fvi_misprint *wrong);

/* fvi_expression_gradient -- the derivatives by all n variables.
 *
 *   x  n numbers     grad  output, n numbers
 *
 * Nothing is checked. */
void fvi_expression_gradient(const fvi_expression *e, const double *x,
                             double *grad);

/* fvi_expression_add_hessian -- factor times the n * n second derivatives, added to H, row by row.
 * Nothing is checked. */
void fvi_expression_add_hessian(const fvi_expression *e, const double *x,
                                double factor, double *H);

/* fvi_expression_variables -- how many variables the expression is one of, n. */
size_t fvi_expression_variables(const fvi_expression *e);

/* fvi_name_finder -- which coordinate, from 0, has this name of so many letters? -1 if none, -2 if
 * there is no memory to find it. A point may stand in such a name, before a letter: d1.force. */
typedef struct {
    int (*find)(const char *name, size_t length, void *params);
    void *params;
} fvi_name_finder;

/* fvi_expression_parse_of -- the same of coordinates with names of any kind: of `names` the parameters
 * alone are read. fvi_expression_value then takes as many x as the finder has numbers. The other
 * functions here are not for such an expression. */
int fvi_expression_parse_of(const char *text, const fvi_name_finder *finder,
                            const fvi_symbols *names, const double *values,
                            fvi_expression **e, fvi_misprint *wrong);

/* fvi_expression_value -- at x, d numbers (not read if d = 0). NaN where it is not
 * defined. Nothing is checked. */
double fvi_expression_value(const fvi_expression *e, const double *x);

/* fvi_expression_parameter_gradient -- the derivative by parameter number j, from 0, of the value
 * and of the gradient.
 *
 *   value  output, dU/dk     grad  output, d numbers, d^2U/(dx_i dk); or NULL
 *
 * Nothing is checked. Cost: of a Hessian's row. */
void fvi_expression_parameter_gradient(const fvi_expression *e, size_t j,
                                 const double *x, double *value, double *grad);

/* fvi_expression_free -- give everything back. NULL is allowed. */
void fvi_expression_free(fvi_expression *e);

/* fvi_potential_expression -- U(x1, ..., xd), to be used in a system of the d of its
 * names; the expression must outlive the runs.
 *
 * quadratic is known where U is a polynomial as it stands. diagonals is 1 if each term has
 * one coordinate, 1 + the largest distance of two that meet in a term else: x1 x2 + x2 x3
 * has 2. Cost: of each term, (n + 1) n / 2 times its length for the Hessian if n
 * coordinates meet in it, n times for the gradient. Runs of 10^6 steps of one mass were
 * seen to take 1.4 to 2.8 times as long as by fvi_potential_duffing and
 * fvi_potential_pendulum: most with Euler's explicit method, which does nothing else.
 * Where U is not defined NaN is written: the step then fails with FVI_EOVRFLW. */
fvi_potential fvi_potential_expression(const fvi_expression *e);

/* fvi_force_expression -- F(t), of one variable, the same on every mass. */
fvi_force fvi_force_expression(const fvi_expression *e);

/* fvi_expression_complex_value -- of one variable, at re + i im, by principal branches; NaN
 * where abs, sign, min or max is asked for, which are not analytic. Nothing is checked. */
void fvi_expression_complex_value(const fvi_expression *e, double re, double im,
                                  double *value_re, double *value_im);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
