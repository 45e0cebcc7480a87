/* tests/bench/peers/ends.c -- Correct the ends of infinite sums: ends.h. [H 18] */
#include "ends.h"

#include <math.h>

void ends(double L, double nu, double *c)
{
    double B[ENDS][ENDS + 1];
    for (int n = 0; n < ENDS; n++) {
        for (int l = 0; l < ENDS; l++)
            B[n][l] = exp(L * APART * l * n);
        B[n][ENDS] = 1 / expm1(L * (nu + n));
    }
    for (int k = 0; k < ENDS; k++)
        for (int n = 0; n < ENDS; n++) {
            const double f = B[n][k] / B[k][k];
            for (int l = k; l <= ENDS && n != k; l++)
                B[n][l] -= f * B[k][l];
        }
    for (int l = 0; l < ENDS; l++)
        c[l] = B[l][ENDS] / B[l][l];
}
