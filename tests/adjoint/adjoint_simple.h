/* tests/adjoint/adjoint_simple.h -- The adjoint run of Algorithm 3 as it stands. */
#ifndef ADJOINT_SIMPLE_H
#define ADJOINT_SIMPLE_H

#include <fvi/coefficients.h>

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* One Duffing oscillator, c x^2/2 + g x^4/4, held at x0; x of N steps, and dJ/dx_k and
 * dJ/dp_N. mu: output, lambda_{N-k}, N + 1 numbers. q: output, the last momentum. */
//> simple
static inline void adjoint_run(size_t N, double h, double kappa, double alpha,
                               double m, double rho, double c, double g,
                               const double *x, const double *Jx, double Jp,
                               double *mu, double *q)
{
    const double kick = rho * pow(h, 1 - 2 * alpha);
    double *w = malloc((N + 1) * sizeof *w);
    fvi_gl_weights(2 * alpha, N + 1, w);
    mu[0] = Jp;
    *q = 0;
    for (size_t i = 0; i < N; i++) { /* from node k + 1 to node k */
        const size_t k = N - 1 - i;
        double H = 0;
        for (size_t n = 0; n <= i; n++)
            H += w[n] * mu[i - n];
        *q += Jx[k + 1] - kick * H; /* (23.4) */
        const double S = kappa * x[k] + (1 - kappa) * x[k + 1],
                     G = c + 3 * g * S * S;
        const double delta = (*q - (1 - kappa) * h * G * mu[i])
                             / (m / h + kappa * (1 - kappa) * h * G);
        *q -= h * G * (mu[i] + kappa * delta);
        mu[i + 1] = mu[i] + delta;
    }
    *q += Jx[0];
    free(w);
}
//< simple

#endif
