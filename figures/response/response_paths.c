/* figures/response/response_paths.c -- H 30: the paths of the poles of three storeys as a damper grows.
 *
 * Masses and springs are 1. A springpot of order 1/2 stands below the first floor, with rho from 10^-3 to 10^3.
 * - Blocks 0 to 2, one for each pole: rho, Re s, Im s, damping ratio.
 * - Block 3: the three poles at rho = 10^-3, where the paths begin.
 * - Block 4: the three poles at rho = 1. */
#include <fvi/dampers.h>
#include <fvi/response.h>
#include <fvi/structures.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 600 };

static double rho_of(int i)
{
    return pow(10, -3 + 6.0 * i / STEPS);
}

/* Compute the poles for this rho. Replace each at[k], the pole for the rho before, by the new pole nearest to it. */
static void find_poles(const fvi_structure *storeys, double rho, double at[3][2])
{
    static const double row[3] = { 1, 0, 0 };
    const fvi_kernel_term term = { FVI_KERNEL_POWER, rho, 0.25, 0, 0 };
    const fvi_kernel kernel = { 1, &term };
    const fvi_damper damper = { .of = fvi_elongation_row(row), .kernel = &kernel };
    const fvi_mechanism mechanism = { .damper_count = 1, .damper = &damper };
    fvi_system system = fvi_structure_system(storeys);
    system.mechanism = &mechanism;
    const fvi_linear_motion motion = { .system = &system };
    fvi_response *response;
    fvi_poles p;
    if (fvi_response_alloc(&motion, &response, NULL)
        || fvi_poles_find(response, 0, &p, NULL) || p.count != 3)
        exit(EXIT_FAILURE);
    for (int k = 0; k < 3; k++) {
        size_t best = 0;
        double least = HUGE_VAL;
        for (size_t j = 0; j < 3; j++) {
            const double apart = hypot(p.pole[2 * j] - at[k][0], p.pole[2 * j + 1] - at[k][1]);
            if (apart < least) {
                least = apart;
                best = j;
            }
        }
        at[k][0] = p.pole[2 * best];
        at[k][1] = p.pole[2 * best + 1];
    }
    fvi_poles_free(&p);
    fvi_response_free(response);
}

static void print(double rho, const double at[2])
{
    printf("%.6g %.9g %.9g %.9g\n", rho, at[0], at[1], -at[0] / hypot(at[0], at[1]));
}

int main(void)
{
    static const fvi_triplet stiffness[] = { { 0, 0, 2 },  { 0, 1, -1 }, { 1, 0, -1 },
                                             { 1, 1, 2 },  { 1, 2, -1 }, { 2, 1, -1 },
                                             { 2, 2, 1 } },
                             mass[] = { { 0, 0, 1 }, { 1, 1, 1 }, { 2, 2, 1 } };
    fvi_sparse M, K;
    fvi_structure *storeys;
    if (fvi_sparse_assemble(3, 3, mass, &M) || fvi_sparse_assemble(3, 7, stiffness, &K)
        || fvi_structure_alloc(&M, &K, NULL, &storeys, NULL))
        return EXIT_FAILURE;
    double at[3][2] = { { 0 } };
    static double path[STEPS + 1][3][2];
    for (int j = 0; j < 3; j++) /* the frequencies without damping */
        at[j][1] = 2 * sin((2 * j + 1) * acos(-1) / 14);
    for (int i = 0; i <= STEPS; i++) {
        find_poles(storeys, rho_of(i), at);
        memcpy(path[i], at, sizeof at);
    }
    for (int k = 0; k < 3; k++) {
        printf("%s# pole %d: rho, re, im, damping ratio\n", k ? "\n\n" : "", k + 1);
        for (int i = 0; i <= STEPS; i++)
            print(rho_of(i), path[i][k]);
    }
    for (int i = 0; i <= STEPS / 2; i += STEPS / 2) { /* rho = 10^-3, then rho = 1 */
        printf("\n\n# at one rho\n");
        for (int k = 0; k < 3; k++)
            print(rho_of(i), path[i][k]);
    }
    fvi_structure_free(storeys);
    fvi_sparse_free(&M);
    fvi_sparse_free(&K);
    return EXIT_SUCCESS;
}
