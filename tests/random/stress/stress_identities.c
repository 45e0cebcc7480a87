/* tests/random/stress/stress_identities.c -- Identities that every run must obey. */
#include <fvi/error.h>
#include "run/whole_run.h"
#include <fvi/paper/integration_by_parts.h>
#include <fvi/paper/legendre.h>
#include <fvi/stability.h>
#include "stress.h"
#include "system/larger.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { D = 100, STEPS = 400 };

/* ---- matching: a random chain of up to 100 masses ---- */

typedef struct {
    double mass[D], damping[D], x0[D], p0[D], spring[2], force[2];
    fvi_system system;
    fvi_run run;
} chain;

/* Choose h at most 0.7 of the stable step and at most a tenth of the period over 2 pi of the fastest mode. */
static void random_chain(gsl_rng *random, chain *c, size_t steps)
{
    const size_t d =
        1 + gsl_rng_uniform_int(random, gsl_rng_uniform_int(random, 2) ? D : 4);
    double step = 0;
    c->spring[0] = stress_uniform(random, 0.5, 2);
    c->spring[1] = stress_uniform(random, 0, 1);
    c->force[0] = stress_uniform(random, -1, 1);
    c->force[1] = stress_uniform(random, 0, 3);
    for (size_t i = 0; i < d; i++) {
        c->mass[i] = stress_decades(random, 0.1, 10);
        c->damping[i] = gsl_rng_uniform_int(random, 3)
                            ? stress_decades(random, 1e-3, 1)
                            : 0;
        c->x0[i] = stress_uniform(random, -1, 1);
        c->p0[i] = stress_uniform(random, -1, 1);
    }
    c->system = (fvi_system){ .d = d,
                              .mass = c->mass,
                              .damping = c->damping,
                              .potential = fvi_potential_chain(c->spring),
                              .force = fvi_force_cosine(c->force) };
    c->run = (fvi_run){ .system = &c->system,
                        .x0 = c->x0,
                        .p0 = c->p0,
                        .steps = steps,
                        .kappa = stress_kappa(random),
                        .alpha = stress_alpha(random),
                        .past = (fvi_initial_history)gsl_rng_uniform_int(random, 3) };
    fvi_stability_longest_step(&fvi_fractional, &c->run, &step);
    if (step == 0) { /* alpha is near 1 and no step is stable, so reduce the damping */
        for (size_t i = 0; i < d; i++)
            c->damping[i] *= 0.1 * c->mass[i];
        fvi_stability_longest_step(&fvi_fractional, &c->run, &step);
    }
    c->run.h = smaller(0.7 * step, 0.02);
}

/* F^-(x_k, x_{k+1}) = p_k = F^+(x_{k-1}, x_k). The run gives p_k; F^- and F^+ are recomputed from its
 * positions. There a rounding error u |x| is divided by h and, in the damping, multiplied by at most 4^alpha
 * rho h^(1 - 2 alpha) < 4 m / h. */
double stress_matching(gsl_rng *random, char *describe, size_t size)
{
    enum { N = 60 };
    chain c;
    random_chain(random, &c, N);
    const size_t d = c.system.d;
    double *x = calloc(5 * (N + 1) * d, sizeof *x), worst = 0, allowed = 0;
    double *p = x + (N + 1) * d, *z = p + (N + 1) * d, *H = z + (N + 1) * d,
           *F = H + (N + 1) * d;
    snprintf(describe, size, "d=%zu alpha=%.17g kappa=%g h=%g past=%d", d,
             c.run.alpha, c.run.kappa, c.run.h, (int)c.run.past);
    int status = fvi_trajectory(&fvi_fractional, &c.run, x, p, NULL);
    for (size_t k = 0; k <= N; k++)
        for (size_t i = 0; i < d; i++) {
            z[k * d + i] = x[k * d + i];
            if (c.run.past != FVI_INITIAL_HISTORY_RIEMANN_LIOUVILLE)
                z[k * d + i] -= c.x0[i];
            if (c.run.past == FVI_INITIAL_HISTORY_CAPUTO && c.run.alpha > 0.5)
                z[k * d + i] -= (double)k * c.run.h * c.p0[i] / c.mass[i];
            allowed =
                larger(allowed, fabs(x[k * d + i]) * c.mass[i] / c.run.h);
        }
    allowed *= 16 * N * 0x1p-53;
    status |= fvi_delta_minus(2 * c.run.alpha, c.run.h, N, d, z, H);
    for (size_t k = 1; k < N && !status; k++) {
        double minus[D], plus[D];
        const double *at = x + k * d;
        c.system.force.value((double)k * c.run.h, d, c.force, F);
        fvi_legendre_minus(&c.system, c.run.kappa, c.run.h, at, at + d, minus);
        fvi_legendre_plus(&c.system, c.run.kappa, c.run.h, at - d, at,
                          H + k * d, F, plus);
        worst = larger(worst, stress_distance(d, minus, p + k * d));
        worst = larger(worst, stress_distance(d, plus, p + k * d));
    }
    free(x);
    return status ? GSL_POSINF : worst / allowed;
}

