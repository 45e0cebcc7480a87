/* tests/bench/peers/radau_tables.c -- Numbers of the Radau IIA methods: the nodes are
 * the zeros of P_s - P_{s-1} on [0, 1] (E. Hairer, G. Wanner, Solving Ordinary
 * Differential Equations II, IV.5).                                     [Chapter 18] */
#include "radau_tables.h"

#include <complex.h>
#include <math.h>
#include <string.h>

enum { S = RADAU_STAGES };
typedef long double complex number;
typedef number matrix[S][S];

/* P_s - P_{s-1} at 2x - 1, and its slope by x. */
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

/* Zeros from the right, each divided out of the next: Maehly's way of Newton. */
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
    for (int i = 0; i < s; i++) /* they came from the left: put them in order */
        for (int j = i + 1; j < s; j++)
            if (c[j] < c[i]) {
                long double t = c[i];
                c[i] = c[j];
                c[j] = t;
            }
}

/* x = B^{-1} x for n columns, by Gauss's elimination with pivots; B is lost. */
static void solve(int s, matrix B, int n, matrix x)
{
    for (int k = 0; k < s; k++) {
        int best = k;
        for (int i = k; i < s; i++)
            if (cabsl(B[i][k]) > cabsl(B[best][k]))
                best = i;
        for (int j = 0; j < s; j++) {
            number t = B[k][j];
            B[k][j] = B[best][j];
            B[best][j] = t;
        }
        for (int j = 0; j < n; j++) {
            number t = x[k][j];
            x[k][j] = x[best][j];
            x[best][j] = t;
        }
        for (int i = 0; i < s; i++) {
            if (i == k)
                continue;
            const number f = B[i][k] / B[k][k];
            for (int j = k; j < s; j++)
                B[i][j] -= f * B[k][j];
            for (int j = 0; j < n; j++)
                x[i][j] -= f * x[k][j];
        }
    }
    for (int i = 0; i < s; i++)
        for (int j = 0; j < n; j++)
            x[i][j] /= B[i][i];
}

/* Eigenvalue number k of M: Durand and Kerner's iteration on the characteristic
 * polynomial, by Faddeev and LeVerrier. */
static void eigenvalues(int s, matrix M, number *lambda)
{
    matrix T = { { 0 } };
    number coefficient[S + 1] = { 0 };
    coefficient[s] = 1;
    for (int k = 1; k <= s; k++) {
        matrix N = { { 0 } };
        number trace = 0;
        for (int i = 0; i < s; i++)
            T[i][i] += coefficient[s - k + 1];
        for (int i = 0; i < s; i++)
            for (int j = 0; j < s; j++)
                for (int l = 0; l < s; l++)
                    N[i][j] += M[i][l] * T[l][j];
        for (int i = 0; i < s; i++)
            trace += N[i][i];
        coefficient[s - k] = -trace / k;
        memcpy(T, N, sizeof T);
    }
    for (int i = 0; i < s; i++)
        lambda[i] = s * cpowl(0.4L + 0.9L * I, i);
    for (int round = 0; round < 300; round++)
        for (int i = 0; i < s; i++) {
            number f = 1, g = 1;
            for (int k = s - 1; k >= 0; k--)
                f = f * lambda[i] + coefficient[k];
            for (int j = 0; j < s; j++)
                if (j != i)
                    g *= lambda[i] - lambda[j];
            lambda[i] -= f / g;
        }
}

/* P = prod over the other eigenvalues of (M - lambda_j) / (lambda_i - lambda_j). */
static void projector(int s, matrix M, const number *lambda, int i, matrix P)
{
    memset(P, 0, sizeof(matrix));
    for (int k = 0; k < s; k++)
        P[k][k] = 1;
    for (int j = 0; j < s; j++) {
        matrix N = { { 0 } };
        for (int k = 0; k < s && j != i; k++)
            for (int l = 0; l < s; l++)
                for (int n = 0; n < s; n++)
                    N[k][l] += P[k][n] * (M[n][l] - (n == l ? lambda[j] : 0))
                               / (lambda[i] - lambda[j]);
        if (j != i)
            memcpy(P, N, sizeof N);
    }
}

/* lambda = tr (M P) / tr P: the error is squared. */
static void refine(int s, matrix M, number *lambda)
{
    for (int round = 0; round < 3; round++)
        for (int i = 0; i < s; i++) {
            matrix P;
            number above = 0, below = 0;
            projector(s, M, lambda, i, P);
            for (int k = 0; k < s; k++) {
                below += P[k][k];
                for (int l = 0; l < s; l++)
                    above += M[k][l] * P[l][k];
            }
            lambda[i] = above / below;
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
        projector(m->s, M, lambda, i, P);
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

/* The powers of the polynomials that vanish at 0: products of (z - c_k). */
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
    /* A: x^k at the nodes goes to x^{k+1} / (k+1); transposed, A^T solves V^T. */
    for (int i = 0; i < s; i++)
        for (int k = 0; k < s; k++) {
            V[k][i] = powl(c[i], k);
            A[k][i] = powl(c[i], k + 1) / (k + 1);
        }
    memcpy(W, V, sizeof W);
    solve(s, W, s, A); /* column i of A is now row i of the method's matrix */
    for (int i = 0; i < s; i++) {
        for (int j = 0; j < s; j++) {
            W[i][j] = A[j][i];
            m->A[i][j] = (double)creall(A[j][i]);
        }
        M[i][i] = 1;
        m->c[i] = (double)c[i];
    }
    solve(s, W, s, M);
    for (int i = 0; i < s; i++)
        for (int j = 0; j < s; j++)
            m->M[i][j] = (double)creall(M[i][j]);
    m->s = s;
    powers(m, c);
    eigenvalues(s, M, lambda);
    refine(s, M, lambda);
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

/* lambda / (mu + lambda) = 1 - mu / (mu + lambda): the form that does not cancel. */
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
