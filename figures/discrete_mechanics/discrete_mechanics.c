/* figures/discrete_mechanics/discrete_mechanics.c -- H 2: the energy of three methods over 10^5 steps, and a
 * pendulum, without damping.
 *
 * - Block 0: the harmonic oscillator m = c = 1 with h = 1/50, by explicit Euler, implicit Euler and the
 *   variational integrator: k, the three energies divided by the energy at the start, (1 + h^2 c/m)^k and its
 *   inverse.
 * - Blocks 1 to 4: x and p of a pendulum that starts at rest at 2 radians, with h = 1/5, by explicit Euler,
 *   implicit Euler, and the variational integrator with kappa = 0 and with kappa = 1/2. */
#include <fvi/discrete_mechanics.h>
#include <fvi/error.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STEPS = 100000 };

static const double one = 1, none = 0;

/* Return the energy, NAN if fvi_energy fails. */
static double energy(const fvi_system *system, const double *x, const double *p)
{
    double E;
    return fvi_energy(system, x, p, &E) ? (double)NAN : E;
}

static fvi_stepper *start(const fvi_method *method, const fvi_run *run)
{
    fvi_stepper *s;
    if (fvi_stepper_start(method, run, &s, NULL) != FVI_SUCCESS)
        exit(EXIT_FAILURE);
    return s;
}

static void advance(fvi_stepper *s)
{
    if (fvi_stepper_step(s) != FVI_SUCCESS)
        exit(EXIT_FAILURE);
}

static void harmonic(void)
{
    const fvi_system system = { 1,     &one,
                                &none, fvi_potential_harmonic(&one),
                                { 0 }, NULL, NULL };
    const fvi_run run = { .system = &system,
                          .x0 = &one,
                          .p0 = &none,
                          .h = 0.02,
                          .steps = STEPS,
                          .kappa = 0.5,
                          .alpha = 0.5 };
    fvi_stepper *s[] = { start(&fvi_euler_explicit, &run),
                         start(&fvi_euler_implicit, &run),
                         start(&fvi_midpoint_variational, &run) };
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
        fvi_stepper_free(s[i]);
    printf("\n\n");
}

/* Print x and p of up to `steps` steps from rest at 2 radians. Stop when |x| > 4. */
static void pendulum(const fvi_method *method, double kappa, size_t steps)
{
    const fvi_system system = { 1,     &one,
                                &none, fvi_potential_pendulum(&one),
                                { 0 }, NULL, NULL };
    const double x0 = 2;
    const fvi_run run = { .system = &system,
                          .x0 = &x0,
                          .p0 = &none,
                          .h = 0.2,
                          .steps = steps,
                          .kappa = kappa,
                          .alpha = 0.5 };
    fvi_stepper *s = start(method, &run);
    printf("# pendulum, %s, kappa = %g, h = %g: x, p\n", method->name, kappa,
           run.h);
    for (; s->k < steps && fabs(s->x[0]) <= 4; advance(s))
        printf("%.9g %.9g\n", s->x[0], s->p[0]);
    fvi_stepper_free(s);
    printf("\n\n");
}

int main(void)
{
    harmonic();
    pendulum(&fvi_euler_explicit, 0.5, 200);
    pendulum(&fvi_euler_implicit, 0.5, 200);
    pendulum(&fvi_midpoint_variational, 0, 2000);
    pendulum(&fvi_midpoint_variational, 0.5, 2000);
    return EXIT_SUCCESS;
}
