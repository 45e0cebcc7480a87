/* tests/random/stress/stress_truth.c -- Compare runs with the truth. */
#include <fvi/coefficients.h>
#include "run/whole_run.h"
#include <fvi/error.h>
#include <fvi/exact_solution.h>
#include <fvi/stability.h>
#include "stress.h"

#include "coefficients/coefficients_ref.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad;
#else
typedef long double quad;
#endif

/* ---- exact: masses, stiffness and damping over twelve decades ---- */

/* Return the largest error of a run over [0, T] in N steps, relative to max |x|. */
static double error_of_run(const fvi_linear_oscillator *problem, double kappa, double T,
                           size_t N)
{
    const double c = problem->c, p0 = problem->m * problem->v0;
    const fvi_system system = {
        .d = 1, .mass = &problem->m, .damping = &problem->rho, .potential = fvi_potential_harmonic(&c)
    };
    const fvi_run run = { .system = &system,
                          .x0 = &problem->x0,
                          .p0 = &p0,
                          .h = T / (double)N,
                          .steps = N,
                          .kappa = kappa,
                          .alpha = problem->alpha,
                          .past = FVI_INITIAL_HISTORY_CAPUTO };
    double *x = malloc(3 * (N + 1) * sizeof *x), *exact, *t, error = GSL_NAN;
    if (!x)
        return error;
    exact = x + N + 1;
    t = exact + N + 1;
    for (size_t k = 0; k <= N; k++)
        t[k] = (double)k * run.h;
    if (fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL) == FVI_SUCCESS
        && fvi_exact_at(problem, N + 1, t, exact, NULL, NULL) == FVI_SUCCESS)
        error = stress_distance(N + 1, x, exact) / stress_size(N + 1, exact);
    free(x);
    return error;
}

/* Let w = sqrt(c/m), r = rho w^(2a-2) / m and W = w T. The error of order 1 is r w h from the damping and, for
 * kappa != 1/2, w h from the start; the error of order 2 is (w h)^2. All errors add up over the time: to at
 * most 2 (1 + W) w h (r + w h + [kappa != 1/2]), for h and for h/2, and 10^-11 for rounding errors if c, rho
 * and m are twelve decades apart. */
double stress_exact(gsl_rng *random, char *describe, size_t size)
{
    enum { N = 2000 };
    double m = stress_decades(random, 1e-6, 1e6),
           w = stress_decades(random, 1e-6, 1e6);
    double alpha = stress_alpha(random), r = stress_decades(random, 1e-6, 0.7);
    double kappa = stress_kappa(random), T = stress_uniform(random, 2, 20) / w;
    const fvi_linear_oscillator problem = { .m = m,
                                 .c = m * w * w,
                                 .rho = r * m * pow(w, 2 - 2 * alpha),
                                 .alpha = alpha,
                                 .past = FVI_INITIAL_HISTORY_CAPUTO,
                                 .x0 = stress_uniform(random, -1, 1),
                                 .v0 = w * stress_uniform(random, -1, 1) };
    double used = 0, error[2];
    for (size_t half = 0; half <= 1; half++) {
        double wh = w * T / (double)((size_t)N << half);
        double bound = 2 * (1 + w * T) * wh * (r + wh + (kappa != 0.5)) + 1e-11;
        error[half] = error_of_run(&problem, kappa, T, (size_t)N << half);
        used = error[half] <= used * bound ? used : error[half] / bound;
    }
    snprintf(describe, size,
             "alpha=%.17g m=%g w=%g r=%g kappa=%g T=%g: errors %g, %g", alpha,
             m, w, r, kappa, T, error[0], error[1]);
    return used;
}

/* ---- halves: a law of two halves of a power takes another algorithm to the same x ---- */

/* As in test_damping_laws_exact.c: frequencies below 10, and w t below 10^4 where the phase matters. The
 * headers of both algorithms promise this accuracy. */
