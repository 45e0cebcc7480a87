/* src/fvi/expression.h -- Potentials, forces and other functions from a typed text, with exact derivatives.     [H 9]
 *
 *     const char *const k[] = { "k" };
 *     const fvi_symbols names = { "x", 1, k, 1 };
 *     double value = 3;
 *     fvi_expression *e;
 *     if (fvi_expression_parse("k*x^4/4 - x^2/2", &names, &value, &e, NULL) == 0)
 *         system.potential = fvi_potential_expression(e);
 *
 * An expression consists of numbers, names, + - * / ^ (or **) and parentheses, pi, and the functions
 *
 *     sin cos tan sinh cosh tanh atan exp   everywhere
 *     asin acos                             on [-1, 1], with derivatives inside
 *     sqrt                                  on [0, inf), with derivatives for u > 0
 *     log                                   on (0, inf)
 *     abs sign                              everywhere; at 0 their derivatives are 0
 *     min(u, v) max(u, v)                   everywhere; where u = v their derivatives are the mean of those of u and v
 *
 * Elsewhere they are NaN. u^v with a constant whole v is defined for every u (for u != 0 if v < 0), and with any other
 * v for u > 0. -x^2 is -(x^2), and 2^3^2 is 2^(3^2). A product needs its *: 2*x, not 2x.
 *
 * Derivatives are exact: the library takes no differences and rewrites no formula. Each node of the expression carries
 * its value u and the derivatives u_i, u_j and u_ij by two of the variables, and a function f passes on
 *
 *     f(u),   f' u_i,   f' u_j,   f'' u_i u_j + f' u_ij,
 *
 * so a derivative has only the rounding errors of these operations, as the value has. */
#ifndef FVI_EXPRESSION_H
#define FVI_EXPRESSION_H

#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

typedef struct fvi_expression fvi_expression;

/* fvi_symbols -- the names that an expression may contain, besides pi and the functions.
 *
 *   variable    one letter or more, "x". The coordinates are x1, ..., x<d>; with d = 1 also x alone
 *   d           the number of coordinates; 0 if there are none, and then `variable` is not read
 *   parameter   the names of the parameters: letters, digits and _, and no digit in front
 *   parameters  the number of parameters */
typedef struct {
    const char *variable;
    size_t d;
    const char *const *parameter;
    size_t parameters;
} fvi_symbols;

/* fvi_misprint -- what is wrong with a text.
 *
 *   at      the wrong byte of the text, from 0
 *   reason  a static text */
typedef struct {
    size_t at;
    const char *reason;
} fvi_misprint;

/* fvi_symbol_is_free -- return nonzero if a parameter may have this name: it is made as fvi_symbols says, and is no
 * function, not pi, and no coordinate.
 *
 *   name      the name
 *   variable  as in fvi_symbols
 *
 *     fvi_symbol_is_free("k", "x");   // 1; but 0 for "x3", "sin" and "2k" */
int fvi_symbol_is_free(const char *name, const char *variable);

/* fvi_expression_parse -- read an expression from a text.
 *
 *   text    see above; spaces do not matter
 *   names   the names it may contain; not kept
 *   values  the values of the parameters, in the order of their names. They are kept, not copied: they may change while
 *           no run goes on, and must outlive the expression
 *   e       output; free it with fvi_expression_free
 *   wrong   output if the text is refused; may be NULL
 *
 * Cost O(length) for one coordinate. For more coordinates the function takes the sum apart into its terms, and
 * multiplies each term by a constant factor of the sum. So it knows which coordinates stand together in a term, and
 * where the Hessian is zero.
 * Returns FVI_SUCCESS; FVI_EFAULT if text, names, e or the name of a variable is NULL; FVI_EINVAL if the text is not an
 * expression, is nested 100 deep, or has a term of more than 1024 operations; FVI_ENOMEM. On error *e is untouched. For
 * FVI_EINVAL the error handler is not called, because a misprint is the user's. */
int fvi_expression_parse(const char *text, const fvi_symbols *names,
                         const double *values, fvi_expression **e,
                         fvi_misprint *wrong);

/* fvi_expression_parse_state -- read an expression that also depends on the time, and on velocities.
 *
 *   text, names, values, e, wrong  as for fvi_expression_parse
 *   velocities  nonzero: the text may contain v1, ..., v<d>, with d = 1 also v alone
 *
 *     fvi_expression_parse_state("-0.3*v*abs(v) + cos(t)", &names, 1, NULL, &e, NULL);
 *
 * The expression has d + 1 variables, or 2 d + 1 with velocities, in one array: x1, ..., xd, then v1, ..., vd, then t.
 * A parameter with one of these names cannot be reached. Returns as fvi_expression_parse. */
