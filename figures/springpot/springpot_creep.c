/* figures/springpot/springpot_creep.c -- H 0: ladders under a force, and after it.
 *
 * - Blocks 0 to 2, for beta = 1/4, 1/2, 3/4: t, the creep x of the ladder under a force 1, and the creep (0.2)
 *   of its springpot.
 * - Block 3: t and x of a ladder of order 1/2 under a force 1 from t = 0 to 1. Its time eta / k is 1/1000 and
 *   its rho is 1.
 * - Blocks 4 to 6: t and x under the same force, of the springpot of this ladder, of a spring and of a dashpot
 *   with the constant 1. */
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

/* Return x(t) of an element of this order under a force 1 from t = 0 to 1: its creep since t = 0, minus its creep since
 * t = 1. */
static double creep_and_recovery(double t, double order)
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
                   orders[i] > 0 ? creep_and_recovery(0.002 * n, orders[i])
                                 : n >= 0 && n < 500);
    }
    return 0;
}
