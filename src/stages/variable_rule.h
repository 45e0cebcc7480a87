/* src/stages/variable_rule.h -- The constants of steps of any length.  [H 22]
 *
 * With the s Lobatto nodes c, their weights B = diag(b) and the matrix D that
 * differentiates the polynomial through s values at them,
 *
 *     A^{-1} = D + e_1 e_1^T / b_1,    A 1 = c,    last row of A: b,        (17.3)
 *
 * everything that does not depend on the step nor on alpha is a constant, and made by
 * verify/variable_steps/variable_rule.py from its definition. */
#ifndef FVI_VARIABLE_RULE_H
#define FVI_VARIABLE_RULE_H

#include <stddef.h>

/* Stages are padded by zeros to LANES, the doubles of the widest vector. */
enum { FVI_LANES = 8, FVI_ENDS = 6 };

/* Four doubles side by side, at any address: a + b adds them one by one on every machine,
 * with one instruction where there is one. */
typedef double fvi_four __attribute__((vector_size(32), aligned(8), may_alias));

/* A matrix, column by column: entry (i, l) at column[l][i]. */
typedef struct {
    double column[FVI_LANES][FVI_LANES];
} fvi_square;

typedef struct {
    size_t s;
    double c[FVI_LANES], b[FVI_LANES];
    fvi_square A, inverse; /* A, and A^{-1} */
    /* X = x + c h v + h form_m delta in form M, A in its place in form D */
    fvi_square form_m;
    /* h a_n, a_n the Legendre coefficients of x'' in a step, from delta = h A x'' */
    fvi_square legendre;
    /* What the last of them does, (22.16): A P_{s-1} at the nodes, where the integral of
     * P_{s-1} is 0; the largest entry of A A P_{s-1}; and what stands for all beyond */
    double last[FVI_LANES], stage, alias;
    /* (mu + A^{-1})^{-1} e_1 / b_1: entry i is sum_n numerator[i][n] mu^n by
     * sum_n det[n] mu^n */
    double det[FVI_LANES + 1], numerator[FVI_LANES][FVI_LANES];
    /* The eigenvalues of A^{-1} in the upper half plane, and vectors v such that
     * v w^T, w_i = b_i v_{s-1-i}, are the projectors */
    double lambda_re[FVI_LANES / 2], lambda_im[FVI_LANES / 2];
    double log_modulus[FVI_LANES / 2], angle[FVI_LANES / 2];
    double re[FVI_LANES / 2][FVI_LANES], im[FVI_LANES / 2][FVI_LANES];
} fvi_variable_rule;

/* fvi_variable -- the rule of s stages, s = 6 or 8; NULL for another s. */
const fvi_variable_rule *fvi_variable(size_t s);

/* fvi_variable_powers -- the lambda^beta of the s/2 eigenvalues in the upper half plane.
 *   re, im  outputs, s/2 numbers each */
void fvi_variable_powers(const fvi_variable_rule *rule, double beta, double *re,
                         double *im);

/* fvi_variable_present -- W0 = (A^{-1})^beta: what h^beta D^beta does within a step of
 * length h, for any h.                                                       (22.2)
 *
 *     W0 = sum over the pairs of 2 Re(lambda^beta v w^T)
 *
 *   beta  -1 <= beta <= 1       W  output
 *
 * Accuracy: 4e-13 of the largest entry for s = 8 (no proof; seen 2e-13), 1e-14 for
 * s = 6. Cost O(s^3), 0.3 us. */
void fvi_variable_present(const fvi_variable_rule *rule, double beta,
                          fvi_square *W);

/* fvi_variable_function -- f(A^{-1}) by the s/2 values re + i im of f at the eigenvalues in
 * the upper half plane; accuracy and cost as above. */
void fvi_variable_function(const fvi_variable_rule *rule, const double *re,
                           const double *im, fvi_square *W);

/* fvi_variable_present_by_order -- d W0 / d beta = (A^{-1})^beta ln A^{-1}, for any beta in
 * [-1, 1]; accuracy and cost as above.                                        (23.18) */
void fvi_variable_present_by_order(const fvi_variable_rule *rule, double beta,
                               fvi_square *W);

/* fvi_variable_ends -- how a sum over all integers is had from one over those >= 0.
 *                                                                            (22.11)
 *     sum_{m>=1} f(-m) = sum_l c_l f(n l),   f(m) = r^{nu m} (1, r^m, ..., r^{5 m}),
 *
 * exactly, l = 0, ..., 5, r = exp(FVI_SPACING every), n = fvi_variable_apart(every).
 * fvi_variable_spread is the same with any six sums in the place of those of f.
 *
 *   every  1 or 2     nu  > 0     sum  FVI_ENDS numbers     c  output, as many */
void fvi_variable_ends(size_t every, double nu, double *c);
void fvi_variable_spread(size_t every, const double *sum, double *c);
size_t fvi_variable_apart(size_t every);

/* fvi_square_apply -- out = M in, both of FVI_LANES numbers, of which s are read; the rest
 * of out is zero where M has zeros there. */
void fvi_square_apply(size_t s, const fvi_square *M, const double *in,
                      double *out);

/* fvi_square_invert -- M becomes its inverse (Gauss and Jordan, with exchanges of rows).
 * Returns FVI_SUCCESS or FVI_ESING. Cost O(s^3), 0.15 us. */
int fvi_square_invert(size_t s, fvi_square *M);

/* fvi_variable_spacing -- steps and modes are powers of its exponential. */
double fvi_variable_spacing(void);

#endif
