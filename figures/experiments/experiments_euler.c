/* figures/experiments/experiments_euler.c -- H 10: the FVI beside explicit and implicit Euler.
 *
 * Prints t, x and the energy of the paper's oscillator, m = c = 1, rho = 0.2, x0 = 1, p0 = 1/2, alpha = 1/2, up
 * to T = 15. The blocks are the exact solution, the FVI and implicit Euler with h = 0.2, the FVI and explicit
 * Euler with h = 0.1. */
#include <fvi/fvi.h>
#include <fvi/paper/experiments.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FINE = 300, T = 15 };

static const double one = 1, rho = 0.2, x0 = 1, p0 = 0.5;

/* Return the energy, NAN if fvi_energy fails. */
static double energy(const fvi_system *system, const double *x, const double *p)
{
    double E;
    return fvi_energy(system, x, p, &E) ? (double)NAN : E;
}

static int print_run(const fvi_system *system, const fvi_method *method,
                     double h, size_t steps)
{
    const fvi_run run = {
        system, &x0, &p0, h, steps, .kappa = 0.5, .alpha = 0.5
    };
    fvi_stepper *s;
    int status = fvi_stepper_start(method, &run, &s, NULL);
    if (status)
        return status;
    printf("\n\n# %s, h = %g: t x energy\n", method->name, h);
    do {
        printf("%.17g %.17g %.17g\n", s->t, s->x[0],
               energy(system, s->x, s->p));
    } while (s->k < steps && (status = fvi_stepper_step(s)) == 0);
    fvi_stepper_free(s);
    return status;
}

int main(void)
{
    const fvi_system system = { .d = 1,
                                .mass = &one,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&one) };
    printf("# exact: t x energy\n");
    for (size_t k = 0; k <= FINE; k++) {
        double x, p, t = (double)k * T / FINE;
        if (fvi_damped_oscillator(1, rho, 1, x0, p0, t, &x, &p))
            return EXIT_FAILURE;
        printf("%.17g %.17g %.17g\n", t, x, energy(&system, &x, &p));
    }
    int status = print_run(&system, &fvi_fractional, 0.2, 75);
    if (!status)
        status = print_run(&system, &fvi_euler_implicit, 0.2, 75);
    if (!status)
        status = print_run(&system, &fvi_fractional, 0.1, 150);
    if (!status)
        status = print_run(&system, &fvi_euler_explicit, 0.1, 150);
    return status ? EXIT_FAILURE : EXIT_SUCCESS;
}
