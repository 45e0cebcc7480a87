/* tests/bench/peers/radau_tables.h -- Numbers of the Radau IIA methods. [H 18] */
#ifndef RADAU_TABLES_H
#define RADAU_TABLES_H

enum { RADAU_STAGES = 7 };

/* Write it before a loop that contains another loop: clang vectorises innermost loops only, and warns. */
#ifdef __clang__
#define OUTER_SIMD
#else
#define OUTER_SIMD _Pragma("omp simd")
#endif

/* radau -- the method with s stages.
 *
 *   c, A    nodes, and the matrix of the method, A[i][j]
 *   M       its inverse
 *   l       l[j][n], n = 1 ... s: the powers of the polynomial that is 1 at c_j, 0 at the
 *           other nodes and 0 at 0
 *   pairs   how many eigenvalues M has in the upper half plane, real ones included
 *   re, im  those eigenvalues
 *   Pre, Pim  their projectors, doubled where there is a conjugate:
 *           f(M) = sum over them of Re(f(lambda) P)
 *   sumre, sumim  the sums of their rows */
typedef struct {
    int s, pairs;
    double c[RADAU_STAGES], A[RADAU_STAGES][RADAU_STAGES],
        M[RADAU_STAGES][RADAU_STAGES], l[RADAU_STAGES][RADAU_STAGES + 1];
    double re[RADAU_STAGES], im[RADAU_STAGES];
    double Pre[RADAU_STAGES][RADAU_STAGES][RADAU_STAGES],
        Pim[RADAU_STAGES][RADAU_STAGES][RADAU_STAGES],
        sumre[RADAU_STAGES][RADAU_STAGES], sumim[RADAU_STAGES][RADAU_STAGES];
} radau;

/* radau_method -- return the method with s stages, 1 <= s <= RADAU_STAGES, which is made at the first call.
 * NULL if GSL has no memory. */
const radau *radau_method(int s);

/* radau_power -- compute f(M) for f = z^beta into W (row by row, s * s). */
void radau_power(const radau *m, double beta, double *W);

/* radau_mode -- compute the numbers of w' = -sigma w + input over one step, mu = h sigma > 0.
 *
 *   a  s numbers  (mu + M)^{-1} M 1; the last is the stability function
 *   g  s numbers  e_s^T (mu + M)^{-1} M if positive (the input is a derivative)
 *                 mu e_s^T (mu + M)^{-1} if not (it is multiplied by sigma) */
void radau_mode(const radau *m, double mu, int positive, double *a, double *g);

#endif
