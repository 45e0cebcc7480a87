/* figures/structures/structures_isolators.c -- H 27: five storeys on isolators.
 *
 * A slab and five floors of mass 1, storeys of stiffness 2000 with dashpots (2 percent of damping at
 * the first frequency of the frame), and isolators below the slab: a spring and a springpot of order
 * 2 alpha. At the frequency of the isolated building, 2.5, the isolators of all four orders have the
 * stiffness 38 and the loss 11.4: a test at that frequency cannot tell them apart. The ground is
 * filtered noise, as for structures_building.c. Prints for each order the loop of the isolators, x_1 and their
 * force, then f and the largest acceleration of a light oscillator of that frequency on the roof, with
 * 2 percent of damping, then t and how far a wind that blows from t = 0 on with 0.1 on each floor has
 * pushed the slab; and last the spectrum without isolators. */
#include <fvi/fvi.h>
#include <fvi/exact_motion.h>
#include <fvi/observer.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FLOORS = 6, STEPS = 6000, ORDERS = 4, FREQUENCIES = 90 };

static const double h = 0.005, frame = 2000, stiff = 38, loss = 11.4, isolated = 2.5;

#include "frame.h"

static double ground[STEPS + 2], roof[STEPS + 2];

static void build(double below, fvi_sparse *M, fvi_sparse *K, fvi_sparse *C)
{
    const double dashpot = 2 * 0.02 / 12.73; /* of K, at the frame's first frequency */
    fvi_triplet m[FLOORS], k[4 * FLOORS], c[4 * FLOORS];
    size_t springs = 0, dampers = 0;
    add(k, &springs, -1, 0, below);
    for (int i = 0; i < FLOORS; i++) {
        m[i] = (fvi_triplet){ i, i, 1 };
        if (i == 0)
            continue;
        add(k, &springs, i - 1, i, frame);
        add(c, &dampers, i - 1, i, frame * dashpot);
    }
    fail(fvi_sparse_assemble(FLOORS, FLOORS, m, M));
    fail(fvi_sparse_assemble(FLOORS, springs, k, K));
    fail(fvi_sparse_assemble(FLOORS, dampers, c, C));
}

/* A wind, by the exact motion. */
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

/* The roof's acceleration; the loop and the wind are printed unless alpha is 0, where the slab is fixed. */
static void run(double alpha)
{
    const double cut = 3.14159265358979324 * alpha,
                 below = alpha > 0 ? stiff - loss / tan(cut) : 1e6;
    const fvi_kernel_term springpot = { FVI_KERNEL_POWER,
                                        alpha > 0 ? loss / pow(isolated, 2 * alpha) / sin(cut)
                                                  : 0,
                                        alpha, 0, 0 },
                          viscous = { FVI_KERNEL_POWER, 1, 0.5, 0, 0 };
    const fvi_kernel kernel[] = { { 1, &springpot }, { 1, &viscous } };
    static const double slab[FLOORS] = { 1 }, rest[FLOORS];
    fvi_sparse M, K, C;
    build(below, &M, &K, &C);
    const fvi_damper dampers[] = { { .of = fvi_elongation_row(slab), .kernel = kernel },
                                   { .matrix = &C, .kernel = kernel + 1 } };
    fvi_structure *structure;
    fvi_stepper *s;
    fvi_observer *o;
    fail(fvi_structure_alloc_dampers(&M, &K, 2, dampers, &structure, NULL));
    fvi_system system = fvi_structure_system(structure);
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
            printf("%.4g %.4g\n", now.x[0], now.force[0] + below * now.x[0]);
    }
    fvi_observer_free(o);
    fvi_stepper_free(s);
    if (alpha > 0)
        blow(&system);
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
    fvi_sparse_free(&C);
}

/* ---- the spectrum of the roof ---- */

/* The largest acceleration of an oscillator on the roof: w^2 times its stretch. */
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
