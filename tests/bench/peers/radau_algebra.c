/* tests/bench/peers/radau_algebra.c -- Small matrices in long double: radau_algebra.h.
 *                                                                       [H 18] */
#include "radau_algebra.h"

#include <string.h>

enum { S = RADAU_STAGES };

void radau_divide(int s, matrix B, int n, matrix x)
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

/* Compute eigenvalue number k of M by Durand and Kerner's iteration on the characteristic polynomial, whose
 * coefficients come from Faddeev and LeVerrier. */
static void roots(int s, matrix M, number *lambda)
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

void radau_projector(int s, matrix M, const number *lambda, int i, matrix P)
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

/* lambda = tr (M P) / tr P squares the error. */
static void refine(int s, matrix M, number *lambda)
{
    for (int round = 0; round < 3; round++)
        for (int i = 0; i < s; i++) {
            matrix P;
            number above = 0, below = 0;
            radau_projector(s, M, lambda, i, P);
            for (int k = 0; k < s; k++) {
                below += P[k][k];
                for (int l = 0; l < s; l++)
                    above += M[k][l] * P[l][k];
            }
            lambda[i] = above / below;
        }
}

void radau_eigenvalues(int s, matrix M, number *lambda)
{
    roots(s, M, lambda);
    refine(s, M, lambda);
}
