/* figures/legendre/legendre.c -- H 8: the errors of three definitions of the momentum.
 *
 * - Block 0: the paper's problem, m = c = 1, rho = 1/5, alpha = 1/2, kappa = 1/2, x0 = 1, p0 = 1/2, up to t =
 *   15.
 * - Block 1: a Duffing oscillator without damping, whose solution is an elliptic function, up to t = 5.
 *
 * Each row has h, the largest errors of p by the matched momentum, by D2 L_d without damping and by the
 * quotient m (x_k - x_{k-1}) / h, and then the largest errors of the three energies. */
#include <fvi/fvi.h>
#include "run/whole_run.h"
#include <fvi/paper/legendre.h>
#include "system/larger.h"

#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MATCHED, RAW, QUOTIENT, CANDIDATES, MOST = 2400 };

static const double one = 1, half = 0.5;

/* Return the energy, NAN if fvi_energy fails. */
static double energy(const fvi_system *system, const double *x, const double *p)
{
    double E;
    return fvi_energy(system, x, p, &E) ? (double)NAN : E;
}

/* Compute the solution of x'' + rho x' + x = 0, x(0) = 1, x'(0) = 1/2. */
static void damped(double rho, double t, double *x, double *p)
{
    const double omega = sqrt(1 - rho * rho / 4), B = (half + rho / 2) / omega;
    const double fade = exp(-rho * t / 2), C = cos(omega * t),
                 S = sin(omega * t);
    *x = fade * (C + B * S);
    *p = fade * omega * (B * C - S) - rho / 2 * *x;
}

/* Compute the solution x = A cn(omega t - 1/2) of x'' + x + x^3 = 0. */
static void elliptic(double rho, double t, double *x, double *p)
{
    (void)rho;
    const double A = 1.25, omega = sqrt(1 + A * A);
    double sn, cn, dn;
    gsl_sf_elljac_e(omega * t - half, A * A / (2 * omega * omega), &sn, &cn,
                    &dn);
    *x = A * cn;
    *p = -A * omega * sn * dn;
}

/* Print one row: h, the largest error of p for each momentum, the largest error of the energy for each momentum. */
static void row(double rho, const fvi_potential *u, double T, size_t N,
                void (*exact)(double, double, double *, double *))
{
    static double x[MOST + 1];
    const fvi_system system = { 1, &one, &rho, *u, { 0 }, NULL, NULL };
    const double h = T / (double)N;
    double x0, p0, worst[2 * CANDIDATES] = { 0 };
    exact(rho, 0, &x0, &p0);
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = h,
                          .steps = N,
                          .kappa = half,
                          .alpha = half };
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL) != FVI_SUCCESS)
        exit(EXIT_FAILURE);
    for (size_t k = 1; k <= N; k++) {
        const double quotient = (x[k] - x[k - 1]) / h;
        double p[CANDIDATES], xt, pt;
        p[QUOTIENT] = quotient; /* m = 1 */
        fvi_legendre_plus(&system, half, h, x + k - 1, x + k, &quotient, NULL,
                          p + MATCHED);
        fvi_legendre_plus(&system, half, h, x + k - 1, x + k, NULL, NULL,
                          p + RAW);
        exact(rho, (double)k * h, &xt, &pt);
        for (size_t i = 0; i < CANDIDATES; i++) {
            const double E = energy(&system, x + k, p + i);
            worst[i] = larger(worst[i], fabs(p[i] - pt));
            worst[CANDIDATES + i] = larger(worst[CANDIDATES + i],
                                           fabs(E - energy(&system, &xt, &pt)));
        }
    }
    printf("%.17g", h);
    for (size_t i = 0; i < 2 * CANDIDATES; i++)
        printf(" %.17g", worst[i]);
    printf("\n");
}

int main(void)
{
    const double spring[] = { 1, 0 }, cubic[] = { 1, 1 };
    const fvi_potential linear = fvi_potential_duffing(spring),
                        duffing = fvi_potential_duffing(cubic);
    printf(
        "# m = c = 1, rho = 1/5, kappa = 1/2, t <= 15: h, errors of p matched, "
        "D2 L_d without damping, m (x_k - x_{k-1})/h, then of the energies\n");
    for (size_t N = 150; N <= MOST; N *= 2)
        row(0.2, &linear, 15, N, damped);
    printf("\n\n# Duffing, c = g = 1, rho = 0, t <= 5: the same columns\n");
    for (size_t N = 50; N <= 800; N *= 2)
        row(0, &duffing, 5, N, elliptic);
    return EXIT_SUCCESS;
}
