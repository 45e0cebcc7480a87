/* tests/structures/building.h -- Five storeys with three kinds of dampers, for tests of H 27 and 30. */
#ifndef BUILDING_H
#define BUILDING_H

#include "structures_runs.h"

enum { D = 5 };

static const double ones[D] = { 1, 1, 1, 1, 1 };

static inline void diagonal(double factor, const double *a, fvi_sparse *A)
{
    fvi_triplet list[D];
    for (int i = 0; i < D; i++)
        list[i] = (fvi_triplet){ i, i, factor * a[i] };
    OK(fvi_sparse_assemble(D, D, list, A));
}

/* Five storeys of mass 1 and stiffness 100: a springpot below the first, a power of an order
 * above 1 below the third, a dashpot with a fraction beside it below the fifth. */
typedef struct {
    fvi_kernel_term term[4];
    fvi_kernel kernel[3];
    double row[3][D];
    fvi_damper damper[3];
    fvi_sparse M, K;
    fvi_structure *structure;
    fvi_system system;
} building;

static inline void build(building *b)
{
    static const size_t storey[] = { 0, 2, 4 };
    *b = (building){
        .term = { { FVI_KERNEL_POWER, 5, 0.3125, 0, 0 },
                  { FVI_KERNEL_POWER, 1, 0.6875, 0, 0 },
                  { FVI_KERNEL_POWER, 0.5, 0.5, 0, 0 },
                  { FVI_KERNEL_ZENER, 3, 0.25, 2, 0 } },
    };
    b->kernel[0] = (fvi_kernel){ 1, b->term };
    b->kernel[1] = (fvi_kernel){ 1, b->term + 1 };
    b->kernel[2] = (fvi_kernel){ 2, b->term + 2 };
    for (size_t j = 0; j < 3; j++) {
        b->row[j][storey[j]] = 1;
        if (storey[j] > 0)
            b->row[j][storey[j] - 1] = -1;
        b->damper[j] = (fvi_damper){ .of = fvi_elongation_row(b->row[j]),
                                     .kernel = b->kernel + j };
    }
    fvi_triplet list[3 * D];
    size_t count = 0;
    for (int i = 0; i < D; i++)
        for (int j = i > 0 ? i - 1 : 0; j <= i + 1 && j < D; j++)
            list[count++] = (fvi_triplet){ i, j, i != j ? -100 : i < D - 1 ? 200 : 100 };
    OK(fvi_sparse_assemble(D, count, list, &b->K));
    diagonal(1, ones, &b->M);
    OK(fvi_structure_alloc_dampers(&b->M, &b->K, 3, b->damper, &b->structure, NULL));
    b->system = fvi_structure_system(b->structure);
}

static inline void free_building(building *b)
{
    fvi_structure_free(b->structure);
    fvi_sparse_free(&b->M);
    fvi_sparse_free(&b->K);
}

static const double shape[D] = { 1. / 16, 2. / 16, 2. / 16, 3. / 16, 4. / 16 },
                    push[D] = { 1. / 4, -2. / 4, 0, 1. / 4, 3. / 4 };

#endif
