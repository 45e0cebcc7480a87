/* src/stages/variable_rule.h -- The constants of the Lobatto rules for variable steps.  [H 22]
 *
 * Let c be the s Lobatto nodes, B = diag(b) their weights, and D the matrix that differentiates the polynomial through
 * s values at the nodes. Then
 *
 *     A^{-1} = D + e_1 e_1^T / b_1,    A 1 = c,    last row of A: b        (17.3)
 *
 * All numbers that depend neither on the step nor on alpha are constants. verify/variable_steps/variable_rule.py
 * computes them from their definitions. */
#ifndef FVI_VARIABLE_RULE_H
#define FVI_VARIABLE_RULE_H

#include <stddef.h>

/* Vectors of stages have FVI_LANES numbers, the doubles of the widest vector of the processor. The numbers behind the
 * s-th are zero. */
enum { FVI_LANES = 8, FVI_ENDS = 6 };

/* Four doubles side by side, at any address that suits a double. a + b adds them one by one on every machine, by one
 * instruction if the machine has one. */
typedef double fvi_four __attribute__((vector_size(32), aligned(8), may_alias));

/* A matrix, column by column: entry (i, l) at column[l][i]. */
typedef struct {
    double column[FVI_LANES][FVI_LANES];
} fvi_square;

typedef struct {
    size_t s;
    double c[FVI_LANES], b[FVI_LANES];
    fvi_square A, inverse; /* A and A^{-1} */
    /* X = x + c h v + h form_m delta in form M; in form D, A takes the place of form_m */
    fvi_square form_m;
    /* maps delta = h A x'' to h a_n, where a_n are the Legendre coefficients of x'' in a step */
    fvi_square legendre;
    /* the effect of the last coefficient, (22.16): A P_{s-1} at the nodes, where the integral of P_{s-1} is 0; the
     * largest entry of A A P_{s-1}; and a bound for all higher coefficients */
    double last[FVI_LANES], stage, alias;
    /* (mu + A^{-1})^{-1} e_1 / b_1: entry i is sum_n numerator[i][n] mu^n divided by sum_n det[n] mu^n */
    double det[FVI_LANES + 1], numerator[FVI_LANES][FVI_LANES];
    /* the eigenvalues of A^{-1} in the upper half plane, and vectors v such that v w^T with w_i = b_i
     * v_{s-1-i} are the projectors */
    double lambda_re[FVI_LANES / 2], lambda_im[FVI_LANES / 2];
    double log_modulus[FVI_LANES / 2], angle[FVI_LANES / 2];
    double re[FVI_LANES / 2][FVI_LANES], im[FVI_LANES / 2][FVI_LANES];
} fvi_variable_rule;

/* fvi_variable -- Return the rule of s stages, s = 6 or 8, or NULL for another s. */
const fvi_variable_rule *fvi_variable(size_t s);

/* fvi_variable_powers -- Compute lambda^beta of the s/2 eigenvalues in the upper half plane. re and im are outputs of
 * s/2 numbers each. */
void fvi_variable_powers(const fvi_variable_rule *rule, double beta, double *re,
                         double *im);

/* fvi_variable_present -- Compute W0 = (A^{-1})^beta, the matrix of h^beta D^beta within a step of any length h. (22.2)
 *
 *     W0 = sum over the pairs of 2 Re(lambda^beta v w^T)
 *
 *   beta  -1 <= beta <= 1
 *   W     output
 *
 * Accuracy: 4e-13 of the largest entry for s = 8 (no proof; seen 2e-13), 1e-14 for s = 6. Cost: O(s^3), 0.3 us. */
void fvi_variable_present(const fvi_variable_rule *rule, double beta,
                          fvi_square *W);

/* fvi_variable_function -- Compute f(A^{-1}) from the s/2 values re + i im of f at the eigenvalues in the upper half
 * plane. Accuracy and cost are those of fvi_variable_present. */
void fvi_variable_function(const fvi_variable_rule *rule, const double *re,
                           const double *im, fvi_square *W);

/* fvi_variable_present_by_order -- Compute dW0/dbeta = (A^{-1})^beta ln A^{-1} for beta in [-1, 1]. Accuracy and cost
 * are those of fvi_variable_present. (23.18) */
void fvi_variable_present_by_order(const fvi_variable_rule *rule, double beta,
                               fvi_square *W);

/* fvi_variable_ends -- Compute the coefficients c_l that replace the part of a sum below 0 by corrections at six
 * points. With r = exp(FVI_SPACING every) and n = fvi_variable_apart(every), (22.11)
 *
 *     sum_{m>=1} f(-m) = sum_l c_l f(n l),   f(m) = r^{nu m} (1, r^m, ..., r^{5 m}),   l = 0, ..., 5
 *
 * holds exactly.
 *
 * fvi_variable_spread -- Do the same with any six sums in place of the sums of f.
 * fvi_variable_apart -- Return the distance n between two points.
 *
 *   every  1 or 2
 *   nu     > 0
 *   sum    FVI_ENDS numbers
 *   c      output, FVI_ENDS numbers */
void fvi_variable_ends(size_t every, double nu, double *c);
void fvi_variable_spread(size_t every, const double *sum, double *c);
size_t fvi_variable_apart(size_t every);

/* fvi_square_apply -- Compute out = M in. Both vectors have FVI_LANES numbers; s numbers of `in` are read. The rest of
 * `out` is zero if M has zeros there. */
void fvi_square_apply(size_t s, const fvi_square *M, const double *in,
                      double *out);

/* fvi_square_invert -- Replace M by its inverse, by Gauss-Jordan elimination with row exchanges. Return FVI_SUCCESS or
 * FVI_ESING. Cost: O(s^3), 0.15 us. */
int fvi_square_invert(size_t s, fvi_square *M);

/* fvi_variable_spacing -- Return the spacing L. Step lengths and decay rates on the lattice are
 * integer powers of exp(L). */
double fvi_variable_spacing(void);

#endif
