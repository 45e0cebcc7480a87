/* tests/bench/peers/radau_tables.c -- The numbers of the Radau IIA methods. [H 18]
 *
 * The nodes are the zeros of P_s - P_{s-1} on [0, 1] (E. Hairer, G. Wanner, Solving Ordinary Differential
 * Equations II, IV.5). */
#include "radau_tables.h"

#include "radau_algebra.h"

#include <math.h>
#include <string.h>

enum { S = RADAU_STAGES };

/* Return P_s - P_{s-1} at 2x - 1, and its derivative by x. */
static long double polynomial(int s, long double x, long double *slope)
{
    const long double z = 2 * x - 1;
    long double p = 1, q = 0, dp = 0, dq = 0;
    for (int j = 1; j <= s; j++) {
        const long double r = ((2 * j - 1) * z * p - (j - 1) * q) / j,
                          dr = ((2 * j - 1) * (p + z * dp) - (j - 1) * dq) / j;
        q = p;
        p = r;
        dq = dp;
        dp = dr;
    }
    *slope = 2 * (dp - dq);
    return p - q;
}

/* Compute the zeros by Newton's method in Maehly's form, which divides out each zero that is found. */
static void nodes(int s, long double *c)
{
    c[s - 1] = 1;
    for (int i = s - 2; i >= 0; i--) {
        long double x = 0;
        for (int k = 0; k < 200; k++) {
            long double slope, f = polynomial(s, x, &slope), sum = 0;
            for (int j = i + 1; j < s; j++)
                sum += 1 / (x - c[j]);
            x -= f / (slope - f * sum);
        }
        c[i] = x;
    }
    for (int i = 0; i < s; i++) /* put the zeros in ascending order */
        for (int j = i + 1; j < s; j++)
            if (c[j] < c[i]) {
                long double t = c[i];
                c[i] = c[j];
                c[j] = t;
            }
}

static void projectors(radau *m, matrix M, const number *lambda)
{
    for (int i = 0; i < m->s; i++) {
        const int real = fabsl(cimagl(lambda[i])) < 1e-9L;
        const long double twice = real ? 1 : 2;
        matrix P;
        if (cimagl(lambda[i]) < 0 && !real)
            continue;
        radau_projector(m->s, M, lambda, i, P);
        m->re[m->pairs] = (double)creall(lambda[i]);
        m->im[m->pairs] = real ? 0 : (double)cimagl(lambda[i]);
        for (int k = 0; k < m->s; k++)
            for (int l = 0; l < m->s; l++) {
                const number z = twice * P[k][l];
                m->Pre[m->pairs][k][l] = (double)creall(z);
                m->Pim[m->pairs][k][l] = (double)cimagl(z);
                m->sumre[m->pairs][k] += m->Pre[m->pairs][k][l];
                m->sumim[m->pairs][k] += m->Pim[m->pairs][k][l];
            }
        m->pairs++;
    }
}

/* Compute the powers of the polynomials that vanish at 0: products of (z - c_k). */
static void powers(radau *m, const long double *c)
{
    for (int j = 0; j < m->s; j++) {
        long double p[S + 1] = { 0, 1 / c[j] };
        for (int k = 0; k < m->s; k++)
            for (int n = m->s; n >= 1 && k != j; n--)
                p[n] = (p[n - 1] - c[k] * p[n]) / (c[j] - c[k]);
        for (int n = 1; n <= m->s; n++)
            m->l[j][n] = (double)p[n];
    }
}

const radau *radau_method(int s)
{
    static radau all[S + 1];
    radau *m = &all[s];
    if (m->s)
        return m;
    long double c[S];
    matrix V = { { 0 } }, A = { { 0 } }, M = { { 0 } }, W;
    number lambda[S];
    nodes(s, c);
    /* A: x^k at the nodes becomes x^{k+1} / (k+1). Transposed, this is A^T as the solution of V^T. */
    for (int i = 0; i < s; i++)
        for (int k = 0; k < s; k++) {
            V[k][i] = powl(c[i], k);
            A[k][i] = powl(c[i], k + 1) / (k + 1);
        }
    memcpy(W, V, sizeof W);
    radau_divide(s, W, s,
                 A); /* column i of A is now row i of the method's matrix */
    for (int i = 0; i < s; i++) {
        for (int j = 0; j < s; j++) {
            W[i][j] = A[j][i];
            m->A[i][j] = (double)creall(A[j][i]);
        }
        M[i][i] = 1;
        m->c[i] = (double)c[i];
    }
    radau_divide(s, W, s, M);
    for (int i = 0; i < s; i++)
        for (int j = 0; j < s; j++)
            m->M[i][j] = (double)creall(M[i][j]);
    m->s = s;
    powers(m, c);
    radau_eigenvalues(s, M, lambda);
    projectors(m, M, lambda);
    return m;
}

void radau_power(const radau *m, double beta, double *W)
{
    const int s = m->s;
    for (int i = 0; i < s * s; i++)
        W[i] = 0;
    for (int k = 0; k < m->pairs; k++) {
        const double size = pow(hypot(m->re[k], m->im[k]), beta),
                     angle = beta * atan2(m->im[k], m->re[k]),
                     re = size * cos(angle), im = size * sin(angle);
        for (int i = 0; i < s; i++)
            for (int j = 0; j < s; j++)
                W[i * s + j] += re * m->Pre[k][i][j] - im * m->Pim[k][i][j];
    }
}

/* lambda / (mu + lambda) = 1 - mu / (mu + lambda): this form does not cancel. */
void radau_mode(const radau *m, double mu, int positive, double *a, double *g)
{
    const int s = m->s, few = mu < 5;
    double sum[RADAU_STAGES] = { 0 }, row[RADAU_STAGES] = { 0 };
    for (int k = 0; k < m->pairs; k++) {
        const double x = m->re[k] + mu, y = m->im[k], size = x * x + y * y,
                     re = few ? mu * x / size : (m->re[k] * x + y * y) / size,
                     im = (few ? -mu : mu) * y / size;
        const double *Pre = m->Pre[k][s - 1], *Pim = m->Pim[k][s - 1];
        for (int i = 0; i < s; i++) {
            sum[i] += re * m->sumre[k][i] - im * m->sumim[k][i];
            row[i] += re * Pre[i] - im * Pim[i];
        }
    }
    for (int i = 0; i < s; i++) {
        a[i] = few ? 1 - sum[i] : sum[i];
        g[i] = few == positive ? (i == s - 1) - row[i] : row[i];
    }
}