/* ---- dissipation and balance: one oscillator, Caputo, v0 = 0 ---- */

typedef struct {
    double m, rho, cg[2], x0, p0;
    fvi_system system;
    fvi_run run;
} oscillator;

static void random_oscillator(gsl_rng *random, oscillator *o, size_t steps)
{
    o->m = stress_decades(random, 1e-3, 1e3);
    o->cg[0] = o->m * stress_uniform(random, 0.2, 2);
    o->cg[1] = o->m * stress_uniform(random, 0, 1);
    o->x0 = stress_uniform(random, -1, 1);
    o->p0 = 0;
    o->system =
        (fvi_system){ .d = 1,
                      .mass = &o->m,
                      .damping = &o->rho,
                      .potential = fvi_potential_duffing(o->cg) };
    o->run = (fvi_run){ .system = &o->system,
                        .x0 = &o->x0,
                        .p0 = &o->p0,
                        .steps = steps,
                        .h = stress_decades(random, 0.003, 0.03),
                        .kappa = 0.5,
                        .alpha = stress_alpha(random),
                        .past = FVI_INITIAL_HISTORY_CAPUTO };
    o->rho = o->m * stress_decades(random, 1e-4, 0.5);
}

/* Compute the work of the damping, sum_k d_k rho Delta Delta x_k, over the first `steps` steps: its lowest
 * partial sum, and the largest |E_k - E_0 + work_k|. */
static int work_of(const oscillator *o, size_t steps, double *lowest,
                   double *defect)
{
    double x[STEPS + 1], z[STEPS + 1], H[STEPS + 1], energy[STEPS + 1],
        work = 0;
    int status = fvi_trajectory(&fvi_fractional, &o->run, x, NULL, energy);
    for (size_t k = 0; k <= STEPS; k++)
        z[k] = x[k] - x[0];
    status |= fvi_delta_minus(2 * o->run.alpha, o->run.h, STEPS, 1, z, H);
    *lowest = *defect = 0;
    for (size_t k = 1; k <= steps && !status; k++) {
        work += (x[k] - x[k - 1]) * o->rho * H[k];
        *lowest = smaller(*lowest, work);
        *defect =
            larger(*defect, fabs(energy[k] - energy[0] + work) / energy[0]);
    }
    return status;
}

/* (1-z)^(beta - 1) has a positive real part on the unit circle, so every partial sum is >= 0 for every motion.
 * The rounding error of H is some u |x| 4^alpha h^(-2 alpha). */
double stress_dissipation(gsl_rng *random, char *describe, size_t size)
{
    oscillator o;
    double lowest, defect;
    random_oscillator(random, &o, STEPS);
    snprintf(describe, size, "alpha=%.17g m=%g rho=%g h=%g", o.run.alpha, o.m,
             o.rho, o.run.h);
    if (work_of(&o, STEPS, &lowest, &defect))
        return GSL_POSINF;
    double rounding = STEPS * 16 * 0x1p-53 * o.rho * o.x0 * o.x0
                      * pow(o.run.h / 2, -2 * o.run.alpha);
    return larger(0, -lowest / rounding);
}

/* E_k - E_0 + work_k is O(h) for a method of order 1. With half the step it must be at least 1.5 times smaller
 * over the same time, unless it is rounding. */
double stress_balance(gsl_rng *random, char *describe, size_t size)
{
    oscillator o;
    double lowest, coarse, fine;
    random_oscillator(random, &o, STEPS);
    int status = work_of(&o, STEPS / 2, &lowest, &coarse);
    o.run.h /= 2;
    status |= work_of(&o, STEPS, &lowest, &fine);
    snprintf(describe, size, "alpha=%.17g m=%g rho=%g h=%g: defects %g, %g",
             o.run.alpha, o.m, o.rho, o.run.h, coarse, fine);
    return status ? GSL_POSINF : fine < 1e-10 ? 0 : 1.5 * fine / coarse;
}

/* ---- scaling, overflow, memories, refusals ---- */

/* A linear system that starts 2^s times as large moves 2^s times as far, to the bit. So no comparison with an
 * absolute number occurs anywhere. */
double stress_scaling(gsl_rng *random, char *describe, size_t size)
{
    oscillator o;
    double x[STEPS + 1], y[STEPS + 1], p[STEPS + 1], q[STEPS + 1];
    random_oscillator(random, &o, STEPS);
    o.cg[1] = 0;
    o.system.potential = fvi_potential_duffing(o.cg);
    o.p0 = o.m * stress_uniform(random, -1, 1);
    o.run.kappa = stress_kappa(random);
    o.run.memory = gsl_rng_uniform_int(random, 2) ? FVI_HISTORY_DIRECT
                                                  : FVI_HISTORY_MODES;
    const int s = (int)gsl_rng_uniform_int(random, 1000) - 500; /* 10^+-150 */
    snprintf(describe, size, "alpha=%.17g m=%g rho=%g h=%g s=%d", o.run.alpha,
             o.m, o.rho, o.run.h, s);
    if (fvi_trajectory(&fvi_fractional, &o.run, x, p, NULL))
        return GSL_POSINF;
    o.x0 = ldexp(o.x0, s);
    o.p0 = ldexp(o.p0, s);
    if (fvi_trajectory(&fvi_fractional, &o.run, y, q, NULL))
        return GSL_POSINF;
    for (size_t k = 0; k <= STEPS; k++)
        if (ldexp(x[k], s) != y[k] || ldexp(p[k], s) != q[k])
            return 2;
    return 0;
}