int fvi_expression_parse_state(const char *text, const fvi_symbols *names,
                               int velocities, const double *values,
                               fvi_expression **e, fvi_misprint *wrong);

/* fvi_expression_gradient -- compute the derivatives by all n variables.
 *
 *   x     n numbers
 *   grad  output, n numbers, not x
 *
 * Nothing is checked. Cost: for each term its length times the number of its variables. */
void fvi_expression_gradient(const fvi_expression *e, const double *x,
                             double *grad);

/* fvi_expression_add_hessian -- add factor times the n * n second derivatives to H, row by row. Nothing is checked.
 * Cost: for each term with m variables m (m + 1) / 2 times its length. */
void fvi_expression_add_hessian(const fvi_expression *e, const double *x,
                                double factor, double *H);

/* fvi_expression_variables -- return n, the number of variables of the expression. */
size_t fvi_expression_variables(const fvi_expression *e);

/* fvi_name_finder -- a function that knows the names of coordinates.
 *
 *   find    returns the number of the coordinate, from 0, whose name is the first `length` bytes of `name`; -1 if there
 *           is none; -2 if there is no memory. A name may contain a point before a letter, as d1.force
 *   params  handed to find, owned by the caller, may be NULL */
typedef struct {
    int (*find)(const char *name, size_t length, void *params);
    void *params;
} fvi_name_finder;

/* fvi_expression_parse_of -- read an expression of coordinates with any names.
 *
 *   text, values, e, wrong  as for fvi_expression_parse
 *   finder  knows the names of the coordinates; not kept
 *   names   only its parameters are read
 *
 * For such an expression call fvi_expression_value, with one x for each number that the finder may return, and
 * fvi_expression_free; the other functions here are not for it. Returns as fvi_expression_parse. */
int fvi_expression_parse_of(const char *text, const fvi_name_finder *finder,
                            const fvi_symbols *names, const double *values,
                            fvi_expression **e, fvi_misprint *wrong);

/* fvi_expression_value -- return the value at x; NaN where the expression is not defined.
 *
 *   x  one number for each variable; not read if there is none
 *
 *     const double x = 2;
 *     printf("%g\n", fvi_expression_value(e, &x));
 *
 * Nothing is checked. Cost O(length). */
double fvi_expression_value(const fvi_expression *e, const double *x);

/* fvi_expression_parameter_gradient -- compute the derivatives of the value and of the gradient by one parameter.
 *
 *   j      the number of the parameter, from 0
 *   x      d numbers
 *   value  output, one number: dU/dk_j
 *   grad   output, d numbers, d^2 U/(dx_i dk_j); or NULL
 *
 * Nothing is checked. Cost: that of one row of a Hessian. */
void fvi_expression_parameter_gradient(const fvi_expression *e, size_t j,
                                 const double *x, double *value, double *grad);

/* fvi_expression_free -- free an expression. NULL is allowed. */
void fvi_expression_free(fvi_expression *e);

/* fvi_potential_expression -- return the potential U(x1, ..., xd), for a system whose d is that of the names. The
 * expression must outlive all runs.
 *
 * `quadratic` of the potential is true if U is a polynomial of degree 2 or less as it is written. `diagonals` is 1 if
 * each term has one coordinate, else 1 + the largest distance of two coordinates in one term: 2 for x1*x2 + x2*x3.
 * Cost: a term with n coordinates takes n times its length for the gradient, and (n + 1) n / 2 times for the Hessian.
 * Runs of 10^6 steps of one mass took 1.4 to 2.8 times as long as with fvi_potential_duffing and
 * fvi_potential_pendulum, the most with Euler's explicit method, which does nothing else. Where U is not defined it is
 * NaN, and the step fails with FVI_EOVRFLW. */
fvi_potential fvi_potential_expression(const fvi_expression *e);

/* fvi_force_expression -- return the force F(t) of an expression of one variable, the same on every mass. The
 * expression must outlive all runs. */
fvi_force fvi_force_expression(const fvi_expression *e);

/* fvi_expression_complex_value -- compute the value of an expression of one variable at re + i im, by principal
 * branches. NaN if the expression contains abs, sign, min or max, which are not analytic.
 *
 *   value_re, value_im  outputs, one number each
 *
 * Nothing is checked. */
void fvi_expression_complex_value(const fvi_expression *e, double re, double im,
                                  double *value_re, double *value_im);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
