/* figures/damping_laws/damping_laws.c -- H 26: the storage and loss moduli of four laws.
 *
 * Prints a block for each law: omega from 10^-3 to 10^3, the storage modulus, the loss modulus. */
#include "laws.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(void)
{
    printf("# omega, storage, loss; loss is 0.2 at omega = 1\n");
    for (int i = 0; i < LAWS; i++) {
        const fvi_kernel_term term = scaled(i);
        printf("%s# %s, rho = %.17g\n", i ? "\n\n" : "", laws[i].name,
               term.rho);
        for (int k = -30; k <= 30; k++) {
            const double omega = pow(10, k / 10.0);
            double storage, loss;
            if (fvi_kernel_moduli(&(fvi_kernel){ 1, &term }, omega, &storage, &loss))
                return EXIT_FAILURE;
            printf("%.17g %.17g %.17g\n", omega, storage, loss);
        }
    }
    return EXIT_SUCCESS;
}
