/* figures/damping_laws/damping_laws_creep.c -- H 26: the relaxation, the creep and the loss factor of four laws.
 *
 * Prints a block for each law: x from 10^-3 to 10^3, the force at t = x after a stretch of 1, the stretch at t
 * = x under a force of 1, and the loss factor at omega = x. */
#include "creep.h"
#include "laws.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(void)
{
    printf("# x; force and stretch at t = x, loss factor at omega = x\n");
    for (int i = 0; i < LAWS; i++) {
        const fvi_kernel_term term = scaled(i);
        const fvi_kernel law = { 1, &term };
        printf("%s# %s, rho = %.17g\n", i ? "\n\n" : "", laws[i].name,
               term.rho);
        for (int k = -12; k <= 12; k++) {
            const double x = pow(10, k / 4.0);
            double storage, loss, force, stretch;
            if (fvi_kernel_moduli(&law, x, &storage, &loss)
                || relaxation_and_creep(&law, x, &force, &stretch))
                return EXIT_FAILURE;
            printf("%.17g %.17g %.17g %.17g\n", x, force, stretch,
                   loss / storage);
        }
    }
    return EXIT_SUCCESS;
}
