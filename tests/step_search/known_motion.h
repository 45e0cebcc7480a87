/* tests/step_search/known_motion.h -- A motion that is known, for the one call. */
#ifndef KNOWN_MOTION_H
#define KNOWN_MOTION_H

#include <fvi/fvi.h>

#include <math.h>

/* Duffing's oscillator with fractional damping under a force of which the motion is known:
 * x = 1 + t^2 - t^3/3 from a body that was held, D^{2 alpha} t^n = n! t^{n - 2 alpha} /
 * Gamma(n + 1 - 2 alpha). */
static const double mass = 1.5, rho = 0.4, spring[] = { 1, 0.5 }, alpha = 0.3;
static const double x0 = 1, p0 = 0;

static double known_x(double t)
{
    return 1 + t * t - t * t * t / 3;
}

static int force(double t, size_t d, void *params, double *F)
{
    (void)d;
    (void)params;
    const double x = known_x(t), order = 2 * alpha,
                 derivative = 2 * pow(t, 2 - order) / tgamma(3 - order)
                              - 2 * pow(t, 3 - order) / tgamma(4 - order);
    *F = mass * (2 - 2 * t) + spring[0] * x + spring[1] * x * x * x
         + rho * derivative;
    return 0;
}

static fvi_problem duffing(void)
{
    return (fvi_problem){ .system = { .d = 1,
                                      .mass = &mass,
                                      .damping = &rho,
                                      .potential = fvi_potential_duffing(spring),
                                      .force = { .value = force } },
                          .x0 = &x0,
                          .p0 = &p0,
                          .T = 2,
                          .alpha = alpha };
}

#endif