/* Huge starts, steps and springs: either every number is finite, or the run returns FVI_EOVRFLW (or cannot
 * solve a step), and all numbers before are finite. */
double stress_overflow(gsl_rng *random, char *describe, size_t size)
{
    oscillator o;
    random_oscillator(random, &o, STEPS);
    o.x0 = stress_decades(random, 1e100, 1e308);
    o.p0 = -stress_decades(random, 1e-300, 1e308);
    o.rho = stress_decades(random, 1e-300, 1e300);
    o.run.h = stress_decades(random, 1e-12, 1e12);
    o.run.kappa = stress_kappa(random);
    fvi_stepper *s;
    int status = fvi_stepper_start(&fvi_fractional, &o.run, &s,
                                   NULL), silent = 0;
    snprintf(describe, size, "alpha=%.17g m=%g rho=%g h=%g x0=%g p0=%g",
             o.run.alpha, o.m, o.rho, o.run.h, o.x0, o.p0);
    if (status)
        return status == FVI_EDOM || status == FVI_ESING ? 0 : 2;
    while (s->k < STEPS && (status = fvi_stepper_step(s)) == FVI_SUCCESS)
        silent |= !gsl_finite(s->x[0]) || !gsl_finite(s->p[0]);
    fvi_stepper_free(s);
    int honest = status == FVI_SUCCESS || status == FVI_EOVRFLW
                 || status == FVI_EMAXITER || status == FVI_ESING;
    return silent || !honest ? 2 : 0;
}

/* The exponentials keep their tolerance, relative to max|x|, in runs well inside the region of stability. */
double stress_memories(gsl_rng *random, char *describe, size_t size)
{
    enum { N = 3000 };
    static double x[2][N + 1];
    oscillator o;
    random_oscillator(random, &o, N);
    o.p0 = o.m * stress_uniform(random, -1, 1);
    const fvi_history_kind kinds[] = { FVI_HISTORY_DIRECT, FVI_HISTORY_MODES };
    for (size_t i = 0; i < 2; i++) {
        o.run.memory = kinds[i];
        if (fvi_trajectory(&fvi_fractional, &o.run, x[i], NULL, NULL))
            return GSL_POSINF;
    }
    double most = stress_size(N + 1, x[0]);
    double fast = stress_distance(N + 1, x[0], x[1]);
    snprintf(describe, size, "alpha=%.17g m=%g rho=%g h=%g: exponentials %.2e",
             o.run.alpha, o.m, o.rho, o.run.h, fast / most);
    return fast / (1e-13 * most);
}

/* With one wrong field the run is refused, and no outputs are written. */
double stress_refusals(gsl_rng *random, char *describe, size_t size)
{
    oscillator o;
    random_oscillator(random, &o, STEPS);
    const double wrong[] = {
        GSL_NAN, GSL_POSINF, GSL_NEGINF, -1, -0x1p-1074, 0
    };
    double bad = wrong[gsl_rng_uniform_int(random, 5)];
    unsigned long field = gsl_rng_uniform_int(random, 10);
    int expected = FVI_EDOM;
    switch (field) {
    case 0:
        o.run.h = gsl_rng_uniform_int(random, 2) ? bad : 0;
        break;
    case 1:
        o.run.kappa = bad;
        break;
    case 2:
        o.run.alpha = bad;
        break;
    case 3:
        o.m = gsl_rng_uniform_int(random, 2) ? bad : 0;
        break;
    case 4:
        o.rho = bad;
        break;
    case 5:
        o.x0 = wrong[gsl_rng_uniform_int(random, 3)];
        break;
    case 6:
        o.p0 = wrong[gsl_rng_uniform_int(random, 3)];
        break;
    case 7:
        o.run.steps = 0;
        expected = FVI_EINVAL;
        break;
    case 8:
        o.system.d = 0;
        expected = FVI_EINVAL;
        break;
    default:
        o.run.x0 = NULL;
        expected = FVI_EFAULT;
        break;
    }
    fvi_stepper *untouched = NULL;
    int status = fvi_stepper_start(&fvi_fractional, &o.run, &untouched, NULL);
    snprintf(describe, size, "field %lu, value %g: %s", field, bad,
             fvi_error_name(status));
    fvi_stepper_free(untouched);
    return status == expected && !untouched ? 0 : 2;
}