double stress_halves(gsl_rng *random, char *describe, size_t size)
{
    enum { TIMES = 5 };
    const double alpha = gsl_rng_uniform(random);
    const fvi_kernel_term half[] = { { FVI_KERNEL_POWER, 0.5, alpha, 0, 0 },
                                  { FVI_KERNEL_POWER, 0.5, alpha, 0, 0 } };
    const fvi_kernel law = { 2, half };
    const int free = stress_uniform(random, 0, 10) < 1;
    fvi_linear_oscillator p = { .m = 1,
                     .c = free ? 0 : stress_decades(random, 0.01, 100),
                     .rho = stress_decades(random, 0.01, 100),
                     .alpha = alpha,
                     .x0 = stress_uniform(random, -0.5, 0.5),
                     .v0 = stress_uniform(random, -0.5, 0.5),
                     .forcing = (fvi_forcing)gsl_rng_uniform_int(random, 3),
                     .A = 1,
                     .T = stress_decades(random, 0.1, 100),
                     .w = stress_decades(random, 0.1, 10) };
    double t[TIMES], x[TIMES], y[TIMES];
    for (size_t j = 0; j < TIMES; j++)
        t[j] = stress_decades(random, 1e-3, 1e3);
    snprintf(describe, size, "alpha=%.17g c=%g rho=%g forcing=%d", alpha, p.c,
             p.rho, (int)p.forcing);
    if (fvi_exact_at(&p, TIMES, t, x, NULL, NULL))
        return GSL_POSINF;
    p.law = &law;
    p.alpha = 0;
    if (fvi_exact_at(&p, TIMES, t, y, NULL, NULL))
        return GSL_POSINF;
    const double most = larger(fabs(p.x0), stress_size(TIMES, x));
    return stress_distance(TIMES, x, y) / (2.4e-13 * most);
}

/* ---- quadruple: the same operations with 113 bits ---- */

/* Run the momentum form for d = 1, U = c x^2/2 + g x^4/4, with g = 0 unless kappa = 0. */
static void run_quad(const fvi_run *run, const double cg[2], quad *x)
{
    const size_t N = run->steps;
    const quad h = run->h, kappa = run->kappa, m = *run->system->mass;
    const quad rho = *run->system->damping, beta = 2 * (quad)run->alpha;
    quad *w = malloc(2 * (N + 1) * sizeof *w), *z = w + N + 1, p = *run->p0;
    /* h^(1 - beta) in long double: 64 bits are 2000 times more accurate than necessary */
    const quad factor =
        rho * (quad)powl(run->h, 1 - 2 * (long double)run->alpha);
    w[0] = 1;
    for (size_t n = 1; n <= N; n++)
        w[n] = w[n - 1] * ((quad)n - 1 - beta) / (quad)n;
    x[0] = *run->x0;
    z[0] = 0; /* Caputo: x - x0 - t v0 */
    for (size_t k = 0; k < N; k++) {
        quad c = cg[0], g = cg[1];
        quad d =
            (p - h * kappa * c * x[k]) / (m / h + h * kappa * (1 - kappa) * c);
        quad s = x[k] + (1 - kappa) * d, sum = 0;
        x[k + 1] = x[k] + d;
        z[k + 1] = x[k + 1] - x[0];
        if (run->alpha > 0.5)
            z[k + 1] -= (quad)(k + 1) * h * (quad)*run->p0 / m;
        for (size_t n = 0; n <= k + 1; n++)
            sum += w[n] * z[k + 1 - n];
        p += -h * (c + g * s * s) * s - factor * sum;
    }
    free(w);
}

/* In each step a rounding error of u max|x|, and the corresponding part of the velocity, persists and adds up:
 * to at most 16 N u max|x| (1 + R'). R' = 4^alpha rho h^(2 - 2 alpha) / m is the size of the damping in a step,
 * below 4 in stable runs. */
double stress_quadruple(gsl_rng *random, char *describe, size_t size)
{
    enum { N = 600 };
    double m = stress_decades(random, 1e-3, 1e3), alpha = stress_alpha(random);
    double h = stress_decades(random, 1e-3, 0.3), kappa = stress_kappa(random);
    double rho = m * pow(h, 2 * alpha - 2) * stress_decades(random, 1e-6, 1)
                 / pow(4, alpha);
    double cg[2] = { m * stress_uniform(random, 0.1, 2), 0 };
    if (kappa == 0)
        cg[1] = m * stress_uniform(random, 0, 2);
    double x0 = stress_uniform(random, -1, 1),
           p0 = m * stress_uniform(random, -1, 1);
    const fvi_system system = { .d = 1,
                                .mass = &m,
                                .damping = &rho,
                                .potential = fvi_potential_duffing(cg) };
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &p0,
                          .h = h,
                          .steps = N,
                          .kappa = kappa,
                          .alpha = alpha,
                          .past = FVI_INITIAL_HISTORY_CAPUTO,
                          .memory = FVI_HISTORY_DIRECT };
    double x[N + 1], load = 0, most = 0, off = 0;
    static quad truth[N + 1];
    snprintf(describe, size, "alpha=%.17g m=%g rho=%g h=%g kappa=%g c=%g g=%g",
             alpha, m, rho, h, kappa, cg[0], cg[1]);
    fvi_stability_number(&fvi_fractional, &run, &load);
    if (load > 0.9
        || fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL) != FVI_SUCCESS)
        return load > 0.9 ? 0 : GSL_POSINF;
    run_quad(&run, cg, truth);
    for (size_t k = 0; k <= N; k++) {
        most = larger(most, fabs((double)truth[k]));
        off = larger(off, fabs((double)((quad)x[k] - truth[k])));
    }
    return off / (16 * N * 0x1p-53 * most * (1 + 4 * load));
}

