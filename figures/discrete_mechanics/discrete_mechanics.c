/* figures/discrete_mechanics/discrete_mechanics.c -- Chapter 2: energy over 10^5 steps, no damping.
 *
 * Block 0: the harmonic oscillator m = c = 1 with h = 1/50, by both Euler methods
 * and by the variational integrator. Blocks 1 to 4: a pendulum that swings out to
 * 2 radians; for one kappa and h each, the farthest energy from E_0 in each of
 * 250 intervals of 400 steps. */
#include <fvi/discrete_mechanics.h>
#include <fvi/error.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STEPS = 100000, INTERVAL = 400 };

static const double one = 1, none = 0;

/* The energy as a number. */
static double energy(const fvi_system *system, const double *x, const double *p)
{
    double E;
    return fvi_energy(system, x, p, &E) ? (double)NAN : E;
}

static fvi_stepper *start(const fvi_method *method, const fvi_run *run)
{
    fvi_stepper *s;
    if (fvi_start(method, run, &s) != FVI_SUCCESS)
        exit(EXIT_FAILURE);
    return s;
}

static void advance(fvi_stepper *s)
{
    if (fvi_step(s) != FVI_SUCCESS)
        exit(EXIT_FAILURE);
}

static void harmonic(void)
{
    const fvi_system system = {
        1, &one, &none, fvi_potential_harmonic(&one), { 0 }
    };
    const fvi_run run = { .system = &system,
                          .x0 = &one,
                          .p0 = &none,
                          .h = 0.02,
                          .steps = STEPS,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    fvi_stepper *s[] = { start(&fvi_euler_explicit, &run),
                         start(&fvi_euler_implicit, &run),
                         start(&fvi_variational, &run) };
    const double E0 = energy(&system, run.x0, run.p0);
    const double factor = 1 + run.h * run.h;
    printf(
        "# harmonic oscillator, h = %g: k, E/E0 of explicit Euler, implicit "
        "Euler, variational with kappa = 1/2, (1 + h^2 c/m)^k, its inverse\n",
        run.h);
    for (size_t k = 0; k <= STEPS; k++) {
        if (k % 5000 == 0) {
            printf("%zu", k);
            for (size_t i = 0; i < 3; i++)
                printf(" %.17g", energy(&system, s[i]->x, s[i]->p) / E0);
            printf(" %.17g %.17g\n", pow(factor, (double)k),
                   pow(factor, -(double)k));
        }
        for (size_t i = 0; i < 3 && k < STEPS; i++)
            advance(s[i]);
    }
    for (size_t i = 0; i < 3; i++)
        fvi_stop(s[i]);
    printf("\n\n");
}

static void pendulum(double kappa, double h)
{
    const fvi_system system = {
        1, &one, &none, fvi_potential_pendulum(&one), { 0 }
    };
    const double x0 = 2;
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &none,
                          .h = h,
                          .steps = STEPS,
                          .kappa = kappa,
                          .alpha = 0.5 };
    fvi_stepper *s = start(&fvi_variational, &run);
    const double E0 = energy(&system, s->x, s->p);
    double far = 0;
    printf("# pendulum, kappa = %g, h = %g: k, largest |E/E0 - 1| in %d steps, "
           "kappa, h\n",
           kappa, h, INTERVAL);
    while (s->k < STEPS) {
        advance(s);
        far = fmax(far, fabs(energy(&system, s->x, s->p) / E0 - 1));
        if (s->k % INTERVAL == 0) {
            printf("%zu %.17g %.17g %.17g\n", s->k, far, kappa, h);
            far = 0;
        }
    }
    fvi_stop(s);
    printf("\n\n");
}

int main(void)
{
    harmonic();
    pendulum(0, 0.1);
    pendulum(0, 0.05);
    pendulum(0.5, 0.1);
    pendulum(0.5, 0.05);
    return EXIT_SUCCESS;
}
