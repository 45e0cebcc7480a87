/* figures/structures/structures_building.c -- H 27: twenty storeys on moving ground, without and with dampers.
 *
 * The floors have mass 1 and the storeys stiffness 800, so the first period is 2.9 s. Six viscoelastic dampers
 * of order 2 alpha = 0.6 stand each between two floors that have no other damper. The ground is white noise
 * from a generator with a fixed seed, sent through a filter of 2.5 Hz; it grows and dies away within 20 s.
 * - Block 0: t, the acceleration of the ground, the roof without dampers, the roof with dampers.
 * - Block 1: floor, and the largest drift of the storey below it, without and with dampers. */
#include <fvi/fvi.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { FLOORS = 20, STEPS = 3000, EVERY = 5, DAMPERS = 6 };

static const double h = 0.01, alpha = 0.3, stiffness = 800, damper = 600;
static const int lower[DAMPERS] = { 0, 2, 4, 6, 8, 10 }; /* the floor below each damper; the first floor is 0 */

#include "frame.h"

//> building
static void build(double size, fvi_sparse *M, fvi_sparse *K, fvi_sparse *C)
{
    fvi_triplet m[FLOORS], k[4 * FLOORS], c[4 * DAMPERS];
    size_t count = 0, dampers = 0;
    for (int i = 0; i < FLOORS; i++) {
        m[i] = (fvi_triplet){ i, i, 1 };
        add(k, &count, i - 1, i, stiffness);
    }
    for (int l = 0; l < DAMPERS && size > 0; l++)
        add(c, &dampers, lower[l], lower[l] + 1, size);
    fail(fvi_sparse_assemble(FLOORS, FLOORS, m, M));
    fail(fvi_sparse_assemble(FLOORS, count, k, K));
    fail(fvi_sparse_assemble(FLOORS, dampers, c, C));
}
//< building

/* Compute the position of the roof at every step, and the largest drift of each storey. size = 0: no dampers. */
static void run(double size, double *ground, double *roof, double *drift)
{
    fvi_sparse M, K, C;
    fvi_structure *structure;
    double rest[FLOORS] = { 0 };
    build(size, &M, &K, &C);
    fail(fvi_structure_alloc(&M, &K, &C, &structure, NULL));
    fvi_system system = fvi_structure_system(structure);
    system.force = (fvi_force){ .value = load, .params = ground };
    fvi_run r = fvi_run_default(&system, rest, rest, h, STEPS);
    r.alpha = alpha;
    fvi_stepper *s;
    fail(fvi_stepper_start(&fvi_cq2_midpoint, &r, &s, NULL));
    for (;; fail(fvi_stepper_step(s))) {
        roof[s->k] = s->x[FLOORS - 1];
        for (int i = 0; i < FLOORS; i++)
            drift[i] =
                larger(drift[i], fabs(s->x[i] - (i > 0 ? s->x[i - 1] : 0)));
        if (s->k == STEPS)
            break;
    }
    fvi_stepper_free(s);
    fvi_structure_free(structure);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
    fvi_sparse_free(&C);
}

int main(void)
{
    static double ground[STEPS + 2], incomplete[STEPS + 1], damped[STEPS + 1];
    double drift[2][FLOORS] = { { 0 } };
    shake(ground);
    run(0, ground, incomplete, drift[0]);
    run(damper, ground, damped, drift[1]);
    for (int k = 0; k <= STEPS; k += EVERY)
        printf("%g %.5g %.5g %.5g\n", k * h, ground[k], incomplete[k], damped[k]);
    printf("\n\n");
    for (int i = 0; i < FLOORS; i++)
        printf("%d %.5g %.5g\n", i + 1, drift[0][i], drift[1][i]);
    return 0;
}
