/* figures/response/response.c -- H 30: a receptance, and the part of it that comes from two poles.
 *
 * The system is the body of Chapter 1, m = c = 1 and rho = 1/2.
 * - Block 0, alpha = 1/4: omega, |H|, and the modulus of the poles' part of H.
 * - Blocks 1 to 3, alpha = 0.05, 0.25, 0.45: omega, |poles' part - H| / |H|. */
#include <complex.h>
#include <fvi/response.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Compute H(i omega), and its poles' part from the residues v^2. */
static void evaluate_receptance(double alpha, double omega, double complex *H,
                                double complex *modes)
{
    const double one = 1, half = 0.5;
    const fvi_system body = { .d = 1, .mass = &one, .damping = &half,
                              .potential = fvi_potential_harmonic(&one) };
    const fvi_linear_motion motion = { .system = &body, .alpha = alpha };
    fvi_response *response;
    fvi_poles p;
    double h[2];
    if (fvi_response_alloc(&motion, &response, NULL)
        || fvi_response_at(response, FVI_RESPONSE_RECEPTANCE, 1, &omega, 0, 0, h, NULL)
        || fvi_poles_find(response, 0, &p, NULL))
        exit(EXIT_FAILURE);
    const double complex s = p.pole[0] + I * p.pole[1],
                         v = p.shape[0] + I * p.shape[1], R = v * v,
                         z = I * omega;
    *H = h[0] + I * h[1];
    *modes = R / (z - s) + conj(R) / (z - conj(s));
    fvi_poles_free(&p);
    fvi_response_free(response);
}

int main(void)
{
    static const double alpha[] = { 0.25, 0.05, 0.25, 0.45 };
    double complex H, modes;
    for (int block = 0; block < 4; block++) {
        printf("%s# alpha = %g\n", block ? "\n\n" : "", alpha[block]);
        for (int k = -60; k <= 60; k++) {
            const double omega = pow(10, k / 40.0);
            evaluate_receptance(alpha[block], omega, &H, &modes);
            if (block == 0)
                printf("%.17g %.17g %.17g\n", omega, cabs(H), cabs(modes));
            else
                printf("%.17g %.6g\n", omega, cabs(modes - H) / cabs(H));
        }
    }
    return EXIT_SUCCESS;
}
