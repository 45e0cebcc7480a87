/* figures/structures/isolators.h -- H 27: five storeys on isolators, for the picture and for the moving picture.
 *
 * The building is a slab and five floors of mass 1, with storeys of stiffness 2000 and dashpots (2 percent of
 * damping at the first frequency of the frame). Below the slab are isolators: a spring and a springpot of order
 * 2 alpha. The frequency of the isolated building is 2.5. At this frequency the isolators of every order have
 * the stiffness 38 and the loss 11.4, so a test at this frequency cannot tell them apart. Include this file
 * after frame.h. */
#ifndef FVI_ISOLATORS_H
#define FVI_ISOLATORS_H

#include <fvi/structures.h>

enum { FLOORS = 6 };

static const double frame = 2000, stiff = 38, loss = 11.4, isolated = 2.5;

/* Do not copy or move a building while it is in use: its parts point at each other. */
typedef struct {
    double slab[FLOORS], below; /* the row that selects the slab from x; the stiffness of the isolators' spring */
    fvi_sparse M, K, C;
    fvi_kernel_term springpot, viscous;
    fvi_kernel kernel[2];
    fvi_damper dampers[2];
    fvi_structure *structure;
} building;

static void assemble_building(building *b)
{
    const double dashpot = 2 * 0.02 / 12.73; /* C = dashpot K: 2 percent at the frequency 12.73 */
    fvi_triplet m[FLOORS], k[4 * FLOORS], c[4 * FLOORS];
    size_t springs = 0, dampers = 0;
    add(k, &springs, -1, 0, b->below);
    for (int i = 0; i < FLOORS; i++) {
        m[i] = (fvi_triplet){ i, i, 1 };
        if (i == 0)
            continue;
        add(k, &springs, i - 1, i, frame);
        add(c, &dampers, i - 1, i, frame * dashpot);
    }
    fail(fvi_sparse_assemble(FLOORS, FLOORS, m, &b->M));
    fail(fvi_sparse_assemble(FLOORS, springs, k, &b->K));
    fail(fvi_sparse_assemble(FLOORS, dampers, c, &b->C));
}

/* Build the building with isolators of order 2 alpha. alpha = 0: no isolators, the slab is fixed to the ground. */
static void build(double alpha, building *b)
{
    const double cut = 3.14159265358979324 * alpha;
    *b = (building){ .slab = { 1 }, .below = alpha > 0 ? stiff - loss / tan(cut) : 1e6 };
    assemble_building(b);
    b->springpot = (fvi_kernel_term){
        FVI_KERNEL_POWER, alpha > 0 ? loss / pow(isolated, 2 * alpha) / sin(cut) : 0, alpha, 0, 0
    };
    b->viscous = (fvi_kernel_term){ FVI_KERNEL_POWER, 1, 0.5, 0, 0 };
    b->kernel[0] = (fvi_kernel){ 1, &b->springpot };
    b->kernel[1] = (fvi_kernel){ 1, &b->viscous };
    b->dampers[0] = (fvi_damper){ .of = fvi_elongation_row(b->slab), .kernel = b->kernel };
    b->dampers[1] = (fvi_damper){ .matrix = &b->C, .kernel = b->kernel + 1 };
    fail(fvi_structure_alloc_dampers(&b->M, &b->K, 2, b->dampers, &b->structure, NULL));
}

static void demolish(building *b)
{
    fvi_structure_free(b->structure);
    fvi_sparse_free(&b->M);
    fvi_sparse_free(&b->K);
    fvi_sparse_free(&b->C);
}

#endif
