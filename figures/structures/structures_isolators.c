/* figures/structures/structures_isolators.c -- H 27: five storeys on isolators of four orders.
 *
 * The building is that of isolators.h. The ground is filtered noise, as in structures_building.c. Prints three
 * blocks for each of four orders, and then the third one for a building without isolators:
 * - the loop of the isolators in the earthquake: x_1 and their force;
 * - a lasting wind: t and x_1. The wind blows from t = 0 on with the force 0.1 on each floor;
 * - the spectrum of the roof: f, and the largest acceleration of a light oscillator of this frequency on the
 *   roof, with 2 percent of damping. */
#include <fvi/fvi.h>
#include <fvi/exact_motion.h>
#include <fvi/observer.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 6000, ORDERS = 4, FREQUENCIES = 90 };

static const double h = 0.005;

#include "frame.h"
#include "isolators.h"

static double ground[STEPS + 2], roof[STEPS + 2];

/* Print how the slab moves in the wind, by the exact motion. */
static void blow(const fvi_system *system)
{
    static const double rest[FLOORS];
    const fvi_exact_problem problem = { .motion = { .system = system },
                                        .x0 = rest,
                                        .p0 = rest,
                                        .forcing = FVI_FORCING_STEP,
                                        .A = 0.1,
                                        .T = 1e9 };
    fvi_exact_motion *motion;
    fail(fvi_exact_motion_alloc(&problem, &motion, NULL));
    printf("\n\n");
    for (int i = 0; i <= 240; i++) {
        const double t = 0.1 * pow(10, i / 40.);
        double x[FLOORS];
        fail(fvi_exact_motion_at(motion, 1, &t, x, NULL, NULL));
        printf("%.4g %.4g\n", t, x[0]);
    }
    fvi_exact_motion_free(motion);
}

/* Compute the acceleration of the roof. Print the loop and the wind, but not if alpha is 0: then the slab is fixed. */
static void run(double alpha)
{
    static const double rest[FLOORS];
    building b;
    build(alpha, &b);
    fvi_stepper *s;
    fvi_observer *o;
    fvi_system system = fvi_structure_system(b.structure);
    system.force = (fvi_force){ .value = load, .params = ground };
    const fvi_run r = fvi_run_default(&system, rest, rest, h, STEPS);
    fail(fvi_stepper_start(&fvi_cq2_midpoint, &r, &s, NULL));
    fail(fvi_observer_start(s, FVI_OBSERVE_ACCELERATION | FVI_OBSERVE_FORCE, &o, NULL));
    while (s->k < STEPS) {
        fvi_observation now;
        fail(fvi_observer_step(o, s));
        fail(fvi_observer_read(o, s, s->t, &now));
        roof[s->k] = now.a[FLOORS - 1] + ground[s->k];
        if (alpha > 0 && s->t <= 12 && s->k % 4 == 0)
            printf("%.4g %.4g\n", now.x[0], now.force[0] + b.below * now.x[0]);
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
    if (alpha > 0)
        blow(&system);
    demolish(&b);
}

/* ---- the spectrum of the roof ---- */

/* Return the largest acceleration of an oscillator of the frequency f on the roof, which is w^2 times its stretch. */
static double largest_acceleration(double f)
{
    const double w = 2 * 3.14159265358979324 * f, c = w * w, rho = 2 * 0.02 * w, mass = 1,
                 rest = 0;
    const fvi_system system = { .d = 1,
                                .mass = &mass,
                                .damping = &rho,
                                .potential = fvi_potential_harmonic(&c),
                                .force = { .value = load, .params = roof } };
    const fvi_run r = fvi_run_default(&system, &rest, &rest, h, STEPS);
    fvi_stepper *s;
    double largest = 0;
    fail(fvi_stepper_start(&fvi_cq2_midpoint, &r, &s, NULL));
    while (s->k < STEPS) {
        fail(fvi_stepper_step(s));
        largest = larger(largest, fabs(*s->x));
    }
    fvi_stepper_free(s);
    return c * largest;
}

int main(void)
{
    shake(ground);
    for (int n = 1; n <= ORDERS + 1; n++) {
        run(n <= ORDERS ? 0.1 * n : 0);
        if (n <= ORDERS)
            printf("\n\n");
        for (int i = 0; i < FREQUENCIES; i++) {
            const double f = 0.2 * pow(75, (double)i / (FREQUENCIES - 1));
            printf("%.4g %.4g\n", f, largest_acceleration(f));
        }
        printf("\n\n");
    }
    return 0;
}
