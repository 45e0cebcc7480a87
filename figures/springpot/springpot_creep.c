/* figures/springpot/springpot_creep.c -- H 0: ladders creep, and are let go.
 *
 * Blocks 0, 1, 2: beta = 1/4, 1/2, 3/4; t, the creep x of the ladder under a force 1, that
 * of its springpot (0.2). Blocks 3 to 6: a force 1 from t = 0 to 1 on a ladder of order 1/2
 * whose time eta / k is 1/1000, rho = 1: t, x; then that of its springpot, of a spring
 * and of a dashpot with the constant 1. */
#include "ladder.h"

#include <stdio.h>

static void creep(double beta)
{
    const double rho = ladder_rho(beta, 1, 1);
    ladder l = ladder_of_order(beta, 1, 1);
    double t = 0, h = 1.0 / 1024, next = 0.1;
    while (t < 3e3) {
        for (int n = 0; n < 80; n++) {
            ladder_step(&l, h, 1);
            t += h;
            if (t >= next) {
                printf("%.9g %.9g %.9g\n", t, l.x[0],
                       pow(t, beta) / tgamma(1 + beta) / rho);
                next *= 1.5;
            }
        }
        h *= 2;
    }
    printf("\n\n");
}

/* The power t^order, from when the force comes, less that from when it goes. */
static double lent(double t, double order)
{
    const double up = t > 0 ? pow(t, order) : 0,
                 down = t > 1 ? pow(t - 1, order) : 0;
    return (up - down) / tgamma(1 + order);
}

int main(void)
{
    const double orders[] = { 0.5, 0, 1 };
    printf("# t, ladder, springpot\n");
    creep(0.25);
    creep(0.5);
    creep(0.75);
    ladder l = ladder_of_order(0.5, sqrt(1000), sqrt(1000) / 1000);
    for (int n = 1; n <= 3000; n++) {
        ladder_step(&l, 0.001, n <= 1000 ? 1 : 0);
        if (n % 100 == 0)
            printf("%.9g %.9g\n", 0.001 * n, l.x[0]);
    }
    for (int i = 0; i < 3; i++) {
        printf("\n\n");
        for (int n = -100; n <= 1500; n++)
            printf("%.9g %.9g\n", 0.002 * n,
                   orders[i] > 0 ? lent(0.002 * n, orders[i])
                                 : n >= 0 && n < 500);
    }
    return 0;
}