/* ---- rounding: Bagley-Torvik, 10^5 steps, against 113 bits ---- */

/* Run with the plain sum: 5 10^9 products in quadruple precision, two or three minutes. */
static void run_plate(size_t N, double step, quad *x)
{
    const quad h = step;
    quad *w = malloc(2 * (N + 1) * sizeof *w), *d = w + N + 1, p = 0;
    quad root = sqrt(step);
    root = (root + h / root) / 2; /* Newton: sqrt(h) to 100 bits */
    w[0] = 1;
    d[0] = x[0] = 0;
    for (size_t n = 1; n <= N; n++)
        w[n] = w[n - 1] * ((quad)n - 1.5) / (quad)n;
    for (size_t k = 0; k < N; k++) {
        quad sum = 0, F = (double)(k + 1) * step <= 1 ? 8 : 0;
        d[k + 1] = (p - h / 2 * x[k]) / (1 / h + h / 4);
        x[k + 1] = x[k] + d[k + 1];
        for (size_t n = 0; n <= k; n++)
            sum += w[n] * d[k + 1 - n];
        p += h * (F - (x[k] + d[k + 1] / 2)) - sum / root;
    }
    free(w);
}

double stress_rounding(gsl_rng *random, char *describe, size_t size)
{
    enum { N = 100000 };
    (void)random;
    const double one = 1, zero = 0, aT[2] = { 8, 1 }, h = 20.0 / N;
    const fvi_system system = {
        .d = 1, .mass = &one, .damping = &one, .potential = fvi_potential_harmonic(&one),
        .force = fvi_force_step(aT)
    };
    quad *truth = malloc((N + 1) * sizeof *truth);
    double *x = malloc(2 * (N + 1) * sizeof *x), *rounded = x + N + 1, off[2];
    run_plate(N, h, truth);
    for (size_t k = 0; k <= N; k++)
        rounded[k] = (double)truth[k];
    for (int fast = 0; fast <= 1; fast++) {
        const fvi_run run = { .system = &system,
                              .x0 = &zero,
                              .p0 = &zero,
                              .h = h,
                              .steps = N,
                              .kappa = 0.5,
                              .alpha = 0.75,
                              .memory = fast ? FVI_HISTORY_MODES
                                             : FVI_HISTORY_DIRECT };
        fvi_trajectory(&fvi_fractional, &run, x, NULL, NULL);
        off[fast] =
            stress_distance(N + 1, x, rounded) / stress_size(N + 1, rounded);
    }
    free(x);
    free(truth);
    snprintf(describe, size,
             "relative to max|x|: direct %.2e, exponentials %.2e", off[0],
             off[1]);
    return larger(off[0] / 1e-14, off[1] / 1e-13);
}

/* ---- weights: 10^8 of them, against the gamma function ---- */

double stress_weights(gsl_rng *random, char *describe, size_t size)
{
    (void)random;
    const size_t rows = sizeof ref_far / sizeof *ref_far;
    size_t wrong = 0, furthest = 0;
    for (size_t i = 0; i < rows; i++)
        furthest = (size_t)larger((double)furthest, (double)ref_far[i].n);
    double *w = malloc((furthest + 1) * sizeof *w), made = -1;
    for (size_t i = 0; w && i < rows; i++) {
        if (ref_far[i].alpha != made)
            fvi_gl_weights(made = ref_far[i].alpha, furthest + 1, w);
        wrong += w[ref_far[i].n] != ref_far[i].want;
    }
    snprintf(describe, size, "%zu of %zu are not the nearest doubles", wrong,
             rows);
    int enough = w != NULL;
    free(w);
    return enough ? 2.0 * (double)wrong : GSL_POSINF;
}
